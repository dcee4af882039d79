//! Forces and couples on bodies beside those of joints and air: loads fixed in a body or in space,
//! Fourier-modulated, and springs between points of two bodies.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wingbeat_dynamics::{BodyMotion, Wrench};
use wingbeat_math::{DVec3, DriftingFourier};

/// Frame in which an applied load keeps its direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoadFrame {
    /// Fixed in the body.
    Body,
    /// Fixed in the inertial frame N.
    Inertial,
}

/// A spring and a damper along the line between two points of two bodies:
/// tension = stiffness (length - rest length) + damping x rate of the length.
#[derive(Clone, Debug, PartialEq)]
pub struct PointSpring {
    /// Name, unique in the flight.
    pub name: String,
    /// Indices of the bodies: 0 the root, then wings and segments in their order.
    pub bodies: [usize; 2],
    /// Its ends, each in the axes of its body from the body's origin \[m\].
    pub points: [DVec3; 2],
    /// Stiffness \[N/m\].
    pub stiffness: f64,
    /// Length without tension \[m\].
    pub rest: f64,
    /// Damping \[N s/m\].
    pub damping: f64,
}

/// A force and a couple on one body.
#[derive(Clone, Debug, PartialEq)]
pub struct AppliedLoad {
    /// Index of the body: 0 the root, then the wings in their order.
    pub body: usize,
    /// Frame that carries the directions of force and couple.
    pub frame: LoadFrame,
    /// Point of application, body components [m].
    pub point: DVec3,
    /// Force components [N] as functions of time.
    pub force: [DriftingFourier; 3],
    /// Couple components [N m] as functions of time.
    pub couple: [DriftingFourier; 3],
}

impl AppliedLoad {
    /// A constant force \[N\], inertial axes, at a point of a body \[m\], axes of the body.
    pub fn constant(body: usize, point: DVec3, force: DVec3) -> Self {
        Self {
            body,
            frame: LoadFrame::Inertial,
            point,
            force: force.to_array().map(DriftingFourier::constant),
            couple: [0.0; 3].map(DriftingFourier::constant),
        }
    }

    /// Whether it is a constant force along `gravity` \[m/s2\] or against it, as a weight is, and nothing besides.
    pub fn is_weight(&self, gravity: DVec3) -> bool {
        let is_constant =
            |f: &DriftingFourier| f.rate == 0.0 && f.cosine.is_empty() && f.sine.is_empty();
        let force = vector(&self.force, 0.0);
        let along = gravity.normalize_or_zero();
        self.frame == LoadFrame::Inertial
            && self.force.iter().chain(&self.couple).all(is_constant)
            && vector(&self.couple, 0.0) == DVec3::ZERO
            && force.cross(along).length() <= ROUNDING * force.length()
            && force != DVec3::ZERO
            && gravity != DVec3::ZERO
    }

    /// The wrench of this load at time `t` [s] about the origin of its body, N components.
    pub fn wrench(&self, t: f64, body: &BodyMotion) -> Wrench {
        let to_n = |v: DVec3| match self.frame {
            LoadFrame::Body => body.r * v,
            LoadFrame::Inertial => v,
        };
        let force = to_n(vector(&self.force, t));
        let arm = body.r * self.point;
        Wrench {
            force,
            moment: to_n(vector(&self.couple, t)) + arm.cross(force),
        }
    }
}

/// Rounding of places on bodies, over their distance from the origins of these.
const ROUNDING: f64 = 1e-12;

impl PointSpring {
    /// The wrenches on its two bodies, moving so, about their origins, N components: equal and opposite
    /// forces. Nothing where its ends meet, to the rounding of their places, for it has no direction there.
    pub fn wrenches(&self, motions: [&BodyMotion; 2]) -> [Wrench; 2] {
        let arms = [0, 1].map(|k| motions[k].r * self.points[k]);
        let velocity = |k: usize| motions[k].point_velocity(self.points[k]);
        let apart = motions[1].p + arms[1] - (motions[0].p + arms[0]);
        let length = apart.length();
        let reach = arms.iter().map(|a| a.length()).fold(self.rest, f64::max);
        let tension = match length > ROUNDING * reach {
            true => {
                let rate = apart.dot(velocity(1) - velocity(0)) / length;
                self.stiffness * (length - self.rest) + self.damping * rate
            }
            false => 0.0,
        };
        let force = tension * apart.normalize_or_zero();
        let on = |arm: DVec3, force: DVec3| Wrench {
            force,
            moment: arm.cross(force),
        };
        [on(arms[0], force), on(arms[1], -force)]
    }
}

/// Values of three series at `t`.
fn vector(x: &[DriftingFourier; 3], t: f64) -> DVec3 {
    DVec3::new(x[0].at(t)[0], x[1].at(t)[0], x[2].at(t)[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat_math::DMat3;

    /// Where a body is a time `dt` later.
    fn later(m: &BodyMotion, dt: f64) -> BodyMotion {
        let turn = DMat3::from_axis_angle(m.w.normalize(), m.w.length() * dt);
        BodyMotion {
            p: m.p + dt * m.v,
            r: m.r * turn,
            ..*m
        }
    }

    /// Where the ends of a spring meet to the rounding of their places it has no direction, and no force.
    #[test]
    fn exact_no_force_of_a_spring_whose_ends_meet() {
        let at = |x: f64| BodyMotion {
            p: DVec3::new(x, 0.1, -0.3),
            ..BodyMotion::REST
        };
        let spring = PointSpring {
            name: "tendon".to_owned(),
            bodies: [0, 1],
            points: [DVec3::ZERO, DVec3::new(0.0, 0.0, -0.1)],
            stiffness: 3.0,
            rest: 0.1,
            damping: 0.0,
        };
        let force = |x: f64| {
            let second = BodyMotion {
                p: DVec3::new(x, 0.1, -0.2),
                ..BodyMotion::REST
            };
            spring.wrenches([&at(0.0), &second])[0].force
        };
        assert_eq!(force(1e-17), DVec3::ZERO);
        assert!((force(1e-6).x + 0.3).abs() < 1e-5, "{}", force(1e-6));
    }

    /// A spring between points off the origins of two bodies that move and turn: its wrenches have
    /// neither a sum nor a moment, and their power is what its energy loses and its damper takes.
    #[test]
    fn conserves_momentum_and_energy_of_a_spring_between_points() {
        let motion = |x: f64| BodyMotion {
            p: DVec3::new(0.3 * x, -0.2, 0.7 - x),
            r: DMat3::from_axis_angle(DVec3::new(1.0, x, -0.4).normalize(), 0.8 + x),
            v: DVec3::new(0.5, x, -0.3),
            w: DVec3::new(-0.7, 1.1 * x, 0.9),
        };
        let bodies = [motion(1.0), motion(-0.6)];
        let spring = PointSpring {
            name: "tendon".to_owned(),
            bodies: [0, 1],
            points: [DVec3::new(0.1, 0.4, -0.2), DVec3::new(-0.3, 0.2, 0.5)],
            stiffness: 3.0,
            rest: 0.4,
            damping: 0.7,
        };
        let wrenches = spring.wrenches([&bodies[0], &bodies[1]]);
        let force: DVec3 = wrenches.iter().map(|w| w.force).sum();
        let about = |(w, m): (&Wrench, &BodyMotion)| w.moment + m.p.cross(w.force);
        let moment: DVec3 = wrenches.iter().zip(&bodies).map(about).sum();
        assert!(wrenches[0].force.length() > 0.1);
        assert!(force.length() < 1e-15 && moment.length() < 1e-15);
        let length = |dt: f64| {
            let end = |k: usize| {
                let m = later(&bodies[k], dt);
                m.p + m.r * spring.points[k]
            };
            end(0).distance(end(1))
        };
        let energy = |dt: f64| 0.5 * spring.stiffness * (length(dt) - spring.rest).powi(2);
        let rate = |f: &dyn Fn(f64) -> f64| (f(1e-5) - f(-1e-5)) / 2e-5;
        let lost = -rate(&energy) - spring.damping * rate(&length).powi(2);
        let power = |(w, m): (&Wrench, &BodyMotion)| w.power(m);
        let power: f64 = wrenches.iter().zip(&bodies).map(power).sum();
        // Central differences: the square of the step, and roundings over it.
        assert!(
            power.abs() > 0.1 && (power - lost).abs() < 1e-9,
            "{power} {lost}"
        );
    }
}
