//! Gusts that the steps do not resolve: shorter than some of them, or, as turbulence, with a time scale below
//! one.
//!
//! A one-minus-cosine gust of N steps gives a fruit fly in blade elements an impulse that is wrong, by where it
//! begins between the steps, by up to 4 % at N = 3, 10 % at 2.5, 26 % at 2 and 60 % at 1.5; of less than 1.2
//! steps it may have the wrong sign, or nothing is felt of it. Turbulence of the time scale T and the
//! autocorrelation exp(-t / T) that is looked at every h has `h / (2 T) coth(h / (2 T))` times its spectral
//! density at low frequencies: 1 % too much at T = 3 h, 8 % at h, 31 % at h / 2, and ever more.

use wingbeat_air::{Gust, GustShape};
use wingbeat_math::DVec3;

use crate::setup::FlightSetup;

/// Steps that resolve a gust \[1\].
const STEPS: f64 = 3.0;

/// Steps in the time scale of turbulence that resolve it \[1\].
const STEPS_OF_TURBULENCE: f64 = 1.0;

/// Part of the range of a table that a peak has to count \[1\].
const COUNTS: f64 = 0.1;

/// Rounding of a ratio of times \[1\].
const ROUNDING: f64 = 1e-9;

/// What is short in a gust: key and value, how long it is \[s\], the steps that it takes \[1\].
struct Short {
    what: String,
    time: f64,
    steps: f64,
}

impl FlightSetup {
    /// Says which gusts of the wind the steps do not resolve, as the flyer meets them with the velocity of the
    /// start.
    pub fn gusts_between_steps(&self) -> Vec<String> {
        let Some(wind) = self.air.wind() else {
            return vec![];
        };
        let root = self.root_at_start();
        let (h, end) = (self.time.step, self.time.steps as f64 * self.time.step);
        let say = |(k, g): (usize, &Gust)| {
            if g.amplitude == DVec3::ZERO {
                return None;
            }
            // The gust's own time runs faster or slower past a flyer that meets or follows its front.
            let rate = (1.0 - g.slowness.dot(root.v)).abs();
            let own = [0.0, end].map(|t| t - g.start - g.slowness.dot(root.p + root.v * t));
            let flown = [own[0].min(own[1]), own[0].max(own[1])];
            let short = short(&g.shape, flown)?;
            let length = short.time / rate;
            (length / h < short.steps * (1.0 - ROUNDING)).then(|| {
                let what = &short.what;
                let (steps, most) = (length / h, length / short.steps);
                match g.shape {
                    GustShape::Turbulence(_) => format!(
                        "air.gust[{k}]{what} is {length:.1e} s to the flyer, {steps:.1} steps of {h:.1e} s: what changes faster than the \
                         steps is aliased, and the spectral density at low frequencies comes out {:.0} % too large; take steps of \
                         at most {most:.1e} s (time.steps_per_beat, or time.step_s), or a longer time_scale_s",
                        100.0 * aliased(steps)
                    ),
                    _ => format!(
                        "air.gust[{k}]{what} passes the flyer in {length:.1e} s, {steps:.1} steps of {h:.1e} s: its impulse comes out \
                         wrong, or is missing; take steps of at most {most:.1e} s (time.steps_per_beat, or time.step_s), or a \
                         longer gust"
                    ),
                }
            })
        };
        wind.gusts.iter().enumerate().filter_map(say).collect()
    }
}

/// Part by which the spectral density of turbulence at low frequencies is too large where its time scale takes
/// so many `steps` \[1\].
fn aliased(steps: f64) -> f64 {
    let x = 0.5 / steps;
    x / x.tanh() - 1.0
}

/// What of a gust may be too short, of what of it is `flown` in its own time \[s\].
fn short(shape: &GustShape, flown: [f64; 2]) -> Option<Short> {
    match shape {
        GustShape::OneMinusCosine { duration } => {
            (flown[1] > 0.0 && flown[0] < *duration).then(|| Short {
                what: format!(".duration_s = {duration:e}"),
                time: *duration,
                steps: STEPS,
            })
        }
        GustShape::Table(rows) => {
            let (at, width) = narrowest_peak(rows, flown)?;
            Some(Short {
                what: format!(".table: the peak at {at:e} s"),
                time: width,
                steps: STEPS,
            })
        }
        GustShape::Turbulence(t) => (flown[1] > 0.0).then(|| Short {
            what: format!(".turbulence.time_scale_s = {:e}", t.time_scale),
            time: t.time_scale,
            steps: STEPS_OF_TURBULENCE,
        }),
    }
}

/// When the narrowest peak or trough that counts begins, and how long it is, foot to foot \[s\], of those
/// `flown`.
fn narrowest_peak(rows: &[(f64, f64)], flown: [f64; 2]) -> Option<(f64, f64)> {
    let levels = turns(rows);
    let values = || levels.iter().map(|(_, value)| *value);
    let range = values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min);
    let peaks = levels.windows(3).filter_map(|w| {
        let height = (w[1].1 - w[0].1).abs().min((w[1].1 - w[2].1).abs());
        let (from, to) = (w[0].0[1], w[2].0[0]);
        let is_flown = to > flown[0] && from < flown[1];
        (is_flown && height > COUNTS * range).then_some((w[1].0[0], to - from))
    });
    peaks.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Where a table turns: from when to when it stays \[s\], and its value; what was before the first row is
/// nothing.
fn turns(rows: &[(f64, f64)]) -> Vec<([f64; 2], f64)> {
    let Some(first) = rows.first() else {
        return vec![];
    };
    let mut levels = vec![([f64::MIN, first.0], 0.0)];
    for &(time, value) in rows {
        let n = levels.len();
        let last = levels[n - 1];
        if value == last.1 {
            levels[n - 1].0[1] = time;
            continue;
        }
        // A row on the way from one turn to the next is none.
        if n > 1 && (value - last.1) * (last.1 - levels[n - 2].1) > 0.0 {
            levels.pop();
        }
        levels.push(([time; 2], value));
    }
    levels
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [f64; 2] = [f64::MIN, f64::MAX];

    /// The spectral density of what is looked at every h is the sum of the autocorrelation:
    /// h (1 + 2 sum exp(-k h / T)) for 2 T.
    #[test]
    fn exact_density_of_aliased_turbulence_is_the_sum_of_its_autocorrelation() {
        for steps in [0.05_f64, 0.5, 1.0, 3.0] {
            let sum: f64 = (1..200).map(|k| (-f64::from(k) / steps).exp()).sum();
            let part = (1.0 + 2.0 * sum) / (2.0 * steps) - 1.0;
            assert!((aliased(steps) / part - 1.0).abs() < 1e-12, "{steps}");
        }
    }

    #[test]
    fn exact_narrowest_peaks_of_tables() {
        let triangle = [
            (0.0, 0.0),
            (1.0, 1.0),
            (2.0, 0.0),
            (9.0, 0.0),
            (9.5, 1.0),
            (10.0, 0.0),
        ];
        assert_eq!(narrowest_peak(&triangle, ALL), Some((9.5, 1.0)));
        assert_eq!(narrowest_peak(&triangle, [0.0, 8.0]), Some((1.0, 2.0)));
        let plateau = [(0.0, 0.0), (0.1, 1.0), (3.0, 1.0), (3.1, 0.0)];
        assert!((narrowest_peak(&plateau, ALL).unwrap().1 - 3.1).abs() < 1e-12);
        // A wind that rises and stays has none, however steep it is, nor has a ripple, or what it parts.
        assert_eq!(
            narrowest_peak(&[(0.0, 0.0), (1e-9, 0.5), (2e-9, 1.0)], ALL),
            None
        );
        let ripple = [(0.0, 0.0), (5.0, 1.0), (5.1, 0.99), (5.2, 1.0), (9.0, 0.0)];
        assert_eq!(narrowest_peak(&ripple, ALL), None);
    }
}
