//! Keys that follow from others where a case leaves them out.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A key that is decided from other keys where the case leaves it out. In a resolved case
/// ([`crate::LoadedCase::raw`]) every such key has its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Open<T>(Option<T>);

impl<T> Default for Open<T> {
    fn default() -> Self {
        Self(None)
    }
}

impl<T> From<T> for Open<T> {
    fn from(value: T) -> Self {
        Self(Some(value))
    }
}

impl<T: Copy> Open<T> {
    /// Whether the case leaves the key out.
    pub fn is_open(&self) -> bool {
        self.0.is_none()
    }

    /// Decides the key where the case leaves it out.
    pub(crate) fn decide(&mut self, value: T) -> T {
        *self.0.get_or_insert(value)
    }

    /// The value of a resolved case.
    pub(crate) fn value(&self) -> T {
        self.0.expect("a resolved case leaves no key open")
    }
}
