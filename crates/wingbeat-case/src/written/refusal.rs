//! What has no keys is refused; what has not changed is found.

use std::fmt::Debug;

use crate::error::IoError;

pub(super) type Written<T> = Result<T, IoError>;

/// Setups hold laws of any kind, so they are compared in the form that holds every number to the last bit.
pub(super) fn same<T: Debug + ?Sized>(a: &T, b: &T) -> bool {
    format!("{a:?}") == format!("{b:?}")
}

pub(super) fn no_keys(
    part: impl Into<String>,
    problem: impl Into<String>,
    remedy: &'static str,
) -> IoError {
    IoError::NoKeys {
        part: part.into(),
        problem: problem.into(),
        remedy,
    }
}
