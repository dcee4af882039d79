//! What the equations of motion answer at one instant.

use wingbeat_math::{BodyAcceleration, DVec3, Wrench};

use crate::System;

/// What a hinge does to its child.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HingeReaction {
    /// Force on the child \[N\], N components.
    pub force: DVec3,
    /// Moment on the child about the hinge point [N m], child components.
    pub moment: DVec3,
    /// Power the hinge's actuator puts into the system \[W\].
    pub power: f64,
}

/// How far the coordinates are from fulfilling the constraints.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Violation {
    /// Largest connection constraint (seed eq. 4, phi_1 to phi_6) \[m\].
    pub position: f64,
    /// Largest orientation constraint (seed eq. 4, phi_7 to phi_12) \[1\], an angle in radians when small.
    pub orientation: f64,
}

/// Energies and momenta of the whole system.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Budget {
    /// Kinetic energy \[J\].
    pub kinetic: f64,
    /// Potential energy in the field of gravity, zero at the origin of N \[J\].
    pub potential: f64,
    /// Mass centre of the system \[m\], N components.
    pub centre: DVec3,
    /// Linear momentum [kg m/s], N components.
    pub momentum: DVec3,
    /// Angular momentum about the mass centre [kg m2/s], N components.
    pub angular_momentum: DVec3,
}

/// Accelerations, reactions and balances at one instant, the same from every formulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Accelerations of every body.
    pub bodies: Vec<BodyAcceleration>,
    /// Reactions of every hinge.
    pub hinges: Vec<HingeReaction>,
    /// Reactions of the joints that close loops.
    pub loops: Vec<HingeReaction>,
    /// Lagrange multipliers of `M q'' + B^T lambda = Q` in the seed's order: three of connection
    /// per hinge \[N\], then three of orientation per hinge [N m].
    pub multipliers: Vec<f64>,
    /// Load the support puts on the root about its origin; zero in free flight.
    pub tether: Wrench,
    /// Violation of the constraints.
    pub violation: Violation,
    /// Energies and momenta.
    pub budget: Budget,
    /// Power of the external loads, gravity and support not included \[W\].
    pub load_power: f64,
}

impl Solution {
    /// Room for the solution of `system`, all zero.
    pub fn new(system: &System) -> Self {
        let hinges = system.hinges().len();
        Self {
            bodies: vec![BodyAcceleration::default(); system.bodies().len()],
            hinges: vec![HingeReaction::default(); hinges],
            loops: vec![HingeReaction::default(); system.loops().len()],
            multipliers: vec![0.0; 6 * hinges],
            tether: Wrench::default(),
            violation: Violation::default(),
            budget: Budget::default(),
            load_power: 0.0,
        }
    }

    /// Sum of the powers of all joints \[W\]: actuators, springs, dampers, stops.
    pub fn hinge_power(&self) -> f64 {
        let all = self.hinges.iter().chain(&self.loops);
        all.map(|h| h.power).sum()
    }

    /// Kinetic plus potential energy \[J\].
    pub fn energy(&self) -> f64 {
        self.budget.kinetic + self.budget.potential
    }
}
