//! The impulse budget of a flight: what became of the impulse that its surfaces gave to the air.

use serde::{Deserialize, Serialize};
use wingbeat_air::ImpulseAccount;
use wingbeat_flight::{AirOptions, FlightSetup, Record};
use wingbeat_math::{DVec3, larger};

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
    /// The largest residual after the first five steps, in which a start has its own, over all that the inviscid force
    /// changed the impulse by, to and fro, or over that of a force coefficient of 0.1 if that is larger \[1\]; beside a
    /// ground its part along the ground. Of all steps, whichever the history holds. None of fewer steps, in wind, and of
    /// results that do not say it.
    #[serde(default)]
    pub largest_relative: Option<f64>,
    /// All that the inviscid force changed the impulse by, to and fro, whatever its direction \[N s\]; none of results that
    /// do not say it.
    #[serde(default)]
    pub exchanged_newton_s: Option<f64>,
}

/// Steps of a start whose residual is not judged: the force of the first one is a difference over a step, and counts
/// half. Sudden and smooth starts of presets: 0.5 to 1 of the impulse so far in the first step, 0.02 to 0.08 in the fifth.
const START: usize = 5;

/// Mean force coefficient of which the impulse counts at least: forces that cancel, or are none, leave rounding.
const SMALL: f64 = 0.1;

/// How far the impulse of the vorticity and that of the force part in a flight, step by step.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Parting {
    /// Impulse of the inviscid force at the step before \[N s\].
    before: Option<DVec3>,
    /// Its changes from step to step in sum \[N s\].
    way: f64,
    /// The residual at the end of the start \[N s\].
    at_start: Option<DVec3>,
    /// The largest one since \[N s\].
    most: f64,
}

impl Parting {
    /// Takes the record of the next step.
    pub(super) fn take(&mut self, record: &Record, setup: &FlightSetup) {
        let Some(air) = setup.air.lattice() else {
            return;
        };
        let before = self.before.replace(record.inviscid_impulse);
        self.way += before.map_or(0.0, |b| b.distance(record.inviscid_impulse));
        if record.step >= START {
            let start = *self.at_start.get_or_insert(record.impulse_residual);
            let residual = record.impulse_residual - start;
            self.most = larger(self.most, along_grounds(residual, air).length());
        }
    }

    /// Over the impulses in play, of a flight that ends with this record.
    fn relative(&self, last: &Record) -> Option<f64> {
        let scale = self.way.max(SMALL * last.dynamic_impulse);
        (last.step > START && scale > 0.0).then(|| self.most / scale)
    }
}

/// The part of a residual along all grounds.
fn along_grounds(residual: DVec3, air: &AirOptions) -> DVec3 {
    let normals = air.lattice.images.iter().map(|g| g.normal.normalize());
    normals.fold(residual, |r, n| r - r.dot(n) * n)
}

impl ImpulseBudget {
    /// Between two records; none without a lattice, with vortex particles, whose vorticity does not close, so
    /// that their impulse depends on the origin, and in wind that varies in space, which acts on the wakes.
    pub(super) fn between(
        setup: &FlightSetup,
        [from, to]: [&Record; 2],
        parting: &Parting,
    ) -> Option<Self> {
        let air = setup.air.lattice()?;
        let lattice = &air.lattice;
        let closes = lattice.particles.is_none() && lattice.wind.is_uniform();
        if !closes || !to.impulse_residual.is_finite() {
            return None;
        }
        let along = |of: fn(&ImpulseAccount) -> DVec3| {
            (of(&to.impulse_account) - of(&from.impulse_account)).dot(down(setup))
        };
        let residual = to.impulse_residual - from.impulse_residual;
        let free = along_grounds(residual, air);
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
            is_beside_ground: !lattice.images.is_empty(),
            largest_relative: parting.relative(to).filter(|_| lattice.wind.is_none()),
            exchanged_newton_s: Some(parting.way),
        })
    }
}
