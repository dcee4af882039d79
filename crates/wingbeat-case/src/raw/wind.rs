//! `[[air.gust]]`, `[air.vortex_street]` and `[air.ground]`: what the undisturbed air does.

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
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
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
    /// Rows of time since the start in s and share of the amplitude, straight lines between. Before the first row
    /// there is no gust; after the last its value stays.
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

/// A von Karman vortex street that travels as it is: two rows of smooth vortices of opposite sense, without end, there
/// from the first instant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VortexStreetCase {
    /// Circulation of a vortex. Positive: between the rows the air goes against the drift, as behind a body.
    ///
    /// Change it to that of the wake that is met.
    pub circulation_m2_s: f64,
    /// From vortex to vortex of a row.
    ///
    /// Change it to that of the wake that is met: the speed over the frequency of shedding.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub spacing_m: f64,
    /// From row to row; left out: 0.281 spacings, von Karman's.
    ///
    /// Change it for a wider or narrower wake.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_m: Option<f64>,
    /// How concentrated the vortices are (Stuart's): towards 1 they become points, towards 0 a shear layer.
    ///
    /// Change it to less for an old wake.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    #[serde(default = "concentration")]
    pub concentration: f64,
    /// Velocity with which the street travels, along its rows, inertial axes; not 0.
    ///
    /// Change it to the speed with which the wake meets the animal.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub drift_m_s: [f64; 3],
    /// Axis of the vortices, of any length but 0, square to the drift, inertial axes.
    ///
    /// Change it to [0, 0, 1] for vortices that stand upright.
    #[serde(default = "axis")]
    pub axis: [f64; 3],
    /// A point midway between the rows at time 0, abreast of a vortex of the row towards axis x drift, inertial axes.
    ///
    /// Change it to meet the wake at another phase, or beside its middle.
    #[serde(default)]
    pub point_m: [f64; 3],
}

fn concentration() -> f64 {
    0.9
}

fn axis() -> [f64; 3] {
    [0.0, 1.0, 0.0]
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
