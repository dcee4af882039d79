//! `[air]`: the air and the settings of the vortex lattice.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::BladeCase;

/// The air and its model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AirCase {
    /// `vortex_lattice`: non-linear, unsteady, with free wakes; `blade_element`: quasi-steady
    /// strips, fast; `none`: vacuum.
    pub model: AirModel,
    /// Density.
    pub density_kg_m3: f64,
    /// Velocity of the undisturbed air, inertial axes.
    pub stream_m_s: [f64; 3],
    /// Whether head, thorax and abdomen are part of the lattice.
    pub body: bool,
    /// Edges of the wings that shed wakes.
    pub shed: Vec<EdgeCase>,
    /// Core of the vortex filaments on the surfaces; default a cut-off of 0.01 mean panel
    /// lengths.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bound_core: Option<CoreCase>,
    /// Core of the vortex filaments in the wakes: a physical input of hover. Default as
    /// `bound_core`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wake_core: Option<CoreCase>,
    /// How the rate of change of circulation in the pressure is formed.
    pub circulation_rate: CirculationRateCase,
    /// Rows kept in each wake sheet; left out: all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_wake_rows: Option<usize>,
    /// Longest way of a wake node in a step; left out: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_displacement_m: Option<f64>,
    /// Wake nodes keep this distance from surfaces and do not pass through them, which is
    /// counted and reported; 0 lets them pass (the published benchmark's).
    pub clearance_m: f64,
    /// Settings of `model = "blade_element"`; the lattice's keys do not matter then.
    #[serde(skip_serializing_if = "is_default")]
    pub blade: BladeCase,
}

fn is_default(case: &BladeCase) -> bool {
    *case == BladeCase::default()
}

impl Default for AirCase {
    fn default() -> Self {
        Self {
            model: AirModel::VortexLattice,
            density_kg_m3: 1.225,
            stream_m_s: [0.0; 3],
            body: true,
            shed: vec![EdgeCase::Trailing, EdgeCase::Tip, EdgeCase::Leading],
            bound_core: None,
            wake_core: None,
            circulation_rate: CirculationRateCase::Backward,
            max_wake_rows: None,
            max_displacement_m: None,
            clearance_m: 0.0,
            blade: BladeCase::default(),
        }
    }
}

/// Air model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AirModel {
    /// Non-linear unsteady vortex lattice.
    VortexLattice,
    /// Quasi-steady blade elements.
    BladeElement,
    /// No air.
    None,
}

/// An edge of a wing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EdgeCase {
    /// Trailing edge.
    Trailing,
    /// Wing tip.
    Tip,
    /// Leading edge.
    Leading,
    /// Root.
    Root,
}

/// Regularisation of a vortex filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum CoreCase {
    /// `cut_off = { length_m = ... }`: van Garrel's cut-off (the published benchmark's).
    CutOff {
        /// Cut-off length.
        length_m: f64,
    },
    /// `vatistas = { radius_m = ... }`: Vatistas with n = 2.
    Vatistas {
        /// Core radius.
        radius_m: f64,
    },
    /// `scully = { radius_m = ... }`.
    Scully {
        /// Core radius.
        radius_m: f64,
    },
    /// `lamb_oseen = { radius_m = ..., viscosity_m2_s = ... }`: grows with age.
    LambOseen {
        /// Core radius at age zero.
        radius_m: f64,
        /// Effective kinematic viscosity.
        viscosity_m2_s: f64,
    },
}

/// How the rate of change of circulation is formed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CirculationRateCase {
    /// Backward difference, first order (the published benchmark's).
    Backward,
    /// Backward difference over two steps, second order.
    BackwardSecond,
    /// Left out.
    Omitted,
}
