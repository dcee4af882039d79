//! What is left between measured angles and the series fitted to them.

use wingbeat_model::motion::{Fourier, Scatter};

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
    /// How long the samples go on \[wingbeats\].
    pub span: f64,
    /// Root mean square of what is left between samples and series \[deg\].
    pub residual_deg: f64,
    /// Most that is left of a sample \[deg\], and its phase \[wingbeats\].
    pub farthest: [f64; 2],
    /// The noise that its highest harmonics follow; none where they are motion, or too few to know.
    pub noise: Option<Scatter>,
}

/// More than this is no noise of measured angles [deg]: video has 1 to 2.
const NOISE_DEG: f64 = 3.0;

/// A sample farther off than so many times the root mean square is none of the others' kind; of two hundred
/// with normal noise the farthest is at 3.
const OUTLIER: f64 = 5.0;

/// Samples of a single beat do not go on for longer, rounding aside \[wingbeats\].
const ONE_BEAT: f64 = 1.001;

impl FittedTable {
    /// Why samples or number of harmonics are to be doubted; none if the series follows the samples.
    pub fn doubt(&self) -> Option<String> {
        let ([most, phase], rms) = (self.farthest, self.residual_deg);
        let is_outlier = most > OUTLIER * rms && most > NOISE_DEG;
        let follows = self.noise.filter(|n| n.harmonics < self.harmonics);
        let noise = follows.map(|n| {
            format!(
                "{}: of {} harmonics those beyond number {} are noise of some {:.1} deg in the samples, with rates of {:.0} % of those of the motion: fit {} harmonics",
                self.key,
                self.harmonics,
                n.harmonics,
                n.deviation.to_degrees(),
                100.0 * n.rates,
                n.harmonics
            )
        });
        let times = match self.span > ONE_BEAT {
            true => format!(
                "if the phases, {:.4} wingbeats in all, are times, give beats_per_unit; else ",
                self.span
            ),
            false => String::new(),
        };
        let coarse = (rms > NOISE_DEG || is_outlier).then(|| {
            format!(
                "{}: {} harmonics leave {rms:.1} deg (rms) and {most:.1} deg of the sample at phase {phase}: {times}take out samples that are no measurements (lost frames), or fit more harmonics",
                self.key, self.harmonics
            )
        });
        coarse.or(noise)
    }
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
        let (series, left) = Fourier::fitted("", &radians(rows), harmonics).ok()?;
        let square = left.iter().map(|x| x * x).sum::<f64>() / left.len() as f64;
        let sizes = left.iter().map(|x| x.abs().to_degrees());
        let farthest = sizes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(FittedTable {
            key: format!("wing.{name}.motion.{angle}.table"),
            harmonics,
            samples: left.len(),
            span: rows[rows.len() - 1][0] - rows[0][0],
            residual_deg: square.sqrt().to_degrees(),
            farthest: [farthest.1, rows[farthest.0][0]],
            noise: series.scatter(left.len()),
        })
    };
    angles.into_iter().filter_map(fitted).collect()
}
