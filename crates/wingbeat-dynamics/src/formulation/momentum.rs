//! The momentum form: mass centre, attitude, linear and angular momentum of the whole system.
//!
//! State, 13 numbers: mass centre r_C \[m\], unit quaternion (x, y, z, w) of the root, linear
//! momentum P [kg m/s], angular momentum H about the mass centre [kg m2/s], all in N components.
//!
//! ```text
//! r_C' = P / m        P' = sum F        H' = sum of moments about the mass centre
//! w    = I(t)^-1 (R^T H - h(t))         q' = q (0, w) / 2
//! ```
//!
//! I(t) and h(t) are inertia and relative angular momentum of the configuration in root components. In
//! vacuum P and H are constant in the arithmetic itself. Constraints hold by construction, so
//! nothing can drift; a body without mass is as good as any.
//!
//! Free joints add their coordinates and speeds to the state (`free`); I and h then
//! depend on them too. Added masses join the inertia of the whole (`added`).

mod added;
mod joints;
mod state;
mod whole;

use std::sync::Arc;

use wingbeat_math::{BodyAcceleration, BodyMotion, DMat3, DQuat, DVec3, Wrench};

use self::joints::{move_joints, write_joint_rates};
pub use self::state::MomentumState;
use self::state::component;
use self::whole::{momentum_rate, total_load, whole_load};
use crate::budget::{budget, load_power};
use crate::configuration::{Configuration, ConfigurationTable};
use crate::formulation::add_by_response;
use crate::formulation::inverse::{multipliers, reactions};
use crate::formulation::workspace::MOMENTUM_STATE;
use crate::mechanism::Mechanism;
use crate::prescribed::Turning;
use crate::system::check::{check_rotation, check_state};
use crate::system::mirror::MirrorSymmetry;
use crate::system::shape::ShapeMass;
use crate::{
    AddedMass, DynamicsError, Formulation, JointType, Solution, System, Violation, Workspace,
};

/// Length of the state vector without free joint coordinates.
const DIM: usize = MOMENTUM_STATE;

/// The momentum form of a [`System`].
#[derive(Clone, Debug)]
pub struct MomentumForm {
    system: System,
    table: Option<Arc<ConfigurationTable>>,
}

impl MomentumForm {
    /// The momentum form of `system`.
    pub fn new(system: System) -> Self {
        Self {
            system,
            table: None,
        }
    }

    /// The same with all that depends on time alone known at the times of `table`.
    pub fn tabulated(self, table: Arc<ConfigurationTable>) -> Self {
        Self {
            table: Some(table),
            ..self
        }
    }

    /// Postures and whole at time `t` into `ws`, known already if it was the last time asked for
    /// and no joint is free.
    fn lay(&self, t: f64, y: &[f64], ws: &mut Workspace) {
        if ws.prescribed != Some(t) {
            (ws.whole, ws.whole_rates) =
                (ws.configuration).lay(&self.system, t, self.free(y), self.table.as_deref());
            ws.turning = Turning::of(ws.whole.inertia);
            ws.prescribed = (self.system.coordinates() == 0).then_some(t);
        }
        if !ws.shapes.is_empty() {
            ws.shaped = ws.configuration.composite_of(&self.system, &ws.shapes);
            ws.shaped_turning = Turning::of(ws.shaped.inertia);
        }
    }

    /// Free joint coordinates and speeds in the state.
    fn free<'a>(&self, y: &'a [f64]) -> (&'a [f64], &'a [f64]) {
        assert_eq!(y.len(), self.dim(), "a state of this momentum form");
        y[DIM..].split_at(self.system.coordinates())
    }

    /// The table of configurations, if there is one.
    pub fn table(&self) -> Option<&ConfigurationTable> {
        self.table.as_deref()
    }

    /// The state in which the root moves like `root` and the free joints stand at `q` and move at
    /// `u`.
    ///
    /// # Errors
    /// As [`Formulation::initial`].
    pub fn start_at(
        &self,
        t: f64,
        root: &BodyMotion,
        (q, u): (Vec<f64>, Vec<f64>),
    ) -> Result<Vec<f64>, DynamicsError> {
        self.system.refuse_loops("momentum")?;
        check_rotation(root.r, t, || "the root's attitude".into())?;
        Configuration::check(&self.system, t)?;
        let mut configuration = Configuration::new(&self.system);
        configuration.update_free(&self.system, t, (&q, &u));
        let whole = configuration.composite(&self.system);
        Turning::of(whole.inertia).solve(t, DVec3::ZERO)?;
        let state = MomentumState::moving_like(root, &whole);
        let mut y = vec![0.0; DIM];
        state.write(&mut y);
        y.extend(q);
        y.extend(u);
        check_state(t, &y, component)?;
        Ok(y)
    }

    /// Quaternions of the root and of spherical joints in the state `y` to unit length.
    pub fn to_unit_length(&self, y: &mut [f64]) {
        let unit = |q: &mut [f64]| DQuat::from_slice(q).normalize().write_to_slice(q);
        unit(&mut y[3..]);
        for (joint, offsets) in self.system.joints().zip(self.system.offsets()) {
            if joint.kind == JointType::Spherical {
                unit(&mut y[DIM + offsets.q..]);
            }
        }
    }

    /// Rotation of the root, and its angular velocity from the angular momentum, `w = I^-1 (R^T H - h)` [rad/s].
    fn root_turn(
        t: f64,
        state: &MomentumState,
        ws: &Workspace,
    ) -> Result<(DMat3, DVec3), DynamicsError> {
        let r = state.rotation();
        let (whole, turning) = ws.moving();
        let w = turning.solve(t, r.transpose() * state.angular - whole.h)?;
        Ok((r, w))
    }

    /// Motion of the root in the whole of `ws`.
    fn root_motion(
        t: f64,
        state: &MomentumState,
        ws: &Workspace,
    ) -> Result<BodyMotion, DynamicsError> {
        let (r, w) = Self::root_turn(t, state, ws)?;
        let (whole, _) = ws.moving();
        Ok(BodyMotion {
            p: state.centre - r * whole.c,
            r,
            v: state.momentum / whole.mass - r * (w.cross(whole.c) + whole.c_dot),
            w,
        })
    }

    /// Motions of all bodies into `ws.motions`, the whole into `ws.whole`; returns the state.
    fn unfold(
        &self,
        t: f64,
        y: &[f64],
        ws: &mut Workspace,
    ) -> Result<MomentumState, DynamicsError> {
        if ws.knows(t, y) {
            return Ok(MomentumState::of(y));
        }
        let state = MomentumState::read(t, y)?;
        self.lay(t, y, ws);
        let root = Self::root_motion(t, &state, ws)?;
        ws.configuration.motions(&root, &mut ws.motions);
        ws.note(t, y);
        Ok(state)
    }

    /// Accelerations of all bodies from Newton's and Euler's laws for the whole system.
    fn accelerate(
        &self,
        t: f64,
        x_c: DVec3,
        load: &Wrench,
        ws: &Workspace,
        out: &mut [BodyAcceleration],
    ) -> Result<(), DynamicsError> {
        let (root, whole) = (ws.motions[0], &ws.whole);
        // With the root's accelerations zero, the momenta change at the rate of the bias.
        ws.configuration
            .accelerations(&root, &BodyAcceleration::default(), out);
        let bias = momentum_rate(&self.system, &ws.motions, out, x_c);
        let moment = root.r.transpose() * (load.moment - bias.moment);
        let angular = ws.turning.solve(t, moment)?;
        let linear = (load.force - bias.force) / whole.mass - root.r * angular.cross(whole.c);
        let acc = BodyAcceleration { linear, angular };
        ws.configuration.accelerations(&root, &acc, out);
        Ok(())
    }
}

impl Formulation for MomentumForm {
    fn system(&self) -> &System {
        &self.system
    }

    fn counts_turns(&self) -> bool {
        true
    }

    fn takes_shapes(&self) -> bool {
        self.system.speeds() == 0
    }

    fn initial_shaped(
        &self,
        t: f64,
        motions: &[BodyMotion],
        shapes: &[ShapeMass],
    ) -> Result<Vec<f64>, DynamicsError> {
        let mut y = self.initial_from(t, motions)?;
        if self.takes_shapes() && !shapes.is_empty() {
            let mut configuration = Configuration::new(&self.system);
            configuration.update(&self.system, t);
            let whole = configuration.composite_of(&self.system, shapes);
            MomentumState::moving_like(&motions[0], &whole).write(&mut y);
        }
        Ok(y)
    }

    fn dim(&self) -> usize {
        DIM + self.system.coordinates() + self.system.speeds()
    }

    fn initial(&self, t: f64, root: &BodyMotion) -> Result<Vec<f64>, DynamicsError> {
        self.start_at(t, root, self.system.start())
    }

    fn initial_from(&self, t: f64, motions: &[BodyMotion]) -> Result<Vec<f64>, DynamicsError> {
        let free = Mechanism::of(&self.system).free_coordinates(&self.system, t, motions);
        self.start_at(t, &motions[0], free)
    }

    fn motions(
        &self,
        t: f64,
        y: &[f64],
        ws: &mut Workspace,
        out: &mut [BodyMotion],
    ) -> Result<(), DynamicsError> {
        self.unfold(t, y, ws)?;
        out.copy_from_slice(&ws.motions);
        Ok(())
    }

    fn rates(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
        dy: &mut [f64],
    ) -> Result<(), DynamicsError> {
        if self.system.speeds() > 0 {
            let state = self.unfold(t, y, ws)?;
            let load = total_load(&self.system, loads, &ws.motions, state.centre);
            let (q, u) = self.free(y);
            move_joints(&self.system, (t, q, u), loads, ws)?;
            state.rates(&ws.whole, ws.motions[0].w, &load).write(dy);
            write_joint_rates(&self.system, (q, u), ws, &mut dy[DIM..]);
            return Ok(());
        }
        let (state, (r, w)) = match ws.knows(t, y) {
            true => (MomentumState::of(y), (ws.motions[0].r, ws.motions[0].w)),
            false => {
                let state = MomentumState::read(t, y)?;
                self.lay(t, y, ws);
                let turn = Self::root_turn(t, &state, ws)?;
                (state, turn)
            }
        };
        let (whole, _) = ws.moving();
        let load = whole_load(&self.system, loads, &ws.configuration, r, whole.c);
        state.rates(whole, w, &load).write(dy);
        Ok(())
    }

    fn solve(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
    ) -> Result<(), DynamicsError> {
        let state = self.unfold(t, y, ws)?;
        // Accelerations are those of rigid bodies, under loads that hold what changing shapes do.
        let centre = match ws.shapes.is_empty() {
            true => state.centre,
            false => ws.motions[0].point(ws.whole.c),
        };
        let load = total_load(&self.system, loads, &ws.motions, centre);
        if self.system.speeds() > 0 {
            let (q, u) = self.free(y);
            move_joints(&self.system, (t, q, u), loads, ws)?;
        }
        self.accelerate(t, centre, &load, ws, &mut out.bodies)?;
        reactions(&self.system, loads, ws, out);
        out.tether = Wrench::default(); // free: what `reactions` leaves there is rounding
        multipliers(&out.hinges, &mut out.multipliers);
        out.violation = Violation::default(); // constraints hold by construction
        out.budget = budget(&self.system, &ws.motions);
        out.load_power = load_power(loads, &ws.motions);
        Ok(())
    }

    fn add_mass(
        &self,
        (t, y): (f64, &[f64]),
        added: &[AddedMass],
        loads: &mut [Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
    ) -> Result<(), DynamicsError> {
        if self.system.speeds() > 0 {
            return add_by_response(self, (t, y), added, loads, ws, out);
        }
        self.unfold(t, y, ws)?;
        let moving = added::accelerate(&self.system, (t, added), loads, ws);
        added::add(&moving, ws, loads);
        Ok(())
    }

    fn symmetrise(&self, mirror: &MirrorSymmetry, _y: &[f64], dy: &mut [f64]) {
        let rates = MomentumState::of(dy);
        MomentumState {
            centre: mirror.kept(rates.centre),
            attitude: mirror.kept_attitude(rates.attitude),
            momentum: mirror.kept(rates.momentum),
            angular: mirror.kept_axial(rates.angular),
        }
        .write(dy);
        let (dq, du) = dy[DIM..].split_at_mut(self.system.coordinates());
        mirror.lead_joints(&self.system, dq, du);
    }

    fn rates_with(
        &self,
        (t, y): (f64, &[f64]),
        added: &[AddedMass],
        loads: &mut [Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
        dy: &mut [f64],
    ) -> Result<(), DynamicsError> {
        if self.system.speeds() > 0 {
            add_by_response(self, (t, y), added, loads, ws, out)?;
            return self.rates(t, y, loads, ws, dy);
        }
        let state = self.unfold(t, y, ws)?;
        let load = added::accelerate(&self.system, (t, added), loads, ws).momentum_rates(ws);
        state.rates(&ws.whole, ws.motions[0].w, &load).write(dy);
        Ok(())
    }

    fn scales(&self) -> Vec<f64> {
        let (m, u) = (self.system.total_mass(), self.system.units());
        let p = m * u.length / u.time;
        let mut s = vec![u.length; 3];
        s.extend([1.0; 4]);
        s.extend([p; 3]);
        s.extend([p * u.length; 3]);
        let joints = || self.system.joints().zip(self.system.offsets());
        let size = |kind| match kind {
            JointType::Prismatic { .. } => u.length,
            _ => 1.0,
        };
        for (j, offsets) in joints() {
            s.extend(vec![size(j.kind); offsets.coordinates]);
        }
        for (j, offsets) in joints() {
            s.extend(vec![size(j.kind) / u.time; offsets.speeds]);
        }
        s
    }

    fn normalise(&self, t: f64, y: &mut [f64], _ws: &mut Workspace) -> Result<(), DynamicsError> {
        check_state(t, y, component)?;
        self.to_unit_length(y);
        Ok(())
    }
}
