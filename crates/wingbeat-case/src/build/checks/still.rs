//! Oscillations of what stands still: phases and starts of constant angles, sines at no frequency.

use wingbeat_flight::FlightSetup;
use wingbeat_model::Wing;

use crate::build::fault::{Built, idle};
use crate::error::Fault;
use crate::raw::{Case, JointCase, TetherCase};

/// Phase and length of the start of wings whose angles are all constant, and the phase of one such wing.
pub(super) fn motion(case: &Case, setup: &FlightSetup) -> Built<()> {
    let wings = &setup.animal.wings;
    own_phases(case, wings)?;
    if wings.is_empty() || !wings.iter().all(Wing::is_still) || !case.joint.is_empty() {
        return Ok(());
    }
    let acts = |key: &&str| ["phase", "start_beats"].contains(key);
    match case.motion.unlike_default().into_iter().find(acts) {
        Some(key) => {
            let why = "on wings whose angles are all constant";
            let acts = "with a wing whose angles vary over the beat (wing.NAME.motion)";
            Err(idle(format!("motion.{key}"), why, acts))
        }
        None => Ok(()),
    }
}

/// The phase of a wing whose own angles are all constant.
fn own_phases(case: &Case, wings: &[Wing]) -> Built<()> {
    for (name, wing) in &case.wing {
        let is_still = wings.iter().any(|w| w.name == *name && w.is_still());
        let phase = wing.motion.as_ref().and_then(|own| own.phase);
        if is_still && phase.is_some_and(|phase| phase != 0.0) {
            return Err(idle(
                format!("wing.{name}.motion.phase"),
                "on a wing whose angles are all constant",
                "with angles of the wing that vary over the beat",
            ));
        }
    }
    Ok(())
}

/// Sines of a tether at no frequency.
pub(super) fn on_tether(tether: &TetherCase) -> Built<()> {
    let paths = [("x", &tether.x), ("y", &tether.y), ("z", &tether.z)];
    let paths = paths.map(|(name, path)| {
        let path = path.as_ref();
        (name, "sine_m", path.map(|p| (p.frequency_hz, &p.sine_m)))
    });
    let turns = [
        ("pitch", &tether.pitch),
        ("yaw", &tether.yaw),
        ("roll", &tether.roll),
    ];
    let turns = turns.map(|(name, turn)| {
        let turn = turn.as_ref();
        (
            name,
            "sine_deg",
            turn.map(|t| (t.frequency_hz, &t.sine_deg)),
        )
    });
    for (name, key, oscillation) in paths.into_iter().chain(turns) {
        if oscillation.is_some_and(|(frequency, sine)| frequency == 0.0 && !sine.is_empty()) {
            return Err(idle(
                format!("flight.tether.{name}.{key}"),
                "at a frequency_hz of 0",
                "with a frequency_hz above 0",
            ));
        }
    }
    Ok(())
}

/// Oscillations of a joint, and of what acts along it, at no frequency; `beat` is that of the wings \[Hz\].
pub(super) fn joint(name: &str, joint: &JointCase, beat: f64) -> Built<()> {
    let turn = joint.turn.iter().map(|t| {
        let still = t.cosine_deg.is_empty() && t.sine_deg.is_empty();
        ("turn".to_owned(), t.frequency_hz, still)
    });
    let travel = joint.travel.iter().map(|t| {
        let still = t.cosine_m.is_empty() && t.sine_m.is_empty();
        ("travel".to_owned(), t.frequency_hz, still)
    });
    let along = joint.element.iter().enumerate().flat_map(|(k, e)| {
        let follow = e.follow.as_ref().map(|f| &f.angle_deg);
        let efforts = [
            ("moment_newton_m", e.moment_newton_m.as_ref()),
            ("force_newton", e.force_newton.as_ref()),
            ("follow.angle_deg", follow),
        ];
        efforts.into_iter().filter_map(move |(key, series)| {
            let s = series?;
            let still = s.cosine.is_empty() && s.sine.is_empty();
            Some((format!("element[{k}].{key}"), s.frequency_hz, still))
        })
    });
    for (key, frequency, still) in turn.chain(travel).chain(along) {
        if !still && frequency.unwrap_or(beat) == 0.0 {
            return Err(Fault::new(
                format!("joint.{name}.{key}"),
                "its sines and cosines stand still at a frequency of 0",
                "harmonics of a frequency above 0",
                "give frequency_hz here or in [motion], or the mean alone",
            ));
        }
    }
    Ok(())
}
