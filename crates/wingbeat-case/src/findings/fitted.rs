//! What is left between measured angles and the series fitted to them.

use wingbeat_math::root_mean_square;
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
    /// Wingbeats in one unit of its first column, as it is given \[1\]; none of phases.
    pub beats_per_unit: Option<f64>,
    /// Frequency at which they are flown \[Hz\].
    pub frequency: f64,
    /// Wingbeats in one unit with which the series follows the samples much better \[1\]; none where there is
    /// none near.
    pub better_beats_per_unit: Option<f64>,
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

/// Frequencies that differ by less are the same, rounded \[1\].
const SAME_FREQUENCY: f64 = 5e-3;

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
        let times = self.times();
        let coarse = (rms > NOISE_DEG || is_outlier).then(|| {
            format!(
                "{}: {} harmonics leave {rms:.1} deg (rms) and {most:.1} deg of the sample at phase {phase}: {times}take out samples that are no measurements (lost frames), or fit more harmonics",
                self.key, self.harmonics
            )
        });
        coarse.or(noise)
    }

    /// That the wings beat at a frequency near that of the samples, but not at it: where the wingbeats in a unit are
    /// those in a second, a millisecond or a microsecond.
    pub fn other_frequency(&self) -> Option<String> {
        let (beats, frequency) = (self.beats_per_unit?, self.frequency);
        let ratios = [1.0, 1e3, 1e6].map(|unit| unit * beats / frequency);
        let near = ratios
            .into_iter()
            .find(|r| (0.75..1.0 / 0.75).contains(r))?;
        ((near - 1.0).abs() > SAME_FREQUENCY).then(|| {
            format!(
                "beats_per_unit = {beats} is not motion.frequency_hz = {frequency}: the strokes are flown at that"
            )
        })
    }

    /// What may be wrong with the times of a table of more than one wingbeat.
    fn times(&self) -> String {
        let span = self.span;
        match (self.beats_per_unit, self.better_beats_per_unit) {
            _ if span <= ONE_BEAT => String::new(),
            (None, _) => format!(
                "if the phases, {span:.4} wingbeats in all, are times, give beats_per_unit; else "
            ),
            (Some(beats), Some(better)) => format!(
                "beats_per_unit = {beats}, {span:.4} wingbeats in all, is likely to be wrong: with {better:.4} the samples repeat; else "
            ),
            (Some(beats), None) => format!(
                "beats_per_unit = {beats}, {span:.4} wingbeats in all, may be wrong, or the frequency changes within the table: then fit a part of it with fewer wingbeats; else "
            ),
        }
    }
}

/// Times are tried with so much more or fewer wingbeats in a unit \[1\].
const WITHIN: f64 = 0.35;

/// Trials for each wingbeat of the table: neighbours are apart by a twentieth of a wingbeat over all of it.
const TRIALS: f64 = 20.0;

/// Samples times trials at most: a tenth of a second or so.
const MAX_TRIED: f64 = 1e5;

/// With which part of the wingbeats in a unit the series follows the samples, with a third of what is left of
/// them or less; none where with none.
fn better(rows: &[(f64, f64)], harmonics: usize, rms: f64) -> Option<f64> {
    let span = rows.last()?.0 - rows.first()?.0;
    let trials = (TRIALS * WITHIN * span).ceil();
    if span <= ONE_BEAT || 2.0 * trials * rows.len() as f64 > MAX_TRIED {
        return None;
    }
    let left = |part: f64| {
        let scaled: Vec<_> = rows.iter().map(|(x, q)| (part * x, *q)).collect();
        let (_, left) = Fourier::fitted("", &scaled, harmonics).ok()?;
        Some(root_mean_square(left.iter().copied()))
    };
    let last = trials as i32;
    let parts = (-last..=last).map(|k| 1.0 + WITHIN * f64::from(k) / trials);
    let tried = parts.filter_map(|part| Some((part, left(part)?)));
    let (mut part, mut least) = tried.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let mut step = 0.5 * WITHIN / trials;
    while step > 1e-4 {
        for near in [part - step, part + step] {
            if let Some(rest) = left(near).filter(|rest| *rest < least) {
                (part, least) = (near, rest);
            }
        }
        step *= 0.5;
    }
    (3.0 * least < rms).then_some(part)
}

impl LoadedCase {
    /// The tables of wing angles that are fitted by series (`harmonics`).
    pub fn fitted_tables(&self) -> Vec<FittedTable> {
        let wings = self.raw.wing.iter();
        let motions = wings.filter_map(|(name, wing)| Some((name, wing.motion.as_ref()?)));
        motions
            .flat_map(|(name, m)| self.of_wing(name, m))
            .collect()
    }

    fn of_wing(&self, name: &str, motion: &WingMotionCase) -> Vec<FittedTable> {
        let fitted = |(angle, case): (&str, &AngleCase)| {
            let AngleCase::Table(table) = case else {
                return None;
            };
            let key = format!("wing.{name}.motion.{angle}.table");
            let beats = self.number_at(&format!("{key}.beats_per_unit"));
            let rows = radians(table.rows_deg.as_ref()?);
            let frequency = self.raw.motion.frequency_hz.value();
            left_of(key, &rows, table.harmonics?, (beats, frequency))
        };
        motion.angles().filter_map(fitted).collect()
    }
}

/// What is left of these rows \[wingbeats, rad\].
fn left_of(
    key: String,
    rows: &[(f64, f64)],
    harmonics: usize,
    (beats_per_unit, frequency): (Option<f64>, f64),
) -> Option<FittedTable> {
    let (series, left) = Fourier::fitted("", rows, harmonics).ok()?;
    let rms = root_mean_square(left.iter().copied());
    let sizes = left.iter().map(|x| x.abs().to_degrees());
    let farthest = sizes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let doubtful = beats_per_unit.filter(|_| rms.to_degrees() > NOISE_DEG);
    let better = doubtful.and_then(|beats| Some(beats * better(rows, harmonics, rms)?));
    Some(FittedTable {
        key,
        harmonics,
        samples: left.len(),
        span: rows[rows.len() - 1].0 - rows[0].0,
        beats_per_unit,
        frequency,
        better_beats_per_unit: better,
        residual_deg: rms.to_degrees(),
        farthest: [farthest.1, rows[farthest.0].0],
        noise: series.scatter(left.len()),
    })
}
