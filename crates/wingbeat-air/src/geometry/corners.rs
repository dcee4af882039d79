//! What the corners of a panel give: their mean, weights in it, areas.

use wingbeat_math::DVec3;

/// Half the cross product of the diagonals.
pub(crate) fn vector_area(x: &[DVec3; 4]) -> DVec3 {
    0.5 * (x[2] - x[0]).cross(x[3] - x[1])
}

/// The first of the two places among the corners that a triangle's repeated corner has.
pub(super) fn repeated(corners: &[usize; 4]) -> Option<usize> {
    (0..4).find(|&k| corners[k] == corners[(k + 1) % 4])
}

/// Weights of the corners in their mean: a repeated corner counts once, half at each of its places.
pub(super) fn corner_weights(corners: &[usize; 4]) -> [f64; 4] {
    let Some(k) = repeated(corners) else {
        return [0.25; 4];
    };
    let is_repeated = |j: usize| j == k || j == (k + 1) % 4;
    std::array::from_fn(|j| if is_repeated(j) { 1.0 / 6.0 } else { 1.0 / 3.0 })
}

/// Mean over the corners, a repeated corner counted once.
pub(super) fn mean_corner(corners: &[usize; 4], x: &[DVec3; 4]) -> DVec3 {
    let sum = (x[0] + x[1]) + (x[2] + x[3]);
    match repeated(corners) {
        Some(k) => (sum - x[k]) / 3.0,
        None => 0.25 * sum,
    }
}

/// Area of the triangles (0, 1, 2) and (0, 2, 3).
pub(super) fn two_triangles(x: &[DVec3; 4]) -> f64 {
    let d = x[2] - x[0];
    0.5 * ((x[1] - x[0]).cross(d).length() + d.cross(x[3] - x[0]).length())
}
