//! What residuals of momentum are measured by: what takes part in the flight and is exchanged in it.
//!
//! While a support has the body (a tether, or the hold before a release), the body moves as it is made to whatever its
//! mass, and only what moves beside it counts; in free flight everything does. A flyer that is held first has one
//! balance of each.

use serde::{Deserialize, Serialize};
use wingbeat_dynamics::{BodyMotion, kinetic_energy, linear_momentum};
use wingbeat_flight::{FlightSetup, Record};
use wingbeat_math::{DVec3, larger};

use super::extent::Extent;

/// Part of the energies and momenta in N, carried motion and all, that always counts: far above their round-off.
pub(super) const ROUNDING: f64 = 1e-8;

/// Kinetic energy \[J\] and momentum [kg m/s] of something in a frame of given velocity, N components.
pub(super) type Share = (f64, DVec3);

/// Where a part of a flight begins: velocity of its frame \[m/s\], residual of the momentum [kg m/s] and impulse of the
/// air [N s], N components, time \[s\].
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Start {
    velocity: DVec3,
    residual: DVec3,
    air: DVec3,
    time: f64,
}

/// Gathered step by step, in the inertial frame in which the flyer rests where the part begins; energies \[J\], momenta
/// [kg m/s].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Part {
    start: Option<Start>,
    kinetic: Extent,
    momentum: Extent,
    residual: Extent,
    /// Momentum in N.
    carried: Extent,
    /// Impulse of the air up to the last step, N components, and the length of its way [N s].
    air: DVec3,
    air_way: f64,
    /// Time since the start \[s\].
    time: f64,
}

impl Part {
    /// Takes the next step of the part.
    fn take(&mut self, r: &Record, setup: &FlightSetup) {
        let start = *self.start.get_or_insert_with(|| Start {
            velocity: velocity(r, setup),
            residual: r.momentum_residual,
            air: r.air_impulse,
            time: r.time,
        });
        let (kinetic, momentum) = moving(r, setup, start.velocity);
        self.kinetic.take(kinetic);
        self.momentum.take(momentum.length());
        self.carried.take(r.momentum.length());
        let air = r.air_impulse - start.air;
        self.air_way += (air - self.air).length();
        self.air = air;
        self.time = r.time - start.time;
        self.take_residual(r);
    }

    /// Takes the residual of the step with which the part ends.
    fn take_residual(&mut self, r: &Record) {
        let before = self.start.map_or(DVec3::ZERO, |start| start.residual);
        self.residual.take((r.momentum_residual - before).length());
    }

    /// Largest residual over the largest of the momentum, that which the kinetic energy stands for where the momenta
    /// of the parts cancel, and `impulse` [N s], with the `mass` \[kg\] of what moves \[1\].
    fn ratio(&self, mass: f64, impulse: f64) -> f64 {
        let of_parts = (2.0 * mass * larger(self.kinetic.most, 0.0)).sqrt();
        let scale = [impulse, self.momentum.most, of_parts]
            .into_iter()
            .fold(ROUNDING * self.carried.most, larger);
        ratio(self.residual.most, scale)
    }

    /// Wingbeats of the part \[1\], one at least.
    fn beats(&self, setup: &FlightSetup) -> f64 {
        let beats = setup.time.period.map_or(1.0, |period| self.time / period);
        larger(beats, 1.0)
    }
}

/// The balance of the momentum while a support has the body, and in free flight.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct MomentumBalance {
    held: Part,
    free: Part,
}

impl MomentumBalance {
    /// Takes the next step.
    pub fn take(&mut self, r: &Record, setup: &FlightSetup) {
        match (setup.mode.is_supported_at(r.step), self.free.start) {
            (true, _) => self.held.take(r, setup),
            (false, Some(_)) => self.free.take(r, setup),
            (false, None) => {
                self.held.take_residual(r);
                self.free.take(r, setup);
            }
        }
    }

    /// The largest residual while a support has the body over what moves beside it \[1\]; the impulses of weight and
    /// air over a wingbeat count, lest every flight be a good one if it is but long. 0 of flights that are free from
    /// the first.
    pub fn held_residual(&self, setup: &FlightSetup) -> f64 {
        if self.held.start.is_none() {
            return 0.0;
        }
        let mass = setup.animal.mass() - setup.animal.body.mass;
        let weight = mass * setup.gravity.length() * self.held.time;
        let impulse = larger(weight, self.held.air_way) / self.held.beats(setup);
        self.held.ratio(mass, impulse)
    }

    /// The largest residual of what is gained or lost in free flight \[1\]; 0 where there is none.
    pub fn free_residual(&self, setup: &FlightSetup) -> f64 {
        if self.free.start.is_none() {
            return 0.0;
        }
        let mass = setup.animal.mass();
        self.free
            .ratio(mass, mass * setup.gravity.length() * self.free.time)
    }
}

pub(super) fn ratio(x: f64, scale: f64) -> f64 {
    if scale == 0.0 { x } else { x / scale }
}

/// Velocity of the frame in which the flyer rests, N components \[m/s\]: that of its mass centre, of one on a support
/// that of its body.
pub(super) fn velocity(r: &Record, setup: &FlightSetup) -> DVec3 {
    match setup.mode.is_supported_at(r.step) {
        true => body_motion(r).v,
        false => r.momentum / setup.animal.mass(),
    }
}

/// Motion of the central body.
pub(super) fn body_motion(r: &Record) -> BodyMotion {
    let three = |numbers: &[f64]| numbers.get(..3).map_or(DVec3::ZERO, DVec3::from_slice);
    BodyMotion {
        p: three(&r.coordinates),
        r: r.root_rotation(),
        v: three(&r.rates),
        w: r.root_angular_velocity,
    }
}

/// What of the flyer moves by itself, in the frame of velocity `u` [m/s], N components: all of a free one, of one on a
/// support all but its body.
pub(super) fn moving(r: &Record, setup: &FlightSetup, u: DVec3) -> Share {
    let mass = setup.animal.mass();
    let kinetic = r.kinetic_energy - u.dot(r.momentum) + 0.5 * mass * u.length_squared();
    let body = match setup.mode.is_supported_at(r.step) {
        true => body(r, setup, u),
        false => (0.0, DVec3::ZERO),
    };
    (kinetic - body.0, r.momentum - mass * u - body.1)
}

/// The central body.
fn body(r: &Record, setup: &FlightSetup, u: DVec3) -> Share {
    let body = &setup.animal.body;
    let mut motion = body_motion(r);
    motion.v -= u;
    (
        kinetic_energy(body, &motion),
        linear_momentum(body, &motion),
    )
}
