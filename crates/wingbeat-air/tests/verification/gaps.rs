//! Gaps narrower than the panels: how far forces of air that is taken in between surfaces are off.

use crate::common::{fly, rectangle};
use wingbeat_air::{AirSettings, Lattice, NodeMotion, Plane, SheddingKinds, Surface};
use wingbeat_math::DVec3;

/// Force of the first step across a plate of chord 1 and this `span` with `rows` panels along the chord that leaves its
/// image in a plane with velocities `velocity` of its nodes.
fn force(rows: usize, [corner, chord, span]: [DVec3; 3], velocity: fn(DVec3) -> DVec3) -> f64 {
    let settings = AirSettings {
        shedding: SheddingKinds::TRAILING,
        images: vec![Plane {
            normal: DVec3::Z,
            point: DVec3::ZERO,
        }],
        ..AirSettings::accurate(1.0, DVec3::ZERO)
    };
    let lattice = Lattice::new(vec![Surface::grid("plate", rows, 10)], settings).unwrap();
    let nodes: Vec<DVec3> = (rectangle(rows, 10, chord, span).into_iter())
        .map(|x| corner + x)
        .collect();
    let motion = |t: f64| NodeMotion {
        position: nodes.iter().map(|x| *x + t * velocity(*x)).collect(),
        velocity: nodes
            .iter()
            .map(|x| velocity(*x).min(DVec3::splat(1e9 * t)))
            .collect(),
    };
    let run = fly(&lattice, motion, 1e-6, 1, |_, _, _, _| {}).unwrap();
    run.loads.surfaces[0].force.length()
}

/// A wedge that opens about its leading edge, by this half angle \[deg\].
fn wedge(rows: usize, half: f64) -> f64 {
    let (s, c) = half.to_radians().sin_cos();
    let sides = [DVec3::ZERO, DVec3::new(c, 0.0, s), 2.5 * DVec3::Y];
    force(rows, sides, |x| DVec3::new(-x.z, 0.0, x.x))
}

/// A plate at this distance from its image.
fn lifted(rows: usize, gap: f64) -> f64 {
    let sides = [0.5 * gap * DVec3::Z, DVec3::X, 2.5 * DVec3::Y];
    force(rows, sides, |_| DVec3::Z)
}

/// Wedges that are 0.28 and 0.56 panels wide at their open ends have 80 % and a seventh too much force, those of 1.1 and
/// 2.2 within 5 %; plates at 0.2 and 0.4 panels from their images twice and a tenth too much, at 0.8 within 8 %.
#[test]
fn agrees_forces_of_gaps_with_those_on_finer_panels() {
    let wedges = [4, 8, 16, 32].map(|rows| wedge(rows, 2.0));
    let plates = [4, 8, 16, 48].map(|rows| lifted(rows, 0.05));
    let ratios = |all: [f64; 4]| [0, 1, 2].map(|k| all[k] / all[3]);
    for (found, expected) in [
        (ratios(wedges), [1.787, 1.147, 0.964]),
        (ratios(plates), [1.968, 1.101, 0.923]),
    ] {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 5e-3, "{found} {expected}"); // last digits
        }
    }
}
