//! Bodies and what joins them.

use wingbeat_math::DVec3;

use super::link::kinematics;
use crate::body::{Body, NaturalUnits};
use crate::check::{check_finite, check_positive};
use crate::error::DynamicsError;
use crate::link::{Link, check_link};
use crate::motion::BodyMotion;
use crate::slot::start;
use crate::system::System;

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
        let links = system.hinges().iter().chain(system.loops());
        Self {
            bodies: system.bodies().to_vec(),
            links: links.cloned().collect(),
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
        for (joint, slot) in system.joints().zip(system.slots()) {
            let (own, others) = rest.split_at(slot.speeds);
            let [x, v] = [0, 1].map(|k| own.iter().map(|c| c[k]).collect::<Vec<f64>>());
            start(&joint.clone().starting(&x, &v), slot, &mut q, &mut u);
            rest = others;
        }
        (q, u)
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
