//! Gaussian elimination with partial pivoting for small, mostly empty matrices.
//!
//! The saddle-point matrix of seed eq. 30 is 30 x 30 with block structure; elimination that skips
//! zero multipliers costs a fraction of a dense factorisation and needs no set-up.

/// The pivot of a column vanished: the matrix is singular.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is singular: no pivot in column {column}")]
pub struct SingularMatrix {
    /// The column without a pivot.
    pub column: usize,
}

/// Solves `A x = b` in place: `a` (row-major, n x n) is destroyed, `b` becomes x. Rows are
/// exchanged for the largest pivot, so scale the matrix before.
///
/// ```
/// let mut a = [0.0, 2.0, 4.0, 0.0]; // 2 x_1 = 6, 4 x_0 = 4
/// let mut b = [6.0, 4.0];
/// wingbeat_math::solve_small(&mut a, &mut b).unwrap();
/// assert_eq!(b, [1.0, 3.0]);
/// ```
///
/// # Errors
/// [`SingularMatrix`] if a column has no finite pivot above round-off of the largest entry.
///
/// # Panics
/// If `a.len()` is not the square of `b.len()`.
pub fn solve_small(a: &mut [f64], b: &mut [f64]) -> Result<(), SingularMatrix> {
    let n = b.len();
    assert_eq!(a.len(), n * n, "a {n} x {n} matrix is needed");
    let largest = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let negligible = n as f64 * f64::EPSILON * largest;
    for k in 0..n {
        exchange_pivot(a, b, k, negligible)?;
        eliminate_below(a, b, k);
    }
    substitute_back(a, b);
    Ok(())
}

/// Brings the largest entry of column k on or below the diagonal to the diagonal.
fn exchange_pivot(
    a: &mut [f64],
    b: &mut [f64],
    k: usize,
    negligible: f64,
) -> Result<(), SingularMatrix> {
    let n = b.len();
    let (mut p, mut largest) = (k, 0.0);
    for i in k..n {
        let size = a[i * n + k].abs();
        if size > largest {
            (p, largest) = (i, size);
        }
    }
    if !(largest > negligible && largest.is_finite()) {
        return Err(SingularMatrix { column: k });
    }
    if p != k {
        let (upper, lower) = a.split_at_mut(p * n);
        upper[k * n..(k + 1) * n].swap_with_slice(&mut lower[..n]);
        b.swap(k, p);
    }
    Ok(())
}

/// Subtracts multiples of row k from the rows below, skipping rows with a zero in column k.
fn eliminate_below(a: &mut [f64], b: &mut [f64], k: usize) {
    let n = b.len();
    let (upper, lower) = a.split_at_mut((k + 1) * n);
    let pivot_row = &upper[k * n + k..];
    let inverse = 1.0 / pivot_row[0];
    let bk = b[k];
    for (row, bi) in lower.chunks_exact_mut(n).zip(&mut b[k + 1..]) {
        let row = &mut row[k..];
        if row[0] != 0.0 {
            let factor = row[0] * inverse;
            for (x, p) in row[1..].iter_mut().zip(&pivot_row[1..]) {
                *x -= factor * p;
            }
            *bi -= factor * bk;
        }
    }
}

/// Solves the upper triangle.
fn substitute_back(a: &[f64], b: &mut [f64]) {
    let n = b.len();
    for k in (0..n).rev() {
        let row = &a[k * n..(k + 1) * n];
        let tail: f64 = row[k + 1..]
            .iter()
            .zip(&b[k + 1..])
            .map(|(x, y)| x * y)
            .sum();
        b[k] = (b[k] - tail) / row[k];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_solution_of_a_matrix_that_needs_pivoting() {
        // Cyclic shift plus a rank-one part with a zero diagonal; x = (1, 2, ..., n) by construction.
        let n = 12;
        let entry = |i: usize, j: usize| {
            f64::from(u8::from((i + 1) % n == j))
                + 0.1 * ((i * j) as f64).sin() * f64::from(u8::from(i != j))
        };
        let mut a: Vec<f64> = (0..n * n).map(|e| entry(e / n, e % n)).collect();
        let x = |j: usize| (j + 1) as f64;
        let mut b: Vec<f64> = (0..n)
            .map(|i| (0..n).map(|j| entry(i, j) * x(j)).sum())
            .collect();
        solve_small(&mut a, &mut b).unwrap();
        for j in 0..n {
            assert!((b[j] - x(j)).abs() < 1e-12); // condition number of order 10, x of order 10
        }
    }

    #[test]
    fn exact_singular_matrix_is_named() {
        let mut a = [1.0, 2.0, 2.0, 4.0];
        assert_eq!(
            solve_small(&mut a, &mut [1.0, 1.0]),
            Err(SingularMatrix { column: 1 })
        );
    }
}
