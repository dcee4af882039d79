//! Where a flyer faces, at any pitch of its body axes and any heading.

use std::sync::Arc;

use crate::common::*;

use wingbeat_analysis::control::{
    Design, LawDesign, Limits, Reference, Route, Target, Timing, Weights,
};
use wingbeat_analysis::*;
use wingbeat_flight::{
    Aim, AirModel, ControlModel, Feedback, FlightSetup, MotionMode, Simulation, TimeGrid,
};
use wingbeat_math::{DMat3, DVec3, EulerSequence};

const STEPS: usize = 40;

/// The hawkmoth in body axes that are pitched up by `more` \[rad\] in it: the same flyer.
fn in_axes_pitched_by(more: f64) -> FlightSetup {
    let mut setup = moth();
    let back = DMat3::from_rotation_y(more).transpose();
    let body = &mut setup.animal.body;
    body.first_moment = back * body.first_moment;
    body.inertia = back * body.inertia * back.transpose();
    for wing in &mut setup.animal.wings {
        wing.hinge_b = back * wing.hinge_b;
        wing.motion.stroke_plane_pitch -= more;
    }
    if let MotionMode::Free(start) = &mut setup.mode {
        start.angles.x += more;
    }
    setup
}

/// The same in steady flight forward.
fn trimmed(more: f64) -> Trim {
    let mut problem = hover(STEPS);
    problem.velocity = DVec3::new(1.0, 0.0, 0.0);
    problem.body_pitch = 45_f64.to_radians() + more;
    let found = trim(&in_axes_pitched_by(more), &problem).expect("a trim");
    assert!(found.solution.converged, "{:?}", found.solution.residual);
    found
}

/// Derivatives, modes and control derivatives of a trimmed flight.
fn numbers(found: &Trim) -> [Vec<f64>; 3] {
    let model = linear_model(&found.beat, &found.state).expect("a model");
    let controls = trimmed_controls(found).expect("control derivatives");
    let controls = controls.iter().flat_map(|c| {
        let (force, moment) = (c.derivative.force, c.derivative.moment);
        [force.to_array(), moment.to_array()].concat()
    });
    let modes = floquet(&found.beat, &found.state).expect("modes");
    let exponents = modes.modes.iter().flat_map(|m| [m.growth, m.frequency]);
    [model.matrix, controls.collect(), exponents.collect()]
}

/// Which way of the body is called b1 says nothing of the flight: pitch of 60 to 120 degrees, nose up and beyond.
#[test]
fn invariant_flight_with_body_axes_of_any_pitch() {
    let usual = trimmed(0.0);
    let pitch = usual.solution.body_pitch;
    let expected = numbers(&usual);
    for degrees in [60.0, 85.0, 90.0, 95.0, 120.0_f64] {
        let found = trimmed(degrees.to_radians() - pitch);
        assert!((found.solution.body_pitch.to_degrees() - degrees).abs() < 1e-6);
        for (of, (a, b)) in expected.iter().zip(numbers(&found)).enumerate() {
            let largest = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let apart = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
            let apart = apart.fold(0.0, f64::max) / largest;
            // Rounding over steps of 1e-4 of the differences: 1e-12, in the map of a wingbeat 1e-11.
            assert!(
                a.len() == b.len() && apart < 1e-10,
                "{degrees}, {of}: {apart:.1e}"
            );
        }
        let aim = Aim {
            heading: 1.0,
            ..Aim::default()
        };
        let reference = Reference::trimmed(&found).expect("a reference");
        let heading = reference.aim(&aim, 0.0, DVec3::ZERO).heading;
        assert!((heading - 1.0).abs() < 1e-12, "{degrees}: {heading}");
    }
}

/// Places of the mass centre after each wingbeat, in axes that are turned by `heading` \[rad\], of the fruit fly in a
/// stream of `wind` [m/s] towards its nose, held as it begins, pushed forward; it and all around it turned by `heading`.
/// None where no controller is laid out.
fn held(heading: f64, wind: DVec3) -> Option<Vec<DVec3>> {
    const BEATS: usize = 12;
    let turn = DMat3::from_rotation_z(heading);
    let mut plain = fly();
    let AirModel::BladeElement(air) = &mut plain.air else {
        unreachable!("it flies in blade elements")
    };
    // Trimmed without what blows across.
    air.blade.free_stream = DVec3::new(wind.x, 0.0, 0.0);
    let mut setup = trim(&plain, &hover(STEPS)).expect("a trim").free();
    let MotionMode::Free(start) = &mut setup.mode else {
        unreachable!("it is free")
    };
    start.position = turn * start.position;
    start.velocity = turn * (start.velocity + DVec3::new(0.05, 0.02, 0.0));
    start.angles = EulerSequence::BODY_231.angles(turn * start.rotation());
    let AirModel::BladeElement(air) = &mut setup.air else {
        unreachable!("it flies in blade elements")
    };
    air.blade.free_stream = turn * wind;
    let period = setup.time.period.expect("wingbeats");
    setup.time = TimeGrid {
        step: period / STEPS as f64,
        steps: BEATS * STEPS,
        period: Some(period),
    };
    let design = Design {
        buoyancy: vec![],
        law: LawDesign::Regulator(Weights::default()),
        target: Target::Begun,
        air: air.clone(),
        velocity: DVec3::new(0.1, 0.0, 0.0),
        timing: Timing {
            parts: 1,
            latency: 1,
            lag: 0.0,
        },
        every: 1,
        limits: Limits::default(),
        sensors: None,
        observer: None,
        route: Route::default(),
    };
    let ahead = turn.transpose() * ControlModel::velocity(&design, &setup).expect("a velocity");
    assert!((ahead - design.velocity).length() < 1e-15, "{ahead}");
    setup.feedback = Some(Feedback {
        controller: Arc::new(design),
        interval: STEPS,
        latency: 1,
        lag: 0.0,
    });
    let length = setup.animal.wing_length();
    let mut flight = Simulation::new(setup).ok()?;
    let mut places = vec![];
    while !flight.finished() {
        for _ in 0..STEPS {
            flight.step().expect("it flies");
        }
        places.push(turn.transpose() * flight.record().mass_centre / length);
    }
    Some(places)
}

/// Gains are laid out in the wind as the flyer meets it: a flight that is turned with everything around it is the same.
#[test]
fn invariant_flight_held_as_it_begins_in_any_heading() {
    for wind in [-0.4, 0.4] {
        let wind = DVec3::new(wind, 0.0, 0.0);
        let expected = held(0.0, wind).expect("a flight");
        for degrees in [73.0, 180.0, -90.0_f64] {
            let found = held(degrees.to_radians(), wind).expect("a flight");
            for (a, b) in expected.iter().zip(&found) {
                // Rounding, which grows over twelve wingbeats of a flyer that strays by a wing length.
                let apart = (*a - *b).length();
                assert!(apart < 1e-11, "{wind}, {degrees}: {apart:.1e}");
            }
        }
    }
    // What blows across parts right from left, in any heading.
    let across = DVec3::new(0.0, 0.4, 0.0);
    assert!([0.0, 1.3].iter().all(|h| held(*h, across).is_none()));
}
