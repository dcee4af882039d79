//! Derivative of a map at a point.

use crate::progress;

/// Derivative of `map` at `x` by fourth-order central differences with steps `step[k]`, by rows:
/// entry (i, j) is the derivative of component i by component j.
///
/// The map may have more or fewer components than the point. For the map "state one period later" this is the
/// monodromy matrix, its eigenvalues Floquet's multipliers.
///
/// # Errors
/// What the map reports.
pub fn jacobian<E>(
    map: impl Fn(&[f64]) -> Result<Vec<f64>, E>,
    x: &[f64],
    step: &[f64],
) -> Result<Vec<f64>, E> {
    let n = x.len();
    let rows = map(x)?.len();
    let mut m = vec![0.0; rows * n];
    for j in 0..n {
        progress::task("slopes of the map", j, n);
        let at = |s: f64| {
            let mut x = x.to_vec();
            x[j] += s * step[j];
            map(&x)
        };
        let (p1, m1, p2, m2) = (at(1.0)?, at(-1.0)?, at(2.0)?, at(-2.0)?);
        for i in 0..rows {
            let slope = 8.0 * (p1[i] - m1[i]) - (p2[i] - m2[i]);
            m[i * n + j] = slope / (12.0 * step[j]);
        }
    }
    Ok(m)
}
