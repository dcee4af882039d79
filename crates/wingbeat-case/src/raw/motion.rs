//! `[motion]` and `[wing.NAME.motion]`: how the wings beat.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use wingbeat_model::motion::Adjustment;

use super::Open;

/// What all wings share in their motion.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MotionCase {
    /// Wingbeat frequency. Default: that of the data set, else 0: wings that do not beat.
    ///
    /// Change it to what was measured.
    #[schemars(extend("minimum" = 0, "maximum" = 1_000_000))]
    #[serde(skip_serializing_if = "Open::is_open")]
    pub frequency_hz: Open<f64>,
    /// Pitch of the stroke plane in the body: the angle about b2 that carries b1 to the normal
    /// of the stroke plane. Hover with a horizontal stroke plane: body pitch + this = 90; with one inclined by beta, so that
    /// the downstroke goes forward and down: body pitch + this = 90 - beta.
    /// Default: that of the data set, else 0. Wings that other wings carry go along with these, and do not have it
    /// a second time.
    ///
    /// Change it for another posture: for hover to 90 less the pitch of the body.
    #[serde(skip_serializing_if = "Open::is_open")]
    pub stroke_plane_pitch_deg: Open<f64>,
    /// A shipped set of measured wing angles, for wings on the body without angles of their own; left out: none.
    ///
    /// Change it for measured angles; `wingbeat presets` lists the sets.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub data: Option<String>,
    /// How the beat starts. Tethers start by `flight.tether.start_s`, not by this: beside one that moves the body
    /// at the wingbeat frequency strokes that start smoothly are late by half of `start_beats`.
    ///
    /// Change it to `impulsive` to begin inside the periodic beat; loads then jump at the first instant.
    #[default(StartCase::Smooth)]
    pub start: StartCase,
    /// Length of a smooth start in wingbeats. Half of it is what the strokes are late from then on, behind laws
    /// of joints too.
    ///
    /// Change it to start more gently.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = "start = smooth"))]
    #[default = 1.0]
    pub start_beats: f64,
    /// Phase at t = 0 in wingbeats.
    ///
    /// Change it to start at another instant of the beat.
    pub phase: f64,
    /// Adjustments of all wings on the body on top of their angles, as trim finds them; wings that other wings carry
    /// go along, and a wing that stands still beside wings that beat (a tail) stays as it is.
    pub adjust: AdjustCase,
    /// By how much these adjustments are larger of right wings than of left ones: half to either side.
    pub difference: AdjustCase,
}

/// Adjustments of the wing angles: of `motion.adjust` the same on both sides by mirror symmetry, of
/// `motion.difference` those of right wings less those of left ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AdjustCase {
    /// Relative change of the stroke's swing about its mean.
    ///
    /// Change it to trim or steer.
    pub stroke_amplitude: f64,
    /// Added to the stroke angle, positive forward.
    ///
    /// Change it to trim or steer: forward pitches the nose up.
    pub stroke_offset_deg: f64,
    /// Relative change of the feathering's swing about its mean.
    ///
    /// Change it to trim or steer.
    pub feathering_amplitude: f64,
    /// Added to the feathering angle.
    ///
    /// Change it to trim or steer.
    pub feathering_offset_deg: f64,
    /// Lead of the feathering in wingbeats.
    ///
    /// Change it to trim or steer: wings that turn before the stroke reverses.
    pub feathering_lead: f64,
    /// Added to the deviation, in the sense of a right wing.
    ///
    /// Change it to trim or steer.
    pub deviation_offset_deg: f64,
    /// Added to the pitch of the stroke plane.
    ///
    /// Change it to trim or steer.
    pub stroke_plane_deg: f64,
}

impl MotionCase {
    /// Names of the keys beside frequency and data set whose values are not the default, in a resolved case.
    pub(crate) fn unlike_default(&self) -> Vec<&'static str> {
        let plain = Self::default();
        let pitch = self.stroke_plane_pitch_deg.value();
        let differ = [
            ("stroke_plane_pitch_deg", pitch != 0.0),
            ("phase", self.phase != plain.phase),
            ("adjust", self.adjust != plain.adjust),
            ("difference", self.difference != plain.difference),
            ("start", self.start != plain.start),
            ("start_beats", self.start_beats != plain.start_beats),
        ];
        let differ = differ.into_iter().filter(|(_, differs)| *differs);
        differ.map(|(key, _)| key).collect()
    }
}

impl From<&AdjustCase> for Adjustment {
    fn from(case: &AdjustCase) -> Self {
        Self {
            stroke_amplitude: case.stroke_amplitude,
            stroke_offset: case.stroke_offset_deg.to_radians(),
            feathering_amplitude: case.feathering_amplitude,
            feathering_offset: case.feathering_offset_deg.to_radians(),
            feathering_lead: case.feathering_lead,
            deviation_offset: case.deviation_offset_deg.to_radians(),
            stroke_plane: case.stroke_plane_deg.to_radians(),
            frequency: 0.0,
        }
    }
}

/// How the beat starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StartCase {
    /// From rest over `start_beats`.
    Smooth,
    /// At full speed from the first instant.
    Impulsive,
}

/// Motion of one wing. A wing that gives no angles takes what it leaves out from the mirror image of the motion
/// of its counterpart; where either gives none, or this one gives angles, it comes from `[motion]`. Angles
/// follow the right-hand rule about this wing's axes, so a left wing that mirrors a right one has phi and theta
/// of opposite sign.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WingMotionCase {
    /// A shipped set of measured wing angles. Left out: that of `[motion]`; none of a wing that another wing carries.
    ///
    /// Change it for wings that beat differently.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub data: Option<String>,
    /// Flap (stroke) angle about axis 1 of the right wing, growing forward (in the downstroke); 0 is straight
    /// out. Left out: that of the data set, else 0.
    ///
    /// Change it for angles of your own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phi: Option<AngleCase>,
    /// Deviation out of the stroke plane about axis 3 of the right wing, in hover growing downward. Left out:
    /// that of the data set, else 0.
    ///
    /// Change it for angles of your own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub theta: Option<AngleCase>,
    /// Feathering about axis 2 of the right wing; in hover 0 is the chord along the normal of the stroke plane
    /// and +-90 lies in the plane; near -50 in the downstroke, when the leading edge leads, near +50 in the
    /// upstroke. Left out: that of the data set, else 0.
    ///
    /// Change it for angles of your own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub psi: Option<AngleCase>,
    /// Pitch of this wing's stroke plane. Left out: that of `[motion]`; 0, the axes of its carrier, of a wing that
    /// another wing carries.
    ///
    /// Change it for wings that beat in planes of their own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stroke_plane_pitch_deg: Option<f64>,
    /// Phase of this wing at t = 0 in wingbeats. Left out: that of `[motion]`.
    ///
    /// Change it for wings that beat out of phase, as those of dragonflies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phase: Option<f64>,
}

/// Names of the angles of a wing, as keys.
pub(crate) const ANGLES: [&str; 3] = ["phi", "theta", "psi"];

impl WingMotionCase {
    /// The angles that the case gives, with their names.
    pub(crate) fn angles(&self) -> impl Iterator<Item = (&'static str, &AngleCase)> {
        let all = [&self.phi, &self.theta, &self.psi].map(Option::as_ref);
        ANGLES
            .into_iter()
            .zip(all)
            .filter_map(|(name, angle)| Some((name, angle?)))
    }

    /// The same to be changed.
    pub(crate) fn angles_mut(&mut self) -> impl Iterator<Item = (&'static str, &mut AngleCase)> {
        let all = [&mut self.phi, &mut self.theta, &mut self.psi].map(Option::as_mut);
        ANGLES
            .into_iter()
            .zip(all)
            .filter_map(|(name, angle)| Some((name, angle?)))
    }
}

/// One angle over the wingbeat.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AngleCase {
    /// The same angle at all times.
    ConstantDeg(f64),
    /// Mean and harmonics.
    Fourier(FourierCase),
    /// Berman & Wang's stroke angle, sine (shape 0) to triangle (shape towards 1).
    SmoothTriangle(ShapedCase),
    /// Berman & Wang's feathering angle, sine (shape 0) to square wave (large shape).
    SmoothSquare(ShapedCase),
    /// Berman & Wang's deviation, `count` oscillations a beat.
    Oval(OvalCase),
    /// Split-cycle strokes (Doman et al. 2009): half strokes of unequal length.
    SplitCycle(SplitCycleCase),
    /// Samples over one beat, joined by a periodic cubic spline or fitted by a Fourier series.
    Table(TableCase),
}

/// `mean + sum_k cosine_k cos(2 pi k x) + sine_k sin(2 pi k x)`, x in wingbeats, k = 1, 2, ...
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FourierCase {
    /// Mean (not halved).
    ///
    /// Change it to what was measured.
    pub mean_deg: f64,
    /// Cosine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to what was measured.
    pub cosine_deg: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ...
    ///
    /// Change it to what was measured.
    pub sine_deg: Vec<f64>,
}

/// A sine bent towards a triangle or square wave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShapedCase {
    /// Amplitude.
    ///
    /// Change it to what was measured.
    pub amplitude_deg: f64,
    /// Shape: K in [0, 1) of the triangle, C >= 0 of the square.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    #[serde(default)]
    pub shape: f64,
    /// Phase shift of the sine.
    ///
    /// Change it to what was measured.
    #[serde(default)]
    pub shift_deg: f64,
    /// Mean.
    ///
    /// Change it to what was measured.
    #[serde(default)]
    pub mean_deg: f64,
}

/// `amplitude cos(2 pi count x + shift) + mean`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OvalCase {
    /// Amplitude.
    ///
    /// Change it to what was measured.
    pub amplitude_deg: f64,
    /// Oscillations per beat: 1 an oval, 2 a figure of eight.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 1))]
    pub count: usize,
    /// Phase shift of the cosine.
    ///
    /// Change it to what was measured.
    #[serde(default)]
    pub shift_deg: f64,
    /// Mean.
    ///
    /// Change it to what was measured.
    #[serde(default)]
    pub mean_deg: f64,
}

/// A cosine from `mean + amplitude` to `mean - amplitude` in the first part of the beat and back in the rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SplitCycleCase {
    /// Amplitude.
    ///
    /// Change it to that of the stroke; negative begins at the other end.
    pub amplitude_deg: f64,
    /// Part of the beat that the first half stroke takes; 0.5 is a cosine.
    ///
    /// Change it to steer: the quicker half stroke drags more.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    #[serde(default = "half")]
    pub first_share: f64,
    /// Phase shift.
    ///
    /// Change it to begin at another instant.
    #[serde(default)]
    pub shift_deg: f64,
    /// Mean.
    ///
    /// Change it to move the stroke forward or backward.
    #[serde(default)]
    pub mean_deg: f64,
}

fn half() -> f64 {
    0.5
}

/// Samples over one beat, the last row the first value one beat later; samples to be fitted (`harmonics`) may
/// be those of several beats.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TableCase {
    /// Rows [phase in wingbeats, angle in degrees].
    ///
    /// Change it to what was measured.
    #[schemars(length(min = 4))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows_deg: Option<Vec<[f64; 2]>>,
    /// CSV file with a header, path relative to the case file; lines from `#` are comments, rows whose angle is empty
    /// or `NaN` are left out.
    ///
    /// Change it for tables of many rows.
    #[schemars(extend("or" = "rows_deg"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Column of the phase in wingbeats. Left out: the first.
    ///
    /// Change it where the file has other columns first.
    #[schemars(extend("with" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phase_column: Option<String>,
    /// Column of the angle, in radians where its name says `rad` (`psi_rad`), else in degrees. Left out: the second.
    ///
    /// Change it where the file has other columns first.
    #[schemars(extend("with" = "file"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle_column: Option<String>,
    /// Wingbeats in one unit of the first column: the wingbeat frequency in Hz for times in seconds, in kHz
    /// for ms, frequency over frame rate for frames. Left out: 1, phases.
    ///
    /// Change it for recordings over time; with `harmonics` they may go on over several wingbeats.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beats_per_unit: Option<f64>,
    /// What the angles of the table are multiplied by before `offset_deg` is added. Left out: 1.
    ///
    /// Change it to -1 for angles that count the other way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub factor: Option<f64>,
    /// What is added to the angles of the table. Left out: 0.
    ///
    /// Change it for angles with another zero: a rotation angle counted from the stroke plane is 90 deg less it
    /// (factor -1, offset 90).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub offset_deg: Option<f64>,
    /// Harmonics of a Fourier series fitted to the samples by least squares; two neighbouring phases must be
    /// less than 1 / (2 harmonics) wingbeats apart, phases may repeat or go on over several beats, which are
    /// folded into one, and the beat need not close. Left out: the spline, which goes through every sample.
    ///
    /// Change it for samples that scatter: as many as stand out of the noise, 4 to 10 for strokes; `wingbeat
    /// check` tells how many do, and what a fit leaves.
    #[schemars(range(min = 1))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub harmonics: Option<usize>,
}
