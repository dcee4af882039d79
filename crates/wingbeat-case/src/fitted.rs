//! What is left between measured angles and the series fitted to them.

use wingbeat_model::motion::Fourier;

use crate::build::radians;
use crate::loaded::LoadedCase;
use crate::raw::{AngleCase, WingMotionCase};

/// A table of angles to which a series is fitted.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedTable {
    /// The key of the table.
    pub key: String,
    /// Harmonics of the series \[1\].
    pub harmonics: usize,
    /// Samples of the table, the repetition of the first left out \[1\].
    pub samples: usize,
    /// Root mean square of what is left between samples and series \[deg\].
    pub residual_deg: f64,
}

impl LoadedCase {
    /// The tables of wing angles that are fitted by series (`harmonics`).
    pub fn fitted_tables(&self) -> Vec<FittedTable> {
        let wings = self.raw.wing.iter();
        let motions = wings.filter_map(|(name, wing)| Some((name, wing.motion.as_ref()?)));
        motions.flat_map(|(name, m)| of_wing(name, m)).collect()
    }
}

fn of_wing(name: &str, motion: &WingMotionCase) -> Vec<FittedTable> {
    let angles = [
        ("phi", &motion.phi),
        ("theta", &motion.theta),
        ("psi", &motion.psi),
    ];
    let fitted = |(angle, case): (&str, &Option<AngleCase>)| {
        let Some(AngleCase::Table(table)) = case else {
            return None;
        };
        let (rows, harmonics) = (table.rows_deg.as_ref()?, table.harmonics?);
        let (_, left) = Fourier::fitted("", &radians(rows), harmonics).ok()?;
        let span = rows.last()?[0] - rows.first()?[0];
        Some(FittedTable {
            key: format!("wing.{name}.motion.{angle}.table"),
            harmonics,
            samples: rows.len() - usize::from(span > 1.0 - 1e-9),
            residual_deg: left.to_degrees(),
        })
    };
    angles.into_iter().filter_map(fitted).collect()
}
