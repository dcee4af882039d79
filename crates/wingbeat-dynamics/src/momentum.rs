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
//! I(t) and h(t) are inertia and relative angular momentum of the posture in root components. In
//! vacuum P and H are constant in the arithmetic itself. Constraints hold by construction, so
//! nothing can drift; a body without mass is as good as any.
//!
//! Free joints add their coordinates and speeds to the state ([`crate::free`]); I and h then
//! depend on them too.

use std::sync::Arc;

use wingbeat_math::{DMat3, DQuat, DVec3};

use crate::added_mass::{Six, seen, six, solve_symmetric, wrench};
use crate::body::inertia_wrench;
use crate::budget::{budget, load_power};
use crate::check::{check_rotation, check_state};
use crate::formulation::add_by_response;
use crate::free::coordinate_rates;
use crate::inverse::{demand, multipliers, reactions};
use crate::mechanism::Mechanism;
use crate::placement::Placement;
use crate::posture::{Composite, Posture, PostureTable};
use crate::slot::start;
use crate::workspace::MOMENTUM_STATE;
use crate::{
    AddedMass, BodyAcceleration, BodyMotion, DynamicsError, Formulation, Freedom, Solution, System,
    Violation, Workspace, Wrench,
};

/// Length of the state vector without free joint coordinates.
const DIM: usize = MOMENTUM_STATE;

/// The momentum form of a [`System`].
#[derive(Clone, Debug)]
pub struct MomentumForm {
    system: System,
    table: Option<Arc<PostureTable>>,
}

/// The state vector, taken apart.
struct State {
    centre: DVec3,
    attitude: DQuat,
    momentum: DVec3,
    angular: DVec3,
}

impl State {
    fn read(t: f64, y: &[f64]) -> Result<Self, DynamicsError> {
        check_state(t, y)?;
        let v = |i: usize| DVec3::new(y[i], y[i + 1], y[i + 2]);
        Ok(Self {
            centre: v(0),
            attitude: DQuat::from_xyzw(y[3], y[4], y[5], y[6]),
            momentum: v(7),
            angular: v(10),
        })
    }

    fn write(&self, y: &mut [f64]) {
        self.centre.write_to_slice(&mut y[0..]);
        self.attitude.write_to_slice(&mut y[3..]);
        self.momentum.write_to_slice(&mut y[7..]);
        self.angular.write_to_slice(&mut y[10..]);
    }

    /// Rates of the state when the root turns at `w` under the total `load`.
    fn rates(&self, whole: &Composite, w: DVec3, load: &Wrench) -> Self {
        Self {
            centre: self.momentum / whole.mass,
            attitude: self.attitude * DQuat::from_xyzw(w.x, w.y, w.z, 0.0) * 0.5,
            momentum: load.force,
            angular: load.moment,
        }
    }

    /// Rotation of the root; the length of the quaternion does not matter.
    fn rotation(&self) -> DMat3 {
        DMat3::from_quat(self.attitude.normalize())
    }
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
    pub fn tabulated(self, table: Arc<PostureTable>) -> Self {
        Self {
            table: Some(table),
            ..self
        }
    }

    /// Postures and whole at time `t` into `ws`, known already if it was the last time asked for
    /// and no joint is free.
    fn lay(&self, t: f64, y: &[f64], ws: &mut Workspace) -> Composite {
        if let Some((at, whole)) = ws.prescribed
            && at == t
        {
            return whole;
        }
        let whole = (ws.posture).lay(&self.system, t, self.free(y), self.table.as_deref());
        ws.prescribed = (self.system.coordinates() == 0).then_some((t, whole));
        whole
    }

    /// Free joint coordinates and speeds in the state.
    fn free<'a>(&self, y: &'a [f64]) -> (&'a [f64], &'a [f64]) {
        assert_eq!(y.len(), self.dim(), "a state of this momentum form");
        y[DIM..].split_at(self.system.coordinates())
    }

    /// The table of postures, if there is one.
    pub fn table(&self) -> Option<&PostureTable> {
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
        Posture::check(&self.system, t)?;
        let mut posture = Posture::new(&self.system);
        posture.update_free(&self.system, t, (&q, &u));
        let whole = posture.composite(&self.system);
        turn(t, whole.inertia, DVec3::ZERO)?;
        let state = State {
            centre: root.p + root.r * whole.c,
            attitude: DQuat::from_mat3(&root.r).normalize(),
            momentum: whole.mass * (root.v + root.r * (root.w.cross(whole.c) + whole.c_dot)),
            angular: root.r * (whole.inertia * root.w + whole.h),
        };
        let mut y = vec![0.0; DIM];
        state.write(&mut y);
        y.extend(q);
        y.extend(u);
        check_state(t, &y)?;
        Ok(y)
    }

    /// Accelerations of the free joint speeds into `ws.free` and into the placements; motions and
    /// placements as [`Self::unfold`] left them.
    fn move_joints(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        whole: &Composite,
        ws: &mut Workspace,
    ) -> Result<(), DynamicsError> {
        let root = ws.motions[0];
        let still = BodyAcceleration::default();
        ws.posture.accelerations(&root, &still, &mut ws.bias);
        demand(&self.system, loads, &ws.motions, &ws.bias, &mut ws.demand);
        let (q, u) = self.free(y);
        let posture = (ws.posture.placements(), whole, root.r);
        (ws.free)
            .solve(&self.system, (t, q, u), posture, &ws.demand)
            .map_err(|e| DynamicsError::SingularMechanism {
                time: t,
                what: format!("hinge `{}`", ws.free.hinge(&self.system, e.column)),
            })?;
        ws.free
            .accelerate(&self.system, ws.posture.placements_mut());
        Ok(())
    }

    /// Rates of the free joint coordinates and speeds.
    fn write_joint_rates(&self, y: &[f64], ws: &Workspace, dy: &mut [f64]) {
        let (q, u) = self.free(y);
        let (dq, du) = dy[DIM..].split_at_mut(q.len());
        for (joint, s) in self.system.joints().iter().zip(self.system.slots()) {
            let (q, u) = (&q[s.q..s.q + s.coordinates], &u[s.u..s.u + s.speeds]);
            coordinate_rates(joint.freedom, q, u, &mut dq[s.q..s.q + s.coordinates]);
        }
        du.copy_from_slice(&ws.free.u_dot);
    }

    /// Coordinates (angles, displacements, quaternion) and speeds of hinge `index` in the state.
    pub fn joint_state<'a>(&self, y: &'a [f64], index: usize) -> (&'a [f64], &'a [f64]) {
        let ((q, u), s) = (self.free(y), self.system.slots()[index]);
        (&q[s.q..s.q + s.coordinates], &u[s.u..s.u + s.speeds])
    }

    /// Angular velocity of the root from the angular momentum, `w = I^-1 (R^T H - h)` [rad/s].
    fn root_motion(
        &self,
        t: f64,
        state: &State,
        whole: &Composite,
    ) -> Result<BodyMotion, DynamicsError> {
        let r = state.rotation();
        let w = turn(t, whole.inertia, r.transpose() * state.angular - whole.h)?;
        Ok(BodyMotion {
            p: state.centre - r * whole.c,
            r,
            v: state.momentum / whole.mass - r * (w.cross(whole.c) + whole.c_dot),
            w,
        })
    }

    /// Motions of all bodies into `ws.motions`; returns the state and the whole.
    fn unfold(
        &self,
        t: f64,
        y: &[f64],
        ws: &mut Workspace,
    ) -> Result<(State, Composite), DynamicsError> {
        let state = State::read(t, y)?;
        if let Some(whole) = ws.known(t, y) {
            return Ok((state, whole));
        }
        let whole = self.lay(t, y, ws);
        let root = self.root_motion(t, &state, &whole)?;
        ws.posture.motions(&root, &mut ws.motions);
        ws.note(t, y, whole);
        Ok((state, whole))
    }

    /// Sum of all external forces and of their moments about the mass centre `x_c`, N components.
    fn total_load(&self, loads: &[Wrench], motions: &[BodyMotion], x_c: DVec3) -> Wrench {
        let mut sum = Wrench {
            force: self.system.total_mass() * self.system.gravity(),
            moment: DVec3::ZERO,
        };
        for (l, m) in loads.iter().zip(motions) {
            sum.force += l.force;
            sum.moment += l.moment + (m.p - x_c).cross(l.force);
        }
        sum
    }

    /// As [`Self::total_load`], from the placements: `r` is the root's rotation, `c` the mass centre
    /// in root components.
    fn whole_load(&self, loads: &[Wrench], posture: &Posture, r: DMat3, c: DVec3) -> Wrench {
        let mut sum = Wrench {
            force: self.system.total_mass() * self.system.gravity(),
            moment: DVec3::ZERO,
        };
        for (l, at) in loads.iter().zip(posture.placements()) {
            sum.force += l.force;
            sum.moment += l.moment + (r * (at.d - c)).cross(l.force);
        }
        sum
    }

    /// Accelerations of all bodies from Newton's and Euler's laws for the whole system.
    fn accelerate(
        &self,
        t: f64,
        x_c: DVec3,
        whole: &Composite,
        load: &Wrench,
        ws: &Workspace,
        out: &mut [BodyAcceleration],
    ) -> Result<(), DynamicsError> {
        let root = ws.motions[0];
        // With the root's accelerations zero, the momenta change at the rate of the bias.
        ws.posture
            .accelerations(&root, &BodyAcceleration::default(), out);
        let bias = self.momentum_rate(&ws.motions, out, x_c);
        let moment = root.r.transpose() * (load.moment - bias.moment);
        let angular = turn(t, whole.inertia, moment)?;
        let linear = (load.force - bias.force) / whole.mass - root.r * angular.cross(whole.c);
        let acc = BodyAcceleration { linear, angular };
        ws.posture.accelerations(&root, &acc, out);
        Ok(())
    }

    /// Acceleration of the mass centre and angular acceleration of the root (root components) under
    /// `loads` and the added masses, less those at rest; rates of the momenta at rest. Motions as
    /// [`Self::unfold`] left them; accelerations at rest into `ws.bias`.
    fn accelerate_with(
        &self,
        added: &[AddedMass],
        loads: &[Wrench],
        state: &State,
        whole: &Composite,
        ws: &mut Workspace,
    ) -> (Six, Wrench) {
        let load = self.total_load(loads, &ws.motions, state.centre);
        let root = ws.motions[0];
        let still = BodyAcceleration::default();
        ws.posture.accelerations(&root, &still, &mut ws.bias);
        let bias = self.momentum_rate(&ws.motions, &ws.bias, state.centre);
        let back = root.r.transpose();
        let mut x = six(
            back * (load.force - bias.force),
            back * (load.moment - bias.moment),
        );
        let mut matrix = inertia_of_whole(whole);
        for a in added {
            let at = &ws.posture.placements()[a.body()];
            let load = a.load(&seen(&ws.motions[a.body()], &ws.bias[a.body()]));
            put_added(a, at, whole.c, &load, &mut matrix, &mut x);
        }
        solve_symmetric(&mut matrix, &mut x);
        (x, bias)
    }

    /// Rates of linear momentum and of angular momentum about the mass centre.
    fn momentum_rate(
        &self,
        motions: &[BodyMotion],
        acc: &[BodyAcceleration],
        x_c: DVec3,
    ) -> Wrench {
        let mut sum = Wrench::default();
        for ((b, m), a) in self.system.bodies().iter().zip(motions).zip(acc) {
            let w = inertia_wrench(b, m, a);
            sum += Wrench {
                force: w.force,
                moment: w.moment + (m.p - x_c).cross(w.force),
            };
        }
        sum
    }
}

/// Solves `inertia x = h` by Cramer's rule.
fn turn(time: f64, inertia: DMat3, h: DVec3) -> Result<DVec3, DynamicsError> {
    let (x, y, z) = (inertia.x_axis, inertia.y_axis, inertia.z_axis);
    let (yz, zx, xy) = (y.cross(z), z.cross(x), x.cross(y));
    let (determinant, scale) = (x.dot(yz), (x.x + y.y + z.z) / 3.0);
    // 1e-12 of the mean moment cubed: a rod a million times longer than thick.
    if determinant > 1e-12 * scale.powi(3) {
        return Ok(DVec3::new(h.dot(yz), h.dot(zx), h.dot(xy)) / determinant);
    }
    Err(DynamicsError::SingularInertia { time, scale })
}

/// `diag(m, I)`, root components.
fn inertia_of_whole(whole: &Composite) -> [Six; 6] {
    let mut matrix = [[0.0; 6]; 6];
    for i in 0..3 {
        matrix[i][i] = whole.mass;
        for j in 0..3 {
            matrix[3 + i][3 + j] = whole.inertia.col(j)[i];
        }
    }
    matrix
}

/// Row k of J: component k of the acceleration of a body (origin, angular; body components) by the
/// acceleration of the mass centre at `c` and the root's angular acceleration, root components.
fn row(at: &Placement, c: DVec3, k: usize) -> Six {
    let axis = at.c.col(k % 3);
    match k < 3 {
        true => six(axis, (at.d - c).cross(axis)),
        false => six(DVec3::ZERO, axis),
    }
}

/// Adds `J^T A J` to the lower half of the matrix and `J^T load` to the right-hand side.
fn put_added(
    a: &AddedMass,
    at: &Placement,
    c: DVec3,
    load: &Six,
    matrix: &mut [Six; 6],
    x: &mut Six,
) {
    let mut rows = [[0.0; 6]; 6];
    a.directions().iter().for_each(|&k| rows[k] = row(at, c, k));
    for &k in a.directions() {
        let mut carried = [0.0; 6];
        for &l in a.directions() {
            let factor = a.matrix()[k][l];
            (0..6).for_each(|j| carried[j] += factor * rows[l][j]);
        }
        for i in 0..6 {
            x[i] += rows[k][i] * load[k];
            (0..=i).for_each(|j| matrix[i][j] += rows[k][i] * carried[j]);
        }
    }
}

fn dot(a: &Six, b: &Six) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Formulation for MomentumForm {
    fn system(&self) -> &System {
        &self.system
    }

    fn dim(&self) -> usize {
        DIM + self.system.coordinates() + self.system.speeds()
    }

    fn initial(&self, t: f64, root: &BodyMotion) -> Result<Vec<f64>, DynamicsError> {
        self.start_at(t, root, self.system.start())
    }

    fn initial_from(&self, t: f64, motions: &[BodyMotion]) -> Result<Vec<f64>, DynamicsError> {
        let mut free = vec![];
        Mechanism::of(&self.system).coordinates(t, motions, &mut free);
        let (mut q, mut u) = self.system.start();
        let mut rest = free.as_slice();
        for (joint, slot) in self.system.joints().iter().zip(self.system.slots()) {
            let (own, others) = rest.split_at(slot.speeds);
            let [x, v] = [0, 1].map(|k| own.iter().map(|c| c[k]).collect::<Vec<f64>>());
            start(&joint.clone().starting(&x, &v), slot, &mut q, &mut u);
            rest = others;
        }
        self.start_at(t, &motions[0], (q, u))
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
            let (state, whole) = self.unfold(t, y, ws)?;
            let load = self.total_load(loads, &ws.motions, state.centre);
            self.move_joints(t, y, loads, &whole, ws)?;
            state.rates(&whole, ws.motions[0].w, &load).write(dy);
            self.write_joint_rates(y, ws, dy);
            return Ok(());
        }
        let state = State::read(t, y)?;
        let whole = self.lay(t, y, ws);
        let r = state.rotation();
        let w = turn(t, whole.inertia, r.transpose() * state.angular - whole.h)?;
        let load = self.whole_load(loads, &ws.posture, r, whole.c);
        state.rates(&whole, w, &load).write(dy);
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
        let (state, whole) = self.unfold(t, y, ws)?;
        let load = self.total_load(loads, &ws.motions, state.centre);
        if self.system.speeds() > 0 {
            self.move_joints(t, y, loads, &whole, ws)?;
        }
        self.accelerate(t, state.centre, &whole, &load, ws, &mut out.bodies)?;
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
        let (state, whole) = self.unfold(t, y, ws)?;
        let (x, _) = self.accelerate_with(added, loads, &state, &whole, ws);
        for a in added {
            let mut s = seen(&ws.motions[a.body()], &ws.bias[a.body()]);
            for &k in a.directions() {
                s[k] += dot(&row(&ws.posture.placements()[a.body()], whole.c, k), &x);
            }
            loads[a.body()] += wrench(ws.motions[a.body()].r, &a.load(&s));
        }
        Ok(())
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
        let (state, whole) = self.unfold(t, y, ws)?;
        let (x, bias) = self.accelerate_with(added, loads, &state, &whole, ws);
        // Accelerations under all loads give the rates of the momenta, added masses included.
        let r = ws.motions[0].r;
        let load = Wrench {
            force: bias.force + r * (whole.mass * DVec3::from_slice(&x)),
            moment: bias.moment + r * (whole.inertia * DVec3::from_slice(&x[3..])),
        };
        state.rates(&whole, ws.motions[0].w, &load).write(dy);
        Ok(())
    }

    fn scales(&self) -> Vec<f64> {
        let (m, u) = (self.system.total_mass(), self.system.units());
        let p = m * u.length / u.time;
        let mut s = vec![u.length; 3];
        s.extend([1.0; 4]);
        s.extend([p; 3]);
        s.extend([p * u.length; 3]);
        let joints = || self.system.joints().iter().zip(self.system.slots());
        let size = |freedom| match freedom {
            Freedom::Prismatic { .. } => u.length,
            _ => 1.0,
        };
        for (j, slot) in joints() {
            s.extend(vec![size(j.freedom); slot.coordinates]);
        }
        for (j, slot) in joints() {
            s.extend(vec![size(j.freedom) / u.time; slot.speeds]);
        }
        s
    }

    fn normalise(&self, t: f64, y: &mut [f64], _ws: &mut Workspace) -> Result<(), DynamicsError> {
        let mut state = State::read(t, y)?;
        state.attitude = state.attitude.normalize();
        state.write(y);
        for (joint, slot) in self.system.joints().iter().zip(self.system.slots()) {
            if joint.freedom == Freedom::Spherical {
                let q = &mut y[DIM + slot.q..];
                DQuat::from_slice(q).normalize().write_to_slice(q);
            }
        }
        Ok(())
    }
}
