//! The controls that a trim may choose, and the animal with them.

use std::f64::consts::{FRAC_PI_3, PI};

use wingbeat_dynamics::{Element, ElementLaw, Joint};
use wingbeat_flight::{FlightSetup, faster};
use wingbeat_math::{DMat3, DVec3};
use wingbeat_model::motion::Adjustment;

use crate::AnalysisError;
use crate::trim::tail::tail_wings;

/// The air is incompressible: speeds are below that of sound [m/s].
pub const SPEED_OF_SOUND: f64 = 340.0;

/// A control or a speed that trim may choose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// Relative change of the stroke amplitude.
    StrokeAmplitude,
    /// Mean stroke angle, positive forward \[rad\].
    StrokeOffset,
    /// Relative change of the frequency.
    Frequency,
    /// Change of the stroke-plane pitch \[rad\].
    StrokePlane,
    /// Change of the mean feathering angle \[rad\].
    FeatheringOffset,
    /// Lead of feathering \[wingbeats\].
    FeatheringLead,
    /// Change of the mean deviation \[rad\].
    DeviationOffset,
    /// Pitch of the body \[rad\]; when it is not chosen, it is kept and one more control is needed.
    BodyPitch,
    /// Mass centre of the body along b1, relative to the hinges, in wing lengths.
    MassCentre,
    /// Change of the feathering angle of the tail, leading edge up \[rad\]: the elevator.
    TailIncidence,
    /// Relative change of what drives joints, moments and forces that are given and the swing of angles that are followed:
    /// the voltage of motors \[1\].
    DriveAmplitude,
    /// Mean velocity along n1 [m/s].
    Forward,
    /// Mean velocity along -n3 [m/s].
    Climb,
    /// Roll of the body, right side down \[rad\].
    BodyRoll,
    /// Relative amplitude of right wings less that of left ones.
    StrokeAmplitudeDifference,
    /// Mean stroke angle of right wings less that of left ones, positive forward \[rad\].
    StrokeOffsetDifference,
    /// Stroke-plane pitch of right wings less that of left ones \[rad\].
    StrokePlaneDifference,
    /// Mean feathering angle of right wings less that of left ones \[rad\].
    FeatheringOffsetDifference,
    /// Mean deviation of right wings less that of left ones \[rad\].
    DeviationOffsetDifference,
}

/// What the value of an unknown counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnknownKind {
    /// A change relative to what the animal has \[1\].
    Relative,
    /// Wingbeats.
    Beats,
    /// Wing lengths.
    WingLengths,
    /// An angle \[rad\].
    Angle,
    /// A speed [m/s].
    Speed,
}

/// All unknowns with their names in cases and reports.
pub const UNKNOWNS: [(Unknown, &str); 19] = [
    (Unknown::StrokeAmplitude, "stroke_amplitude"),
    (Unknown::StrokeOffset, "stroke_offset"),
    (Unknown::Frequency, "frequency"),
    (Unknown::StrokePlane, "stroke_plane"),
    (Unknown::FeatheringOffset, "feathering_offset"),
    (Unknown::FeatheringLead, "feathering_lead"),
    (Unknown::DeviationOffset, "deviation_offset"),
    (Unknown::BodyPitch, "body_pitch"),
    (Unknown::MassCentre, "mass_centre"),
    (Unknown::TailIncidence, "tail_incidence"),
    (Unknown::DriveAmplitude, "drive_amplitude"),
    (Unknown::Forward, "forward"),
    (Unknown::Climb, "climb"),
    (Unknown::BodyRoll, "body_roll"),
    (
        Unknown::StrokeAmplitudeDifference,
        "stroke_amplitude_difference",
    ),
    (Unknown::StrokeOffsetDifference, "stroke_offset_difference"),
    (Unknown::StrokePlaneDifference, "stroke_plane_difference"),
    (
        Unknown::FeatheringOffsetDifference,
        "feathering_offset_difference",
    ),
    (
        Unknown::DeviationOffsetDifference,
        "deviation_offset_difference",
    ),
];

impl Unknown {
    /// Name in cases and reports.
    pub fn name(self) -> &'static str {
        let found = UNKNOWNS.iter().find(|u| u.0 == self);
        found.expect("the table holds all").1
    }

    /// The unknown of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        UNKNOWNS.iter().find(|u| u.1 == name).map(|u| u.0)
    }

    /// What its value counts.
    pub fn kind(self) -> UnknownKind {
        match self {
            Self::StrokeAmplitude
            | Self::Frequency
            | Self::DriveAmplitude
            | Self::StrokeAmplitudeDifference => UnknownKind::Relative,
            Self::FeatheringLead => UnknownKind::Beats,
            Self::MassCentre => UnknownKind::WingLengths,
            Self::Forward | Self::Climb => UnknownKind::Speed,
            _ => UnknownKind::Angle,
        }
    }

    /// Whether it parts right from left.
    pub fn is_lateral(self) -> bool {
        use Unknown::{
            BodyRoll, DeviationOffsetDifference, FeatheringOffsetDifference,
            StrokeAmplitudeDifference, StrokeOffsetDifference, StrokePlaneDifference,
        };
        matches!(
            self,
            BodyRoll
                | StrokeAmplitudeDifference
                | StrokeOffsetDifference
                | StrokePlaneDifference
                | FeatheringOffsetDifference
                | DeviationOffsetDifference
        )
    }
}

/// Between what an unknown must lie, in its own unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// The unknown.
    pub unknown: Unknown,
    /// Least value \[1 or rad\].
    pub from: f64,
    /// Largest value \[1 or rad\].
    pub to: f64,
}

impl Bound {
    /// What holds unless told otherwise: what wings that are still wings can do.
    pub fn default_of(unknown: Unknown) -> Self {
        let (from, to) = match unknown {
            Unknown::StrokeAmplitude | Unknown::Frequency | Unknown::DriveAmplitude => (-0.7, 2.0),
            Unknown::StrokeAmplitudeDifference => (-1.0, 1.0),
            Unknown::BodyPitch | Unknown::BodyRoll => (-PI, PI),
            Unknown::FeatheringLead => (-0.25, 0.25),
            Unknown::MassCentre => (-1.0, 1.0),
            Unknown::Forward | Unknown::Climb => (-SPEED_OF_SOUND, SPEED_OF_SOUND),
            _ => (-FRAC_PI_3, FRAC_PI_3),
        };
        Self { unknown, from, to }
    }

    /// Refuses a relative change with which wings stand still or stroke the other way round.
    ///
    /// # Errors
    /// What is allowed.
    pub fn check(&self) -> Result<(), String> {
        let (least, most, allowed) = match self.unknown {
            Unknown::StrokeAmplitude | Unknown::Frequency | Unknown::DriveAmplitude => {
                (-1.0, f64::INFINITY, "above -1")
            }
            Unknown::StrokeAmplitudeDifference => (-2.0, 2.0, "above -2 and below 2"),
            _ => return Ok(()),
        };
        match self.from > least && self.to < most {
            true => Ok(()),
            false => Err(format!(
                "{} from {} to {} has wings that stand still or stroke the other way round: its values are parts of 1, not percent, {allowed}; -0.2..0.2 is 20 % less to 20 % more",
                self.unknown.name(),
                self.from,
                self.to
            )),
        }
    }

    /// By how much `x` is inside; negative outside.
    pub(crate) fn room(&self, x: f64) -> f64 {
        (x - self.from).min(self.to - x)
    }

    /// Whether `x` is outside by more than rounding.
    pub(crate) fn excludes(&self, x: f64) -> bool {
        self.room(x) < -self.rounding()
    }

    /// Whether `x` is on a bound, or inside by no more than `within`.
    pub(crate) fn is_reached(&self, x: f64, within: f64) -> bool {
        !self.excludes(x) && self.room(x) <= within + self.rounding()
    }

    /// Rounding of values as large as the bounds.
    fn rounding(&self) -> f64 {
        4.0 * f64::EPSILON * self.from.abs().max(self.to.abs())
    }
}

/// What the values of unknowns make of an animal.
#[derive(Clone, Debug)]
pub(crate) struct Adjusted {
    /// The animal with all of it.
    pub setup: FlightSetup,
    /// Of all wings.
    pub adjustment: Adjustment,
    /// Of right wings less that of left ones.
    pub difference: Adjustment,
    /// Shift of the mass centre along b1 [m].
    pub mass_centre: f64,
    /// Change of the feathering angle of the tail \[rad\].
    pub tail_incidence: f64,
    /// Relative change of what drives joints \[1\].
    pub drive_amplitude: f64,
    /// Pitch of the body \[rad\].
    pub pitch: f64,
    /// Roll of the body \[rad\].
    pub roll: f64,
}

/// An error if an unknown is not what it says for what `setup` has: a tail, drives.
pub(crate) fn check_unknowns(
    setup: &FlightSetup,
    unknowns: &[Unknown],
) -> Result<(), AnalysisError> {
    if unknowns.contains(&Unknown::TailIncidence) {
        tail_wings(setup)?;
    }
    match unknowns.contains(&Unknown::DriveAmplitude) && !has_drives(setup) {
        false => Ok(()),
        true => Err(AnalysisError::not_covered(
            "drive_amplitude changes what actuators of joints exert or follow, and no joint has one",
            "choose other unknowns, as stroke_amplitude for strokes that are prescribed, or give a [[joint.NAME.element]] with moment_newton_m or follow",
        )),
    }
}

/// Whether actuators of joints exert anything, or follow angles that swing.
pub(crate) fn has_drives(setup: &FlightSetup) -> bool {
    (setup.joints.iter()).any(|joint| driven(joint, 1.0) != joint.model.elements)
}

/// Whether the mass centre is shifted in the body itself, as a battery is: where joints, springs or loads have places of
/// their own on the body. Elsewhere the hinges of the wings are shifted the other way.
pub fn shifts_body(setup: &FlightSetup) -> bool {
    !setup.joints.is_empty()
        || setup.springs.iter().any(|s| s.bodies.contains(&0))
        || setup
            .loads
            .iter()
            .any(|l| l.body == 0 && l.point != DVec3::ZERO)
}

/// The elements of a joint with `by` \[1\] more of what drives it: moments and forces that are given, and how far the
/// angles swing that actuators follow.
fn driven(joint: &Joint, by: f64) -> Vec<Element> {
    let mut elements = joint.model.elements.clone();
    let factor = 1.0 + by;
    for element in &mut elements {
        let (ElementLaw::Effort(series) | ElementLaw::Follow { target: series, .. }) =
            &mut element.law
        else {
            continue;
        };
        let harmonics = series.cosine.iter_mut().chain(&mut series.sine);
        harmonics.for_each(|x| *x *= factor);
        if let ElementLaw::Effort(series) = &mut element.law {
            series.constant *= factor;
        }
    }
    elements
}

/// The setup with the values of `unknowns`; a body attitude that is not among them is `pitch` and `roll`.
pub(crate) fn adjusted(
    setup: &FlightSetup,
    unknowns: &[Unknown],
    [mut pitch, mut roll]: [f64; 2],
    values: &[f64],
) -> Adjusted {
    let mut a = Adjustment::default();
    let mut d = Adjustment::default();
    let [mut shift, mut tail_incidence, mut drive_amplitude] = [0.0; 3];
    for (unknown, &x) in unknowns.iter().zip(values) {
        match unknown {
            Unknown::StrokeAmplitude => a.stroke_amplitude = x,
            Unknown::StrokeOffset => a.stroke_offset = x,
            Unknown::Frequency => a.frequency = x,
            Unknown::StrokePlane => a.stroke_plane = x,
            Unknown::FeatheringOffset => a.feathering_offset = x,
            Unknown::FeatheringLead => a.feathering_lead = x,
            Unknown::DeviationOffset => a.deviation_offset = x,
            Unknown::BodyPitch => pitch = x,
            Unknown::MassCentre => shift = x,
            Unknown::TailIncidence => tail_incidence = x,
            Unknown::DriveAmplitude => drive_amplitude = x,
            Unknown::Forward | Unknown::Climb => {} // of the flight, not of the animal
            Unknown::BodyRoll => roll = x,
            Unknown::StrokeAmplitudeDifference => d.stroke_amplitude = x,
            Unknown::StrokeOffsetDifference => d.stroke_offset = x,
            Unknown::StrokePlaneDifference => d.stroke_plane = x,
            Unknown::FeatheringOffsetDifference => d.feathering_offset = x,
            Unknown::DeviationOffsetDifference => d.deviation_offset = x,
        }
    }
    let mut setup = setup.clone();
    shift *= setup.animal.wing_length();
    let in_body = shifts_body(&setup);
    let adjusted: Vec<bool> = (0..setup.animal.wings.len())
        .map(|w| setup.is_adjusted(w))
        .collect();
    for (wing, is_adjusted) in setup.animal.wings.iter_mut().zip(adjusted) {
        let own = a.on(wing.side, &d);
        let own = if is_adjusted { own } else { own.on_wing() };
        wing.motion = wing.motion.adjusted(wing.side, &own);
        if !in_body {
            wing.hinge_b.x -= shift;
        }
    }
    if in_body && shift != 0.0 {
        let body = &mut setup.animal.body;
        *body = body.moved(DMat3::IDENTITY, shift * DVec3::X);
    }
    if tail_incidence != 0.0
        && let Ok(tail) = tail_wings(&setup)
    {
        let elevator = Adjustment {
            feathering_offset: tail_incidence,
            ..Adjustment::default()
        };
        for w in tail {
            let wing = &mut setup.animal.wings[w];
            wing.motion = wing.motion.adjusted(wing.side, &elevator);
        }
    }
    if drive_amplitude != 0.0 {
        for joint in &mut setup.joints {
            joint.model.elements = driven(joint, drive_amplitude);
        }
    }
    if a.frequency != 0.0 {
        for joint in &mut setup.joints {
            *joint = faster(joint, 1.0 + a.frequency);
        }
    }
    Adjusted {
        setup,
        adjustment: a,
        difference: d,
        mass_centre: shift,
        tail_incidence,
        drive_amplitude,
        pitch,
        roll,
    }
}
