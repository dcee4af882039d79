//! Feedback of flyers with free joints, which it does not see.

use wingbeat::Flight;
use wingbeat::analysis::control::{Regulator, Weights};
use wingbeat::analysis::{Trim, trim, trim_from};
use wingbeat::case::LoadedCase;
use wingbeat::flight::{FlightSetup, Simulation};

use crate::beats;

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
    let set: Vec<String> = all.iter().chain(set).map(|s| (*s).to_owned()).collect();
    let case = LoadedCase::find("fruit-fly-abdomen-spring", &set);
    case.unwrap_or_else(|e| panic!("{e}")).setup
}

/// Pitch at the release of the trimmed flight, with a kick \[deg\].
fn kicked() -> String {
    let mut open = nodding(1, &[]);
    open.feedback = None;
    let flight = wingbeat::Flight::from(open);
    let trim = flight.trim(&flight.hover()).unwrap();
    format!("flight.pitch_deg={}", trim.body_pitch.to_degrees() + KICK)
}

/// The regulator knows what the abdomen remembers, whose motion it does not see: a kick dies out. Laid out on the body alone it grew
/// tenfold in 40 wingbeats with a latency of one, and without.
#[test]
fn balances_a_flyer_whose_abdomen_nods_on_a_spring() {
    let pitch = kicked();
    let damped = "joint.waist.element[0].damping_newton_m_s_per_rad=1.7e-10";
    for (set, most) in [
        (&["control.latency_beats=1"][..], 1e-4),
        (&["control.latency_beats=0"], 1e-4),
        (&["control.latency_beats=1", damped], 1e-4),
    ] {
        let all = [&[pitch.as_str()], set].concat();
        let flown = beats(nodding(120, &all));
        let strayed = |range: std::ops::Range<usize>| {
            flown[range]
                .iter()
                .fold(0.0_f64, |m, (place, _)| m.max(*place))
        };
        let [first, last] = [strayed(0..40), strayed(100..120)];
        println!("{set:?}: strays {first:e} m in 40 beats, {last:e} m from the 100th");
        assert!(
            last < 0.2 * first && last < most,
            "{set:?}: {first:e} {last:e}"
        );
    }
}

/// An abdomen whose spring nothing damps goes on nodding, and the layout says whether feedback ends it. The stabiliser, laid
/// out on means, takes no free joint.
#[test]
fn refuses_feedback_of_joints_that_do_not_settle() {
    let damping = "joint.waist.element[0].damping_newton_m_s_per_rad=";
    let trimmed = |open: FlightSetup, from: Option<&Trim>| {
        let open = FlightSetup {
            feedback: None,
            ..open
        };
        let problem = Flight::from(open.clone()).hover();
        let found = match from {
            Some(near) => trim_from(&open, &problem, near.point.clone()),
            None => trim(&open, &problem),
        };
        found.unwrap()
    };
    let damped = trimmed(nodding(1, &[]), None);
    let undamped = trimmed(nodding(1, &[&format!("{damping}0")]), Some(&damped));
    assert!(damped.converged && undamped.converged);
    let laid_out = |trim: &Trim| Regulator::new(trim, &Weights::default(), 1);
    assert!(laid_out(&damped).is_ok());
    let said = laid_out(&undamped).expect_err("refused").to_string();
    for word in ["waist", "times itself in a wingbeat", "damping"] {
        assert!(said.contains(word), "{said}");
    }
    let stabiliser = Simulation::new(nodding(1, &["control.controller=stabiliser"]));
    let said = stabiliser.err().expect("refused").to_string();
    assert!(said.contains("waist"), "{said}");
}
