//! What the air remembers from step to step: circulations and wakes.

use crate::images::Mirror;
use crate::particles::Particles;
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

/// Positions and velocities of the nodes of all surfaces, concatenated in the order of the
/// surfaces, in the inertial frame N.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeMotion {
    /// Positions [m], N.
    pub position: Vec<DVec3>,
    /// Velocities [m/s], N.
    pub velocity: Vec<DVec3>,
}

/// The free rows of one wake sheet, **oldest row first**. The newest row of nodes, on the
/// shedding edge itself, is not stored: it follows the surface.
///
/// Ring (r, c) lies between node rows r and r + 1 (the shedding edge being the row after the
/// last) and node columns c and c + 1. Its circulation is positive if it runs its newer edge
/// from column c + 1 to column c.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct WakeSheet {
    /// Rings per row; a row has one node more.
    pub columns: usize,
    /// Free nodes [m], N, row by row.
    pub nodes: Points,
    /// Circulation of the rings [m2/s], row by row.
    pub gamma: Vec<f64>,
    /// Time at which each row of rings left the edge [s].
    pub shed_time: Vec<f64>,
    /// Velocity with which the nodes came here [m/s], N; empty unless convection looks back.
    pub velocity: Points,
    /// Oldest rows of each column whose rings have become particles. Their circulations are kept
    /// while a neighbour is still a ring.
    pub spent: Vec<usize>,
    /// Particles that were rings.
    pub particles: Particles,
}

/// Whether there are as many components of each kind, perhaps after reading a file.
pub(crate) fn is_whole(points: &Points) -> bool {
    points.y.len() == points.len() && points.z.len() == points.len()
}

impl WakeSheet {
    /// Number of rows of rings, which is the number of free rows of nodes.
    pub fn rows(&self) -> usize {
        self.shed_time.len()
    }

    /// Node `column` of free row `row`, counted from the oldest [m], N.
    pub fn node(&self, row: usize, column: usize) -> DVec3 {
        let k = row * (self.columns + 1) + column;
        DVec3::new(self.nodes.x[k], self.nodes.y[k], self.nodes.z[k])
    }

    /// Impulse per density [m4/s], N, of the rings of the oldest `rows` rows.
    pub(crate) fn impulse_of_oldest(&self, rows: usize) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for r in 0..rows.min(self.rows().saturating_sub(1)) {
            for c in 0..self.columns {
                let at = |r: usize, c: usize| self.node(r, c);
                let ring = [at(r + 1, c + 1), at(r + 1, c), at(r, c), at(r, c + 1)];
                let area = (ring[2] - ring[0]).cross(ring[3] - ring[1]);
                sum += 0.5 * self.gamma[r * self.columns + c] * area;
            }
        }
        sum
    }

    /// Drops the oldest rows until at most `rows` are left. Whole rings go, so every filament
    /// that is left is still part of closed rings.
    pub(crate) fn keep(&mut self, rows: usize) {
        let drop = self.rows().saturating_sub(rows);
        let nodes = drop * (self.columns + 1);
        drop_first(&mut self.nodes, nodes);
        drop_first(&mut self.velocity, nodes);
        self.gamma.drain(..drop * self.columns);
        self.shed_time.drain(..drop);
        self.spent
            .iter_mut()
            .for_each(|s| *s = s.saturating_sub(drop));
    }
}

impl WakeSheet {
    /// Takes the nodes of the twin sheet `lead`, which has been moved and truncated already, after
    /// its own row was shed; returns how many rows were dropped.
    pub(crate) fn follow(&mut self, lead: &WakeSheet, mirror: Mirror) -> u64 {
        self.nodes.clear();
        let places = lead.nodes.iter().map(|x| mirror.place(x));
        places.for_each(|x| self.nodes.push(x));
        self.velocity.clear();
        let velocities = lead.velocity.iter().map(|v| mirror.vector(v));
        velocities.for_each(|v| self.velocity.push(v));
        let drop = self.rows() - lead.rows();
        self.gamma.drain(..drop * self.columns);
        self.shed_time.drain(..drop);
        self.spent.clone_from(&lead.spent);
        self.particles.follow(&lead.particles, mirror);
        drop as u64
    }
}

fn drop_first(points: &mut Points, n: usize) {
    let n = n.min(points.len());
    for c in [&mut points.x, &mut points.y, &mut points.z] {
        c.drain(..n);
    }
}

/// How often the wake had to be tamed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct WakeEvents {
    /// Displacements shortened to [`crate::AirSettings::max_displacement`], and strengths
    /// of particles held to a change of half in a step and twice their first size in all.
    pub limited: u64,
    /// Wake nodes and particles kept at [`crate::AirSettings::clearance`] from a surface.
    pub near_surface: u64,
    /// Rows of wake that were dropped.
    pub dropped_rows: u64,
    /// Particles made of rings.
    pub new_particles: u64,
    /// Particles that were dropped.
    pub dropped_particles: u64,
}

impl std::ops::AddAssign for WakeEvents {
    fn add_assign(&mut self, other: Self) {
        self.limited += other.limited;
        self.near_surface += other.near_surface;
        self.dropped_rows += other.dropped_rows;
        self.new_particles += other.new_particles;
        self.dropped_particles += other.dropped_particles;
    }
}

/// The state of the air: plain data, enough to go on bit for bit.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct AirState {
    /// Accepted steps so far.
    pub step: u64,
    /// Time of the last accepted step [s].
    pub time: f64,
    /// Whether the step was accepted but the wake not yet moved.
    pub wake_due: bool,
    /// Circulation of the panels at the last accepted step [m2/s].
    pub gamma: Vec<f64>,
    /// Circulation one accepted step earlier [m2/s].
    pub gamma_before: Vec<f64>,
    /// Time between these two [s].
    pub dt_before: f64,
    /// What the separation criterion compares with its threshold, for each leading-edge strip,
    /// at the last accepted step.
    pub leading: Vec<f64>,
    /// Length of the last step of the wakes [s], zero before it.
    pub dt_wake: f64,
    /// Positions of the surface nodes at the last accepted step [m], N.
    pub position: Vec<DVec3>,
    /// Their velocities [m/s], N.
    pub velocity: Vec<DVec3>,
    /// Momentum of the fictitious fluid inside each surface (zero for open ones) at the last
    /// accepted step [kg m/s], N.
    pub inner_momentum: Vec<DVec3>,
    /// Wake sheets, in the order of [`crate::Lattice::sheets`].
    pub sheets: Vec<WakeSheet>,
    /// Regularised events since the start.
    pub events: WakeEvents,
    /// Impulse per density of rings and particles when they were dropped [m4/s], N.
    pub dropped_impulse: DVec3,
}
