//! Tethers and wings that move at one frequency, and start differently.

use wingbeat_math::DriftingFourier;
use wingbeat_model::Start;

use crate::setup::prescribed::PrescribedMotion;
use crate::setup::{FlightSetup, MotionMode};

/// Part of a period that is rounding \[1\].
const ROUNDING: f64 = 1e-6;

impl FlightSetup {
    /// Says by which part of its period the motion of a tether is ahead of the strokes, or behind, because one of them
    /// starts smoothly: which counts where it oscillates at the wingbeat frequency or a multiple of it.
    pub fn starts_apart(&self) -> Option<String> {
        let beat = 1.0 / self.time.period?;
        let motion = tether(&self.mode)?;
        let wing = self.animal.wings.iter().find(|w| !w.is_still())?;
        let ahead = late(&wing.motion.start) - late(&motion.start);
        let laws = motion.position.iter().chain(&motion.angles);
        let apart = laws.filter_map(|law| apart(law, beat, ahead));
        let most = apart.max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        let side = if most > 0.0 { "ahead of" } else { "behind" };
        Some(format!(
            "the tether (flight.tether) oscillates at the wingbeat frequency or a multiple of it and is {:.3} of its period {side} where the wings' angles put it, as they start differently: take motion.start = \"impulsive\" and no flight.tether.start_s, or give flight.tether.start_s the length of the wings' start (motion.start_beats over motion.frequency_hz)",
            most.abs()
        ))
    }
}

/// What moves the body, for as long as it is held.
pub(super) fn tether(mode: &MotionMode) -> Option<&PrescribedMotion> {
    match mode {
        MotionMode::Tethered(motion) => Some(motion),
        MotionMode::Free(start) => start.held_motion.as_deref(),
    }
}

/// By how much a motion is late once its start is over \[s\].
fn late(start: &Start) -> f64 {
    match start {
        Start::Impulsive => 0.0,
        Start::Smooth { duration } => 0.5 * duration,
    }
}

/// Part of its period, -1/2 to 1/2, by which an oscillation at the frequency `beat` \[Hz\] or a multiple of it is
/// ahead after `time` \[s\] \[1\]; none of what is in step, or oscillates otherwise.
fn apart(law: &DriftingFourier, beat: f64, time: f64) -> Option<f64> {
    let ratio = law.frequency / beat;
    let is_multiple = ratio.round() >= 1.0 && (ratio - ratio.round()).abs() < ROUNDING * ratio;
    let turns = law.frequency * time;
    let apart = turns - turns.round();
    (law.oscillates() && is_multiple && apart.abs() > ROUNDING).then_some(apart)
}
