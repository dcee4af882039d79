//! What is left between measured angles and the series fitted to them.

use wingbeat_math::{root_mean_square, to_digits};
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
    /// The samples that are none of the others' kind, the farthest first.
    pub outliers: Vec<Outlier>,
    /// As [`Self::residual_deg`], of a series fitted to the others \[deg\].
    pub residual_of_others_deg: f64,
    /// The noise that its highest harmonics follow; none where they are motion, or too few to know.
    pub noise: Option<Scatter>,
}

/// A sample that is none of the others' kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlier {
    /// Its number in the table, from 1 on; rows without an angle do not count \[1\].
    pub sample: usize,
    /// Its phase \[wingbeats\].
    pub phase: f64,
    /// Its angle \[deg\].
    pub angle_deg: f64,
    /// How far that is above the series of the others \[deg\].
    pub off_deg: f64,
}

/// More than this is no noise of measured angles [deg]: video has 1 to 2.
const NOISE_DEG: f64 = 3.0;

/// A sample farther off than so many times the root mean square is none of the others' kind; of two hundred
/// with normal noise the farthest is at 3.
const OUTLIER: f64 = 5.0;

/// Samples for each that may be an outlier \[1\].
const SAMPLES_PER_OUTLIER: usize = 20;

/// Significant digits of phases and angles in what is said of them.
pub(super) const DIGITS: usize = 6;

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
                "{}: {} harmonics leave {rms:.1} deg (rms) and {most:.1} deg of the sample at phase {}: {times}take out samples that are no measurements (lost frames), or fit more harmonics",
                self.key, self.harmonics, to_digits(phase, DIGITS)
            )
        });
        self.stray().or(coarse).or(noise)
    }

    /// That samples are none of the others' kind.
    fn stray(&self) -> Option<String> {
        let farthest = self.outliers.first()?;
        let shown = |x: f64| to_digits(x, DIGITS);
        let more = match self.outliers.len() - 1 {
            0 => String::new(),
            1 => ", and one more is off".to_owned(),
            n => format!(", and {n} more are off"),
        };
        let rest = self.residual_of_others_deg;
        let coarse = match rest > NOISE_DEG {
            true => format!("; of the others, {}fit more harmonics", self.times()),
            false => String::new(),
        };
        Some(format!(
            "{}: sample {} of {}, {} deg at phase {}, is {:.1} deg off the {} harmonics of the others, which leave {rest:.1} deg (rms) of these{more}: take out samples that are no measurements (lost frames){coarse}",
            self.key,
            farthest.sample,
            self.samples,
            shown(farthest.angle_deg),
            shown(farthest.phase),
            farthest.off_deg.abs(),
            self.harmonics,
        ))
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
        rms_of(&scaled, harmonics)
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
    let (others, outliers) = parted(&rows[..left.len()], harmonics);
    let rest = rms_of(&others, harmonics).unwrap_or(rms);
    let doubtful = beats_per_unit.filter(|_| rest.to_degrees() > NOISE_DEG);
    let better = doubtful.and_then(|beats| Some(beats * better(&others, harmonics, rest)?));
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
        outliers,
        residual_of_others_deg: rest.to_degrees(),
        noise: series.scatter(left.len()),
    })
}

/// Root mean square of what a series leaves of the rows \[rad\]; none where they do not determine it.
fn rms_of(rows: &[(f64, f64)], harmonics: usize) -> Option<f64> {
    let (_, left) = Fourier::fitted("", rows, harmonics).ok()?;
    Some(root_mean_square(left.iter().copied()))
}

/// The rows \[wingbeats, rad\] without the outliers among them, and these: the farthest is taken out and the others are
/// fitted again, until none is far off, or phases are too far apart without it.
fn parted(rows: &[(f64, f64)], harmonics: usize) -> (Vec<(f64, f64)>, Vec<Outlier>) {
    let (mut kept, mut found): (Vec<usize>, Vec<usize>) = ((0..rows.len()).collect(), vec![]);
    let at = |kept: &[usize]| kept.iter().map(|k| rows[*k]).collect::<Vec<_>>();
    let far_off = |kept: &[usize]| {
        let (_, left) = Fourier::fitted("", &at(kept), harmonics).ok()?;
        let rms = root_mean_square(left.iter().copied());
        let sizes = left.iter().map(|x| x.abs()).enumerate();
        let (k, most) = sizes.max_by(|a, b| a.1.total_cmp(&b.1))?;
        (most > OUTLIER * rms && most.to_degrees() > NOISE_DEG).then_some(k)
    };
    while found.len() < rows.len() / SAMPLES_PER_OUTLIER
        && let Some(k) = far_off(&kept)
    {
        let mut others = kept.clone();
        let outlier = others.remove(k);
        if rms_of(&at(&others), harmonics).is_none() {
            break;
        }
        (kept, found) = (others, [found, vec![outlier]].concat());
    }
    let others = at(&kept);
    let Ok((series, _)) = Fourier::fitted("", &others, harmonics) else {
        return (others, vec![]);
    };
    let outlier = |k: usize| {
        let (phase, angle) = rows[k];
        Outlier {
            sample: k + 1,
            phase,
            angle_deg: angle.to_degrees(),
            off_deg: (angle - series.at(phase)[0]).to_degrees(),
        }
    };
    (others, found.into_iter().map(outlier).collect())
}
