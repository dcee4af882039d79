//! What may not change the answer: place, direction, handedness, the observer, threads.

use crate::lab::{Run, fly, rectangle, total_force};
use crate::{Case, Part, Row, VerifyError};
use wingbeat_air::{AirError, AirSettings, Lattice, NodeMotion, Plane, SheddingKinds, Surface};
use wingbeat_math::{DMat3, DVec3, r1, r2, r3};

pub(super) const CASES: &[Case] = &[Case {
    name: "invariance",
    about: "Two flapping wings, all edges shedding, eight steps: turned, seen by a moving observer, \
            mirrored, over a ground, on other numbers of threads.",
    part: Part::Analytic,
    quick: true,
    run,
}];

const STREAM: DVec3 = DVec3::new(2.0, 0.0, 0.3);
const STEPS: usize = 8;

/// One wing on the given side flapping about the x axis, z up.
fn wing(side: f64, t: f64, motion: &mut NodeMotion) {
    let (angle, rate) = (0.5 * (3.0 * t).cos(), -1.5 * (3.0 * t).sin());
    let turn = r1(side * angle) * r2(0.1);
    for x in rectangle(3, 4, DVec3::X, side * 2.0 * DVec3::Y) {
        let x = turn * x + side * 0.1 * DVec3::Y;
        motion.position.push(x);
        motion.velocity.push(side * rate * DVec3::X.cross(x));
    }
}

fn wings(sides: &[f64], t: f64) -> NodeMotion {
    let mut motion = NodeMotion::default();
    sides.iter().for_each(|&s| wing(s, t, &mut motion));
    motion
}

fn lattice(count: usize, stream: DVec3, images: Vec<Plane>) -> Result<Lattice, AirError> {
    let surfaces = (0..count)
        .map(|k| Surface::grid(&format!("wing {k}"), 3, 4))
        .collect();
    let shedding = SheddingKinds {
        trailing: true,
        tip: true,
        leading: true,
        root: false,
    };
    let settings = AirSettings {
        shedding,
        images,
        ..AirSettings::accurate(1.2, stream)
    };
    Lattice::new(surfaces, settings)
}

fn flight(lattice: &Lattice, motion: impl Fn(f64) -> NodeMotion) -> Result<Run, AirError> {
    fly(lattice, motion, 0.1, STEPS, |_, _, _, _| {})
}

fn turned(motion: NodeMotion, r: DMat3, shift: DVec3, velocity: DVec3) -> NodeMotion {
    NodeMotion {
        position: motion.position.iter().map(|x| r * *x + shift).collect(),
        velocity: motion.velocity.iter().map(|v| r * *v + velocity).collect(),
    }
}

const BOTH: &[f64] = &[1.0, -1.0];
const ROUNDING: &str = "roundings, amplified by eight steps of a free wake near its own filaments";

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let plain = flight(&lattice(2, STREAM, vec![])?, |t| wings(BOTH, t))?;
    let force = total_force(&plain.loads);
    let r = r1(0.7) * r3(-1.2) * r2(2.0);
    let rotated = flight(&lattice(2, r * STREAM, vec![])?, |t| {
        turned(wings(BOTH, t), r, DVec3::new(3.0, -2.0, 5.0), DVec3::ZERO)
    })?;
    let u = DVec3::new(0.5, -1.5, 0.8);
    let observed = flight(&lattice(2, STREAM + u, vec![])?, |t| {
        turned(wings(BOTH, t), DMat3::IDENTITY, t * u, u)
    })?;
    let zero = |what: &str, x: f64, source| {
        Row::new(what, "1", x / force.length())
            .against(0.0, source)
            .within(1e-9, ROUNDING)
    };
    Ok(vec![
        zero(
            "force, everything turned",
            (r * force - total_force(&rotated.loads)).length(),
            "rotation",
        ),
        zero(
            "force, moving observer",
            (force - total_force(&observed.loads)).length(),
            "Galileo",
        ),
        mirror_bits()?,
        mirror_plane(&plain)?,
        ground()?,
        threads()?,
    ])
}

/// A right wing alone and its mirror image alone: nothing may differ but the sign of y.
fn mirror_bits() -> Result<Row, VerifyError> {
    let alone = lattice(1, STREAM, vec![])?;
    let [right, left] = [
        flight(&alone, |t| wings(&[1.0], t))?,
        flight(&alone, |t| wings(&[-1.0], t))?,
    ];
    let flip = DVec3::new(1.0, -1.0, 1.0);
    let pairs = right.loads.force.iter().zip(&left.loads.force);
    let differ = pairs.filter(|(a, b)| **a * flip != **b).count();
    Ok(Row::new(
        "panels whose force differs in a bit from its mirror image",
        "1",
        differ as f64,
    )
    .against(0.0, "mirror symmetry")
    .within(0.0, "bit for bit"))
}

/// One wing and a plane of symmetry against two wings.
fn mirror_plane(two: &Run) -> Result<Row, VerifyError> {
    let plane = Plane {
        point: DVec3::ZERO,
        normal: DVec3::Y,
    };
    let half = flight(&lattice(1, STREAM, vec![plane])?, |t| wings(&[1.0], t))?;
    let [a, b] = [half.loads.surfaces[0].force, two.loads.surfaces[0].force];
    Ok(Row::new(
        "force with a plane of symmetry against two wings",
        "1",
        (a - b).length() / b.length(),
    )
    .against(0.0, "mirror symmetry")
    .within(1e-9, ROUNDING))
}

/// A wing over a ground against the wing and its image flown together.
fn ground() -> Result<Row, VerifyError> {
    let plane = Plane {
        point: -2.0 * DVec3::Z,
        normal: DVec3::Z,
    };
    let stream = 2.0 * DVec3::X;
    let over = flight(&lattice(1, stream, vec![plane])?, |t| wings(&[1.0], t))?;
    let both = flight(&lattice(2, stream, vec![])?, |t| {
        let mut motion = wings(&[1.0], t);
        for k in 0..motion.position.len() {
            let (x, v) = (motion.position[k], motion.velocity[k]);
            motion.position.push(DVec3::new(x.x, x.y, -4.0 - x.z));
            motion.velocity.push(DVec3::new(v.x, v.y, -v.z));
        }
        motion
    })?;
    let [a, b] = [over.loads.surfaces[0].force, both.loads.surfaces[0].force];
    Ok(Row::new(
        "force over a ground against wing and image flown together",
        "1",
        (a - b).length() / b.length(),
    )
    .against(0.0, "method of images")
    .within(1e-9, ROUNDING))
}

fn threads() -> Result<Row, VerifyError> {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let lattice = lattice(2, STREAM, vec![])?;
        let flown = pool
            .expect("a few threads")
            .install(|| flight(&lattice, |t| wings(BOTH, t)));
        flown.map(|r| r.loads.force)
    };
    let (one, three) = (on(1)?, on(3)?);
    let differ = one.iter().zip(&three).filter(|(a, b)| a != b).count();
    Ok(Row::new(
        "panels whose force differs in a bit between one and three threads",
        "1",
        differ as f64,
    )
    .against(0.0, "same case, same bits")
    .within(0.0, "bit for bit"))
}
