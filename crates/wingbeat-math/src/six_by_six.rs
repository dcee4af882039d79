//! Six numbers of two vectors, and six by six matrices of such: masses, stiffnesses and derivatives of loads of
//! rigid bodies. Rows and columns stand as place and attitude, velocity and angular velocity, or force and
//! moment.

use glam::{DMat3, DVec3};

/// Six numbers of two vectors: a force and a moment, or two velocities or accelerations.
pub type Six = [f64; 6];

/// Six rows of six numbers.
pub type SixBySix = [Six; 6];

/// Zero.
pub const ZERO: SixBySix = [[0.0; 6]; 6];

/// Six numbers of two vectors.
pub fn six(a: DVec3, b: DVec3) -> Six {
    [a.x, a.y, a.z, b.x, b.y, b.z]
}

/// The two vectors of which number `k` is one, and all others zero.
pub fn unit(k: usize) -> [DVec3; 2] {
    match k {
        0..3 => [DVec3::AXES[k], DVec3::ZERO],
        _ => [DVec3::ZERO, DVec3::AXES[k - 3]],
    }
}

/// The matrix of `entry(row, column)`.
pub fn from_entries(entry: impl Fn(usize, usize) -> f64) -> SixBySix {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// The matrix of four quarters, by rows.
pub fn from_quarters(q: [[DMat3; 2]; 2]) -> SixBySix {
    from_entries(|i, j| q[i / 3][j / 3].col(j % 3)[i % 3])
}

/// A matrix times six numbers.
pub fn times(a: &SixBySix, x: &Six) -> Six {
    std::array::from_fn(|i| (0..6).map(|j| a[i][j] * x[j]).sum())
}

/// Product.
pub fn product(a: &SixBySix, b: &SixBySix) -> SixBySix {
    from_entries(|i, j| (0..6).map(|k| a[i][k] * b[k][j]).sum())
}

/// Transpose.
pub fn transpose(a: &SixBySix) -> SixBySix {
    from_entries(|i, j| a[j][i])
}

/// Sum.
pub fn sum(a: &SixBySix, b: &SixBySix) -> SixBySix {
    from_entries(|i, j| a[i][j] + b[i][j])
}

/// Every number times `factor`.
pub fn scaled(a: &SixBySix, factor: f64) -> SixBySix {
    a.map(|row| row.map(|x| factor * x))
}

/// Mean of a matrix and its transpose, exactly symmetric.
///
/// ```
/// use wingbeat_math::six_by_six::{from_entries, symmetric_part};
/// let a = symmetric_part(&from_entries(|i, j| (i * j + 2 * i) as f64));
/// assert_eq!([a[1][3], a[3][1]], [7.0; 2]);
/// ```
pub fn symmetric_part(a: &SixBySix) -> SixBySix {
    from_entries(|i, j| 0.5 * (a[i][j] + a[j][i]))
}
