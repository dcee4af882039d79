//! Loops that a law drives, against the closed form of the slider-crank.

use std::f64::consts::TAU;
use std::sync::Arc;

use wingbeat_dynamics::{
    Body, Configuration, DynamicsError, Joint, JointModel, JointType, NaturalUnits, System,
    TravelLaw, driven,
};
use wingbeat_math::{DMat3, DVec3, EulerSequence, MassProperties, MovingRotation, RotationLaw};

/// Crank and rod [m].
const CRANK: f64 = 0.3;
const ROD: f64 = 1.0;

/// The crank's angle [rad] with two rates: it goes round once a second, unevenly.
fn angle(t: f64) -> [f64; 3] {
    let (s, c) = (TAU * t).sin_cos();
    [
        TAU * t + 0.2 * s,
        TAU * (1.0 + 0.2 * c),
        -0.2 * TAU * TAU * s,
    ]
}

#[derive(Debug)]
struct Turning;

impl RotationLaw for Turning {
    fn at(&self, t: f64) -> MovingRotation {
        MovingRotation::about(1, angle(t))
    }
}

/// To and fro over the whole way of the slider, from its middle.
#[derive(Debug)]
struct Pushed;

impl TravelLaw for Pushed {
    fn at(&self, t: f64) -> [DVec3; 3] {
        let (s, c) = (TAU * t).sin_cos();
        [s, TAU * c, -TAU * TAU * s].map(|x| CRANK * x * DVec3::X)
    }
}

/// What moves the mechanism.
#[derive(Clone, Copy, PartialEq)]
enum Mover {
    Crank,
    Slider,
    Nothing,
}

/// A ground with crank, rod on the crank and slider along axis 1; the rod ends in the slider.
fn slider_crank(mover: Mover) -> System {
    let body = |name: &str| Body {
        name: name.into(),
        mass: MassProperties::about_centre(1.0, DVec3::ZERO, DMat3::IDENTITY),
        sequence: EulerSequence::BODY_231,
    };
    let bodies = ["ground", "crank", "rod", "slider"].map(body).to_vec();
    let hinge = |name: &str, [parent, child]: [usize; 2], at: f64, freedom: JointType| {
        Joint::new(name, Some(parent), child, freedom).at(at * DVec3::X, DVec3::ZERO)
    };
    let turning = JointType::Revolute { axis: DVec3::Y };
    let mut hinges = vec![
        hinge("crank", [0, 1], 0.0, turning),
        hinge("rod", [1, 2], CRANK, turning),
        hinge(
            "slider",
            [0, 3],
            ROD,
            JointType::Prismatic { axis: DVec3::X },
        ),
    ];
    hinges[2].model.coordinates = vec![CRANK];
    if mover == Mover::Crank {
        hinges[0].law = Some(Arc::new(Turning));
        hinges[0].model = JointModel::new(JointType::Weld);
    }
    if mover == Mover::Slider {
        hinges[2].model = JointModel::new(JointType::Weld);
        hinges[2].model.travel = Some(Arc::new(Pushed));
        hinges[0].model.coordinates = vec![1.42];
        hinges[1].model.coordinates = vec![-1.72];
    }
    let units = NaturalUnits {
        length: 1.0,
        time: 1.0,
    };
    let system = System::new(bodies, hinges, DVec3::ZERO, units).unwrap();
    let freedom = JointType::PointOnLine { axis: DVec3::Y };
    let end = Joint::new("end", Some(2), 3, freedom).at(ROD * DVec3::X, DVec3::ZERO);
    system.with_loops(vec![end]).unwrap()
}

/// The slider is at `x = r cos a + sqrt(l^2 - r^2 sin^2 a)`, its rates follow by the chain rule.
fn slider(t: f64) -> [f64; 3] {
    let [a, w, w_dot] = angle(t);
    let (s, c) = a.sin_cos();
    let (r2, root) = (CRANK * CRANK, (ROD * ROD - CRANK * CRANK * s * s).sqrt());
    let by_angle = -CRANK * s - r2 * s * c / root;
    let twice = -CRANK * c - r2 * (c * c - s * s) / root - (r2 * s * c).powi(2) / root.powi(3);
    [
        CRANK * c + root,
        by_angle * w,
        twice * w * w + by_angle * w_dot,
    ]
}

#[test]
fn exact_slider_crank_goes_round() {
    let (step, count) = (0.05, 20);
    let tree = driven(slider_crank(Mover::Crank), step, count).unwrap();
    assert!(tree.loops().is_empty() && tree.coordinates() == 0);
    let mut configuration = Configuration::new(&tree);
    for k in 0..=count {
        let t = k as f64 * step;
        configuration.update(&tree, t);
        let at = configuration.placements()[3];
        let found = [at.d, at.d_dot, at.d_ddot];
        for (i, (found, exact)) in found.iter().zip(slider(t)).enumerate() {
            // Roundings of Newton's closing, times the square of the frequency for accelerations.
            let bound = 1e-13 * TAU.powi(i as i32 + 1);
            let gap = (*found - exact * DVec3::X).length();
            assert!(gap < bound, "t = {t}, derivative {i}: {gap:.1e}");
        }
        // The rod ends there: sine of its angle to axis 1.
        let rod = &configuration.placements()[2];
        assert!((rod.c.x_axis.z - CRANK * angle(t)[0].sin() / ROD).abs() < 1e-13);
    }
}

#[test]
fn refuses_loops_that_may_go_on_in_several_ways_or_are_loose() {
    // Pushed at the slider, the crank may pass its dead centre to either side.
    let refused = |mover| driven(slider_crank(mover), 0.01, 100).expect_err("refused");
    let error = refused(Mover::Slider);
    assert!(
        matches!(&error, DynamicsError::SingularPosition { joints, .. } if joints == "`end`"),
        "{error}"
    );
    let error = refused(Mover::Nothing);
    assert!(
        matches!(&error, DynamicsError::LooseLoop { joint, free: 1 } if joint == "end"),
        "{error}"
    );
}
