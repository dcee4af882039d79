//! Vortex particles, and wakes of rings and particles.

use crate::lab::series::rms;
use crate::lab::{fly, order, rectangle, total_force, translating};
use crate::{Case, Part, Row, VerifyError};
use std::f64::consts::{PI, TAU};
use wingbeat_air::{
    AirError, AirLoads, AirSettings, AirState, CoreModel, Lattice, NodeMotion, ParticleSettings,
    Stretching, Surface,
};
use wingbeat_math::{DMat3, DVec3, r1};

pub(super) const CASES: &[Case] = &[
    Case {
        name: "vortex-particles",
        about: "Particles alone: the speed of a ring, total vorticity and impulse of two rings that stretch \
                each other.",
        part: Part::Analytic,
        quick: true,
        run: alone,
    },
    Case {
        name: "hybrid-wake",
        about: "A plunging wing of aspect ratio 4 at k = 0.5 whose wake becomes particles after 1, 4 and 12 \
                rows, against the wake of rings.",
        part: Part::Analytic,
        quick: true,
        run: hybrid,
    },
];

const SIGMA: f64 = 0.1;

fn settings(after: usize, radius: f64) -> ParticleSettings {
    ParticleSettings {
        after: Some(after),
        leading_at_once: false,
        radius,
        viscosity: 0.0,
        stretching: Stretching::Transpose,
    }
}

/// Particles far from a wing of a millimetre: nothing else moves them.
struct Cloud {
    lattice: Lattice,
    rest: NodeMotion,
    state: AirState,
}

impl Cloud {
    fn new(radius: f64, stretching: Stretching) -> Result<Self, AirError> {
        let particles = ParticleSettings {
            stretching,
            ..settings(1_000_000, radius)
        };
        let all = AirSettings {
            particles: Some(particles),
            ..AirSettings::accurate(1.0, DVec3::ZERO)
        };
        let lattice = Lattice::new(vec![Surface::grid("speck", 1, 1)], all)?;
        let nodes = rectangle(1, 1, 1e-3 * DVec3::X, 1e-3 * DVec3::Y);
        let nodes = nodes.iter().map(|x| *x + 1e3 * DVec3::Z).collect();
        let rest = translating(nodes, DVec3::ZERO);
        let state = lattice.initial_state(&rest);
        Ok(Self {
            lattice,
            rest,
            state,
        })
    }

    /// A ring of circulation and radius 1 in `n` particles.
    fn add_ring(&mut self, n: usize, turn: DMat3, centre: DVec3) {
        let set = &mut self.state.sheets[0].particles;
        for k in 0..n {
            let (s, c) = (TAU * (k as f64 + 0.5) / n as f64).sin_cos();
            let strength = TAU / n as f64 * DVec3::new(-s, c, 0.0);
            let place = turn * DVec3::new(c, s, 0.0) + centre;
            set.push(place, turn * strength, 0.0);
        }
    }

    fn go_on(&mut self, dt: f64, steps: usize) -> Result<(), AirError> {
        let (mut ws, mut loads) = (self.lattice.workspace(), AirLoads::default());
        for step in 0..steps {
            let (t, state) = (step as f64 * dt, &mut self.state);
            (self.lattice).loads(state, t, dt, &self.rest, &mut ws, &mut loads)?;
            self.lattice.accept(state, &self.rest, &loads)?;
            self.lattice.convect(state, dt, &mut ws)?;
        }
        Ok(())
    }
}

/// Speed of a ring of `n` particles over the time 2.
fn ring_speed(n: usize) -> Result<f64, AirError> {
    let mut cloud = Cloud::new(SIGMA, Stretching::Transpose)?;
    cloud.add_ring(n, DMat3::IDENTITY, DVec3::ZERO);
    cloud.go_on(0.01, 200)?; // in the core the air turns at G/(pi sigma^2) = 32 rad/s
    let set = &cloud.state.sheets[0].particles;
    Ok(set.position.z.iter().sum::<f64>() / n as f64 / 2.0)
}

/// Two rings at an angle: total vorticity, relative drift of the impulse.
fn two_rings(n: usize, sigma: f64, stretching: Stretching) -> Result<[f64; 2], AirError> {
    let mut cloud = Cloud::new(sigma, stretching)?;
    cloud.add_ring(n, DMat3::IDENTITY, DVec3::ZERO);
    cloud.add_ring(n, r1(1.0), DVec3::new(0.3, 1.2, 0.0));
    let before = cloud.state.sheets[0].particles.impulse();
    cloud.go_on(0.1 / n as f64, 4 * n)?;
    let set = &cloud.state.sheets[0].particles;
    let drift = (set.impulse() - before).length() / before.length();
    Ok([set.strength.iter().sum::<DVec3>().length(), drift])
}

fn alone(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let [coarse, fine] = [ring_speed(75)?, ring_speed(150)?];
    let term = |k: usize| {
        let r2 = 4.0 * (PI * (k as f64 + 0.5) / 2e4).sin().powi(2);
        0.5 * r2 * (r2 + 2.5 * SIGMA * SIGMA) / (r2 + SIGMA * SIGMA).powf(2.5)
    };
    let integral = (0..20_000).map(term).sum::<f64>() * TAU / 2e4 / (4.0 * PI);
    let thin = ((8.0 / SIGMA).ln() - 0.5) / (4.0 * PI);
    let mut rings = Vec::new();
    for scheme in [Stretching::Transpose, Stretching::Classical] {
        for n in [24, 48, 96] {
            let sigma = match scheme {
                Stretching::Transpose => 7.2 / n as f64,
                _ => 0.3,
            };
            rings.push(two_rings(n, sigma, scheme)?);
        }
    }
    Ok(vec![
        Row::new("speed of a ring of 150 particles, sigma = 0.1 R", "m/s", fine)
            .against(integral, "the same smoothing integrated along the circle")
            .uncertain(fine - coarse)
            .within_part(1e-5, "midpoint rule in balls wider than the spacing: exp(-2 pi sigma/h) of the peak"),
        Row::new("the same", "m/s", fine)
            .against(
                thin,
                "thin ring, G/(4 pi R) (ln(8 R/sigma) - 1/2), smoothing of Winckelmans & Leonard 1993",
            )
            .within_part(0.02, "next term, (sigma/R)^2 ln(R/sigma)"),
        Row::new("total vorticity of two rings, transpose scheme", "m3/s", rings[2][0])
            .against(0.0, "the scheme conserves it")
            .within(1e-12, "roundings"),
        Row::new("drift of their impulse, transpose scheme, 96 particles each", "1", rings[2][1])
            .against(0.0, "conservation of impulse in an unbounded fluid")
            .uncertain(rings[2][1] - rings[1][1])
            .within(2e-3, "first order in sigma, here 0.075: alpha x omega in the core"),
        Row::new("its order in sigma", "1", order(rings[0][1], rings[2][1]) / 2.0)
            .because("24, 48, 96 particles, sigma with their spacing"),
        Row::new("drift of their impulse, classical scheme, 96 particles each", "1", rings[5][1])
            .against(0.0, "conservation of impulse in an unbounded fluid")
            .uncertain(rings[5][1] - rings[4][1])
            .within(2e-5, "a material line keeps it: second order in spacing and step"),
        Row::new("its order in spacing and step", "1", order(rings[3][1], rings[5][1]) / 2.0)
            .because("24, 48, 96 particles, sigma = 0.3"),
    ])
}

/// Normal force of a plunging wing over 2 periods of 25 steps.
fn plunging(particles: Option<ParticleSettings>) -> Result<Vec<f64>, AirError> {
    let core = CoreModel::Scully { radius: 0.1 };
    let all = AirSettings {
        bound_core: core,
        wake_core: core,
        particles,
        ..AirSettings::accurate(1.2, DVec3::X)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", 4, 8)], all)?;
    let flat = rectangle(4, 8, DVec3::X, 4.0 * DVec3::Y);
    let motion = |t: f64| {
        let path = 0.2 * (1.0 - t.cos()) * DVec3::Z;
        let nodes = flat.iter().map(|x| *x + path).collect();
        translating(nodes, 0.2 * t.sin() * DVec3::Z)
    };
    let mut force = Vec::new();
    fly(&lattice, motion, TAU / 25.0, 50, |_, _, loads, _| {
        force.push(total_force(loads).z);
    })?;
    Ok(force)
}

fn hybrid(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let rings = plunging(None)?;
    let mut rows = Vec::new();
    for (after, bound) in [(1, 0.03), (4, 0.003), (12, 0.001)] {
        let hybrid = plunging(Some(settings(after, 0.25)))?;
        let apart: Vec<f64> = hybrid.iter().zip(&rings).map(|(a, b)| a - b).collect();
        rows.push(
            Row::new(
                format!("rms change of the normal force, particles after {after} rows"),
                "1",
                rms(&apart[25..]) / rms(&rings[25..]),
            )
            .against(0.0, "our own wake of rings")
            .within(
                bound,
                "a row is a quarter of a chord long, so is sigma: one row away the smoothing shows",
            ),
        );
    }
    Ok(rows)
}
