//! From step to step: accepting a step, moving and shedding the wakes.

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
        let mut events = self.move_sheets(state, dt, ws)?;
        events.near_surface = self.count_near_surface(state);
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
        let (gamma, time, step) = (&state.gamma, state.time, state.step);
        let mut mover = Mover {
            nodes: &ws.filaments.wake.nodes,
            velocity: &ws.velocity,
            stream: self.settings().free_stream,
            limit: self.settings().max_displacement.unwrap_or(f64::INFINITY),
            dt,
            next: 0,
            limited: 0,
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
        Ok(WakeEvents {
            limited: mover.limited,
            near_surface: 0,
        })
    }

    /// Free wake nodes, the row just shed apart, that stand over a panel at less than the
    /// clearance.
    fn count_near_surface(&self, state: &AirState) -> u64 {
        let clearance = self.settings().clearance;
        if clearance <= 0.0 {
            return 0;
        }
        let near = |x: DVec3| {
            let mut panels = self.topology().panels.iter();
            panels.any(|c| stands_over(x, c.map(|n| state.position[n]), clearance))
        };
        let old = |sheet: &WakeSheet| (sheet.rows() - 1) * (sheet.columns + 1);
        let count = |sheet: &WakeSheet| {
            let nodes = sheet.nodes.iter().take(old(sheet));
            nodes.filter(|&x| near(x)).count() as u64
        };
        state.sheets.iter().map(count).sum()
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
    next: usize,
    limited: u64,
}

impl Mover<'_> {
    /// Fills `sheet` with its moved nodes, those that were on the shedding edge being the new last
    /// row. The error is (row from the newest, column, velocity).
    fn move_nodes(&mut self, sheet: &mut WakeSheet) -> Result<(), (usize, usize, DVec3)> {
        let (rows, width) = (sheet.rows() + 1, sheet.columns + 1);
        sheet.nodes.clear();
        for k in 0..rows * width {
            let x = self.nodes.get(self.next);
            let v = self.velocity.get(self.next);
            let moved = x + self.dt * self.stream + self.displacement(v);
            if !moved.is_finite() {
                return Err((rows - 1 - k / width, k % width, v));
            }
            sheet.nodes.push(moved);
            self.next += 1;
        }
        Ok(())
    }

    /// Displacement relative to the undisturbed air, shortened to the limit.
    fn displacement(&mut self, v: DVec3) -> DVec3 {
        let d = self.dt * v;
        let length = d.length();
        if length > self.limit {
            self.limited += 1;
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

/// Whether `x` is less than `height` over or under the quadrilateral `c`, its projection inside.
fn stands_over(x: DVec3, c: [DVec3; 4], height: f64) -> bool {
    let normal = (c[2] - c[0]).cross(c[3] - c[1]).normalize_or_zero();
    let centre = 0.25 * ((c[0] + c[1]) + (c[2] + c[3]));
    if (x - centre).dot(normal).abs() >= height {
        return false;
    }
    (0..4).all(|k| {
        let (a, b) = (c[k], c[(k + 1) % 4]);
        (b - a).cross(x - a).dot(normal) >= 0.0
    })
}
