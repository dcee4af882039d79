//! What counts as a narrow gap.

use super::*;
use crate::motion::{AngleLaw, Fourier, WingMotion};
use crate::{BodyPart, MassInput, Planform, Revolution, Side, WingShape};
use wingbeat_math::{DMat3, MassProperties, RotationLaw};

/// A rectangle of length 1 and chord 0.5, its axis at 0.2, with these panels along the chord.
fn wing(chordwise: usize) -> Wing {
    let planform = Planform::Outline {
        leading: vec![(0.0, 0.2), (1.0, 0.2)],
        trailing: vec![(0.0, -0.3), (1.0, -0.3)],
        least_chord: 0.1,
    };
    let shape = WingShape::uniform(planform, chordwise, 10);
    let motion = WingMotion::fixed(0.0, [0.0; 3]);
    let mass = MassInput::Total(0.1);
    Wing::new("wing", Side::Right, DVec3::ZERO, &shape, &mass, motion).unwrap()
}

fn animal(wings: Vec<Wing>, parts: Vec<BodyPart>) -> Animal {
    Animal {
        name: "gaps".into(),
        body: wings[0].mass,
        parts,
        wings,
        segments: vec![],
    }
}

/// What is found of wings with these panels along the chord whose hinges are here, with these attitudes.
fn found(wings: &[(usize, DVec3, DMat3)], planes: Vec<[DVec3; 2]>) -> Vec<NarrowGap> {
    let animal = animal(wings.iter().map(|w| wing(w.0)).collect(), vec![]);
    let mut gaps = NarrowGaps::new(&animal, false, planes);
    let body = Some((DVec3::ZERO, DMat3::IDENTITY));
    let wings = wings.iter().map(|w| Some((w.1, w.2)));
    let poses: Vec<_> = std::iter::once(body).chain(wings).collect();
    gaps.see(&poses, std::iter::empty(), |_| 0.0);
    gaps.found()
}

/// Two wings one over the other with panels of 0.1 and 0.05, the second moved by these lengths.
fn over(x: f64, z: f64) -> Vec<NarrowGap> {
    let one = (5, DVec3::ZERO, DMat3::IDENTITY);
    found(&[one, (10, DVec3::new(x, 0.0, z), DMat3::IDENTITY)], vec![])
}

/// Gaps are seen by each wing in its own panels, where they are narrower than half of these, and over a part of the area
/// that counts.
#[test]
fn exact_gaps_between_plates() {
    let [gap] = over(0.0, 0.03)[..] else {
        panic!("{:?}", over(0.0, 0.03))
    };
    assert_eq!((gap.wing, gap.faced, gap.time), (0, Faced::Wing(1), 1.0));
    let Narrowest { share, gap, panel } = gap.at;
    // Roundings.
    assert!((share - 1.0).abs() < 1e-12 && (gap - 0.03).abs() < 1e-12);
    assert!((panel - 0.1).abs() < 1e-12);
    assert_eq!(over(0.0, 0.02).len(), 2);
    assert_eq!(over(0.0, 0.051), []);
    for (x, share) in [(0.1, 0.8), (-0.3, 0.4), (0.4, 0.2), (0.47, 0.0), (0.6, 0.0)] {
        let found = over(x, -0.03);
        let part = found.first().map_or(0.0, |gap| gap.at.share);
        assert!((part - share).abs() < 1e-12, "{x}: {found:?}");
    }
}

/// Rows of vortices of strengths that grow along them make the normal velocity of a sheet, which is as pi h / p to the sum
/// of `h^2 / (d^2 + h^2)` over the distances d from half way between two of them, less the excess; of order p / (pi h) in
/// narrow gaps, none in wide ones.
#[test]
fn exact_excess_in_narrow_and_wide_gaps() {
    let excess = |gap: f64| {
        let at = Narrowest {
            share: 1.0,
            gap,
            panel: 0.1,
        };
        at.excess()
    };
    for gap in [0.01, 0.03, 0.1] {
        let place = |k: i32| 0.1 * (f64::from(k) + 0.5);
        let sum: f64 = (-100_000..100_000)
            .map(|k| gap * gap / (place(k).powi(2) + gap * gap))
            .sum();
        // What is left out of the sum: 2 h^2 / (p^2 100000).
        assert!(
            (PI * gap / 0.1 / sum - excess(gap)).abs() < 1e-4,
            "{gap}: {sum}"
        );
    }
    assert!((excess(1e-4) * PI * 1e-3 - 1.0).abs() < 1e-5); // (pi h / p)^2 / 3
    assert!((excess(0.05) - 1.0903).abs() < 1e-4);
    assert!((excess(0.2) - 1.0).abs() < 1e-5);
}

/// Wings that open about their leading edges, as wide at their trailing edges as 0.4, 1, 1.5 and 2.7 panels: images of
/// each other count up to 1.1, others up to 2.
#[test]
fn exact_part_of_a_wedge() {
    for (angle, of_image, of_other) in [
        (0.08, 1.0, 1.0),
        (0.2, 7.0 / 15.0, 7.0 / 15.0),
        (0.3, 0.0, 5.0 / 15.0),
        (0.5, 0.0, 0.0),
    ] {
        let turned = |by: f64| {
            let r = DMat3::from_rotation_y(by);
            (5, -0.2 * (r * DVec3::X), r)
        };
        let both = found(&[turned(0.5 * angle), turned(-0.5 * angle)], vec![]);
        let plane = vec![[DVec3::new(3.0, 1.0, 0.0), DVec3::Z]];
        let one = found(&[turned(0.5 * angle)], plane);
        let part = |found: &[NarrowGap]| found.first().map_or(0.0, |gap| gap.at.share);
        assert!((part(&both) - of_other).abs() < 1e-12, "{angle}: {both:?}");
        assert!((part(&one) - of_image).abs() < 1e-12, "{angle}: {one:?}");
        assert!(both.iter().all(|gap| !gap.is_aligned));
        assert!(
            one.iter()
                .all(|gap| gap.faced == Faced::Image(0) && gap.is_aligned)
        );
    }
}

/// Wings edge to edge, across each other or standing on a plane face nothing.
#[test]
fn behaves_wings_beside_each_other_face_nothing() {
    let flat = (5, DVec3::ZERO, DMat3::IDENTITY);
    let upright = |at: DVec3| (5, at, DMat3::from_rotation_x(0.5 * PI));
    for other in [
        (5, DVec3::new(-0.5, 0.0, 1e-3), DMat3::IDENTITY),
        (5, DVec3::new(-0.47, 0.0, 1e-3), DMat3::IDENTITY),
        (5, DVec3::new(0.0, 1.0, 0.0), DMat3::from_rotation_x(0.1)),
        upright(DVec3::new(0.0, 0.5, 0.0)),
    ] {
        assert_eq!(found(&[flat, other], vec![]), [], "{other:?}");
    }
    let ground = || vec![[DVec3::ZERO, DVec3::Z]];
    assert_eq!(found(&[upright(DVec3::ZERO)], ground()), []);
    assert_eq!(found(&[flat], vec![[0.04 * DVec3::Z, -DVec3::Z]]), []);
    assert_eq!(found(&[flat], vec![[0.02 * DVec3::Z, -DVec3::Z]]).len(), 1);
}

/// A wing that lies on a part of the body, and one whose root stands on it.
#[test]
fn behaves_wings_along_a_part_face_it() {
    let trunk = Revolution::ellipsoid(DVec3::ZERO, 4.0, 1.0, [24, 24]);
    let mass = MassInput::Given(MassProperties::point(0.1, DVec3::ZERO));
    let part = BodyPart::revolution("trunk", &trunk, &mass).unwrap();
    let animal = animal(vec![wing(2)], vec![part]);
    let faced = |at: DVec3| {
        let mut gaps = NarrowGaps::new(&animal, true, vec![]);
        let poses = [DVec3::ZERO, at].map(|at| Some((at, DMat3::IDENTITY)));
        gaps.see(&poses, std::iter::empty(), |_| 0.0);
        gaps.found()
    };
    let along = faced(DVec3::new(0.0, -0.5, -1.02));
    assert_eq!(along.len(), 1, "{along:?}");
    assert_eq!(along[0].faced, Faced::Part(0));
    assert_eq!(faced(DVec3::new(0.0, 1.0, 0.0)), []);
    assert_eq!(faced(DVec3::new(0.0, 0.8, -0.6)), []);
}

/// A wing that beats past another one is beside it for a part of the beat, and what was seen goes on.
#[test]
fn behaves_gaps_are_counted_over_the_beat() {
    let mut flapping = wing(2);
    let (mean, cos, sin) = (0.0, vec![], vec![1.0]);
    flapping.motion.angles.phi = AngleLaw::Fourier(Fourier { mean, cos, sin });
    flapping.motion.frequency = 7.0;
    let mut still = wing(2);
    still.hinge_b.z = 0.3;
    let animal = animal(vec![flapping, still], vec![]);
    let look = |stop: Option<usize>| {
        let mut gaps = NarrowGaps::new(&animal, false, vec![]);
        for (k, t) in instants_of_gaps(&animal).enumerate() {
            let pose = |w: &Wing| Some((w.hinge_b, w.motion.impulsive().at(t).c));
            let poses = [None, pose(&animal.wings[0]), pose(&animal.wings[1])];
            gaps.see(&poses, std::iter::empty(), |_| 0.0);
            if stop == Some(k) {
                let seen = gaps.seen().clone();
                gaps = NarrowGaps::new(&animal, false, vec![]);
                gaps.go_on(seen);
            }
        }
        gaps.found()
    };
    let found = look(None);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(
        found.iter().all(|gap| (0.1..0.5).contains(&gap.time)),
        "{found:?}"
    );
    assert_eq!(look(Some(30)), found);
}
