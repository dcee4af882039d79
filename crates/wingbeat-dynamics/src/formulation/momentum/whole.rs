//! Loads on the whole system, and the rates of its momenta.

use wingbeat_math::{BodyAcceleration, BodyMotion, DMat3, DVec3, Wrench};

use crate::configuration::Configuration;
use crate::system::System;
use crate::system::body::inertia_wrench;

/// Sum of all external forces and of their moments about the mass centre `x_c`, N components.
pub(super) fn total_load(
    system: &System,
    loads: &[Wrench],
    motions: &[BodyMotion],
    x_c: DVec3,
) -> Wrench {
    load_with(system, loads, motions.iter().map(|m| m.p - x_c))
}

/// As [`total_load`], from the placements: `r` is the root's rotation, `c` the mass centre
/// in root components.
pub(super) fn whole_load(
    system: &System,
    loads: &[Wrench],
    configuration: &Configuration,
    r: DMat3,
    c: DVec3,
) -> Wrench {
    let arms = configuration.placements().iter().map(|at| r * (at.d - c));
    load_with(system, loads, arms)
}

/// Gravity and the loads, with their arms from the mass centre \[m\].
fn load_with(system: &System, loads: &[Wrench], arms: impl Iterator<Item = DVec3>) -> Wrench {
    let mut sum = Wrench {
        force: system.total_mass() * system.gravity(),
        moment: DVec3::ZERO,
    };
    for (l, arm) in loads.iter().zip(arms) {
        sum.force += l.force;
        sum.moment += l.moment + arm.cross(l.force);
    }
    sum
}

/// Rates of linear momentum and of angular momentum about the mass centre.
pub(super) fn momentum_rate(
    system: &System,
    motions: &[BodyMotion],
    acc: &[BodyAcceleration],
    x_c: DVec3,
) -> Wrench {
    let mut sum = Wrench::default();
    for ((b, m), a) in system.bodies().iter().zip(motions).zip(acc) {
        let w = inertia_wrench(&b.mass, m, a);
        sum += Wrench {
            force: w.force,
            moment: w.moment + (m.p - x_c).cross(w.force),
        };
    }
    sum
}
