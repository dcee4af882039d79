//! From what was flown or found to the numbers that are kept.

use std::collections::HashMap;
use std::ops::RangeInclusive;

use wingbeat_analysis::{
    AnalysisError, LinearModel, ModeSet, Power, Trim, floquet_of_trim, linear_model,
};
use wingbeat_flight::{FlightSetup, Record};
use wingbeat_math::{larger, smaller};
use wingbeat_results::Summary;
use wingbeat_results::columns::Columns;
use wingbeat_results::summary::{BeatMeans, Estimate, PerBeat, starting_beats, what_starts};

use crate::plan::number::{ModeNumber, Modes, Number, Of, Source, TrimNumber};

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
    /// That it has fewer wingbeats than means are taken over beyond those that its start or its hold reach into, in words;
    /// none where it has enough.
    pub fn lacks(&self, numbers: &[Number], beats: usize) -> Option<String> {
        if !needs_beats(numbers, &self.setup) {
            return None;
        }
        let (flown, out) = (self.summary.beats.len(), starting_beats(&self.setup));
        let left = flown.saturating_sub(out);
        (left < beats).then(|| match out {
            0 => format!(
                "means over {beats} wingbeats, but only {flown} whole ones were flown: fly longer (time.beats), or take mean_beats = {}",
                flown.max(1)
            ),
            _ => format!(
                "means over {beats} wingbeats, and {left} are left of {flown} whole ones that were flown: means leave out those that {} reach into; fly longer (time.beats = {} or more)",
                what_starts(&self.setup),
                out + beats
            ),
        })
    }

    /// Its numbers, put where `numbers` has them (others are left as they are).
    ///
    /// # Errors
    /// Nothing flown; records of its wingbeats that are not at hand.
    pub fn fill(&self, numbers: &[Number], beats: usize, values: &mut [f64]) -> Result<(), String> {
        let means = &self.summary.beats;
        let last = &means[means.len().saturating_sub(beats)..];
        let columns = self.columns(numbers)?;
        for (number, value) in numbers.iter().zip(values) {
            let each = |of: fn(&PerBeat) -> Option<f64>| {
                last.iter().map(move |b| of(&b.mean).unwrap_or(f64::NAN))
            };
            let mean = |of| each(of).sum::<f64>() / last.len().max(1) as f64;
            match &number.source {
                Source::Beat(of) => *value = mean(*of),
                Source::Error(of) => {
                    let each: Vec<f64> = each(*of).collect();
                    *value = Estimate::of(&each).standard_error.unwrap_or(f64::NAN);
                }
                Source::Efficiency => {
                    let useful = mean(|m| Some(m.thrust_newton)) * self.airspeed(last);
                    *value = efficiency(useful, mean(|m| Some(m.power_watt)));
                }
                Source::Column(of, name) => {
                    *value = match columns.get(&name[..]) {
                        Some(column) => self.taken(*of, column, last)?,
                        None => f64::NAN,
                    };
                }
                Source::Summary(of) => *value = of(&self.summary).unwrap_or(f64::NAN),
                _ => {}
            }
        }
        Ok(())
    }

    /// Numbers of the rows of the last wingbeats.
    fn span(&self, beats: &[BeatMeans]) -> RangeInclusive<usize> {
        let each = self.setup.time.steps_per_beat().unwrap_or(0);
        let end = beats.last().map_or(0, |b| b.beat * each);
        let start = end - beats.len() * each;
        let at = |step: usize| self.records.partition_point(|r| r.step < step);
        at(start)..=at(end)
    }

    /// The rows of the last wingbeats.
    fn rows(&self, beats: &[BeatMeans]) -> &[Record] {
        self.records.get(self.span(beats)).unwrap_or(&[])
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

    /// The columns that `numbers` are taken of, row by row, by their names; without those that this flight has none of.
    ///
    /// # Errors
    /// Nothing flown.
    fn columns<'a>(&self, numbers: &'a [Number]) -> Result<HashMap<&'a str, Vec<f64>>, String> {
        let name = |n: &'a Number| match &n.source {
            Source::Column(_, name) => Some(&name[..]),
            _ => None,
        };
        let mut columns: HashMap<&str, Vec<f64>> = numbers
            .iter()
            .filter_map(name)
            .map(|n| (n, vec![]))
            .collect();
        if columns.is_empty() {
            return Ok(columns);
        }
        let first = self.records.first().ok_or("nothing was flown")?;
        let all = Columns::of(&self.setup, first).map_err(|e| e.to_string())?;
        let places: HashMap<&str, usize> = (all.iter().enumerate())
            .map(|(k, c)| (&c.name[..], k))
            .collect();
        columns.retain(|name, _| places.contains_key(name));
        let mut row = first.clone();
        for record in &self.records {
            row.clone_from(record);
            for (name, column) in &mut columns {
                column.push(all.value(places[name], &mut row));
            }
        }
        Ok(columns)
    }

    /// What is taken of a column.
    ///
    /// # Errors
    /// Records of its wingbeats that are not at hand.
    fn taken(&self, of: Of, column: &[f64], beats: &[BeatMeans]) -> Result<f64, String> {
        let rows = match (of, beats) {
            (Of::Mean, beats) | (_, beats @ [_, ..]) => self.span(beats),
            (_, []) => 0..=column.len() - 1,
        };
        let gone = || "records of its wingbeats are not at hand".to_owned();
        let known = column.get(rows.clone()).ok_or_else(gone);
        Ok(match of {
            Of::End => column[column.len() - 1],
            Of::Min => known?.iter().copied().fold(f64::INFINITY, smaller),
            Of::Max => known?.iter().copied().fold(f64::NEG_INFINITY, larger),
            Of::Mean => {
                let (values, records) = (known?, &self.records[rows]);
                let [first, .., last] = records else {
                    return Err(gone());
                };
                let pairs = records.windows(2).zip(values.windows(2));
                let area = pairs.map(|(r, v)| 0.5 * (v[0] + v[1]) * (r[1].time - r[0].time));
                area.sum::<f64>() / (last.time - first.time)
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

/// Useful power over the power of the wings; none where this is not positive: air that drives the wings is not
/// propulsion.
fn efficiency(useful: f64, power: f64) -> f64 {
    if power > 0.0 {
        useful / power
    } else {
        f64::NAN
    }
}

#[cfg(test)]
mod tests {
    use wingbeat_case::LoadedCase;
    use wingbeat_flight::Simulation;
    use wingbeat_results::Outcome;

    use super::*;
    use crate::plan::number::{find, registry};

    /// Means and extremes over a wingbeat of which a row is gone say so; the end is the last row that there is.
    #[test]
    fn refuses_means_and_extremes_of_rows_that_are_gone() {
        let set = ["time.beats=1".to_owned()];
        let setup = LoadedCase::find("fruit-fly-blade", &set).unwrap().setup;
        let mut flight = Simulation::new(setup.clone()).unwrap();
        let mut records = vec![flight.record().clone()];
        while !flight.finished() {
            records.push(flight.step().unwrap().clone());
        }
        let all = registry(&setup).unwrap();
        let name = "body_z_m";
        let mut flown = Flown {
            summary: Summary::of(&setup, &records, &Outcome::Finished),
            records,
            setup,
        };
        let of = |flown: &Flown, prefix: &str| {
            let number = find(&all, &format!("{prefix}{name}")).unwrap();
            let mut value = [0.0];
            flown.fill(&[number], 1, &mut value).map(|()| value[0])
        };
        let places = flown.records.iter().map(|r| r.coordinates[2]);
        let [least, most] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| {
            [a.min(x), b.max(x)]
        });
        assert_eq!(of(&flown, "min."), Ok(least));
        assert_eq!(of(&flown, "max."), Ok(most));
        assert!((least..=most).contains(&of(&flown, "").unwrap()));
        flown.records.pop();
        for prefix in ["", "min.", "max."] {
            let refused = of(&flown, prefix).unwrap_err();
            assert_eq!(refused, "records of its wingbeats are not at hand");
        }
        let last = flown.records[flown.records.len() - 1].coordinates[2];
        assert_eq!(of(&flown, "end."), Ok(last));
    }

    #[test]
    fn exact_wings_that_the_air_drives_have_no_efficiency() {
        assert_eq!(efficiency(1.0, 4.0), 0.25);
        assert_eq!(efficiency(-1.0, 4.0), -0.25); // drag
        assert!(efficiency(-1.0, -0.06).is_nan());
        assert!(efficiency(1.0, 0.0).is_nan());
    }
}
