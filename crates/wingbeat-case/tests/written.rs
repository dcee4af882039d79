//! Setups written as cases: read back they are what they were, to rounding; what no key says is refused.

use crate::common::preset;
use wingbeat_case::{LoadedCase, case_of, presets};
use wingbeat_flight::{AirModel, FlightSetup, MotionMode};
use wingbeat_math::{DVec3, MassProperties};

/// The words of a text and, apart, its numbers.
fn words_and_numbers(text: &str) -> (Vec<&str>, Vec<f64>) {
    let all = text.split([' ', ',', '(', ')', '[', ']', '{', '}']);
    let (numbers, words): (Vec<&str>, Vec<&str>) = all
        .filter(|word| !word.is_empty())
        .partition(|word| word.parse::<f64>().is_ok());
    let numbers = numbers.iter().map(|x| x.parse().unwrap()).collect();
    (words, numbers)
}

/// Largest difference of numbers, over the largest number among them and their eight neighbours on
/// either side: a product of inertia is round-off of moments.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let size = |k: usize| {
        let around = k.saturating_sub(8)..(k + 9).min(a.len());
        a[around].iter().fold(0.0_f64, |m, x| m.max(x.abs()))
    };
    let gap = |k: usize| match (a[k] - b[k]).abs() {
        0.0 => 0.0,
        gap => gap / size(k),
    };
    (0..a.len()).map(gap).fold(0.0, f64::max)
}

/// What no case can say without the case it came from.
const REFUSED: [&str; 5] = ["joints", "loads", "segments", "feedback", "air ("];

#[test]
fn agrees_every_preset_with_the_case_of_its_setup() {
    let (mut same, mut refused) = (0, 0);
    for preset in presets::PRESETS {
        let mut setup = LoadedCase::find(preset.name, &[]).unwrap().setup;
        // What mass a part has of the body's is not asked for any more, nor how round it is but for the drag's place.
        if let AirModel::BladeElement(air) = &mut setup.air
            && let Some(drag) = &mut air.body_drag
        {
            drag.centre = drag.centre.or(Some(setup.animal.body_centre()));
        }
        let flatten = |setup: &mut FlightSetup| {
            for part in &mut setup.animal.parts {
                part.mass = MassProperties::ZERO;
                part.enclosed = (0.0, DVec3::ZERO);
            }
        };
        let again = case_of(&setup, None).map(|mut case| {
            flatten(&mut case.setup);
            case.setup
        });
        flatten(&mut setup);
        let again = match again {
            Ok(again) => again,
            Err(e) => {
                let said = e.to_string();
                let part = said.split("no keys for its ").nth(1).unwrap_or(&said);
                assert!(REFUSED.iter().any(|p| part.starts_with(p)), "{said}");
                refused += 1;
                continue;
            }
        };
        let written = [&setup, &again].map(|s| format!("{s:?}"));
        let [a, b] = written.each_ref().map(|s| words_and_numbers(s));
        assert!(a.0 == b.0 && a.1.len() == b.1.len(), "{}", preset.name);
        // Some roundings of angles, moments of inertia and fronts of gusts, 1e-16 each.
        let apart = apart(&a.1, &b.1);
        assert!(apart < 2e-14, "{}: {apart:e}", preset.name);
        same += 1;
    }
    println!("{same} written, {refused} refused");
    assert!(same > 20 && refused > 3);
}

#[test]
fn exact_setup_that_is_unchanged_keeps_its_case() {
    for preset in presets::PRESETS {
        let case = LoadedCase::find(preset.name, &[]).unwrap();
        let mut longer = case.setup.clone();
        longer.time.steps += 1;
        let again =
            case_of(&longer, Some(&case)).unwrap_or_else(|e| panic!("{}: {e}", preset.name));
        let [a, b] = [&longer, &again.setup].map(|s| format!("{s:?}"));
        assert!(a == b, "{}", preset.name);
    }
}

#[test]
fn agrees_a_hold_on_a_moving_tether_with_the_case_of_its_setup() {
    let set = [
        "flight.held_beats=2",
        "flight.angular_velocity_deg_s=[1, 2, 3]",
        "flight.tether.x={ frequency_hz = 200, cosine_m = [1e-4], sine_m = [0, 2e-5] }",
        "flight.tether.pitch={ frequency_hz = 200, sine_deg = [3] }",
    ]
    .map(str::to_owned);
    let setup = LoadedCase::find("fruit-fly-blade", &set).unwrap().setup;
    let again = case_of(&setup, None).unwrap().setup;
    let [a, b] = [&setup, &again].map(|s| match &s.mode {
        MotionMode::Free(start) => start.clone(),
        MotionMode::Tethered(_) => panic!("it is free"),
    });
    assert_eq!(a.held_steps, b.held_steps);
    for t in [0.0, 1e-3, 7e-3] {
        let [a, b] = [&a, &b].map(|s| s.released(t));
        let parts = [a.p - b.p, a.v - b.v, 1e-3 * (a.w - b.w)];
        assert!(parts.iter().all(|d| d.length() < 1e-15), "{parts:?}");
    }
}

/// Cases of which some keys have no effect beside the others, as a load that does not oscillate.
#[test]
fn exact_resolved_cases_can_be_read() {
    for sets in [
        vec!["load=[{force_newton=[0,0,-1e-7]}]"],
        vec!["load=[{couple_newton_m=[0,1e-9,0]}]"],
        vec!["load=[{frequency_hz=50,force_sine_newton=[[1e-7,0,0]]}]"],
        vec!["load=[{frequency_hz=50,couple_cosine_newton_m=[[1e-9,0,0]]}]"],
        vec!["flight.mode=tethered", "flight.tether.yaw.rate_deg_s=100"],
        vec![
            "flight.mode=tethered",
            "flight.velocity_m_s=[1,0,0]",
            "flight.tether.start_s=0.01",
        ],
        vec![
            "flight.mode=tethered",
            "flight.tether.pitch={rate_deg_s=1,frequency_hz=20,cosine_deg=[3]}",
        ],
    ] {
        let case = preset("fruit-fly-blade", &sets);
        let again = LoadedCase::from_text("again", &case.resolved(), ".".as_ref(), &[]);
        let again = again.unwrap_or_else(|e| panic!("{sets:?}: {e}"));
        assert!(format!("{:?}", case.setup) == format!("{:?}", again.setup));
    }
}

/// Defaults that a resolved case has filled in stand by what is set on top of it; what says more does not.
#[test]
fn behaves_resolved_cases_are_tethered_by_one_key() {
    let resolved = LoadedCase::find("fruit-fly-blade", &[]).unwrap().resolved();
    assert!(resolved.contains("held_beats = 0.0"), "{resolved}");
    let set = |text: &str, key: &str| {
        LoadedCase::from_text(
            "resolved",
            text,
            std::path::Path::new(""),
            &[key.to_owned()],
        )
    };
    let tethered = set(&resolved, "flight.mode=tethered").unwrap();
    assert!(matches!(tethered.setup.mode, MotionMode::Tethered(_)));
    let held = resolved.replace("held_beats = 0.0", "held_beats = 1.0");
    let said = set(&held, "flight.mode=tethered").unwrap_err().to_string();
    assert!(
        said.contains("held_beats = 1.0: this has no effect"),
        "{said}"
    );
    // In one file, where nothing was set on top, the two contradict each other.
    let written = resolved.replace("mode = \"free\"", "mode = \"tethered\"");
    let said = set(&written, "time.beats=1").unwrap_err().to_string();
    assert!(said.contains("this has no effect"), "{said}");
}
