//! Energies and momenta of the system, from the motions of its bodies alone.

use wingbeat_math::{BodyAcceleration, BodyMotion, DVec3, Wrench};

use crate::system::body::{angular_momentum, inertia_wrench, kinetic_energy, linear_momentum};
use crate::{Budget, System};

/// Mass centre of the system \[m\], N components.
pub fn mass_centre(system: &System, motions: &[BodyMotion]) -> DVec3 {
    let parts = system.bodies().iter().zip(motions);
    let moments = parts.map(|(b, m)| b.mass.mass * m.p + m.r * b.mass.first_moment);
    moments.sum::<DVec3>() / system.total_mass()
}

/// Energies, mass centre and momenta of the system.
pub fn budget(system: &System, motions: &[BodyMotion]) -> Budget {
    let mass = system.total_mass();
    let (mut kinetic, mut moment) = (0.0, DVec3::ZERO);
    let mut momentum = DVec3::ZERO;
    for (b, m) in system.bodies().iter().zip(motions) {
        kinetic += kinetic_energy(&b.mass, m);
        moment += b.mass.mass * m.p + m.r * b.mass.first_moment;
        momentum += linear_momentum(&b.mass, m);
    }
    let centre = moment / mass;
    let angular_momentum = angular_momentum_about(system, motions, centre, momentum / mass);
    Budget {
        kinetic,
        potential: -system.gravity().dot(moment),
        centre,
        momentum,
        angular_momentum,
    }
}

/// Angular momentum about the mass centre [kg m2/s], N components. Positions and velocities are
/// taken relative to the mass centre, so that nothing cancels far from the origin.
fn angular_momentum_about(
    system: &System,
    motions: &[BodyMotion],
    centre: DVec3,
    centre_velocity: DVec3,
) -> DVec3 {
    let mut sum = DVec3::ZERO;
    for (b, m) in system.bodies().iter().zip(motions) {
        let relative = BodyMotion {
            p: m.p - centre,
            v: m.v - centre_velocity,
            ..*m
        };
        sum += angular_momentum(&b.mass, &relative);
    }
    sum
}

/// Power of `loads` on bodies that move like `motions` \[W\].
pub fn load_power(loads: &[Wrench], motions: &[BodyMotion]) -> f64 {
    loads.iter().zip(motions).map(|(l, m)| l.power(m)).sum()
}

/// Kinetic energy of the motion relative to the root \[J\] and its rate \[W\]: what a flyer on a
/// fixed root would have. All of the prescribed motion's, for light wings nearly all of the
/// energy that the hinges turn over.
pub fn relative_energy(
    system: &System,
    motions: &[BodyMotion],
    accelerations: &[BodyAcceleration],
) -> [f64; 2] {
    let (root, acc) = (&motions[0], &accelerations[0]);
    let (back, w, w_dot) = (root.r.transpose(), root.w, acc.angular);
    let mut sum = [0.0; 2];
    let bodies = system.bodies().iter().zip(motions).zip(accelerations);
    for ((body, m), a) in bodies.skip(1) {
        let (p, r) = (back * (m.p - root.p), back * m.r);
        let v = back * (m.v - root.v) - w.cross(p);
        let seen = r.transpose() * w;
        let relative = BodyMotion {
            p,
            r,
            v,
            w: m.w - seen,
        };
        let turning = w_dot.cross(p) + w.cross(w.cross(p)) + 2.0 * w.cross(v);
        let rate = BodyAcceleration {
            linear: back * (a.linear - acc.linear) - turning,
            angular: a.angular - r.transpose() * w_dot + relative.w.cross(seen),
        };
        sum[0] += kinetic_energy(&body.mass, &relative);
        sum[1] += inertia_wrench(&body.mass, &relative, &rate).power(&relative);
    }
    sum
}
