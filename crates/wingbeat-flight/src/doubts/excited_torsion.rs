//! Torsion of elastic wings that quasi-steady blade elements excite.
//!
//! A section in a stream U turns about an elastic axis a c behind its leading edge. By thin-airfoil theory, the force
//! of circulation at a quarter of the chord follows the downwash of 3/4, and the added mass gives `m U q` at mid chord:
//! the moment `pi rho c^3 U q ((a - 1/4) (3/4 - a) - (1/2 - a)/4)`, which drives the motion where
//! `a > (5 - sqrt 5)/8 = 0.35`. With the couple `-(pi/16) rho c^3 U q` [Theodorsen 1935], which the quasi-steady law
//! leaves out by default, it damps for every a up to 1/2. Behind that a wake that lags is what damps. Where wings bend, too,
//! without the couple those grow whose elastic axis or mass lies behind a quarter of the chord: a wing of 0.3 x 0.08 m at
//! 5 m/s by 15 1/s with the axis at 0.25 and the mass at 0.5, by 3 and 23 1/s with both at 0.3 and 0.4; with both at 0.25
//! it decays.

use wingbeat_blade::Rotation;
use wingbeat_model::{Members, Wing};

use super::said::names;
use crate::setup::{AirModel, FlightSetup};

/// Elastic axis or mass behind the leading edge over the chord, behind which a wing is driven without the couple \[1\].
const DRIVEN: f64 = 0.251;

/// Elastic axis from which on torsion is driven with the couple \[1\].
const DRIVEN_WITH_COUPLE: f64 = 0.5;

impl FlightSetup {
    /// Says which elastic wings have neither damping of their own nor, in quasi-steady blade elements, enough of the
    /// moments of the air that damp torsion; none of other air.
    pub fn excited_torsion(&self) -> Option<String> {
        let AirModel::BladeElement(air) = &self.air else {
            return None;
        };
        let rotation = air.blade.rotation;
        if air.blade.unsteady.is_some() || rotation == Rotation::None {
            return None;
        }
        let has_couple = air.blade.damps_feathering();
        let wings = self.animal.wings.iter();
        let driven = wings.filter(|w| is_driven(w, has_couple));
        let wings: Vec<&str> = driven.map(|w| &w.name[..]).collect();
        let (why, remedy) = match has_couple {
            false => (
                "leave out the moment of thin-airfoil theory against feathering, and what is left",
                "air.blade.rotation = \"circulation_and_couple\", air.blade.unsteady = \"peters\"",
            ),
            true => (
                "have no wake that lags, and what is left about an elastic axis behind mid chord",
                "air.blade.unsteady = \"peters\"",
            ),
        };
        (!wings.is_empty()).then(|| {
            format!(
                "quasi-steady blade elements {why} makes the torsion of elastic wings grow, whatever its stiffness and the steps (wings {}, which have no damping of their own): take {remedy}, or give structure.damping_s",
                names(wings, ", ")
            )
        })
    }
}

/// Whether the torsion of `wing` has no damping and is driven.
fn is_driven(wing: &Wing, has_couple: bool) -> bool {
    wing.structure.as_ref().is_some_and(|made| {
        let is_behind = match &made.members {
            Members::Beam(beam) if has_couple => beam.axis_fraction >= DRIVEN_WITH_COUPLE,
            Members::Beam(beam) => beam.axis_fraction.max(beam.mass_fraction) > DRIVEN,
            Members::Shell(_) => !has_couple,
        };
        let damping = made.damping;
        is_behind && damping.strain_rate == 0.0 && damping.mass == 0.0
    })
}
