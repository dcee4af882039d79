//! Control derivatives: mean loads by the means of steering, wing by wing.

use wingbeat_flight::FlightSetup;
use wingbeat_math::{DMat3, DVec3, Wrench};
use wingbeat_model::{AngleLaw, Wing};

use crate::AnalysisError;
use crate::beat::Beat;
use crate::beat::level::Level;
use crate::progress;
use crate::trim::unknown::{Unknown, adjusted};

/// A means of steering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// One that trims choose, too; the frequency (of all wings, and of the joints that are driven, only).
    Trimmed(Unknown),
    /// Part of the beat that the first half stroke takes \[1\], of split-cycle strokes only.
    StrokeSplit,
}

impl Control {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Trimmed(Unknown::StrokeAmplitude),
        Self::Trimmed(Unknown::StrokeOffset),
        Self::FREQUENCY,
        Self::Trimmed(Unknown::StrokePlane),
        Self::Trimmed(Unknown::FeatheringOffset),
        Self::Trimmed(Unknown::FeatheringLead),
        Self::Trimmed(Unknown::DeviationOffset),
        Self::StrokeSplit,
    ];

    const FREQUENCY: Self = Self::Trimmed(Unknown::Frequency);

    /// Name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Trimmed(unknown) => unknown.name(),
            Self::StrokeSplit => "stroke_split",
        }
    }

    /// The flyer with `x` of this control of all wings, or of the wing `chosen`.
    fn steered(self, setup: &FlightSetup, chosen: Option<usize>, x: f64) -> FlightSetup {
        let mut all = match self {
            Self::Trimmed(unknown) => adjusted(setup, &[unknown], [0.0; 2], &[x]).setup,
            Self::StrokeSplit => {
                let mut setup = setup.clone();
                for wing in &mut setup.animal.wings {
                    wing.motion.angles.phi = wing.motion.angles.phi.split_by(x);
                }
                setup
            }
        };
        let wings = all.animal.wings.iter_mut().zip(&setup.animal.wings);
        for (k, (wing, unsteered)) in wings.enumerate() {
            if chosen.is_some_and(|c| c != k) {
                wing.motion = unsteered.motion.clone();
            }
        }
        all
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
    pub derivative: Wrench,
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
    let had = Control::ALL.into_iter();
    let had: Vec<_> = had.filter(|c| c.is_had(&setup.animal.wings)).collect();
    for (k, &control) in had.iter().enumerate() {
        let name = control.name();
        progress::task(&format!("derivatives by {name}"), k, had.len());
        let single = (0..wings)
            .map(Some)
            .filter(|_| control != Control::FREQUENCY);
        for chosen in single.chain([None]) {
            let at = |x: f64| -> Result<Wrench, AnalysisError> {
                let level = Level::new(rotation, setup.gravity);
                let beat = Beat::new(&control.steered(setup, chosen, x), steps)?;
                beat.mean_load(&level, velocity, DVec3::ZERO)
            };
            let (plus, minus) = (at(STEP)?, at(-STEP)?);
            list.push(ControlDerivative {
                control: name,
                wing: chosen.map_or("all".into(), |k| setup.animal.wings[k].name.clone()),
                derivative: Wrench {
                    force: (plus.force - minus.force) / (2.0 * STEP),
                    moment: (plus.moment - minus.moment) / (2.0 * STEP),
                },
            });
        }
    }
    Ok(list)
}
