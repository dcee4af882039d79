//! `[[air.gust]]` and `[air.ground]`: what the undisturbed air does.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wingbeat_air::Spectrum;

/// A gust: amplitude times a function of time, given by `duration_s`, `table` or `turbulence`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GustCase {
    /// Velocity at the height of the gust, inertial axes.
    ///
    /// Change it for a stronger gust or another direction.
    pub amplitude_m_s: [f64; 3],
    /// Time at which it begins at the origin.
    ///
    /// Change it to let the flight become periodic before the gust comes.
    #[serde(default)]
    pub start_s: f64,
    /// Velocity with which its front travels; left out: it is everywhere at once.
    ///
    /// Change it for gusts that are not much longer than the animal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub front_m_s: Option<[f64; 3]>,
    /// Length of a 1-cosine gust.
    ///
    /// Change it to meet the slow or the fast modes of flight.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Rows of time since the start in s and share of the amplitude, straight lines between.
    ///
    /// Change it for measured gusts.
    #[schemars(length(min = 2), extend("or" = "duration_s"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<Vec<(f64, f64)>>,
    /// Turbulence, the amplitude its root mean square.
    ///
    /// Change it to fly in rough air.
    #[schemars(extend("or" = ["duration_s", "table"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turbulence: Option<TurbulenceCase>,
}

/// Turbulence of one direction as a sum of waves with a given spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TurbulenceCase {
    /// Spectrum, of the component along the motion through the air or across it.
    ///
    /// Change it to the spectrum that is asked for.
    #[serde(default)]
    pub spectrum: Spectrum,
    /// Length scale of the turbulence over the speed with which the animal meets it.
    ///
    /// Change it to meet the slow or the fast modes of flight.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub time_scale_s: f64,
    /// Number from which the waves are drawn: the same air for the same seed.
    ///
    /// Change it for other air of the same kind, and for the other directions of the same air.
    #[serde(default)]
    pub seed: u64,
}

/// A plane through which no air goes; animal and wake stay on one side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GroundCase {
    /// A point of the plane, inertial axes.
    ///
    /// Change it for another height: n3 points down.
    pub point_m: [f64; 3],
    /// Its normal, of any length but 0, inertial axes.
    ///
    /// Change it for a wall.
    pub normal: [f64; 3],
}
