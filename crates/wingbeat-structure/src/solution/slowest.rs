//! The slowest modes of large bodies, without the others.
//!
//! Of `M x = mu (K + s M) x` the largest `mu = 1 / (omega^2 + s)` belong to the slowest modes. With `K + s M = L L^T`
//! they are those of the symmetric `L^-1 M L^-T`, which is applied to vectors and never formed. Krylov's space of a
//! block of vectors holds them nearly once it has a few times as many directions: Rayleigh and Ritz's method finds them
//! there, and residuals say when they are found. Modes of one frequency, up to as many as the block has vectors, are
//! all found. That none is missing is counted: as many pivots of `K - sigma M` are negative as modes have squares of
//! their frequencies below sigma.
//!
//! # Source
//! R. Grimes, J. Lewis & H. Simon, A shifted block Lanczos algorithm for solving sparse symmetric generalized
//! eigenproblems, SIAM J. Matrix Anal. Appl. 15 (1994), sec. 2-4; all directions are made orthogonal to all others.

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, Mat, MatRef, Par, Side};

/// Vectors of a block.
const BLOCK: usize = 8;

/// Blocks between two looks at what is found.
const LOOK: usize = 4;

/// Directions for every eigenvalue that is asked, at most.
const DIRECTIONS: usize = 6;

/// Residual over the largest eigenvalue up to which one is found \[1\]: its own error is of the square of that, over the
/// distance to the next one. Rounding of stiff bodies leaves 1e-11.
const FOUND: f64 = 1e-10;

/// Eigenvalues and vectors, one a column.
pub(crate) type Pairs = (Vec<f64>, Mat<f64>);

/// The `count` largest eigenvalues `mu` \[s2\], falling, and vectors x for which `x^T (K + s M) x = 1`, of the factor L
/// of `K + s M`; none where they are not found within a few times as many directions.
pub(crate) fn slowest(lower: MatRef<f64>, mass: MatRef<f64>, count: usize) -> Option<Pairs> {
    let n = mass.nrows();
    let most = (DIRECTIONS * count).min(n) / BLOCK;
    let [mut basis, mut images] = [0, 0].map(|_| Mat::zeros(n, BLOCK * most));
    let mut next = beginning(n);
    for block in 0..most {
        let known = BLOCK * block;
        next = beside(basis.subcols(0, known), next);
        let image = flexibility(lower, mass, &next);
        basis.subcols_mut(known, BLOCK).copy_from(&next);
        images.subcols_mut(known, BLOCK).copy_from(&image);
        next = image;
        let size = known + BLOCK;
        if size < 2 * count || !(block + 1).is_multiple_of(LOOK) && block + 1 < most {
            continue;
        }
        let spaces = [basis.subcols(0, size), images.subcols(0, size)];
        if let Some((values, mut vectors)) = within(spaces, count) {
            solve_upper_triangular_in_place(lower.transpose(), vectors.as_mut(), Par::Seq);
            return Some((values, vectors));
        }
    }
    None
}

/// `L^-1 M L^-T x`.
fn flexibility(lower: MatRef<f64>, mass: MatRef<f64>, x: &Mat<f64>) -> Mat<f64> {
    let mut x = x.clone();
    solve_upper_triangular_in_place(lower.transpose(), x.as_mut(), Par::Seq);
    let mut out = Mat::zeros(x.nrows(), x.ncols());
    matmul(out.as_mut(), Accum::Replace, mass, x, 1.0, Par::Seq);
    solve_lower_triangular_in_place(lower, out.as_mut(), Par::Seq);
    out
}

/// A block that no symmetry of the body keeps apart from any mode: multiples of the golden section, less their whole
/// parts, are spread evenly, in no order that a mesh has.
fn beginning(n: usize) -> Mat<f64> {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    Mat::from_fn(n, BLOCK, |i, j| {
        (golden * (BLOCK * i + j + 1) as f64).fract() - 0.5
    })
}

/// Unit vectors orthogonal to `basis` and to each other, spanning with it what `block` does. Twice is enough.
fn beside(basis: MatRef<f64>, mut block: Mat<f64>) -> Mat<f64> {
    for _ in 0..2 {
        let part = basis.transpose() * &block;
        block -= basis * part;
        block = block.qr().compute_thin_Q();
    }
    block
}

/// The `count` largest eigenvalues and unit vectors within the space of a basis, whose images stand beside it; none if
/// residuals are not small.
fn within([basis, images]: [MatRef<f64>; 2], count: usize) -> Option<Pairs> {
    let projected = basis.transpose() * images;
    let eigen = projected.self_adjoint_eigen(Side::Lower).ok()?;
    let size = basis.ncols();
    let values: Vec<f64> = (0..count).map(|j| eigen.S()[size - 1 - j]).collect();
    let parts = Mat::from_fn(size, count, |i, j| eigen.U()[(i, size - 1 - j)]);
    let (vectors, images) = (basis * &parts, images * parts);
    let residual = |j: usize| (images.col(j) - vectors.col(j) * faer::Scale(values[j])).norm_l2();
    let are_found = (0..count).all(|j| residual(j) <= FOUND * values[0]);
    (are_found && values[count - 1] > 0.0).then_some((values, vectors))
}

/// How many modes have squares of their frequencies below `sigma` [rad2/s2]: negative pivots of `K - sigma M`.
pub(crate) fn below(stiffness: MatRef<f64>, mass: MatRef<f64>, sigma: f64) -> usize {
    let n = mass.nrows();
    let shifted = Mat::from_fn(n, n, |i, j| stiffness[(i, j)] - sigma * mass[(i, j)]);
    let factors = shifted.lblt(Side::Lower);
    let (diagonal, beside) = (factors.B_diag(), factors.B_subdiag());
    let (mut i, mut negative) = (0, 0);
    while i < n {
        // A pivot of two rows has a negative determinant: one of each sign.
        let is_pair = i + 1 < n && beside[i] != 0.0;
        negative += usize::from(is_pair || diagonal[i] < 0.0);
        i += if is_pair { 2 } else { 1 };
    }
    negative
}
