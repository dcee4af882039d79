//! Means over many wingbeats with their standard errors, and whether the wingbeats still change.

use serde::{Deserialize, Serialize};
use wingbeat_flight::{FlightSetup, MotionMode};

use super::beats::BeatMeans;
use super::estimate::{
    Estimate, FEWEST, MAX_CORRELATION, correlation, moments, within_nineteen_of_twenty,
};
use super::per_beat::{PerBeat, force};

/// Fewest beats at the start that means over wingbeats leave out: the wake comes up.
const LEFT_OUT: usize = 2;

/// Part of a wingbeat that is rounding of the steps \[1\].
const ROUNDING: f64 = 1e-6;

/// Beats at the start of a flight of `setup` that means over wingbeats leave out: the first two, in which the wake comes
/// up, and all that the smooth starts of strokes and of a moving tether, or the hold before the release, reach into.
/// What is held to its end has no release, and its beats count as those of a tethered body.
///
/// ```
/// let set = ["time.beats=9", "flight.held_beats=3"].map(str::to_owned);
/// let case = wingbeat_case::LoadedCase::find("fruit-fly-blade", &set)?;
/// assert_eq!(wingbeat_results::summary::left_out(&case.setup), 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn left_out(setup: &FlightSetup) -> usize {
    starting_beats(setup).max(LEFT_OUT)
}

/// Beats at the start of a flight of `setup` that smooth starts of strokes and of a moving tether, or the hold before the
/// release, reach into: none of them is a beat of the flight that is asked about. 0 of a flight without wingbeats.
///
/// ```
/// let set = ["motion.start=smooth", "motion.start_beats=1.5"].map(str::to_owned);
/// let case = wingbeat_case::LoadedCase::find("fruit-fly-blade", &set)?;
/// assert_eq!(wingbeat_results::summary::starting_beats(&case.setup), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn starting_beats(setup: &FlightSetup) -> usize {
    let Some(period) = setup.time.period else {
        return 0;
    };
    let beats = |time: f64| (time / period - ROUNDING).ceil().max(0.0) as usize;
    let reached = setup.smooth_starts().map(beats);
    let held = held_steps(setup) as f64 * setup.time.step;
    reached.into_iter().chain([beats(held)]).fold(0, usize::max)
}

/// What reaches into the [`starting_beats`] of a flight, in words with its keys.
pub fn what_starts(setup: &FlightSetup) -> &'static str {
    match held_steps(setup) {
        0 => "smooth starts (motion.start_beats, flight.tether.start_s)",
        _ => {
            "a smooth start or the hold before the release (motion.start_beats, flight.held_beats)"
        }
    }
}

/// Steps before the release; 0 where nothing is held, or held to the end.
fn held_steps(setup: &FlightSetup) -> usize {
    match &setup.mode {
        MotionMode::Free(start) if start.held_steps < setup.time.steps => start.held_steps,
        _ => 0,
    }
}

/// Why a flight whose beats would be enough has no means over them; none where too few were flown, or it has.
pub(super) fn too_few_left(setup: &FlightSetup, flown: usize) -> Option<String> {
    let out = left_out(setup);
    let left = flown.saturating_sub(out);
    (flown >= LEFT_OUT + FEWEST && left < FEWEST).then(|| {
        format!(
            "No mean over wingbeats: means leave out the beats that {} reach into, of {flown} flown {left} are left, and three are needed: time.beats = {} or more.",
            what_starts(setup),
            out + FEWEST
        )
    })
}

/// A change of the force from the first half of the beats to the second, in parts of it, that is none.
const NO_CHANGE: f64 = 0.01;

/// A change that must show beside the scatter of the beats if they are to count as steady.
const MUST_SHOW: f64 = 0.1;

/// Means over the wingbeats after those that are left out ([`left_out`]).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ManyBeats {
    /// First and last beat, from 1.
    pub beats: [usize; 2],
    /// The means with their errors.
    #[serde(flatten)]
    pub estimate: PerBeat<Estimate>,
    /// Change of lift from the first half of these beats to the second, over the mean force \[1\].
    pub change_of_lift: f64,
    /// The same of the thrust \[1\].
    #[serde(default)]
    pub change_of_thrust: f64,
    /// The same of the force along n2 \[1\].
    #[serde(default)]
    pub change_of_side_force: f64,
    /// Whether the changes of lift and of the force along n1 and n2, taken together, are less than a hundredth, or than
    /// the scatter of the beats makes in 19 of 20 flights, and this is less than a tenth of the force.
    pub is_steady: bool,
    /// Whether the beats tell that: not steady is what changes by more than their scatter makes, unknown is where that
    /// would be more than a tenth.
    #[serde(default = "yes")]
    pub is_known: bool,
}

/// Results that do not say it were written when nothing was unknown.
fn yes() -> bool {
    true
}

impl ManyBeats {
    /// Of the wingbeats of a flight without the first `left_out` ([`left_out`]); none if there are fewer than three more.
    pub fn of(beats: &[BeatMeans], left_out: usize) -> Option<Self> {
        let beats = beats.get(left_out..).filter(|b| b.len() >= FEWEST)?;
        let estimate = PerBeat::joined(beats.iter().map(|b| &b.mean), Estimate::of);
        let size = mean_force(&estimate).max(f64::MIN_POSITIVE);
        let forces: [fn(&BeatMeans) -> f64; 3] = [
            |b| b.mean.lift_newton,
            |b| b.mean.thrust_newton,
            |b| b.mean.side_force_newton,
        ];
        let changes = forces.map(|of| Change::of(&beats.iter().map(of).collect::<Vec<_>>(), size));
        let [lift, thrust, side] = &changes;
        let judged = [*lift, thrust.with(side)];
        let changed = judged.iter().any(Change::is_felt);
        let hidden = judged.iter().any(|c| c.hidden > MUST_SHOW);
        Some(Self {
            beats: [beats[0].beat, beats[beats.len() - 1].beat],
            estimate,
            change_of_lift: lift.change,
            change_of_thrust: thrust.change,
            change_of_side_force: side.change,
            is_steady: !changed && !hidden,
            is_known: changed || !hidden,
        })
    }

    /// Whether the errors of the means are larger than what changes: few beats that drift have such ones, in which the
    /// drift is counted as correlation ([`Estimate`]). A change of more than a tenth of the force is never called so.
    pub fn changes_within_error(&self) -> bool {
        let e = &self.estimate;
        let size = mean_force(e);
        let error = |mean: &Estimate| mean.standard_error.unwrap_or(0.0);
        let level = self.change_of_thrust.hypot(self.change_of_side_force);
        let level_error = error(&e.thrust_newton).hypot(error(&e.side_force_newton));
        let changes = [
            (self.change_of_lift, error(&e.lift_newton)),
            (level, level_error),
        ];
        changes.into_iter().all(|(change, error)| {
            let is_within = change.abs() <= MUST_SHOW && change.abs() * size <= error;
            change.abs() <= NO_CHANGE || is_within
        })
    }
}

/// Magnitude of the mean force \[N\].
fn mean_force(estimate: &PerBeat<Estimate>) -> f64 {
    let parts = [
        estimate.lift_newton,
        estimate.thrust_newton,
        estimate.side_force_newton,
    ];
    force(parts.map(|part| part.mean))
}

/// By how much values change from their first half to their second, and what of that their scatter would hide,
/// over a size \[1\].
///
/// The test is Student's of the slope of a straight line through the values, 5 % by chance. Their scatter is that about
/// the line, lest a drift hide itself, with n - 2 degrees of freedom: of three values next to nothing is known, and only
/// what is nearly a line is felt.
#[derive(Clone, Copy)]
struct Change {
    change: f64,
    /// The same by the line.
    by_line: f64,
    hidden: f64,
}

impl Change {
    /// Of three values or more.
    fn of(values: &[f64], size: f64) -> Self {
        let n = values.len() as f64;
        let half = values.len() / 2;
        let halves = [&values[..half], &values[values.len() - half..]];
        let means = halves.map(|part| part.iter().sum::<f64>() / half as f64);
        let middle = 0.5 * (n - 1.0);
        let (mean, _) = moments(values);
        let numbered = || (0..).map(|k| f64::from(k) - middle).zip(values);
        let spread: f64 = numbered().map(|(k, _)| k * k).sum();
        let slope = numbered().map(|(k, x)| k * (x - mean)).sum::<f64>() / spread;
        let rest: Vec<f64> = numbered().map(|(k, x)| x - mean - slope * k).collect();
        let error = error_of_slope(&rest, spread);
        let apart = n - half as f64;
        Self {
            change: (means[1] - means[0]) / size,
            by_line: slope * apart / size,
            hidden: within_nineteen_of_twenty(n - 2.0) * error * apart / size,
        }
    }

    /// Of a vector of two parts, whichever way it heads: of one that has but one of them, the same as of that.
    fn with(&self, other: &Self) -> Self {
        Self {
            change: self.change.hypot(other.change),
            by_line: self.by_line.hypot(other.by_line),
            hidden: self.hidden.hypot(other.hidden),
        }
    }

    fn is_felt(&self) -> bool {
        self.change.abs() > NO_CHANGE && self.by_line.abs() > self.hidden
    }
}

/// Fewest values whose scatter about a line says something of how neighbours are correlated.
const FEWEST_CORRELATED: usize = 5;

/// Standard error of the slope of a line from what values differ from it; `spread` is the sum of the squares of their
/// places about the middle. Correlation r of neighbours makes it larger by the root of `(1 + r) / (1 - r)`. Of r
/// [`Estimate`] has what it is likely to be; added here, that would hide the drift that is looked for, so but the least
/// of it, 1 / n, is.
fn error_of_slope(rest: &[f64], spread: f64) -> f64 {
    let n = rest.len() as f64;
    let (mean, square) = moments(rest);
    let error = (square / (n - 2.0) / spread).sqrt();
    if rest.len() < FEWEST_CORRELATED {
        return error;
    }
    let shown = correlation(rest, (mean, square)) + 1.0 / n;
    let r = shown.clamp(0.0, MAX_CORRELATION);
    error * ((1.0 + r) / (1.0 - r)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::estimate::series;
    use super::*;

    fn flown(lift: impl Fn(usize) -> f64) -> Option<ManyBeats> {
        flown_with(lift, |_| 0.0)
    }

    fn flown_with(lift: impl Fn(usize) -> f64, thrust: impl Fn(usize) -> f64) -> Option<ManyBeats> {
        flown_towards(0.0, lift, thrust)
    }

    /// Headed so far from n1 to n2 \[rad\].
    fn flown_towards(
        heading: f64,
        lift: impl Fn(usize) -> f64,
        thrust: impl Fn(usize) -> f64,
    ) -> Option<ManyBeats> {
        let beat = |k: usize| BeatMeans {
            beat: k,
            mean: PerBeat {
                lift_newton: lift(k),
                lift_over_weight: Some(lift(k) / 2.0),
                thrust_newton: heading.cos() * thrust(k),
                side_force_newton: heading.sin() * thrust(k),
                power_watt: 3.0,
                positive_power_watt: 4.0,
                lift_coefficient: Some(lift(k)),
                thrust_coefficient: Some(thrust(k)),
                inviscid_lift_newton: Some(lift(k)),
                lift_by_impulse_newton: Some(lift(k)),
            },
        };
        ManyBeats::of(&(1..=10).map(beat).collect::<Vec<_>>(), LEFT_OUT)
    }

    #[test]
    fn exact_means_leave_two_beats_out_and_drift_is_not_steady() {
        let same = flown(|k| if k < 3 { 9.0 } else { 2.0 }).unwrap();
        assert_eq!(same.beats, [3, 10]);
        assert_eq!(same.estimate.lift_over_weight.unwrap().mean, 1.0);
        assert_eq!(same.estimate.lift_newton.standard_error, Some(0.0));
        assert!(same.is_steady && same.change_of_lift == 0.0);
        let falls = flown(|k| 10.0 - 0.5 * k as f64).unwrap();
        assert!(
            !falls.is_steady && falls.change_of_lift < -0.25,
            "{falls:?}"
        );
        let scatters = flown(|k| 10.0 + [0.4, -0.3, 0.1, -0.4, 0.2][k % 5]).unwrap();
        assert!(scatters.is_steady, "{scatters:?}");
        // From the lift of one beat to that of the next by a half: a change of a tenth would not show.
        let unknown = flown(|k| 10.0 + [4.0, -3.0, 1.0, -4.0, 2.0][k % 5]).unwrap();
        assert!(!unknown.is_steady && !unknown.is_known, "{unknown:?}");
        assert!(falls.is_known && scatters.is_known && same.is_known);
        // A body that tilts: its lift is what it was, its thrust is not.
        let tilts = flown_with(|_| 10.0, |k| 0.3 * k as f64).unwrap();
        assert!(!tilts.is_steady && tilts.is_known && tilts.change_of_thrust > 0.1);
        assert_eq!(ManyBeats::of(&[], LEFT_OUT), None);
    }

    /// Whether beats are steady does not depend on where the flyer heads: one whose lift stays and whose force forward
    /// grows, or scatters, or is steady.
    #[test]
    fn invariant_steadiness_of_a_force_that_heads_anywhere() {
        let scatter = |k: usize| [0.4, -0.3, 0.1, -0.4, 0.2][k % 5];
        let thrusts: [&dyn Fn(usize) -> f64; 4] = [
            &|k| 0.3 * k as f64,
            &|k| 0.03 * k as f64 + 0.02 * scatter(k),
            &|k| 10.0 * scatter(k),
            &|k| 5.0 + 0.1 * scatter(k),
        ];
        let judged = |heading: f64, thrust: &dyn Fn(usize) -> f64| {
            let means = flown_towards(heading, |_| 10.0, thrust).unwrap();
            let within = means.changes_within_error();
            (means.is_steady, means.is_known, within)
        };
        for thrust in thrusts {
            for heading in [0.3, 0.8, 1.5, 3.0, -2.0] {
                assert_eq!(judged(heading, thrust), judged(0.0, thrust), "{heading}");
            }
        }
        assert!(!judged(0.0, thrusts[0]).0 && judged(0.0, thrusts[3]).0);
        assert!(!judged(0.0, thrusts[2]).1);
    }

    /// Two beats, or those that a smooth start or a hold reaches into, begun ones as whole ones; what is held to its end, or
    /// does not move, has none.
    #[test]
    fn exact_beats_of_starts_and_holds_are_left_out() {
        for (set, expected) in [
            (&["motion.start_beats=4"][..], 4),
            (&["motion.start_beats=2.1"], 3),
            (&["motion.start_beats=0.5"], 2),
            (&["flight.held_beats=1"], 2),
            (&["flight.held_beats=2"], 2),
            (&["flight.held_beats=5.5"], 6),
            (&["flight.held_beats=9"], 2),
            (&["flight.held_beats=3", "motion.start_beats=4"], 4),
        ] {
            let set: Vec<String> = (set.iter().copied())
                .chain(["motion.start=smooth", "time.beats=9"])
                .map(str::to_owned)
                .collect();
            let case = wingbeat_case::LoadedCase::find("fruit-fly-blade", &set).unwrap();
            assert_eq!(left_out(&case.setup), expected, "{set:?}");
            assert!(starting_beats(&case.setup) <= expected, "{set:?}");
        }
        let impulsive = wingbeat_case::LoadedCase::find("fruit-fly-blade", &[]).unwrap();
        assert_eq!(starting_beats(&impulsive.setup), 0);
        let short = wingbeat_case::LoadedCase::find(
            "fruit-fly-blade",
            &["time.beats=9".to_owned(), "flight.held_beats=7".to_owned()],
        );
        let setup = short.unwrap().setup;
        assert!(
            too_few_left(&setup, 9)
                .unwrap()
                .contains("time.beats = 10 or more")
        );
        assert_eq!([4, 10].map(|n| too_few_left(&setup, n)), [None, None]);
    }

    /// A drift that is felt may be less than the error of the mean, which counts it as correlation. A drift by a quarter
    /// is not.
    #[test]
    fn behaves_drifts_within_the_error_of_the_mean_are_told_from_others() {
        let of = |lift: fn(usize) -> f64| flown(lift).unwrap();
        let slow = of(|k| 1.0 - 0.003 * k as f64);
        assert!(
            !slow.is_steady && slow.is_known && slow.changes_within_error(),
            "{slow:?}"
        );
        let falls = of(|k| [1.3, 1.0][k / 7] + 0.01 * (k % 2) as f64);
        assert!(!falls.is_steady && falls.change_of_lift < -0.2, "{falls:?}");
        assert!(!falls.changes_within_error(), "{falls:?}");
    }

    /// Shares of many flights of `n` beats after the second whose lift is called drifting, and of those of which it is
    /// said that they do not tell: `lift` of a scatter of 3 % with the correlation `r` of neighbours.
    fn called(n: usize, r: f64, drift: f64) -> [f64; 2] {
        const MANY: u64 = 4000;
        let change = |seed| {
            let scatter = series(r, n, seed).into_iter().zip(0..);
            let along = |(x, k)| 1.0 + 0.03 * x + drift * f64::from(k) / (n - 1) as f64;
            Change::of(&scatter.map(along).collect::<Vec<_>>(), 1.0)
        };
        let all: Vec<Change> = (0..MANY).map(change).collect();
        let share =
            |of: fn(&Change) -> bool| all.iter().filter(|c| of(c)).count() as f64 / MANY as f64;
        [
            share(Change::is_felt),
            share(|c| !c.is_felt() && c.hidden > MUST_SHOW),
        ]
    }

    /// Beats that do not drift are called drifting in one of 20 flights, in one of 6 at most where neighbours are
    /// correlated by a half; a drift that is five times the scatter is felt where there are enough beats, and the
    /// others do not tell.
    #[test]
    fn agrees_beats_are_called_drifting_as_often_by_chance_as_the_test_says() {
        for n in [3, 4, 5, 6, 8, 12, 18] {
            let [drifting, unknown] = called(n, 0.0, 0.0);
            let [correlated, _] = called(n, 0.5, 0.0);
            let [found, _] = called(n, 0.0, 0.15);
            println!("{n}: {drifting:.3} {unknown:.3} {correlated:.3} {found:.3}");
            // Nominal 0.05. Measured 0.041 to 0.052; with correlation 0.064 to 0.155, which few beats do not show.
            assert!((0.03..0.06).contains(&drifting), "{n}: {drifting}");
            assert!(correlated < 0.18, "{n}: {correlated}");
            assert!(n < 8 || found > 0.8, "{n}: {found}");
            assert!(n > 4 || unknown > 0.4, "{n}: {unknown}");
        }
    }
}
