//! The impulse budget of a flight: what became of the impulse that its surfaces gave to the air.

use serde::{Deserialize, Serialize};
use wingbeat_air::ImpulseAccount;
use wingbeat_flight::{AirModel, FlightSetup, Record};

use super::beats::down;

/// Impulses along gravity, from the first record to the last.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImpulseBudget {
    /// Given to the vorticity by surfaces \[N s\].
    pub created_newton_s: f64,
    /// Gained by free wakes as they moved \[N s\].
    pub moved_newton_s: f64,
    /// That of wakes when they were dropped \[N s\].
    pub cut_newton_s: f64,
    /// Taken by surfaces from wakes that they held back \[N s\].
    pub absorbed_newton_s: f64,
    /// Vortex impulse and impulse of the inviscid force together \[N s\].
    pub residual_newton_s: f64,
    /// The residual, with its parts across gravity, over the impulse of the inviscid force \[1\]. Beside a
    /// ground its part along the ground alone, which bears a force normal to it.
    pub residual_relative: f64,
    /// Whether there is a ground.
    #[serde(default)]
    pub is_beside_ground: bool,
}

impl ImpulseBudget {
    /// Between two records; none without a lattice, with vortex particles, whose vorticity does not close, so
    /// that their impulse depends on the origin, in wind that varies in space, which acts on the wakes, and of
    /// results of older versions, which lack the account.
    pub(super) fn between(setup: &FlightSetup, from: &Record, to: &Record) -> Option<Self> {
        let AirModel::VortexLattice(air) = &setup.air else {
            return None;
        };
        let lattice = &air.lattice;
        let closes = lattice.particles.is_none() && lattice.wind.is_uniform();
        if !closes || !to.impulse_residual.is_finite() {
            return None;
        }
        let along = |of: fn(&ImpulseAccount) -> wingbeat_math::DVec3| {
            (of(&to.impulse_account) - of(&from.impulse_account)).dot(down(setup))
        };
        let residual = to.impulse_residual - from.impulse_residual;
        let grounds = &air.lattice.images;
        let normals = grounds.iter().map(|ground| ground.normal.normalize());
        let free = normals.fold(residual, |r, n| r - r.dot(n) * n);
        let inviscid = (to.inviscid_impulse - from.inviscid_impulse).length();
        Some(Self {
            created_newton_s: along(|a| a.created),
            moved_newton_s: along(|a| a.moved),
            cut_newton_s: along(|a| a.cut),
            absorbed_newton_s: along(|a| a.absorbed),
            residual_newton_s: residual.dot(down(setup)),
            residual_relative: match inviscid > 0.0 {
                true => free.length() / inviscid,
                false => free.length(),
            },
            is_beside_ground: !grounds.is_empty(),
        })
    }
}
