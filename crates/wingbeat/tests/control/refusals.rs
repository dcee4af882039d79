//! What control cannot do.

use wingbeat::case::LoadedCase;
use wingbeat::flight::{FlightSetup, FlightState, Simulation};

use super::{BLADES, PRESET, case, in_blades};
use crate::support::strings;

#[test]
fn refuses_what_control_cannot_do_by_name() {
    let wrong: [(&[&str], &str); 32] = [
        (&["control.controller=\"pid\""], "control.controller"),
        (&["control.latency_beats=-1"], "control.latency_beats"),
        (&["control.latency_beats=21"], "control.latency_beats"),
        (&["control.lag_beats=-1"], "control.lag_beats"),
        (&["control.every_beats=0"], "control.every_beats"),
        (&["control.looks_per_beat=0"], "control.looks_per_beat"),
        (&["control.looks_per_beat=4"], "control.looks_per_beat"), // of 30 steps
        (&["control.looks_per_beat=10"], "control.looks_per_beat"),
        (
            &["control.looks_per_beat=2", "control.latency_beats=0.25"],
            "control.latency_beats",
        ),
        (
            &["control.looks_per_beat=2", "control.every_beats=2"],
            "control.every_beats",
        ),
        (&["control.amplitude_limit=0"], "control.amplitude_limit"),
        (&["control.angle_limit_deg=120"], "control.angle_limit_deg"),
        (&["control.weights.place=1"], "control.weights.place"),
        (&["control.stiffness.pitch=0.3"], "control.stiffness"),
        (
            &["control.sensors.tilt_noise_deg=-1"],
            "control.sensors.tilt_noise_deg",
        ),
        (
            &["control.waypoint=[{time_s=0,heading_deg=9}]"],
            "control.waypoint[0].time_s",
        ),
        (
            &["control.waypoint=[{time_s=0.1,heading_deg=9},{time_s=0.104,heading_deg=0}]"],
            "control.waypoint[1].time_s",
        ),
        (
            &[
                "control.waypoint=[{time_s=1,heading_deg=9}]",
                "control.climb_m_s=0.1",
            ],
            "control.climb_m_s",
        ),
        (
            &[
                "control.controller=stabiliser",
                "control.waypoint=[{time_s=1,position_m=[1e-3,0,0]}]",
            ],
            "control.waypoint[0].position_m",
        ),
        (&["control.observer={}"], "control.observer"),
        (
            &[
                "control.sensors={tilt_noise_deg=1}",
                "control.observer={velocity=0}",
            ],
            "control.observer.velocity",
        ),
        (&["control.controller=external"], "control.external.command"),
        (
            &[
                "control.external={command=[\"true\"]}",
                "control.controller=regulator",
            ],
            "control.external",
        ),
        (
            &[
                "control.controller=external",
                "control.external={command=[\"true\"]}",
                "control.climb_m_s=0.1",
            ],
            "control.climb_m_s",
        ),
        (&["control.waypoint=[{time_s=0.1}]"], "control.waypoint[0]"),
        (
            &["control.waypoint=[{time_s=0.1,heading_deg=9},{time_s=0.2}]"],
            "control.waypoint[1]",
        ),
        (&["control.sensors={}"], "control.sensors"),
        (&["control.sensors={seed=4}"], "control.sensors"),
        (
            &["control.sensors={seed=4,velocity_bias_m_s=[0.1,0,0]}"],
            "control.sensors.seed",
        ),
        (&["air.model=none"], "control"),
        (&["flight.mode=tethered"], "control"),
        (
            &["air.model=blade_element", "flight.held_beats=0.5"],
            "flight.held_beats",
        ),
    ];
    for (set, key) in wrong {
        let error = LoadedCase::find(PRESET, &strings(set))
            .unwrap_err()
            .to_string();
        assert!(error.contains(key), "{set:?}: {error}");
        assert!(
            error.contains("try") || error.contains("did you mean"),
            "{set:?}: {error}"
        );
    }
    let mirror = ["air.model=vortex_lattice", "air.mirror=true"].map(str::to_owned);
    let error = LoadedCase::find(PRESET, &mirror).unwrap_err().to_string();
    assert!(error.contains("air.mirror"), "{error}");
}

#[test]
fn refuses_a_flyer_that_cannot_be_trimmed_when_it_is_built() {
    // Ten times the weight that the strokes carry.
    let case = case(&[&BLADES[..], &["body.mass_kg=1e-5"]].concat());
    let error = Simulation::new(case.setup.clone())
        .err()
        .expect("too heavy");
    let told = case.refused(&error).to_string();
    assert!(
        told.contains("control.controller") && told.contains("trim"),
        "{told}"
    );
}

/// Wings that differ, and a wind across, are named as what [control] does not fly; unknowns of a trim are none
/// of its keys.
#[test]
fn refuses_asymmetric_flights_in_words_of_the_case() {
    for key in [
        "motion.difference.stroke_amplitude=0.1",
        "air.stream_m_s=[0,-0.1,0]",
    ] {
        let case = case(&[&BLADES[..], &[key]].concat());
        let error = Simulation::new(case.setup.clone())
            .err()
            .expect("asymmetric");
        let told = case.refused(&error).to_string();
        for word in [
            "symmetric",
            "wings alike",
            "air.stream_m_s",
            "control.controller",
        ] {
            assert!(told.contains(word), "{key}: {told}");
        }
        assert!(!told.contains("unknowns"), "{key}: {told}");
    }
}

#[test]
fn refuses_harmonics_of_loads_without_a_frequency() {
    let set = |load: &str| LoadedCase::find(PRESET, &[format!("load=[{{{load}}}]")]);
    let error = set("force_cosine_newton=[[1e-6,0,0]]")
        .unwrap_err()
        .to_string();
    assert!(error.contains("load[0].force_cosine_newton") && error.contains("frequency_hz"));
    assert!(set("frequency_hz=50,force_cosine_newton=[[1e-6,0,0]]").is_ok());
}

/// Memories of another controller, of another latency and of no wings, as a checkpoint beside another case has them.
#[test]
fn refuses_to_resume_with_what_another_controller_remembers() {
    let damages: [fn(&mut FlightState); 6] = [
        |s| s.control = None,
        |s| s.control.as_mut().unwrap().memory.clear(),
        |s| s.control.as_mut().unwrap().memory.push(0.0),
        |s| _ = s.control.as_mut().unwrap().memory.pop(),
        |s| s.control.as_mut().unwrap().queue.clear(),
        |s| s.control.as_mut().unwrap().to.clear(),
    ];
    let sums = ["control.weights.sum=2", "control.stiffness.integral=0.02"];
    for (controller, sum) in ["regulator", "stabiliser"].iter().zip(sums) {
        let controller = format!("control.controller={controller}");
        let setup = in_blades(&["time.beats=3", "control.latency_beats=1", &controller, sum]);
        let mut flight = Simulation::new(setup.clone()).unwrap();
        (0..50).for_each(|_| _ = flight.step().unwrap());
        assert!(Simulation::resume(setup.clone(), flight.state().clone()).is_ok());
        for (k, damage) in damages.iter().enumerate() {
            let mut state = flight.state().clone();
            damage(&mut state);
            let refused = Simulation::resume(setup.clone(), state).map(drop);
            let said = refused.expect_err(&format!("damage {k}")).to_string();
            assert!(said.contains("resume with the case"), "{k}: {said}");
        }
    }
}

/// As a checkpoint beside a case from which [control] was removed has it.
#[test]
fn refuses_to_resume_without_the_feedback_that_was_saved() {
    let setup = in_blades(&["time.beats=3"]);
    let flight = Simulation::new(setup.clone()).unwrap();
    let open = FlightSetup {
        feedback: None,
        ..setup
    };
    let refused = Simulation::resume(open, flight.state().clone()).map(drop);
    let said = refused.unwrap_err().to_string();
    for word in ["memory of feedback", "no [control]", "resume with the case"] {
        assert!(said.contains(word), "{said}");
    }
}
