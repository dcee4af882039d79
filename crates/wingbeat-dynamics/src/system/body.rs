//! A rigid body: its mass properties, momentum, weight and energy.

use wingbeat_math::{BodyAcceleration, BodyMotion, DVec3, EulerSequence, MassProperties, Wrench};

/// A rigid body.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name, for messages and results.
    pub name: String,
    /// Mass properties about the body's frame origin, body components.
    pub mass: MassProperties,
    /// Euler sequence of its three angles in the Euler form (seed: 2-3-1 body, 1-3-2 wings).
    pub sequence: EulerSequence,
}

/// Natural units of the problem: tolerances and scales are relative to them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NaturalUnits {
    /// Length \[m\], for an insect its wing length.
    pub length: f64,
    /// Time \[s\], for an insect 1/f, the period of a wingbeat.
    pub time: f64,
}

/// Rate of change of the momentum of a body: force \[N\] in N components and moment about its
/// frame origin [N m] in N components,
/// `f = m a + R (w' x s + w x (w x s))`, `n = R (J w' + w x J w + s x R^T a)`.
pub fn inertia_wrench(mass: &MassProperties, m: &BodyMotion, acc: &BodyAcceleration) -> Wrench {
    let (s, j, w) = (mass.first_moment, mass.inertia, m.w);
    let turning = acc.angular.cross(s) + w.cross(w.cross(s));
    let spin = j * acc.angular + w.cross(j * w) + s.cross(m.r.transpose() * acc.linear);
    Wrench {
        force: mass.mass * acc.linear + m.r * turning,
        moment: m.r * spin,
    }
}

/// Weight of a body and its moment about the body's frame origin (seed eq. 10, with the moment
/// for every body).
pub fn weight_wrench(body: &Body, m: &BodyMotion, gravity: DVec3) -> Wrench {
    Wrench {
        force: body.mass.mass * gravity,
        moment: (m.r * body.mass.first_moment).cross(gravity),
    }
}

/// Kinetic energy of a body \[J\]: `m v.v / 2 + v . R (w x s) + w . J w / 2` (seed eq. 13, 23).
pub fn kinetic_energy(mass: &MassProperties, m: &BodyMotion) -> f64 {
    let (s, j) = (mass.first_moment, mass.inertia);
    0.5 * mass.mass * m.v.length_squared() + m.v.dot(m.r * m.w.cross(s)) + 0.5 * m.w.dot(j * m.w)
}

/// Linear momentum of a body [kg m/s], N components: `m v + R (w x s)`.
pub fn linear_momentum(mass: &MassProperties, m: &BodyMotion) -> DVec3 {
    mass.mass * m.v + m.r * m.w.cross(mass.first_moment)
}

/// Angular momentum of a body about the origin of N [kg m2/s], N components: `p x P + R (s x R^T v + J w)`, P
/// its linear momentum.
pub fn angular_momentum(mass: &MassProperties, m: &BodyMotion) -> DVec3 {
    let spin = mass.first_moment.cross(m.r.transpose() * m.v) + mass.inertia * m.w;
    m.p.cross(linear_momentum(mass, m)) + m.r * spin
}
