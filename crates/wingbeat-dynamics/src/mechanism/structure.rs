//! Bodies and what joins them.

use wingbeat_math::{BodyMotion, DVec3};

use super::joint::kinematics;
use crate::error::DynamicsError;
use crate::system::System;
use crate::system::body::{Body, NaturalUnits};
use crate::system::check::{check_finite, check_positive};
use crate::system::joint::{Joint, check_joint};
use crate::system::offsets::start;

/// Bodies and joints.
#[derive(Clone, Debug)]
pub struct Mechanism {
    bodies: Vec<Body>,
    joints: Vec<Joint>,
    gravity: DVec3,
    units: NaturalUnits,
}

impl Mechanism {
    /// `bodies` joined by `joints` in the field `gravity` [m/s2, N components]. Either body 0 or
    /// the ground is where everything hangs.
    ///
    /// # Errors
    /// Impossible mass properties, numbers that are not finite, axes that are no unit vectors,
    /// joints to bodies that do not exist, a body that no chain of joints joins to the rest.
    pub fn new(
        bodies: Vec<Body>,
        joints: Vec<Joint>,
        gravity: DVec3,
        units: NaturalUnits,
    ) -> Result<Self, DynamicsError> {
        if bodies.is_empty() {
            return Err(DynamicsError::NoBodies);
        }
        for b in &bodies {
            b.mass.validate().map_err(|source| DynamicsError::Mass {
                body: b.name.clone(),
                source,
            })?;
        }
        check_finite("gravity [m/s2]", gravity)?;
        check_positive("natural unit of length [m]", units.length)?;
        check_positive("natural unit of time [s]", units.time)?;
        joints
            .iter()
            .try_for_each(|l| check_joint(l, bodies.len()))?;
        check_connected(&bodies, &joints)?;
        Ok(Self {
            bodies,
            joints,
            gravity,
            units,
        })
    }

    /// The mechanism of a [`System`]: its hinges as joints, in their order, then those that close
    /// loops.
    pub fn of(system: &System) -> Self {
        let joints = system.hinges().iter().chain(system.loops());
        Self {
            bodies: system.bodies().to_vec(),
            joints: joints.cloned().collect(),
            gravity: system.gravity(),
            units: system.units(),
        }
    }

    /// The same mechanism with one more joint.
    pub(crate) fn with_joint(mut self, joint: Joint) -> Self {
        self.joints.push(joint);
        self
    }

    /// Coordinates and rates along the free directions of all joints at time `t` \[s\], joint after
    /// joint: angles in (-pi, pi] \[rad\], rotation vectors of spherical joints, displacements \[m\].
    pub fn coordinates(&self, t: f64, motions: &[BodyMotion], out: &mut Vec<[f64; 2]>) {
        out.clear();
        for joint in &self.joints {
            let n = joint.model.kind.directions();
            out.extend(&kinematics(joint, t, motions).coordinates()[..n]);
        }
    }

    /// Coordinates and speeds of the free joints of `system`, whose mechanism this is, where its bodies move
    /// like `motions`.
    pub(crate) fn free_coordinates(
        &self,
        system: &System,
        t: f64,
        motions: &[BodyMotion],
    ) -> (Vec<f64>, Vec<f64>) {
        let mut free = vec![];
        self.coordinates(t, motions, &mut free);
        let (mut q, mut u) = system.start();
        let mut rest = free.as_slice();
        for (joint, offsets) in system.joints().zip(system.offsets()) {
            let (own, others) = rest.split_at(offsets.speeds);
            let [x, v] = [0, 1].map(|k| own.iter().map(|c| c[k]).collect::<Vec<f64>>());
            start(&joint.clone().starting(&x, &v), offsets, &mut q, &mut u);
            rest = others;
        }
        (q, u)
    }

    /// The bodies.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The joints, in the order of reactions.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Gravity [m/s2], N components.
    pub fn gravity(&self) -> DVec3 {
        self.gravity
    }

    /// Natural units.
    pub fn units(&self) -> NaturalUnits {
        self.units
    }
}

/// Every body must be reached from the ground or, if nothing hangs on the ground, from body 0.
fn check_connected(bodies: &[Body], joints: &[Joint]) -> Result<(), DynamicsError> {
    let grounded = joints.iter().any(|l| l.parent.is_none());
    let mut reached = vec![false; bodies.len()];
    reached[0] = !grounded;
    let mut grows = true;
    while grows {
        grows = false;
        for l in joints {
            let parent = l.parent.is_none_or(|p| reached[p]);
            if parent != reached[l.child] {
                reached[l.child] = true;
                l.parent.into_iter().for_each(|p| reached[p] = true);
                grows = true;
            }
        }
    }
    match reached.iter().position(|r| !r) {
        None => Ok(()),
        Some(i) => Err(DynamicsError::Disconnected {
            body: bodies[i].name.clone(),
            from: if grounded { "the ground" } else { "body 0" },
        }),
    }
}
