//! `[motion]` and `[wing.NAME.motion]`: how the wings beat.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What all wings share in their motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MotionCase {
    /// Wingbeat frequency; default that of the data set, else 0: wings that do not beat.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Pitch of the stroke plane in the body: the angle about b2 that carries b1 to the normal
    /// of the stroke plane. Hover with a horizontal stroke plane: body pitch + this = 90.
    /// Default that of the data set, else 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stroke_plane_pitch_deg: Option<f64>,
    /// A shipped set of measured wing angles, for wings without angles of their own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub data: Option<String>,
    /// Smooth: from rest over `start_beats`; impulsive: at full speed from the first instant.
    pub start: StartCase,
    /// Length of a smooth start in wingbeats.
    pub start_beats: f64,
    /// Phase at t = 0 in wingbeats.
    pub phase: f64,
    /// Adjustments of all wings on top of their angles, as trim finds them.
    #[serde(skip_serializing_if = "is_default")]
    pub adjust: AdjustCase,
}

fn is_default(case: &AdjustCase) -> bool {
    *case == AdjustCase::default()
}

/// Adjustments of the wing angles, the same on both sides by mirror symmetry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AdjustCase {
    /// Relative change of the stroke's swing about its mean.
    pub stroke_amplitude: f64,
    /// Added to the stroke angle, positive forward.
    pub stroke_offset_deg: f64,
    /// Relative change of the feathering's swing about its mean.
    pub feathering_amplitude: f64,
    /// Added to the feathering angle.
    pub feathering_offset_deg: f64,
    /// Lead of the feathering in wingbeats.
    pub feathering_lead: f64,
    /// Added to the deviation, in the sense of a right wing.
    pub deviation_offset_deg: f64,
    /// Added to the pitch of the stroke plane.
    pub stroke_plane_deg: f64,
}

impl Default for MotionCase {
    fn default() -> Self {
        Self {
            frequency_hz: None,
            stroke_plane_pitch_deg: None,
            data: None,
            start: StartCase::Smooth,
            start_beats: 1.0,
            phase: 0.0,
            adjust: AdjustCase::default(),
        }
    }
}

/// How the beat starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StartCase {
    /// From rest.
    Smooth,
    /// At full speed.
    Impulsive,
}

/// Motion of one wing; what is left out comes from `[motion]`. Angles follow the right-hand
/// rule about this wing's axes, so a left wing that mirrors a right one has phi and theta of
/// opposite sign.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WingMotionCase {
    /// A shipped set of measured wing angles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub data: Option<String>,
    /// Flap (stroke) angle about axis 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phi: Option<AngleCase>,
    /// Deviation out of the stroke plane about axis 3.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub theta: Option<AngleCase>,
    /// Feathering about axis 2; in hover 0 is the chord along the normal of the stroke plane
    /// and +-90 lies in the plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub psi: Option<AngleCase>,
    /// Pitch of this wing's stroke plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stroke_plane_pitch_deg: Option<f64>,
    /// Phase of this wing at t = 0 in wingbeats.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phase: Option<f64>,
}

/// One angle over the wingbeat.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AngleCase {
    /// `phi.constant_deg = 5`: the same angle at all times.
    ConstantDeg(f64),
    /// `[...phi.fourier]`: mean and harmonics.
    Fourier(FourierCase),
    /// `[...phi.smooth_triangle]`: Berman & Wang's stroke angle, sine (shape 0) to triangle
    /// (shape towards 1).
    SmoothTriangle(ShapedCase),
    /// `[...psi.smooth_square]`: Berman & Wang's feathering angle, sine (shape 0) to square wave
    /// (large shape).
    SmoothSquare(ShapedCase),
    /// `[...theta.oval]`: Berman & Wang's deviation, `count` oscillations a beat.
    Oval(OvalCase),
    /// `[...phi.table]`: samples over one beat, joined by a periodic cubic spline.
    Table(TableCase),
}

/// `mean + sum_k cosine_k cos(2 pi k x) + sine_k sin(2 pi k x)`, x in wingbeats, k = 1, 2, ...
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FourierCase {
    /// Mean (not halved).
    pub mean_deg: f64,
    /// Cosine coefficients of harmonics 1, 2, ...
    pub cosine_deg: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ...
    pub sine_deg: Vec<f64>,
}

/// A sine bent towards a triangle or square wave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShapedCase {
    /// Amplitude.
    pub amplitude_deg: f64,
    /// Shape: K in [0, 1) of the triangle, C >= 0 of the square.
    #[serde(default)]
    pub shape: f64,
    /// Phase shift of the sine.
    #[serde(default)]
    pub shift_deg: f64,
    /// Mean.
    #[serde(default)]
    pub mean_deg: f64,
}

/// `amplitude cos(2 pi count x + shift) + mean`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OvalCase {
    /// Amplitude.
    pub amplitude_deg: f64,
    /// Oscillations per beat: 1 an oval, 2 a figure of eight.
    pub count: usize,
    /// Phase shift of the cosine.
    #[serde(default)]
    pub shift_deg: f64,
    /// Mean.
    #[serde(default)]
    pub mean_deg: f64,
}

/// Samples over one beat; the last row repeats the first value one beat later.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TableCase {
    /// Rows [phase in wingbeats, angle in degrees].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows_deg: Option<Vec<[f64; 2]>>,
    /// CSV file with a header, path relative to the case file; lines from `#` are comments.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Column of the phase in wingbeats; default the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phase_column: Option<String>,
    /// Column of the angle in degrees; default the second.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle_column: Option<String>,
}
