//! The laws of a deformation: along the span and over the beat.

use crate::error::{ModelError, check_rising, finite, in_row};
use crate::motion::Fourier;

/// A quantity along the span, at the relative distance r/R from the hinge.
#[derive(Clone, Debug, PartialEq)]
pub enum SpanLaw {
    /// Linear from the root of the surface to the tip.
    Linear {
        /// Value at the root.
        root: f64,
        /// Value at the tip.
        tip: f64,
    },
    /// Rows (r/R, value) from the root (or farther in) to the tip, straight lines between.
    Table(Vec<(f64, f64)>),
}

/// Rounding allowed where a table has to reach root and tip.
const END: f64 = 1e-9;

/// Where tables may end beyond the tip, r/R \[1\]: outlines differ a little from the wings that were measured.
const BEYOND: f64 = 1.1;

impl SpanLaw {
    /// The same value all along.
    pub fn constant(value: f64) -> Self {
        Self::Linear {
            root: value,
            tip: value,
        }
    }

    /// Value at `r` = r/R of a wing whose surface begins at `root` = r/R.
    pub fn at(&self, r: f64, root: f64) -> f64 {
        match self {
            &Self::Linear { root: a, tip: b } => a + (b - a) * ((r - root) / (1.0 - root)),
            Self::Table(rows) => wingbeat_math::interpolate_pairs(rows, r),
        }
    }

    /// All values times `s`.
    pub fn scaled(&self, s: f64) -> Self {
        match self {
            &Self::Linear { root, tip } => Self::Linear {
                root: s * root,
                tip: s * tip,
            },
            Self::Table(rows) => Self::Table(rows.iter().map(|&(r, v)| (r, s * v)).collect()),
        }
    }

    /// Checks the law of a wing whose surface begins at `root` = r/R.
    ///
    /// # Errors
    /// A number that is not finite; a table that is unsorted or does not reach from root to tip.
    pub fn check(&self, key: &str, root: f64) -> Result<(), ModelError> {
        match self {
            Self::Linear { root, tip } => {
                finite(&format!("{key}.linear[0]"), *root)?;
                finite(&format!("{key}.linear[1]"), *tip).map(|_| ())
            }
            Self::Table(rows) => check_table(&format!("{key}.table"), rows, root),
        }
    }
}

fn check_table(table: &str, rows: &[(f64, f64)], root: f64) -> Result<(), ModelError> {
    let bad = |row: usize, problem: String| Err(in_row(table, row, problem));
    check_rising(table, "r/R =", rows)?;
    match rows {
        [] | [_] => bad(rows.len(), "a table needs at least 2 rows".to_owned()),
        [first, ..] if first.0 > root + END => bad(
            0,
            format!(
                "the table begins at r/R = {}, the surface at {root}: it does not cover the span",
                first.0
            ),
        ),
        [.., last] if last.0 < 1.0 - END => bad(
            rows.len() - 1,
            format!(
                "the table ends at r/R = {}, not at the tip (1): it does not cover the span",
                last.0
            ),
        ),
        [.., last] if last.0 > BEYOND => bad(
            rows.len() - 1,
            format!(
                "the table ends at r/R = {}, and the tip is at 1: distances from the hinge are to be divided by the wing length, per cent by 100",
                last.0
            ),
        ),
        _ => Ok(()),
    }
}

/// A law along the span times a Fourier series in the phase of the wing's beat.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Along the span; carries the unit.
    pub span: SpanLaw,
    /// Over the beat \[1\].
    pub time: Fourier,
}

impl Term {
    /// The same at all times.
    pub fn steady(span: SpanLaw) -> Self {
        let time = Fourier {
            mean: 1.0,
            ..Fourier::default()
        };
        Self { span, time }
    }

    /// Whether it does not vary over the beat.
    pub fn is_steady(&self) -> bool {
        self.time.is_constant()
    }

    /// Value and first two time derivatives of the series at the phase `[x, x', x'']`.
    pub(crate) fn over_time(&self, phase: [f64; 3]) -> [f64; 3] {
        over_time(&self.time, phase)
    }
}

/// Value and first two time derivatives of a series at the phase `[x, x', x'']`.
pub(super) fn over_time(series: &Fourier, [x, x1, x2]: [f64; 3]) -> [f64; 3] {
    let [q, q1, q2] = series.at(x - x.floor());
    [q, q1 * x1, q2 * x1 * x1 + q1 * x2]
}

/// Deformation of one section, each with its first two time derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionDeformation {
    /// Twist tau \[rad\].
    pub twist: [f64; 3],
    /// Height of the mean line over the chord \[1\].
    pub camber: [f64; 3],
    /// Displacement towards -axis 3 \[m\].
    pub bending: [f64; 3],
}
