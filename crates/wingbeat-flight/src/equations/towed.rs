//! The root that a tether moves, by itself: its energy and momenta are known in closed form at every instant.
//! What the tether spends on them is left out of the quadratures of work and impulse, which have only the rest
//! to integrate: a body sped up in a few steps would else open the balances by its own inertia, and that may be
//! a placeholder.

use wingbeat_dynamics::{
    BodyMotion, System, Wrench, angular_momentum, inertia_wrench, kinetic_energy, linear_momentum,
};
use wingbeat_math::{BodyAcceleration, DVec3};

/// Energy and momenta of the root alone, N components; all zero where no tether moves it.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Towed {
    /// Kinetic energy [J].
    pub kinetic: f64,
    /// Linear momentum [kg m/s].
    pub momentum: DVec3,
    /// Angular momentum about the inertial origin [kg m2/s].
    pub angular_momentum: DVec3,
    /// Rate of change of its momenta [N, N m], the moment about its frame origin, N components; no part of what
    /// is kept of the start.
    #[serde(skip)]
    pub inertia: Wrench,
}

impl Towed {
    /// The root among bodies with these motions and accelerations.
    pub fn at(system: &System, motions: &[BodyMotion], rates: &[BodyAcceleration]) -> Self {
        let (body, m) = (&system.bodies()[0], &motions[0]);
        Self {
            kinetic: kinetic_energy(&body.mass, m),
            momentum: linear_momentum(&body.mass, m),
            angular_momentum: angular_momentum(&body.mass, m),
            inertia: inertia_wrench(&body.mass, m, &rates[0]),
        }
    }

    /// What the root has gained since it was `start`.
    pub fn gained(&self, start: &Self) -> (f64, DVec3, DVec3) {
        (
            self.kinetic - start.kinetic,
            self.momentum - start.momentum,
            self.angular_momentum - start.angular_momentum,
        )
    }
}
