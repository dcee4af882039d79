//! Newton-Raphson for small systems of equations.

use crate::linear::small_lu::{SingularMatrix, solve_small};
use crate::numbers::extremes::larger;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonSettings {
    /// Largest residual allowed \[1\]; scale the equations so that one number serves them all.
    pub tolerance: f64,
    /// Most iterations allowed.
    pub max_iterations: usize,
}

/// Why Newton's iteration ended without a solution.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NewtonError {
    /// The iteration did not reach the tolerance.
    #[error(
        "Newton's iteration has residual {residual:.2e} after {iterations} iterations, {tolerance:.0e} is needed"
    )]
    NotConverged {
        /// Largest residual at the end.
        residual: f64,
        /// Iterations made.
        iterations: usize,
        /// The residual that was needed.
        tolerance: f64,
    },
    /// The Jacobian is singular.
    #[error("the Jacobian of Newton's iteration is singular: {0}")]
    Singular(#[from] SingularMatrix),
}

/// Solves `f(x) = 0`; returns the number of iterations. `f` fills the residual and the Jacobian
/// (row-major, derivative of residual i by x_j at `i * n + j`).
///
/// ```
/// use wingbeat_math::newton::{NewtonSettings, newton};
/// let mut x = [1.0];
/// let settings = NewtonSettings { tolerance: 1e-14, max_iterations: 10 };
/// newton(&mut x, settings, |x, r, j| { r[0] = x[0] * x[0] - 2.0; j[0] = 2.0 * x[0]; }).unwrap();
/// assert!((x[0] - 2.0_f64.sqrt()).abs() < 1e-15);
/// ```
///
/// # Errors
/// [`NewtonError`]: no convergence, or a singular Jacobian.
pub fn newton(
    x: &mut [f64],
    settings: NewtonSettings,
    mut f: impl FnMut(&[f64], &mut [f64], &mut [f64]),
) -> Result<usize, NewtonError> {
    let n = x.len();
    let (mut residual, mut jacobian) = (vec![0.0; n], vec![0.0; n * n]);
    for iteration in 0..=settings.max_iterations {
        jacobian.fill(0.0);
        f(x, &mut residual, &mut jacobian);
        let size = residual.iter().fold(0.0, |a, r| larger(a, r.abs()));
        if size <= settings.tolerance {
            return Ok(iteration);
        }
        if iteration == settings.max_iterations || !size.is_finite() {
            return Err(NewtonError::NotConverged {
                residual: size,
                iterations: iteration,
                tolerance: settings.tolerance,
            });
        }
        solve_small(&mut jacobian, &mut residual)?;
        x.iter_mut().zip(&residual).for_each(|(x, d)| *x -= d);
    }
    unreachable!("the last iteration returns")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_intersection_of_circle_and_line() {
        let mut x = [2.0, 0.5];
        let settings = NewtonSettings {
            tolerance: 1e-14,
            max_iterations: 20,
        };
        let n = newton(&mut x, settings, |x, r, j| {
            r[0] = x[0] * x[0] + x[1] * x[1] - 25.0;
            r[1] = x[1] - 0.75 * x[0];
            j.copy_from_slice(&[2.0 * x[0], 2.0 * x[1], -0.75, 1.0]);
        });
        assert!(n.unwrap() < 8); // quadratic convergence
        assert!((x[0] - 4.0).abs() < 1e-14 && (x[1] - 3.0).abs() < 1e-14); // (4, 3)
    }

    #[test]
    fn refuses_residuals_that_are_no_numbers() {
        let settings = NewtonSettings {
            tolerance: 1e-12,
            max_iterations: 5,
        };
        for k in 0..2 {
            let e = newton(&mut [0.5, 0.5], settings, |_, r, j| {
                r.fill(0.0);
                r[k] = f64::NAN;
                j.copy_from_slice(&[1.0, 0.0, 0.0, 1.0]);
            });
            assert!(
                matches!(e, Err(NewtonError::NotConverged { residual, iterations: 0, .. }) if residual.is_nan())
            );
        }
    }

    #[test]
    fn exact_no_root_is_an_error_with_its_residual() {
        let settings = NewtonSettings {
            tolerance: 1e-12,
            max_iterations: 5,
        };
        let e = newton(&mut [0.5], settings, |x, r, j| {
            r[0] = 1.0 + x[0] * x[0];
            j[0] = 2.0 * x[0];
        });
        assert!(
            matches!(e, Err(NewtonError::NotConverged { residual, iterations: 5, .. }) if residual >= 1.0)
        );
    }
}
