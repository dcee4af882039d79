//! The boundary condition: no air goes through the surfaces.

use crate::error::AirError;
use crate::lattice::Lattice;
use crate::solve::influence::{Influence, Instant};
use crate::solve::leading_edges::{FreeWakes, LeadingEdges};
use crate::solve::unknowns::{panel, unknowns};
use crate::wake::{Filaments, NEAR, Sums, WakeVelocityCache};
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

/// Memory of the solution for the circulations.
#[derive(Default)]
pub(crate) struct BoundaryCondition {
    pub influence: Influence,
    /// Control points of the unknowns.
    points: Points,
    /// Velocity there without the undisturbed air: of the free wakes, then of all.
    velocity: Points,
    /// Velocity there of near wakes and shedding edges without the panels' circulations.
    near_velocity: Points,
    free_wake: WakeVelocityCache,
    pub leading_edges: LeadingEdges,
    /// Uniform normal velocity that the rings of each surface could not make [m/s].
    pub net_flux_residual: Vec<f64>,
}

impl BoundaryCondition {
    /// Circulations of the panels and what leaves the leading edges: the rings make up for what motion, stream
    /// and wakes leave. The filaments are those of this instant.
    ///
    /// # Errors
    /// Equations without a unique solution.
    pub(crate) fn solve(
        &mut self,
        now: Instant,
        filaments: &mut Filaments,
        sums: &mut Sums,
        [gamma, leaving]: [&mut Vec<f64>; 2],
    ) -> Result<(), AirError> {
        let lattice = now.lattice;
        for (list, count) in [
            (&mut *gamma, lattice.panel_count()),
            (&mut *leaving, lattice.strips().len()),
        ] {
            list.clear();
            list.resize(count, 0.0);
        }
        filaments.set_bound(lattice, now.state, [gamma, leaving]);
        self.wake_velocity(now, filaments, sums);
        self.right_side(now, gamma);
        self.influence.assemble(now, filaments);
        self.influence.carry(lattice, gamma);
        let found = &mut gamma[..self.points.len()];
        self.influence.solve(lattice, now.state, found)?;
        let near = NEAR * now.panels.size();
        let wakes = FreeWakes { sums, near };
        let (influence, found) = (&mut self.influence, (found, &mut leaving[..]));
        (self.leading_edges).converge(now, (filaments, wakes), influence, found)?;
        (self.influence).spread(lattice, gamma, &mut self.net_flux_residual);
        Ok(())
    }

    /// Velocity at the control points of the wakes alone. Their near parts and their share of the
    /// shedding edges come from the filaments with no circulation on the panels.
    fn wake_velocity(&mut self, now: Instant, filaments: &Filaments, sums: &mut Sums) {
        let (lattice, panels) = (now.lattice, now.panels);
        let (settings, mirrors) = (lattice.settings(), lattice.mirrors());
        self.points.clear();
        let points = (0..unknowns(lattice)).map(|i| panels.point[panel(lattice, i)]);
        points.for_each(|x| self.points.push(x));
        let near = NEAR * panels.size();
        sums.load_free(settings, filaments, near);
        let (points, velocity) = (&self.points, &mut self.velocity);
        (self.free_wake).velocity(sums, points, near, mirrors, velocity);
        self.near_velocity.reset(points.len());
        sums.load_attached(settings, filaments);
        sums.add_attached(points, mirrors, &mut self.near_velocity);
    }

    /// The normal velocities that the rings have to make.
    fn right_side(&self, now: Instant, gamma: &mut [f64]) {
        let panels = now.panels;
        for (i, right) in gamma[..self.points.len()].iter_mut().enumerate() {
            let p = panel(now.lattice, i);
            let stream = now.lattice.stream(panels.point[p], now.time);
            let v = stream + self.velocity.get(i) + self.near_velocity.get(i);
            *right = (now.wash.velocity[p] - v).dot(now.wash.normal[p]);
        }
    }

    /// Velocity of the air at all control points [m/s], N: that of stream and wakes, and of the lattice with these
    /// circulations and what leaves its leading edges.
    pub(crate) fn velocities(
        &mut self,
        now: Instant,
        filaments: &mut Filaments,
        sums: &mut Sums,
        found: [&[f64]; 2],
        out: &mut Vec<DVec3>,
    ) {
        let lattice: &Lattice = now.lattice;
        filaments.set_bound(lattice, now.state, found);
        sums.load_attached(lattice.settings(), filaments);
        sums.add_attached(&self.points, lattice.mirrors(), &mut self.velocity);
        if let Some(symmetry) = lattice.symmetry() {
            symmetry.reflect(&self.velocity, &mut self.near_velocity);
            std::mem::swap(&mut self.velocity, &mut self.near_velocity);
        }
        out.clear();
        let at = now.panels.point.iter().zip(self.velocity.iter());
        out.extend(at.map(|(&x, v)| lattice.stream(x, now.time) + v));
    }
}
