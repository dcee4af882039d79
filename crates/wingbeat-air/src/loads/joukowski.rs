//! Forces on segments: Joukowski's theorem, and Polhamus's analogy and vortex lift built on it.
//!
//! A segment l of net circulation G that moves with the surface at U in air of velocity V feels
//! `rho G (V - U) x l`; the panels feel `rho A dG/dt` along their normals besides. In sum this is the
//! pressure on the sheet and the suction at its free edges. Of a segment of an edge that sheds a
//! part is wake and feels nothing.

use crate::geometry::{Edge, NodeMotion, Strip, column, section};
use crate::lattice::Lattice;
use crate::loads::lag::add_lag;
use crate::loads::leading_strip::add_front;
use crate::loads::rate::couple_of_rate;
use crate::loads::values::AirLoads;
use crate::loads::vortex_lift::yielding;
use crate::settings::{LeadingEdge, LoadMethod, VortexLift};
use crate::solve::is_computed;
use crate::state::AirState;
use crate::wake::{Filaments, NEAR, Sums, WakeVelocityCache};
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

/// Where on a segment the velocity is taken, from 0 to 1: in the middle; at Gauss's two points where the force is to be
/// what the segment does to the rest of the flow, reversed.
fn places(lattice: &Lattice) -> &'static [f64] {
    const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
    match lattice.settings().is_symmetric() {
        true => &GAUSS,
        false => &[0.5],
    }
}

/// Whether an edge bounds a panel of an open surface that is computed: the others' forces are not needed.
fn is_wanted(lattice: &Lattice, edge: &Edge) -> bool {
    let is_open = |p: usize| !lattice.surfaces()[lattice.topology().panel_surface[p]].closed;
    let mut panels = [Some(edge.plus), edge.minus].into_iter().flatten();
    panels.any(|p| is_open(p) && is_computed(lattice, p))
}

/// Velocities and forces of the bound segments.
#[derive(Default)]
pub(crate) struct Segments {
    /// Edges of open surfaces on the half that is computed.
    edges: Vec<usize>,
    /// Places on the segments, as many on each, and the velocity of the air relative to them.
    place: Points,
    velocity: Points,
    /// What of it the free wakes make.
    free_wake: WakeVelocityCache,
    /// Force and moment of the segments on each panel.
    panel_force: Vec<[DVec3; 2]>,
    /// What of the force the segments along the span have, of panels behind leading edges [N], N.
    spanwise_force: Vec<DVec3>,
    /// Force that is added at the leading edge of each strip [N], N.
    at_edge: Vec<DVec3>,
}

/// The flow around the segments: all sources are in the sums, with their circulations.
pub(crate) struct Flow<'a> {
    pub filaments: &'a Filaments,
    pub sums: &'a mut Sums,
    /// Nodes of the rings as they meet the surfaces.
    pub rings: &'a NodeMotion,
}

impl Segments {
    /// Gives (or completes) the forces of open surfaces as [`LoadMethod`] says, and takes the
    /// inviscid force of all surfaces.
    pub(crate) fn add_forces(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        motion: &NodeMotion,
        flow: Flow,
        out: &mut AirLoads,
    ) {
        let filaments = flow.filaments;
        self.take_velocities(lattice, flow, NEAR * out.panels.size(), out.time);
        self.collect(lattice, state, filaments, &out.panels.point);
        let method = lattice.settings().loads;
        let suction = match method {
            LoadMethod::Joukowski => {
                self.joukowski((lattice, state), filaments, &motion.position, out);
                add_front(lattice, state, filaments, &motion.position, out);
                DVec3::ZERO
            }
            LoadMethod::Pressure | LoadMethod::Polhamus => self.suction(&out.panels.normal),
        };
        out.inviscid_force = out.force.iter().sum::<DVec3>() + suction;
        out.fed.clear();
        out.fed.resize(lattice.strips().len(), 0.0);
        match method {
            LoadMethod::Joukowski => match lattice.settings().leading {
                LeadingEdge::VortexLift(law) => {
                    self.vortex_lift(state, (lattice, &law), (filaments, motion), out);
                }
                _ => self.lose_suction(lattice, out),
            },
            LoadMethod::Polhamus => self.polhamus(lattice, motion, out),
            LoadMethod::Pressure => {}
        }
    }

    /// What pressures lack: the parts of the segments' forces along the panels. In their sum those of segments inside a
    /// surface are the pressure's on curved ones, what is left pulls at the edges.
    fn suction(&self, normals: &[DVec3]) -> DVec3 {
        (0..normals.len()).map(|p| self.along(p, normals)).sum()
    }

    /// Part of the segments' force on a panel along it.
    fn along(&self, p: usize, normals: &[DVec3]) -> DVec3 {
        let ([force, _], n) = (self.panel_force[p], normals[p]);
        force - force.dot(n) * n
    }

    /// Suction of the leading edge of a strip [N], normal to it: what the segments along the span pull forward along the
    /// column of panels, over the cosine of the sweep. Pressure on camber is no suction, and what pulls at the segments
    /// along the chord is that of side edges: on a wing swept back by 45 deg it has a part normal to the leading edge a
    /// quarter as large as the suction there.
    fn leading_suction(&self, strip: &Strip, position: &[DVec3], normals: &[DVec3]) -> f64 {
        let along = |&p: &usize| {
            let (force, n) = (self.spanwise_force[p], normals[p]);
            force - force.dot(n) * n
        };
        let pull: DVec3 = strip.panels.iter().map(along).sum();
        let first = normals[strip.panels[0]];
        let [aft, back] = [section(strip, position).0, column(strip, position)]
            .map(|x| (x - x.dot(first) * first).normalize_or_zero());
        // Segments farther aft may have less sweep, as those of a delta wing.
        -pull.dot(back) / aft.dot(back)
    }

    /// Velocity of the air relative to the places on the segments that are wanted.
    /// That of the free wakes is not summed again for places that have moved less than `near` [m].
    fn take_velocities(&mut self, lattice: &Lattice, flow: Flow, near: f64, t: f64) {
        let bound = &flow.filaments.bound;
        let (places, settings) = (places(lattice), lattice.settings());
        self.place.clear();
        self.edges.clear();
        let all = lattice.topology().edges.iter().enumerate();
        let wanted = all.filter(|(_, edge)| is_wanted(lattice, edge));
        self.edges.extend(wanted.map(|(e, _)| e));
        for &e in &self.edges {
            let (a, b) = bound.ends(e);
            for s in places {
                self.place.push(a.lerp(b, *s));
            }
        }
        if settings.is_symmetric() {
            let core = bound.nodes.core[0];
            self.place.core.resize(self.place.len(), core);
        }
        let (points, sum) = (&self.place, &mut self.velocity);
        let (sums, mirrors) = (flow.sums, lattice.mirrors());
        (self.free_wake).velocity(sums, points, near, mirrors, sum);
        sums.add_attached(points, mirrors, sum);
        for (at, &e) in self.edges.iter().enumerate() {
            let [a, b] = bound.edges[e].map(|n| flow.rings.velocity[n as usize]);
            for (i, s) in places.iter().enumerate() {
                let k = at * places.len() + i;
                let v = sum.get(k) + lattice.stream(points.get(k), t) - a.lerp(b, *s);
                sum.set(k, v);
            }
        }
    }

    /// Force and moment about the control point that the segments give to every panel of an open
    /// surface; a shared segment gives half to either side.
    fn collect(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        filaments: &Filaments,
        points: &[DVec3],
    ) {
        let bound = &filaments.bound;
        let (rho, count) = (lattice.settings().density, places(lattice).len());
        self.panel_force.clear();
        self.panel_force
            .resize(lattice.panel_count(), [DVec3::ZERO; 2]);
        self.spanwise_force.clear();
        self.spanwise_force
            .resize(lattice.panel_count(), DVec3::ZERO);
        for (at, &e) in self.edges.iter().enumerate() {
            let edge = &lattice.topology().edges[e];
            let l = bound.nodes.get(edge.to) - bound.nodes.get(edge.from);
            let circulation = rho * bound.gamma[e] / count as f64;
            let part = lattice.felt_part(state, edge, bound.gamma[e], &filaments.newest);
            for k in at * count..(at + 1) * count {
                let share = part * (circulation * self.velocity.get(k).cross(l));
                for p in [Some(edge.plus), edge.minus].into_iter().flatten() {
                    let arm = self.place.get(k) - points[p];
                    self.panel_force[p][0] += share;
                    self.panel_force[p][1] += arm.cross(share);
                    if lattice.is_spanwise(e) {
                        self.spanwise_force[p] += share;
                    }
                }
            }
        }
        let Some(symmetry) = lattice.symmetry() else {
            return;
        };
        for &p in &symmetry.computed {
            let [force, moment] = self.panel_force[p];
            let image = symmetry.panel[p];
            if image != p {
                let vector = |v| symmetry.mirror.vector(v);
                self.panel_force[image] = [vector(force), -vector(moment)];
                self.spanwise_force[image] = vector(self.spanwise_force[p]);
            }
        }
    }

    fn joukowski(
        &self,
        (lattice, state): (&Lattice, &AirState),
        filaments: &Filaments,
        position: &[DVec3],
        out: &mut AirLoads,
    ) {
        let rho = lattice.settings().density;
        for p in 0..lattice.panel_count() {
            let surface = lattice.topology().panel_surface[p];
            if lattice.surfaces()[surface].closed {
                continue;
            }
            let unsteady = rho * out.gamma_rate[p] * out.panels.area[p] * out.panels.normal[p];
            let [force, moment] = self.panel_force[p];
            out.force[p] = force + unsteady;
            let aside = couple_of_rate(lattice, filaments, p, unsteady);
            out.couple[p] = aside.map_or(moment, |couple| moment + couple);
        }
        add_lag(lattice, state, filaments, position, out);
    }

    /// Takes from strips behind leading edges that may shed what their suction lacks of the force it would have
    /// on round ones, and whatever else pulls along them: what acts on a thin plate is normal to it.
    fn lose_suction(&self, lattice: &Lattice, out: &mut AirLoads) {
        let Some([_, efficiency]) = lattice.settings().leading.suction() else {
            return;
        };
        let edges = &lattice.topology().edges;
        let strips = lattice.strips().iter();
        for strip in strips.filter(|s| efficiency < 1.0 && edges[s.edge].wake.is_some()) {
            for &p in &strip.panels {
                let n = out.panels.normal[p];
                out.force[p] -= (1.0 - efficiency) * self.along(p, &out.panels.normal);
                let turning = out.couple[p].dot(n) * n;
                out.couple[p] -= (1.0 - efficiency) * turning;
            }
        }
    }

    /// Makes of the suction and of the normal forces of all strips what their leading edges hold and the
    /// vortices there leave of them.
    fn vortex_lift(
        &mut self,
        state: &AirState,
        (lattice, law): (&Lattice, &VortexLift),
        (filaments, motion): (&Filaments, &NodeMotion),
        out: &mut AirLoads,
    ) {
        let dt = if state.step > 0 { out.dt } else { 0.0 };
        self.at_edge.clear();
        for (k, strip) in lattice.strips().iter().enumerate() {
            let strip_now = yielding((lattice, law), strip, motion, (state.fed[k], dt), out);
            let parts = strip_now.parts;
            out.fed[k] = strip_now.fed;
            let suction = self.leading_suction(strip, &motion.position, &out.panels.normal);
            let side = strip_now.parameter.signum() * out.panels.normal[strip.panels[0]];
            self.at_edge.push(parts.vortex * suction * side);
            self.slacken(strip, 1.0 - parts.suction, &out.panels.normal);
            if parts.normal < 1.0 {
                self.weaken(strip, 1.0 - parts.normal, &out.panels.normal);
            }
        }
        self.joukowski((lattice, state), filaments, &motion.position, out);
        for (strip, force) in lattice.strips().iter().zip(&self.at_edge) {
            add_at_edge(strip, motion, *force, out);
        }
    }

    /// Takes this part of the forces of a strip's segments along its panels, and of their moments.
    fn slacken(&mut self, strip: &Strip, part: f64, normals: &[DVec3]) {
        for &p in &strip.panels {
            let (n, along) = (normals[p], self.along(p, normals));
            let [force, moment] = &mut self.panel_force[p];
            *force -= part * along;
            *moment -= part * moment.dot(n) * n;
        }
    }

    /// Takes this part of the normal forces of a strip's segments, and of their moments.
    fn weaken(&mut self, strip: &Strip, part: f64, normals: &[DVec3]) {
        for &p in &strip.panels {
            let n = normals[p];
            let [force, moment] = &mut self.panel_force[p];
            *force -= part * force.dot(n) * n;
            *moment -= part * (*moment - moment.dot(n) * n);
        }
    }

    /// The suction of a strip ([`Self::leading_suction`]) is added to the leading panel along its normal, on the side to
    /// which the pressure of the strip pushes. It acts where suction does, at the leading edge.
    fn polhamus(&self, lattice: &Lattice, motion: &NodeMotion, out: &mut AirLoads) {
        for strip in lattice.strips() {
            let suction = self.leading_suction(strip, &motion.position, &out.panels.normal);
            let suction = suction.max(0.0);
            let first = strip.panels[0];
            let normal = out.panels.normal[first];
            let push: DVec3 = strip.panels.iter().map(|&p| out.force[p]).sum();
            let force = suction * push.dot(normal).signum() * normal;
            add_at_edge(strip, motion, force, out);
        }
    }
}

/// Adds a force on the leading panel of a strip that acts at the leading edge.
fn add_at_edge(strip: &Strip, motion: &NodeMotion, force: DVec3, out: &mut AirLoads) {
    let first = strip.panels[0];
    let [a, b] = strip.front().map(|n| motion.position[n]);
    let edge = a.midpoint(b);
    out.force[first] += force;
    out.couple[first] += (edge - out.panels.point[first]).cross(force);
}
