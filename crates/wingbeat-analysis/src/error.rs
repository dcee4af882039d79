//! What can go wrong in an analysis.

use wingbeat_dynamics::DynamicsError;
use wingbeat_flight::FlightError;

/// An analysis that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AnalysisError {
    /// The flight cannot be built or flown.
    #[error(transparent)]
    Flight(#[from] FlightError),
    /// The bodies refuse.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
    /// The setup has something this analysis does not cover.
    #[error("{what}: {remedy}")]
    NotCovered {
        /// What is in the way.
        what: String,
        /// What to do instead.
        remedy: &'static str,
    },
    /// What was flown does not come back after a wingbeat.
    #[error("{what}: {remedy}")]
    NotPeriodic {
        /// What has no periodic motion.
        what: String,
        /// What to try.
        remedy: &'static str,
    },
    /// Right and left part where only the plane of symmetry was asked.
    #[error(
        "this flight parts right from left: the largest of its lateral forces, moments, turns and drifts in a wingbeat is {lateral:.1e} (of weight, weight times wing length, radian, wing length): {remedy}"
    )]
    Asymmetric {
        /// The largest of them \[1\].
        lateral: f64,
        /// What to do instead.
        remedy: &'static str,
    },
    /// A wing in a stream does not come to rest.
    #[error(
        "at {speed} m/s the wing does not come to rest: after {time:.3} s with much damping ({steps} steps) a node still moves at {drift:.1e} of the speed of the stream. {remedy}"
    )]
    NotSteady {
        /// Speed of the stream [m/s].
        speed: f64,
        /// Time that it was flown \[s\].
        time: f64,
        /// Steps in that time.
        steps: usize,
        /// Velocity of its fastest node over that of the stream \[1\].
        drift: f64,
        /// What to do instead.
        remedy: &'static str,
    },
    /// The flight to the steady state of a wing in a stream ended.
    #[error(
        "at {speed} m/s no steady state was found, about which vibrations are sought: {error}. {}", towards_rest(*is_sudden)
    )]
    NoSteadyState {
        /// Speed of the stream [m/s].
        speed: f64,
        /// How the flight ended.
        error: FlightError,
        /// Whether it did so long before the wing could have come there.
        is_sudden: bool,
    },
    /// A number is not finite or a matrix singular.
    #[error("{0}")]
    Numbers(String),
}

impl AnalysisError {
    /// Whether it is of the flight that was tried, so that a search has not found it and may go on from elsewhere; what
    /// other programs fail in, and what cannot be built, is wrong everywhere.
    pub(crate) fn is_of_one_flight(&self) -> bool {
        match self {
            Self::Flight(error) => is_flown(error),
            Self::Dynamics(_)
            | Self::NotCovered { .. }
            | Self::NotPeriodic { .. }
            | Self::Asymmetric { .. }
            | Self::NotSteady { .. }
            | Self::NoSteadyState { .. }
            | Self::Numbers(_) => true,
        }
    }

    pub(crate) fn not_covered(what: impl Into<String>, remedy: &'static str) -> Self {
        Self::NotCovered {
            what: what.into(),
            remedy,
        }
    }
}

/// Whether a flight ended by its own motion or strokes.
fn is_flown(error: &FlightError) -> bool {
    match error {
        FlightError::JointGrows { ended, .. } => is_flown(ended),
        // Of a search that set out, what is adjusted is what the setup contradicts.
        FlightError::Setup { .. }
        | FlightError::Dynamics(_)
        | FlightError::Structure(_)
        | FlightError::ElasticNotConverged { .. }
        | FlightError::Air(_)
        | FlightError::RootsApart { .. }
        | FlightError::OffPlane { .. }
        | FlightError::Folded { .. }
        | FlightError::StepTooSmall { .. }
        | FlightError::SingularPosition { .. }
        | FlightError::Asymmetric { .. }
        | FlightError::Diverged { .. }
        | FlightError::TurnedPast { .. }
        | FlightError::TooManySteps { .. }
        | FlightError::NotConverged { .. } => true,
        FlightError::WingStructure(_)
        | FlightError::Blade(_)
        | FlightError::Control { .. }
        | FlightError::External(_) => false,
    }
}

/// What to try where a flight to the steady state ended.
fn towards_rest(is_sudden: bool) -> &'static str {
    match is_sudden {
        true => {
            "That is long before it could have come there: loads that act from the start bend it too fast for the step. Take a smaller step (time.step_s)"
        }
        false => {
            "The wing may be beyond static divergence there: try lower speeds, or no incidence"
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn behaves_air_of_another_program_that_fails_is_no_flight_that_a_search_has_not_found() {
        let failed = FlightError::External("the program has ended".into());
        assert!(!AnalysisError::from(failed).is_of_one_flight());
        let singular = FlightError::SingularPosition {
            time: 0.0,
            joints: "a and b".into(),
        };
        assert!(AnalysisError::from(singular).is_of_one_flight());
        assert!(AnalysisError::Numbers("not finite".into()).is_of_one_flight());
    }
}
