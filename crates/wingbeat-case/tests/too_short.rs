//! Flights that end before what they are to do.

use crate::common::preset;
use wingbeat_case::LoadedCase;

/// Waypoints later than the end of the flight, counted from the release; starts longer than flight or hold.
#[test]
fn behaves_what_the_flight_is_too_short_for_is_doubted() {
    let late = |beats: &str| {
        let way =
            "control.waypoint=[{time_s=0.03, heading_deg=5}, {time_s=5, position_m=[0.01, 0, 0]}]";
        let set = [way, "air.model=blade_element", beats].map(str::to_owned);
        LoadedCase::find("fruit-fly-controlled", &set)
            .unwrap()
            .setup
            .late_waypoints()
    };
    let said = late("time.beats=12").unwrap();
    assert!(
        said.contains("control.waypoint[1] is to be reached after the end"),
        "{said}"
    );
    let both = late("time.beats=4").unwrap();
    assert!(
        both.contains("the waypoints from control.waypoint[0] on"),
        "{both}"
    );
    assert_eq!(late("time.beats=1200"), None);
    let starts = |set: &[&str]| {
        preset("fruit-fly-blade", set)
            .setup
            .starts_that_do_not_end()
    };
    let [smooth, two] = ["motion.start=smooth", "time.beats=2"];
    assert_eq!(starts(&[smooth, two, "motion.start_beats=2"]), [""; 0]);
    let long = starts(&[smooth, two, "motion.start_beats=3"]);
    assert!(
        long.len() == 1 && long[0].contains("motion.start_beats"),
        "{long:?}"
    );
    let tether = "flight.tether={start_s=10, x={frequency_hz=10, sine_m=[0.001]}}";
    let tether = starts(&[tether, two, "flight.mode=tethered"]);
    assert!(
        tether.len() == 1 && tether[0].contains("flight.tether.start_s"),
        "{tether:?}"
    );
}

/// Commands that begin to act after the end, and a controller that looks only at the release.
#[test]
fn behaves_controllers_that_never_act_are_doubted() {
    let said = |set: &[&str]| {
        let set: Vec<&str> = [&["air.model=blade_element", "control.hold=start"], set].concat();
        preset("fruit-fly-controlled", &set)
            .setup
            .commands_too_late()
    };
    let flight = "time.beats=7"; // two held
    assert_eq!(said(&[flight, "control.latency_beats=4"]), None);
    let late = said(&[flight, "control.latency_beats=5"]).unwrap();
    assert!(late.contains("control.latency_beats"), "{late}");
    let held = said(&[flight, "control.latency_beats=4", "flight.held_beats=3"]).unwrap();
    assert!(held.contains("control.latency_beats"), "{held}");
    let looks = |set: &[&str]| {
        let set: Vec<&str> = [
            &[flight, "air.model=blade_element", "control.latency_beats=0"],
            set,
        ]
        .concat();
        preset("fruit-fly-controlled", &set).setup.single_look()
    };
    let once = looks(&["control.every_beats=5"]).unwrap();
    assert!(once.contains("control.every_beats"), "{once}");
    assert_eq!(looks(&["control.every_beats=4"]), None);
}

/// A smooth start makes strokes late by half of its length, and a tether beside them that starts at once is ahead by so
/// much of its period, or behind by the rest of it.
#[test]
fn exact_sides_by_which_tethers_and_strokes_are_apart() {
    let said = |beats: f64, count: f64| {
        let frequency = 200.0 * count;
        let setup = preset(
            "fruit-fly-blade",
            &[
                "flight={ mode = \"tethered\" }",
                "motion.frequency_hz=200",
                "motion.start=smooth",
                &format!("motion.start_beats={beats:?}"),
                &format!("flight.tether.z={{ frequency_hz = {frequency:?}, sine_m = [1e-4] }}"),
                "time.beats=9",
            ],
        );
        setup.setup.starts_apart()
    };
    for (beats, count, words) in [
        (0.5, 1.0, "0.250 of its period ahead of"),
        (1.5, 1.0, "0.250 of its period behind"),
        (1.5, 2.0, "0.500 of its period"),
        (0.8, 2.0, "0.200 of its period behind"),
        (2.5, 1.0, "0.250 of its period ahead of"),
    ] {
        let text = said(beats, count).unwrap();
        assert!(text.contains(words), "{beats} {count}: {text}");
    }
    assert_eq!(said(2.0, 1.0), None);
}
