//! The verification dossier: what is claimed of the air, against what, how far off, and whether
//! that is good enough.
//!
//! A [`Case`] is one short function that runs something and returns [`Row`]s: a quantity, its
//! reference with the source, ours, an uncertainty from our own refinement, a tolerance with its
//! reason. A row without a tolerance is a *report*: a comparison with an experiment or another
//! program, stated and not judged. Misses are listed as misses.
//!
//! The chapter in order: [`row`] and [`dossier`] say what a result is and how it is written;
//! [`lab`] holds the wings, motions and the stepping that cases share; [`cases`] is the suite,
//! analytic cases first, then other programs, then experiments.
//!
//! What it does not know: files (it returns text), the clock.
#![warn(missing_docs)]

pub mod cases;
pub mod dossier;
pub mod lab;
pub mod row;

pub use dossier::{Dossier, Entry};
pub use row::{Row, Trouble, Verdict};

use rayon::prelude::*;

/// Which part of the dossier a case belongs to.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize,
)]
#[serde(rename_all = "snake_case")]
pub enum Part {
    /// Closed forms, theory, conservation, invariance.
    Analytic,
    /// Published numbers of other programs.
    Programs,
    /// Measurements on animals and robots.
    Experiments,
    /// How far our own results depend on numerical choices.
    Sensitivity,
}

/// One case of the suite.
#[derive(Clone, Copy)]
pub struct Case {
    /// Short name, unique.
    pub name: &'static str,
    /// One sentence: what is computed and compared.
    pub about: &'static str,
    /// Where it stands in the dossier.
    pub part: Part,
    /// Whether it is in the short set.
    pub quick: bool,
    /// Runs it; `true` asks for the short form.
    pub run: fn(bool) -> Result<Vec<Row>, Trouble>,
}

/// The cases of the short or the whole suite whose name holds `only`.
pub fn select(quick: bool, only: &str) -> Vec<Case> {
    let wanted = |c: &Case| (c.quick || !quick) && c.name.contains(only);
    cases::suite().into_iter().filter(wanted).collect()
}

/// Runs the cases, several at a time; `done` is told each as it ends. The dossier does not depend on
/// the number of threads.
pub fn run(cases: &[Case], quick: bool, done: impl Fn(&Entry) + Sync) -> Dossier {
    let one = |case: &Case| {
        let entry = Entry::of(case, (case.run)(quick));
        done(&entry);
        entry
    };
    // Longest last in the list would leave threads idle: every case is its own task.
    let entries = cases.par_iter().with_max_len(1).map(one).collect();
    Dossier { quick, entries }
}
