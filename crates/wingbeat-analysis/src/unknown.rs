//! The controls that a trim may choose, and the animal with them.

use wingbeat_flight::{FlightSetup, faster};
use wingbeat_model::motion::Adjustment;

use crate::AnalysisError;

/// A control that trim may choose.
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
    /// Mass centre along b1, relative to the hinges, in wing lengths.
    MassCentre,
}

/// All unknowns with their names in cases and reports.
pub const UNKNOWNS: [(Unknown, &str); 9] = [
    (Unknown::StrokeAmplitude, "stroke_amplitude"),
    (Unknown::StrokeOffset, "stroke_offset"),
    (Unknown::Frequency, "frequency"),
    (Unknown::StrokePlane, "stroke_plane"),
    (Unknown::FeatheringOffset, "feathering_offset"),
    (Unknown::FeatheringLead, "feathering_lead"),
    (Unknown::DeviationOffset, "deviation_offset"),
    (Unknown::BodyPitch, "body_pitch"),
    (Unknown::MassCentre, "mass_centre"),
];

impl Unknown {
    /// Name in cases and reports.
    pub fn name(self) -> &'static str {
        let found = UNKNOWNS.iter().find(|u| u.0 == self);
        found.expect("the table holds all").1
    }
}

/// An error if an unknown is not what it says for the joints of `setup`.
pub(crate) fn check_unknowns(
    setup: &FlightSetup,
    unknowns: &[Unknown; 3],
) -> Result<(), AnalysisError> {
    match setup.joints.first() {
        Some(joint) if unknowns.contains(&Unknown::MassCentre) => Err(AnalysisError::not_covered(
            format!(
                "mass_centre shifts the hinges of wings against the body, and joint `{}` has a place of its own",
                joint.name
            ),
            "choose other unknowns, or shift at_m of the joints in the case",
        )),
        _ => Ok(()),
    }
}

/// The setup with the controls `values` of `unknowns`, from the body pitch `pitch`; adjustment, shift of the mass
/// centre and body pitch.
pub(crate) fn adjusted(
    setup: &FlightSetup,
    unknowns: &[Unknown; 3],
    mut pitch: f64,
    values: &[f64],
) -> (FlightSetup, Adjustment, f64, f64) {
    let mut a = Adjustment::default();
    let mut shift = 0.0;
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
        }
    }
    let mut setup = setup.clone();
    let tips = setup.animal.wings.iter().flat_map(|w| &w.mesh.nodes);
    shift *= tips.fold(0.0_f64, |m, r| m.max(r.length()));
    for wing in &mut setup.animal.wings {
        wing.motion = wing.motion.adjusted(wing.side, &a);
        wing.hinge_b.x -= shift;
    }
    if a.frequency != 0.0 {
        for joint in &mut setup.joints {
            *joint = faster(joint, 1.0 + a.frequency);
        }
    }
    (setup, a, shift, pitch)
}
