//! The command line, and what the program says of itself.

use std::ffi::OsString;

use pyo3::prelude::*;
use wingbeat::analysis::Power;
use wingbeat::case::{self, presets::PRESETS};
use wingbeat::results::Summary;
use wingbeat::results::summary::PerBeat;

use crate::threads::detached;

/// Does what the command line says, the name of the program first; the exit code.
#[pyfunction]
pub fn main(py: Python<'_>, args: Vec<OsString>) -> PyResult<u8> {
    detached(py, || wingbeat::command::main(args))
}

/// Names of the presets and what each is.
#[pyfunction]
pub fn presets() -> Vec<(&'static str, &'static str)> {
    PRESETS.iter().map(|p| (p.name, p.line())).collect()
}

/// The JSON schema of cases.
#[pyfunction]
pub fn schema() -> String {
    case::schema()
}

/// What a number that a flight gives, or a key of a case, is; an empty text of names that are neither.
#[pyfunction]
pub fn described(name: &str) -> String {
    let of_beats = PerBeat::<f64>::QUANTITIES.iter().find(|q| q.name == name);
    let of_flight = Summary::NUMBERS.iter().find(|q| q.name == name);
    let about = of_beats.map(|q| q.about).or(of_flight.map(|q| q.about));
    let of_key = || case::keys::described(name).map(|[_, about]| about);
    about.map(str::to_owned).or_else(of_key).unwrap_or_default()
}

/// Names of the means over wingbeats, of the numbers of the summary, and of powers [W].
#[pyfunction]
pub fn names_of_numbers() -> [Vec<String>; 3] {
    let beats = PerBeat::<f64>::QUANTITIES.iter();
    let powers = Power::QUANTITIES.iter();
    [
        beats.map(|q| q.name.to_owned()).collect(),
        Summary::NUMBERS.iter().map(|q| q.name.to_owned()).collect(),
        powers.map(|q| format!("{}_watt", q.name)).collect(),
    ]
}

/// Version of the program.
#[pyfunction]
pub fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}
