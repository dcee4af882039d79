//! Starting values of order four (error of y three steps on: fifth power of h) by iterating the
//! implicit block formulas that integrate the cubic through f[0] to f[3]
//! [Hairer, Norsett & Wanner, Solving ODEs I, sec. III.1, ex. 1]:
//!
//! ```text
//! y1 = y0 +  h/24 (9 f0 + 19 f1 - 5 f2 + f3)
//! y2 = y0 +  h/3  (f0 + 4 f1 + f2)
//! y3 = y0 + 3h/8  (f0 + 3 f1 + 3 f2 + f3)
//! ```
//!
//! Each iteration sweeps once over the three steps in order, so a right-hand side with a history
//! (a wake) is replayed from the start with the current iterate.

use super::hamming::{Convergence, Multistep, StepReport};
use super::{StepError, scaled_difference};

/// Three starting steps of size `step` from `y0`. `sweep(y, f)` fills the rates `f[k]` of the
/// four states `y[k]` at the times `t0 + k h`, in order.
///
/// # Errors
/// The right-hand side fails; the iteration does not converge to `convergence.tolerance` (a zero
/// tolerance makes `max_passes` sweeps and never fails).
pub fn block_start<E>(
    y0: &[f64],
    step: f64,
    convergence: Convergence,
    scales: &[f64],
    mut sweep: impl FnMut(&[Vec<f64>; 4], &mut [Vec<f64>; 4]) -> Result<(), E>,
) -> Result<(Multistep, StepReport), StepError<E>> {
    let mut y: [Vec<f64>; 4] = std::array::from_fn(|_| y0.to_vec());
    let mut f: [Vec<f64>; 4] = std::array::from_fn(|_| vec![0.0; y0.len()]);
    let mut next = y.clone();
    let mut report = StepReport::default();
    loop {
        sweep(&y, &mut f).map_err(StepError::Rates)?;
        let done = report.passes > 0 && report.residual <= convergence.tolerance;
        if done || report.passes == convergence.max_passes {
            break;
        }
        block_formulas(y0, step, &f, &mut next);
        report.passes += 1;
        report.residual = (1..4)
            .map(|k| scaled_difference(&next[k], &y[k], scales))
            .fold(0.0, f64::max);
        for (y, n) in y.iter_mut().zip(&next) {
            for (a, b) in y.iter_mut().zip(n) {
                *a += convergence.relaxation * (b - *a);
            }
        }
    }
    let failed = report.residual > convergence.tolerance && convergence.tolerance > 0.0;
    if failed || !report.residual.is_finite() {
        return Err(StepError::NotConverged(report));
    }
    Ok((Multistep::from_start(y, f), report))
}

/// The three block formulas.
fn block_formulas(y0: &[f64], h: f64, f: &[Vec<f64>; 4], y: &mut [Vec<f64>; 4]) {
    let [f0, f1, f2, f3] = f;
    for i in 0..y0.len() {
        let (a, b, c, d) = (f0[i], f1[i], f2[i], f3[i]);
        y[1][i] = y0[i] + h / 24.0 * (9.0 * a + 19.0 * b - 5.0 * c + d);
        y[2][i] = y0[i] + h / 3.0 * (a + 4.0 * b + c);
        y[3][i] = y0[i] + 3.0 * h / 8.0 * (a + 3.0 * b + 3.0 * c + d);
    }
}
