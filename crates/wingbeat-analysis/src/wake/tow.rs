//! The steady glide of a flyer in air with memory, or with wings that bend: it is towed with constant velocity and
//! attitude until its past no longer tells when the tow began, and what the tow has to carry is what lacks to a glide.
//!
//! In the lattice the wake grows as the tow goes on. Of a straight wake of the length L behind a span b the vortex at
//! which it began is felt by some (b / L)^2 / 4 of the wake's downwash: a tow that is twice as long has a quarter of
//! that, and what is left at the end is a third of what the second half of the way has changed. So tows are doubled
//! until this is small. Wakes of strips and bent wings are brought to rest as those of a periodic orbit are
//! ([`periodic_beat`]).

use wingbeat_flight::{FlightSetup, MotionMode, Past, Record, Simulation};
use wingbeat_math::{DVec3, larger};

use super::free_beat::start;
use super::orbit::periodic_beat;
use crate::AnalysisError;
use crate::beat::glide::period_of_glide;
use crate::progress;

/// How long a glider was towed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tow {
    /// Steps.
    pub steps: usize,
    /// Way through the air over the mean chord of all wings \[1\].
    pub chords: f64,
    /// By how much the loads changed over the second half of the way, over the weight, and weight times wing length
    /// \[1\]. Some third of it is what the start of the wake still makes at its end.
    pub change: f64,
}

/// Change of the loads over the second half of a tow below which its wake is long enough \[1\].
pub(super) const LONG: f64 = 1e-3;

/// Residuals that are good enough to tell how long a tow has to be \[1\].
pub(super) const COARSE: f64 = 1e-3;

/// Periods of a glide, sqrt(R / g) / 4, in the longest tow.
pub(super) const MAX_PERIODS: usize = 128;

/// Steps of the free flight that follows a tow at least: differences over fewer tell no rates.
const MIN_STEPS: usize = 4;

/// What is seen at the end of a tow.
pub(super) struct Towed {
    /// Force over the weight and moment about the mass centre over weight and wing length that lack to a steady glide,
    /// N components \[1\].
    pub lacks: [DVec3; 2],
    /// As [`Tow::change`].
    pub change: f64,
    /// Wakes of strips and bent wings.
    pub past: Past,
}

/// Steps of the case that make about the time by which a glide is analysed, at least some.
pub(super) fn steps_of_glide(setup: &FlightSetup) -> usize {
    let period = (setup.time.period).or_else(|| period_of_glide(setup));
    let steps = (period.unwrap_or(0.0) / setup.time.step).round();
    (steps as usize).max(MIN_STEPS)
}

/// The flyer of `setup` on a tow along the way of its hold.
fn on_tow(setup: &FlightSetup) -> FlightSetup {
    FlightSetup {
        mode: MotionMode::Tethered(start(setup).hold()),
        ..setup.clone()
    }
}

/// What the flyer of `setup` lacks after the steps of its hold, in air that keeps wakes.
///
/// # Errors
/// What the flight reports.
pub(super) fn tow_with_wake(setup: &FlightSetup) -> Result<Towed, AnalysisError> {
    let steps = start(setup).held_steps;
    let mut flight = Simulation::new(on_tow(setup))?;
    let mut halfway = [DVec3::ZERO; 2];
    for step in 1..=steps {
        if step % 10 == 0 {
            progress::task("tow", step, steps);
        }
        flight.step()?;
        if step == steps / 2 {
            halfway = lacks(setup, flight.record());
        }
    }
    let found = lacks(setup, flight.record());
    let changes = found.iter().zip(halfway).map(|(a, b)| *a - b);
    let largest = |x: DVec3| x.abs().max_element();
    Ok(Towed {
        lacks: found,
        change: changes.map(largest).fold(0.0, larger),
        past: Past::default(),
    })
}

/// What the flyer of `setup` lacks when its wings and the wakes of its strips are steady, sought from `past` on, or from
/// rest, for residuals within `tolerance`; and the periods of `steps` flown until then.
///
/// # Errors
/// What the flight reports; wings or wakes that do not come to rest.
pub(super) fn tow_to_rest(
    setup: &FlightSetup,
    steps: usize,
    past: Option<Past>,
    tolerance: f64,
) -> Result<(Towed, usize), AnalysisError> {
    let found = periodic_beat(&on_tow(setup), steps, past, tolerance)?;
    let [_, end] = &found.ends;
    let towed = Towed {
        lacks: lacks(setup, end),
        change: 0.0,
        past: found.pasts.into_iter().next_back().unwrap_or_default(),
    };
    Ok((towed, found.beats))
}

/// Force over the weight and moment about the mass centre over weight and wing length that the tow does not have to
/// carry \[1\], N components.
fn lacks(setup: &FlightSetup, record: &Record) -> [DVec3; 2] {
    let weight = setup.animal.mass() * setup.gravity.length();
    let root = DVec3::from_slice(&record.coordinates);
    let tether = &record.tether;
    let moment = tether.moment + (root - record.mass_centre).cross(tether.force);
    let length = setup.animal.wing_length();
    [-tether.force / weight, -moment / (weight * length)]
}
