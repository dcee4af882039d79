//! Mirror images in the 1-3 plane, which bring the left and the right side of an animal to each other.

use glam::DVec3;

/// Mirror image of a polar vector: a place, velocity, acceleration or force.
///
/// ```
/// use wingbeat_math::{DVec3, mirrored, mirrored_axial};
/// let (arm, force) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-4.0, 5.0, 6.0));
/// assert_eq!(mirrored_axial(arm.cross(force)), mirrored(arm).cross(mirrored(force)));
/// ```
pub fn mirrored(v: DVec3) -> DVec3 {
    DVec3::new(v.x, -v.y, v.z)
}

/// Mirror image of a polar vector in the plane across `normal`, a unit vector in the same components \[1\].
///
/// ```
/// use wingbeat_math::{DVec3, mirrored, reflected};
/// let v = DVec3::new(1.0, 2.0, 3.0);
/// assert_eq!(reflected(v, DVec3::Y), mirrored(v));
/// ```
pub fn reflected(v: DVec3, normal: DVec3) -> DVec3 {
    v - 2.0 * normal.dot(v) * normal
}

/// Mirror image of an axial vector: an angular velocity or acceleration, a moment, an axis of rotation.
pub fn mirrored_axial(v: DVec3) -> DVec3 {
    DVec3::new(-v.x, v.y, -v.z)
}
