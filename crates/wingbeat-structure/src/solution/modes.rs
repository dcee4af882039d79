//! Frequencies and shapes of small vibrations.

use faer::linalg::solvers::Llt;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{ColRef, Mat, MatRef, Par, Side};
use wingbeat_math::{DMat3, DVec3, MassProperties};

use crate::error::StructureError;
use crate::nodes::configuration::{Configuration, NODE};
use crate::nodes::frame::FrameMotion;
use crate::solution::assembly::Assembly;
use crate::solution::slowest::{below, slowest};
use crate::solution::statics::steady_tangent;
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
/// The matrices of this eigenproblem are dense: up to some 600 unknowns are solved within seconds. Of larger bodies
/// [`slowest_modes`] are found sooner.
///
/// # Errors
/// [`StructureError::Modes`].
pub fn modes(
    structure: &Structure,
    at: &Configuration,
    frame: &FrameMotion,
    added: Option<&[f64]>,
) -> Result<Vec<Mode>, StructureError> {
    let problem = Problem::new(structure, at, frame, added);
    let (factor, shift) = problem.factor()?;
    problem.all(factor.L(), shift)
}

/// The slowest modes of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Slowest {
    /// Of rising frequency; none is left out between them.
    pub modes: Vec<Mode>,
    /// Angular frequency of the fastest mode of the body [rad/s]; where that is not among those found, what it is at
    /// least.
    pub fastest: f64,
}

/// Unknowns up to which all modes are found at once.
const SMALL: usize = 600;

/// How many of the slowest modes of a larger body are looked for first, and part of its unknowns up to which there are
/// more to be tried before all.
const FIRST: usize = 40;
const PART: usize = 8;

/// The slowest [`modes`], so many that they are `enough`, or all.
///
/// # Errors
/// [`StructureError::Modes`].
pub fn slowest_modes(
    structure: &Structure,
    at: &Configuration,
    (frame, added): (&FrameMotion, Option<&[f64]>),
    enough: &dyn Fn(&[Mode]) -> bool,
) -> Result<Slowest, StructureError> {
    let problem = Problem::new(structure, at, frame, added);
    let (factor, shift) = problem.factor()?;
    let n = structure.unknowns();
    let mut count = FIRST;
    while n > SMALL && count <= n / PART {
        let found = slowest(factor.L(), problem.mass.as_ref(), count);
        let Some((values, vectors)) = found else {
            break;
        };
        let mut modes: Vec<Mode> = (0..count)
            .map(|j| problem.mode(values[j], vectors.col(j), shift))
            .collect();
        let sigma = cut(&mut modes);
        if enough(&modes) {
            if below(problem.stiffness.as_ref(), problem.mass.as_ref(), sigma) != modes.len() {
                break;
            }
            let fastest = problem.largest_ratio().sqrt();
            return Ok(Slowest { modes, fastest });
        }
        count *= 2;
    }
    let modes = problem.all(factor.L(), shift)?;
    let fastest = modes.last().map_or(0.0, Mode::frequency);
    Ok(Slowest { modes, fastest })
}

/// Takes the last modes away from the widest gap among the last quarter on; the middle of the gap [rad2/s2].
fn cut(modes: &mut Vec<Mode>) -> f64 {
    let gap = |j: usize| modes[j].square - modes[j - 1].square;
    let quarter = modes.len() - modes.len() / 4..modes.len();
    let widest = quarter.max_by(|&a, &b| gap(a).total_cmp(&gap(b)));
    let at = widest.unwrap_or(1);
    let sigma = 0.5 * (modes[at].square + modes[at - 1].square);
    modes.truncate(at);
    sigma
}

/// Symmetric stiffness and mass of the free unknowns, scaled so that the diagonals of the stiffness are one: metres,
/// radians, stiff and soft directions weigh alike.
struct Problem<'a> {
    structure: &'a Structure,
    stiffness: Mat<f64>,
    mass: Mat<f64>,
    scale: Vec<f64>,
}

impl<'a> Problem<'a> {
    fn new(
        structure: &'a Structure,
        at: &Configuration,
        frame: &FrameMotion,
        added: Option<&[f64]>,
    ) -> Self {
        let (mut stiffness, mut mass) = matrices(structure, at, frame, added);
        let n = structure.unknowns();
        let scale = (0..n).map(|i| positive(stiffness[(i, i)]).sqrt().recip());
        let scale: Vec<f64> = scale.collect();
        for matrix in [&mut stiffness, &mut mass] {
            scaled(matrix, &scale);
        }
        Self {
            structure,
            stiffness,
            mass,
            scale,
        }
    }

    /// All modes.
    fn all(&self, lower: MatRef<f64>, shift: f64) -> Result<Vec<Mode>, StructureError> {
        let n = self.scale.len();
        let (values, vectors) = whole_eigen(lower, &self.mass)?;
        // Massless combinations have no frequency: their eigenvalues are the rounding of the largest.
        let heaviest = values.iter().fold(0.0_f64, |a, v| a.max(*v));
        let rounding = n as f64 * f64::EPSILON * heaviest;
        let heavy = (0..n).filter(|&j| values[j] > rounding);
        let modes = heavy.map(|j| self.mode(values[j], vectors.col(j), shift));
        let mut all: Vec<Mode> = modes.collect();
        all.sort_by(|a, b| a.square.total_cmp(&b.square));
        Ok(all)
    }

    /// The mode of an eigenvalue `1 / (omega^2 + shift)`.
    fn mode(&self, value: f64, vector: ColRef<f64>, shift: f64) -> Mode {
        let mut shape = vec![0.0; NODE * self.structure.nodes()];
        for (i, &number) in self.structure.number.iter().enumerate() {
            shape[number] = self.scale[i] * vector[i] / value.sqrt();
        }
        Mode {
            square: 1.0 / value - shift,
            shape,
        }
    }

    /// Ratios of the diagonals of stiffness and mass [rad2/s2].
    fn ratios(&self) -> impl Iterator<Item = f64> {
        let [k, m] = [&self.stiffness, &self.mass];
        let heavy = (0..self.scale.len()).filter(|&i| m[(i, i)] > 0.0);
        heavy.map(|i| k[(i, i)].abs() / m[(i, i)])
    }

    /// Rayleigh's quotients of the unknowns one by one: the largest is below that of the fastest mode.
    fn largest_ratio(&self) -> f64 {
        self.ratios().fold(0.0, f64::max)
    }

    /// Cholesky's factor of `K + shift M`, and the shift: small frequencies come out best, and neither massless
    /// directions nor rigid motions disturb.
    fn factor(&self) -> Result<(Llt<f64>, f64), StructureError> {
        let [k, m] = [&self.stiffness, &self.mass];
        let n = self.scale.len();
        let smallest = self.ratios().fold(f64::INFINITY, f64::min);
        for shift in SHIFTS.map(|s| s * smallest) {
            let sum = Mat::from_fn(n, n, |i, j| k[(i, j)] + shift * m[(i, j)]);
            if let Ok(factor) = sum.llt(Side::Lower) {
                return Ok((factor, shift));
            }
        }
        Err(StructureError::Modes(
            "the stiffness has strongly negative eigenvalues: the state is not an equilibrium that can vibrate; look at structure of the wing: less tension at rest (shell.prestress_newton_per_m) where edges are free, more thickness, or smaller loads",
        ))
    }
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
        let block = m.matrix(DMat3::from_quat(structure.rest.rotation[node]));
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
        let block = m.matrix(DMat3::from_quat(at.rotation[node]));
        assembly.add(structure, [node, node], &block);
    }
    for m in &structure.between {
        let point = m.point();
        assembly.add_between(structure, m.nodes, &point.matrix(DMat3::IDENTITY));
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

/// All eigenvalues `1 / (omega^2 + shift)` and vectors of `M x = mu L L^T x`.
fn whole_eigen(lower: MatRef<f64>, m: &Mat<f64>) -> Result<(Vec<f64>, Mat<f64>), StructureError> {
    let mut half = m.clone();
    solve_lower_triangular_in_place(lower, half.as_mut(), Par::Seq);
    let mut whole = half.transpose().to_owned();
    solve_lower_triangular_in_place(lower, whole.as_mut(), Par::Seq);
    let eigen = whole
        .self_adjoint_eigen(Side::Lower)
        .map_err(|_| StructureError::Modes("the iteration does not converge"))?;
    let mut vectors = eigen.U().to_owned();
    solve_upper_triangular_in_place(lower.transpose(), vectors.as_mut(), Par::Seq);
    let values = (0..m.nrows()).map(|i| eigen.S()[i]).collect();
    Ok((values, vectors))
}
