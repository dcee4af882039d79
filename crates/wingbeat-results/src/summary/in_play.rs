//! What residuals of the energy are measured by: what takes part in the flight and is exchanged in it.
//!
//! Everything counts in the inertial frame C in which the flyer rests at the start: that of its mass centre, of one on
//! a tether or held first that of its body. With u the velocity of C, P the momentum, M the mass and J the impulse of
//! all external forces, integrated as the works W are,
//!
//! ```text
//! E_C = E - u . P + M u^2 / 2,   W_C = W - u . J,   R_C = R - u . R_P,   R_P = P - P_0 - J
//! ```
//!
//! are kinetic energy, work and residual of the energy there. So a flyer that is towed through still air has
//! the verdict of one that is held in a stream. While a support has the body, the residual counts in the body's
//! own frame: less the power of what is missing in force and moment of the support, `v . dR_P + w . dR_L` with
//! the residual R_L of the angular momentum. The body moves as it is made to whatever its mass: only what moves
//! beside it counts, neither its weight nor what a tether does against that. Works of tether and air count each
//! by itself: where a tether drives wings through the air, their sum is nothing. What a hold did to the body by
//! the time of its release counts no more afterwards.

use serde::{Deserialize, Serialize};
use wingbeat_dynamics::{inertia_wrench, kinetic_energy};
use wingbeat_flight::{FlightSetup, MotionMode, Record, natural_units};
use wingbeat_math::{DVec3, larger};

use super::extent::Extent;
use super::momentum_balance::{ROUNDING, body_motion, moving, ratio, velocity};

/// Part of the weight times the length of the flyer that counts as turned over in free flight, though nothing moves but by
/// rounding \[1\].
const STILL: f64 = 1e-12;

/// Where a flight begins: velocity of C \[m/s\] and momentum, with what it jumps by at a release [kg m/s], N components,
/// time \[s\].
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Start {
    velocity: DVec3,
    momentum: DVec3,
    time: f64,
}

/// The frame in which residuals count at a step, as it moves past the origin of N, and the residuals there: velocity
/// \[m/s\], angular velocity [rad/s], momentum [kg m/s], angular momentum [kg m2/s], N components.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Carrier {
    is_supported: bool,
    velocity: DVec3,
    angular_velocity: DVec3,
    momentum: DVec3,
    angular_momentum: DVec3,
}

/// What a tether, or the hold before a release, has done in C beside speeding the body up and lifting it: time
/// \[s\], power \[W\] and work \[J\] up to the last step, the energy of the body at the start, and what it has
/// gained up to the last step or the release \[J\].
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Tether {
    time: f64,
    power: f64,
    work: f64,
    body: f64,
    gained: f64,
}

/// Gathered step by step; energies and works \[J\] in C.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct InPlay {
    start: Option<Start>,
    kinetic: Extent,
    /// On a tether without that of the body.
    potential: Extent,
    /// Kinetic energy beside that of the mass centre, while a support has the body that of what moves beside
    /// it, and strain energy of elastic wings.
    inner: Extent,
    works: Extent,
    tether: Option<Tether>,
    residual: Extent,
    /// Kinetic and potential energy in N.
    carried: Extent,
    /// Last carrier, and the part of the residual in N that is due to its motion.
    carrier: Option<Carrier>,
    due: f64,
}

impl InPlay {
    /// Takes the next step.
    pub fn take(&mut self, r: &Record, setup: &FlightSetup) {
        let is_supported = setup.mode.is_supported_at(r.step);
        let is_released = !is_supported && self.carrier.is_some_and(|c| c.is_supported);
        let start = self.start.get_or_insert_with(|| Start {
            velocity: velocity(r, setup),
            momentum: r.momentum,
            time: r.time,
        });
        if is_released {
            start.momentum += jump(r, setup);
        }
        let start = *start;
        let u = start.velocity;
        let mass = setup.animal.mass();
        let weight = mass * setup.gravity * (r.time - start.time);
        self.kinetic.take(moving(r, setup, u).0);
        let potential = r.potential_energy + u.dot(weight);
        let body = match setup.mode {
            MotionMode::Tethered(_) => self.body_potential(r, setup),
            MotionMode::Free(_) => 0.0,
        };
        self.potential.take(potential - body);
        self.inner.take(match is_supported {
            true => moving(r, setup, u).0 + strain_energy(r),
            false => inner_energy(r, mass),
        });
        // Of air, loads and tether together: what they do to a frame is known of their sum.
        let external = r.momentum - start.momentum - r.momentum_residual_of_works - weight;
        let external = r.air_work + r.applied_work - u.dot(external);
        self.works.take(r.hinge_work);
        self.works.take(r.deformation_work);
        match (is_supported, self.tether) {
            (true, _) => self.take_tether(r, setup, external),
            (false, None) => self.works.take(external),
            (false, Some(held)) => {
                let gained = match is_released {
                    true => self.body_energy(r, setup) - held.body,
                    false => held.gained,
                };
                self.tether = Some(Tether { gained, ..held });
                self.works.take(external - gained);
            }
        }
        self.carry(carrier(r, setup, u));
        self.residual.take(r.energy_residual - self.due);
        self.carried
            .take(larger(r.kinetic_energy, r.potential_energy.abs()));
    }

    /// A tether that drives wings through the air does as much work as the air takes, and both together none:
    /// each counts, and both together, without what the body takes up by itself, weight and all.
    /// `external`: work of both and of loads in C \[J\].
    fn take_tether(&mut self, r: &Record, setup: &FlightSetup, external: f64) {
        let u = self.start.map_or(DVec3::ZERO, |start| start.velocity);
        let (body, mut motion) = (&setup.animal.body, body_motion(r));
        motion.v -= u;
        let mut tether = r.tether;
        tether.force += body.mass * setup.gravity;
        tether.moment += (motion.r * body.first_moment).cross(setup.gravity);
        if let Some(rates) = r.accelerations.first() {
            let inertia = inertia_wrench(body, &motion, rates);
            tether.force -= inertia.force;
            tether.moment -= inertia.moment;
        }
        let power = tether.power(&motion);
        let energy = self.body_energy(r, setup);
        let before = self.tether.unwrap_or(Tether {
            time: r.time,
            power,
            work: 0.0,
            body: energy,
            gained: 0.0,
        });
        let work = before.work + 0.5 * (before.power + power) * (r.time - before.time);
        let gained = energy - before.body;
        self.tether = Some(Tether {
            time: r.time,
            power,
            work,
            gained,
            ..before
        });
        let beside = external - gained;
        for work in [work, beside - work, beside] {
            self.works.take(work);
        }
    }

    /// Kinetic and potential energy of the body in C \[J\].
    fn body_energy(&self, r: &Record, setup: &FlightSetup) -> f64 {
        let mut motion = body_motion(r);
        motion.v -= self.start.map_or(DVec3::ZERO, |start| start.velocity);
        kinetic_energy(&setup.animal.body, &motion) + self.body_potential(r, setup)
    }

    /// Potential energy of the body in C, as a frame that moves past the origin of N \[J\].
    fn body_potential(&self, r: &Record, setup: &FlightSetup) -> f64 {
        let (body, motion) = (&setup.animal.body, body_motion(r));
        let carried = self
            .start
            .map_or(DVec3::ZERO, |start| start.velocity * (r.time - start.time));
        let moment = body.mass * (motion.p - carried) + motion.r * body.first_moment;
        -setup.gravity.dot(moment)
    }

    /// Counts what the motion of the frame has to do with the residual in N from the last step to this one.
    fn carry(&mut self, now: Carrier) {
        let zero = Carrier {
            momentum: DVec3::ZERO,
            angular_momentum: DVec3::ZERO,
            ..now
        };
        let before = self.carrier.unwrap_or(zero);
        // The step that ends a hold is one of the hold, whatever the velocity of the release.
        let end = match before.is_supported && !now.is_supported {
            true => before,
            false => now,
        };
        let mean = |a: DVec3, b: DVec3| 0.5 * (a + b);
        self.due += mean(before.velocity, end.velocity).dot(now.momentum - before.momentum)
            + mean(before.angular_velocity, end.angular_velocity)
                .dot(now.angular_momentum - before.angular_momentum);
        self.carrier = Some(now);
    }

    /// Largest residual of the energy over the energy turned over \[1\]: of tethered flyers kinetic energy,
    /// change of potential energy and works. Those that fly freely gain or lose energy of their own, however much a
    /// fall has: there works count, and what the parts turn over among themselves.
    pub fn energy_residual(&self, setup: &FlightSetup) -> f64 {
        let scale = match setup.mode {
            MotionMode::Free(_) => {
                let weight = setup.animal.mass() * setup.gravity.length();
                let still = STILL * weight * natural_units(setup).length;
                self.largest([larger(self.works.most, still), self.inner.most])
            }
            MotionMode::Tethered(_) => self.energy_scale(),
        };
        ratio(self.residual.most, scale)
    }

    /// The largest of the energies and works in play \[J\].
    pub fn energy_scale(&self) -> f64 {
        let exchanged = larger(self.potential.range(), self.works.most);
        self.largest([self.kinetic.most, exchanged])
    }

    fn largest(&self, energies: [f64; 2]) -> f64 {
        let floor = ROUNDING * self.carried.most;
        energies.into_iter().fold(floor, larger)
    }
}

/// Momentum that a release with an angular velocity of its own adds, N components [kg m/s]: all bodies turn with the root
/// from then on. No force makes it, and balances leave it out.
fn jump(r: &Record, setup: &FlightSetup) -> DVec3 {
    let MotionMode::Free(start) = &setup.mode else {
        return DVec3::ZERO;
    };
    let root = body_motion(r);
    let turn = root.r * start.angular_velocity;
    setup.animal.mass() * turn.cross(r.mass_centre - root.p)
}

/// The frame in which residuals count: C of velocity `u` [m/s], N components, and that of a body on a support.
fn carrier(r: &Record, setup: &FlightSetup, u: DVec3) -> Carrier {
    let is_supported = setup.mode.is_supported_at(r.step);
    let body = body_motion(r);
    let (velocity, angular_velocity) = match is_supported {
        true => {
            let w = body.r * body.w;
            (body.v - w.cross(body.p), w)
        }
        false => (u, DVec3::ZERO),
    };
    Carrier {
        is_supported,
        velocity,
        angular_velocity,
        momentum: r.momentum_residual_of_works,
        angular_momentum: r.angular_momentum_residual,
    }
}

/// Energy that the parts of a flyer turn over among themselves \[J\].
fn inner_energy(r: &Record, mass: f64) -> f64 {
    r.kinetic_energy - r.momentum.length_squared() / (2.0 * mass) + strain_energy(r)
}

/// Elastic energy of all wings \[J\].
fn strain_energy(r: &Record) -> f64 {
    r.elastic.iter().map(|w| w.strain_energy).sum()
}
