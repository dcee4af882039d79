//! Control derivatives: mean loads by the means of steering, wing by wing.

use wingbeat_flight::{FlightSetup, faster};
use wingbeat_math::{DMat3, DVec3};
use wingbeat_model::motion::Adjustment;
use wingbeat_model::{AngleLaw, Wing, WingMotion};

use crate::AnalysisError;
use crate::beat::Beat;
use crate::level::Level;
use crate::mean::MeanLoad;
use crate::progress;

/// A means of steering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Relative change of the stroke amplitude \[1\].
    StrokeAmplitude,
    /// Mean stroke angle, positive forward \[rad\].
    StrokeOffset,
    /// Relative change of the frequency \[1\] (of all wings, and of the joints that are driven, only).
    Frequency,
    /// Stroke-plane pitch \[rad\].
    StrokePlane,
    /// Mean feathering angle \[rad\].
    FeatheringOffset,
    /// Lead of feathering \[wingbeats\].
    FeatheringLead,
    /// Mean deviation \[rad\].
    DeviationOffset,
    /// Part of the beat that the first half stroke takes \[1\], of split-cycle strokes only.
    StrokeSplit,
}

/// All controls with their names.
pub const CONTROL_NAMES: [(Control, &str); 8] = [
    (Control::StrokeAmplitude, "stroke_amplitude"),
    (Control::StrokeOffset, "stroke_offset"),
    (Control::Frequency, "frequency"),
    (Control::StrokePlane, "stroke_plane"),
    (Control::FeatheringOffset, "feathering_offset"),
    (Control::FeatheringLead, "feathering_lead"),
    (Control::DeviationOffset, "deviation_offset"),
    (Control::StrokeSplit, "stroke_split"),
];

impl Control {
    /// The motion of `wing` with `x` of this control.
    fn steered(self, wing: &Wing, x: f64) -> WingMotion {
        let mut motion = wing.motion.clone();
        let mut a = Adjustment::default();
        match self {
            Self::StrokeAmplitude => a.stroke_amplitude = x,
            Self::StrokeOffset => a.stroke_offset = x,
            Self::Frequency => a.frequency = x,
            Self::StrokePlane => a.stroke_plane = x,
            Self::FeatheringOffset => a.feathering_offset = x,
            Self::FeatheringLead => a.feathering_lead = x,
            Self::DeviationOffset => a.deviation_offset = x,
            Self::StrokeSplit => motion.angles.phi = motion.angles.phi.split_by(x),
        }
        motion.adjusted(wing.side, &a)
    }

    /// Whether any of the wings answers to it.
    fn is_had(self, wings: &[Wing]) -> bool {
        let split = |w: &Wing| matches!(w.motion.angles.phi, AngleLaw::SplitCycle(_));
        self != Self::StrokeSplit || wings.iter().any(split)
    }
}

/// Derivative of the mean load by a control of one wing or all.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlDerivative {
    /// Name of the control.
    pub control: &'static str,
    /// The wing's name, or "all".
    pub wing: String,
    /// Derivatives of force \[N\] and moment [N m] about the mean mass centre, level frame, per unit
    /// of the control.
    pub derivative: MeanLoad,
}

/// Control derivatives about steady flight with the attitude `rotation` (root to N) and the
/// velocity `velocity` (level frame) [m/s], by central differences.
///
/// # Errors
/// A setup that [`Beat`] does not cover.
pub fn control_derivatives(
    setup: &FlightSetup,
    rotation: DMat3,
    velocity: DVec3,
    steps: usize,
) -> Result<Vec<ControlDerivative>, AnalysisError> {
    const STEP: f64 = 1e-4;
    let wings = setup.animal.wings.len();
    let mut list = vec![];
    let had = CONTROL_NAMES
        .iter()
        .filter(|c| c.0.is_had(&setup.animal.wings));
    let had: Vec<_> = had.copied().collect();
    for (k, &(control, name)) in had.iter().enumerate() {
        progress::task(&format!("derivatives by {name}"), k, had.len());
        let single = (0..wings)
            .map(Some)
            .filter(|_| control != Control::Frequency);
        for chosen in single.chain([None]) {
            let at = |x: f64| -> Result<MeanLoad, AnalysisError> {
                let mut setup = setup.clone();
                for (k, wing) in setup.animal.wings.iter_mut().enumerate() {
                    if chosen.is_none_or(|c| c == k) {
                        wing.motion = control.steered(wing, x);
                    }
                }
                if control == Control::Frequency {
                    for joint in &mut setup.joints {
                        *joint = faster(joint, 1.0 + x);
                    }
                }
                let level = Level::new(rotation, setup.gravity);
                let beat = Beat::new(&setup, steps)?;
                beat.mean_load(&level, velocity, DVec3::ZERO)
            };
            let (plus, minus) = (at(STEP)?, at(-STEP)?);
            list.push(ControlDerivative {
                control: name,
                wing: chosen.map_or("all".into(), |k| setup.animal.wings[k].name.clone()),
                derivative: MeanLoad {
                    force: (plus.force - minus.force) / (2.0 * STEP),
                    moment: (plus.moment - minus.moment) / (2.0 * STEP),
                },
            });
        }
    }
    Ok(list)
}
