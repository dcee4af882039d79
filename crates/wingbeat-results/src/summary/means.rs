//! Means over many wingbeats with their standard errors, and whether the wingbeats still change.

use serde::{Deserialize, Serialize};

use super::beats::BeatMeans;
use super::estimate::{Estimate, FEWEST, correlation, moments};
use super::per_beat::PerBeat;

/// Beats at the start that means over wingbeats leave out: the wake comes up.
pub const LEFT_OUT: usize = 2;

/// A change of the force from the first half of the beats to the second, in parts of it, that is none.
const NO_CHANGE: f64 = 0.01;

/// A change that must show beside the scatter of the beats if they are to count as steady.
const MUST_SHOW: f64 = 0.1;

/// Means over the wingbeats after the second one.
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
    /// Whether both changes are less than a hundredth, or than twice the error of the difference between the
    /// halves, and this is less than a tenth of the force.
    pub is_steady: bool,
    /// Whether the scatter of the beats tells that: not steady is what changes by more than it, unknown what
    /// scatters by more than a tenth.
    #[serde(default = "yes")]
    pub is_known: bool,
}

/// Results that do not say it were written when nothing was unknown.
fn yes() -> bool {
    true
}

impl ManyBeats {
    /// Of the wingbeats of a flight; none if there are fewer than five.
    pub fn of(beats: &[BeatMeans]) -> Option<Self> {
        let beats = beats.get(LEFT_OUT..).filter(|b| b.len() >= FEWEST)?;
        let estimate = PerBeat::joined(beats.iter().map(|b| &b.mean), Estimate::of);
        let [lift, thrust] = [estimate.lift_newton, estimate.thrust_newton];
        let size = lift.mean.hypot(thrust.mean).max(f64::MIN_POSITIVE);
        let forces: [fn(&BeatMeans) -> f64; 2] = [|b| b.mean.lift_newton, |b| b.mean.thrust_newton];
        let changes = forces.map(|of| Change::of(&beats.iter().map(of).collect::<Vec<_>>(), size));
        let changed = changes.iter().any(|c| c.is_felt());
        let hidden = changes.iter().any(|c| c.hidden > MUST_SHOW);
        Some(Self {
            beats: [beats[0].beat, beats[beats.len() - 1].beat],
            estimate,
            change_of_lift: changes[0].change,
            change_of_thrust: changes[1].change,
            is_steady: !changed && !hidden,
            is_known: changed || !hidden,
        })
    }

    /// Whether the errors of the means are larger than what changes: few beats that drift have such ones, in which the
    /// drift is counted as correlation ([`Estimate`]). A change of more than a tenth of the force is never called so.
    pub fn changes_within_error(&self) -> bool {
        let [lift, thrust] = [self.estimate.lift_newton, self.estimate.thrust_newton];
        let size = lift.mean.hypot(thrust.mean);
        let changes = [(self.change_of_lift, lift), (self.change_of_thrust, thrust)];
        changes.into_iter().all(|(change, mean)| {
            let error = mean.standard_error.unwrap_or(0.0);
            let is_within = change.abs() <= MUST_SHOW && change.abs() * size <= error;
            change.abs() <= NO_CHANGE || is_within
        })
    }
}

/// By how much values change from their first half to their second, and what of that their scatter would hide,
/// over a size \[1\].
struct Change {
    change: f64,
    hidden: f64,
}

impl Change {
    fn of(values: &[f64], size: f64) -> Self {
        let half = values.len() / 2;
        let halves = [&values[..half], &values[values.len() - half..]];
        let means = halves.map(|part| part.iter().sum::<f64>() / half as f64);
        // The error of each half is that of the scatter about its own mean: a drift must not excuse itself.
        let error = match half > 1 {
            true => {
                let [a, b] = halves.map(shown_error);
                a.hypot(b)
            }
            false => shown_error(values),
        };
        Self {
            change: (means[1] - means[0]) / size,
            hidden: 2.0 * error / size,
        }
    }

    fn is_felt(&self) -> bool {
        self.change.abs() > self.hidden.max(NO_CHANGE)
    }
}

/// Error of the mean of two values or more as they show it themselves, where [`Estimate`] has what it is likely to be.
/// There the correlation that few values hide is added, and Student's factor, lest an error be too small; here either
/// would hide the drift that is looked for, so both are left out and a change is felt rather too soon. Correlation r of
/// neighbours makes n values `n (1 - r) / (1 + r)`, the limit of many in [`Estimate`]'s formula: of the two or three
/// values of a half its sum of lags says no more.
fn shown_error(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let (mean, square) = moments(values);
    let most = (n - 2.0).max(0.0) / n; // two count at least
    let r = correlation(values, (mean, square)).clamp(0.0, most);
    let effective = (n * (1.0 - r) / (1.0 + r)).max(1.0);
    (square / (n - 1.0) / effective).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flown(lift: impl Fn(usize) -> f64) -> Option<ManyBeats> {
        flown_with(lift, |_| 0.0)
    }

    fn flown_with(lift: impl Fn(usize) -> f64, thrust: impl Fn(usize) -> f64) -> Option<ManyBeats> {
        let beat = |k: usize| BeatMeans {
            beat: k,
            mean: PerBeat {
                lift_newton: lift(k),
                lift_over_weight: Some(lift(k) / 2.0),
                thrust_newton: thrust(k),
                power_watt: 3.0,
                positive_power_watt: 4.0,
                lift_coefficient: Some(lift(k)),
                thrust_coefficient: Some(thrust(k)),
                inviscid_lift_newton: Some(lift(k)),
                lift_by_impulse_newton: Some(lift(k)),
            },
        };
        ManyBeats::of(&(1..=10).map(beat).collect::<Vec<_>>())
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
        assert_eq!(ManyBeats::of(&[]), None);
    }

    /// The beats 3 to 8 of a honeybee: their drift of 1.7 % is felt, and less than the error of their mean, which counts
    /// it as correlation. A drift by a quarter is not.
    #[test]
    fn behaves_drifts_within_the_error_of_the_mean_are_told_from_others() {
        let beat = |(k, lift): (usize, f64)| {
            let text = format!(
                r#"{{"beat": {k}, "lift_newton": {lift}, "lift_over_weight": null, "thrust_newton": 0, "power_watt": 0}}"#
            );
            serde_json::from_str::<BeatMeans>(&text).unwrap()
        };
        let of = |lifts: [f64; 8]| {
            let beats: Vec<BeatMeans> = (1..).zip(lifts).map(beat).collect();
            ManyBeats::of(&beats).unwrap()
        };
        let bee = of([0.488, 0.993, 0.902, 0.899, 0.9017, 0.8866, 0.8805, 0.8903]);
        assert!(
            !bee.is_steady && bee.is_known && bee.changes_within_error(),
            "{bee:?}"
        );
        let falls = of([1.0, 1.0, 1.3, 1.29, 1.31, 0.99, 1.0, 1.01]);
        assert!(!falls.is_steady && falls.change_of_lift < -0.2, "{falls:?}");
    }
}
