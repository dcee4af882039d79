//! Cases that a trim writes, ensembles, and signals, under feedback.

use std::fs;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use wingbeat::analysis::TrimProblem;
use wingbeat::analysis::ensemble::{is_noisy, member};
use wingbeat::case::{LoadedCase, trimmed_case};
use wingbeat::flight::Simulation;
use wingbeat::math::DVec3;
use wingbeat::{Flight, ensemble};

use crate::support::{Scratch, preset};

fn fly(set: &[&str]) -> LoadedCase {
    let all = ["time.steps_per_beat=40", "control.controller=regulator"];
    preset("fruit-fly-blade", &[&all[..], set].concat())
}

/// A case that was trimmed in forward flight goes on with the speed that it was trimmed at; it braked to hover.
#[test]
fn balances_a_trimmed_case_under_feedback_flies_on_at_its_speed() {
    const SPEED: f64 = 0.3;
    let case = fly(&["control.latency_beats=1"]);
    let mut open = case.setup.clone();
    open.feedback = None;
    let flight = Flight::from(open);
    let pitch = case.setup.angles_at_release().x;
    let forward = TrimProblem::straight(DVec3::new(SPEED, 0.0, 0.0), pitch);
    let trim = flight.trim(&forward).unwrap();
    let text = trimmed_case(&case, &trim).unwrap();
    let set = ["time.beats=30".to_owned()];
    let written = LoadedCase::from_text("written", &text, std::path::Path::new(""), &set).unwrap();
    let period = written.setup.time.period.unwrap();
    let steps = written.setup.time.steps_per_beat().unwrap();
    let mut flight = Simulation::new(written.setup).unwrap();
    let mut places = vec![flight.record().mass_centre.x];
    while !flight.finished() {
        (0..steps).for_each(|_| _ = flight.step().unwrap());
        places.push(flight.record().mass_centre.x);
    }
    for (beat, pair) in places.windows(2).enumerate() {
        let speed = (pair[1] - pair[0]) / period;
        // The reference of a flight that is held as it begins is that of the first look.
        assert!((speed - SPEED).abs() < 0.01 * SPEED, "beat {beat}: {speed}");
    }
}

/// Members of an ensemble whose senses are noisy have noise of their own: they scatter, and their mean has an error.
#[test]
fn behaves_members_of_a_noisy_flight_scatter() {
    let noise = "control.sensors.tilt_noise_deg=2";
    let setup = fly(&["time.beats=5", noise]).setup;
    let found = ensemble(&Flight::from(setup), 3, 0).unwrap();
    assert!(
        found.is_noisy && found.beats[3].spread > 1e-4,
        "{:?}",
        found.beats[3]
    );
    let means = found.means.as_ref().unwrap();
    assert!(
        means
            .estimate
            .lift_newton
            .standard_error
            .is_some_and(|e| e > 0.0)
    );
    assert!(
        found.remark().contains("noise of its own"),
        "{}",
        found.remark()
    );
    // The first member is the case itself.
    let silent = fly(&["time.beats=2"]).setup;
    assert!(!ensemble(&Flight::from(silent), 2, 0).unwrap().is_noisy);
    // Noise that no command follows is none: the flyer is held to the end, or it is released too late.
    let is_noisy = |set: &[&str]| is_noisy(&fly(&[&["time.beats=5", noise], set].concat()).setup);
    assert!(is_noisy(&["flight.held_beats=2"]));
    assert!(!is_noisy(&["flight.held_beats=5"]));
    assert!(!is_noisy(&[
        "flight.held_beats=3",
        "control.latency_beats=2"
    ]));
}

/// No air goes through a ground, a wall or the plane of symmetry: members of an ensemble have their wind along them.
#[test]
fn behaves_members_of_an_ensemble_fly_beside_grounds_and_walls() {
    let cases = [
        ("[0,0,1]", false, 0),
        ("[1,0,0]", false, 0),
        ("[0,1,0]", false, 0),
        ("[0.3,0.2,-2]", false, 0),
        ("[0,0,1]", true, 0),
        ("[0,0,1]", true, 30),
        ("[2,0,1]", true, 0),
    ];
    for (normal, mirror, yaw) in cases {
        let set = [
            format!("air.ground.normal={normal}"),
            "air.ground.point_m=[0.02,0.02,0.02]".to_owned(),
            format!("air.mirror={mirror}"),
            format!("flight.yaw_deg={yaw}"),
            "time.steps_per_beat=20".to_owned(),
            "wing.right.mesh.chordwise=2".to_owned(),
            "wing.right.mesh.spanwise=4".to_owned(),
            "flight.pitch_deg=0".to_owned(), // so that yaw alone does not tilt it
        ];
        let setup = LoadedCase::find("fruit-fly-hover", &set)
            .unwrap_or_else(|e| panic!("{e}"))
            .setup;
        let mut streams = vec![];
        for k in 0..5 {
            let member = member(&setup, k, 5).unwrap();
            streams.push(member.air.stream().unwrap());
            let mut flight = Simulation::new(member)
                .unwrap_or_else(|e| panic!("{normal}, mirror {mirror}, member {k}: {e}"));
            flight
                .step()
                .unwrap_or_else(|e| panic!("{normal}, mirror {mirror}, member {k}: {e}"));
        }
        assert_eq!(streams[0], DVec3::ZERO);
        assert!(
            streams[1..].iter().all(|s| s.length() > 1e-7),
            "{streams:?}"
        );
    }
}

/// A signal while the controller is laid out ends the program with the code that its help promises, and a sentence.
#[cfg(unix)]
#[test]
fn behaves_a_signal_before_the_flight_begins_is_told() {
    let scratch = Scratch::new("control-signal");
    let dir = &scratch.0;
    let arguments = [
        "run",
        "fruit-fly-blade",
        "--set",
        "control.controller=regulator",
        "--set",
        "control.looks_per_beat=20",
        "--set",
        "time.steps_per_beat=200",
        "--out",
        "r",
    ];
    let mut command = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
    command
        .current_dir(dir)
        .args(arguments)
        .stderr(Stdio::piped());
    let child = command.stdout(Stdio::null()).spawn().unwrap();
    // The handler is there once the program does not ignore the signal by default.
    let status = format!("/proc/{}/status", child.id());
    let catches = || fs::read_to_string(&status).is_ok_and(|s| mask(&s) >> 14 & 1 == 1);
    (0..500)
        .take_while(|_| !catches())
        .for_each(|_| sleep(Duration::from_millis(10)));
    let kill = Command::new("kill").arg(child.id().to_string()).status();
    assert!(kill.unwrap().success());
    let out = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(130), "{said}");
    assert!(
        said.contains("interrupted before the flight began"),
        "{said}"
    );
    assert!(!dir.join("r").exists());
}

/// Signals that a process catches; bit 0 is signal 1.
#[cfg(unix)]
fn mask(status: &str) -> u64 {
    let line = status.lines().find_map(|l| l.strip_prefix("SigCgt:"));
    line.map_or(0, |text| u64::from_str_radix(text.trim(), 16).unwrap_or(0))
}
