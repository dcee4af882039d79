//! `[flight]` and `[dynamics]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;

use super::Open;

const FREE: &str = "mode = free";

/// Free or tethered, and the state at t = 0.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FlightCase {
    /// Free flight, or a body on a tether (held or moved as prescribed).
    ///
    /// Change it to `tethered` to measure forces at a known motion.
    #[default(Mode::Free)]
    pub mode: Mode,
    /// Position of the body origin, inertial axes.
    ///
    /// Change it for flight near the ground or in a shear.
    pub position_m: [f64; 3],
    /// Pitch, nose up: the first angle phi of the 2-3-1 sequence.
    ///
    /// Change it to the body angle of the flight.
    pub pitch_deg: f64,
    /// Yaw, about b3 of the pitched body: the second angle theta of 2-3-1. Nose right of a body without pitch;
    /// a pitched one tilts, too.
    ///
    /// Change it for sideslip; of a body pitched by q turn the velocity or the stream instead, or head h to the
    /// right by pitch_deg = atan(tan q / cos h), yaw_deg = asin(cos q sin h), roll_deg = -atan(sin q tan h).
    pub yaw_deg: f64,
    /// Roll, right wing down: the third angle psi of 2-3-1.
    ///
    /// Change it to start from a bank.
    pub roll_deg: f64,
    /// Velocity of the body origin, inertial axes; a tethered body keeps it.
    ///
    /// Change it for forward flight in still air.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub velocity_m_s: [f64; 3],
    /// Angular velocity in body axes, at the release if the body is held, beside that of the tether.
    ///
    /// Change it to start from a turn.
    #[schemars(extend("with" = FREE))]
    pub angular_velocity_deg_s: [f64; 3],
    /// Wingbeats during which a free body is still held while its wake grows.
    ///
    /// Change it to 1 or 2 to release the body into a grown wake.
    #[schemars(range(min = 0), extend("with" = FREE))]
    pub held_beats: f64,
    /// Time for which a free body is still held while its wake grows, where nothing beats; left out: none.
    ///
    /// Change it to release a glider into a grown wake: some tens of chords over its speed.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = FREE))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held_s: Option<f64>,
    /// Motion of the tether on top of the constant velocity, in free flight while the body is held
    /// (`held_beats`, `held_s`), which is released with the velocities that it has then; left out: none.
    ///
    /// Change it to move the body as an experiment did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tether: Option<TetherCase>,
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
    /// Along n1; left out: none.
    ///
    /// Change it to move the body as an experiment did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<PathOscillation>,
    /// Along n2; left out: none.
    ///
    /// Change it to move the body as an experiment did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<PathOscillation>,
    /// Along n3 (down); left out: none.
    ///
    /// Change it to move the body as an experiment did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<PathOscillation>,
    /// In pitch; left out: none.
    ///
    /// Change it to move the body as an experiment did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch: Option<AngleOscillation>,
    /// In yaw; left out: none.
    ///
    /// Change it to move the body as an experiment did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yaw: Option<AngleOscillation>,
    /// In roll; left out: none.
    ///
    /// Change it to move the body as an experiment did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roll: Option<AngleOscillation>,
    /// Time in which all of the motion of a tethered body (`velocity_m_s`, rates, oscillations) rises from
    /// rest; from then on it is late by half of that. Left out: at full speed from the first instant, also where
    /// the wings start smoothly (`motion.start`), which is half a beat out of step with them.
    ///
    /// Change it for wings that are towed or revolved from rest.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = "flight.mode = tethered"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_s: Option<f64>,
}

/// `sum_k cosine_k cos(2 pi k f t) + sine_k sin(2 pi k f t)`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PathOscillation {
    /// Frequency f.
    ///
    /// Change it to that of the motion.
    #[schemars(range(min = -1_000_000, max = 1_000_000), extend("with" = "cosine_m | sine_m"))]
    pub frequency_hz: f64,
    /// Cosine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to those of the motion.
    #[serde(default)]
    pub cosine_m: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to those of the motion.
    #[serde(default)]
    pub sine_m: Vec<f64>,
}

/// `rate t + sum_k cosine_k cos(2 pi k f t) + sine_k sin(2 pi k f t)`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AngleOscillation {
    /// Steady rate. In a stream sideslip or incidence then change with the heading: a rate of yaw measures
    /// `C_r - C_betadot`, one of pitch `C_q + C_alphadot`. A steady turn needs a circle by `x` and `y`, too
    /// (docs/flight-mechanics.md).
    ///
    /// Change it to revolve wings, or to roll, or with a circle for turns.
    #[serde(default)]
    pub rate_deg_s: f64,
    /// Frequency f.
    ///
    /// Change it to that of the motion.
    #[schemars(range(min = -1_000_000, max = 1_000_000), extend("with" = "cosine_deg | sine_deg"))]
    #[serde(default)]
    pub frequency_hz: f64,
    /// Cosine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to those of the motion.
    #[serde(default)]
    pub cosine_deg: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to those of the motion.
    #[schemars(extend("with" = "frequency_hz"))]
    #[serde(default)]
    pub sine_deg: Vec<f64>,
}

/// Equations of motion.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DynamicsCase {
    /// Which equations are integrated. Default: `momentum` where joints make a tree, `quaternion`
    /// where they close loops or a held body has free joints, which is always integrated so.
    ///
    /// Change it to `euler` for the equations and multipliers of the paper.
    #[serde(skip_serializing_if = "Open::is_open")]
    pub formulation: Open<Formulation>,
    /// Baumgarte's stabilisation of the constraints.
    ///
    /// Change it to `fixed` where the order of convergence in the step is measured.
    #[default(BaumgarteCase::StepFactor(0.1))]
    #[schemars(extend("with" = ["formulation = euler | quaternion", "stabilisation = baumgarte"]))]
    pub baumgarte: BaumgarteCase,
    /// Whether wings have mass.
    ///
    /// Change it to `massless` to compare with the standard equations of a rigid aircraft.
    #[default(WingInertia::Massive)]
    pub wings: WingInertia,
    /// How the quaternion form keeps its constraints.
    ///
    /// Change it to `projection` with `order_eight` or `runge_kutta`: constraints hold to rounding.
    #[default(StabilisationCase::Baumgarte)]
    #[schemars(extend("with" = "formulation = quaternion"))]
    pub stabilisation: StabilisationCase,
    /// Integrator. Default: `hamming` with air, `bdf` where joints leave something free in a vortex lattice or
    /// beside elastic wings, `order_eight` without air and elastic wings. A wake needs `hamming` or `bdf`.
    ///
    /// Change it to see what depends on the method; to `bdf` where forces alternate from step to step.
    #[serde(skip_serializing_if = "Open::is_open")]
    pub integrator: Open<IntegratorCase>,
    /// Error per step of `order_eight`, relative to natural sizes.
    ///
    /// Change it for studies of convergence.
    #[default = 1e-10]
    #[schemars(extend("exclusiveMinimum" = 0, "with" = "integrator = order_eight"))]
    pub tolerance: f64,
}

/// Whether wings have mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WingInertia {
    /// The masses given.
    Massive,
    /// None: wings carry air loads but no inertia.
    Massless,
}

/// Which equations are integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Formulation {
    /// Momenta and a quaternion: cannot drift, no singularity.
    Momentum,
    /// Euler coordinates with multipliers as in the paper, all joints prescribed.
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
    /// By projection of positions and velocities after every step of a one-step integrator.
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
    /// much beside the animal. Order 2 where elastic wings hang on free joints, which need it.
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
    /// alpha = beta = a / step with this a. Second order in the step.
    StepFactor(#[schemars(range(min = 0))] f64),
    /// Constants of their own. Fourth order; 0 and 0 leave the constraints to drift.
    Fixed {
        /// Damping.
        ///
        /// Change it with the time scale of the flight: a tenth of the inverse step.
        #[schemars(range(min = 0))]
        alpha_per_s: f64,
        /// Stiffness.
        ///
        /// Change it with the time scale of the flight: a tenth of the inverse step.
        #[schemars(range(min = 0))]
        beta_per_s: f64,
    },
}
