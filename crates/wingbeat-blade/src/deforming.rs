//! Wings that are deformed: every strip a rigid section that is moved and turned in the wing frame.
//!
//! The loads are those of the flat wing, with the velocity of the section's own point on the
//! feathering axis and the rate at which the section itself turns, `q = w2 + tau'`. Sections stay in
//! planes of axes 1 and 3; camber is left to the coefficients.

use wingbeat_math::DVec3;

use crate::settings::AddedMass;
use crate::strip::Strip;
use crate::wing::{BladeWing, FrameAcceleration, FrameMotion, Load};
use std::f64::consts::PI;

/// How a section lies and moves in the wing frame, wing components.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionMotion {
    /// The point that is on the feathering axis of the flat wing: place [m], velocity [m/s],
    /// acceleration [m/s2].
    pub axis: [DVec3; 3],
    /// Turn about axis 2 with its first two time derivatives [rad].
    pub twist: [f64; 3],
}

impl SectionMotion {
    /// Directions of chord (forward) and normal.
    fn axes(&self) -> [DVec3; 2] {
        let (sin, cos) = self.twist[0].sin_cos();
        [DVec3::new(cos, 0.0, -sin), DVec3::new(sin, 0.0, cos)]
    }

    /// Place, velocity, acceleration of the point `x` ahead of the axis.
    fn point(&self, x: f64) -> [DVec3; 3] {
        let ([e1, e3], [p, p1, p2], [_, t1, t2]) = (self.axes(), self.axis, self.twist);
        [
            p + x * e1,
            p1 - x * t1 * e3,
            p2 - x * (t2 * e3 + t1 * t1 * e1),
        ]
    }
}

/// Loads on a wing, and what deforming it takes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DeformingLoad {
    /// Force and moment about the hinge.
    pub load: Load,
    /// Power needed to deform the wing against this load [W].
    pub power: f64,
}

impl DeformingLoad {
    /// Adds `force` at the axis of a section and the moment `about_2` there, wing components.
    fn add(&mut self, section: &SectionMotion, force: DVec3, about_2: f64) {
        let [p, p1, _] = section.axis;
        self.load.force += force;
        self.load.moment += DVec3::new(0.0, about_2, 0.0) + p.cross(force);
        self.power -= force.dot(p1) + about_2 * section.twist[1];
    }
}

/// Velocity of the air relative to a point and the rate of its components in the turning frame.
struct Through {
    hinge: DVec3,
    hinge_rate: DVec3,
    w: DVec3,
    turn: DVec3,
}

impl BladeWing {
    /// As [`BladeWing::velocity_load`], strip `k` lying and moving like `section(k)`.
    pub fn deforming_velocity_load(
        &self,
        motion: &FrameMotion,
        section: impl Fn(usize) -> SectionMotion,
        wind: impl Fn(DVec3) -> DVec3,
    ) -> DeformingLoad {
        let v = self.velocity_through_air(motion);
        let mut sum = DeformingLoad::default();
        for (k, strip) in self.strips().iter().enumerate() {
            let s = section(k);
            let ([e1, e3], [p, p1, _]) = (s.axes(), s.axis);
            let v = v - wind(p);
            let here = v + motion.rate.cross(p) + p1;
            let here = DVec3::new(here.dot(e1), 0.0, here.dot(e3));
            let rate = DVec3::new(0.0, motion.rate.y + s.twist[1], 0.0);
            let mut own = Load::default();
            self.add_strip(&Strip { y: 0.0, ..*strip }, here, rate, &mut own);
            let force = own.force.x * e1 + own.force.z * e3;
            sum.add(&s, force, own.moment.y);
            if self.settings().added_mass == AddedMass::Section {
                self.add_chordwise(strip, &s, motion, v, &mut sum);
            }
        }
        sum
    }

    /// As [`BladeWing::acceleration_load`], strip `k` lying and moving like `section(k)`; its own
    /// accelerations are included.
    pub fn deforming_acceleration_load(
        &self,
        motion: &FrameMotion,
        acc: &FrameAcceleration,
        section: impl Fn(usize) -> SectionMotion,
        wind: impl Fn(DVec3) -> DVec3,
    ) -> DeformingLoad {
        let mut sum = DeformingLoad::default();
        if self.settings().added_mass == AddedMass::None {
            return sum;
        }
        let hinge = self.velocity_through_air(motion);
        let linear = motion.rotation.transpose() * acc.linear;
        for (k, strip) in self.strips().iter().enumerate() {
            let s = section(k);
            let ([e1, n], x) = (s.axes(), strip.x_mid());
            let [p, p1, p2] = s.point(x);
            let hinge = hinge - wind(p);
            let through = Through {
                hinge,
                hinge_rate: linear - motion.rate.cross(hinge),
                w: motion.rate,
                turn: acc.angular,
            };
            let v = through.hinge + through.w.cross(p) + p1;
            let v_rate = through.hinge_rate + through.turn.cross(p) + through.w.cross(p1) + p2;
            // Rate of v . n; the normal turns by tau' towards the leading edge.
            let rate = v_rate.dot(n) + s.twist[1] * v.dot(e1);
            let force = -self.strip_mass(strip) * rate;
            let inertia = match self.settings().added_mass {
                AddedMass::Section => {
                    PI / 128.0 * self.settings().density * strip.chord.powi(4) * strip.width
                }
                _ => 0.0,
            };
            let turn = through.turn.y + s.twist[2];
            sum.add(&s, force * n, -x * force - inertia * turn);
        }
        sum
    }

    /// Force `-m q w` along the chord at mid chord.
    fn add_chordwise(
        &self,
        strip: &Strip,
        s: &SectionMotion,
        motion: &FrameMotion,
        v: DVec3,
        sum: &mut DeformingLoad,
    ) {
        let ([e1, n], [p, p1, _]) = (s.axes(), s.point(strip.x_mid()));
        let normal = (v + motion.rate.cross(p) + p1).dot(n);
        let q = motion.rate.y + s.twist[1];
        sum.add(s, -self.strip_mass(strip) * q * normal * e1, 0.0);
    }

    /// Added mass of a strip [kg].
    fn strip_mass(&self, s: &Strip) -> f64 {
        0.25 * PI * self.settings().density * s.chord * s.chord * s.width
    }
}
