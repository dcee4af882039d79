//! `[flight]`, `[dynamics]` and `[[load]]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Free or tethered, and the state at t = 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FlightCase {
    /// Free flight, or a body on a tether (held or moved as prescribed).
    pub mode: Mode,
    /// Position of the body origin, inertial axes.
    pub position_m: [f64; 3],
    /// Pitch, nose up: the first angle phi of the 2-3-1 sequence.
    pub pitch_deg: f64,
    /// Yaw, nose right for an upright body is negative: the second angle theta of 2-3-1.
    pub yaw_deg: f64,
    /// Roll, right wing down: the third angle psi of 2-3-1.
    pub roll_deg: f64,
    /// Velocity of the body origin, inertial axes; a tethered body keeps it.
    pub velocity_m_s: [f64; 3],
    /// Angular velocity in body axes (free flight), at the release if the body is held.
    pub angular_velocity_deg_s: [f64; 3],
    /// Wingbeats during which a free body is still held while its wake grows.
    pub held_beats: f64,
    /// Motion of the tether on top of the constant velocity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tether: Option<TetherCase>,
}

impl Default for FlightCase {
    fn default() -> Self {
        Self {
            mode: Mode::Free,
            position_m: [0.0; 3],
            pitch_deg: 0.0,
            yaw_deg: 0.0,
            roll_deg: 0.0,
            velocity_m_s: [0.0; 3],
            angular_velocity_deg_s: [0.0; 3],
            held_beats: 0.0,
            tether: None,
        }
    }
}

/// How the body moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Mode {
    /// By the forces on it.
    Free,
    /// As prescribed.
    Tethered,
}

/// Oscillations of a tethered body, each coordinate its own.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TetherCase {
    /// Along n1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<PathOscillation>,
    /// Along n2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<PathOscillation>,
    /// Along n3 (down).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<PathOscillation>,
    /// In pitch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch: Option<AngleOscillation>,
    /// In yaw.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yaw: Option<AngleOscillation>,
    /// In roll.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roll: Option<AngleOscillation>,
}

/// `sum_k cosine_k cos(2 pi k f t) + sine_k sin(2 pi k f t)`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PathOscillation {
    /// Frequency f.
    pub frequency_hz: f64,
    /// Cosine coefficients of harmonics 1, 2, ...
    #[serde(default)]
    pub cosine_m: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ...
    #[serde(default)]
    pub sine_m: Vec<f64>,
}

/// `rate t + sum_k cosine_k cos(2 pi k f t) + sine_k sin(2 pi k f t)`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AngleOscillation {
    /// Steady rate.
    #[serde(default)]
    pub rate_deg_s: f64,
    /// Frequency f.
    #[serde(default)]
    pub frequency_hz: f64,
    /// Cosine coefficients of harmonics 1, 2, ...
    #[serde(default)]
    pub cosine_deg: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ...
    #[serde(default)]
    pub sine_deg: Vec<f64>,
}

/// Equations of motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DynamicsCase {
    /// `momentum`: momenta and a quaternion, cannot drift, no singularity (default where joints
    /// make a tree). `euler`: Euler coordinates with multipliers as in the paper, all joints
    /// prescribed. `quaternion`: positions and quaternions of all bodies with multipliers (default
    /// where joints close loops).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub formulation: Option<Formulation>,
    /// Baumgarte's stabilisation of the constraints (Euler and quaternion form).
    pub baumgarte: BaumgarteCase,
    /// `massive`: wings with the masses given; `massless`: wings that carry air loads but no
    /// inertia, which leaves the standard equations of a rigid aircraft of the body's mass.
    pub wings: WingInertia,
    /// How the quaternion form keeps its constraints: `baumgarte` (default), `projection` after
    /// every step of a one-step integrator, or `none`.
    pub stabilisation: StabilisationCase,
    /// Integrator: `hamming` (default with air), `adams`, `runge_kutta`, `order_eight` (adaptive,
    /// default without air). A wake needs `hamming`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub integrator: Option<IntegratorCase>,
    /// Error per step of `order_eight`, relative to natural sizes.
    pub tolerance: f64,
}

impl Default for DynamicsCase {
    fn default() -> Self {
        Self {
            formulation: None,
            baumgarte: BaumgarteCase::StepFactor(0.1),
            wings: WingInertia::Massive,
            stabilisation: StabilisationCase::Baumgarte,
            integrator: None,
            tolerance: 1e-10,
        }
    }
}

/// Whether wings have mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WingInertia {
    /// The masses given.
    Massive,
    /// None.
    Massless,
}

/// Which equations are integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Formulation {
    /// Momentum form.
    Momentum,
    /// Euler coordinates with multipliers.
    Euler,
    /// Positions and quaternions of all bodies with multipliers.
    Quaternion,
}

/// How the quaternion form keeps its constraints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StabilisationCase {
    /// By feedback with the constants of `baumgarte`.
    Baumgarte,
    /// By projection of positions and velocities after every step.
    Projection,
    /// Not at all.
    None,
}

/// Time integrators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum IntegratorCase {
    /// Hamming's predictor-corrector, order 4.
    Hamming,
    /// Backward differences, order 4: with a wake, where the air that moves with the wings weighs
    /// much beside the animal.
    Bdf,
    /// Adams-Bashforth-Moulton, order 4.
    Adams,
    /// Runge-Kutta, order 4.
    RungeKutta,
    /// Dormand and Prince, order 8, adaptive.
    OrderEight,
}

/// Constants of Baumgarte's stabilisation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BaumgarteCase {
    /// `baumgarte.step_factor = a`: alpha = beta = a / step. Second order in the step.
    StepFactor(f64),
    /// `baumgarte.fixed = { alpha_per_s = ..., beta_per_s = ... }`. Fourth order; 0 and 0 leave
    /// the constraints to drift.
    Fixed {
        /// Damping.
        alpha_per_s: f64,
        /// Stiffness.
        beta_per_s: f64,
    },
}

/// A force and a couple on one body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadCase {
    /// `body` or the name of a wing or segment.
    #[serde(default = "root")]
    pub on: String,
    /// Axes of the components.
    #[serde(default = "body_frame")]
    pub frame: FrameCase,
    /// Point of application in the axes of the loaded body, from its origin.
    #[serde(default)]
    pub point_m: [f64; 3],
    /// Constant part of the force.
    #[serde(default)]
    pub force_newton: [f64; 3],
    /// Constant part of the couple.
    #[serde(default)]
    pub couple_newton_m: [f64; 3],
    /// Frequency f of the oscillating parts.
    #[serde(default)]
    pub frequency_hz: f64,
    /// Cosine parts of the force, one vector per harmonic 1, 2, ...
    #[serde(default)]
    pub force_cosine_newton: Vec<[f64; 3]>,
    /// Sine parts of the force.
    #[serde(default)]
    pub force_sine_newton: Vec<[f64; 3]>,
    /// Cosine parts of the couple.
    #[serde(default)]
    pub couple_cosine_newton_m: Vec<[f64; 3]>,
    /// Sine parts of the couple.
    #[serde(default)]
    pub couple_sine_newton_m: Vec<[f64; 3]>,
}

/// Axes of a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FrameCase {
    /// Fixed in the loaded body.
    Body,
    /// Fixed in the inertial frame.
    Inertial,
}

fn root() -> String {
    "body".to_owned()
}

fn body_frame() -> FrameCase {
    FrameCase::Body
}
