//! Measured angles whose samples scatter: wings that beat with the noise of a camera.

use wingbeat_math::median;
use wingbeat_model::motion::{PeriodicSpline, Scatter};
use wingbeat_model::{AngleLaw, Wing};

use super::said::{grouped, names};
use crate::setup::FlightSetup;

/// Steps for each sample of a table below which a flight does not follow a spline through samples that scatter:
/// a camera's noise of a degree in 200 samples needs twice as many steps for its lift to come within a per
/// cent.
const STEPS: f64 = 2.0;

impl FlightSetup {
    /// Says which tables of wing angles hold noise, or samples that are wrong, how much, and what to do about it.
    pub fn scattered_angles(&self) -> Vec<String> {
        let all = self.animal.wings.iter().flat_map(|wing| {
            scatters(wing).map(|(angle, scatter, jump)| {
                let text = match jump {
                    Some(jump) => say_jump(angle, &jump),
                    None => self.say_scatter(angle, &scatter),
                };
                (text, &wing.name[..])
            })
        });
        of_wings(all)
    }

    /// Says of which tables of wing angles a part of the beat has no samples, which the spline crosses as it happens to.
    pub fn gaps_in_angles(&self) -> Vec<String> {
        let all = self.animal.wings.iter().flat_map(|wing| {
            let gaps = tables(wing).filter_map(|(angle, table)| say_gap(angle, table));
            gaps.map(|text| (text, &wing.name[..]))
        });
        of_wings(all)
    }

    fn say_scatter(&self, angle: &str, s: &Scatter) -> String {
        let least = STEPS * s.samples as f64;
        let steps = self.time.period.map(|p| p / self.time.step);
        let few = match steps.filter(|steps| *steps < least * (1.0 - 1e-9)) {
            Some(steps) => format!(
                ", which {steps:.0} steps per wingbeat do not even follow ({least:.0} at least)"
            ),
            None => String::new(),
        };
        format!(
            "the samples of motion.{angle} scatter by some {:.2} deg (noise, or single ones that are wrong): beyond harmonic {} there are rates of {:.0} % of those of the motion{few}; look at the samples, then fit them by `harmonics = {}` in this table, or give smoother ones",
            s.deviation.to_degrees(),
            s.harmonics,
            100.0 * s.rates,
            s.harmonics
        )
    }
}

/// What is said of wings, each text once with the names of those that it is said of.
fn of_wings<'a>(all: impl Iterator<Item = (String, &'a str)>) -> Vec<String> {
    let say = |(text, wings): (String, Vec<&str>)| {
        let what = if wings.len() == 1 { "wing" } else { "wings" };
        format!("{what} {}: {text}", names(wings, ", "))
    };
    grouped(all).into_iter().map(say).collect()
}

/// The gap between the samples of a table, if there is one.
fn say_gap(angle: &str, table: &PeriodicSpline) -> Option<String> {
    let rows: Vec<(f64, f64)> = table.rows().collect();
    let apart: Vec<f64> = rows.windows(2).map(|two| two[1].0 - two[0].0).collect();
    let at = (0..apart.len()).max_by(|&a, &b| apart[a].total_cmp(&apart[b]))?;
    let gap = apart[at];
    let usual = median(apart)?;
    (gap > GAP[0].max(GAP[1] * usual)).then(|| {
        format!(
            "motion.{angle} has no samples from phase {:.3} to {:.3}, where others are {usual:.4} wingbeats apart: the spline crosses the gap as it happens to; give the samples that are missing, or fit the others by `harmonics`",
            rows[at].0,
            rows[at + 1].0
        )
    })
}

/// Least part of a wingbeat, and least multiple of the usual distance of samples, that is a gap \[1\].
const GAP: [f64; 2] = [0.05, 8.0];

/// A jump is more than so many times any other step from sample to sample: a wrong sample has two steps.
const JUMPS: f64 = 5.0;

/// One step from a sample to the next that is of another kind than all others.
struct Jump {
    /// Phase of the sample after it \[wingbeats\].
    phase: f64,
    /// Its size, and that of the largest other step \[rad\].
    sizes: [f64; 2],
    /// Whether it is the step from the last sample to the first.
    closes: bool,
}

impl Jump {
    fn of(table: &PeriodicSpline) -> Option<Self> {
        let rows: Vec<(f64, f64)> = table.rows().collect();
        let steps = rows.windows(2).map(|two| (two[1].1 - two[0].1).abs());
        let mut sizes: Vec<(usize, f64)> = steps.enumerate().collect();
        sizes.sort_by(|a, b| b.1.total_cmp(&a.1));
        let [(at, most), (_, next), ..] = sizes[..] else {
            return None;
        };
        (most > JUMPS * next).then(|| Self {
            phase: rows[at + 1].0,
            sizes: [most, next],
            closes: at + 2 == rows.len(),
        })
    }
}

fn say_jump(angle: &str, jump: &Jump) -> String {
    let [most, next] = jump.sizes.map(f64::to_degrees);
    let place = match jump.closes {
        true => "at the end of the beat".to_owned(),
        false => format!("before phase {:.4}", jump.phase),
    };
    format!(
        "motion.{angle} jumps by {most:.1} deg {place}, where other samples are {next:.2} deg apart at most: wings do not move so; give samples of a whole wingbeat that ends where it began, in one branch of the angle (no leap of 180 or 360 deg)"
    )
}

/// The angles of a wing that are tables.
fn tables(wing: &Wing) -> impl Iterator<Item = (&'static str, &PeriodicSpline)> {
    let laws = &wing.motion.angles;
    let angles = [
        ("phi", &laws.phi),
        ("theta", &laws.theta),
        ("psi", &laws.psi),
    ];
    angles.into_iter().filter_map(|(name, law)| match law {
        AngleLaw::Table(table) => Some((name, table)),
        _ => None,
    })
}

/// The angles of a wing whose samples scatter, by noise or by a single jump.
fn scatters(wing: &Wing) -> impl Iterator<Item = (&'static str, Scatter, Option<Jump>)> {
    tables(wing).filter_map(|(name, table)| Some((name, table.scatter()?, Jump::of(table))))
}
