//! The bodies as seen from the root: a function of time alone, because every hinge is prescribed.

use wingbeat_math::{DMat3, DVec3, MovingRotation, tilde};

use crate::system::check_rotation;
use crate::{BodyAcceleration, BodyMotion, DynamicsError, System};

/// Placement of a body's frame relative to the root's frame, with two time derivatives as seen
/// from the root.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// Rotation A: body components to root components.
    pub rotation: MovingRotation,
    /// Position d of the body's origin \[m\], root components.
    pub d: DVec3,
    /// First derivative of `d` [m/s].
    pub d_dot: DVec3,
    /// Second derivative of `d` [m/s2].
    pub d_ddot: DVec3,
}

impl Placement {
    /// The root itself.
    const ROOT: Self = Self {
        rotation: MovingRotation {
            c: DMat3::IDENTITY,
            c_dot: DMat3::ZERO,
            c_ddot: DMat3::ZERO,
        },
        d: DVec3::ZERO,
        d_dot: DVec3::ZERO,
        d_ddot: DVec3::ZERO,
    };

    /// The child of a body placed like `self`, hung at `anchor_parent` by its `anchor_child` and
    /// turned by `law`.
    fn child(&self, law: &MovingRotation, anchor_parent: DVec3, anchor_child: DVec3) -> Self {
        let (a, b) = (&self.rotation, self.rotation.then(law));
        Self {
            rotation: b,
            d: self.d + a.c * anchor_parent - b.c * anchor_child,
            d_dot: self.d_dot + a.c_dot * anchor_parent - b.c_dot * anchor_child,
            d_ddot: self.d_ddot + a.c_ddot * anchor_parent - b.c_ddot * anchor_child,
        }
    }
}

/// Mass properties of the whole system and the momentum of its parts relative to the root.
#[derive(Clone, Copy, Debug)]
pub struct Composite {
    /// Total mass m \[kg\].
    pub mass: f64,
    /// Mass centre c \[m\], root components.
    pub c: DVec3,
    /// Velocity of the mass centre as seen from the root [m/s].
    pub c_dot: DVec3,
    /// Inertia about the mass centre [kg m2], root components.
    pub inertia: DMat3,
    /// Angular momentum about the mass centre of the motion seen from the root [kg m2/s].
    pub h: DVec3,
}

/// Placements of all bodies at one time.
#[derive(Clone, Debug)]
pub struct Posture {
    placements: Vec<Placement>,
}

impl Posture {
    /// Room for the placements of `system`.
    pub fn new(system: &System) -> Self {
        Self {
            placements: vec![Placement::ROOT; system.bodies().len()],
        }
    }

    /// Evaluates the hinge laws at time `t` \[s\].
    pub fn update(&mut self, system: &System, t: f64) {
        for &k in system.outward() {
            let h = &system.hinges()[k];
            let parent = self.placements[h.parent];
            self.placements[h.child] = parent.child(&h.law.at(t), h.anchor_parent, h.anchor_child);
        }
    }

    /// Placement of every body.
    pub fn placements(&self) -> &[Placement] {
        &self.placements
    }

    /// Motion of every body when the root moves like `root`.
    pub fn motions(&self, root: &BodyMotion, out: &mut [BodyMotion]) {
        for (m, at) in out.iter_mut().zip(&self.placements) {
            let a = &at.rotation;
            *m = BodyMotion {
                p: root.p + root.r * at.d,
                r: root.r * a.c,
                v: root.v + root.r * (root.w.cross(at.d) + at.d_dot),
                w: a.c.transpose() * root.w + a.angular_velocity(),
            };
        }
    }

    /// Accelerations of every body when the root moves like `root` and accelerates like `acc`
    /// (transport, Coriolis and relative part).
    pub fn accelerations(
        &self,
        root: &BodyMotion,
        acc: &BodyAcceleration,
        out: &mut [BodyAcceleration],
    ) {
        let w = root.w;
        for (o, at) in out.iter_mut().zip(&self.placements) {
            let a = &at.rotation;
            let seen = a.c.transpose() * w;
            *o = BodyAcceleration {
                linear: acc.linear
                    + root.r
                        * (acc.angular.cross(at.d)
                            + w.cross(w.cross(at.d))
                            + 2.0 * w.cross(at.d_dot)
                            + at.d_ddot),
                angular: a.c.transpose() * acc.angular - a.angular_velocity().cross(seen)
                    + a.angular_acceleration(),
            };
        }
    }

    /// Mass properties of the whole and momentum relative to the root.
    pub fn composite(&self, system: &System) -> Composite {
        let (mut mass, mut s, mut s_dot) = (0.0, DVec3::ZERO, DVec3::ZERO);
        let (mut inertia, mut h) = (DMat3::ZERO, DVec3::ZERO);
        for (b, at) in system.bodies().iter().zip(&self.placements) {
            let (a, w) = (at.rotation.c, at.rotation.angular_velocity());
            let moved = b.mass.moved(a, at.d);
            let spun = a * w.cross(b.mass.first_moment);
            mass += b.mass.mass;
            s += moved.first_moment;
            s_dot += b.mass.mass * at.d_dot + spun;
            inertia += moved.inertia;
            h += moved.first_moment.cross(at.d_dot) + at.d.cross(spun) + a * (b.mass.inertia * w);
        }
        let (c, c_dot) = (s / mass, s_dot / mass);
        let tc = tilde(c);
        Composite {
            mass,
            c,
            c_dot,
            inertia: inertia + tc * tc * mass,
            h: h - mass * c.cross(c_dot),
        }
    }

    /// Checks that every hinge law gives a rotation at time `t`.
    ///
    /// # Errors
    /// [`DynamicsError::NotARotation`] names the first hinge that does not.
    pub fn check(system: &System, t: f64) -> Result<(), DynamicsError> {
        system.hinges().iter().try_for_each(|h| {
            check_rotation(h.law.at(t).c, t, || {
                format!("the law of hinge `{}`", h.name)
            })
        })
    }
}
