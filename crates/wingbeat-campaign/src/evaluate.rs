//! From what was flown or found to the numbers that are kept.

use wingbeat_analysis::{
    AnalysisError, LinearModel, ModeSet, Power, Trim, floquet_of_trim, linear_model,
};
use wingbeat_flight::{FlightSetup, Record};
use wingbeat_results::Summary;
use wingbeat_results::columns::Columns;
use wingbeat_results::summary::{BeatMeans, Estimate};

use crate::number::{ModeNumber, Modes, Number, Of, Source, TrimNumber};

/// A flight that was flown.
pub struct Flown {
    /// What was flown.
    pub setup: FlightSetup,
    /// One record per step, or per row of a history that leaves steps out.
    pub records: Vec<Record>,
    /// Of all steps.
    pub summary: Summary,
}

impl Flown {
    /// That it has fewer wingbeats than means are taken over, in words; none where it has enough.
    pub fn lacks(&self, numbers: &[Number], beats: usize) -> Option<String> {
        if !needs_beats(numbers, &self.setup) {
            return None;
        }
        let flown = self.summary.beats.len();
        let words = || {
            format!(
                "means over {beats} wingbeats, but only {flown} whole ones were flown: fly longer (time.beats), or take mean_beats = {}",
                flown.max(1)
            )
        };
        (flown < beats).then(words)
    }

    /// Its numbers, put where `numbers` has them (others are left as they are).
    ///
    /// # Errors
    /// Nothing flown; records of its wingbeats that are not at hand.
    pub fn fill(&self, numbers: &[Number], beats: usize, values: &mut [f64]) -> Result<(), String> {
        let means = &self.summary.beats;
        let last = &means[means.len().saturating_sub(beats)..];
        for (number, value) in numbers.iter().zip(values) {
            let mean = |of: fn(&BeatMeans) -> f64| {
                last.iter().map(of).sum::<f64>() / last.len().max(1) as f64
            };
            match &number.source {
                Source::Beat(of) => *value = mean(*of),
                Source::Error(of) => {
                    let each: Vec<f64> = last.iter().map(*of).collect();
                    *value = Estimate::of(&each).standard_error.unwrap_or(f64::NAN);
                }
                Source::Efficiency => {
                    let useful = mean(|b| b.thrust_newton) * self.airspeed(last);
                    *value = efficiency(useful, mean(|b| b.power_watt));
                }
                Source::Column(of, name) => *value = self.column(*of, name, last)?,
                Source::Summary(of) => *value = of(&self.summary),
                _ => {}
            }
        }
        Ok(())
    }

    /// The rows of the last wingbeats.
    fn rows(&self, beats: &[BeatMeans]) -> &[Record] {
        let each = self.setup.time.steps_per_beat().unwrap_or(0);
        let end = beats.last().map_or(0, |b| b.beat * each);
        let start = end - beats.len() * each;
        let at = |step: usize| self.records.partition_point(|r| r.step < step);
        self.records.get(at(start)..=at(end)).unwrap_or(&[])
    }

    /// Mean speed of the mass centre along n1 through the air [m/s].
    fn airspeed(&self, beats: &[BeatMeans]) -> f64 {
        let stream = self.setup.air.stream().map_or(0.0, |s| s.x);
        match self.rows(beats) {
            [first, .., last] => {
                (last.mass_centre.x - first.mass_centre.x) / (last.time - first.time) - stream
            }
            _ => f64::NAN,
        }
    }

    /// What is taken of a column; not a number where this flight has none of that name.
    fn column(&self, of: Of, name: &str, beats: &[BeatMeans]) -> Result<f64, String> {
        let first = self.records.first().ok_or("nothing was flown")?;
        let columns = Columns::of(&self.setup, first).map_err(|e| e.to_string())?;
        let Some(place) = columns.iter().position(|c| c.name == name) else {
            return Ok(f64::NAN);
        };
        let (mut scratch, mut row) = (first.clone(), vec![]);
        let mut value = |r: &Record| {
            columns.values(r, &mut scratch, &mut row);
            row[place]
        };
        let all = &self.records[..];
        let counted = match beats {
            [] => all,
            beats => self.rows(beats),
        };
        Ok(match of {
            Of::End => value(&all[all.len() - 1]),
            Of::Min => counted.iter().map(value).fold(f64::INFINITY, f64::min),
            Of::Max => (counted.iter().map(value)).fold(f64::NEG_INFINITY, f64::max),
            Of::Mean => {
                let rows = self.rows(beats);
                let [first, .., last] = rows else {
                    return Err("records of its wingbeats are not at hand".to_owned());
                };
                let time = last.time - first.time;
                let values: Vec<f64> = rows.iter().map(value).collect();
                let pairs = rows.windows(2).zip(values.windows(2));
                let area = pairs.map(|(r, v)| 0.5 * (v[0] + v[1]) * (r[1].time - r[0].time));
                area.sum::<f64>() / time
            }
        })
    }
}

/// Whether any of the numbers is taken over wingbeats of flights of `setup`.
pub fn needs_beats(numbers: &[Number], setup: &FlightSetup) -> bool {
    let has_beats = setup.time.steps_per_beat().is_some();
    let wants = |n: &Number| n.source.is_mean() && (has_beats || !n.source.is_extreme());
    numbers.iter().any(wants)
}

/// Whether any of the numbers is taken of every step of the history.
pub fn need_every_step(numbers: &[Number]) -> bool {
    numbers.iter().any(|n| n.source.needs_every_step())
}

/// Numbers of a trim.
pub fn of_trim(trim: &Trim, numbers: &[Number], values: &mut [f64]) {
    for (number, value) in numbers.iter().zip(values) {
        if let Source::Trim(what) = &number.source {
            *value = match what {
                TrimNumber::Unknown(u) => trim.solution.value(*u).unwrap_or(f64::NAN),
                TrimNumber::Residual => trim.solution.error(),
                TrimNumber::Iterations => trim.solution.iterations as f64,
            };
        }
    }
}

/// Modes and derivatives of a trimmed flight.
///
/// # Errors
/// What the analysis does not cover.
pub fn of_stability(
    trim: &Trim,
    numbers: &[Number],
    values: &mut [f64],
) -> Result<(), AnalysisError> {
    let orbit = floquet_of_trim(trim)?;
    let averaged: Option<LinearModel> = match numbers.iter().any(|n| n.source.needs_average()) {
        true => {
            trim.beat.check_averaged()?;
            Some(linear_model(&trim.beat, &trim.state)?)
        }
        false => None,
    };
    let of = |set: Option<&ModeSet>, k: usize, what: ModeNumber| {
        let mode = set.and_then(|s| s.modes.get(k));
        mode.map_or(f64::NAN, |m| match what {
            ModeNumber::Growth => m.growth,
            ModeNumber::Frequency => m.frequency,
        })
    };
    for (number, value) in numbers.iter().zip(values) {
        match &number.source {
            Source::Mode(Modes::Floquet, k, what) => *value = of(Some(&orbit), *k, *what),
            Source::Mode(Modes::Averaged, k, what) => {
                *value = of(averaged.as_ref().map(|a| &a.modes), *k, *what);
            }
            Source::Derivative(load, motion) => {
                *value = averaged
                    .as_ref()
                    .map_or(f64::NAN, |a| a.derivatives[*load][*motion]);
            }
            _ => {}
        }
    }
    Ok(())
}

/// Powers.
pub fn of_power(power: &Power, numbers: &[Number], values: &mut [f64]) {
    for (number, value) in numbers.iter().zip(values) {
        if let Source::Power(of) = &number.source {
            *value = of(power);
        }
    }
}

/// Useful power over the power of the wings; none where this is not positive: air that drives the wings is not propulsion.
fn efficiency(useful: f64, power: f64) -> f64 {
    if power > 0.0 {
        useful / power
    } else {
        f64::NAN
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_wings_that_the_air_drives_have_no_efficiency() {
        assert_eq!(efficiency(1.0, 4.0), 0.25);
        assert_eq!(efficiency(-1.0, 4.0), -0.25); // drag
        assert!(efficiency(-1.0, -0.06).is_nan());
        assert!(efficiency(1.0, 0.0).is_nan());
    }
}
