//! Commands that are given, lag and saturate; loads and noise that feedback works against.

use std::sync::Arc;

use wingbeat::Flight;
use wingbeat::case::LoadedCase;
use wingbeat::flight::{Controller, Feedback, Sensed, Simulation};
use wingbeat::model::Crossing;
use wingbeat::model::motion::Adjustment;
use wingbeat::results::{Outcome, Summary};

use super::{beats, in_blades};

/// Commands the same at every look.
#[derive(Clone, Debug)]
struct Constant(Adjustment);

impl Controller for Constant {
    fn command(&mut self, _: &Sensed) -> Result<Vec<Adjustment>, String> {
        Ok(vec![self.0; 2])
    }
}

/// A step of the command, through actuators of first order: `1 - exp(-t / lag)` at the looks, after the latency.
#[test]
fn exact_actuators_lag_behind_a_step() {
    let mut setup = in_blades(&["time.beats=6"]);
    let step = Adjustment {
        stroke_amplitude: 0.1,
        stroke_plane: -0.05,
        ..Adjustment::default()
    };
    for (interval, latency, lag) in [(40, 0, 2.0), (40, 2, 0.5), (10, 1, 1.0)] {
        setup.feedback = Some(Feedback {
            controller: Arc::new(Constant(step)),
            interval,
            latency,
            lag: lag * 0.005, // a wingbeat is 5 ms
        });
        let records = Flight::from(setup.clone()).fly().unwrap().records;
        for (look, record) in records.iter().step_by(interval).enumerate() {
            // At the end of the passage that begins here.
            let beats = ((look + 1).saturating_sub(latency) * interval) as f64 / 40.0;
            let share = 1.0 - (-beats / lag).exp();
            let [a, b] = [
                record.commands[0].stroke_amplitude,
                record.commands[1].stroke_plane,
            ];
            assert!((a - 0.1 * share).abs() < 1e-14, "{look}: {a}");
            assert!((b + 0.05 * share).abs() < 1e-14, "{look}: {b}");
        }
    }
}

/// Strokes that feedback moves aft until the wings meet behind the body.
#[test]
fn behaves_summary_names_wings_that_commands_bring_through_each_other() {
    for (offset, crosses) in [(-5_f64, false), (-40.0, true)] {
        let mut setup = in_blades(&["time.beats=3"]);
        let back = Adjustment {
            stroke_offset: offset.to_radians(),
            ..Adjustment::default()
        };
        setup.feedback = Some(Feedback {
            controller: Arc::new(Constant(back)),
            interval: 40,
            latency: 0,
            lag: 0.0,
        });
        assert!(setup.crossing_wings().is_empty());
        let run = Flight::from(setup.clone()).fly().unwrap();
        let summary = Summary::of(&setup, &run.records, &Outcome::Finished);
        let named = "wings `left` and `right` pass through each other";
        let said = summary.warnings.iter().any(|w| w.contains(named));
        assert_eq!(said, crosses, "{offset}: {:?}", summary.warnings);
    }
}

/// Wings that pass through each other in flight: what brings them there is named first, the commands where nothing
/// else does.
#[test]
fn behaves_the_remedy_is_that_of_what_brings_wings_through_each_other() {
    for (preset, remedy) in [
        ("fruit-fly-blade", "of a mean chord: limit the commands"),
        ("robobee", "of a mean chord: stop or stiffen their joints"),
        ("hawkmoth-blade", "(theta) or change their phase"), // they do so without commands
    ] {
        let mut setup = LoadedCase::find(preset, &[]).unwrap().setup;
        setup.feedback = Some(Feedback {
            controller: Arc::new(Constant(Adjustment::default())),
            interval: 40,
            latency: 0,
            lag: 0.0,
        });
        let found = Crossing {
            wings: [0, 1],
            part: 0.4,
        };
        let said = setup.say_flown_crossing(&found, 1e-4).said;
        assert!(said.contains(remedy), "{preset}: {said}");
    }
}

/// Actuators that lag by a wingbeat: a regulator that counts with it holds a tilted fly.
#[test]
fn balances_a_tilted_flight_behind_slow_actuators() {
    let tilted = [
        "flight.pitch_deg=69.69",
        "time.beats=80",
        "time.steps_per_beat=60",
        "control.weights={}",
        "control.lag_beats=1",
    ];
    let (way, turned) = beats(in_blades(&tilted))[79];
    println!("{turned} deg, {way:e} m");
    assert!(
        (turned - 20.0).abs() < 0.1 && way < 0.01 * 2.5e-3,
        "{turned} deg, {way:e} m"
    );
}

/// A twentieth of the weight hangs on the body: proportional-derivative loops of altitude give way by `a /
/// omega^2`, the integral action takes it back.
#[test]
fn exact_altitude_under_a_load_with_and_without_integral_action() {
    let sunk = [0.0, 0.02].map(|integral| {
        let integral = format!("control.stiffness={{altitude=0.2,integral={integral}}}");
        let setup = in_blades(&[
            "flight.pitch_deg=49.69",
            "time.beats=400",
            "control.controller=stabiliser",
            "control.latency_beats=0",
            "load=[{frame=\"inertial\",force_newton=[0,0,4.62e-7]}]",
            &integral,
        ]);
        let mut flight = Simulation::new(setup).unwrap();
        let from = flight.record().mass_centre.z;
        (0..40 * 400).for_each(|_| _ = flight.step().unwrap());
        flight.record().mass_centre.z - from
    });
    let expect = 4.62e-7 / 0.9422e-6 / (0.2_f64 / 0.005).powi(2);
    println!("{sunk:?} m, {expect:e} m");
    // Lift is not quite linear in the amplitude: 0.5 %. What is left of the sum's way after 400 beats is 1e-4.
    assert!((sunk[0] / expect - 1.0).abs() < 0.02, "{sunk:?} {expect}");
    assert!(sunk[1].abs() < 5e-4 * expect, "{sunk:?} {expect}");
}

#[test]
fn exact_noise_is_that_of_its_seed() {
    let noisy = |seed: u32| {
        let sensors = format!("control.sensors={{seed={seed},tilt_noise_deg=1}}");
        let setup = in_blades(&["time.beats=3", &sensors]);
        Flight::from(setup).fly().unwrap().records.pop().unwrap()
    };
    assert_eq!(noisy(1), noisy(1));
    assert_ne!(noisy(1).mass_centre, noisy(2).mass_centre);
}
