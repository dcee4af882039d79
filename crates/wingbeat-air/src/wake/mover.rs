//! Moves wake nodes with the velocities of the accepted step.

use crate::images::{Plane, ROUNDING};
use crate::lattice::Lattice;
use crate::state::{WakeEvents, WakeSheet};
use crate::wake::contact::Obstacles;
use crate::wake::particle_flow::ParticleFlow;
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

/// Walks through the wake nodes and particles of all sheets in order and moves them.
pub(crate) struct Mover<'a> {
    pub lattice: &'a Lattice,
    pub nodes: &'a Points,
    pub velocity: &'a Points,
    /// Largest displacement relative to the undisturbed air [m].
    pub limit: f64,
    pub time: f64,
    pub dt: f64,
    pub looks_back: bool,
    /// Weight of the change of velocity since the step before.
    pub change: f64,
    pub obstacles: &'a Obstacles,
    /// Next node and particle of all sheets.
    pub next: usize,
    /// First node of the sheet moved last.
    pub first: usize,
    pub flow: &'a ParticleFlow,
    pub next_particle: usize,
    pub events: WakeEvents,
    /// Paths of the nodes or particles of a sheet.
    pub from: Vec<DVec3>,
    pub to: Vec<DVec3>,
    /// Where the nodes of the sheet would be without surfaces in the way; empty if none was held back.
    pub unhindered: Vec<DVec3>,
    /// Impulse per density [m4/s], N components, that surfaces in the way took from the particles of the sheet
    /// moved last.
    pub taken_from_particles: DVec3,
}

impl Mover<'_> {
    /// Fills `sheet` with its moved nodes, those that were on the shedding edge being the new last row. The
    /// error is (row from the newest, column, velocity). Nodes that left the `middle` of a body, a column of
    /// the sheet, move as those that left the root do, until [`super::joined_nodes`] puts them between both
    /// roots'.
    pub(crate) fn move_nodes(
        &mut self,
        sheet: &mut WakeSheet,
        middle: Option<usize>,
    ) -> Result<(), (usize, usize, DVec3)> {
        let (mut from, mut to) = (std::mem::take(&mut self.from), std::mem::take(&mut self.to));
        let (rows, width) = (sheet.rows() + 1, sheet.columns + 1);
        let nodes = self.next..self.next + rows * width;
        (self.first, self.next) = (nodes.start, nodes.end);
        from.clear();
        from.extend(nodes.clone().map(|k| self.nodes.get(k)));
        to.clear();
        // A sheet with a middle has two columns of nodes.
        let leads = |i: usize| i ^ usize::from(middle == Some(i % width));
        for (i, &x) in from.iter().enumerate() {
            let v = self.velocity.get(nodes.start + leads(i));
            let stream = self.lattice.stream(x, self.time);
            let past = (i < sheet.velocity.len()).then(|| sheet.velocity.get(leads(i)));
            let change = past.map_or(DVec3::ZERO, |past| self.change * (v + stream - past));
            let end = x + (self.dt * stream + self.displacement(v + change));
            if !end.is_finite() {
                return Err((rows - 1 - i / width, i % width, v));
            }
            to.push(end);
        }
        if self.looks_back {
            sheet.velocity.clear();
            for (i, k) in nodes.enumerate() {
                let stream = self.lattice.stream(from[i], self.time);
                sheet.velocity.push(self.velocity.get(k) + stream);
            }
        }
        self.unhindered.clear();
        self.unhindered.extend_from_slice(&to);
        let has_strength = |i: usize| sheet.has_strength(i / width);
        let held_back = match middle {
            None => self.keep_clear(&from, &mut to, has_strength),
            // The middle is within the body.
            Some(middle) => (1 - middle..to.len())
                .step_by(width)
                .map(|i| self.keep_clear(&from[i..=i], &mut to[i..=i], |_| has_strength(i)))
                .sum(),
        };
        if held_back == 0 {
            self.unhindered.clear();
        }
        sheet.nodes.clear();
        to.iter().for_each(|&x| sheet.nodes.push(x));
        (self.from, self.to) = (from, to);
        Ok(())
    }

    /// Keeps ends of paths off surfaces and on their side of planes; returns how many it changed. Those that have
    /// `strength` are events.
    pub(crate) fn keep_clear(
        &mut self,
        from: &[DVec3],
        to: &mut [DVec3],
        strength: impl Fn(usize) -> bool + Sync,
    ) -> u64 {
        let [mut all, mut strong] = match self.lattice.settings().plane_wakes {
            true => self.obstacles.keep_rows_off(from, to, &strength),
            false => self.obstacles.keep_off(from, to, &strength),
        };
        for plane in &self.lattice.settings().images {
            let [of_all, of_strong] = keep_on_side(plane, from, to, &strength);
            (all, strong) = (all + of_all, strong + of_strong);
        }
        self.events.near_surface += strong;
        all
    }

    /// Where a node of the `sheet` moved last was before [m], N; the last row was the shedding edge.
    pub(crate) fn node_before(&self, row: usize, sheet: &WakeSheet, column: usize) -> DVec3 {
        self.nodes
            .get(self.first + row * (sheet.columns + 1) + column)
    }

    /// Displacement relative to the undisturbed air, shortened to the limit.
    pub(crate) fn displacement(&mut self, v: DVec3) -> DVec3 {
        let d = self.dt * v;
        let length = d.length();
        if length > self.limit {
            self.events.limited += 1;
            return d * (self.limit / length);
        }
        d
    }
}

/// Nodes that would go through a plane of symmetry or a ground end on it; returns how many, all and those that have
/// `strength`. There they and their images cancel.
fn keep_on_side(
    plane: &Plane,
    from: &[DVec3],
    to: &mut [DVec3],
    strength: impl Fn(usize) -> bool,
) -> [u64; 2] {
    let mut count = [0; 2];
    for (i, (a, b)) in from.iter().zip(to).enumerate() {
        if plane.height(*a) * plane.height(*b) < 0.0 {
            // What moves along the plane lies now on one side of it, now on the other, by roundings.
            let changed = plane.height(*b).abs() > ROUNDING * a.distance(*b);
            *b = plane.foot(*b);
            let of = [changed, changed && strength(i)].map(u64::from);
            count = [count[0] + of[0], count[1] + of[1]];
        }
    }
    count
}
