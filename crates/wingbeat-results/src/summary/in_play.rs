//! What residuals of energy and momentum are measured by: what takes part in the flight and is exchanged in it.
//!
//! Everything counts in the inertial frame C in which the flyer rests at the start: that of its mass centre, of a
//! tethered one that of its body. With u the velocity of C, P the momentum, M the mass and J an impulse,
//!
//! ```text
//! E_C = E - u . P + M u^2 / 2,   P_C = P - M u,   W_C = W - u . J,   R_C = R - u . R_P
//! ```
//!
//! are kinetic energy, momentum, work and residual of the energy there, R_P the residual of the momentum. So a
//! flyer that is towed through still air has the verdict of one that is held in a stream. A tethered body moves
//! as it is made to whatever its mass: only what moves beside it counts.

use serde::{Deserialize, Serialize};
use wingbeat_dynamics::{BodyMotion, kinetic_energy, linear_momentum};
use wingbeat_flight::{FlightSetup, MotionMode, Record};
use wingbeat_math::{DMat3, DQuat, DVec3, larger};

use super::extent::Extent;

/// Part of the energies and momenta in N, carried motion and all, that always counts: far above their round-off.
const ROUNDING: f64 = 1e-8;

/// Where a flight begins: velocity of C \[m/s\] and momentum [kg m/s], N components, time \[s\].
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Start {
    velocity: DVec3,
    momentum: DVec3,
    time: f64,
}

/// Gathered step by step; energies and works \[J\] and momenta [kg m/s] in C.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct InPlay {
    start: Option<Start>,
    kinetic: Extent,
    potential: Extent,
    /// Kinetic energy beside that of the mass centre, and strain energy of elastic wings.
    inner: Extent,
    works: Extent,
    energy_residual: Extent,
    momentum: Extent,
    momentum_residual: Extent,
    /// Kinetic and potential energy, and momentum, in N.
    carried: [Extent; 2],
    /// Impulse of the air up to the last step, N components, and the length of its way \[N s\].
    air: DVec3,
    air_way: f64,
    /// Time since the start \[s\].
    time: f64,
}

/// Kinetic energy \[J\] and momentum [kg m/s] of something in C.
type Share = (f64, DVec3);

impl InPlay {
    /// Takes the next step.
    pub fn take(&mut self, r: &Record, setup: &FlightSetup) {
        let start = *self.start.get_or_insert_with(|| start(r, setup));
        let u = start.velocity;
        self.time = r.time - start.time;
        let mass = setup.animal.mass();
        let weight = mass * setup.gravity * self.time;
        let (kinetic, momentum) = moving(r, setup, u);
        self.kinetic.take(kinetic);
        self.momentum.take(momentum.length());
        self.potential.take(r.potential_energy + u.dot(weight));
        self.inner.take(inner_energy(r, mass));
        // Of air, loads and tether together: each alone has its impulse by another rule than its work.
        let external = r.momentum - start.momentum - r.momentum_residual - weight;
        let external = r.air_work + r.applied_work - u.dot(external);
        for work in [r.hinge_work, r.deformation_work, external] {
            self.works.take(work);
        }
        self.energy_residual
            .take(r.energy_residual - u.dot(r.momentum_residual));
        self.momentum_residual.take(r.momentum_residual.length());
        self.carried[0].take(larger(r.kinetic_energy, r.potential_energy.abs()));
        self.carried[1].take(r.momentum.length());
        self.air_way += (r.air_impulse - self.air).length();
        self.air = r.air_impulse;
    }

    /// Largest residual of the energy over the largest of what is in play \[1\]: kinetic energy, change of potential
    /// energy, works. Elastic wings that fly freely gain or lose energy of their own, however much a fall has:
    /// there works count, and what the parts turn over among themselves.
    pub fn energy_residual(&self, setup: &FlightSetup) -> f64 {
        let is_free = matches!(setup.mode, MotionMode::Free(_));
        let scale = match is_free && setup.animal.is_elastic() {
            true => self.largest([self.works.most, self.inner.most]),
            false => self.energy_scale(),
        };
        ratio(self.energy_residual.most, scale)
    }

    /// The largest of the energies and works in play \[J\].
    pub fn energy_scale(&self) -> f64 {
        let exchanged = larger(self.potential.range(), self.works.most);
        self.largest([self.kinetic.most, exchanged])
    }

    fn largest(&self, energies: [f64; 2]) -> f64 {
        let floor = ROUNDING * self.carried[0].most;
        energies.into_iter().fold(floor, larger)
    }

    /// Largest residual of the momentum over the largest of what is in play \[1\]: the momentum, that which the
    /// kinetic energy stands for where the momenta of the parts cancel, and the impulse of the weight. Of a
    /// tethered animal these are of what moves beside its body, and the impulse of the air counts; both impulses
    /// over a wingbeat, lest every flight be a good one if it is but long.
    pub fn momentum_residual(&self, setup: &FlightSetup) -> f64 {
        let is_tethered = matches!(setup.mode, MotionMode::Tethered(_));
        let (mass, air, beats) = match is_tethered {
            true => (beside_body(setup), self.air_way, self.beats(setup)),
            false => (setup.animal.mass(), 0.0, 1.0),
        };
        let weight = mass * setup.gravity.length() * self.time;
        let of_parts = (2.0 * mass * larger(self.kinetic.most, 0.0)).sqrt();
        let scale = [larger(weight, air) / beats, self.momentum.most, of_parts]
            .into_iter()
            .fold(ROUNDING * self.carried[1].most, larger);
        ratio(self.momentum_residual.most, scale)
    }

    /// Wingbeats of the flight \[1\], one at least.
    fn beats(&self, setup: &FlightSetup) -> f64 {
        let beats = setup.time.period.map_or(1.0, |period| self.time / period);
        larger(beats, 1.0)
    }
}

pub(super) fn ratio(x: f64, scale: f64) -> f64 {
    if scale == 0.0 { x } else { x / scale }
}

/// Where the flight begins that has `r` first.
fn start(r: &Record, setup: &FlightSetup) -> Start {
    let velocity = match setup.mode {
        MotionMode::Tethered(_) => body_motion(r).v,
        MotionMode::Free(_) => r.momentum / setup.animal.mass(),
    };
    Start {
        velocity,
        momentum: r.momentum,
        time: r.time,
    }
}

/// Motion of the central body.
fn body_motion(r: &Record) -> BodyMotion {
    let three = |numbers: &[f64]| numbers.get(..3).map_or(DVec3::ZERO, DVec3::from_slice);
    let [w, x, y, z] = r.root_quaternion;
    BodyMotion {
        p: three(&r.coordinates),
        r: DMat3::from_quat(DQuat::from_xyzw(x, y, z, w)),
        v: three(&r.rates),
        w: r.root_angular_velocity,
    }
}

/// What of the flyer moves by itself, in the frame of velocity `u` [m/s], N components: all of a free one, of a
/// tethered one all but its body.
fn moving(r: &Record, setup: &FlightSetup, u: DVec3) -> Share {
    let mass = setup.animal.mass();
    let kinetic = r.kinetic_energy - u.dot(r.momentum) + 0.5 * mass * u.length_squared();
    let body = match setup.mode {
        MotionMode::Tethered(_) => body(r, setup, u),
        MotionMode::Free(_) => (0.0, DVec3::ZERO),
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

/// Mass of wings and segments \[kg\].
fn beside_body(setup: &FlightSetup) -> f64 {
    setup.animal.mass() - setup.animal.body.mass
}

/// Energy that the parts of a flyer turn over among themselves \[J\].
fn inner_energy(r: &Record, mass: f64) -> f64 {
    let strain: f64 = r.elastic.iter().map(|w| w.strain_energy).sum();
    r.kinetic_energy - r.momentum.length_squared() / (2.0 * mass) + strain
}
