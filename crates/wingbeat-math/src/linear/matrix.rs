//! Two matters of 3 x 3 matrices that glam leaves open.

use glam::{DMat3, DVec3};

/// `v v^T`.
pub fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v.x * v, v.y * v, v.z * v)
}

/// Sum of the diagonal: that of `v v^T` is `|v|^2`.
///
/// ```
/// use wingbeat_math::{DVec3, outer, trace};
/// assert_eq!(trace(outer(DVec3::new(1.0, 2.0, 3.0))), 14.0);
/// ```
pub fn trace(m: DMat3) -> f64 {
    m.x_axis.x + m.y_axis.y + m.z_axis.z
}
