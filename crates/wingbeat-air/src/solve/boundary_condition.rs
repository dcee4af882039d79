//! The boundary condition: no air goes through the surfaces.

use crate::error::AirError;
use crate::lattice::Lattice;
use crate::solve::influence::{Influence, Instant};
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
    /// Uniform normal velocity that the rings of each surface could not make [m/s].
    pub net_flux_residual: Vec<f64>,
}

impl BoundaryCondition {
    /// Circulations of the panels: the rings make up for what motion, stream and wakes leave. The filaments are
    /// those of this instant.
    ///
    /// # Errors
    /// Equations without a unique solution.
    pub(crate) fn solve(
        &mut self,
        now: Instant,
        filaments: &mut Filaments,
        sums: &mut Sums,
        gamma: &mut Vec<f64>,
    ) -> Result<(), AirError> {
        gamma.clear();
        gamma.resize(now.lattice.panel_count(), 0.0);
        filaments.set_bound(now.lattice, now.state, gamma);
        self.wake_velocity(now, filaments, sums);
        self.right_side(now, gamma);
        self.influence.assemble(now, filaments);
        (self.influence).solve(now.lattice, now.state, gamma, &mut self.net_flux_residual)
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
            *right = (panels.velocity[p] - v).dot(panels.normal[p]);
        }
    }

    /// Velocity of the air at all control points [m/s], N: that of stream and wakes, and of the lattice with these
    /// circulations.
    pub(crate) fn velocities(
        &mut self,
        now: Instant,
        filaments: &mut Filaments,
        sums: &mut Sums,
        gamma: &[f64],
        out: &mut Vec<DVec3>,
    ) {
        let lattice: &Lattice = now.lattice;
        filaments.set_bound(lattice, now.state, gamma);
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
