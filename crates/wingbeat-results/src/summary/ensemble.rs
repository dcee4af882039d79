//! Means of an ensemble: the same flight many times over, each from a start that differs by next to nothing.
//!
//! Wingbeats that follow each other are correlated; members of an ensemble are not, once their wakes have parted.

use serde::{Deserialize, Serialize};

use super::beats::BeatMeans;
use super::means::{Estimate, LEFT_OUT};

/// One wingbeat over all members.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EnsembleBeat {
    /// Number of the beat, from 1.
    pub beat: usize,
    /// Air force against gravity \[N\].
    pub lift_newton: Estimate,
    /// The same over the weight; none without gravity.
    pub lift_over_weight: Option<Estimate>,
    /// Air force along n1 (forward) \[N\].
    pub thrust_newton: Estimate,
    /// Power of hinge actuators and prescribed deformation \[W\].
    pub power_watt: Estimate,
    /// Standard deviation of the lift over the members, over the mean of its magnitudes: how far the members have
    /// parted \[1\].
    pub spread: f64,
}

/// An ensemble.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ensemble {
    /// Members that flew.
    pub members: usize,
    /// The beats that all of them finished.
    pub beats: Vec<EnsembleBeat>,
    /// The beats from the third on as one (its number is that of the first); none of fewer than three beats.
    pub means: Option<EnsembleBeat>,
}

impl Ensemble {
    /// Of the beats of two members or more; none of fewer, or if one has no whole beat.
    pub fn of(members: &[Vec<BeatMeans>]) -> Option<Self> {
        let count = members.iter().map(Vec::len).min().filter(|n| *n > 0)?;
        if members.len() < 2 {
            return None;
        }
        let over = |from: usize, to: usize| {
            let value = |f: fn(&BeatMeans) -> f64| -> Vec<f64> {
                let mean = |m: &Vec<BeatMeans>| {
                    m[from..to].iter().map(f).sum::<f64>() / (to - from) as f64
                };
                members.iter().map(mean).collect()
            };
            let lift = value(|b| b.lift_newton);
            let weighed = members
                .iter()
                .flatten()
                .all(|b| b.lift_over_weight.is_some());
            let size = lift.iter().map(|x| x.abs()).sum::<f64>() / lift.len() as f64;
            let lift_newton = Estimate::of_independent(&lift);
            let deviation = lift_newton.standard_error * (lift.len() as f64).sqrt();
            EnsembleBeat {
                beat: members[0][from].beat,
                lift_newton,
                lift_over_weight: weighed.then(|| {
                    Estimate::of_independent(&value(|b| b.lift_over_weight.unwrap_or(0.0)))
                }),
                thrust_newton: Estimate::of_independent(&value(|b| b.thrust_newton)),
                power_watt: Estimate::of_independent(&value(|b| b.power_watt)),
                spread: if size > 0.0 { deviation / size } else { 0.0 },
            }
        };
        Some(Self {
            members: members.len(),
            beats: (0..count).map(|k| over(k, k + 1)).collect(),
            means: (count > LEFT_OUT).then(|| over(LEFT_OUT, count)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn member(lift: &[f64]) -> Vec<BeatMeans> {
        let beat = |(k, x): (usize, &f64)| BeatMeans {
            beat: k + 1,
            lift_newton: *x,
            lift_over_weight: Some(x / 2.0),
            thrust_newton: 0.0,
            power_watt: 1.0,
            inviscid_lift_newton: *x,
            lift_by_impulse_newton: *x,
        };
        lift.iter().enumerate().map(beat).collect()
    }

    #[test]
    fn exact_means_and_errors_over_members() {
        let members = [
            member(&[1.0, 1.0, 3.0, 5.0]),
            member(&[1.0, 1.0, 1.0, 3.0, 9.0]),
        ];
        let e = Ensemble::of(&members).unwrap();
        assert_eq!((e.members, e.beats.len()), (2, 4));
        assert_eq!((e.beats[0].spread, e.beats[0].lift_newton.mean), (0.0, 1.0));
        let third = &e.beats[2].lift_newton;
        // 3 and 1: deviation sqrt 2, error of the mean of two 1.
        assert_eq!(third.mean, 2.0);
        assert!((third.standard_error - 1.0).abs() < 1e-15);
        let all = e.means.unwrap();
        assert_eq!((all.beat, all.lift_newton.mean), (3, 3.0));
        assert_eq!(all.lift_over_weight.unwrap().mean, 1.5);
        assert_eq!(Ensemble::of(&members[..1]), None);
        assert_eq!(Ensemble::of(&[vec![], vec![]]), None);
    }
}
