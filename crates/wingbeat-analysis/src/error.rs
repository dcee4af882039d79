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
    pub(crate) fn not_covered(what: impl Into<String>, remedy: &'static str) -> Self {
        Self::NotCovered {
            what: what.into(),
            remedy,
        }
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
