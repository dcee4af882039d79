//! A case of the suite.

use serde::{Deserialize, Serialize};

use crate::row::{Row, VerifyError};

/// Which part of the report a case belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
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
    /// Where it stands in the report.
    pub part: Part,
    /// Whether it is in the short set.
    pub quick: bool,
    /// Runs it; `true` asks for the short form.
    pub run: fn(bool) -> Result<Vec<Row>, VerifyError>,
}
