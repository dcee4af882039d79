//! The command line, and what the program says of itself.

use std::ffi::OsString;

use pyo3::prelude::*;
use wingbeat::case::{self, presets::PRESETS};

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

/// Version of the program.
#[pyfunction]
pub fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}
