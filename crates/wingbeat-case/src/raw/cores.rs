//! Cores of vortex filaments: `[air.bound_core]` and `[air.wake_core]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Regularisation of a vortex filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum CoreCase {
    /// Van Garrel's cut-off (the published benchmark's).
    CutOff(CutOffCase),
    /// Vatistas with n = 2.
    Vatistas(RadiusCase),
    /// Scully.
    Scully(RadiusCase),
    /// Lamb and Oseen: grows with age.
    LambOseen(LambOseenCase),
    /// Algebraic, of Rosenhead and Moore: the same between any two filaments, so that action is reaction;
    /// grows with age. For both cores or none.
    Algebraic(LambOseenCase),
}

/// A cut-off.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CutOffCase {
    /// Cut-off length.
    ///
    /// Change it with the size of the panels: the benchmark has a hundredth of it.
    #[schemars(range(min = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
    /// Cut-off length in mean chords of all wings.
    ///
    /// Change it with the size of the panels: the benchmark has a hundredth of it.
    #[schemars(range(min = 0), extend("or" = "length_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_chords: Option<f64>,
}

/// A core of constant radius.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RadiusCase {
    /// Core radius.
    ///
    /// Change it by a factor of two both ways to see what depends on it.
    #[schemars(range(min = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Core radius in mean chords of all wings.
    ///
    /// Change it by a factor of two both ways to see what depends on it.
    #[schemars(range(min = 0), extend("or" = "radius_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_chords: Option<f64>,
}

/// A core that grows with age.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LambOseenCase {
    /// Core radius at age zero.
    ///
    /// Change it by a factor of two both ways to see what depends on it.
    #[schemars(range(min = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Core radius in mean chords of all wings.
    ///
    /// Change it by a factor of two both ways to see what depends on it.
    #[schemars(range(min = 0), extend("or" = "radius_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_chords: Option<f64>,
    /// Effective kinematic viscosity, of `wake_core`: filaments on surfaces do not age, so `bound_core`
    /// has none of its own. Default: `air.viscosity_m2_s`.
    ///
    /// Change it for another fluid, or to a larger one for turbulent wakes.
    #[schemars(range(min = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscosity_m2_s: Option<f64>,
}

impl LambOseenCase {
    /// Algebraic, in air, with this radius in mean chords.
    pub(super) fn chords(radius: f64) -> CoreCase {
        CoreCase::Algebraic(Self {
            radius_chords: Some(radius),
            ..Self::default()
        })
    }
}
