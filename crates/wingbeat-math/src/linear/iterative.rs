//! Stabilised biconjugate gradients, for systems of which something near the inverse is known.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::matrix_free::bicgstab::{BicgParams, bicgstab, bicgstab_scratch};
use faer::matrix_free::{IdentityPrecond, LinOp, Precond};
use faer::{MatMut, MatRef, Par};
use std::fmt;

/// Solves `A x = b` with A and something near its inverse given as functions
/// [van der Vorst 1992, SIAM J. Sci. Stat. Comput. 13:631]; keeps its memory between solutions.
///
/// What is not left to the two functions runs on one thread: the same system, the same bits.
///
/// ```
/// use wingbeat_math::BiCgStab;
/// let multiply = |x: &[f64], out: &mut [f64]| {
///     out[0] = 4.0 * x[0] + x[1];
///     out[1] = x[0] - 2.0 * x[1];
/// };
/// let nearly_divide = |x: &[f64], out: &mut [f64]| (out[0], out[1]) = (x[0] / 4.0, -x[1] / 2.0);
/// let mut x = [0.0, 0.0];
/// assert!(BiCgStab::default().solve(&multiply, &nearly_divide, &[6.0, -3.0], &mut x));
/// assert!((x[0] - 1.0).abs() < 1e-13 && (x[1] - 2.0).abs() < 1e-13);
/// ```
#[derive(Default)]
pub struct BiCgStab {
    order: usize,
    scratch: Option<MemBuffer>,
    check: Vec<f64>,
}

/// Norm of `b - A x` over that of `b` that is small enough.
const RESIDUAL: f64 = 1e-13;

/// How much larger the residual may be when it is computed again: some roundings of a matrix with some hundred
/// columns.
const DRIFT: f64 = 4.0;

/// Steps after which there is no hope: a system worth solving this way needs ten.
const STEPS: usize = 40;

/// A product of a matrix, or of something near its inverse, with a vector: (vector, product).
pub type Product<'a> = dyn Fn(&[f64], &mut [f64]) + Sync + 'a;

impl BiCgStab {
    /// Replaces `x`, a guess, by the solution; says whether that went well, that is whether the norm of what is left
    /// of `b` is below 4e-13 of that of `b`.
    ///
    /// # Panics
    /// If `b` and `x` differ in length.
    pub fn solve(
        &mut self,
        multiply: &Product,
        nearly_divide: &Product,
        b: &[f64],
        x: &mut [f64],
    ) -> bool {
        let n = b.len();
        assert_eq!(n, x.len(), "as many unknowns as equations");
        let [a, near] = [multiply, nearly_divide].map(|product| Operator { n, product });
        let none = IdentityPrecond { dim: n };
        if self.order != n || self.scratch.is_none() {
            let room = bicgstab_scratch::<f64>(none, &near, &a, 1, Par::Seq);
            (self.order, self.scratch) = (n, Some(MemBuffer::new(room)));
        }
        let scratch = self.scratch.as_mut().expect("just made");
        let params = BicgParams {
            rel_tolerance: RESIDUAL,
            max_iters: STEPS,
            ..BicgParams::default()
        };
        let found = bicgstab(
            MatMut::from_column_major_slice_mut(x, n, 1),
            none,
            &near,
            &a,
            MatRef::from_column_major_slice(b, n, 1),
            params,
            |_| {},
            Par::Seq,
            MemStack::new(scratch),
        );
        found.is_ok() && self.is_solution(multiply, b, x)
    }

    /// The method carries its residual along; this is the true one.
    fn is_solution(&mut self, multiply: &Product, b: &[f64], x: &[f64]) -> bool {
        self.check.resize(b.len(), 0.0);
        multiply(x, &mut self.check);
        let left: f64 = (self.check.iter().zip(b))
            .map(|(c, b)| (b - c).powi(2))
            .sum();
        let norm: f64 = b.iter().map(|b| b * b).sum();
        left <= (DRIFT * RESIDUAL).powi(2) * norm
    }
}

/// A product in faer's words.
struct Operator<'a> {
    n: usize,
    product: &'a Product<'a>,
}

impl fmt::Debug for Operator<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "operator of order {}", self.n)
    }
}

impl LinOp<f64> for Operator<'_> {
    fn apply_scratch(&self, _: usize, _: Par) -> StackReq {
        StackReq::EMPTY
    }

    fn nrows(&self) -> usize {
        self.n
    }

    fn ncols(&self) -> usize {
        self.n
    }

    fn apply(&self, out: MatMut<'_, f64>, rhs: MatRef<'_, f64>, _: Par, _: &mut MemStack) {
        let whole = "one column, whole";
        let rhs = rhs.col(0).try_as_col_major().expect(whole).as_slice();
        let out = out.col_mut(0).try_as_col_major_mut().expect(whole);
        (self.product)(rhs, out.as_slice_mut());
    }

    fn conj_apply(&self, out: MatMut<'_, f64>, rhs: MatRef<'_, f64>, par: Par, s: &mut MemStack) {
        self.apply(out, rhs, par, s);
    }
}

impl Precond<f64> for Operator<'_> {}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix with its largest entries on the diagonal, and the product with it.
    fn near_diagonal(n: usize) -> impl Fn(&[f64], &mut [f64]) + Sync {
        let entry = move |i: usize, j: usize| match i == j {
            true => 1.0 + i as f64,
            false => ((i + 3 * j) as f64).sin() / n as f64,
        };
        move |x, out| {
            for (i, out) in out.iter_mut().enumerate() {
                *out = x.iter().enumerate().map(|(j, x)| entry(i, j) * x).sum();
            }
        }
    }

    fn divide(x: &[f64], out: &mut [f64]) {
        for (i, (x, out)) in x.iter().zip(out).enumerate() {
            *out = x / (1.0 + i as f64);
        }
    }

    #[test]
    fn exact_solution_is_recovered_from_any_guess() {
        let (n, mut method) = (60, BiCgStab::default());
        let multiply = near_diagonal(n);
        let truth: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
        let mut b = vec![0.0; n];
        multiply(&truth, &mut b);
        for guess in [0.0, 1.0, -100.0] {
            let mut x = vec![guess; n];
            assert!(method.solve(&multiply, &divide, &b, &mut x));
            // 4e-13 of a norm of some 200, the matrix divides by 1 or more.
            let error = x.iter().zip(&truth).map(|(x, t)| (x - t).abs());
            assert!(error.fold(0.0, f64::max) < 1e-10);
        }
    }

    #[test]
    fn exact_nothing_for_nothing_and_no_solution_where_there_is_none() {
        let mut method = BiCgStab::default();
        let mut x = [1.0, 2.0];
        let multiply = |x: &[f64], out: &mut [f64]| out.fill(x[0] + x[1]); // singular
        let keep = |x: &[f64], out: &mut [f64]| out.copy_from_slice(x);
        assert!(method.solve(&multiply, &keep, &[0.0, 0.0], &mut x));
        assert_eq!(x, [0.0, 0.0]);
        assert!(!method.solve(&multiply, &keep, &[1.0, 2.0], &mut x));
        assert!(!method.solve(&multiply, &keep, &[1.0, f64::NAN], &mut x));
    }
}
