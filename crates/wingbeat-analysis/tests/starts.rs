//! Smooth starts of the strokes: what they delay, and that analyses and controllers know of it.

use crate::common;

use std::sync::Arc;

use common::{fly, hover, moth, smooth};
use wingbeat_analysis::control::{
    Design, LawDesign, Limits, Route, Stiffness, Target, Timing, Weights,
};
use wingbeat_analysis::{Beat, Trim, floquet_of_trim, linear_model, power_of_trim, trim};
use wingbeat_dynamics::{Joint, JointType};
use wingbeat_flight::joints::AxisTurn;
use wingbeat_flight::*;
use wingbeat_math::{DMat3, DVec3, DriftingFourier, MassProperties};
use wingbeat_model::deformation::{SpanLaw, Term};
use wingbeat_model::motion::Fourier;
use wingbeat_model::{Deformation, Segment, Start};

/// Smooth over this many wingbeats.
fn started(mut setup: FlightSetup, beats: f64) -> FlightSetup {
    for wing in &mut setup.animal.wings {
        wing.motion.start = match beats {
            0.0 => Start::Impulsive,
            _ => Start::Smooth {
                duration: beats / wing.motion.frequency,
            },
        };
    }
    setup
}

/// Growth rates of the modes, sorted \[1/s\]: they do not depend on where the beat begins.
fn growths(found: &Trim) -> Vec<f64> {
    let modes = floquet_of_trim(found).expect("its modes").modes;
    let mut rates: Vec<f64> = modes.iter().map(|m| m.growth).collect();
    rates.sort_by(f64::total_cmp);
    rates
}

fn close(a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        let apart = (a - b).abs();
        assert!(apart <= tolerance * (1.0 + b.abs()), "{a} and {b}");
    }
}

/// Analyses know the periodic beat alone: however wings whose deformation is prescribed start, trim, modes and
/// power are the same.
#[test]
fn invariant_deforming_wings_are_trimmed_alike_however_they_start() {
    let mut setup = fly();
    for wing in &mut setup.animal.wings {
        let twist = Term {
            span: SpanLaw::Linear {
                root: 0.0,
                tip: 15_f64.to_radians(),
            },
            time: Fourier {
                mean: 0.0,
                cos: vec![-1.0],
                sin: vec![0.3],
            },
        };
        let deformation = Deformation {
            twist: vec![twist],
            ..Deformation::default()
        };
        *wing = wing.clone().deformed_by(deformation).expect("a twist");
    }
    let of = |beats: f64| {
        let found = trim(&started(setup.clone(), beats), &hover(40)).expect("a trim");
        assert!(found.solution.converged, "{}", found.solution.error());
        let model = linear_model(&found.beat, &found.state).expect("a model");
        let power = power_of_trim(&found).expect("its power");
        let powers = [power.aerodynamic, power.no_storage, power.peak];
        let (matrix, growths) = (&model.matrix, &growths(&found));
        [
            &found.solution.values,
            &found.state,
            matrix,
            growths,
            &powers[..],
        ]
        .concat()
    };
    let impulsive = of(0.0);
    for beats in [0.7, 1.0, 2.0] {
        assert_eq!(of(beats), impulsive, "a start over {beats} wingbeats");
    }
}

/// The fly whose abdomen nods with its wings, by a sine of this amplitude \[rad\] and phase \[wingbeats\].
fn nodding(amplitude: f64, phase: f64) -> FlightSetup {
    let mut setup = fly();
    let wings = setup.animal.wings.len();
    let (mass, place) = (0.38e-6, DVec3::new(-0.5e-3, 0.0, 0.1e-3));
    let mut abdomen = MassProperties::point(mass, place);
    abdomen.inertia += DMat3::IDENTITY * (mass * 1e-7);
    setup.animal.segments.push(Segment {
        name: "abdomen".into(),
        origin_b: DVec3::ZERO,
        mass: abdomen,
        parts: vec![],
    });
    let (sin, cos) = (std::f64::consts::TAU * phase).sin_cos();
    let frequency = setup.animal.wings[0].motion.frequency;
    let angle = DriftingFourier::periodic(0.0, frequency, [sin, cos].map(|x| vec![amplitude * x]));
    setup.joints.push(Joint {
        law: Some(Arc::new(AxisTurn {
            axis: DVec3::Y,
            angle,
        })),
        ..Joint::new("waist", Some(0), wings + 1, JointType::Weld)
    });
    setup
}

/// A smooth start delays the wings and not the abdomen: what is trimmed is the flight that is flown, in which
/// the abdomen is ahead by half of the rise. It is the impulsive flight whose abdomen has that phase, up to
/// where the beat begins.
#[test]
fn agrees_trim_of_a_nodding_abdomen_with_the_phase_that_a_smooth_start_leaves() {
    let found = |setup: FlightSetup| {
        let found = trim(&setup, &hover(60)).expect("a trim");
        assert!(found.solution.converged, "{}", found.solution.error());
        found
    };
    let amplitude = 10_f64.to_radians();
    for beats in [1.0, 0.5] {
        let smooth = found(started(nodding(amplitude, 0.0), beats));
        let ahead = found(started(nodding(amplitude, 0.5 * beats), 0.0));
        let other = found(started(nodding(amplitude, 0.0), 0.0));
        let strokes = |t: &Trim| {
            [
                t.solution.adjustment.stroke_amplitude,
                t.solution.adjustment.stroke_offset,
            ]
        };
        // The steps of the beats lie on the same instants: what differs is where Newton's method ends.
        close(&strokes(&smooth), &strokes(&ahead), 1e-7);
        close(&growths(&smooth), &growths(&ahead), 1e-5);
        let apart = strokes(&smooth)[1] - strokes(&other)[1];
        assert!(apart.abs() > 1e-3, "the phase matters: {apart}");
    }
    let whole = found(started(nodding(amplitude, 0.0), 2.0));
    let impulsive = found(started(nodding(amplitude, 0.0), 0.0));
    close(&whole.state, &impulsive.state, 1e-9);
}

/// The beat that is analysed is that of the flight: all joints turn as they do whole wingbeats after the rise.
#[test]
fn exact_beat_is_the_flight_after_its_start() {
    for beats in [0.0, 0.5, 1.0, 2.0] {
        let setup = started(nodding(0.2, 0.1), beats);
        let (beat, flown) = (Beat::new(&setup, 20).expect("a beat"), system_of(&setup));
        let (flown, period) = (flown.expect("bodies"), beat.period());
        for k in 0..20 {
            let t = 0.05 * f64::from(k) * period;
            let hinges = beat.flight().system().hinges().iter();
            for (a, b) in hinges.zip(flown.hinges()) {
                let (a, b) = (a.rotation(t), b.rotation(t + 3.0 * period));
                // Phases of some wingbeats have roundings of 1e-15.
                let (turned, spun) = (a.c - b.c, (a.w - b.w) * period);
                let columns = [turned.x_axis, turned.y_axis, turned.z_axis, spun];
                assert!(columns.iter().all(|x| x.length() < 1e-11), "{columns:?}");
            }
        }
    }
}

/// Place of the mass centre at the end over the wing length, from the release, and the mean velocity of the
/// last beat in wing lengths per wingbeat, of an animal under a law that looks `parts` times in a wingbeat.
fn steered(setup: FlightSetup, law: LawDesign, parts: usize, start_beats: f64) -> [DVec3; 2] {
    const STEPS: usize = 40;
    const BEATS: usize = 80;
    let mut setup = started(setup, start_beats);
    let AirModel::BladeElement(air) = setup.air.clone() else {
        unreachable!("it flies in blade elements")
    };
    let period = 1.0 / setup.animal.wings[0].motion.frequency;
    setup.time = TimeGrid {
        step: period / STEPS as f64,
        steps: BEATS * STEPS,
        period: Some(period),
    };
    let design = Design {
        buoyancy: vec![],
        law,
        target: Target::Trimmed,
        air,
        velocity: DVec3::ZERO,
        timing: Timing {
            parts,
            latency: 0,
            lag: 0.0,
        },
        every: 1,
        limits: Limits {
            amplitude: 0.2,
            angle: 12_f64.to_radians(),
        },
        sensors: None,
        observer: None,
        route: Route::default(),
    };
    setup.feedback = Some(Feedback {
        controller: Arc::new(design),
        interval: STEPS / parts,
        latency: 0,
        lag: 0.0,
    });
    let nodes = &setup.animal.wings[0].mesh.nodes;
    let length = nodes.iter().fold(0.0_f64, |m, r| m.max(r.length()));
    let mut flight = Simulation::new(setup).expect("a flight");
    let start = flight.record().mass_centre;
    let mut places = vec![start];
    while !flight.finished() {
        for _ in 0..STEPS {
            flight.step().expect("it flies");
        }
        places.push(flight.record().mass_centre);
    }
    [places[BEATS] - start, places[BEATS] - places[BEATS - 1]].map(|x| x / length)
}

/// Gains, orbit and reference of a controller that is laid out belong to the phase that the wings have at its
/// looks: under a start that delays them by half a wingbeat, or any part of one, the regulator brings the flyer
/// back to where it was released, as under an impulsive start. Gains of another phase left it two wing lengths
/// away.
#[test]
fn invariant_regulated_flight_comes_back_however_the_strokes_start() {
    let law = LawDesign::Regulator(Weights::default());
    for parts in [1, 4] {
        for beats in [0.0, 1.0, 0.7, 2.0] {
            let [place, way] = steered(smooth(moth()), law, parts, beats);
            println!("regulator, {parts} looks, start over {beats}: {place} {way}");
            assert!(
                place.length() < 1.5e-3,
                "{parts} looks, {beats} beats: {place}"
            );
            assert!(way.length() < 1e-4, "{parts} looks, {beats} beats: {way}");
        }
    }
}

/// The same of the stabiliser, which holds attitude and altitude and lets no drift grow.
#[test]
fn invariant_stabilised_flight_comes_to_rest_however_the_strokes_start() {
    let law = LawDesign::Stabiliser(Stiffness::default());
    for parts in [1, 4] {
        for beats in [0.0, 1.0, 0.7, 2.0] {
            let [place, way] = steered(smooth(fly()), law, parts, beats);
            println!("stabiliser, {parts} looks, start over {beats}: {place} {way}");
            assert!(
                place.z.abs() < 0.02,
                "{parts} looks, {beats} beats: {place}"
            );
            assert!(way.length() < 2e-3, "{parts} looks, {beats} beats: {way}");
        }
    }
}
