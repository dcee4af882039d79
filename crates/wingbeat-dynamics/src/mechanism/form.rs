//! Absolute coordinates with multipliers: position, unit quaternion, velocity and angular velocity
//! of every body, 13 numbers each; singular at no attitude.
//!
//! ```text
//! [ M  B^T ] [ v'     ]   [ Q - inertia terms                     ]
//! [ B  0   ] [ lambda ] = [ -bias - 2 alpha rate - beta^2 value   ]
//! ```
//!
//! Velocities are taken in N components, angular velocities in body components, so that M is
//! `[[m I, -R tilde(S)], [tilde(S) R^T, J]]`. Coordinates are scaled by
//! `1/sqrt(M_ii)`, multipliers by `1/sqrt((B M^-1 B^T)_kk)`.

use wingbeat_math::{
    BodyAcceleration, BodyMotion, DMat3, DQuat, DVec3, Wrench, larger, mirrored_axial, reflected,
};

pub use super::equations::AbsoluteScratch;
use super::equations::{eliminate, put_bodies, put_constraints, put_efforts, read, step};
use super::joint::{JointKinematics, Row, kinematics};
use super::structure::Mechanism;
use crate::system::check::check_state;
use crate::system::joint::Joint;
use crate::system::mirror::MirrorSymmetry;
use crate::{Baumgarte, DynamicsError, HingeReaction};

/// Numbers per body in the state.
pub(crate) const STATE_NUMBERS: usize = 13;

/// How the constraints are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stabilization {
    /// Not at all.
    None,
    /// By feedback (seed eq. 29).
    Baumgarte(Baumgarte),
    /// By projection of positions and velocities between steps ([`AbsoluteForm::project`]), along
    /// the directions of least kinetic energy.
    Projection,
}

/// The equations of a [`Mechanism`].
#[derive(Clone, Debug)]
pub struct AbsoluteForm {
    mechanism: Mechanism,
    stabilization: Stabilization,
}

/// What component `k` of a state is.
pub(crate) fn component(k: usize, _of: usize) -> &'static str {
    match k % STATE_NUMBERS {
        0..3 => "a position",
        3..7 => "an attitude",
        7..10 => "a velocity",
        _ => "an angular velocity",
    }
}

impl AbsoluteForm {
    /// The equations of `mechanism`.
    pub fn new(mechanism: Mechanism, stabilization: Stabilization) -> Self {
        Self {
            mechanism,
            stabilization,
        }
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    /// How the constraints are kept.
    pub fn stabilization(&self) -> Stabilization {
        self.stabilization
    }

    /// Length of the state.
    pub fn dim(&self) -> usize {
        STATE_NUMBERS * self.mechanism.bodies().len()
    }

    /// Room for intermediate results.
    pub fn scratch(&self) -> AbsoluteScratch {
        let (bodies, joints) = (self.mechanism.bodies().len(), self.mechanism.joints());
        let motions = vec![BodyMotion::REST; bodies];
        let joints = joint_kinematics(joints, 0.0, &motions);
        let mut rows = vec![];
        for (k, l) in joints.iter().enumerate() {
            l.rows(|r| rows.push((k, r)));
        }
        let n = 6 * bodies + rows.len();
        AbsoluteScratch {
            accelerations: vec![BodyAcceleration::default(); bodies],
            reactions: vec![HingeReaction::default(); joints.len()],
            violation: [0.0; 2],
            matrix: vec![0.0; n * n],
            rhs: vec![0.0; n],
            scale: vec![0.0; n],
            loads: vec![Wrench::default(); bodies],
            motions,
            joints,
            rows,
        }
    }

    /// The state of bodies that move like `motions`.
    pub fn pack(&self, motions: &[BodyMotion], y: &mut [f64]) {
        for (m, y) in motions.iter().zip(y.chunks_exact_mut(STATE_NUMBERS)) {
            m.p.write_to_slice(&mut y[0..]);
            DQuat::from_mat3(&m.r)
                .normalize()
                .write_to_slice(&mut y[3..]);
            m.v.write_to_slice(&mut y[7..]);
            m.w.write_to_slice(&mut y[10..]);
        }
    }

    /// Motions of the bodies in the state `y`.
    ///
    /// # Errors
    /// The state is not finite.
    pub fn motions(&self, t: f64, y: &[f64], out: &mut [BodyMotion]) -> Result<(), DynamicsError> {
        assert_eq!(y.len(), self.dim(), "13 components for every body");
        check_state(t, y, component)?;
        for (m, y) in out.iter_mut().zip(y.chunks_exact(STATE_NUMBERS)) {
            let v = |i: usize| DVec3::from_slice(&y[i..]);
            *m = BodyMotion {
                p: v(0),
                r: DMat3::from_quat(DQuat::from_slice(&y[3..]).normalize()),
                v: v(7),
                w: v(10),
            };
        }
        Ok(())
    }

    /// Accelerations and reactions in the state `y` under `loads` (weight not included) into `s`.
    ///
    /// # Errors
    /// The state is not finite; the equations are singular.
    pub fn solve(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        s: &mut AbsoluteScratch,
    ) -> Result<(), DynamicsError> {
        self.motions(t, y, &mut s.motions)?;
        self.find_rows(t, s);
        s.loads.copy_from_slice(loads);
        put_efforts(&self.mechanism, t, s);
        put_bodies(&self.mechanism, s);
        let b = match self.stabilization {
            Stabilization::Baumgarte(b) => b,
            _ => Baumgarte::OFF,
        };
        let first = 6 * s.motions.len();
        for (k, (_, r)) in s.rows.iter().enumerate() {
            s.rhs[first + k] = b.right_side(r.bias, r.rate, r.value);
        }
        put_constraints(&self.mechanism, s);
        eliminate(&self.mechanism, t, s)?;
        read(&self.mechanism, t, s);
        Ok(())
    }

    /// Time derivative of the state.
    ///
    /// # Errors
    /// As [`Self::solve`].
    pub fn rates(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        s: &mut AbsoluteScratch,
        dy: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.solve(t, y, loads, s)?;
        let bodies = y
            .chunks_exact(STATE_NUMBERS)
            .zip(dy.chunks_exact_mut(STATE_NUMBERS));
        for (a, (y, dy)) in s.accelerations.iter().zip(bodies) {
            let (q, w) = (DQuat::from_slice(&y[3..]), DVec3::from_slice(&y[10..]));
            dy[0..3].copy_from_slice(&y[7..10]);
            let turn = q * DQuat::from_xyzw(w.x, w.y, w.z, 0.0) * 0.5;
            turn.write_to_slice(&mut dy[3..]);
            a.linear.write_to_slice(&mut dy[7..]);
            a.angular.write_to_slice(&mut dy[10..]);
        }
        Ok(())
    }

    /// Projects the rates `dy` of the state `y` onto motions that are symmetric in `mirror`: those of the root and
    /// of the pairs; other bodies are left as they are.
    pub(crate) fn symmetrise(&self, mirror: &MirrorSymmetry, y: &[f64], dy: &mut [f64]) {
        let vector = |of: &[f64], k: usize| DVec3::from_slice(&of[k..]);
        let (root, _) = dy.split_at_mut(STATE_NUMBERS);
        mirror.kept(vector(root, 0)).write_to_slice(root);
        let turn = mirror.kept_attitude(DQuat::from_slice(&root[3..]));
        turn.write_to_slice(&mut root[3..]);
        mirror.kept(vector(root, 7)).write_to_slice(&mut root[7..]);
        (root[10], root[12]) = (0.0, 0.0);
        for [a, b] in mirror.pairs.iter().map(|p| p.map(|k| STATE_NUMBERS * k)) {
            let attitude = |of: &[f64], k: usize| DQuat::from_slice(&of[k + 3..]);
            let sign = mirror.attitude(attitude(y, a)).dot(attitude(y, b)).signum();
            let [p, v] = [0, 7].map(|k| reflected(vector(dy, a + k), mirror.normal));
            let turn = mirror.attitude(attitude(dy, a)) * sign;
            let w = mirrored_axial(vector(dy, a + 10));
            p.write_to_slice(&mut dy[b..]);
            turn.write_to_slice(&mut dy[b + 3..]);
            v.write_to_slice(&mut dy[b + 7..]);
            w.write_to_slice(&mut dy[b + 10..]);
        }
    }

    /// Quaternions to unit length and, if asked for, positions and velocities onto the
    /// constraints: two steps of Newton in the metric of the masses.
    ///
    /// # Errors
    /// The equations are singular.
    pub fn project(
        &self,
        t: f64,
        y: &mut [f64],
        s: &mut AbsoluteScratch,
    ) -> Result<(), DynamicsError> {
        self.motions(t, y, &mut s.motions)?;
        if self.stabilization == Stabilization::Projection {
            for _ in 0..NEWTON_STEPS {
                self.correct(t, s, |r| r.value)?;
                for i in 0..s.motions.len() {
                    let [x, turn] = step(&s.rhs, i);
                    let m = &mut s.motions[i];
                    m.p += x;
                    m.r *= DMat3::from_quat(DQuat::from_scaled_axis(turn));
                }
            }
            self.correct(t, s, |r| r.rate)?;
            for i in 0..s.motions.len() {
                let [v, w] = step(&s.rhs, i);
                s.motions[i].v += v;
                s.motions[i].w += w;
            }
        }
        self.pack(&s.motions, y);
        Ok(())
    }

    /// The change of least kinetic energy that takes `what` to zero, into `s.rhs`.
    fn correct(
        &self,
        t: f64,
        s: &mut AbsoluteScratch,
        what: impl Fn(&Row) -> f64,
    ) -> Result<(), DynamicsError> {
        self.find_rows(t, s);
        put_bodies(&self.mechanism, s);
        let first = 6 * s.motions.len();
        s.rhs[..first].fill(0.0);
        for (k, (_, r)) in s.rows.iter().enumerate() {
            s.rhs[first + k] = -what(r);
        }
        put_constraints(&self.mechanism, s);
        eliminate(&self.mechanism, t, s)
    }

    /// Constraints of all joints for the motions in `s`.
    pub(crate) fn find_rows(&self, t: f64, s: &mut AbsoluteScratch) {
        s.rows.clear();
        s.violation = [0.0; 2];
        for (k, joint) in self.mechanism.joints().iter().enumerate() {
            s.joints[k] = kinematics(joint, t, &s.motions);
            s.joints[k].rows(|r| s.rows.push((k, r)));
        }
        for (_, r) in &s.rows {
            let worst = &mut s.violation[usize::from(!r.is_length)];
            *worst = larger(*worst, r.value.abs());
        }
    }

    /// Constraints and the joints they belong to, as last found.
    pub(crate) fn rows(s: &AbsoluteScratch) -> &[(usize, Row)] {
        &s.rows
    }

    /// Links as last found.
    pub(crate) fn joints(s: &AbsoluteScratch) -> &[JointKinematics] {
        &s.joints
    }

    /// Natural sizes of the components of the state.
    pub fn scales(&self) -> Vec<f64> {
        let u = self.mechanism.units();
        let mut one = vec![u.length; 3];
        one.extend([1.0; 4]);
        one.extend([u.length / u.time; 3]);
        one.extend([1.0 / u.time; 3]);
        one.repeat(self.mechanism.bodies().len())
    }
}

/// Steps of Newton's iteration in a projection: a step's drift is small, two reach round-off.
const NEWTON_STEPS: usize = 2;

fn joint_kinematics(joints: &[Joint], t: f64, motions: &[BodyMotion]) -> Vec<JointKinematics> {
    joints.iter().map(|l| kinematics(l, t, motions)).collect()
}
