//! How the forces of a surface answer to normal velocities of its panels: the lattice's own added mass, and what the
//! circulation does meanwhile.
//!
//! In frozen wakes the circulations are linear in the normal velocities w of the panels, `dGamma = A^-1 dw`, A
//! the influence of the surface on itself; pressures are linear in the circulations, by their rate of change
//! and by the jump of the tangential velocity. Other surfaces, the images and the tilt of the panels are left
//! out: this is for the left-hand side of a coupled step, whose right-hand side knows all of it.

use crate::error::AirError;
use crate::lattice::Lattice;
use crate::loads::{AirLoads, couple_of_rate, rate_weights};
use crate::settings::CirculationRate;
use crate::state::AirState;
use crate::workspace::{AirWorkspace, ResponseRoom};
use wingbeat_math::DVec3;

impl Lattice {
    /// Derivative of the normal forces of the panels of the open surface `s` by the normal velocities of their
    /// control points \[N s/m\], row by row into `response`, at the instant that `ws` and `loads` were last asked for
    /// ([`Self::loads`]): of one half where only that is computed the other's answers are its mirror image.
    ///
    /// # Errors
    /// A singular influence matrix.
    pub fn normal_response(
        &self,
        s: usize,
        state: &AirState,
        (ws, loads): (&mut AirWorkspace, &AirLoads),
        response: &mut Vec<f64>,
    ) -> Result<(), AirError> {
        let panels = self.panels_of(s);
        let n = panels.len();
        self.take_circulation_by_wash(s, state, ws)?;
        let inverse = &ws.response.inverse;
        response.clear();
        response.resize(n * n, 0.0);
        for (i, p) in panels.clone().enumerate() {
            for (j, weight) in self.force_by_circulation(p, state, ws, loads) {
                let Some(j) = j.checked_sub(panels.start).filter(|j| *j < n) else {
                    continue;
                };
                for k in 0..n {
                    response[i * n + k] += weight * inverse[k * n + j];
                }
            }
        }
        Ok(())
    }

    /// Derivative of the normal forces of the panels of the open surface `s` by the normal accelerations of
    /// their control points \[kg\], row by row into `response`, at the instant that `ws` and `loads` were last asked
    /// for: the added mass, its sign turned.
    ///
    /// # Errors
    /// A singular influence matrix.
    pub fn normal_inertia(
        &self,
        s: usize,
        state: &AirState,
        (ws, loads): (&mut AirWorkspace, &AirLoads),
        response: &mut Vec<f64>,
    ) -> Result<(), AirError> {
        let n = self.panels_of(s).len();
        self.take_circulation_by_wash(s, state, ws)?;
        let inverse = &ws.response.inverse;
        let areas = &loads.panels.area[self.panels_of(s)];
        let rho = self.settings().density;
        let entry = |(area, q): (f64, usize)| rho * area * inverse[q];
        let rows = (0..n).flat_map(|i| (0..n).map(move |k| (areas[i], k * n + i)));
        response.clear();
        response.extend(rows.map(entry));
        Ok(())
    }

    /// Force \[N\] and couple about its control point \[N m\] of panel `p` of an open surface where its circulation
    /// changes at this `rate` \[m2/s2\], N components, at the instant that `ws` and `loads` were last asked for.
    pub fn loads_of_rate(
        &self,
        p: usize,
        rate: f64,
        (ws, loads): (&AirWorkspace, &AirLoads),
    ) -> [DVec3; 2] {
        let (area, normal) = (loads.panels.area[p], loads.panels.normal[p]);
        let force = self.settings().density * rate * area * normal;
        let couple = couple_of_rate(self, &ws.filaments, p, force);
        [force, couple.unwrap_or_default()]
    }

    /// Weights of the circulations now, `dt` \[s\] after the last accepted step, in that step and in the one
    /// before in their rate of change \[1/s\]; none where the loads leave that out
    /// ([`CirculationRate::Omitted`]).
    pub fn circulation_rate_weights(&self, state: &AirState, dt: f64) -> Option<[f64; 3]> {
        let is_omitted = self.settings().rate == CirculationRate::Omitted;
        (!is_omitted).then(|| rate_weights(self, state, dt))
    }

    /// Takes the circulations of the panels of the surface `s` by normal velocities.
    fn take_circulation_by_wash(
        &self,
        s: usize,
        state: &AirState,
        ws: &mut AirWorkspace,
    ) -> Result<(), AirError> {
        let panels = self.panels_of(s);
        let ResponseRoom {
            matrix,
            inverse,
            lu,
        } = &mut ws.response;
        lu.resize(panels.len());
        ws.boundary.influence.block(self, panels, matrix);
        lu.factor(matrix).map_err(|source| AirError::Singular {
            step: state.step,
            source,
        })?;
        lu.inverse(inverse);
        Ok(())
    }

    /// How the normal velocity of panel `p`, that of the surface less that of the air, changes with the nodes
    /// of its surface (their numbers on it), at the instant of `ws` and `loads`, all nodes of the surfaces
    /// being at `position` [m, N]; some nodes several times. Of each node by its velocity \[1\] and by its place \[1/s\], N
    /// components; the first is also how the node shares in a normal force of the panel.
    pub fn normal_wash(
        &self,
        p: usize,
        ws: &AirWorkspace,
        (loads, position): (&AirLoads, &[DVec3]),
        mut see: impl FnMut(usize, [DVec3; 2]),
    ) {
        let first = self.nodes_of(self.topology().panel_surface[p]).start;
        let corners = self.topology().panels[p];
        let normal = ws.wash.normal[p];
        let slip = ws.wash.velocity[p] - loads.velocity[p];
        let slip = slip - slip.dot(normal) * normal;
        let nodes = (&corners, &ws.wash.nodes.position[..]);
        (self.controls()).wash(p, nodes, [normal, slip], |n, [by_velocity, by_place]| {
            let (rings, aft) = (self.rings(), self.rings().aft());
            (ws.wash).spread((n, aft), &ws.rings, by_velocity, |n, v| {
                rings.spread((n, position), v, |n, v| see(n - first, [v, DVec3::ZERO]));
            });
            (ws.wash).spread((n, aft), &ws.rings, by_place, |n, v| {
                rings.spread((n, position), v, |n, v| see(n - first, [DVec3::ZERO, v]));
            });
        });
    }

    /// Secant of the normal force of panel `p` by circulations, the derivative where edges hold nothing or all:
    /// (panel, weight \[N s/m2\]), some panels twice.
    fn force_by_circulation<'a>(
        &'a self,
        p: usize,
        state: &'a AirState,
        ws: &'a AirWorkspace,
        loads: &'a AirLoads,
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        let (topology, bound) = (self.topology(), &ws.filaments.bound);
        let rho = self.settings().density;
        let normal = loads.panels.normal[p];
        let relative = loads.velocity[p] - loads.panels.velocity[p];
        let [rate, ..] = rate_weights(self, state, loads.dt);
        let own = (p, rho * rate * loads.panels.area[p]);
        let edges = topology.panel_edges[p].iter().flat_map(move |e| {
            let edge = &topology.edges[e.edge];
            let [a, b]: [DVec3; 2] = [edge.from, edge.to].map(|n| bound.nodes.get(n));
            let net = bound.gamma[e.edge];
            let weight = self.felt_part(state, edge, net, &ws.filaments.newest);
            let weight = rho * weight * relative.dot((b - a).cross(normal));
            let minus = edge.minus.map(|q| (q, -weight));
            std::iter::once((edge.plus, weight)).chain(minus)
        });
        std::iter::once(own).chain(edges)
    }
}
