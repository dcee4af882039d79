//! Corrector passes: when they are done, how a step went, and why one fails.

/// When the corrector is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence {
    /// Largest scaled change of the last pass [1]; 0 always makes `max_passes` passes and never
    /// fails.
    pub tolerance: f64,
    /// Most passes.
    pub max_passes: usize,
    /// Relaxation factor of a pass \[1\], above 0 and up to 1.
    pub relaxation: f64,
}

/// What happened in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct StepReport {
    /// Corrector passes made.
    pub passes: usize,
    /// Scaled change of the last pass \[1\].
    pub residual: f64,
}

/// Why a step failed.
#[derive(Clone, Debug, PartialEq)]
pub enum StepError<E> {
    /// The right-hand side failed.
    Rates(E),
    /// The corrector did not converge.
    NotConverged(StepReport),
}

/// What the rates of a state are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// A pass of the corrector: those of followers are not needed.
    Pass,
    /// The accepted state: all rates.
    Accepted,
}

/// Largest difference of two states in units of the natural sizes `scales` of their components;
/// an infinite scale takes a component out of the norm. Not a number counts as infinite.
pub fn scaled_difference(a: &[f64], b: &[f64], scales: &[f64]) -> f64 {
    let mut largest = 0.0_f64;
    for ((x, y), s) in a.iter().zip(b).zip(scales) {
        let d = (x - y).abs();
        if d.is_nan() {
            return f64::INFINITY;
        }
        if s.is_finite() {
            largest = largest.max(d / s);
        }
    }
    largest
}

/// Corrector passes from `trial` until two in succession agree; the last one is in `corrected`.
/// `pass(trial, corrected)` makes one.
///
/// # Errors
/// The right-hand side fails; the passes do not converge.
pub(super) fn agree<E>(
    convergence: Convergence,
    trial: &mut [f64],
    corrected: &mut [f64],
    scales: &[f64],
    mut pass: impl FnMut(&[f64], &mut [f64]) -> Result<(), E>,
) -> Result<StepReport, StepError<E>> {
    let mut report = StepReport::default();
    while report.passes < convergence.max_passes {
        pass(trial, corrected).map_err(StepError::Rates)?;
        report.passes += 1;
        report.residual = scaled_difference(corrected, trial, scales);
        if report.residual <= convergence.tolerance {
            return Ok(report);
        }
        for (x, c) in trial.iter_mut().zip(corrected.iter()) {
            *x += convergence.relaxation * (c - *x);
        }
    }
    if convergence.tolerance > 0.0 || !report.residual.is_finite() {
        return Err(StepError::NotConverged(report));
    }
    Ok(report)
}
