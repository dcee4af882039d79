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

/// A symmetric matrix as `L D L^T`, without pivoting: for positive definite ones.
///
/// ```
/// use wingbeat_math::six_by_six::{Ldlt, from_entries, times};
/// let a = from_entries(|i, j| 1.0 / (1 + i + j) as f64); // Hilbert's matrix
/// let factors = Ldlt::new(a);
/// assert!(factors.is_positive());
/// let mut x = times(&a, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
/// factors.solve(&mut x);
/// assert!((x[5] - 6.0).abs() < 1e-8); // of a condition number of 1e7
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Ldlt {
    /// Row k of the upper half: column k of L.
    columns: SixBySix,
    /// 1 / D.
    inverse: Six,
}

impl Ldlt {
    /// Of the matrix `a`, of which only the lower half is read.
    pub fn new(mut a: SixBySix) -> Self {
        let mut inverse = [0.0; 6];
        for k in 0..6 {
            inverse[k] = 1.0 / a[k][k];
            for i in k + 1..6 {
                a[k][i] = a[i][k] * inverse[k];
            }
            for i in k + 1..6 {
                let entry = a[i][k];
                for j in k + 1..=i {
                    a[i][j] -= entry * a[k][j];
                }
            }
        }
        Self {
            columns: a,
            inverse,
        }
    }

    /// Solves for the right-hand side `x`, in its place.
    pub fn solve(&self, x: &mut Six) {
        let l = &self.columns;
        for k in 0..6 {
            for i in k + 1..6 {
                x[i] -= l[k][i] * x[k];
            }
        }
        for k in (0..6).rev() {
            x[k] *= self.inverse[k];
            for i in k + 1..6 {
                x[k] -= l[k][i] * x[i];
            }
        }
    }

    /// Whether the matrix is positive definite: all of D is.
    pub fn is_positive(&self) -> bool {
        self.inverse.iter().all(|d| *d > 0.0 && d.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `A = Q D Q^T` of a reflection Q is positive definite where D is, whatever a diagonal shows.
    #[test]
    fn exact_positive_where_eigenvalues_are() {
        let v: Six = [0.5, -0.25, 0.5, 0.25, -0.5, 0.125];
        let square: f64 = v.iter().map(|x| x * x).sum();
        let q = from_entries(|i, j| f64::from(u8::from(i == j)) - 2.0 * v[i] * v[j] / square);
        let of = |least: f64| {
            let d = from_entries(|i, j| if i == j { least + i as f64 } else { 0.0 });
            Ldlt::new(product(&product(&q, &d), &q)).is_positive()
        };
        assert!(of(1e-6) && !of(-1e-6) && !of(-2.5));
        assert!(!Ldlt::new(ZERO).is_positive());
    }
}
