//! `[air.blade]`: the blade-element model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Blade elements: quasi-steady, one strip per spanwise panel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BladeCase {
    /// Published set of translational coefficients by name.
    pub coefficients: String,
    /// Coefficients of your own instead: `C_L = lift sin 2a`,
    /// `C_D = drag_0 cos^2 a + drag_90 sin^2 a`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub own: Option<OwnCoefficients>,
    /// Force of feathering while sweeping.
    pub rotation: RotationCase,
    /// Coefficient C of the circulation `C c^2 q` of feathering for all strips; default
    /// `pi (0.75 - x0)` by strip.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_coefficient: Option<f64>,
    /// Added mass.
    pub added_mass: AddedMassCase,
    /// Where the force acts.
    pub centre_of_pressure: PressureCase,
    /// Viscous moment against feathering (Berman & Wang).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscous: Option<ViscousCase>,
    /// Drag of the body; left out: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body_drag: Option<BodyDragCase>,
    /// Induced flow at the wings, inertial axes; zero for coefficients measured on flapping
    /// wings.
    pub induced_m_s: [f64; 3],
}

impl Default for BladeCase {
    fn default() -> Self {
        Self {
            coefficients: "dickson-2008".to_owned(),
            own: None,
            rotation: RotationCase::Circulation,
            rotation_coefficient: None,
            added_mass: AddedMassCase::Normal,
            centre_of_pressure: PressureCase::Cosine,
            viscous: None,
            body_drag: None,
            induced_m_s: [0.0; 3],
        }
    }
}

/// Coefficients of your own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OwnCoefficients {
    /// Lift coefficient at 45 degrees.
    pub lift: f64,
    /// Drag coefficient at 0 degrees.
    pub drag_0: f64,
    /// Drag coefficient at 90 degrees.
    pub drag_90: f64,
}

/// Force of feathering while sweeping.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RotationCase {
    /// Left out.
    None,
    /// Kutta and Joukowski's force of the circulation of feathering: smooth.
    Circulation,
    /// The same, normal to the wing (Sane & Dickinson 2002).
    SaneDickinson,
}

/// Added mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AddedMassCase {
    /// Left out.
    None,
    /// Normal to the wing (Sane & Dickinson 2001).
    Normal,
    /// With force along the chord and moment of the section (Berman & Wang 2007).
    Section,
}

/// Where the force acts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PressureCase {
    /// From 1/4 chord edge-on to 1/2 square to the air.
    Cosine,
    /// The logistic law of Chen 2016.
    Chen2016,
    /// `centre_of_pressure.fixed = 0.25`: this part of the chord behind the edge that meets the air.
    Fixed(f64),
}

/// Viscous moment `-(pi/16) rho c^4 (linear + quadratic |q|) q` per span.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ViscousCase {
    /// Linear part (mu1 times the wingbeat frequency).
    pub linear_hz: f64,
    /// Quadratic part (mu2).
    pub quadratic: f64,
}

/// Drag of the body along and across its axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyDragCase {
    /// Reference area.
    pub area_m2: f64,
    /// Coefficient along the body.
    pub along: f64,
    /// Coefficient across it.
    pub across: f64,
}
