//! Corrector passes: when they are done, how a step went, and why one fails.

use crate::nonlinear::secants::{Secants, Shown};

/// Most differences of passes that are kept for the next step.
const MAX_KEPT: usize = 8;

/// Differences of passes over the largest of them below which they are rounding and not kept \[1\].
const TELLING: f64 = 1e-3;

/// Part of a difference of passes that others leave, below which it is left out \[1\]: states that are mirror images of
/// themselves stay so to 1e3 times the rounding.
const DEPENDENT: f64 = 1e-3;

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
    /// First pass from which least squares of the passes before speed the next ones up ([`Secants`]); none for
    /// plain passes.
    pub accelerated_from: Option<usize>,
}

/// How a trial goes over into the next one: plainly, or by what the passes of this step have shown.
#[derive(Clone, Debug)]
pub(super) struct Passing {
    secants: Secants,
    change: Vec<f64>,
}

impl Default for Passing {
    fn default() -> Self {
        Self {
            secants: Secants::leaving_out(DEPENDENT),
            change: vec![],
        }
    }
}

impl Passing {
    /// The first pass of another step is next, which begins with what former ones have shown.
    pub fn begin(&mut self, shown: &[Shown]) {
        self.secants.begin(shown);
    }

    /// So many `passes` of the step agree: what they have shown is left for the next, unless all were plain.
    pub fn end(&mut self, c: &Convergence, passes: usize, shown: &mut Vec<Shown>) {
        match c.accelerated_from.is_some_and(|from| passes >= from) {
            true => (self.secants).keep(TELLING, MAX_KEPT, shown),
            false => self.secants.keep_none(shown),
        }
    }

    /// The trial after pass number `pass`, which led from `trial` to `corrected`; components of infinite scale
    /// follow plainly.
    pub fn go_on(
        &mut self,
        c: &Convergence,
        pass: usize,
        (trial, corrected): (&mut [f64], &[f64]),
        scales: &[f64],
    ) {
        let Some(from) = c.accelerated_from else {
            let all = trial.iter_mut().zip(corrected);
            return all.for_each(|(x, c_x)| *x += c.relaxation * (c_x - *x));
        };
        self.change.clear();
        let all = trial.iter().zip(corrected).zip(scales);
        let change = |((x, to), s): ((&f64, &f64), &f64)| c.relaxation * (to - x) / s;
        (self.change).extend(all.filter(|(_, s)| s.is_finite()).map(change));
        let is_plain = pass < from;
        match is_plain {
            true => self.secants.watch(&self.change),
            false => self.secants.accelerate(&mut self.change),
        }
        let mut changes = self.change.iter();
        for ((x, to), s) in trial.iter_mut().zip(corrected).zip(scales) {
            let change = if s.is_finite() { changes.next() } else { None };
            match change.filter(|_| !is_plain) {
                Some(change) => *x += s * change,
                None => *x += c.relaxation * (to - *x),
            }
        }
    }
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
    (passing, shown): (&mut Passing, &mut Vec<Shown>),
    mut pass: impl FnMut(&[f64], &mut [f64]) -> Result<(), E>,
) -> Result<StepReport, StepError<E>> {
    let mut report = StepReport::default();
    passing.begin(shown);
    while report.passes < convergence.max_passes {
        pass(trial, corrected).map_err(StepError::Rates)?;
        report.passes += 1;
        report.residual = scaled_difference(corrected, trial, scales);
        if report.residual <= convergence.tolerance {
            passing.end(&convergence, report.passes, shown);
            return Ok(report);
        }
        passing.go_on(&convergence, report.passes, (trial, corrected), scales);
    }
    if convergence.tolerance > 0.0 || !report.residual.is_finite() {
        return Err(StepError::NotConverged(report));
    }
    passing.end(&convergence, report.passes, shown);
    Ok(report)
}
