//! wingbeat for Python: the module `wingbeat._core`, on which the Python sources in `python/wingbeat` are written.
//!
//! It holds no formula: flights, results and analyses are those of the library, their numbers handed over as
//! numpy arrays that own what Rust computed. Python is left to itself (the interpreter is released) wherever
//! something is flown or analysed.
//!
//! | module | what it holds |
//! |---|---|
//! | `command` | the command line |
//! | `errors` | errors as exceptions of `wingbeat.errors` |
//! | `arrays` | numpy arrays that cannot be written to |
//! | `own` | controllers and models of the air written in Python |
//! | `threads` | the pool of threads of this process, of a fork too |
//! | `worker` | work beside the interpreter: progress, signals |
//! | `flight` | flights |
//! | `stepping` | flights step by step |
//! | `run` | flights that were flown |
//! | `frame` | surfaces and wakes of one instant |
//! | `course` | what episodes about one flight share |
//! | `fleet` | many episodes at once, for who learns |
//! | `solution` | what trims in any air find |
//! | `mechanics` | trim, stability, controls, power |
//! | `vibration` | modes and flutter of elastic wings |
//! | `wake` | trim in air with a memory |
#![warn(missing_docs)]

mod arrays;
mod command;
mod course;
mod errors;
mod fleet;
mod flight;
mod frame;
mod mechanics;
mod own;
mod run;
mod solution;
mod stepping;
mod threads;
mod vibration;
mod wake;
mod worker;

/// What `wingbeat` (Python) is written on.
#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use crate::command::{described, main, names_of_numbers, presets, schema, version};
    #[pymodule_export]
    use crate::course::Course;
    #[pymodule_export]
    use crate::fleet::Fleet;
    #[pymodule_export]
    use crate::flight::{Flight, hash_of_files};
    #[pymodule_export]
    use crate::frame::Frame;
    #[pymodule_export]
    use crate::mechanics::Trim;
    #[pymodule_export]
    use crate::own::Sensed;
    #[pymodule_export]
    use crate::run::Run;
    #[pymodule_export]
    use crate::solution::TrimSolution;
    #[pymodule_export]
    use crate::stepping::Stepper;
    #[pymodule_export]
    use crate::wake::WakeTrim;

    #[pymodule_init]
    #[allow(clippy::unnecessary_wraps)]
    fn init(_module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        crate::threads::begin();
        Ok(())
    }
}
