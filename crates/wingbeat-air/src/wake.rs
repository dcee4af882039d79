//! From step to step: accepting a step, moving and shedding the wakes.

use crate::contact::Obstacles;
use crate::error::AirError;
use crate::filaments::newest;
use crate::front;
use crate::images::{Mirror, Plane};
use crate::lattice::Lattice;
use crate::loads::{AirLoads, AirWorkspace};
use crate::particle_motion::ParticleFlow;
use crate::seams;
use crate::settings::{Convection, LeadingEdge, NewestRow};
use crate::state::{AirState, NodeMotion, WakeEvents, WakeSheet};
use crate::surface::EdgeKind;
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

impl Lattice {
    /// Makes the circulations of `loads`, computed for `motion`, those of the state.
    ///
    /// # Errors
    /// The wake of the step before has not been moved, or sizes differ.
    pub fn accept(
        &self,
        state: &mut AirState,
        motion: &NodeMotion,
        loads: &AirLoads,
    ) -> Result<(), AirError> {
        self.check_state(state)?;
        self.check_motion(motion, state.step)?;
        if state.wake_due {
            let what = "two steps accepted without moving the wake between them; call convect";
            let step = state.step;
            return Err(AirError::Order { step, what });
        }
        if loads.gamma.len() != self.panel_count() || loads.leading.len() != self.strips().len() {
            let what = "number of panels of the loads";
            return Err(AirError::StateMismatch { what });
        }
        std::mem::swap(&mut state.gamma, &mut state.gamma_before);
        state.gamma.copy_from_slice(&loads.gamma);
        state.dt_before = loads.dt;
        state.position.copy_from_slice(&motion.position);
        state.velocity.copy_from_slice(&motion.velocity);
        state.inner_momentum.copy_from_slice(&loads.inner_momentum);
        state.leading.copy_from_slice(&loads.leading);
        state.time = loads.time;
        state.step += 1;
        state.wake_due = true;
        Ok(())
    }

    /// Moves the wakes by `dt` [s] with the velocities of the accepted step, as
    /// [`Convection`] says, and sheds a row of rings with the circulations of that step (the
    /// unsteady Kutta condition); then drops the rows that are too old or too far.
    /// Returns what had to be tamed in this step, of a mirror-symmetric flow on the half computed.
    ///
    /// # Errors
    /// No accepted step to move from, a step that is not positive, velocities that are not finite.
    pub fn convect(
        &self,
        state: &mut AirState,
        dt: f64,
        ws: &mut AirWorkspace,
    ) -> Result<WakeEvents, AirError> {
        self.check_state(state)?;
        let step = state.step;
        if !state.wake_due {
            let what = "the wake has been moved already, or no step accepted; call accept first";
            return Err(AirError::Order { step, what });
        }
        if !(dt.is_finite() && dt > 0.0) {
            return Err(AirError::TimeStep { dt, step });
        }
        self.gather_accepted(state, ws);
        ws.filaments.movable(self, state, &mut ws.movable);
        ws.velocity.reset(ws.movable.len());
        let mirrors = self.mirrors();
        ws.sums.load(self.settings(), &ws.filaments);
        ws.sums.add(&ws.movable, mirrors, &mut ws.velocity);
        ws.flow.take(self, state, &mut ws.sums);
        let events = self.move_sheets(state, dt, ws)?;
        state.events += events;
        state.wake_due = false;
        state.dt_wake = dt;
        Ok(events)
    }

    /// Filaments of the accepted step with all circulations.
    fn gather_accepted(&self, state: &AirState, ws: &mut AirWorkspace) {
        ws.filaments
            .gather(self, state, state.time, &state.position);
        ws.filaments.set_bound(self, state, &state.gamma);
    }

    fn move_sheets(
        &self,
        state: &mut AirState,
        dt: f64,
        ws: &mut AirWorkspace,
    ) -> Result<WakeEvents, AirError> {
        ws.obstacles.take(self, state, dt);
        let step = state.step;
        let looks_back = self.settings().convection == Convection::AdamsBashforth;
        let mut mover = Mover {
            lattice: self,
            nodes: &ws.movable,
            velocity: &ws.velocity,
            limit: self.settings().max_displacement.unwrap_or(f64::INFINITY),
            time: state.time,
            dt,
            looks_back,
            // Weight of the change of velocity since the step before.
            change: if looks_back && state.dt_wake > 0.0 {
                0.5 * dt / state.dt_wake
            } else {
                0.0
            },
            obstacles: &ws.obstacles,
            next: 0,
            flow: &ws.flow,
            next_particle: 0,
            events: WakeEvents::default(),
        };
        let mut sheets = std::mem::take(&mut state.sheets);
        let dropped = &mut ws.dropped;
        dropped.clear();
        dropped.resize(sheets.len(), DVec3::ZERO);
        for k in 0..sheets.len() {
            if let Some((lead, mirror)) = self.followed(k) {
                let (first, rest) = sheets.split_at_mut(k);
                self.shed(k, &mut rest[0], state, &ws.filaments.lengths[k]);
                let rows = rest[0].follow(&first[lead], mirror);
                if self.settings().particles.is_none() {
                    mover.events.dropped_rows += rows;
                }
                dropped[k] = mirror.vector(dropped[lead]);
                continue;
            }
            let sheet = &mut sheets[k];
            let moved = mover.move_nodes(sheet, &mut ws.from, &mut ws.to);
            if let Err((row, column, velocity)) = moved {
                state.sheets = sheets;
                return Err(AirError::WakeNotFinite {
                    step,
                    sheet: k,
                    row,
                    column,
                    velocity,
                });
            }
            if let Err((particle, velocity)) = mover.move_particles(&mut sheet.particles) {
                state.sheets = sheets;
                return Err(AirError::ParticleNotFinite {
                    step,
                    sheet: k,
                    particle,
                    velocity,
                });
            }
            self.shed(k, sheet, state, &ws.filaments.lengths[k]);
            let (events, impulse) = self.truncate(k, sheet, state);
            mover.events += events;
            dropped[k] = impulse;
        }
        seams::tie(self.topology(), &mut sheets);
        state.sheets = sheets;
        let events = mover.events;
        state.dropped_impulse += dropped.iter().sum::<DVec3>();
        Ok(events)
    }

    /// The sheet whose mirror image sheet `k` is, if that one is moved for both.
    pub(crate) fn followed(&self, k: usize) -> Option<(usize, Mirror)> {
        let halves = self.halves()?;
        let lead = halves.sheet[k];
        (lead < k).then_some((lead, halves.mirror))
    }

    /// Unsteady Kutta condition: the row that leaves carries the circulation of its panels; none
    /// where the flow stays attached to a leading edge.
    fn shed(&self, k: usize, sheet: &mut WakeSheet, state: &AirState, lengths: &[f64]) {
        let root = &self.sheets()[k];
        self.settle(k, sheet, state, lengths);
        let delays = self.settings().newest_row == NewestRow::Matched && sheet.rows() > 0;
        for (c, (&panel, &sign)) in root.panels.iter().zip(&root.signs).enumerate() {
            let attached = root.kinds[c] == EdgeKind::Leading && !self.leaves(panel, state);
            let present = sign * state.gamma[panel];
            let gamma = match (attached, delays) {
                (true, _) => 0.0,
                (false, false) => present,
                (false, true) => {
                    let before = newest(sheet, c);
                    before + front::released(lengths[c]) * (present - before)
                }
            };
            sheet.gamma.push(gamma);
        }
        sheet.shed_time.push(state.time);
    }

    /// The row that was the newest gets the circulation it keeps.
    fn settle(&self, k: usize, sheet: &mut WakeSheet, state: &AirState, lengths: &[f64]) {
        let Some(newest) = sheet.rows().checked_sub(1) else {
            return;
        };
        if self.settings().newest_row == NewestRow::Constant {
            return;
        }
        let root = &self.sheets()[k];
        for c in 0..sheet.columns {
            let ring = &mut sheet.gamma[newest * sheet.columns + c];
            let held = root.kinds[c] == EdgeKind::Leading
                && self.settings().leading != LeadingEdge::Always
                && *ring == 0.0;
            if !held {
                let change = root.signs[c] * state.gamma[root.panels[c]] - *ring;
                *ring += front::kept(lengths[c]) * change;
            }
        }
    }

    /// Whether the flow leaves the leading edge at this leading panel.
    fn leaves(&self, panel: usize, state: &AirState) -> bool {
        let strip = self.strips().iter().position(|s| s.panels[0] == panel);
        strip.is_none_or(|s| self.is_separated(s, state))
    }

    /// Drops the oldest rows that are too many, too old or too far, or makes particles of them.
    /// Returns also the impulse per density [m4/s], N, of what was dropped.
    fn truncate(&self, k: usize, sheet: &mut WakeSheet, state: &AirState) -> (WakeEvents, DVec3) {
        let settings = self.settings();
        let before = sheet.rows();
        let mut keep = before.min(settings.max_rows.unwrap_or(usize::MAX));
        if let Some(age) = settings.max_age {
            let young = |t: &&f64| state.time - **t <= age;
            keep = keep.min(sheet.shed_time.iter().filter(young).count());
        }
        if let Some(far) = settings.max_distance {
            let edge = self.edge_middle(k, state);
            let is_far = |r: usize| {
                let mut row = (0..=sheet.columns).map(|c| sheet.node(r, c));
                row.all(|x| x.distance(edge) > far)
            };
            let farthest = (0..before).rev().find(|&r| is_far(r));
            keep = keep.min(farthest.map_or(before, |r| before - 1 - r));
        }
        let dropped = before - keep.clamp(1, before.max(1));
        if settings.particles.is_some() {
            return self.make_particles(k, sheet, dropped, state);
        }
        let impulse = sheet.impulse_of_oldest(dropped);
        sheet.keep(before - dropped);
        let events = WakeEvents {
            dropped_rows: dropped as u64,
            ..WakeEvents::default()
        };
        (events, impulse)
    }

    /// Middle of the edge that sheet `k` leaves [m], N.
    pub(crate) fn edge_middle(&self, k: usize, state: &AirState) -> DVec3 {
        let nodes = &self.sheets()[k].nodes;
        let sum: DVec3 = nodes.iter().map(|&n| state.position[n]).sum();
        sum / nodes.len() as f64
    }

    /// Velocity of the air [m/s] at `points` [m], N, in the accepted step; `out` is resized. At a
    /// time between [`Self::accept`] and [`Self::convect`] that is the very flow of the step;
    /// after it the wake is already that of the next one.
    ///
    /// # Errors
    /// A state that does not fit.
    pub fn velocity(
        &self,
        state: &AirState,
        points: &Points,
        ws: &mut AirWorkspace,
        out: &mut Points,
    ) -> Result<(), AirError> {
        self.check_state(state)?;
        self.gather_accepted(state, ws);
        out.reset(points.len());
        for i in 0..points.len() {
            out.set(i, self.stream(points.get(i), state.time));
        }
        ws.sums.load(self.settings(), &ws.filaments);
        ws.sums.add(points, self.mirrors(), out);
        Ok(())
    }

    /// Impulse of all vorticity [N s], N, in the accepted step: `1/2 rho integral x cross omega`.
    /// In air at rest at infinity the force on the surfaces, with the fictitious fluid inside
    /// closed ones, is its rate of decrease. Rows of wake that were dropped are missing.
    ///
    /// # Errors
    /// A state that does not fit.
    pub fn impulse(&self, state: &AirState, ws: &mut AirWorkspace) -> Result<DVec3, AirError> {
        self.check_state(state)?;
        self.gather_accepted(state, ws);
        Ok(self.settings().density * ws.filaments.impulse(state.position[0]))
    }
}

/// Walks through the wake nodes and particles of all sheets in order and moves them.
pub(crate) struct Mover<'a> {
    pub lattice: &'a Lattice,
    nodes: &'a Points,
    velocity: &'a Points,
    limit: f64,
    pub time: f64,
    pub dt: f64,
    pub looks_back: bool,
    pub change: f64,
    obstacles: &'a Obstacles,
    next: usize,
    pub flow: &'a ParticleFlow,
    pub next_particle: usize,
    pub events: WakeEvents,
}

impl Mover<'_> {
    /// Fills `sheet` with its moved nodes, those that were on the shedding edge being the new last
    /// row. The error is (row from the newest, column, velocity).
    fn move_nodes(
        &mut self,
        sheet: &mut WakeSheet,
        from: &mut Vec<DVec3>,
        to: &mut Vec<DVec3>,
    ) -> Result<(), (usize, usize, DVec3)> {
        let (rows, width) = (sheet.rows() + 1, sheet.columns + 1);
        let nodes = self.next..self.next + rows * width;
        self.next = nodes.end;
        from.clear();
        from.extend(nodes.clone().map(|k| self.nodes.get(k)));
        to.clear();
        for (i, k) in nodes.clone().enumerate() {
            let (x, v) = (from[i], self.velocity.get(k));
            let stream = self.lattice.stream(x, self.time);
            let past = (i < sheet.velocity.len()).then(|| sheet.velocity.get(i));
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
        self.keep_clear(from, to);
        sheet.nodes.clear();
        to.iter().for_each(|&x| sheet.nodes.push(x));
        Ok(())
    }

    /// Keeps ends of paths off surfaces and on their side of planes.
    pub(crate) fn keep_clear(&mut self, from: &[DVec3], to: &mut [DVec3]) {
        self.events.near_surface += self.obstacles.keep_off(from, to);
        for plane in &self.lattice.settings().images {
            self.events.near_surface += keep_on_side(plane, from, to);
        }
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

/// Nodes that would go through a plane of symmetry or a ground end on it; returns how many. There
/// they and their images cancel.
fn keep_on_side(plane: &Plane, from: &[DVec3], to: &mut [DVec3]) -> u64 {
    let mut count = 0;
    for (a, b) in from.iter().zip(to) {
        if plane.height(*a) * plane.height(*b) < 0.0 {
            *b = plane.foot(*b);
            count += 1;
        }
    }
    count
}
