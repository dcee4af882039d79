//! Errors as exceptions of `wingbeat.errors`, each with the key it is about, the line, and what to try.

use std::path::Path;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use wingbeat::Error;
use wingbeat::analysis::AnalysisError;
use wingbeat::case::{CaseError, IoError};
use wingbeat::flight::FlightError;

/// What an exception carries beside its message.
#[derive(Default)]
struct ErrorFields {
    key: String,
    line: Option<usize>,
    remedy: String,
}

/// The exception of this class.
fn exception(py: Python<'_>, class: &str, message: &str, fields: ErrorFields) -> PyErr {
    let build = || -> PyResult<PyErr> {
        let dict = PyDict::new(py);
        dict.set_item("key", fields.key)?;
        dict.set_item("line", fields.line)?;
        dict.set_item("remedy", fields.remedy)?;
        let class = py.import("wingbeat.errors")?.getattr(class)?;
        let value = class.call((message,), Some(&dict))?;
        Ok(PyErr::from_value(value))
    };
    build().unwrap_or_else(|e| e)
}

/// A value that is refused before any case is made of it.
pub fn refused(py: Python<'_>, key: &str, problem: &str, remedy: &str) -> PyErr {
    let message = format!("{key}: {problem}; try: {remedy}");
    let fields = ErrorFields {
        key: key.to_owned(),
        line: None,
        remedy: remedy.to_owned(),
    };
    exception(py, "CaseError", &message, fields)
}

/// Of a folder with the numbers of a flight in memory, which no case goes with.
pub fn without_case(py: Python<'_>, dir: &Path) -> PyErr {
    let key = dir.display().to_string();
    let message = format!(
        "`{key}`: it holds the numbers of a flight in memory (run.write), and no case to read them with"
    );
    let remedy = "fly(out=FOLDER) writes what read() takes; history.csv and summary.json are read by other means (numpy, json)";
    let fields = ErrorFields {
        key,
        line: None,
        remedy: remedy.to_owned(),
    };
    exception(py, "ResultError", &message, fields)
}

/// Of a question to air that is no vortex lattice.
pub fn no_lattice(py: Python<'_>) -> PyErr {
    let problem = "the air of this flight is no vortex lattice";
    refused(py, "air.model", problem, "air.model = \"vortex_lattice\"")
}

/// What has this name among `all`, given as `key`.
pub fn named<T: Copy>(py: Python<'_>, key: &str, name: &str, all: &[(&str, T)]) -> PyResult<T> {
    let found = all.iter().find(|(own, _)| *own == name);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<&str> = all.iter().map(|(name, _)| *name).collect();
        let problem = format!("`{name}` is not known");
        refused(py, key, &problem, &names.join(", "))
    })
}

/// What went wrong, as an exception.
pub fn raised(py: Python<'_>, error: &Error) -> PyErr {
    let (class, fields) = match error {
        Error::Io(e) => file(e),
        Error::Flight(e) => flight(e),
        Error::Analysis(e) => analysis(e),
        Error::NoWind { .. } => {
            let remedy = "fly in blade elements or in the vortex lattice";
            ("CaseError", about("air.model", remedy))
        }
        Error::Ensemble { remedy, .. } => ("FlightError", about("members", *remedy)),
        Error::Threads(_) => ("FlightError", about("threads", "fly on fewer threads")),
    };
    let fields = ErrorFields {
        remedy: in_python(&fields.remedy),
        ..fields
    };
    exception(py, class, &in_python(&error.to_string()), fields)
}

/// Words of the command line and those of Python in their place. A new flight takes no directory of an old one there.
const SPOKEN: [(&str, &str); 6] = [
    (" with --out, or take this one with --overwrite", ""),
    (" with --out DIR", ""),
    (" with --out", ""),
    ("with --overwrite", "with overwrite=True"),
    ("which --overwrite", "which overwrite=True"),
    ("`wingbeat presets`", "wingbeat.presets()"),
];

fn in_python(message: &str) -> String {
    let replaced = |text: String, (from, to): &(&str, &str)| text.replace(from, to);
    SPOKEN.iter().fold(message.to_owned(), replaced)
}

/// Of a command that is not done because its work ended in a panic.
pub fn broken() -> PyErr {
    PyRuntimeError::new_err("wingbeat failed within itself; please report the case")
}

fn about(key: impl Into<String>, remedy: impl Into<String>) -> ErrorFields {
    ErrorFields {
        key: key.into(),
        line: None,
        remedy: remedy.into(),
    }
}

fn file(error: &IoError) -> (&'static str, ErrorFields) {
    match error {
        IoError::Case(e) => ("CaseError", of_case(e)),
        IoError::NoCase { name, hint } => {
            let remedy = format!("{hint}; `wingbeat presets` lists the presets");
            let remedy = remedy.trim_start_matches([',', ';', ' ']); // as the message has it
            ("CaseError", about(or_case(name), remedy))
        }
        IoError::NoSpecies { name, known, .. } => {
            let remedy = format!("choose from {known}");
            ("CaseError", about(or_case(name), remedy))
        }
        IoError::Insect { remedy, .. } => ("CaseError", about("insect", remedy.as_str())),
        IoError::NoKeys { part, remedy, .. } => ("CaseError", about(part.as_str(), *remedy)),
        IoError::Exists { path, remedy } | IoError::File { path, remedy, .. } => {
            ("ResultError", about(path.display().to_string(), *remedy))
        }
        IoError::Reserved { path } => {
            let remedy = "name a file outside the result directory";
            ("ResultError", about(path.display().to_string(), remedy))
        }
        IoError::Figure { path, .. } => {
            let remedy = "choose another figure, or another folder";
            ("ResultError", about(path.display().to_string(), remedy))
        }
        IoError::Busy { path } => {
            let remedy = "wait for the other wingbeat, or end it";
            ("ResultError", about(path.display().to_string(), remedy))
        }
        IoError::Damaged { path, .. } => {
            let remedy =
                "give the directory of a run, whole as it was written; or fly the case again";
            ("ResultError", about(path.display().to_string(), remedy))
        }
    }
}

/// What is wrong with a case as a whole is wrong with `case`.
fn or_case(key: &str) -> String {
    match key {
        "" => "case".to_owned(),
        key => key.to_owned(),
    }
}

fn of_case(error: &CaseError) -> ErrorFields {
    let remedy = match &error.remedy[..] {
        "" => &error.allowed,
        remedy => remedy,
    };
    ErrorFields {
        key: or_case(&error.key),
        line: error.line,
        remedy: remedy.to_owned(),
    }
}

fn flight(error: &FlightError) -> (&'static str, ErrorFields) {
    match error {
        FlightError::Setup { key, problem, .. } => ("CaseError", about(*key, last_clause(problem))),
        FlightError::NotConverged { .. } => {
            let remedy = "more steps (time.steps_per_beat), more passes (corrector.max_passes), or corrector.relaxation below 1";
            ("FlightError", about("time.steps_per_beat", remedy))
        }
        FlightError::Control { .. } => {
            let remedy = "answer with one adjustment per wing, its numbers finite, frequency 0, and 0 where nothing beats";
            ("FlightError", about("control", remedy))
        }
        FlightError::External(_) => ("FlightError", about("air", "see what the air says")),
        FlightError::ElasticNotConverged { remedy, .. } => {
            ("FlightError", about("time.steps_per_beat", *remedy))
        }
        FlightError::Asymmetric { .. } => {
            let remedy = "compute both halves: air.mirror = false";
            ("FlightError", about("air.mirror", remedy))
        }
        FlightError::Diverged { remedy, .. } => {
            ("FlightError", about("time.steps_per_beat", *remedy))
        }
        FlightError::JointGrows { remedy, .. } => {
            ("FlightError", about("dynamics.integrator", remedy.clone()))
        }
        FlightError::StepTooSmall { .. } => {
            let remedy = "smooth it, or take integrator = \"hamming\"";
            ("FlightError", about("dynamics.integrator", remedy))
        }
        FlightError::TooManySteps { .. } => {
            let remedy = "make it softer or slower, or shorten the step";
            ("FlightError", about("time.steps_per_beat", remedy))
        }
        _ => ("FlightError", about("", last_clause(&error.to_string()))),
    }
}

/// What a message ends with, which is what to try.
fn last_clause(message: &str) -> &str {
    let parts = message.rsplit_once("; ").or(message.rsplit_once(": "));
    parts.map_or(message, |(_, last)| last)
}

fn analysis(error: &AnalysisError) -> (&'static str, ErrorFields) {
    match error {
        AnalysisError::Flight(e) => flight(e),
        AnalysisError::NotCovered { remedy, .. }
        | AnalysisError::Asymmetric { remedy, .. }
        | AnalysisError::NotPeriodic { remedy, .. } => ("AnalysisError", about("", *remedy)),
        AnalysisError::NoSteadyState { .. } => {
            ("AnalysisError", about("", "lower speeds, or no incidence"))
        }
        _ => {
            let remedy = "start nearer to the flight that is looked for";
            ("AnalysisError", about("", remedy))
        }
    }
}
