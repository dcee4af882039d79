//! What can be wrong with a blade-element model.

/// A blade-element model that cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BladeError {
    /// A number out of range.
    #[error("{key} = {value}: {allowed} is needed")]
    Value {
        /// Name of the setting.
        key: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A strip that is none.
    #[error(
        "strip {index} at {span:.3e} m along the span has chord {chord:.3e} m and width {width:.3e} m; both must be finite and above 0: give the wing a finer or less pointed mesh"
    )]
    Strip {
        /// Index of the strip, root to tip.
        index: usize,
        /// Its place along the span [m].
        span: f64,
        /// Its chord [m].
        chord: f64,
        /// Its width [m].
        width: f64,
    },
    /// No set of coefficients has this name.
    #[error("there is no coefficient set `{name}`; the shipped ones are {known}")]
    UnknownSet {
        /// The name asked for.
        name: String,
        /// All names.
        known: String,
    },
}

/// An error unless `ok`.
pub(crate) fn require(
    ok: bool,
    key: &'static str,
    value: f64,
    allowed: &'static str,
) -> Result<(), BladeError> {
    if ok {
        return Ok(());
    }
    Err(BladeError::Value {
        key,
        value,
        allowed,
    })
}
