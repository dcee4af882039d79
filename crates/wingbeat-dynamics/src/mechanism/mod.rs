//! Mechanisms: bodies joined by any joints, to the ground or to each other, in trees and loops.
//!
//! A [`Mechanism`] is more general than a [`crate::System`]: links may hang on the ground, and
//! several links may hold one body. [`AbsoluteForm`] writes its motion in absolute coordinates
//! (position and unit quaternion of every body) with multipliers, which are singular nowhere.
//! Reading order: [`link`] (what a joint asks of two bodies), [`partition`] (which coordinates
//! follow from which, and what is asked twice), [`assembly`] (consistent starts), [`form`].

pub mod assembly;
pub mod form;
pub mod link;
pub mod partition;

use std::sync::Arc;

use wingbeat_math::{DMat3, DVec3, RotationLaw};

use crate::mechanism::form::kinematics;
use crate::system::{check_finite, check_positive};
use crate::{Body, BodyMotion, DynamicsError, Freedom, Joint, NaturalUnits, System};

/// A joint between two bodies, or between the ground and a body.
#[derive(Clone, Debug)]
pub struct Link {
    /// Name, for messages and results.
    pub name: String,
    /// Index of the parent body; the ground (frame N) if none.
    pub parent: Option<usize>,
    /// Index of the child body.
    pub child: usize,
    /// Joint point in the parent's frame \[m\].
    pub anchor_parent: DVec3,
    /// Joint point in the child's frame \[m\].
    pub anchor_child: DVec3,
    /// Rotation of the joint's frame K: K components to parent components.
    pub law: Arc<dyn RotationLaw>,
    /// What is free, and what acts.
    pub joint: Joint,
}

impl Link {
    /// A joint between `parent` and `child` with frames parallel at zero coordinates.
    pub fn new(name: &str, parent: Option<usize>, child: usize, freedom: Freedom) -> Self {
        Self {
            name: name.into(),
            parent,
            child,
            anchor_parent: DVec3::ZERO,
            anchor_child: DVec3::ZERO,
            law: Arc::new(DMat3::IDENTITY),
            joint: Joint::new(freedom),
        }
    }

    /// The same at the point `parent` \[m\] of the parent and `child` \[m\] of the child.
    pub fn at(self, parent: DVec3, child: DVec3) -> Self {
        Self {
            anchor_parent: parent,
            anchor_child: child,
            ..self
        }
    }
}

/// Bodies and links.
#[derive(Clone, Debug)]
pub struct Mechanism {
    bodies: Vec<Body>,
    links: Vec<Link>,
    gravity: DVec3,
    units: NaturalUnits,
}

impl Mechanism {
    /// `bodies` joined by `links` in the field `gravity` [m/s2, N components]. Either body 0 or
    /// the ground is where everything hangs.
    ///
    /// # Errors
    /// Impossible mass properties, numbers that are not finite, axes that are no unit vectors,
    /// links to bodies that do not exist, a body that no chain of links joins to the rest.
    pub fn new(
        bodies: Vec<Body>,
        links: Vec<Link>,
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
        links.iter().try_for_each(|l| check_link(l, bodies.len()))?;
        check_connected(&bodies, &links)?;
        Ok(Self {
            bodies,
            links,
            gravity,
            units,
        })
    }

    /// The mechanism of a [`System`]: its hinges as links, in their order, then those that close
    /// loops.
    pub fn of(system: &System) -> Self {
        let hinges = system.hinges().iter().zip(system.joints());
        let tree = hinges.map(|(h, joint)| Link {
            name: h.name.clone(),
            parent: Some(h.parent),
            child: h.child,
            anchor_parent: h.anchor_parent,
            anchor_child: h.anchor_child,
            law: h.law.clone(),
            joint: joint.clone(),
        });
        Self {
            bodies: system.bodies().to_vec(),
            links: tree.chain(system.loops().iter().cloned()).collect(),
            gravity: system.gravity(),
            units: system.units(),
        }
    }

    /// The same mechanism with one more joint.
    pub(crate) fn with_link(mut self, link: Link) -> Self {
        self.links.push(link);
        self
    }

    /// Coordinates and rates along the free directions of all joints at time `t` \[s\], joint after
    /// joint: angles in (-pi, pi] \[rad\], rotation vectors of spherical joints, displacements \[m\].
    pub fn coordinates(&self, t: f64, motions: &[BodyMotion], out: &mut Vec<[f64; 2]>) {
        out.clear();
        for link in &self.links {
            let n = link.joint.freedom.directions().min(3);
            out.extend(&kinematics(link, t, motions).coordinates()[..n]);
        }
    }

    /// The bodies.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The links, in the order of reactions.
    pub fn links(&self) -> &[Link] {
        &self.links
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

pub(crate) fn check_link(l: &Link, bodies: usize) -> Result<(), DynamicsError> {
    for index in l.parent.into_iter().chain([l.child]) {
        if index >= bodies {
            return Err(DynamicsError::NoSuchBody {
                hinge: l.name.clone(),
                index,
                last: bodies - 1,
            });
        }
    }
    let fault = if l.parent == Some(l.child) {
        Some(("child is its own parent: body".into(), l.child as f64))
    } else {
        l.joint.fault()
    };
    if let Some((what, value)) = fault {
        return Err(DynamicsError::BadJoint {
            joint: l.name.clone(),
            what,
            value,
        });
    }
    check_finite(
        &format!("joint `{}`: anchor on the parent [m]", l.name),
        l.anchor_parent,
    )?;
    check_finite(
        &format!("joint `{}`: anchor on the child [m]", l.name),
        l.anchor_child,
    )
}

/// Every body must be reached from the ground or, if nothing hangs on the ground, from body 0.
fn check_connected(bodies: &[Body], links: &[Link]) -> Result<(), DynamicsError> {
    let grounded = links.iter().any(|l| l.parent.is_none());
    let mut reached = vec![false; bodies.len()];
    reached[0] = !grounded;
    let mut grows = true;
    while grows {
        grows = false;
        for l in links {
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
