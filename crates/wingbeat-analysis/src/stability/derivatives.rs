//! Control derivatives: mean loads by the means of steering, wing by wing.

use wingbeat_flight::FlightSetup;
use wingbeat_math::{DMat3, DVec3, Wrench};
use wingbeat_model::{AngleLaw, Wing};

use crate::AnalysisError;
use crate::beat::Beat;
use crate::beat::level::Level;
use crate::progress;
use crate::trim::unknown::{Unknown, UnknownKind, adjusted};

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

    /// Unit in which its values count.
    pub fn unit(self) -> &'static str {
        match self {
            Self::StrokeSplit => "1",
            Self::Trimmed(unknown) => match unknown.kind() {
                UnknownKind::Relative => "1",
                UnknownKind::Beats => "wingbeat",
                _ => "rad",
            },
        }
    }

    /// The flyer with `x` of this control of all wings that are steered together ([`FlightSetup::is_adjusted`]), or of the
    /// wing `chosen` alone, whichever it is: a tail, a hand wing in the axes of its arm wing.
    pub(crate) fn steered(self, setup: &FlightSetup, chosen: Option<usize>, x: f64) -> FlightSetup {
        let mut steered = setup.clone();
        let wings = steered.animal.wings.iter_mut().enumerate();
        let meant = wings.filter(|(k, _)| chosen.is_none_or(|c| c == *k));
        let meant = meant.map(|(_, wing)| wing);
        match self {
            Self::Trimmed(unknown) => {
                let all = adjusted(setup, &[unknown], [0.0; 2], &[x]);
                if chosen.is_none() {
                    return all.setup;
                }
                let by = &all.adjustment;
                meant.for_each(|wing| wing.motion = wing.motion.adjusted(wing.side, by));
            }
            Self::StrokeSplit => meant.for_each(|wing| {
                wing.motion.angles.phi = wing.motion.angles.phi.split_by(x);
            }),
        }
        steered
    }

    /// Those that act on wings which stand still.
    pub(crate) const OF_STILL_WINGS: [Self; 4] = [
        Self::Trimmed(Unknown::StrokeOffset),
        Self::Trimmed(Unknown::StrokePlane),
        Self::Trimmed(Unknown::FeatheringOffset),
        Self::Trimmed(Unknown::DeviationOffset),
    ];

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
    /// Unit of the control.
    pub unit: &'static str,
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
    let level = Level::new(rotation, setup.gravity);
    let load = |steered: &FlightSetup, _| {
        Beat::new(steered, steps)?.mean_load(&level, velocity, DVec3::ZERO)
    };
    differences(setup, &Control::ALL, STEP, load)
}

/// Central differences, over this `step` of each of the `controls` that the flyer has, of the `load` of the steered
/// flyer about the mass centre, level components; with it goes the number of the wing that is steered, none where all
/// are.
///
/// # Errors
/// Those of the loads.
pub(crate) fn differences(
    setup: &FlightSetup,
    controls: &[Control],
    step: f64,
    load: impl Fn(&FlightSetup, Option<usize>) -> Result<Wrench, AnalysisError>,
) -> Result<Vec<ControlDerivative>, AnalysisError> {
    let wings = setup.animal.wings.len();
    let mut list = vec![];
    let had = controls.iter().copied();
    let had: Vec<_> = had.filter(|c| c.is_had(&setup.animal.wings)).collect();
    for (k, &control) in had.iter().enumerate() {
        let name = control.name();
        progress::task(&format!("derivatives by {name}"), k, had.len());
        let single = (0..wings)
            .map(Some)
            .filter(|_| control != Control::FREQUENCY);
        for chosen in single.chain([None]) {
            let at = |x: f64| load(&control.steered(setup, chosen, x), chosen);
            let (plus, minus) = (at(step)?, at(-step)?);
            list.push(ControlDerivative {
                control: name,
                unit: control.unit(),
                wing: chosen.map_or("all".into(), |k| setup.animal.wings[k].name.clone()),
                derivative: Wrench {
                    force: (plus.force - minus.force) / (2.0 * step),
                    moment: (plus.moment - minus.moment) / (2.0 * step),
                },
            });
        }
    }
    Ok(list)
}
