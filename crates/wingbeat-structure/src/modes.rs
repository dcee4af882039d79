//! Frequencies and shapes of small vibrations.

use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, Par, Side};
use wingbeat_math::{DMat3, DVec3, MassProperties};

use crate::assembly::Assembly;
use crate::configuration::{Configuration, NODE};
use crate::error::StructureError;
use crate::frame::FrameMotion;
use crate::inertia::mass_matrix;
use crate::statics::steady_tangent;
use crate::structure::{HELD, Structure};

/// A mode of small vibration.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Square of the angular frequency [rad2/s2]; negative if the state is unstable.
    pub square: f64,
    /// Six numbers a node (dx \[m\] in W, dtheta \[rad\] in node components) for a modal mass of 1 kg: `shape^T
    /// M shape = 1`.
    pub shape: Vec<f64>,
}

impl Mode {
    /// Angular frequency [rad/s]; 0 for a mode that does not vibrate.
    pub fn frequency(&self) -> f64 {
        self.square.max(0.0).sqrt()
    }

    /// What part of the kinetic energy the turns of the nodes of `structure` hold, each about its origin \[1\].
    pub fn turning(&self, structure: &Structure) -> f64 {
        let nodes = self.shape.chunks_exact(NODE).zip(structure.masses());
        let part = |(six, mass): (&[f64], &MassProperties)| {
            let w = DVec3::from_slice(&six[3..]);
            w.dot(mass.inertia * w)
        };
        nodes.map(part).sum()
    }
}

/// Modes about an equilibrium in a frame that moves steadily, of rising frequency: stiffness of the deformed
/// state with centrifugal stiffening and softening; Coriolis forces, which couple modes of a turning body, are
/// left out. Modes faster than the slowest by `1 / sqrt(n epsilon)`, n unknowns, some 1e6, are rounding and
/// left out, as motions without mass are. `added` is mass that moves along, by rows of 6 N x 6 N numbers, N
/// nodes, force in W and moment in node components by acceleration (added mass of the air), to be symmetric.
///
/// The matrices of this eigenproblem are dense: up to some 600 unknowns are solved within seconds.
///
/// # Errors
/// [`StructureError::Modes`].
pub fn modes(
    structure: &Structure,
    at: &Configuration,
    frame: &FrameMotion,
    added: Option<&[f64]>,
) -> Result<Vec<Mode>, StructureError> {
    let (mut k, mut m) = matrices(structure, at, frame, added);
    let n = structure.unknowns();
    // Diagonals of the stiffness of one: metres, radians, stiff and soft directions weigh alike.
    let scale: Vec<f64> = (0..n).map(|i| positive(k[(i, i)]).sqrt().recip()).collect();
    for matrix in [&mut k, &mut m] {
        scaled(matrix, &scale);
    }
    let (values, vectors, shift) = shifted_eigen(&k, &m)?;
    let mode = |j: usize| {
        let mut shape = vec![0.0; NODE * structure.nodes()];
        for (i, &number) in structure.number.iter().enumerate() {
            shape[number] = scale[i] * vectors[(i, j)] / values[j].sqrt();
        }
        Mode {
            square: 1.0 / values[j] - shift,
            shape,
        }
    };
    // Massless combinations have no frequency: their eigenvalues are the rounding of the largest.
    let heaviest = values.iter().fold(0.0_f64, |a, v| a.max(*v));
    let rounding = n as f64 * f64::EPSILON * heaviest;
    let heavy = (0..n).filter(|&j| values[j] > rounding);
    let mut all: Vec<Mode> = heavy.map(mode).collect();
    all.sort_by(|a, b| a.square.total_cmp(&b.square));
    Ok(all)
}

/// Unknowns times the square of the band of a stiffness up to which its factors take some tenths of a second.
const LARGE: f64 = 2.5e8;

/// Most passes of the iteration, and the change of the eigenvalue that ends it \[1\].
const PASSES: usize = 200;
const CONVERGED: f64 = 1e-8;

/// Relative error of the eigenvalue, twice that of the frequency, up to which it is known after all passes \[1\].
const KNOWN: f64 = 0.02;

/// Angular frequency \[rad/s\] of the slowest vibration about rest, by inverse iteration with the banded
/// stiffness and Rayleigh's quotient; 0 where a push grows. With `turns` nodes have all their inertia; without,
/// as for sheets, that of their turns counts in the quotient alone: motions in which nodes turn and nothing
/// moves are of the elements and of no sheet. Where the slowest vibrations are too close to each other to be told
/// apart, as flapping and lagging of a round beam, the quotient of their mixture is taken if it is known to 1 %: an
/// eigenvalue `mu` of `K^-1 M` lies within `|K^-1 M x - mu x|` of the quotient of x, `|x| = 1`, in the norm of M.
/// None of a body so large that this takes long, and where the iteration does not come so near.
///
/// # Source
/// The bound: B. N. Parlett, The symmetric eigenvalue problem, 1980, sec. 4-5 (residuals of Rayleigh's quotient).
///
/// # Errors
/// [`StructureError::Singular`], [`StructureError::Modes`]: a body that is not held, stiffnesses that differ by more than rounding.
pub fn first_frequency(structure: &Structure, turns: bool) -> Result<Option<f64>, StructureError> {
    let (n, band) = (structure.unknowns() as f64, structure.band as f64);
    if n * band * band > LARGE {
        return Ok(None);
    }
    let mut assembly = Assembly::new(structure);
    assembly.matrix.clear(false);
    let rest = (structure.rest(), None);
    steady_tangent(structure, rest, &FrameMotion::REST, &mut assembly);
    assembly.factor(structure)?;
    // A push at all nodes, the farther the harder, so that no symmetry hides the slowest vibration.
    let mut push = weighed(structure, &vec![1.0; structure.unknowns()], turns);
    let nodes = structure.nodes() as f64;
    let numbers = push.iter_mut().zip(&structure.number);
    numbers.for_each(|(f, k)| *f *= 1.0 + (k / NODE) as f64 / nodes);
    let (mut square, mut error) = (0.0_f64, f64::INFINITY);
    for _ in 0..PASSES {
        let mut shape = push.clone();
        assembly.matrix.solve(&mut shape);
        let stiffness = product(&shape, &push);
        let momentum = weighed(structure, &shape, turns);
        let kinetic = product(&shape, &momentum);
        let whole = product(&shape, &weighed(structure, &shape, true));
        let (found, before) = (stiffness / whole, square);
        (push, square) = (momentum, found);
        push.iter_mut().for_each(|f| *f /= kinetic.sqrt());
        error = (kinetic / stiffness.powi(2) - 1.0).max(0.0).sqrt();
        if !found.is_finite() {
            return Err(StructureError::Modes(
                "stiffnesses differ by more than rounding",
            ));
        }
        if (found - before).abs() <= CONVERGED * found.abs() {
            return Ok(Some(found.max(0.0).sqrt()));
        }
    }
    Ok((error <= KNOWN).then(|| square.max(0.0).sqrt()))
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Momenta of the free unknowns that move as `shape`; without `turns` of masses at the nodes that turn freely.
fn weighed(structure: &Structure, shape: &[f64], turns: bool) -> Vec<f64> {
    let mut out = vec![0.0; shape.len()];
    for (node, m) in structure.masses.iter().enumerate() {
        let m = match turns {
            true => *m,
            false => MassProperties {
                mass: m.mass,
                ..MassProperties::ZERO
            },
        };
        let block = mass_matrix(&m, DMat3::from_quat(structure.rest.rotation[node]));
        let own = |i: usize| structure.unknown[NODE * node + i];
        for (i, j) in (0..NODE * NODE).map(|k| (own(k / NODE), k)) {
            let (row, col) = (j / NODE, own(j % NODE));
            if i != HELD && col != HELD {
                out[i] += block[row][j % NODE] * shape[col];
            }
        }
    }
    for m in &structure.between {
        for d in 0..3 {
            let own = m.nodes.map(|n| structure.unknown[NODE * n + d]);
            let free = || own.iter().filter(|&&u| u != HELD);
            let velocity = free().map(|&u| shape[u]).sum::<f64>() / 2.0;
            free().for_each(|&u| out[u] += 0.5 * m.mass * velocity);
        }
    }
    out
}

fn positive(x: f64) -> f64 {
    if x.abs() > 0.0 { x.abs() } else { 1.0 }
}

fn scaled(m: &mut Mat<f64>, scale: &[f64]) {
    for (j, i) in (0..scale.len()).flat_map(|j| (0..scale.len()).map(move |i| (j, i))) {
        m[(i, j)] *= scale[i] * scale[j];
    }
}

/// Symmetric stiffness and mass of the free unknowns.
fn matrices(
    structure: &Structure,
    at: &Configuration,
    frame: &FrameMotion,
    added: Option<&[f64]>,
) -> (Mat<f64>, Mat<f64>) {
    let n = structure.unknowns();
    let mut assembly = Assembly::new(structure);
    assembly.matrix.clear(true);
    steady_tangent(structure, (at, None), frame, &mut assembly);
    let k = symmetric(n, assembly.matrix.rows());
    assembly.matrix.clear(true);
    for (node, m) in structure.masses.iter().enumerate() {
        let block = mass_matrix(m, DMat3::from_quat(at.rotation[node]));
        assembly.add(structure, [node, node], &block);
    }
    for m in &structure.between {
        let point = m.point();
        assembly.add_between(structure, m.nodes, &mass_matrix(&point, DMat3::IDENTITY));
    }
    if let Some(added) = added {
        let width = NODE * structure.nodes();
        for (i, j) in (0..n * n).map(|q| (q / n, q % n)) {
            let value = added[structure.number[i] * width + structure.number[j]];
            assembly.matrix.add(i, j, value);
        }
    }
    (k, symmetric(n, assembly.matrix.rows()))
}

fn symmetric(n: usize, rows: &[f64]) -> Mat<f64> {
    Mat::from_fn(n, n, |i, j| 0.5 * (rows[i * n + j] + rows[j * n + i]))
}

/// Shifts tried, over the smallest ratio of the diagonals of stiffness and mass: small ones for frequencies of
/// all sizes, large ones where modes grow fast, as those of a sheet that buckles.
const SHIFTS: [f64; 16] = [
    1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12,
];

/// Eigenvalues `1 / (omega^2 + shift)` and vectors of `M x = mu (K + shift M) x`, and the shift: small frequencies
/// come out best, and neither massless directions nor rigid motions disturb.
fn shifted_eigen(k: &Mat<f64>, m: &Mat<f64>) -> Result<(Vec<f64>, Mat<f64>, f64), StructureError> {
    let n = k.nrows();
    let ratios = (0..n).filter(|&i| m[(i, i)] > 0.0);
    let ratios = ratios.map(|i| k[(i, i)].abs() / m[(i, i)]);
    let smallest = ratios.fold(f64::INFINITY, f64::min);
    for shift in SHIFTS.map(|s| s * smallest) {
        let sum = Mat::from_fn(n, n, |i, j| k[(i, j)] + shift * m[(i, j)]);
        let Ok(llt) = sum.llt(Side::Lower) else {
            continue;
        };
        let lower = llt.L();
        let mut half = m.clone();
        solve_lower_triangular_in_place(lower, half.as_mut(), Par::Seq);
        let mut whole = half.transpose().to_owned();
        solve_lower_triangular_in_place(lower, whole.as_mut(), Par::Seq);
        let eigen = whole
            .self_adjoint_eigen(Side::Lower)
            .map_err(|_| StructureError::Modes("the iteration does not converge"))?;
        let mut vectors = eigen.U().to_owned();
        solve_upper_triangular_in_place(lower.transpose(), vectors.as_mut(), Par::Seq);
        let values = (0..n).map(|i| eigen.S()[i]).collect();
        return Ok((values, vectors, shift));
    }
    Err(StructureError::Modes(
        "the stiffness has strongly negative eigenvalues: the state is not an equilibrium that can vibrate; look at structure of the wing: less tension at rest (shell.prestress_newton_per_m) where edges are free, more thickness, or smaller loads",
    ))
}
