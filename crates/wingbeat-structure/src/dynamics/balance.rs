//! What the body hands to the one that carries it, and its momentum and energy.

use wingbeat_math::{DMat3, DVec3, tilde};

use super::generalized_alpha::Trial;
use super::solver::{LoadTangent, Solver, combined};
use crate::block::{Block, ZERO, block, pair, product};
use crate::configuration::{Configuration, NODE};
use crate::frame::FrameMotion;
use crate::inertia::{self, Motion};
use crate::screw::right_jacobian;
use crate::structure::Structure;

/// Force \[N\] and moment [N m] about the origin of W, or momentum and angular momentum; W components.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RootWrench {
    /// Force \[N\].
    pub force: DVec3,
    /// Moment about the origin [N m].
    pub moment: DVec3,
}

/// Sum over all nodes of forces in W and moments in node components, about the origin of W.
fn resultant(at: &Configuration, of: impl Fn(usize) -> [DVec3; 2]) -> RootWrench {
    let mut sum = RootWrench::default();
    for (n, (u, r)) in at.position.iter().zip(&at.rotation).enumerate() {
        let [force, moment] = of(n);
        sum.force += force;
        sum.moment += u.cross(force) + *r * moment;
    }
    sum
}

/// Force and moment that a body in motion exerts on the one that carries its frame: all loads (six numbers a node) less all
/// inertial forces. Supports and mass-proportional damping together.
pub fn reaction(
    structure: &Structure,
    trial: &Trial,
    frame: &FrameMotion,
    loads: &[f64],
) -> RootWrench {
    let motion = trial.motion();
    let load = resultant(&trial.configuration, |n| pair(loads, n));
    let inertial = inertial_resultant(structure, &motion, frame);
    RootWrench {
        force: load.force - inertial.force,
        moment: load.moment - inertial.moment,
    }
}

/// Inertial force and moment of all nodes.
pub(crate) fn inertial_resultant(
    structure: &Structure,
    motion: &Motion<'_>,
    frame: &FrameMotion,
) -> RootWrench {
    resultant(motion.at, |n| {
        inertia::force(&structure.masses[n], frame, &motion.node(n))
    })
}

/// Momentum [kg m/s] and angular momentum about the origin of W [kg m2/s] of the motion relative to W; `velocity` six
/// numbers a node.
pub fn relative_momentum(
    structure: &Structure,
    at: &Configuration,
    velocity: &[f64],
) -> RootWrench {
    let motion = Motion {
        at,
        velocity,
        acceleration: velocity,
    };
    resultant(at, |n| {
        inertia::momentum(&structure.masses[n], &motion.node(n))
    })
}

/// Kinetic energy \[J\] of a body whose nodes move with `velocity` (six numbers a node) relative to W, W itself with the
/// velocity of its origin and the angular velocity `[velocity, w]` in W components.
pub fn kinetic_energy(
    structure: &Structure,
    at: &Configuration,
    velocity: &[f64],
    [origin, w]: [DVec3; 2],
) -> f64 {
    let motion = Motion {
        at,
        velocity,
        acceleration: velocity,
    };
    let node = |(n, m): (usize, &wingbeat_math::MassProperties)| {
        let mut node = motion.node(n);
        node.v += origin + w.cross(node.u);
        node.omega += node.r.transpose() * w;
        let [p, h] = inertia::momentum(m, &node);
        0.5 * (p.dot(node.v) + h.dot(node.omega))
    };
    structure.masses.iter().enumerate().map(node).sum()
}

impl Solver {
    /// Derivative of [`reaction`] (force, moment) by the acceleration and angular acceleration of W over the step just
    /// solved, six by six by rows: the body's effective mass in this step, less than nothing. What follows elastically is
    /// condensed by the factors of the step's tangent, of which `loads` has to be the same; the last residual has to be that
    /// of the trial.
    pub fn frame_response(
        &mut self,
        structure: &Structure,
        trial: &Trial,
        frame: &FrameMotion,
        loads: &LoadTangent<'_>,
    ) -> [[f64; 6]; 6] {
        let columns = self.frame_columns(structure, trial);
        let (rigid, rows) = self.root_rows(structure, trial, frame, loads);
        let mut response = rigid.map(|row| row.map(|v| -v));
        let given = loads
            .acceleration
            .map(|by| followed(&trial.configuration, by));
        for (j, column) in columns.into_iter().enumerate() {
            let mut follow = column;
            if let Some(given) = &given {
                for (x, &k) in follow.iter_mut().zip(&structure.number) {
                    *x -= given[j][k];
                }
                let sum = resultant(&trial.configuration, |n| pair(&given[j], n));
                let six = [sum.force.to_array(), sum.moment.to_array()].concat();
                (0..NODE).for_each(|i| response[i][j] += six[i]);
            }
            self.solve(&mut follow);
            for i in 0..NODE {
                let with: f64 = rows[i].iter().zip(&follow).map(|(a, b)| a * b).sum();
                response[i][j] += with;
            }
        }
        response
    }

    /// Derivatives of the residual by the acceleration and angular acceleration of W.
    pub(super) fn frame_columns(&self, structure: &Structure, trial: &Trial) -> [Vec<f64>; NODE] {
        let motion = trial.motion();
        let nodes = structure.masses.iter().enumerate();
        let blocks: Vec<Block> = nodes
            .map(|(n, m)| inertia::by_frame_acceleration(m, &motion.node(n)))
            .collect();
        let free = |j: usize| {
            let entry = |k: &usize| blocks[k / NODE][k % NODE][j];
            structure.number.iter().map(entry).collect()
        };
        std::array::from_fn(free)
    }

    /// Derivatives of the resultant of inertial forces less loads about the origin: by the acceleration of W, and by the
    /// increments of the free unknowns.
    pub(super) fn root_rows(
        &self,
        structure: &Structure,
        trial: &Trial,
        frame: &FrameMotion,
        loads: &LoadTangent<'_>,
    ) -> (Block, [Vec<f64>; NODE]) {
        let motion = trial.motion();
        let mut rigid = ZERO;
        let mut full: [Vec<f64>; NODE] =
            std::array::from_fn(|_| vec![0.0; NODE * structure.nodes()]);
        for (n, m) in structure.masses.iter().enumerate() {
            let node = motion.node(n);
            let to_root = to_root(&node);
            let by_frame = inertia::by_frame_acceleration(m, &node);
            rigid = crate::block::sum(&rigid, &product(&to_root, &by_frame));
            let tangents = inertia::tangents(m, frame, &node);
            let local = combined(&tangents, trial.weights(), trial.turn(n), 0.0);
            let [force, moment] = inertia::force(m, frame, &node);
            let [load, turning] = pair(&self.loads, n);
            let moved = carried(&node, [force - load, moment - turning], trial.turn(n));
            let all = crate::block::sum(&product(&to_root, &local), &moved);
            for (row, values) in full.iter_mut().zip(all) {
                let at = &mut row[NODE * n..NODE * (n + 1)];
                at.iter_mut().zip(values).for_each(|(a, v)| *a += v);
            }
        }
        if !loads.is_none() {
            load_rows(structure, trial, loads, &mut full);
        }
        let free = |row: Vec<f64>| structure.number.iter().map(|&k| row[k]).collect();
        (rigid, full.map(free))
    }
}

/// Loads on the nodes by the acceleration and angular acceleration of W, where loads follow the accelerations of the nodes by
/// the matrix `by` (rows of 6 N numbers).
fn followed(at: &Configuration, by: &[f64]) -> [Vec<f64>; NODE] {
    let width = NODE * at.len();
    let of = |j: usize| {
        let (linear, angular) = match j {
            0..3 => (DVec3::AXES[j], DVec3::ZERO),
            _ => (DVec3::ZERO, DVec3::AXES[j - 3]),
        };
        let node = |(u, r): (&DVec3, &wingbeat_math::DQuat)| {
            let (a, turn) = (linear + angular.cross(*u), r.inverse() * angular);
            [a.to_array(), turn.to_array()].concat()
        };
        let nodes: Vec<f64> = at
            .position
            .iter()
            .zip(&at.rotation)
            .flat_map(node)
            .collect();
        let rows = by.chunks_exact(width);
        rows.map(|row| row.iter().zip(&nodes).map(|(b, x)| b * x).sum())
            .collect()
    };
    std::array::from_fn(of)
}

/// Force and moment about the origin of W by its acceleration and angular acceleration, six by six by rows, of loads that
/// follow the accelerations of the nodes by the matrix `by` (rows of 6 N numbers) and nothing else.
pub fn carried_by_frame(at: &Configuration, by: &[f64]) -> [[f64; 6]; 6] {
    let columns = followed(at, by).map(|loads| {
        let sum = resultant(at, |n| pair(&loads, n));
        [sum.force.to_array(), sum.moment.to_array()].concat()
    });
    std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]))
}

/// Map of a node's force (W) and moment (node components) to the origin.
fn to_root(node: &inertia::NodeMotion) -> Block {
    block([[DMat3::IDENTITY, DMat3::ZERO], [tilde(node.u), node.r]])
}

/// Change of the resultant as a node moves with its force and moment.
fn carried(node: &inertia::NodeMotion, [force, moment]: [DVec3; 2], turn: DVec3) -> Block {
    let zero = DMat3::ZERO;
    let turned = node.r * tilde(-moment) * right_jacobian(turn);
    block([[zero, zero], [tilde(-force), turned]])
}

/// Takes off the resultant of the derivatives of the loads.
fn load_rows(
    structure: &Structure,
    trial: &Trial,
    loads: &LoadTangent<'_>,
    full: &mut [Vec<f64>; NODE],
) {
    let motion = trial.motion();
    for column in 0..structure.nodes() {
        let turn = right_jacobian(trial.turn(column));
        for n in 0..structure.nodes() {
            let rows: Block =
                std::array::from_fn(|i| loads.row(NODE * n + i, column, trial, &turn));
            let all = product(&to_root(&motion.node(n)), &rows);
            for (row, values) in full.iter_mut().zip(all) {
                let at = &mut row[NODE * column..NODE * (column + 1)];
                at.iter_mut().zip(values).for_each(|(a, v)| *a -= v);
            }
        }
    }
}
