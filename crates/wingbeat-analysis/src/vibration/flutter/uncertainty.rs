//! What is not known of the growth of a mode.
//!
//! The same mode is found in other responses of the same wing: twice the one to half the disturbance (what is
//! not linear, and rounding, which weighs twice there) and the first part of the response (what depends on its
//! length). Errors of an eigenvalue have no preferred direction in the complex plane: growth is as little known
//! as the eigenvalue moves. A mode that is not found again is not known at all. What the fit leaves of the
//! response could be of this mode, too: a residual of the part `r` changes the amplitude of a mode of the share
//! `s` by `r / s` within the length `T` of the response, its growth by `r / (s T)`.
//!
//! What the step `h` of the flight does to a mode is the same in all responses. Methods of second order move an
//! eigenvalue `lambda` by about `|lambda|^3 h^2 / 12` (the trapezoidal rule and generalized-alpha without
//! dissipation), of a wing alone along its frequency, with loads in either direction: modes of few steps a
//! period are neutral.

use wingbeat_math::larger;

use crate::AnalysisError;
use crate::vibration::realisation::{Realisation, Sampled, Vibration, realise_sampled};

/// Uncertainty of the growth of each of `modes` [1/s], found in `response`, which is `taken`; `others` are responses of
/// the same wing, sampled as often.
pub(super) fn uncertainties(
    modes: &[Vibration],
    response: &Realisation,
    taken: &Sampled,
    others: &[Sampled],
) -> Result<Vec<f64>, AnalysisError> {
    let found = others.iter().map(realise_sampled);
    let found = found.collect::<Result<Vec<_>, _>>()?;
    let length = taken.count() as f64 * taken.apart();
    let of = |m: &Vibration| {
        let moved = found.iter().map(|f| nearest(m, f));
        let size = m.growth.hypot(m.frequency);
        let stepped = size * (size * taken.step).powi(2) / 12.0;
        moved.fold(0.0, larger) + response.residual / (m.share * length) + stepped
    };
    Ok(modes.iter().map(of).collect())
}

/// Distance to the nearest eigenvalue [1/s], of those, too, whose frequency is not known; infinite where there is none.
fn nearest(m: &Vibration, found: &Realisation) -> f64 {
    let all = found.vibrations.iter().chain(&found.untold);
    all.map(|v| m.distance(v)).fold(f64::INFINITY, f64::min)
}
