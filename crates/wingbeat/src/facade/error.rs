//! Why a flight as a value could not be built, flown, trimmed or written.

use wingbeat_analysis::AnalysisError;
use wingbeat_case::IoError;
use wingbeat_flight::FlightError;

/// Why a flight could not be built, flown, trimmed or written.
///
/// ```
/// use wingbeat::{Error, Flight};
/// let error = Flight::preset("fruit-fli-blade").expect_err("no such preset");
/// assert!(matches!(error, Error::Io(_)));
/// assert!(error.to_string().contains("fruit-fly-blade")); // the nearest name
/// ```
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The case or a file.
    #[error(transparent)]
    Io(#[from] IoError),
    /// The flight.
    #[error(transparent)]
    Flight(#[from] FlightError),
    /// The trim.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The system gives no threads.
    #[error("cannot start threads: {0}; fly on fewer")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A gust in air that has no wind.
    #[error(
        "a gust cannot blow in this air ({air}): fly in blade elements or in the vortex lattice"
    )]
    NoWind {
        /// What the air is called.
        air: &'static str,
    },
    /// What is no ensemble.
    #[error("{problem}; choose {remedy}")]
    Ensemble {
        /// What is wrong.
        problem: &'static str,
        /// What to choose.
        remedy: &'static str,
    },
}
