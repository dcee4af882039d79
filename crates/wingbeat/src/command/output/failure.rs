//! Why a command did not do what it was asked, and its exit code.

use wingbeat::Error;
use wingbeat::analysis::AnalysisError;
use wingbeat::case::IoError;
use wingbeat::flight::FlightError;

use crate::command::output::terminal::tell;

/// Nothing was run.
pub(crate) const REFUSED: u8 = 2;
/// It failed midway.
pub(crate) const FAILED: u8 = 1;
/// Ended by a signal.
pub(crate) const INTERRUPTED: u8 = 130;

/// Why a command did not do what it was asked.
pub(crate) enum Failure {
    /// An option that cannot be used, or not here.
    Option(String),
    /// Case, result or file.
    Io(IoError),
    /// The analysis.
    Analysis(AnalysisError),
    /// A flight, or what it cannot be made for.
    Flight(Error),
    /// What happened was told already; the exit code.
    Told(u8),
}

impl From<IoError> for Failure {
    fn from(e: IoError) -> Self {
        Self::Io(e)
    }
}

impl From<AnalysisError> for Failure {
    fn from(e: AnalysisError) -> Self {
        Self::Analysis(e)
    }
}

impl From<Error> for Failure {
    fn from(e: Error) -> Self {
        match e {
            Error::Io(e) => Self::Io(e),
            Error::Analysis(e) => Self::Analysis(e),
            Error::Flight(_)
            | Error::Threads(_)
            | Error::NoWind { .. }
            | Error::Ensemble { .. } => Self::Flight(e),
        }
    }
}

/// An error in words for users; that of a case begins with `error:` itself.
pub(crate) fn in_words(e: &IoError) -> String {
    match e {
        IoError::Case(report) => report.to_string(),
        e => format!("error: {e}"),
    }
}

impl Failure {
    /// Tells it; the exit code.
    pub(crate) fn tell(&self) -> u8 {
        match self {
            Self::Io(e) => tell!("{}", in_words(e)),
            Self::Option(problem) => tell!("error: {problem}"),
            Self::Analysis(e) => tell!("error: {e}"),
            Self::Flight(e) => tell!("error: {e}"),
            Self::Told(_) => {}
        }
        match self {
            Self::Told(code) => *code,
            Self::Analysis(
                AnalysisError::NotCovered { .. }
                | AnalysisError::Asymmetric { .. }
                | AnalysisError::Flight(FlightError::Setup { .. }),
            )
            | Self::Flight(Error::Flight(FlightError::Setup { .. })) => REFUSED,
            Self::Analysis(_) | Self::Flight(Error::Flight(_)) => FAILED,
            Self::Io(IoError::File { source, .. }) if is_full(source) => FAILED,
            Self::Option(_) | Self::Io(_) | Self::Flight(_) => REFUSED,
        }
    }
}

/// Whether something was written, and then there was no space for the rest.
fn is_full(e: &std::io::Error) -> bool {
    use std::io::ErrorKind::{FileTooLarge, QuotaExceeded, StorageFull, WriteZero};
    matches!(
        e.kind(),
        FileTooLarge | QuotaExceeded | StorageFull | WriteZero
    )
}
