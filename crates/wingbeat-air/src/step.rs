//! The recipes of a step: loads, acceptance, motion of the wakes; and what can be asked of an accepted step.

use crate::error::AirError;
use crate::geometry::{NodeMotion, Panels};
use crate::lattice::Lattice;
use crate::loads::{
    AirLoads, Flow, add_section_drag, check_finite, circulation_rate, forces, impulse,
    leading_values, outer_forces, pressure_jump, resultants, velocity_jump,
};
use crate::solve::Instant;
use crate::state::{AirState, WakeEvents};
use crate::workspace::AirWorkspace;
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

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
        self.place_panels(state, motion, ws, out)?;
        ws.filaments.gather(self, state, t, &motion.position);
        self.solve_circulations(state, motion, ws, out)?;
        velocity_jump(self, state, &ws.filaments, out);
        circulation_rate(self, state, out);
        pressure_jump(self, out);
        forces(self, state, &ws.filaments, &motion.position, out);
        outer_forces(self, state, out);
        if self.settings().is_symmetric() {
            ws.filaments.soften(self, state);
            ws.sums.load_attached(self.settings(), &ws.filaments);
        }
        let flow = Flow {
            filaments: &ws.filaments,
            sums: &mut ws.sums,
            rings: &ws.wash.nodes,
        };
        ws.segments.add_forces(self, state, motion, flow, out);
        add_section_drag(self, &motion.position, out);
        let suction = (&ws.boundary.leading_edges.suction[..], &motion.position[..]);
        leading_values((self, state), &ws.filaments, suction, out);
        impulse(self, state, &ws.filaments, out);
        resultants(self, &ws.boundary.net_flux_residual, out);
        check_finite(self, state, out)
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

    /// Rings and panels where the motion has them.
    fn place_panels(
        &self,
        state: &AirState,
        motion: &NodeMotion,
        ws: &mut AirWorkspace,
        out: &mut AirLoads,
    ) -> Result<(), AirError> {
        motion.check(self.topology(), state.step)?;
        self.rings().place(motion, &mut ws.rings);
        let lattice = (self.topology(), self.controls());
        (out.panels).update(lattice, &ws.rings, state.step)?;
        motion.check_joined(self.topology(), out.panels.size(), state.step)?;
        self.check_on_planes(&motion.position, out.panels.size(), state.step)?;
        self.check_sides([&state.position, &motion.position], state.step)?;
        match self.symmetry() {
            Some(symmetry) => symmetry.check(&motion.position, state.step),
            None => Ok(()),
        }
    }

    /// Place and motion of the surfaces as the rings meet them, where leading edges hold this part of their
    /// circulation, strip by strip.
    fn take_wash(&self, ws: &mut AirWorkspace, panels: &Panels, held: impl Fn(usize) -> f64) {
        ws.wash.none(&ws.rings, panels);
        let all = self.settings().held_shift();
        if all > 0.0 {
            let strips = (self.strips(), self.rings().aft());
            let lattice = (self.topology(), self.controls());
            (ws.wash).move_aft(lattice, strips, |k| all * held(k), &ws.rings);
        }
    }

    /// Circulations of the panels and velocities at their control points. As far as there was next to no
    /// circulation before it is not known what leading edges will hold: that follows from the flow in which
    /// they hold all.
    fn solve_circulations(
        &self,
        state: &AirState,
        motion: &NodeMotion,
        ws: &mut AirWorkspace,
        out: &mut AirLoads,
    ) -> Result<(), AirError> {
        let newest = std::mem::take(&mut ws.filaments.newest);
        let held_before = |k: usize| self.held_of_strip(state, k, &newest);
        self.take_wash(ws, &out.panels, held_before);
        ws.filaments.newest = newest;
        self.solve_with_wash(state, motion, ws, out)?;
        let known = self.known_part(state, &out.gamma);
        if self.settings().held_shift() > 0.0 && known < 1.0 {
            self.take_wash(ws, &out.panels, |_| 1.0);
            self.solve_with_wash(state, motion, ws, out)?;
            leading_values((self, state), &ws.filaments, (&[], &motion.position), out);
            let newest = std::mem::take(&mut ws.filaments.newest);
            let held = |k: usize| {
                let now = out.hold[k] / out.gamma[self.strips()[k].panels[0]].abs();
                let before = self.held_of_strip(state, k, &newest);
                known * before + (1.0 - known) * now.min(1.0)
            };
            self.take_wash(ws, &out.panels, held);
            ws.filaments.newest = newest;
            self.solve_with_wash(state, motion, ws, out)?;
        }
        Ok(())
    }

    /// The same with the wash there is.
    fn solve_with_wash(
        &self,
        state: &AirState,
        motion: &NodeMotion,
        ws: &mut AirWorkspace,
        out: &mut AirLoads,
    ) -> Result<(), AirError> {
        let now = Instant {
            lattice: self,
            state,
            panels: &out.panels,
            wash: &ws.wash,
            motion,
            time: out.time,
        };
        let (filaments, sums) = (&mut ws.filaments, &mut ws.sums);
        let found = [&mut out.gamma, &mut out.leaving];
        (ws.boundary).solve(now, filaments, sums, found)?;
        let found = [&out.gamma[..], &out.leaving];
        (ws.boundary).velocities(now, filaments, sums, found, &mut out.velocity);
        out.unfound = ws.boundary.leading_edges.unfound;
        Ok(())
    }

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
        motion.check(self.topology(), state.step)?;
        if state.wake_due {
            let what = "two steps accepted without moving the wake between them; call convect";
            let step = state.step;
            return Err(AirError::Order { step, what });
        }
        if loads.gamma.len() != self.panel_count() || loads.fed.len() != self.strips().len() {
            let what = "number of panels of the loads";
            return Err(AirError::StateMismatch { what });
        }
        std::mem::swap(&mut state.gamma, &mut state.gamma_before);
        state.gamma.copy_from_slice(&loads.gamma);
        state.dt_before = loads.dt;
        state.position.copy_from_slice(&motion.position);
        state.velocity.copy_from_slice(&motion.velocity);
        std::mem::swap(&mut state.inner, &mut state.inner_before);
        state.inner.copy_from_slice(&loads.inner);
        (state.impulse, state.attached_impulse) = (loads.account, loads.attached_impulse);
        state.hold.copy_from_slice(&loads.hold);
        state.leaving.copy_from_slice(&loads.leaving);
        state.fed.copy_from_slice(&loads.fed);
        state.events.limited += loads.unfound;
        state.time = loads.time;
        state.step += 1;
        state.wake_due = true;
        Ok(())
    }

    /// Moves the wakes by `dt` [s] with the velocities of the accepted step, as
    /// [`crate::Convection`] says, and sheds a row of rings with the circulations of that step (the
    /// unsteady Kutta condition); then drops the rows that are too old or too far.
    /// Returns what had to be limited in this step, of a mirror-symmetric flow on the half computed.
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
            sums,
            wakes,
            ..
        } = ws;
        wakes.take_velocities(self, state, filaments, sums);
        let events = wakes.move_sheets(self, state, dt, &filaments.newest)?;
        state.events += events;
        state.leaving.fill(0.0); // it is in the wakes now
        state.wake_due = false;
        state.dt_wake = dt;
        Ok(events)
    }

    /// Filaments of the accepted step with all circulations.
    fn gather_accepted(&self, state: &AirState, ws: &mut AirWorkspace) {
        ws.filaments
            .gather(self, state, state.time, &state.position);
        (ws.filaments).set_bound(self, state, [&state.gamma, &state.leaving]);
        ws.filaments.soften(self, state);
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
        Ok(self.settings().density * ws.filaments.impulse(self, state.position[0]))
    }
}
