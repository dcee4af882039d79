//! Choices of the method.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::settings::vortex_lift::{VortexLift, held_part};

/// How the rate of change of circulation in the unsteady Bernoulli equation is formed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CirculationRate {
    /// Backward difference over the step, first order, the published benchmark's.
    #[default]
    Backward,
    /// Backward difference over two steps (of any lengths), second order; the first step that
    /// has a predecessor takes that over one.
    BackwardSecond,
    /// Left out: quasi-steady loads.
    Omitted,
}

/// How wake nodes are moved with the velocities of the accepted step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Convection {
    /// With the velocity of the step: explicit Euler, first order, the published benchmark's.
    #[default]
    Euler,
    /// With the velocity extrapolated to the middle of the step from those of this step and the
    /// one before (Adams-Bashforth, steps of any lengths): second order. A node that has just left
    /// its edge has no past and takes one Euler step.
    AdamsBashforth,
}

/// How circulation is spread over the newest row of a wake, next to its edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NewestRow {
    /// One value, that of the panel when the row's far side left: first order, the published
    /// benchmark's.
    #[default]
    Constant,
    /// As the lattice continued into the wake would have it: second order. In rows of up to eight
    /// panel lengths the circulation falls from the panel's present one to its past one in steps of
    /// a panel length; rows shorter than a panel leave with a delay.
    Matched,
}

/// How forces follow from circulations. The methods differ in what they do with the suction at
/// attached leading edges: never mix them in one comparison.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoadMethod {
    /// Unsteady Bernoulli, pressure jump times normal: no suction (the published benchmark's).
    #[default]
    Pressure,
    /// Joukowski's force on every segment and `rho A dGamma/dt` along the normal: with suction at
    /// the edges that do not shed.
    Joukowski,
    /// Pressure, and the suction of the leading edge of each strip, without that of side edges, turned into a normal
    /// force on its leading panel: Polhamus's analogy for an attached leading-edge vortex
    /// [Polhamus 1966, NASA TN D-3767].
    Polhamus,
}

impl LoadMethod {
    /// As a case has it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Pressure => "pressure",
            Self::Joukowski => "joukowski",
            Self::Polhamus => "polhamus",
        }
    }
}

/// Where and when the flow leaves leading edges, judged strip by strip at every step. Needs
/// [`SheddingKinds::leading`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LeadingEdge {
    /// Nowhere.
    Never,
    /// Everywhere.
    #[default]
    Always,
    /// Where the effective angle of attack [rad] exceeds the threshold.
    AngleOfAttack {
        /// Threshold [rad], 0 to pi.
        threshold: f64,
    },
    /// Where the leading-edge suction parameter exceeds the threshold, and only as much as keeps it there
    /// [Ramesh et al. 2014, J. Fluid Mech. 751:500].
    Suction {
        /// Threshold, above 0.
        threshold: f64,
        /// Part of the force of the suction held, and of all else that pulls along the wing, that acts, 0 to 1:
        /// the leading-edge suction efficiency [`DeLaurier` 1993, Aeronaut. J. 97:125]. Thin sharp edges hold
        /// the circulation in a bubble and have none of that force: what they feel is normal to the wing
        /// [Usherwood & Ellington 2002, J. Exp. Biol. 205:1547]. Forces on segments have it; pressures alone
        /// have none anyway.
        efficiency: f64,
    },
    /// The same, what leaves being found together with the circulations of the same instant, so that no edge
    /// ever has more than it holds. Rings lie aft as in attached flow, the wake begins at the very edge, and
    /// the suction counts what vorticity beside the leading panel makes along it.
    SuctionImplicit {
        /// Threshold, above 0.
        threshold: f64,
        /// Part of the force of the suction held that acts, 0 to 1, as above.
        efficiency: f64,
    },
    /// Nowhere: what the suction parameter has beyond the threshold acts as the normal force of a leading-edge
    /// vortex, which is lost when it has been fed for too long, see [`VortexLift`].
    VortexLift(VortexLift),
}

impl LeadingEdge {
    /// Whether any flow may leave leading edges.
    pub fn sheds(&self) -> bool {
        !matches!(self, Self::Never | Self::VortexLift(_))
    }

    /// Suction parameter that edges hold and part of its force that acts \[1\], if it is suction that decides.
    pub fn suction(&self) -> Option<[f64; 2]> {
        match *self {
            Self::Suction {
                threshold,
                efficiency,
            }
            | Self::SuctionImplicit {
                threshold,
                efficiency,
            }
            | Self::VortexLift(VortexLift {
                threshold,
                efficiency,
                ..
            }) => Some([threshold, efficiency]),
            _ => None,
        }
    }

    /// Part of the suction of a plate at this incidence [rad], 0 to pi/2, that the edge holds: the rest of the
    /// flow leaves it \[1\].
    ///
    /// Where a suction parameter decides, the plate's is the sine of its incidence, and the part is rounded as
    /// [`VortexLift`] rounds it.
    pub(crate) fn holds(&self, incidence: f64) -> f64 {
        match *self {
            Self::Never => 1.0,
            Self::Always => 0.0,
            Self::AngleOfAttack { threshold } if incidence > threshold => 0.0,
            Self::AngleOfAttack { .. } => 1.0,
            Self::Suction { threshold, .. }
            | Self::SuctionImplicit { threshold, .. }
            | Self::VortexLift(VortexLift { threshold, .. }) => {
                held_part(incidence.sin() / threshold)
            }
        }
    }
}
