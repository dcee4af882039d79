//! Dense LU factorisation with partial pivoting, buffers kept between factorisations.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{MatMut, Par};

/// Factors of an n x n matrix, `P A = L U`, and the memory to compute them without allocating.
///
/// Always runs on one thread: the factorisation's rounding depends on how work is split, and the
/// same case has to give the same bits with any number of threads.
///
/// ```
/// let mut lu = wingbeat_math::DenseLu::new(2);
/// lu.factor(&[0.0, 2.0, 4.0, 1.0]).unwrap(); // rows (0, 2) and (4, 1)
/// let mut x = [6.0, 11.0];
/// lu.solve_in_place(&mut x);
/// assert_eq!(x, [2.0, 3.0]);
/// ```
pub struct DenseLu {
    n: usize,
    /// L (unit diagonal left out) and U, row-major.
    factors: Vec<f64>,
    perm: Vec<usize>,
    perm_inverse: Vec<usize>,
    scratch: MemBuffer,
    /// How much scratch there is.
    room: StackReq,
}

/// Why a matrix could not be factorised.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LuError {
    /// A pivot vanishes against the largest matrix entry.
    #[error(
        "the {n} x {n} matrix is singular: pivot {index} is {pivot:.3e} where the largest entry is {largest:.3e}"
    )]
    Singular {
        /// Order of the matrix.
        n: usize,
        /// Index of the pivot.
        index: usize,
        /// The pivot.
        pivot: f64,
        /// Largest absolute entry of the matrix.
        largest: f64,
    },
    /// An entry is infinite or not a number.
    #[error("entry ({row}, {col}) of the matrix is not a finite number")]
    NotFinite {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        col: usize,
    },
}

impl Default for DenseLu {
    /// No room yet.
    fn default() -> Self {
        Self::new(0)
    }
}

impl DenseLu {
    /// Room for matrices of order `n`.
    pub fn new(n: usize) -> Self {
        let mut lu = Self {
            n: 0,
            factors: vec![],
            perm: vec![],
            perm_inverse: vec![],
            scratch: MemBuffer::new(StackReq::EMPTY),
            room: StackReq::EMPTY,
        };
        lu.resize(n);
        lu
    }

    /// Room for matrices of order `n`, what was factorised forgotten where that is another one: nothing is allocated
    /// for an order that it had room for before.
    pub fn resize(&mut self, n: usize) {
        if self.n == n {
            return;
        }
        self.n = n;
        self.factors.resize(n * n, 0.0);
        self.perm.resize(n, 0);
        self.perm_inverse.resize(n, 0);
        let factor = factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Default::default());
        self.make_room(factor.or(solve::solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq)));
    }

    fn make_room(&mut self, wanted: StackReq) {
        let room = self.room.or(wanted);
        if room != self.room {
            self.room = room;
            self.scratch = MemBuffer::new(room);
        }
    }

    /// Order of the matrix.
    pub fn order(&self) -> usize {
        self.n
    }

    /// Factorises the matrix given by rows.
    ///
    /// # Errors
    /// [`LuError::Singular`] if a pivot is below `n` roundings of the largest entry,
    /// [`LuError::NotFinite`] if an entry is not a finite number. The factors are then not usable.
    ///
    /// # Panics
    /// If `rows` does not hold n x n numbers.
    pub fn factor(&mut self, rows: &[f64]) -> Result<(), LuError> {
        let n = self.n;
        assert_eq!(rows.len(), n * n, "a matrix of order {n} has n x n entries");
        if let Some(k) = rows.iter().position(|a| !a.is_finite()) {
            return Err(LuError::NotFinite {
                row: k / n,
                col: k % n,
            });
        }
        self.factors.copy_from_slice(rows);
        factor::lu_in_place(
            MatMut::from_row_major_slice_mut(&mut self.factors, n, n),
            &mut self.perm,
            &mut self.perm_inverse,
            Par::Seq,
            MemStack::new(&mut self.scratch),
            Default::default(),
        );
        self.check_pivots(rows)
    }

    fn check_pivots(&self, rows: &[f64]) -> Result<(), LuError> {
        let n = self.n;
        let largest = rows.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        for index in 0..n {
            let pivot = self.factors[index * n + index];
            if pivot.is_nan() || pivot.abs() <= n as f64 * f64::EPSILON * largest {
                return Err(LuError::Singular {
                    n,
                    index,
                    pivot,
                    largest,
                });
            }
        }
        Ok(())
    }

    /// Replaces the right-hand side `x` by the solution of `A x = b`.
    ///
    /// # Panics
    /// If `x` has not n entries.
    pub fn solve_in_place(&mut self, x: &mut [f64]) {
        let n = self.n;
        assert_eq!(x.len(), n, "the right-hand side has n entries");
        let lu = faer::MatRef::from_row_major_slice(&self.factors, n, n);
        // The permutation was made by the factorisation: checked construction costs nothing here.
        let perm = PermRef::new_checked(&self.perm, &self.perm_inverse, n);
        solve::solve_in_place(
            lu,
            lu,
            perm,
            MatMut::from_column_major_slice_mut(x, n, 1),
            Par::Seq,
            MemStack::new(&mut self.scratch),
        );
    }

    /// The inverse of the factorised matrix, by columns, into `columns`.
    pub fn inverse(&mut self, columns: &mut Vec<f64>) {
        let n = self.n;
        columns.clear();
        columns.resize(n * n, 0.0);
        columns.iter_mut().step_by(n + 1).for_each(|d| *d = 1.0);
        self.make_room(solve::solve_in_place_scratch::<usize, f64>(n, n, Par::Seq));
        let lu = faer::MatRef::from_row_major_slice(&self.factors, n, n);
        solve::solve_in_place(
            lu,
            lu,
            PermRef::new_checked(&self.perm, &self.perm_inverse, n),
            MatMut::from_column_major_slice_mut(columns, n, n),
            Par::Seq,
            MemStack::new(&mut self.scratch),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Entries scattered over (-1, 1) without pattern: dense, needs pivoting, condition of order n.
    fn scattered(n: usize) -> Vec<f64> {
        (0..n * n)
            .map(|k| (0.37 * ((k + 1) * (k + 1)) as f64).sin())
            .collect()
    }

    #[test]
    fn exact_solution_is_recovered_and_buffers_can_be_reused() {
        let mut lu = DenseLu::default();
        for n in [1, 64, 7] {
            lu.resize(n);
            let a = scattered(n);
            for shift in [0.0, 1.0] {
                let truth: Vec<f64> = (0..n).map(|i| (i as f64 + shift).cos()).collect();
                let mut x: Vec<f64> = (0..n)
                    .map(|i| (0..n).map(|j| a[i * n + j] * truth[j]).sum())
                    .collect();
                lu.factor(&a).unwrap();
                lu.solve_in_place(&mut x);
                // Condition below 1e5, some tens of roundings: 1e-10.
                assert!(
                    x.iter().zip(&truth).all(|(a, b)| (a - b).abs() < 1e-10),
                    "{n}"
                );
            }
        }
    }

    #[test]
    fn exact_product_with_the_inverse_is_the_unit_matrix() {
        let n = 30;
        let (mut lu, a) = (DenseLu::new(n), scattered(n));
        lu.factor(&a).unwrap();
        let mut columns = vec![];
        lu.inverse(&mut columns);
        for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
            let product: f64 = (0..n).map(|k| a[i * n + k] * columns[j * n + k]).sum();
            // As above.
            assert!((product - f64::from(u8::from(i == j))).abs() < 1e-10);
        }
    }

    #[test]
    fn exact_singular_and_infinite_matrices_are_refused() {
        let mut lu = DenseLu::new(3);
        let singular = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        assert!(matches!(
            lu.factor(&singular),
            Err(LuError::Singular { .. })
        ));
        assert!(matches!(
            lu.factor(&[0.0; 9]),
            Err(LuError::Singular { .. })
        ));
        let mut bad = singular;
        bad[5] = f64::NAN;
        assert_eq!(lu.factor(&bad), Err(LuError::NotFinite { row: 1, col: 2 }));
    }
}
