//! Feedback of flyers with free joints, which it does not see.

use wingbeat::Flight;
use wingbeat::analysis::control::{Regulator, Weights};
use wingbeat::analysis::{trim, trim_from};
use wingbeat::flight::{FlightSetup, Simulation};

use super::beats;
use crate::support::preset;

/// Kick of the body's pitch at the release \[deg\].
const KICK: f64 = 1.0;

/// The fly whose abdomen nods on a spring, in blade elements under feedback.
fn nodding(beats: usize, set: &[&str]) -> FlightSetup {
    let time = format!("time.beats={beats}");
    let all = [
        "air.model=blade_element",
        "air.mirror=",
        "output.frames_every=0",
        "time.steps_per_beat=40",
        "control.controller=regulator",
        &time,
    ];
    preset("fruit-fly-abdomen-spring", &[&all[..], set].concat()).setup
}

/// Pitch at the release of the trimmed flight, with a kick \[deg\].
fn kicked() -> String {
    let mut open = nodding(1, &[]);
    open.feedback = None;
    let flight = wingbeat::Flight::from(open);
    let trim = flight.trim(&flight.hover()).unwrap();
    format!(
        "flight.pitch_deg={}",
        trim.solution.body_pitch.to_degrees() + KICK
    )
}

/// The regulator knows what the abdomen remembers, whose motion it does not see: a kick dies out. Laid out on
/// the body alone it grew tenfold in 40 wingbeats with a latency of one, and without.
#[test]
fn balances_a_flyer_whose_abdomen_nods_on_a_spring() {
    let pitch = kicked();
    let damped = "joint.waist.element[0].damping_newton_m_s_per_rad=1.7e-10";
    for (set, most) in [
        (&["control.latency_beats=1"][..], 3e-4),
        (&["control.latency_beats=0"], 1e-4),
        (&["control.latency_beats=1", damped], 1e-4),
    ] {
        let all = [&[pitch.as_str()], set].concat();
        let flown = beats(nodding(60, &all));
        let strayed = |range: std::ops::Range<usize>| {
            flown[range]
                .iter()
                .fold(0.0_f64, |m, (place, _)| m.max(*place))
        };
        let [first, last] = [strayed(0..30), strayed(50..60)];
        println!("{set:?}: strays {first:e} m in 30 beats, {last:e} m from the 50th");
        // 95, 26 and 36 um.
        assert!(
            last < 0.2 * first && last < most,
            "{set:?}: {first:e} {last:e}"
        );
    }
}

/// An abdomen whose spring nothing damps is held, too: what it does to the body is seen and damped. The trim is
/// followed from the damped one. The stabiliser, laid out on means, takes no free joint.
#[test]
fn behaves_an_undamped_joint_is_held_and_the_stabiliser_refuses_joints() {
    let damping = "joint.waist.element[0].damping_newton_m_s_per_rad=";
    let open = |set: &[&str]| FlightSetup {
        feedback: None,
        ..nodding(1, set)
    };
    let first = open(&[]);
    let problem = Flight::from(first.clone()).hover();
    let mut found = trim(&first, &problem).unwrap();
    for share in [0.2, 0.0] {
        let less = format!("{damping}{:e}", share * 1.7e-11);
        found = trim_from(&open(&[&less]), &problem, found.point.clone()).unwrap();
        assert!(
            found.solution.converged,
            "{share}: {}",
            found.solution.error()
        );
    }
    assert!(Regulator::new(&found, &Weights::default(), 1).is_ok());
    let stabiliser = Simulation::new(nodding(1, &["control.controller=stabiliser"]));
    let said = stabiliser.err().expect("refused").to_string();
    assert!(said.contains("waist"), "{said}");
}
