//! Bodies that change their shape: what their mass does otherwise than the rigid body they are at rest.

use wingbeat_math::{DMat3, DVec3};

/// First and second moment of mass of a body beside those at rest, and its momenta relative to its frame, about its
/// origin in body components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeMass {
    /// Index of the body.
    pub body: usize,
    /// First moment less that at rest [kg m].
    pub first_moment: DVec3,
    /// Inertia less that at rest [kg m2].
    pub inertia: DMat3,
    /// Linear momentum of the motion relative to the frame [kg m/s].
    pub momentum: DVec3,
    /// Angular momentum of that motion about the origin [kg m2/s].
    pub angular_momentum: DVec3,
}
