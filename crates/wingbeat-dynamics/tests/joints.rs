//! Free joints on a flying root: the momentum form against the quaternion form, balances, closed
//! solutions.

use crate::common;

use common::*;
use std::sync::Arc;
use wingbeat_dynamics::{
    BodyAcceleration, BodyMotion, ElementLaw, Formulation, JointModel, JointType, MomentumForm,
    QuaternionForm, Stabilization, System, TravelLaw, budget, relative_energy, tethered_motions,
};
use wingbeat_math::ode::{Dop853, Tolerance};
use wingbeat_math::{DMat3, DVec3, DriftingFourier, EulerSequence, MassProperties};

/// A slide along axis 3 of the parent and back.
#[derive(Debug)]
struct Slide;

impl TravelLaw for Slide {
    fn at(&self, t: f64) -> [DVec3; 3] {
        let w = std::f64::consts::TAU / BEAT;
        let (s, c) = (w * t).sin_cos();
        [1e-4 * s, 1e-4 * w * c, -1e-4 * w * w * s].map(|x| DVec3::Z * x)
    }
}

/// The fly with four more bodies, each on another kind of joint: an abdomen on a ball joint, a
/// second segment on a universal joint behind it, a slider in the body, and a passive flap on the
/// right wing; the left hinge travels.
fn menagerie() -> System {
    let base = fly(GRAVITY);
    let (mut bodies, mut hinges) = (base.bodies().to_vec(), base.hinges().to_vec());
    let part = |share: f64| {
        let mass = share * BODY_MASS;
        let j = DMat3::from_diagonal(DVec3::new(1.0, 2.0, 2.5)) * (mass * 1e-7);
        MassProperties::about_centre(mass, DVec3::new(-3e-4, 1e-4, 5e-5), j)
    };
    let mut add = |name: &str, parent: usize, share: f64, at: DVec3| {
        bodies.push(body(name, part(share), EulerSequence::BODY_231));
        let mut h = hinge(name, bodies.len() - 1, at, DMat3::IDENTITY);
        h.parent = Some(parent);
        hinges.push(h);
    };
    add("abdomen", 0, 0.4, DVec3::new(-5e-4, 0.0, 1e-4));
    add("tail", 3, 0.1, DVec3::new(-6e-4, 0.0, 0.0));
    add("slider", 0, 0.05, DVec3::new(0.0, 0.0, 3e-4));
    add("flap", 2, 0.002, DVec3::new(0.0, 0.7 * LENGTH, 0.0));
    let spring = |stiffness: f64| ElementLaw::Spring {
        stiffness,
        rest: 0.1,
    };
    let damper = |coefficient: f64| ElementLaw::Damper { coefficient };
    let axis = DVec3::new(0.6, 0.0, 0.8);
    let ball = (0..3).fold(JointModel::new(JointType::Spherical), |j, k| {
        j.with(k, spring(1e-7)).with(k, damper(1e-11))
    });
    let cross = JointModel::new(JointType::Universal {
        axes: [DVec3::Y, DVec3::Z],
    })
    .with(0, spring(2e-8))
    .with(
        1,
        ElementLaw::Follow {
            target: DriftingFourier {
                frequency: 1.0 / BEAT,
                sine: vec![0.3],
                ..DriftingFourier::default()
            },
            stiffness: 2e-8,
            damping: 2e-12,
        },
    )
    .starting(&[0.2, -0.1], &[3.0, 0.0]);
    let slider = JointModel::new(JointType::Prismatic { axis })
        .with(
            0,
            ElementLaw::Spring {
                stiffness: 0.2,
                rest: 0.0,
            },
        )
        .with(
            0,
            ElementLaw::Effort(DriftingFourier {
                frequency: 150.0,
                cosine: vec![1e-6],
                ..DriftingFourier::default()
            }),
        )
        .starting(&[5e-5], &[]);
    let flap = JointModel::new(JointType::Revolute { axis: DVec3::Y })
        .with(0, spring(3e-9))
        .with(0, damper(1e-13));
    let mut travelling = JointModel::new(JointType::Weld);
    travelling.travel = Some(Arc::new(Slide));
    let joints = [
        travelling,
        JointModel::new(JointType::Weld),
        ball,
        cross,
        slider,
        flap,
    ];
    let system = System::new(bodies, hinges, GRAVITY, UNITS).unwrap();
    (joints.into_iter().enumerate()).fold(system, |s, (k, j)| s.with_joint(k, j).unwrap())
}

/// State after `beats` beats in steps of 1/`grid` beat at tolerance `tol`.
fn fly_on(form: &dyn Formulation, loads: Loads, beats: f64, tol: f64) -> Vec<f64> {
    let mut flight = Flight::new(form, loads);
    let (mut ws, mut y) = (form.workspace(), form.initial(0.0, &start()).unwrap());
    let tolerance = Tolerance {
        relative: tol,
        absolute: tol,
        max_steps: 100_000,
    };
    let mut method = Dop853::new(tolerance, form.scales());
    let pieces = (beats * 20.0).round() as usize;
    for k in 0..pieces {
        let at = |k: usize| k as f64 * BEAT / 20.0;
        let rates = |t: f64, y: &[f64], dy: &mut [f64]| flight.rates(t, y, dy);
        method.integrate((at(k), at(k + 1)), &mut y, rates).unwrap();
        form.normalise(at(k + 1), &mut y, &mut ws).unwrap();
    }
    y
}

#[test]
fn agrees_free_joints_of_every_kind_in_momentum_and_quaternion_form() {
    let system = menagerie();
    let m = MomentumForm::new(system.clone());
    let q = QuaternionForm::new(system, Stabilization::Projection);
    let t = 3.0 * BEAT;
    let forms: [&dyn Formulation; 2] = [&m, &q];
    let ends = forms.map(|form| {
        let y = fly_on(form, applied, 3.0, 1e-13);
        let mut f = Flight::new(form, applied);
        let s = f.solve(t, &y).unwrap().clone();
        (f.motions.clone(), s)
    });
    let [(ma, sa), (mb, sb)] = ends;
    let mut gap = [0.0_f64; 4];
    for (x, y) in ma.iter().zip(&mb) {
        let (p, r) = distance(x, y);
        (gap[0], gap[1]) = (gap[0].max(p), gap[1].max(r));
    }
    let force = sa
        .hinges
        .iter()
        .map(|h| h.force.length())
        .fold(0.0, f64::max);
    let moment = sa
        .hinges
        .iter()
        .map(|h| h.moment.length())
        .fold(0.0, f64::max);
    for (x, y) in sa.hinges.iter().zip(&sb.hinges) {
        gap[2] = gap[2].max((x.force - y.force).length() / force);
        gap[3] = gap[3].max((x.moment - y.moment).length() / moment);
    }
    println!(
        "seven bodies, five kinds of joints: {gap:.1?}",
        gap = gap.map(f64::log10)
    );
    // Three beats at 1e-13 in two sets of variables, the flap's spring oscillating fast.
    assert!(gap.iter().all(|g| *g < 1e-9), "{gap:?}");
}

#[test]
fn balances_energy_of_free_joints_and_their_elements() {
    // E - E(0) = work of hinges (springs, dampers, actuators, prescriptions) and loads.
    let form = MomentumForm::new(menagerie());
    let mut flight = Flight::new(&form, applied);
    let n = form.dim();
    let mut y = form.initial(0.0, &start()).unwrap();
    let first = flight.solve(0.0, &y).unwrap().energy();
    y.push(0.0);
    let mut scales = form.scales();
    let unit = first.abs();
    scales.push(unit);
    let tolerance = Tolerance {
        relative: 1e-12,
        absolute: 1e-12,
        max_steps: 100_000,
    };
    let rates = |t: f64, y: &[f64], dy: &mut [f64]| {
        flight.rates(t, &y[..n], &mut dy[..n])?;
        let s = flight.solve(t, &y[..n])?;
        dy[n] = s.hinge_power() + s.load_power;
        Ok::<(), wingbeat_dynamics::DynamicsError>(())
    };
    Dop853::new(tolerance, scales)
        .integrate((0.0, 3.0 * BEAT), &mut y, rates)
        .unwrap();
    let mut flight = Flight::new(&form, applied);
    let s = flight.solve(3.0 * BEAT, &y[..n]).unwrap();
    let gap = (s.energy() - first - y[n]).abs() / s.budget.kinetic;
    println!("energy less work after three beats: {gap:.1e} of the kinetic energy");
    assert!(gap < 1e-9); // integration at 1e-12
}

/// Jacobi's sn, cn, dn of `u` for the parameter m = k^2 < 1, by descending Landen steps
/// [Abramowitz & Stegun 1964, 16.4].
fn jacobi(u: f64, m: f64) -> [f64; 3] {
    let (mut a, mut b, mut pairs) = (1.0, (1.0 - m).sqrt(), vec![]);
    let mut scale = 1.0;
    while pairs.len() < 12 {
        let c: f64 = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        pairs.push(c / a);
        scale *= 2.0;
    }
    let mut phi = scale * a * u;
    for ratio in pairs.iter().rev() {
        phi = 0.5 * (phi + (ratio * phi.sin()).asin());
    }
    let s = phi.sin();
    [s, phi.cos(), (1.0 - m * s * s).sqrt()]
}

#[test]
fn exact_free_rigid_body_in_jacobi_elliptic_functions() {
    // A > B > C, 2 T B < H^2 [Landau & Lifshitz 1969, par. 37, axes 1, 2, 3 of growing moments]:
    // w1 = a1 cn, w2 = a2 sn, w3 = a3 dn. One case lies next to the separatrix: turning about the
    // intermediate axis, which tumbles.
    let [i1, i2, i3] = [1e-13, 2e-13, 2.6e-13];
    let mass = MassProperties::about_centre(
        BODY_MASS,
        DVec3::ZERO,
        DMat3::from_diagonal(DVec3::new(i1, i2, i3)),
    );
    for w0 in [
        DVec3::new(40.0, 0.0, 60.0),
        DVec3::new(2.0, 0.0, 1.9) + DVec3::Y * 90.0,
    ] {
        // Shift of time so that w2 may begin anywhere: found from sn at the start by bisection.
        let energy = i1 * w0.x * w0.x + i2 * w0.y * w0.y + i3 * w0.z * w0.z;
        let spin = (i1 * w0.x).powi(2) + (i2 * w0.y).powi(2) + (i3 * w0.z).powi(2);
        assert!(spin > energy * i2, "the branch of the formulas");
        let a1 = ((energy * i3 - spin) / (i1 * (i3 - i1))).sqrt();
        let a2 = ((energy * i3 - spin) / (i2 * (i3 - i2))).sqrt();
        let a3 = ((spin - energy * i1) / (i3 * (i3 - i1))).sqrt();
        let rate = ((i3 - i2) * (spin - energy * i1) / (i1 * i2 * i3)).sqrt();
        let m = (i2 - i1) * (energy * i3 - spin) / ((i3 - i2) * (spin - energy * i1));
        let at = |tau: f64| {
            let [s, c, d] = jacobi(tau, m);
            DVec3::new(a1 * c, a2 * s, a3 * d)
        };
        let (mut low, mut high) = (0.0, 20.0);
        // sn rises from 0 to its first maximum: bisect there, w1 > 0.
        while at(high).x < 0.0 || at(high * 0.5).x < 0.0 || at(high * 0.75).x < 0.0 {
            high *= 0.5;
        }
        for _ in 0..200 {
            let mid = 0.5 * (low + high);
            if at(mid).y < w0.y {
                low = mid
            } else {
                high = mid
            }
        }
        let tau0 = low;
        assert!((at(tau0) - w0).length() < 1e-6, "{} {w0}", at(tau0));
        let bodies = vec![body("top", mass, EulerSequence::BODY_231)];
        let system = System::new(bodies, vec![], DVec3::ZERO, UNITS).unwrap();
        let forms: [Box<dyn Formulation>; 2] = [
            Box::new(MomentumForm::new(system.clone())),
            Box::new(QuaternionForm::new(system, Stabilization::None)),
        ];
        for form in forms {
            let mut flight = Flight::new(form.as_ref(), none);
            let begin = BodyMotion {
                w: at(tau0),
                ..BodyMotion::REST
            };
            let mut y = form.initial(0.0, &begin).unwrap();
            let tolerance = Tolerance {
                relative: 1e-14,
                absolute: 1e-14,
                max_steps: 100_000,
            };
            let mut method = Dop853::new(tolerance, form.scales());
            let mut worst = 0.0_f64;
            for k in 0..40 {
                let (t0, t1) = (f64::from(k) * BEAT, f64::from(k + 1) * BEAT);
                let rates = |t: f64, y: &[f64], dy: &mut [f64]| flight.rates(t, y, dy);
                method.integrate((t0, t1), &mut y, rates).unwrap();
                let w = flight.motions(t1, &y)[0].w;
                worst = worst.max((w - at(tau0 + rate * t1)).length() / w0.length());
            }
            println!(
                "parameter m = {m:.6}: {worst:.1e} over {:.1} periods",
                rate * 0.2 / 6.3
            );
            // The separatrix multiplies rounding by 1 / (1 - m) or so.
            assert!(worst < 1e-11 / (1.0 - m));
        }
    }
}

#[test]
fn agrees_relative_energy_with_its_rate_and_a_fixed_root() {
    // Differences of the energy along a flight against the rate; and on a root at rest all energy
    // is relative.
    let form = MomentumForm::new(menagerie());
    let y0 = fly_on(&form, applied, 0.3, 1e-13);
    let (t0, mut flight) = (0.3 * BEAT, Flight::new(&form, applied));
    let mut at = |dt: f64| {
        let mut y = y0.clone();
        let tolerance = Tolerance {
            relative: 1e-13,
            absolute: 1e-13,
            max_steps: 1000,
        };
        if dt != 0.0 {
            let rates = |t: f64, y: &[f64], dy: &mut [f64]| flight.rates(t, y, dy);
            let mut method = Dop853::new(tolerance, form.scales());
            (method.integrate((t0, t0 + dt), &mut y, rates)).unwrap();
        }
        let s = flight.solve(t0 + dt, &y).unwrap().clone();
        relative_energy(form.system(), &flight.motions, &s.bodies)
    };
    let rate = at(0.0)[1];
    let h = 1e-3 * BEAT;
    let slope = (8.0 * (at(h)[0] - at(-h)[0]) - (at(2.0 * h)[0] - at(-2.0 * h)[0])) / (12.0 * h);
    assert!((slope - rate).abs() < 1e-7 * rate.abs(), "{slope} {rate}"); // h^4 and rounding / h
    let system = fly(GRAVITY);
    let mut m = vec![BodyMotion::REST; 3];
    let mut ws = wingbeat_dynamics::Workspace::new(&system);
    tethered_motions(&system, t0, &BodyMotion::REST, &mut ws, &mut m);
    let still = vec![BodyAcceleration::default(); 3];
    let [energy, _] = relative_energy(&system, &m, &still);
    let whole = budget(&system, &m).kinetic;
    assert!((energy - whole).abs() < 1e-14 * whole);
}
