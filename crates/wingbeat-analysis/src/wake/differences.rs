//! The derivative of the free beat by differences of disturbed flights.
//!
//! A flight is disturbed by each component of a departure to either side, and departs by others soon after its
//! start and a wingbeat later. What takes the differences of the former into those of the latter is the map
//! over the beat.

use wingbeat_math::solve_small;

use crate::AnalysisError;
use crate::progress;

/// Derivatives of `order` components of a departure at first and a beat later, by the sizes of as many
/// disturbances, one column each; `fly` flies disturbance `k` of a size, which `step` gives.
///
/// # Errors
/// What the flights report.
pub(super) fn departures<D: AsRef<[f64]>>(
    order: usize,
    step: impl Fn(usize) -> f64,
    fly: impl Fn(usize, f64) -> Result<[D; 2], AnalysisError>,
) -> Result<[Vec<f64>; 2], AnalysisError> {
    let mut departures = [vec![0.0; order * order], vec![0.0; order * order]];
    for k in 0..order {
        let h = step(k);
        let told = |number, size| {
            progress::task("disturbed flights", number, 2 * order);
            fly(k, size)
        };
        let (plus, minus) = (told(2 * k, h)?, told(2 * k + 1, -h)?);
        for (columns, (plus, minus)) in departures.iter_mut().zip(plus.iter().zip(&minus)) {
            for (i, (plus, minus)) in plus.as_ref().iter().zip(minus.as_ref()).enumerate() {
                columns[order * i + k] = (plus - minus) / (2.0 * h);
            }
        }
    }
    Ok(departures)
}

/// The map of order `n` from the columns of `before` to those of `after`.
///
/// # Errors
/// Columns that depend on each other.
pub(super) fn map_between(
    [before, after]: &[Vec<f64>; 2],
    n: usize,
) -> Result<Vec<f64>, AnalysisError> {
    // after = M before: rows of M solve before^T m = after row.
    let mut matrix = Vec::with_capacity(n * n);
    for after in after.chunks_exact(n) {
        let mut transposed: Vec<f64> = (0..n * n).map(|e| before[n * (e % n) + e / n]).collect();
        let mut row = after.to_vec();
        solve_small(&mut transposed, &mut row)
            .map_err(|e| AnalysisError::Numbers(format!("the disturbances are dependent: {e}")))?;
        matrix.extend(row);
    }
    Ok(matrix)
}
