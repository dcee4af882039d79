//! From step to step: accepting a step, moving and shedding the wakes.

use crate::contact::Obstacles;
use crate::error::AirError;
use crate::kernel::Points;
use crate::lattice::Lattice;
use crate::loads::{AirLoads, AirWorkspace};
use crate::state::{AirState, NodeMotion, WakeEvents, WakeSheet};
use crate::topology::Sheet;
use wingbeat_math::DVec3;

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
        if loads.gamma.len() != self.panel_count() {
            let what = "number of panels of the loads";
            return Err(AirError::StateMismatch { what });
        }
        std::mem::swap(&mut state.gamma, &mut state.gamma_before);
        state.gamma.copy_from_slice(&loads.gamma);
        state.dt_before = loads.dt;
        state.position.copy_from_slice(&motion.position);
        state.velocity.copy_from_slice(&motion.velocity);
        state.inner_momentum.copy_from_slice(&loads.inner_momentum);
        state.time = loads.time;
        state.step += 1;
        state.wake_due = true;
        Ok(())
    }

    /// Moves the wakes by `dt` [s] with the velocities of the accepted step (explicit Euler) and
    /// sheds a row of rings with the circulations of that step (the unsteady Kutta condition).
    /// Returns what had to be tamed in this step.
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
        let AirWorkspace {
            filaments,
            velocity,
            bound_sum,
            wake_sum,
            ..
        } = &mut *ws;
        let (targets, settings) = (&filaments.wake.nodes, self.settings());
        velocity.reset(targets.len());
        bound_sum.add(settings.bound_core, &filaments.bound, targets, velocity);
        wake_sum.add(settings.wake_core, &filaments.wake, targets, velocity);
        let events = self.move_sheets(state, dt, ws)?;
        state.events += events;
        state.wake_due = false;
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
        ws: &AirWorkspace,
    ) -> Result<WakeEvents, AirError> {
        let obstacles = Obstacles::new(self, state, dt);
        let (gamma, time, step) = (&state.gamma, state.time, state.step);
        let mut mover = Mover {
            nodes: &ws.filaments.wake.nodes,
            velocity: &ws.velocity,
            stream: self.settings().free_stream,
            limit: self.settings().max_displacement.unwrap_or(f64::INFINITY),
            dt,
            obstacles: &obstacles,
            next: 0,
            events: WakeEvents::default(),
        };
        for (k, (sheet, root)) in state.sheets.iter_mut().zip(self.sheets()).enumerate() {
            mover
                .move_nodes(sheet)
                .map_err(|(row, column, velocity)| AirError::WakeNotFinite {
                    step,
                    sheet: k,
                    row,
                    column,
                    velocity,
                })?;
            shed(sheet, root, gamma, time);
            sheet.keep(self.settings().max_rows.unwrap_or(usize::MAX));
        }
        Ok(mover.events)
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
            out.set(i, self.settings().free_stream);
        }
        let settings = self.settings();
        ws.bound_sum
            .add(settings.bound_core, &ws.filaments.bound, points, out);
        ws.wake_sum
            .add(settings.wake_core, &ws.filaments.wake, points, out);
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

/// Walks through the wake nodes of all sheets in order and moves them.
struct Mover<'a> {
    nodes: &'a Points,
    velocity: &'a Points,
    stream: DVec3,
    limit: f64,
    dt: f64,
    obstacles: &'a Obstacles,
    next: usize,
    events: WakeEvents,
}

impl Mover<'_> {
    /// Fills `sheet` with its moved nodes, those that were on the shedding edge being the new last
    /// row. The error is (row from the newest, column, velocity).
    fn move_nodes(&mut self, sheet: &mut WakeSheet) -> Result<(), (usize, usize, DVec3)> {
        let (rows, width) = (sheet.rows() + 1, sheet.columns + 1);
        let nodes = self.next..self.next + rows * width;
        self.next = nodes.end;
        let from: Vec<DVec3> = nodes.clone().map(|k| self.nodes.get(k)).collect();
        let mut to = from.clone();
        for (i, k) in nodes.enumerate() {
            let v = self.velocity.get(k);
            to[i] += self.dt * self.stream + self.displacement(v);
            if !to[i].is_finite() {
                return Err((rows - 1 - i / width, i % width, v));
            }
        }
        self.events.near_surface += self.obstacles.keep_off(&from, &mut to);
        sheet.nodes.clear();
        to.into_iter().for_each(|x| sheet.nodes.push(x));
        Ok(())
    }

    /// Displacement relative to the undisturbed air, shortened to the limit.
    fn displacement(&mut self, v: DVec3) -> DVec3 {
        let d = self.dt * v;
        let length = d.length();
        if length > self.limit {
            self.events.limited += 1;
            return d * (self.limit / length);
        }
        d
    }
}

/// Unsteady Kutta condition: the row that leaves carries the circulation of its panels.
fn shed(sheet: &mut WakeSheet, root: &Sheet, gamma: &[f64], time: f64) {
    for (&panel, &sign) in root.panels.iter().zip(&root.signs) {
        sheet.gamma.push(sign * gamma[panel]);
    }
    sheet.shed_time.push(time);
}
