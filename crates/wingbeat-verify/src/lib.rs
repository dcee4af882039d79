//! The verification report: what is claimed of the air, against what, how far off, and whether
//! that is good enough.
//!
//! A [`Case`] is one short function that runs something and returns [`Row`]s: a quantity, its
//! reference with the source, the computed value, an uncertainty from our own refinement, a tolerance with its
//! reason. A row without a tolerance is a *report*: a comparison with an experiment or another
//! program, stated and not judged. What fails is listed first.
//!
//! The chapter in order: [`row`] and [`report`] say what a result is and how it is written;
//! [`lab`] holds the wings, motions and the stepping that cases share; [`cases`] is the suite,
//! analytic cases first, then other programs, then experiments.
//!
//! What it does not know: files (it returns text), the clock.
#![warn(missing_docs)]

mod case;
pub mod cases;
pub mod lab;
pub mod report;
pub mod row;

pub use case::{Case, Part};
pub use cases::select;
pub use report::{Entry, Report};
pub use row::{Comparison, Row, Verdict, VerifyError};

use rayon::prelude::*;

/// Runs the cases, several at a time; `done` is called with each as it ends. The report does not depend on
/// the number of threads.
pub fn run(cases: &[Case], quick: bool, done: impl Fn(&Entry) + Sync) -> Report {
    let one = |case: &Case| {
        let entry = Entry::of(case, (case.run)(quick));
        done(&entry);
        entry
    };
    // Longest last in the list would leave threads idle: every case is its own task.
    let entries = cases.par_iter().with_max_len(1).map(one).collect();
    Report { quick, entries }
}
