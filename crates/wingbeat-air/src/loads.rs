//! Loads of one instant: circulation, pressure jump, forces.

use crate::closed;
use crate::contact::Obstacles;
use crate::error::AirError;
use crate::filaments::Filaments;
use crate::influence::{Influence, Instant};
use crate::joukowski;
use crate::lattice::Lattice;
use crate::panels::Panels;
use crate::particle_motion::ParticleFlow;
use crate::pressure;
use crate::rings;
use crate::section_drag;
use crate::state::{AirState, NodeMotion};
use crate::strips;
use crate::summation::{StillWake, Sums, direct};
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

/// What the air does to one surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceLoads {
    /// Force of the air [N], N.
    pub force: DVec3,
    /// Moment of the air about the origin of N [N m], N.
    pub moment: DVec3,
    /// Uniform normal velocity that the rings of a closed surface cannot make [m/s].
    pub leak: f64,
}

impl SurfaceLoads {
    /// Moment about the point `p` [m, N] [N m], N.
    pub fn moment_about(&self, p: DVec3) -> DVec3 {
        self.moment - p.cross(self.force)
    }
}

/// Loads of one instant, panel by panel, in the inertial frame N.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AirLoads {
    /// Time [s].
    pub time: f64,
    /// Time since the last accepted step [s]; without meaning at step 0.
    pub dt: f64,
    /// Geometry of the panels; forces act at the control points.
    pub panels: Panels,
    /// Circulation of the rings, the jump of the potential along the normal [m2/s].
    pub gamma: Vec<f64>,
    /// Its rate of change on the moving panel [m2/s2].
    pub gamma_rate: Vec<f64>,
    /// Velocity of the air at the control points, the mean of the two sides [m/s].
    pub velocity: Vec<DVec3>,
    /// Jump of the tangential velocity along the normal [m/s].
    pub velocity_jump: Vec<DVec3>,
    /// Pressure behind the panel less pressure before it, the normal pointing forward [Pa]:
    /// positive pushes along the normal. On a closed surface inner less outer pressure, the inner
    /// being that of the fictitious fluid inside.
    pub pressure_jump: Vec<f64>,
    /// Force of the air on the panel [N]: as [`crate::LoadMethod`] has it; on a closed surface
    /// pressure jump x area x normal less what the fictitious fluid inside does.
    pub force: Vec<DVec3>,
    /// Moment of the air on the panel about its control point [N m]: of forces on segments, zero
    /// for pressures.
    pub couple: Vec<DVec3>,
    /// What the separation criterion compares with its threshold, for each leading-edge strip
    /// (angle [rad], suction parameter [1]; zero for the criteria that need none).
    pub leading: Vec<f64>,
    /// Resultants of the surfaces.
    pub surfaces: Vec<SurfaceLoads>,
    /// Momentum of the fictitious fluid inside each closed surface [kg m/s].
    pub inner_momentum: Vec<DVec3>,
    /// Impulse of all vorticity, that of dropped wakes included, less the momentum of the fictitious
    /// fluid [kg m/s], N. In air that is at rest or in uniform motion far away, without images, its
    /// rate of decrease is the force on all surfaces together, the suction at attached edges
    /// included: a method independent of pressures and segments
    /// [Saffman 1992, Vortex Dynamics, ch. 3].
    pub impulse: DVec3,
    /// Largest normal velocity through a control point, the leak apart [m/s].
    pub penetration: f64,
}

/// How far a control point may go, in panel sizes, before the wakes are summed for it anew: what
/// this leaves out is a tenth of what the default tree does.
const STILL: f64 = 1e-5;

/// Scratch memory of the air, good for any lattice: nothing in it outlives a call.
#[derive(Default)]
pub struct AirWorkspace {
    pub(crate) filaments: Filaments,
    pub(crate) influence: Influence,
    /// Control points.
    pub(crate) points: Points,
    /// Velocity there, or at the wake nodes, without the free stream.
    pub(crate) velocity: Points,
    /// Velocity at the control points of the newest wake rings' shedding edges.
    pub(crate) shed: Points,
    pub(crate) leak: Vec<f64>,
    /// Nodes of the rings, see [`crate::rings`].
    pub(crate) rings: NodeMotion,
    /// Middles of the bound segments, velocity of the air relative to them; force and moment of
    /// the segments on each panel.
    pub(crate) middle: Points,
    pub(crate) middle_velocity: Points,
    pub(crate) panel_force: Vec<[DVec3; 2]>,
    /// Surfaces in the way of the wakes, and the paths of a sheet's nodes.
    pub(crate) obstacles: Obstacles,
    pub(crate) from: Vec<DVec3>,
    pub(crate) to: Vec<DVec3>,
    /// Impulse per density of what each sheet dropped.
    pub(crate) dropped: Vec<DVec3>,
    /// Nodes of the wakes that are to be moved.
    pub(crate) movable: Points,
    pub(crate) sums: Sums,
    pub(crate) still: StillWake,
    pub(crate) flow: ParticleFlow,
}

impl AirWorkspace {
    /// The filaments of the last call.
    pub fn filaments(&self) -> &Filaments {
        &self.filaments
    }
}

impl Lattice {
    /// Loads on the surfaces as `motion` has them at time `t` [s], `dt` [s] after the last
    /// accepted step, in the frozen wake of `state`; the newest wake rings stay attached to the
    /// shedding edges. Changes no state: call it as often as the bodies need to agree.
    ///
    /// # Errors
    /// Motion of the wrong size or not finite, panels without area, singular influence matrix,
    /// loads that are not finite, a step that is not positive, a wake that is still to be moved.
    pub fn loads(
        &self,
        state: &AirState,
        t: f64,
        dt: f64,
        motion: &NodeMotion,
        ws: &mut AirWorkspace,
        out: &mut AirLoads,
    ) -> Result<(), AirError> {
        self.check_call(state, dt)?;
        (out.time, out.dt) = (t, dt);
        self.check_motion(motion, state.step)?;
        rings::place(self, motion, &mut ws.rings);
        out.panels.update(self, &ws.rings, state.step)?;
        self.check_seams(motion, out.panels.size(), state.step)?;
        if let Some(halves) = self.halves() {
            halves.check(motion, state.step)?;
        }
        ws.filaments.gather(self, state, t, &motion.position);
        self.wake_velocity(state, ws, out);
        self.solve_circulation(state, motion, ws, out)?;
        self.add_bound_velocity(state, ws, out);
        pressure::velocity_jump(self, state, &ws.filaments, out);
        pressure::circulation_rate(self, state, out);
        pressure::pressure_jump(self, out);
        pressure::forces(self, out);
        joukowski::segment_forces(self, state, motion, ws, out);
        closed::outer_forces(self, state, out);
        section_drag::add(self, &motion.position, out);
        strips::leading_values(self, &motion.position, out);
        let inner: DVec3 = out.inner_momentum.iter().sum();
        let vorticity = ws.filaments.impulse(DVec3::ZERO) + state.dropped_impulse;
        out.impulse = self.settings().density * vorticity - inner;
        self.resultants(ws, out);
        self.check_finite(state, out)
    }

    fn check_call(&self, state: &AirState, dt: f64) -> Result<(), AirError> {
        self.check_state(state)?;
        let step = state.step;
        if state.wake_due {
            let what = "the last step was accepted but its wake not moved; call convect first";
            return Err(AirError::Order { step, what });
        }
        if step > 0 && !(dt.is_finite() && dt > 0.0) {
            return Err(AirError::TimeStep { dt, step });
        }
        Ok(())
    }

    /// Velocity at the control points of the wakes alone. Their newest rows and their share of the
    /// shedding edges come from front and bound network with no circulation on the panels.
    fn wake_velocity(&self, state: &AirState, ws: &mut AirWorkspace, out: &mut AirLoads) {
        let n = self.panel_count();
        ws.points.clear();
        match self.halves() {
            None => out.panels.point.iter().for_each(|&p| ws.points.push(p)),
            Some(h) => h
                .lead
                .iter()
                .for_each(|&p| ws.points.push(out.panels.point[p])),
        }
        ws.shed.reset(ws.points.len());
        out.gamma.clear();
        out.gamma.resize(n, 0.0);
        let (filaments, settings, mirrors) = (&mut ws.filaments, self.settings(), self.mirrors());
        filaments.set_bound(self, state, &out.gamma);
        let sums = &mut ws.sums;
        let is_new = sums.load_free(settings, filaments);
        let near = STILL * out.panels.size();
        let (points, velocity) = (&ws.points, &mut ws.velocity);
        ws.still
            .velocity(sums, is_new, points, near, mirrors, velocity);
        sums.front
            .load(direct(settings.wake_core), &filaments.front);
        sums.front.add(points, mirrors, &mut ws.shed);
        sums.bound
            .load(direct(settings.bound_core), &filaments.bound);
        sums.bound.add(points, mirrors, &mut ws.shed);
    }

    /// No penetration: the rings make up for what motion, stream and wakes leave.
    fn solve_circulation(
        &self,
        state: &AirState,
        motion: &NodeMotion,
        ws: &mut AirWorkspace,
        out: &mut AirLoads,
    ) -> Result<(), AirError> {
        let panels = &out.panels;
        for i in 0..ws.points.len() {
            let p = self.halves().map_or(i, |h| h.lead[i]);
            let stream = self.stream(panels.point[p], out.time);
            let v = stream + ws.velocity.get(i) + ws.shed.get(i);
            out.gamma[i] = (panels.velocity[p] - v).dot(panels.normal[p]);
        }
        ws.influence.assemble(Instant {
            lattice: self,
            state,
            filaments: &ws.filaments,
            panels,
            motion,
        });
        (ws.influence).solve(self, state, &mut out.gamma, &mut ws.leak)
    }

    /// Adds the velocity of the lattice to that of stream and wakes.
    fn add_bound_velocity(&self, state: &AirState, ws: &mut AirWorkspace, out: &mut AirLoads) {
        ws.filaments.set_bound(self, state, &out.gamma);
        let (settings, mirrors) = (self.settings(), self.mirrors());
        let Filaments { bound, front, .. } = &ws.filaments;
        for (model, sum, sources) in [
            (settings.wake_core, &mut ws.sums.front, front),
            (settings.bound_core, &mut ws.sums.bound, bound),
        ] {
            sum.load(direct(model), sources);
            sum.add(&ws.points, mirrors, &mut ws.velocity);
        }
        if let Some(halves) = self.halves() {
            halves.reflect(&ws.velocity, &mut ws.shed);
            std::mem::swap(&mut ws.velocity, &mut ws.shed);
        }
        out.velocity.clear();
        let at = out.panels.point.iter().zip(ws.velocity.iter());
        let total = at.map(|(&x, v)| self.stream(x, out.time) + v);
        out.velocity.extend(total);
    }

    fn resultants(&self, ws: &AirWorkspace, out: &mut AirLoads) {
        out.surfaces.clear();
        out.penetration = 0.0;
        for s in 0..self.surfaces().len() {
            let mut sum = SurfaceLoads {
                leak: ws.leak[s],
                ..SurfaceLoads::default()
            };
            for p in self.panels_of(s) {
                let (x, normal) = (out.panels.point[p], out.panels.normal[p]);
                sum.force += out.force[p];
                sum.moment += x.cross(out.force[p]) + out.couple[p];
                let through = (out.velocity[p] - out.panels.velocity[p]).dot(normal) + sum.leak;
                out.penetration = out.penetration.max(through.abs());
            }
            out.surfaces.push(sum);
        }
    }

    fn check_finite(&self, state: &AirState, out: &AirLoads) -> Result<(), AirError> {
        let first = |x: &[f64]| x.iter().position(|v| !v.is_finite());
        for (what, values) in [
            ("circulation", &out.gamma),
            ("pressure jump", &out.pressure_jump),
        ] {
            if let Some(p) = first(values) {
                return Err(self.panel_not_finite(p, state.step, what, values[p]));
            }
        }
        match out.force.iter().position(|f| !f.is_finite()) {
            Some(p) => {
                let value = out.force[p].length();
                Err(self.panel_not_finite(p, state.step, "force", value))
            }
            None => Ok(()),
        }
    }
}
