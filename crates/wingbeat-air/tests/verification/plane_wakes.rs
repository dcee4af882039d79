//! Plane flow: rows of wake that stay straight.

use crate::common::{fly, rectangle, translating};
use wingbeat_air::{AirSettings, AirState, Lattice, Plane, SheddingKinds, Surface};
use wingbeat_math::DVec3;

const SPAN: f64 = 50.0;

/// A unit stream along x beside a wall at the root, cores of 0.02 chords.
fn settings(plane_wakes: bool) -> AirSettings {
    AirSettings {
        plane_wakes,
        images: vec![Plane {
            point: DVec3::ZERO,
            normal: DVec3::Y,
        }],
        ..AirSettings::accurate(1.0, DVec3::X).with_cut_off_for(2.0)
    }
}

/// A plate of one panel along the span that plunges two beats at a Strouhal number of 0.6.
fn plunge(plane_wakes: bool) -> AirState {
    let flat = rectangle(6, 1, DVec3::X, SPAN * DVec3::Y);
    let lattice = Lattice::new(vec![Surface::grid("plate", 6, 1)], settings(plane_wakes)).unwrap();
    let (heave, omega) = (0.2, 3.0 * std::f64::consts::PI);
    let motion = |t: f64| {
        let at = heave * (omega * t).cos() * DVec3::Z;
        let velocity = -heave * omega * (omega * t).sin() * DVec3::Z;
        translating(flat.iter().map(|x| *x + at).collect(), velocity)
    };
    fly(&lattice, motion, 1.0 / 60.0, 80, |_, _, _, _| {})
        .unwrap()
        .state
}

/// How far the two ends of a row part at most across the span, and how far they leave their planes \[chords\].
fn parting(state: &AirState) -> [f64; 2] {
    let sheet = &state.sheets[0];
    let ends = (0..sheet.rows()).map(|r| [sheet.node(r, 0), sheet.node(r, 1)]);
    ends.fold([0.0, 0.0], |[apart, along], [a, b]| {
        let d = b - a;
        let off = [a, b].map(|x| x.y.abs().min((x.y - SPAN).abs()));
        [
            f64::max(apart, d.x.hypot(d.z)),
            off.into_iter().fold(along, f64::max),
        ]
    })
}

#[test]
fn invariant_rows_of_plane_wakes_stay_straight_and_across_the_flow() {
    let plane = parting(&plunge(true));
    assert!(plane.iter().all(|x| *x < 1e-11), "{plane:?}"); // roundings of 50 chords, 80 steps
    // Without it the wake moves half as fast at the free end of the plate as at the wall.
    let free = parting(&plunge(false));
    assert!(free[0] > 0.02, "{free:?}");
}

#[test]
fn refuses_plane_wakes_of_side_edges() {
    let shedding = SheddingKinds {
        tip: true,
        ..SheddingKinds::TRAILING
    };
    let wing = vec![Surface::grid("plate", 6, 1)];
    let settings = AirSettings {
        shedding,
        ..settings(true)
    };
    let error = Lattice::new(wing, settings).unwrap_err().to_string();
    assert!(error.contains("plane_wakes"), "{error}");
}
