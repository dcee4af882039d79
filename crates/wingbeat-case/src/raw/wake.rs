//! `[air.particles]` and `[air.section_drag]`: what is added to the plain lattice.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wingbeat_air::Stretching;

/// Vortex particles made of the wakes' rings. A strength may change by half in a step and grow to
/// twice its first size; what would change more is held there, counted and reported.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ParticlesCase {
    /// Newest rows of every sheet that stay rings; left out: all.
    ///
    /// Change it to more where the near wake matters.
    #[schemars(range(min = 1))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub after_rows: Option<usize>,
    /// Whether rows that leave leading edges become particles at once.
    ///
    /// Change it to true where leading-edge sheets roll up within a few steps.
    #[schemars(extend("with" = "air.shed = leading"))]
    #[serde(default)]
    pub leading_edge: bool,
    /// Radius of new particles; if left out that of `wake_core`, where `wake_overlap` is 0.
    ///
    /// Change it with the step: about the distance between rows of wake.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Radius of new particles in mean chords of all wings.
    ///
    /// Change it with the step: about the distance between rows of wake.
    #[schemars(extend("exclusiveMinimum" = 0, "or" = "radius_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_chords: Option<f64>,
    /// Effective kinematic viscosity, with which they spread; if left out that of `wake_core`, or 0.
    ///
    /// Change it for another fluid, or to a larger one for turbulent wakes.
    #[schemars(range(min = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscosity_m2_s: Option<f64>,
    /// How their strengths change.
    ///
    /// Change it to `omitted` if a wake blows up, to see whether stretching does it.
    #[serde(default)]
    pub stretching: Stretching,
}

/// Drag of the sections of wings: friction along the strip and `1/2 rho U^2 A (cd0 + cd2 alpha^2)` along the velocity U
/// of the undisturbed air past it, alpha the angle between that velocity and the strip.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SectionDragCase {
    /// Law of the friction.
    ///
    /// Change it to `none` where cd0 holds the friction already.
    #[serde(default)]
    pub friction: FrictionCase,
    /// Kinematic viscosity of the air, needed by the friction. Default: that of `wake_core`, if it has one, or `air.viscosity_m2_s`.
    ///
    /// Change it for another fluid: 1.5e-5 is air at 20 degrees Celsius.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = "friction = blasius"))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscosity_m2_s: Option<f64>,
    /// Profile drag at zero incidence.
    ///
    /// Change it with the section of the wing.
    #[schemars(range(min = 0))]
    #[serde(default)]
    pub cd0: f64,
    /// Its growth with the square of the incidence.
    ///
    /// Change it with the section of the wing.
    #[schemars(range(min = 0))]
    #[serde(default)]
    pub cd2_per_rad2: f64,
}

/// Law of the friction of a section.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FrictionCase {
    /// Laminar flat plate, both faces: `2.656 / sqrt(Re) + 5.34 / Re^(7/8)` (Blasius, and what the trailing
    /// edge adds), Re that of the velocity along the strip. Where leading edges shed, or have vortex lift, the
    /// face behind them has as much of its half as the edge holds of the suction of a plate at the strip's
    /// incidence.
    #[default]
    Blasius,
    /// None.
    None,
}
