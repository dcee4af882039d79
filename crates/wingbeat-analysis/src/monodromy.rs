//! Derivative of a map at a point, and what can be checked of it.

use crate::progress;

/// Derivative of `map` at `x` by fourth-order central differences with steps `step[k]`, by rows:
/// entry (i, j) is the derivative of component i by component j.
///
/// The map may have more or fewer components than the point. For the map "state one period later" this is the monodromy matrix, its eigenvalues Floquet's
/// multipliers.
///
/// # Errors
/// What the map reports.
pub fn monodromy<E>(
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

/// Determinant of the n x n matrix `a` given by rows, by elimination with row exchanges.
pub fn determinant(a: &[f64], n: usize) -> f64 {
    let mut a = a.to_vec();
    let mut d = 1.0;
    for k in 0..n {
        let size = |i: &usize| a[i * n + k].abs();
        let p = (k..n)
            .max_by(|i, j| size(i).total_cmp(&size(j)))
            .unwrap_or(k);
        if a[p * n + k] == 0.0 {
            return 0.0;
        }
        if p != k {
            (0..n).for_each(|j| a.swap(p * n + j, k * n + j));
            d = -d;
        }
        d *= a[k * n + k];
        for i in k + 1..n {
            let f = a[i * n + k] / a[k * n + k];
            (k..n).for_each(|j| a[i * n + j] -= f * a[k * n + j]);
        }
    }
    d
}
