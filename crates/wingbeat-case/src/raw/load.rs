//! `[[load]]` and `[spring.NAME]`: forces and couples beside those of joints and air.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wingbeat_flight::LoadFrame;

/// What oscillates.
const SERIES: &str =
    "force_cosine_newton | force_sine_newton | couple_cosine_newton_m | couple_sine_newton_m";

/// A force and a couple on one body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadCase {
    /// `body` or the name of a segment or of a wing without `structure`.
    ///
    /// Change it to load another body.
    #[serde(default = "root")]
    pub on: String,
    /// Axes of the components.
    ///
    /// Change it for loads that keep their direction in space.
    #[serde(default = "body_frame")]
    pub frame: LoadFrame,
    /// Point of application in the axes of the loaded body, from its origin; `animal.scale` scales it, and no force.
    ///
    /// Change it for forces off the origin.
    #[schemars(extend("with" = "force_newton | force_cosine_newton | force_sine_newton"))]
    #[serde(default)]
    pub point_m: [f64; 3],
    /// Constant part of the force.
    ///
    /// Change it to tow or load the animal.
    #[serde(default)]
    pub force_newton: [f64; 3],
    /// Constant part of the couple.
    ///
    /// Change it to turn the animal.
    #[serde(default)]
    pub couple_newton_m: [f64; 3],
    /// Frequency f of the oscillating parts.
    ///
    /// Change it together with the series below.
    #[schemars(range(min = 0, max = 1_000_000), extend("with" = SERIES))]
    #[serde(default)]
    pub frequency_hz: f64,
    /// Cosine parts of the force, one vector per harmonic 1, 2, ...
    ///
    /// Change it for forces that oscillate.
    #[serde(default)]
    pub force_cosine_newton: Vec<[f64; 3]>,
    /// Sine parts of the force.
    ///
    /// Change it for forces that oscillate.
    #[schemars(extend("with" = "frequency_hz"))]
    #[serde(default)]
    pub force_sine_newton: Vec<[f64; 3]>,
    /// Cosine parts of the couple.
    ///
    /// Change it for couples that oscillate.
    #[serde(default)]
    pub couple_cosine_newton_m: Vec<[f64; 3]>,
    /// Sine parts of the couple.
    ///
    /// Change it for couples that oscillate.
    #[schemars(extend("with" = "frequency_hz"))]
    #[serde(default)]
    pub couple_sine_newton_m: Vec<[f64; 3]>,
}

fn root() -> String {
    "body".to_owned()
}

fn body_frame() -> LoadFrame {
    LoadFrame::Body
}

/// A spring and a damper along the line between points of two bodies: a tendon, a thread, an elastic
/// stop. Its work counts among that of applied loads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpringCase {
    /// Its two bodies: `body` or names of wings and segments.
    ///
    /// Change it to span other bodies.
    pub between: [String; 2],
    /// Its ends, each in the axes of its body from that body's origin: the point of its joint or hinge.
    ///
    /// Change it to where it is attached.
    pub at_m: [[f64; 3]; 2],
    /// Stiffness.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    #[serde(default)]
    pub stiffness_newton_per_m: f64,
    /// Length without tension; shorter, it pushes.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0), extend("with" = "stiffness_newton_per_m"))]
    #[serde(default)]
    pub rest_m: f64,
    /// Damping of the rate of its length.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    #[serde(default)]
    pub damping_newton_s_per_m: f64,
}
