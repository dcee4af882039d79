//! Newton's iteration for a step in time.

use wingbeat_math::six_by_six::{ZERO, from_quarters, product};
use wingbeat_math::{DMat3, DVec3, SixBySix, larger};

use super::carried::ResponseScratch;
use super::generalized_alpha::{State, Trial, Weights};
use crate::error::StructureError;
use crate::nodes::block::{add_pair, pair};
use crate::nodes::configuration::{Configuration, NODE};
use crate::nodes::frame::FrameMotion;
use crate::nodes::inertia::{self, Motion};
use crate::nodes::screw::right_jacobian;
use crate::solution::assembly::{Assembly, Viscous};
use crate::structure::{HELD, Structure};

/// Derivatives of the loads on the nodes: matrices by rows of 6 N x 6 N numbers, N nodes; forces in W and
/// moments in node components by the six numbers of each node or their rates. None is zero.
#[derive(Clone, Copy, Debug, Default)]
pub struct LoadTangent<'a> {
    /// By places and attitudes (dx, dtheta) [N/m, N, N m].
    pub position: Option<&'a [f64]>,
    /// By velocities and angular velocities.
    pub velocity: Option<&'a [f64]>,
    /// By accelerations and angular accelerations: less the added mass.
    pub acceleration: Option<&'a [f64]>,
}

impl LoadTangent<'_> {
    /// Whether there is any.
    pub(super) fn is_none(&self) -> bool {
        self.position.is_none() && self.velocity.is_none() && self.acceleration.is_none()
    }

    /// Derivative by the increments of a step, for row k and the columns of a node.
    pub(super) fn row(&self, k: usize, node: usize, trial: &Trial, turn: &DMat3) -> [f64; NODE] {
        let (w, width) = (trial.weights(), trial.increment.len());
        let part = |m: Option<&[f64]>| -> [f64; NODE] {
            m.map_or([0.0; NODE], |m| {
                std::array::from_fn(|j| m[k * width + NODE * node + j])
            })
        };
        let [p, v, a] = [self.position, self.velocity, self.acceleration].map(part);
        let place = through(&p, turn);
        std::array::from_fn(|j| place[j] + w.velocity * v[j] + w.acceleration * a[j])
    }
}

/// A row of derivatives by (dx, dtheta) times the derivative of these by the increments.
fn through(row: &[f64; NODE], turn: &DMat3) -> [f64; NODE] {
    let angles = turn.transpose() * DVec3::from_slice(&row[3..]);
    [row[0], row[1], row[2], angles.x, angles.y, angles.z]
}

/// Scratch of a step in time; allocates nothing after its first.
#[derive(Debug)]
pub struct Solver {
    pub(super) assembly: Assembly,
    /// Internal, damping and inertial forces less loads, six numbers a node.
    pub(super) residual: Vec<f64>,
    /// Right-hand side, then solution, of the free unknowns.
    pub(super) change: Vec<f64>,
    /// Internal forces of damping.
    damping: Vec<f64>,
    /// Loads of the last residual.
    pub(super) loads: Vec<f64>,
    /// Where stresses are foreseen from, and six increments a node.
    before: Configuration,
    ahead: Vec<f64>,
    pub(super) response: ResponseScratch,
}

impl Solver {
    /// Scratch for a structure.
    pub fn new(structure: &Structure) -> Self {
        Self {
            assembly: Assembly::new(structure),
            residual: vec![0.0; NODE * structure.nodes()],
            change: vec![0.0; structure.unknowns()],
            damping: vec![0.0; NODE * structure.nodes()],
            loads: vec![0.0; NODE * structure.nodes()],
            before: Configuration::default(),
            ahead: vec![],
            response: ResponseScratch::default(),
        }
    }

    /// Forces of a trial that are not balanced, six numbers a node (W components, moments in node components) [N, N m]:
    /// internal, damping and inertial forces less `loads`. At held numbers this is what the support has to carry.
    pub fn residual(
        &mut self,
        structure: &Structure,
        trial: &Trial,
        frame: &FrameMotion,
        loads: &[f64],
    ) -> &[f64] {
        self.loads.copy_from_slice(loads);
        let r = &mut self.residual;
        r.iter_mut().zip(loads).for_each(|(r, l)| *r = -l);
        let (at, velocity) = (&trial.configuration, &trial.velocity[..]);
        self.assembly.internal(structure, at, velocity, r);
        self.damping_forces(structure, trial);
        let r = &mut self.residual;
        r.iter_mut().zip(&self.damping).for_each(|(r, d)| *r += d);
        inertial(structure, &trial.motion(), frame, r);
        r
    }

    fn damping_forces(&mut self, structure: &Structure, trial: &Trial) {
        self.damping.fill(0.0);
        let motion = trial.motion();
        let d = structure.damping;
        if d.strain_rate > 0.0 {
            self.assembly.damping(
                structure,
                &trial.configuration,
                &trial.velocity,
                &mut self.damping,
            );
            self.damping.iter_mut().for_each(|f| *f *= d.strain_rate);
        }
        if d.mass > 0.0 {
            for (n, m) in structure.masses.iter().enumerate() {
                let node = motion.node(n);
                let momentum = inertia::momentum(m, &node).map(|p| d.mass * p);
                add_pair(&mut self.damping, n, momentum);
            }
            for m in &structure.between {
                let half = 0.5 * d.mass * m.mass * motion.middle(m.nodes).v;
                for n in m.nodes {
                    add_pair(&mut self.damping, n, [half, DVec3::ZERO]);
                }
            }
        }
    }

    /// Forces of damping in the last residual, six numbers a node (W components, moments in node components) [N, N m].
    pub fn damping(&self) -> &[f64] {
        &self.damping
    }

    /// Power that damping dissipates in a trial \[W\], from the last [`Self::residual`].
    pub fn dissipation(&self, trial: &Trial) -> f64 {
        let both = self.damping.iter().zip(&trial.velocity);
        both.map(|(f, v)| f * v).sum()
    }

    /// Assembles and factorises the derivative of the residual by the increments of the step, with the loads' part if
    /// `loads` has one (dense then).
    ///
    /// # Errors
    /// [`StructureError::Singular`].
    pub fn factor(
        &mut self,
        structure: &Structure,
        trial: &Trial,
        frame: &FrameMotion,
        loads: &LoadTangent<'_>,
    ) -> Result<(), StructureError> {
        self.factor_from(structure, trial, frame, loads, false)
    }

    /// Takes note of where the next stresses will be foreseen from: the trial before it is changed by `step`,
    /// increments of the free unknowns.
    pub fn look_ahead(&mut self, structure: &Structure, trial: &Trial, step: &[f64]) {
        self.before.clone_from(&trial.configuration);
        self.ahead.clear();
        self.ahead.resize(NODE * structure.nodes(), 0.0);
        for (&k, x) in structure.number.iter().zip(step) {
            self.ahead[k] = *x;
        }
        for n in 0..structure.nodes() {
            let angles = &mut self.ahead[NODE * n + 3..NODE * (n + 1)];
            let turned = right_jacobian(trial.turn(n)) * DVec3::from_slice(angles);
            turned.write_to_slice(angles);
        }
    }

    /// The same for a trial that has just been predicted.
    pub fn look_ahead_from_start(&mut self, trial: &Trial) {
        self.before.clone_from(&trial.start);
        self.ahead.clone_from(&trial.increment);
    }

    /// As [`Self::factor`], with the stresses that were to be foreseen in place of those of the trial
    /// ([`crate::Element::tangent_ahead`]): for trials far from balance.
    ///
    /// # Errors
    /// [`StructureError::Singular`].
    pub fn factor_ahead(
        &mut self,
        structure: &Structure,
        trial: &Trial,
        frame: &FrameMotion,
        loads: &LoadTangent<'_>,
    ) -> Result<(), StructureError> {
        self.factor_from(structure, trial, frame, loads, true)
    }

    fn factor_from(
        &mut self,
        structure: &Structure,
        trial: &Trial,
        frame: &FrameMotion,
        loads: &LoadTangent<'_>,
        looks_ahead: bool,
    ) -> Result<(), StructureError> {
        self.assembly.matrix.clear(!loads.is_none());
        let viscous = Viscous {
            time: structure.damping.strain_rate,
            rate: trial.weights().velocity,
            velocity: &trial.velocity,
        };
        let viscous = (viscous.time > 0.0).then_some(&viscous);
        let ahead = looks_ahead.then_some((&self.before, &self.ahead[..]));
        let turns = |n: usize| right_jacobian(trial.turn(n));
        self.assembly
            .tangent(structure, (&trial.configuration, ahead), viscous, &turns);
        for n in 0..structure.nodes() {
            let block = self.node_tangent(structure, trial, frame, n);
            self.assembly.add(structure, [n, n], &block);
        }
        for m in &structure.between {
            let node = trial.motion().middle(m.nodes);
            let t = inertia::tangents(&m.point(), frame, &node);
            let block = combined(&t, trial.weights(), DVec3::ZERO, structure.damping.mass);
            self.assembly.add_between(structure, m.nodes, &block);
        }
        if !loads.is_none() {
            self.add_loads(structure, trial, loads);
        }
        self.assembly.factor(structure)
    }

    /// Derivative of the inertial and mass-damping forces of node n by its increments.
    fn node_tangent(
        &self,
        structure: &Structure,
        trial: &Trial,
        frame: &FrameMotion,
        n: usize,
    ) -> SixBySix {
        let (m, node) = (&structure.masses[n], trial.motion().node(n));
        let t = inertia::tangents(m, frame, &node);
        combined(&t, trial.weights(), trial.turn(n), structure.damping.mass)
    }

    fn add_loads(&mut self, structure: &Structure, trial: &Trial, loads: &LoadTangent<'_>) {
        for n in 0..structure.nodes() {
            let turn = right_jacobian(trial.turn(n));
            for (i, &k) in structure.number.iter().enumerate() {
                let row = loads.row(k, n, trial, &turn);
                let columns = &structure.unknown[NODE * n..NODE * (n + 1)];
                for (&j, value) in columns.iter().zip(row).filter(|(j, _)| **j != HELD) {
                    self.assembly.matrix.add(i, j, -value);
                }
            }
        }
    }

    /// Solves with the factorised tangent: `x`, in the order of [`Structure::free_numbers`], is a force on the
    /// way in and an increment on the way out.
    pub fn solve(&mut self, x: &mut [f64]) {
        self.assembly.matrix.solve(x);
    }

    /// Ends a step: the trial, with what damping dissipated, becomes the state. To be called after
    /// [`Self::residual`] of the same trial.
    pub fn accept(&self, trial: &Trial, state: &mut State) {
        let power = self.dissipation(trial);
        state.dissipated += 0.5 * trial.weights().step * (state.dissipation + power);
        state.dissipation = power;
        state.configuration.clone_from(&trial.configuration);
        state.velocity.clone_from(&trial.velocity);
        state.acceleration.clone_from(&trial.acceleration);
        state.algorithmic.clone_from(&trial.algorithmic);
    }

    /// Power that goes into the elastic energy in the last residual's trial \[W\].
    pub fn strain_power(&self) -> f64 {
        self.assembly.power
    }

    /// Elastic energy of the last residual's trial \[J\].
    pub fn strain_energy(&self) -> f64 {
        self.assembly.energy
    }
}

impl Trial {
    /// Changes the increments of the step by those of the free unknowns, in the order of
    /// [`Structure::free_numbers`]; returns their size \[1\], the largest of rotations \[rad\] and translations
    /// over the size of the body.
    pub fn add(&mut self, structure: &Structure, change: &[f64]) -> f64 {
        apply(structure, change, self)
    }

    pub(crate) fn motion(&self) -> Motion<'_> {
        Motion {
            at: &self.configuration,
            velocity: &self.velocity,
            acceleration: &self.acceleration,
        }
    }
}

/// Changes a trial by increments of the free unknowns; returns their size, not a number where one of them is not.
pub(crate) fn apply(structure: &Structure, change: &[f64], trial: &mut Trial) -> f64 {
    let mut largest = 0.0_f64;
    for n in 0..structure.nodes() {
        let all = std::array::from_fn(|d| match structure.unknown[NODE * n + d] {
            HELD => 0.0,
            u => change[u],
        });
        trial.change(n, &all);
        largest = larger(largest, size(&all, structure.size()));
    }
    largest
}

/// Size of six increments \[1\]; not a number where one of them is not.
pub(crate) fn size(numbers: &[f64; NODE], length: f64) -> f64 {
    let [dx, turn] = pair(numbers, 0);
    larger(dx.length() / length, turn.length())
}

/// Adds the inertial forces of all nodes.
pub(crate) fn inertial(
    structure: &Structure,
    motion: &Motion<'_>,
    frame: &FrameMotion,
    out: &mut [f64],
) {
    for (n, m) in structure.masses.iter().enumerate() {
        add_pair(out, n, inertia::force(m, frame, &motion.node(n)));
    }
    for m in &structure.between {
        let [force, _] = inertia::force(&m.point(), frame, &motion.middle(m.nodes));
        for n in m.nodes {
            add_pair(out, n, [0.5 * force, DVec3::ZERO]);
        }
    }
}

/// Derivative of inertial and mass-damping forces by the increments of a step.
pub(crate) fn combined(
    t: &inertia::Tangents,
    w: Weights,
    turn: DVec3,
    mass_damping: f64,
) -> SixBySix {
    let zero = DMat3::ZERO;
    let jacobian = from_quarters([[DMat3::IDENTITY, zero], [zero, right_jacobian(turn)]]);
    let by_place = product(&t.position, &jacobian);
    let mass = w.acceleration + mass_damping * w.velocity;
    let mut sum = ZERO;
    for (i, j) in (0..NODE * NODE).map(|k| (k / NODE, k % NODE)) {
        sum[i][j] = by_place[i][j] + w.velocity * t.velocity[i][j] + mass * t.acceleration[i][j];
    }
    sum
}
