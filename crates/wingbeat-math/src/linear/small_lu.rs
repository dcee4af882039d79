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
    let negligible = negligible(a, n);
    for k in 0..n {
        let pivot = exchange_pivot(a, n, k, negligible)?;
        b.swap(k, pivot);
        let bk = b[k];
        eliminate_below(a, n, k, |i, factor| b[i] -= factor * bk);
    }
    substitute_back(a, b);
    Ok(())
}

/// A matrix that is eliminated once, for many right-hand sides: to the last bit what [`solve_small`] has for each.
///
/// ```
/// let lu = wingbeat_math::SmallLu::new(vec![0.0, 2.0, 4.0, 0.0], 2).unwrap(); // 2 x_1, 4 x_0
/// let mut b = [6.0, 4.0];
/// lu.solve(&mut b);
/// assert_eq!(b, [1.0, 3.0]);
/// ```
#[derive(Clone, Debug)]
pub struct SmallLu {
    /// The upper triangle, by rows.
    upper: Vec<f64>,
    /// Column by column: the row that was exchanged, and rows below with their multipliers.
    steps: Vec<(usize, Vec<(usize, f64)>)>,
}

impl SmallLu {
    /// Of the matrix `a` (row-major, n x n).
    ///
    /// # Errors
    /// As [`solve_small`].
    ///
    /// # Panics
    /// If `a` has not n x n entries.
    pub fn new(mut a: Vec<f64>, n: usize) -> Result<Self, SingularMatrix> {
        assert_eq!(a.len(), n * n, "a {n} x {n} matrix is needed");
        let negligible = negligible(&a, n);
        let step = |k: usize| {
            let (pivot, mut below) = (exchange_pivot(&mut a, n, k, negligible)?, vec![]);
            eliminate_below(&mut a, n, k, |i, factor| below.push((i, factor)));
            Ok((pivot, below))
        };
        let steps = (0..n).map(step).collect::<Result<_, _>>()?;
        Ok(Self { upper: a, steps })
    }

    /// Solves `A x = b` in place.
    pub fn solve(&self, b: &mut [f64]) {
        for (k, (pivot, below)) in self.steps.iter().enumerate() {
            b.swap(k, *pivot);
            let bk = b[k];
            below.iter().for_each(|(i, factor)| b[*i] -= factor * bk);
        }
        substitute_back(&self.upper, b);
    }
}

/// A pivot up to here is round-off.
fn negligible(a: &[f64], n: usize) -> f64 {
    n as f64 * f64::EPSILON * crate::numbers::extremes::largest(a.iter().map(|x| x.abs()))
}

/// Brings the largest entry of column k on or below the diagonal to the diagonal; returns its row.
fn exchange_pivot(
    a: &mut [f64],
    n: usize,
    k: usize,
    negligible: f64,
) -> Result<usize, SingularMatrix> {
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
    }
    Ok(p)
}

/// Subtracts multiples of row k from the rows below, skipping rows with a zero in column k; tells rows and multipliers.
fn eliminate_below(a: &mut [f64], n: usize, k: usize, mut tell: impl FnMut(usize, f64)) {
    let (upper, lower) = a.split_at_mut((k + 1) * n);
    let pivot_row = &upper[k * n + k..];
    let inverse = 1.0 / pivot_row[0];
    for (i, row) in (k + 1..).zip(lower.chunks_exact_mut(n)) {
        let row = &mut row[k..];
        if row[0] != 0.0 {
            let factor = row[0] * inverse;
            for (x, p) in row[1..].iter_mut().zip(&pivot_row[1..]) {
                *x -= factor * p;
            }
            tell(i, factor);
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

    /// The same operations in the same order.
    #[test]
    fn exact_many_right_hand_sides_have_the_bits_of_one() {
        let n = 9;
        let entry =
            |e: usize| ((e * e) as f64 * 0.37).sin() * f64::from(u8::from(!e.is_multiple_of(5)));
        let a: Vec<f64> = (0..n * n).map(entry).collect();
        let lu = SmallLu::new(a.clone(), n).unwrap();
        for column in 0..4 {
            let b: Vec<f64> = (0..n).map(|i| ((i + 7 * column) as f64).cos()).collect();
            let (mut one, mut other) = (b.clone(), b);
            solve_small(&mut a.clone(), &mut one).unwrap();
            lu.solve(&mut other);
            let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&one), bits(&other));
        }
        let singular = SmallLu::new(vec![1.0, 2.0, 2.0, 4.0], 2).map(drop);
        assert_eq!(singular, Err(SingularMatrix { column: 1 }));
    }

    #[test]
    fn exact_singular_matrix_is_named() {
        let mut a = [1.0, 2.0, 2.0, 4.0];
        assert_eq!(
            solve_small(&mut a, &mut [1.0, 1.0]),
            Err(SingularMatrix { column: 1 })
        );
    }

    #[test]
    fn refuses_matrices_with_entries_that_are_not_numbers() {
        for k in 0..4 {
            let mut a = [1.0, 0.5, 0.0, 1.0];
            a[k] = f64::NAN;
            assert!(solve_small(&mut a, &mut [1.0, 1.0]).is_err(), "{k}");
        }
    }
}
