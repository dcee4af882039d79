//! The fluid that the rings of a closed surface set in motion inside it.

use serde::{Deserialize, Serialize};
use wingbeat_math::{DMat3, DVec3};

/// Flow of the fictitious fluid inside a closed surface, N components; zero for open ones.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InnerFlow {
    /// Momentum [kg m/s].
    pub momentum: DVec3,
    /// Gradient of its velocity about the centroid of the volume [1/s].
    pub strain: DMat3,
}

impl InnerFlow {
    /// Fluid at rest.
    pub const REST: Self = Self {
        momentum: DVec3::ZERO,
        strain: DMat3::ZERO,
    };
}
