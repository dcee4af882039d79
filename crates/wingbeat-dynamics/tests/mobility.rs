//! How readily joints give way, against closed forms.

use crate::common;

use common::body;
use common::mechanism::SI;
use wingbeat_dynamics::*;
use wingbeat_math::{DMat3, DVec3, EulerSequence, MassProperties};

/// Two bodies of these masses \[kg\] and moments of inertia about axis 3 \[kg m2\], frames at their centres, joined at
/// these points \[m\] of theirs.
fn pair(masses: [f64; 2], inertias: [f64; 2], anchors: [DVec3; 2], kind: JointType) -> System {
    let one = |k: usize| {
        let inertia = DMat3::from_diagonal(inertias[k] * DVec3::new(0.7, 0.8, 1.0));
        let mass = MassProperties::about_centre(masses[k], DVec3::ZERO, inertia);
        body(["root", "child"][k], mass, EulerSequence::BODY_231)
    };
    let joint = Joint::new("joint", Some(0), 1, kind).at(anchors[0], anchors[1]);
    System::new(vec![one(0), one(1)], vec![joint], DVec3::ZERO, SI).unwrap()
}

/// The only mobility of a pair that moves and turns.
fn mobility(system: System) -> f64 {
    let form = QuaternionForm::new(system, Stabilization::None);
    let root = BodyMotion {
        v: DVec3::new(0.3, -0.2, 0.1),
        w: DVec3::new(0.0, 0.0, 0.8),
        ..BodyMotion::REST
    };
    let y = form.initial(0.0, &root).unwrap();
    mobilities(&form, (0.0, &y), &[(0, 0)]).unwrap()[0][0]
}

/// Turning in their plane, two free bodies have the matrix of masses of their reduced mass at both arms.
#[test]
fn exact_mobility_of_a_hinge_between_free_bodies() {
    let (masses, inertias) = ([2.0, 0.5], [0.3, 0.04]);
    let arms = [DVec3::new(0.2, 0.1, 0.0), DVec3::new(-0.3, 0.25, 0.0)];
    let kind = JointType::Revolute { axis: DVec3::Z };
    let found = mobility(pair(masses, inertias, arms, kind));
    let reduced = masses[0] * masses[1] / (masses[0] + masses[1]);
    let own = [0, 1].map(|k| inertias[k] + reduced * arms[k].length_squared());
    let both = -reduced * arms[0].dot(arms[1]);
    let expected = (own[0] + own[1] + 2.0 * both) / (own[0] * own[1] - both * both);
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    // At the centres of both.
    let found = mobility(pair(masses, inertias, [DVec3::ZERO; 2], kind));
    let expected = inertias.iter().map(|j| 1.0 / j).sum::<f64>();
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
}

#[test]
fn exact_mobility_of_a_slide_through_the_centres_of_free_bodies() {
    let (masses, arms) = ([2.0, 0.5], [DVec3::new(0.4, 0.0, 0.0), DVec3::ZERO]);
    let kind = JointType::Prismatic { axis: DVec3::X };
    let found = mobility(pair(masses, [0.3, 0.04], arms, kind));
    let expected = masses.iter().map(|m| 1.0 / m).sum::<f64>();
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
}

/// A root whose mass is without end is held.
#[test]
fn limit_mobility_on_a_heavy_root_is_that_of_a_pendulum() {
    let arm = DVec3::new(-0.3, 0.25, 0.0);
    let kind = JointType::Revolute { axis: DVec3::Z };
    let found = mobility(pair([1e9, 0.5], [1e9, 0.04], [DVec3::ZERO, arm], kind));
    let expected = 1.0 / (0.04 + 0.5 * arm.length_squared());
    assert!((found / expected - 1.0).abs() < 1e-8, "{found} {expected}");
}

/// Two links in line on a held root: the inverse of their matrix of masses in the angles between them.
#[test]
fn exact_mobilities_of_a_double_pendulum() {
    let (mass, length, own) = (0.5, 0.3, 0.04);
    let link = |name: &str| {
        let inertia = DMat3::from_diagonal(own * DVec3::new(0.7, 0.8, 1.0));
        let mass = MassProperties::about_centre(mass, DVec3::ZERO, inertia);
        body(name, mass, EulerSequence::BODY_231)
    };
    let heavy = MassProperties::about_centre(1e9, DVec3::ZERO, 1e9 * DMat3::IDENTITY);
    let bodies = vec![
        body("root", heavy, EulerSequence::BODY_231),
        link("inner"),
        link("outer"),
    ];
    let kind = || JointType::Revolute { axis: DVec3::Z };
    // The inner link turns about the root and carries the outer one at its centre; both centres lie `length`
    // from the joints farther in.
    let arm = DVec3::new(-length, 0.0, 0.0);
    let joints = vec![
        Joint::new("inner", Some(0), 1, kind()).at(DVec3::ZERO, arm),
        Joint::new("outer", Some(1), 2, kind()).at(DVec3::ZERO, arm),
    ];
    let form = QuaternionForm::new(
        System::new(bodies, joints, DVec3::ZERO, SI).unwrap(),
        Stabilization::None,
    );
    let y = form.initial(0.0, &BodyMotion::REST).unwrap();
    let found = mobilities(&form, (0.0, &y), &[(0, 0), (1, 0)]).unwrap();
    // Kinetic energy of x1 = l a, x2 = l a + l (a + b): mass matrix in the angles a, b between links, in line.
    let one = mass * length * length;
    let [[p, q], [_, r]] = [[5.0 * one + 2.0 * own, 2.0 * one + own], [0.0, one + own]];
    let det = p * r - q * q;
    let expected = [[r / det, -q / det], [-q / det, p / det]];
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let ratio = found[i][j] / expected[i][j];
        // A root of a thousand million times the mass is held to as much.
        assert!((ratio - 1.0).abs() < 1e-7, "{i} {j}: {ratio}");
    }
}
