//! Closing loops time after time.
//!
//! With q the coordinates of the joints on loops, u their speeds and J the derivative of the rates of the loops'
//! constraints Phi by u:
//!
//! ```text
//! J dq = -Phi (Newton)        J u = -Phi'(u = 0)        J u' = -Phi''(u' = 0)
//! ```
//!
//! The root is at rest. J is square where the loops leave nothing free and ask for nothing twice.

use wingbeat_math::{BodyAcceleration, BodyMotion, DQuat, DVec3, MovingRotation, larger};

use crate::configuration::Configuration;
use crate::error::quoted_once;
use crate::mechanism::Mechanism;
use crate::mechanism::form::{AbsoluteForm, Stabilization};
use crate::mechanism::joint::{Row, kinematics};
use crate::mechanism::partition::{NEARLY_SINGULAR, partition};
use crate::system::joint::Joint;
use crate::system::placement::{Placement, carry};
use crate::{DynamicsError, JointType, System};

/// Newton's steps at most; from where the loops were just before, four reach round-off.
const ITERATIONS: usize = 20;

/// A step of Newton's method that counts as none \[rad, natural lengths\].
const TOLERANCE: f64 = 1e-12;

/// Coordinates that are farther than this from where their speeds took them \[rad, natural lengths\] belong to
/// another closed position.
const JUMP: f64 = 0.3;

/// The rotation and the displacement of a joint's child against its parent.
pub(super) type Relative = (MovingRotation, [DVec3; 3]);

/// Loops that are closed time after time.
pub(super) struct Closing<'a> {
    system: &'a System,
    configuration: Configuration,
    motions: Vec<BodyMotion>,
    accelerations: Vec<BodyAcceleration>,
    /// Natural sizes of the coordinates.
    sizes: Vec<f64>,
    q: Vec<f64>,
    u: Vec<f64>,
    u_dot: Vec<f64>,
}

impl<'a> Closing<'a> {
    /// Closes the loops of `system` at time zero.
    ///
    /// # Errors
    /// Loops that cannot be closed, ask for something twice or leave something free, by name.
    pub fn new(system: &'a System) -> Result<Self, DynamicsError> {
        let mut configuration = Configuration::new(system);
        configuration.update(system, 0.0);
        let mut motions = vec![BodyMotion::REST; system.bodies().len()];
        configuration.motions(&BodyMotion::REST, &mut motions);
        let support = Joint::new("support of the root", None, 0, JointType::Weld);
        let mechanism = Mechanism::of(system).with_joint(support);
        let form = AbsoluteForm::new(mechanism, Stabilization::None);
        let y = form.initial(0.0, &motions, &[])?;
        form.motions(0.0, &y, &mut motions)?;
        if let (free @ 1.., Some(joint)) = (form.freedoms(0.0, &motions), system.loops().first()) {
            let joint = joint.name.clone();
            return Err(DynamicsError::LooseLoop { joint, free });
        }
        let (q, u) = form.mechanism().free_coordinates(system, 0.0, &motions);
        let mut sizes = vec![1.0; u.len()];
        for (joint, offsets) in system.joints().zip(system.offsets()) {
            if let JointType::Prismatic { .. } = joint.kind {
                sizes[offsets.u] = system.units().length;
            }
        }
        Ok(Self {
            system,
            configuration,
            accelerations: vec![BodyAcceleration::default(); motions.len()],
            motions,
            sizes,
            u_dot: vec![0.0; u.len()],
            q,
            u,
        })
    }

    /// Coordinates, speeds and their rates at time `t` \[s\], a `duration` \[s\] after the last.
    ///
    /// # Errors
    /// [`DynamicsError::SingularPosition`]: the loops may go on in several ways, or went on in another.
    pub fn close(&mut self, t: f64, duration: f64) -> Result<(), DynamicsError> {
        let onward: Vec<f64> = self.u.iter().map(|u| u * duration).collect();
        self.shift(&onward);
        let zero = vec![0.0; self.u.len()];
        let mut moved = 0.0;
        for _ in 0..ITERATIONS {
            let rows = self.rows(t, &zero);
            let step = self.solved(t, rows.iter().map(|r| r.1.value).collect())?;
            self.shift(&step);
            let sizes = step.iter().zip(&self.sizes).map(|(x, s)| (x / s).abs());
            let size = sizes.fold(0.0, larger);
            moved += size;
            if moved > JUMP || moved.is_nan() {
                break;
            }
            if size <= TOLERANCE {
                return self.find_rates(t);
            }
        }
        let all: Vec<usize> = (0..self.system.loops().len()).collect();
        Err(self.undetermined(t, &all))
    }

    /// Speeds and their rates in the closed position.
    fn find_rates(&mut self, t: f64) -> Result<(), DynamicsError> {
        let zero = vec![0.0; self.u.len()];
        let rows = self.rows(t, &zero);
        self.u = self.solved(t, rows.iter().map(|r| r.1.rate).collect())?;
        let u = self.u.clone();
        let rows = self.rows(t, &u);
        let second = rows.iter().map(|(l, r)| self.second_rate(*l, r)).collect();
        self.u_dot = self.solved(t, second)?;
        Ok(())
    }

    /// The solution x of `J x = -right` in the present position.
    fn solved(&mut self, t: f64, right: Vec<f64>) -> Result<Vec<f64>, DynamicsError> {
        let n = self.u.len();
        let unit = |j: usize| -> Vec<f64> { (0..n).map(|k| f64::from(u8::from(j == k))).collect() };
        let base = self.rows(t, &vec![0.0; n]);
        let columns: Vec<_> = (0..n).map(|j| self.rows(t, &unit(j))).collect();
        let length = self.system.units().length;
        let scale = |r: &Row| if r.is_length { 1.0 / length } else { 1.0 };
        let row = |i: usize| -> Vec<f64> {
            let r = &base[i].1;
            let slope = |j: usize| (columns[j][i].1.rate - r.rate) * self.sizes[j] * scale(r);
            (0..n).map(slope).collect()
        };
        let matrix = (0..base.len()).map(row).collect();
        let right = right.iter().zip(&base).map(|(x, (_, r))| -x * scale(r));
        let found = partition(matrix, right.collect(), &vec![true; n], NEARLY_SINGULAR);
        if let Some(d) = found.dependent.first() {
            let shares = d.combination.iter().zip(&base);
            let names = shares.filter(|(c, _)| c.abs() > 1e-6);
            let loops: Vec<usize> = names.map(|(_, (l, _))| *l).collect();
            return Err(self.undetermined(t, &loops));
        }
        Ok(found
            .step
            .iter()
            .zip(&self.sizes)
            .map(|(x, s)| x * s)
            .collect())
    }

    /// Changes the coordinates by `step`, those of spherical joints by a rotation vector.
    fn shift(&mut self, step: &[f64]) {
        for offsets in self.system.offsets() {
            let (q, step) = (&mut self.q[offsets.q..], &step[offsets.u..]);
            if offsets.coordinates == 4 {
                let turn = DQuat::from_scaled_axis(DVec3::from_slice(step));
                let turned = (DQuat::from_slice(q) * turn).normalize();
                turned.write_to_slice(q);
            } else {
                (0..offsets.speeds).for_each(|k| q[k] += step[k]);
            }
        }
    }

    /// The constraints of all loops, each with the number of its loop, at time `t` \[s\] for the speeds `u`;
    /// motions of the bodies, and accelerations at constant speeds, stay.
    fn rows(&mut self, t: f64, u: &[f64]) -> Vec<(usize, Row)> {
        let (root, still) = (BodyMotion::REST, BodyAcceleration::default());
        self.configuration.update_free(self.system, t, (&self.q, u));
        self.configuration.motions(&root, &mut self.motions);
        (self.configuration).accelerations(&root, &still, &mut self.accelerations);
        let mut rows = vec![];
        for (k, joint) in self.system.loops().iter().enumerate() {
            kinematics(joint, t, &self.motions).rows(|row| rows.push((k, row)));
        }
        rows
    }

    /// Second rate of a constraint of loop `k` at constant speeds.
    fn second_rate(&self, k: usize, r: &Row) -> f64 {
        let joint = &self.system.loops()[k];
        let part = |body: usize, [v, w]: [DVec3; 2]| {
            let a = &self.accelerations[body];
            v.dot(a.linear) + w.dot(a.angular)
        };
        let of_parent = joint.parent.map_or(0.0, |p| part(p, r.parent));
        of_parent + part(joint.child, r.child) + r.bias
    }

    /// How the child of hinge `k` moves against its parent in the position closed last, at time `t` \[s\].
    pub fn relative(&self, t: f64, k: usize) -> Relative {
        let h = &self.system.hinges()[k];
        let joint = &h.model;
        let offsets = self.system.offsets()[k];
        let travel = (joint.travel.as_ref()).map_or([DVec3::ZERO; 3], |law| law.at(t));
        let frame = Placement::ROOT.slid(travel).turned(&h.rotation(t));
        let [u, u_dot] = [&self.u, &self.u_dot].map(|x| &x[offsets.u..offsets.u + offsets.speeds]);
        let child = carry(joint.kind, frame, &self.q[offsets.q..], u, Some(u_dot));
        let turned = MovingRotation {
            c: child.c,
            w: child.w,
            w_dot: child.w_dot,
        };
        (turned, [child.d, child.d_dot, child.d_ddot])
    }

    /// The error of a position in which loops may go on in several ways.
    fn undetermined(&self, time: f64, loops: &[usize]) -> DynamicsError {
        let joints = quoted_once(loops.iter().map(|k| &*self.system.loops()[*k].name));
        DynamicsError::SingularPosition { time, joints }
    }
}
