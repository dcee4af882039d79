//! Where a body faces.

use glam::{DMat3, DVec3};

/// How far a body that faces `ahead` is turned about `down` from one that has the axes of N \[rad\]; `ahead` is at
/// right angles to `down`, both N components \[1\].
pub fn heading(ahead: DVec3, down: DVec3) -> f64 {
    let zero = facing(DMat3::IDENTITY, down);
    (-zero.dot(down.cross(ahead))).atan2(zero.dot(ahead))
}

/// Horizontal part of the nose, beside one that is level, below which right of the body says the more where forward is,
/// the nearer the nose is to the vertical \[1\].
const UPRIGHT: f64 = 0.1;

/// The horizontal direction in which a body of the attitude `r` (root to N) faces where down is `down`, N components
/// \[1\]: the horizontal part of b1, of a body that is pitched beyond the vertical the reverse of it. So a body that
/// pitches up through the vertical faces the same way all along, and its right is right; one on its back counts as
/// pitched over, not as rolled over. Where b1 is nearly vertical, forward goes over to what has b2, made horizontal, to
/// the right: the same in a flight that does not bank.
pub fn facing(r: DMat3, down: DVec3) -> DVec3 {
    /// Horizontal part of b2 below which it has no direction.
    const NONE: f64 = 1e-9;
    let nose = r.x_axis - r.x_axis.dot(down) * down;
    let facing = r.y_axis.cross(down);
    if facing.length() < NONE {
        return nose.normalize(); // banked by a right angle
    }
    let facing = facing.normalize();
    let along = nose.dot(facing);
    let share = (along / UPRIGHT).powi(2);
    if share >= 1.0 {
        return along.signum() * nose.normalize();
    }
    (share * along.signum() * nose.normalize_or_zero() + (1.0 - share) * facing).normalize()
}
