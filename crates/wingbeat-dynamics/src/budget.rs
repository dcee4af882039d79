//! Energies and momenta of the system, from the motions of its bodies alone.

use wingbeat_math::DVec3;

use crate::{Body, BodyMotion, Budget, System, Wrench};

/// Kinetic energy of a body \[J\]: `m v.v / 2 + v . R (w x s) + w . J w / 2` (seed eq. 13, 23).
pub fn kinetic_energy(body: &Body, m: &BodyMotion) -> f64 {
    let (s, j) = (body.mass.first_moment, body.mass.inertia);
    0.5 * body.mass.mass * m.v.length_squared()
        + m.v.dot(m.r * m.w.cross(s))
        + 0.5 * m.w.dot(j * m.w)
}

/// Energies, mass centre and momenta of the system.
pub fn budget(system: &System, motions: &[BodyMotion]) -> Budget {
    let mass = system.total_mass();
    let (mut kinetic, mut moment) = (0.0, DVec3::ZERO);
    let mut momentum = DVec3::ZERO;
    for (b, m) in system.bodies().iter().zip(motions) {
        kinetic += kinetic_energy(b, m);
        moment += b.mass.mass * m.p + m.r * b.mass.first_moment;
        momentum += linear_momentum(b, m);
    }
    let centre = moment / mass;
    let angular_momentum = angular_momentum(system, motions, centre, momentum / mass);
    Budget {
        kinetic,
        potential: -system.gravity().dot(moment),
        centre,
        momentum,
        angular_momentum,
    }
}

/// `m v + R (w x s)` [kg m/s], N components.
fn linear_momentum(b: &Body, m: &BodyMotion) -> DVec3 {
    b.mass.mass * m.v + m.r * m.w.cross(b.mass.first_moment)
}

/// Angular momentum about the mass centre [kg m2/s], N components. Positions and velocities are
/// taken relative to the mass centre, so that nothing cancels far from the origin.
fn angular_momentum(
    system: &System,
    motions: &[BodyMotion],
    centre: DVec3,
    centre_velocity: DVec3,
) -> DVec3 {
    let mut sum = DVec3::ZERO;
    for (b, m) in system.bodies().iter().zip(motions) {
        let relative = BodyMotion {
            v: m.v - centre_velocity,
            ..*m
        };
        sum += (m.p - centre).cross(linear_momentum(b, &relative))
            + m.r
                * (b.mass.first_moment.cross(m.r.transpose() * relative.v) + b.mass.inertia * m.w);
    }
    sum
}

/// Power of `loads` on bodies that move like `motions` \[W\].
pub fn load_power(loads: &[Wrench], motions: &[BodyMotion]) -> f64 {
    loads.iter().zip(motions).map(|(l, m)| l.power(m)).sum()
}
