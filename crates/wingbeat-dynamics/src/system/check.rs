//! Checks of numbers, rotations and states that users give or integrators make.

use wingbeat_math::{DMat3, DVec3, largest};

use crate::error::DynamicsError;

/// Largest deviation of `r^T r` from the identity.
pub(crate) fn orthogonality_error(r: DMat3) -> f64 {
    let e = r.transpose() * r - DMat3::IDENTITY;
    largest(e.to_cols_array().map(f64::abs))
}

/// An error if `r` is not a rotation to 1e-9 (round-off of a long chain of products is below
/// 1e-12; a matrix typed with six digits is off by 1e-6).
pub(crate) fn check_rotation(
    r: DMat3,
    time: f64,
    what: impl FnOnce() -> String,
) -> Result<(), DynamicsError> {
    let (deviation, determinant) = (orthogonality_error(r), r.determinant());
    if deviation <= 1e-9 && determinant > 0.0 {
        return Ok(());
    }
    Err(DynamicsError::NotARotation {
        what: what(),
        time,
        deviation,
        determinant,
    })
}

pub(crate) fn check_finite(what: &str, v: DVec3) -> Result<(), DynamicsError> {
    match v.to_array().into_iter().find(|x| !x.is_finite()) {
        None => Ok(()),
        Some(value) => Err(bad_number(what, value, "")),
    }
}

pub(crate) fn check_positive(what: &str, value: f64) -> Result<(), DynamicsError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(bad_number(what, value, " > 0"))
}

fn bad_number(what: &str, value: f64, bound: &'static str) -> DynamicsError {
    DynamicsError::BadNumber {
        what: what.to_owned(),
        value,
        bound,
    }
}

/// An error if a component of the state is not finite; `name` says what the component of a number is.
pub(crate) fn check_state(
    time: f64,
    y: &[f64],
    name: fn(usize, usize) -> &'static str,
) -> Result<(), DynamicsError> {
    match y.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(component) => Err(DynamicsError::NotFinite {
            time,
            component,
            what: name(component, y.len()),
            value: y[component],
        }),
    }
}
