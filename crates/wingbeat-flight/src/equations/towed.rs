//! The root that a tether moves, by itself: its energy and momenta are known in closed form at every instant.
//! What the tether spends on them is left out of the quadratures of work and impulse, which have only the rest
//! to integrate: a body sped up or lifted in a few steps would else open the balances by its own inertia and
//! weight, and these may be placeholders.

use wingbeat_dynamics::{
    BodyMotion, System, Wrench, angular_momentum, inertia_wrench, kinetic_energy, linear_momentum,
    weight_wrench,
};
use wingbeat_math::{BodyAcceleration, DVec3};

/// Energy and momenta of the root alone, N components; all zero where no tether moves it.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Towed {
    /// Kinetic energy [J].
    pub kinetic: f64,
    /// Potential energy of the weight, zero at the inertial origin [J].
    pub potential: f64,
    /// Linear momentum [kg m/s].
    pub momentum: DVec3,
    /// Angular momentum about the inertial origin [kg m2/s].
    pub angular_momentum: DVec3,
    /// Rate of change of its momenta [N, N m], the moment about its frame origin, N components; no part of what
    /// is kept of the start.
    #[serde(skip)]
    pub inertia: Wrench,
    /// Its weight and the moment about its frame origin [N, N m], N components; not kept either. Impulses have
    /// it with that of the whole.
    #[serde(skip)]
    pub weight: Wrench,
}

impl Towed {
    /// The root among bodies with these motions and accelerations.
    pub fn at(system: &System, motions: &[BodyMotion], rates: &[BodyAcceleration]) -> Self {
        let (body, m) = (&system.bodies()[0], &motions[0]);
        let gravity = system.gravity();
        let first_moment = body.mass.mass * m.p + m.r * body.mass.first_moment;
        Self {
            kinetic: kinetic_energy(&body.mass, m),
            potential: -gravity.dot(first_moment),
            momentum: linear_momentum(&body.mass, m),
            angular_momentum: angular_momentum(&body.mass, m),
            inertia: inertia_wrench(&body.mass, m, &rates[0]),
            weight: weight_wrench(body, m, gravity),
        }
    }

    /// What the root has gained since it was `start`.
    pub fn gained(&self, start: &Self) -> (f64, DVec3, DVec3) {
        (
            self.kinetic - start.kinetic + (self.potential - start.potential),
            self.momentum - start.momentum,
            self.angular_momentum - start.angular_momentum,
        )
    }
}
