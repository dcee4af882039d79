//! Which part of a flight a figure shows, and which of its steps, in words for titles.

use std::ops::Range;

use wingbeat_flight::FlightSetup;
use wingbeat_results::summary::ordinal;

/// What stands in a figure: the whole flight or some of it, every step or every so many.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TimeWindow {
    /// Where it begins and ends, if it is not the whole flight, on the time axis: wingbeats where there are any, else
    /// seconds.
    range: Option<[f64; 2]>,
    /// Whether there are wingbeats.
    beating: bool,
    /// Steps from row to row of the history.
    every: usize,
    /// Number, from 1, of the last whole wingbeat in it, and whether it is the last of the flight.
    beat: Option<(usize, bool)>,
    /// How long the flight is, on the time axis.
    length: f64,
}

impl TimeWindow {
    /// Rows of a history with these times \[s\], which holds every so many steps.
    pub fn of(setup: &FlightSetup, every: usize, times: &[f64], rows: &Range<usize>) -> Self {
        let at = |k: usize| {
            times
                .get(k)
                .map_or(0.0, |t| t / setup.time.period.unwrap_or(1.0))
        };
        let end = at(rows.end.saturating_sub(1));
        let length = at(times.len().saturating_sub(1));
        let whole = |x: f64| (x + 1e-6).floor() as usize;
        let beat = whole(end);
        let inside = beat as f64 > at(rows.start) + 1.0 - 1e-6;
        let beating = setup.time.period.is_some();
        Self {
            range: (*rows != (0..times.len())).then(|| [at(rows.start), end]),
            beating,
            every,
            beat: (beating && inside).then(|| (beat, beat == whole(length))),
            length,
        }
    }

    /// The whole flight, of whose steps the history holds every one.
    pub fn whole(setup: &FlightSetup) -> Self {
        Self::of(setup, 1, &[], &(0..0))
    }

    /// What a title says of it: nothing of all steps of a whole flight.
    pub fn note(&self) -> String {
        let range = match self.range {
            Some([from, to]) => format!(", {} to {} {}", short(from), short(to), self.unit()),
            None => String::new(),
        };
        range + &self.thinning()
    }

    /// What a title says of the steps that are left out.
    pub fn thinning(&self) -> String {
        match self.every {
            0 | 1 => String::new(),
            n => format!(", every {} step", ordinal(n)),
        }
    }

    /// What a title says of figures that show the extremes of so many rows.
    pub fn extremes(&self, group: usize) -> String {
        let of = if self.every > 1 { "of them" } else { "steps" };
        match group {
            1 => self.note(),
            n => format!("{}, extremes of every {n} {of}", self.note()),
        }
    }

    /// The place it begins at.
    pub fn start(&self) -> String {
        match (self.range, self.beating) {
            (Some([from, _]), true) if from > 0.0 => match short(from) {
                1.0 => "after 1 beat".to_owned(),
                n => format!("after {n} beats"),
            },
            (Some([from, _]), false) if from > 0.0 => format!("at {} s", short(from)),
            _ => "start".to_owned(),
        }
    }

    /// What differences to the first place are counted from.
    pub fn origin(&self) -> &'static str {
        match self.range {
            Some([from, _]) if from > 0.0 => "the start of this part",
            _ => "the start",
        }
    }

    /// Start and end, and words, of the wingbeat that stands for all: the last whole one, or all of a flight that has
    /// none \[wingbeats\].
    pub fn beat(&self) -> Option<([f64; 2], String)> {
        match self.beat {
            Some((n, is_last)) => {
                let words = match is_last {
                    true if self.length - n as f64 > 1e-6 => {
                        format!("in wingbeat {n}, the last whole one")
                    }
                    true => "in the last wingbeat".to_owned(),
                    false => format!("in wingbeat {n}"),
                };
                Some(([n as f64 - 1.0, n as f64], words))
            }
            None if self.range.is_none() => Some((
                [0.0, 1.0],
                format!("in the first {} wingbeats", short(self.length)),
            )),
            None => None,
        }
    }

    /// Why there is no wingbeat in it, if there may be one elsewhere in the flight.
    pub fn lacks_beat(&self) -> Option<String> {
        let [from, to] = self.range.filter(|_| self.beating && self.beat.is_none())?;
        Some(format!(
            "there is no whole wingbeat from {} to {} wingbeats (they are counted from the start of the flight: 0 to 1, 1 to 2, ...); choose another --from, --to or --beats",
            short(from),
            short(to)
        ))
    }

    fn unit(&self) -> &'static str {
        if self.beating { "wingbeats" } else { "s" }
    }
}

/// At most four decimals.
fn short(x: f64) -> f64 {
    (x * 1e4).round() / 1e4
}

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat_case::LoadedCase;

    /// Twelve wingbeats of four steps, of which the history holds every second.
    #[test]
    fn exact_parts_of_a_flight_are_named() {
        let setup = LoadedCase::find("fruit-fly-vacuum", &[]).unwrap().setup;
        let period = setup.time.period.unwrap();
        let times: Vec<f64> = (0..=24).map(|k| f64::from(k) * period / 2.0).collect();
        let part = |rows| TimeWindow::of(&setup, 2, &times, &rows);
        let all = part(0..25);
        assert_eq!(
            (&all.note()[..], &all.start()[..]),
            (", every 2nd step", "start")
        );
        assert_eq!(
            all.beat().unwrap(),
            ([11.0, 12.0], "in the last wingbeat".to_owned())
        );
        assert_eq!(
            all.extremes(9),
            ", every 2nd step, extremes of every 9 of them"
        );
        let some = part(15..22);
        assert_eq!(some.note(), ", 7.5 to 10.5 wingbeats, every 2nd step");
        assert_eq!(some.start(), "after 7.5 beats");
        assert_eq!(
            some.beat().unwrap(),
            ([9.0, 10.0], "in wingbeat 10".to_owned())
        );
        let half = part(6..8);
        assert!(half.beat().is_none());
        assert!(
            half.lacks_beat()
                .unwrap()
                .contains("no whole wingbeat from 3 to 3.5 wingbeats")
        );
        assert!(part(20..23).lacks_beat().is_none() && all.lacks_beat().is_none());
    }
}
