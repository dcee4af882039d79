//! Kelvin's theorem, impulse, three ways to the force.

use crate::lab::{fly, order, rectangle, total_force, translating};
use crate::{Case, Part, Row, VerifyError};
use wingbeat_air::{
    AirError, AirSettings, AirState, AirWorkspace, CoreModel, Lattice, LoadMethod, NodeMotion,
    Points, SheddingKinds, Surface,
};
use wingbeat_math::{DVec3, r2};

pub(super) const CASES: &[Case] = &[
    Case {
        name: "kelvin",
        about: "Circulation about an accelerating wing with all its wake.",
        part: Part::Analytic,
        quick: true,
        run: kelvin,
    },
    Case {
        name: "impulse",
        about: "Force from pressure, from Joukowski's theorem and from the rate of the vortex impulse, \
                on a heaving wing.",
        part: Part::Analytic,
        quick: true,
        run: impulse,
    },
    Case {
        name: "impulse-force",
        about: "The third way to the force, the rate of the impulse of all vorticity: a plate without wake, a \
                plunging wing at k = 0.5 with attached flow, a sphere.",
        part: Part::Analytic,
        quick: true,
        run: impulse_force,
    },
];

/// Circulation around the rectangle [x0, x1] x [z0, z1] in the plane y, right-handed about +y, by
/// Simpson's rule.
fn circulation(
    lattice: &Lattice,
    state: &AirState,
    ws: &mut AirWorkspace,
    [x0, x1, z0, z1]: [f64; 4],
    y: f64,
) -> Result<f64, AirError> {
    let corner =
        [[x0, z0], [x0, z1], [x1, z1], [x1, z0], [x0, z0]].map(|[x, z]| DVec3::new(x, y, z));
    let n = 400;
    let mut sum = 0.0;
    for side in corner.windows(2) {
        let path = side[1] - side[0];
        let points: Points = (0..=n)
            .map(|k| side[0] + path * (k as f64 / n as f64))
            .collect();
        let mut v = Points::default();
        lattice.velocity(state, &points, ws, &mut v)?;
        for k in 0..=n {
            let ends = k == 0 || k == n;
            let weight = if ends {
                1.0
            } else {
                2.0 + 2.0 * (k % 2) as f64
            };
            sum += weight / (3.0 * n as f64) * v.get(k).dot(path);
        }
    }
    Ok(sum)
}

fn kelvin(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let all = SheddingKinds {
        trailing: true,
        tip: true,
        leading: true,
        root: false,
    };
    let mut rows = Vec::new();
    for (name, shedding) in [
        ("trailing edge", SheddingKinds::TRAILING),
        ("all edges", all),
    ] {
        let settings = AirSettings {
            shedding,
            ..AirSettings::accurate(1.2, DVec3::X)
        };
        let lattice = Lattice::new(vec![Surface::grid("wing", 4, 5)], settings)?;
        let flat: Vec<DVec3> = (rectangle(4, 5, DVec3::X, 2.5 * DVec3::Y).iter())
            .map(|x| r2(0.2) * *x)
            .collect();
        let motion = |t: f64| {
            let path = DVec3::new(-0.5 * t * t, 0.0, 0.0);
            translating(
                flat.iter().map(|x| *x + path).collect(),
                DVec3::new(-t, 0.0, 0.0),
            )
        };
        let mut run = fly(&lattice, motion, 0.25, 6, |_, _, _, _| {})?;
        let x = run.state.position[4 * 6 + 2].x;
        let bound = run.state.gamma[17];
        let far = [x - 4.0, x + 8.0, -4.0, 4.0];
        let total = circulation(&lattice, &run.state, &mut run.ws, far, 1.25)?;
        rows.push(
            Row::new(
                format!("circulation about wing and wake over the wing's, {name} sheds"),
                "1",
                total / bound,
            )
            .against(0.0, "Kelvin's theorem")
            .within(
                1e-8,
                "Simpson's rule on 400 intervals, 4 chords from everything",
            ),
        );
    }
    Ok(rows)
}

/// Normal forces at the end of a heave: pressure (or segments), impulse.
fn heaving(k: usize, loads: LoadMethod) -> Result<[f64; 2], AirError> {
    let (rows, cols, steps) = (3 * k, 4 * k, 10 * k);
    // With next to no core close filaments of the rolled-up wake circle faster than the steps follow.
    let core = CoreModel::Scully { radius: 0.01 };
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        loads,
        ..AirSettings::accurate(1.2, DVec3::ZERO)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", rows, cols)], settings)?;
    let flat = rectangle(rows, cols, DVec3::X, 3.0 * DVec3::Y);
    let motion = |t: f64| -> NodeMotion {
        let path = DVec3::new(-t, 0.0, 0.2 * (1.0 - (2.0 * t).cos()));
        let velocity = DVec3::new(-1.0, 0.0, 0.4 * (2.0 * t).sin());
        translating(flat.iter().map(|x| *x + path).collect(), velocity)
    };
    let dt = 2.0 / steps as f64;
    let mut impulse = [DVec3::ZERO; 3];
    let run = fly(&lattice, motion, dt, steps, |_, state, _, ws| {
        let now = lattice.impulse(state, ws).unwrap_or(DVec3::NAN);
        impulse = [impulse[1], impulse[2], now];
    })?;
    let rate = (3.0 * impulse[2] - 4.0 * impulse[1] + impulse[0]) / (2.0 * dt);
    Ok([total_force(&run.loads).z, -rate.z])
}

fn impulse(quick: bool) -> Result<Vec<Row>, VerifyError> {
    let k = if quick { [1, 2, 4] } else { [2, 4, 8] };
    let mut rows = Vec::new();
    for (name, method) in [
        ("pressure", LoadMethod::Pressure),
        ("segments", LoadMethod::Joukowski),
    ] {
        let mut error = [0.0; 3];
        let mut last = [0.0; 2];
        for (k, e) in k.into_iter().zip(&mut error) {
            last = heaving(k, method)?;
            *e = last[0] / last[1] - 1.0;
        }
        rows.push(
            Row::new(
                format!("normal force from {name} over that from the impulse"),
                "1",
                last[0] / last[1],
            )
            .against(1.0, "force = - d(impulse)/dt in air at rest at infinity")
            .uncertain(error[2] - error[1])
            .within(
                if quick { 0.03 } else { 0.015 },
                "forces act at panels: first order in panels and steps",
            ),
        );
        rows.push(
            Row::new(
                format!("order of the disagreement, {name}"),
                "1",
                order(error[0], error[2]) / 2.0,
            )
            .because("halving panels and steps together; first order is expected"),
        );
    }
    Ok(rows)
}

/// Rate of decrease of the impulse [N], second order, from the third step on.
fn force_of(impulse: &[DVec3], dt: f64) -> Vec<DVec3> {
    let rate = |w: &[DVec3]| -(3.0 * w[2] - 4.0 * w[1] + w[0]) / (2.0 * dt);
    impulse.windows(3).map(rate).collect()
}

/// Forces by the method and by the impulse, step by step from the third on.
fn both_ways(
    lattice: &Lattice,
    motion: impl Fn(f64) -> NodeMotion,
    dt: f64,
    last: usize,
) -> Result<[Vec<DVec3>; 2], AirError> {
    let (mut force, mut impulse) = (Vec::new(), Vec::new());
    fly(lattice, motion, dt, last, |_, _, loads, _| {
        force.push(total_force(loads));
        impulse.push(loads.impulse);
    })?;
    Ok([force.split_off(2), force_of(&impulse, dt)])
}

/// Root mean square of the difference over the last `n` steps, relative to the second's.
fn apart([a, b]: &[Vec<DVec3>; 2], n: usize) -> f64 {
    let from = b.len() - n;
    let square = |x: &dyn Fn(usize) -> DVec3| -> f64 {
        (from..b.len()).map(|k| x(k).z.powi(2)).sum::<f64>()
    };
    (square(&|k| a[k] - b[k]) / square(&|k| b[k])).sqrt()
}

/// A wing of aspect ratio 6 that plunges by a tenth of its chord in a stream, over two periods.
fn plunging(k: usize, loads: LoadMethod) -> Result<f64, AirError> {
    let core = CoreModel::Scully { radius: 1e-7 };
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        loads,
        ..AirSettings::accurate(1.2, DVec3::X)
    };
    let (rows, cols, steps) = (2 * k, 6 * k, 12 * k);
    let lattice = Lattice::new(vec![Surface::grid("wing", rows, cols)], settings)?;
    let flat = rectangle(rows, cols, DVec3::X, 6.0 * DVec3::Y);
    let motion = |t: f64| {
        let path = 0.1 * (1.0 - t.cos()) * DVec3::Z;
        let nodes = flat.iter().map(|x| *x + path).collect();
        translating(nodes, 0.1 * t.sin() * DVec3::Z)
    };
    let dt = std::f64::consts::TAU / steps as f64;
    Ok(apart(&both_ways(&lattice, motion, dt, 2 * steps)?, steps))
}

fn impulse_force(quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = vec![plate()?, ball()?];
    let k = if quick { [1, 2] } else { [2, 4] };
    for (name, method) in [
        ("pressure", LoadMethod::Pressure),
        ("segments", LoadMethod::Joukowski),
    ] {
        let [coarse, fine] = [plunging(k[0], method)?, plunging(k[1], method)?];
        rows.push(
            Row::new(
                format!("plunging wing, {name}: rms difference from the impulse over a period"),
                "1",
                fine,
            )
            .against(
                0.0,
                "force = - d(impulse)/dt, unchanged by a uniform stream",
            )
            .uncertain(fine - coarse)
            .within(
                0.16 / k[1] as f64,
                "forces act at panels: first order in panels and steps",
            ),
        );
    }
    Ok(rows)
}

/// Without wake and sliding, pressure is rho dGamma/dt alone and the two ways are one sum.
fn plate() -> Result<Row, VerifyError> {
    let none = SheddingKinds {
        trailing: false,
        ..SheddingKinds::TRAILING
    };
    let settings = AirSettings {
        shedding: none,
        ..AirSettings::accurate(1.2, DVec3::ZERO)
    };
    let lattice = Lattice::new(vec![Surface::grid("plate", 4, 6)], settings)?;
    let flat = rectangle(4, 6, DVec3::X, 2.0 * DVec3::Y);
    let motion = |t: f64| {
        let nodes = flat.iter().map(|x| *x + t.powi(3) * DVec3::Z).collect();
        translating(nodes, 3.0 * t * t * DVec3::Z)
    };
    let ways = both_ways(&lattice, motion, 0.1, 6)?;
    Ok(Row::new(
        "accelerated plate: difference over the force",
        "1",
        apart(&ways, 3),
    )
    .against(0.0, "added mass either way")
    .within(1e-12, "roundings"))
}

/// A sphere that accelerates: the fictitious fluid inside is taken out of both.
fn ball() -> Result<Row, VerifyError> {
    let (nodes, quads) = crate::lab::sphere(4);
    let surface = Surface::closed("ball", nodes.len(), quads);
    let settings = AirSettings {
        rate: wingbeat_air::CirculationRate::BackwardSecond,
        ..AirSettings::benchmark(1.2, DVec3::ZERO).with_cut_off_for(0.01)
    };
    let lattice = Lattice::new(vec![surface], settings)?;
    let motion = |t: f64| {
        let at = nodes.iter().map(|x| *x + 0.5 * t * t * DVec3::Z);
        translating(at.collect(), t * DVec3::Z)
    };
    let ways = both_ways(&lattice, motion, 0.1, 5)?;
    Ok(Row::new(
        "accelerated sphere: difference over the force",
        "1",
        apart(&ways, 2),
    )
    .against(0.0, "added mass either way")
    .within(
        0.01,
        "a panel's area is that of its two triangles, as in the benchmark; a ring's impulse has its \
         vector area, less where four corners are not in one plane: second order, 0.003 here",
    ))
}
