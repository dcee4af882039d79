//! Motion of a body and loads on it: what dynamics, blade elements and analysis hand each other.

use glam::{DMat3, DVec3};

use crate::bodies::mirror::{mirrored, mirrored_axial, reflected};

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyMotion {
    /// Position of the frame origin \[m\], N components.
    pub p: DVec3,
    /// Rotation R_NB: body components to N components.
    pub r: DMat3,
    /// Velocity of the frame origin [m/s], N components.
    pub v: DVec3,
    /// Angular velocity relative to N [rad/s], body components.
    pub w: DVec3,
}

impl BodyMotion {
    /// At rest at the origin, unrotated.
    pub const REST: Self = Self {
        p: DVec3::ZERO,
        r: DMat3::IDENTITY,
        v: DVec3::ZERO,
        w: DVec3::ZERO,
    };

    /// Position \[m\], rotation R_NB row by row, velocity [m/s], angular velocity [rad/s], in components as the
    /// fields.
    ///
    /// ```
    /// use wingbeat_math::{BodyMotion, DVec3, r3};
    /// let m = BodyMotion { p: DVec3::X, r: r3(std::f64::consts::FRAC_PI_2), w: DVec3::Z, ..BodyMotion::REST };
    /// let numbers = m.numbers();
    /// assert_eq!((numbers[0], numbers[4], numbers[17]), (1.0, -1.0, 1.0)); // b2 points against n1
    /// ```
    pub fn numbers(&self) -> [f64; 18] {
        let mut all = [0.0; 18];
        self.p.write_to_slice(&mut all);
        self.r.transpose().write_cols_to_slice(&mut all[3..]);
        self.v.write_to_slice(&mut all[12..]);
        self.w.write_to_slice(&mut all[15..]);
        all
    }

    /// Position in N \[m\] of the point `r` \[m\] of the body frame (seed eq. 3).
    ///
    /// ```
    /// use wingbeat_math::{BodyMotion, DVec3, r3};
    /// let m = BodyMotion { p: DVec3::X, r: r3(std::f64::consts::FRAC_PI_2), ..BodyMotion::REST };
    /// assert!((m.point(DVec3::X) - DVec3::new(1.0, 1.0, 0.0)).length() < 1e-15);
    /// ```
    pub fn point(&self, r: DVec3) -> DVec3 {
        self.p + self.r * r
    }

    /// Velocity in N [m/s] of the point `r` \[m\] fixed to the body (seed eq. 14).
    pub fn point_velocity(&self, r: DVec3) -> DVec3 {
        self.v + self.r * self.w.cross(r)
    }
}

/// Accelerations of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyAcceleration {
    /// Acceleration of the frame origin [m/s2], N components.
    pub linear: DVec3,
    /// Angular acceleration [rad/s2], body components (time derivative of the components of w,
    /// which equals the derivative of the vector).
    pub angular: DVec3,
}

/// Force and moment: the external load on a body without gravity, N components, about the origin of its frame,
/// where a function does not name others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// Force \[N\].
    pub force: DVec3,
    /// Moment [N m], same components.
    pub moment: DVec3,
}

impl Wrench {
    /// A force \[N\] at a point that lies `arm` \[m\] from the body's frame origin (both N components).
    pub fn at(force: DVec3, arm: DVec3) -> Self {
        Self {
            force,
            moment: arm.cross(force),
        }
    }

    /// The same wrench in the components to which `r` leads.
    #[must_use]
    pub fn turned(&self, r: DMat3) -> Self {
        Self {
            force: r * self.force,
            moment: r * self.moment,
        }
    }

    /// Its mirror image in the plane across `normal`, a unit vector in the same components \[1\]: the moment is an
    /// axial vector.
    #[must_use]
    pub fn reflected(&self, normal: DVec3) -> Self {
        Self {
            force: reflected(self.force, normal),
            moment: -reflected(self.moment, normal),
        }
    }

    /// Its mirror image in the 1-3 plane of its components.
    ///
    /// ```
    /// use wingbeat_math::{DVec3, Wrench};
    /// let load = Wrench::at(DVec3::new(1.0, 2.0, 3.0), DVec3::new(-4.0, 5.0, 6.0));
    /// assert_eq!(load.mirrored(), load.reflected(DVec3::Y));
    /// ```
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self {
            force: mirrored(self.force),
            moment: mirrored_axial(self.moment),
        }
    }

    /// Power on a body that moves like `motion` \[W\].
    pub fn power(&self, motion: &BodyMotion) -> f64 {
        self.force.dot(motion.v) + self.moment.dot(motion.r * motion.w)
    }
}

impl std::ops::AddAssign for Wrench {
    fn add_assign(&mut self, o: Self) {
        self.force += o.force;
        self.moment += o.moment;
    }
}

impl std::ops::Add for Wrench {
    type Output = Self;

    fn add(mut self, o: Self) -> Self {
        self += o;
        self
    }
}

impl std::ops::Sub for Wrench {
    type Output = Self;

    fn sub(self, o: Self) -> Self {
        Self {
            force: self.force - o.force,
            moment: self.moment - o.moment,
        }
    }
}
