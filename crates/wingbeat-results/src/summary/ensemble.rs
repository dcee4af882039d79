//! Means of an ensemble: the same flight many times over, each from a start that differs by next to nothing.
//!
//! Wingbeats that follow each other are correlated; members of an ensemble are not, once their wakes have parted. Until
//! then they are one flight, and how little they differ says nothing of how well the mean of such a flight is known.

use serde::{Deserialize, Serialize};

use super::beats::BeatMeans;
use super::estimate::{Estimate, FEWEST, moments};
use super::means::ManyBeats;
use super::per_beat::PerBeat;
use super::words::steadiness;

/// Members have parted with the beat in which their forces scatter by this part of what those of the beats of a member
/// scatter among themselves (half of the variance).
const PARTED: f64 = 0.7;

/// Growth of the members' scatter from the first beat to the last up to which nothing parts them.
const NO_GROWTH: f64 = 2.0;

/// Scatter over members, over the size of the force, up to which they are one flight: a thousand times the disturbance
/// that makes them differ. What has parted within the first beat scatters more, and grows no further.
const ONE_FLIGHT: f64 = 1e-3;

/// One wingbeat over all members.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EnsembleBeat {
    /// Number of the beat, from 1.
    pub beat: usize,
    /// The means over the members with their errors.
    #[serde(flatten)]
    pub estimate: PerBeat<Estimate>,
    /// Standard deviation of the lift over the members, over the mean of its magnitudes: how far the members have
    /// parted \[1\].
    pub spread: f64,
}

/// As what the members of an ensemble count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Members {
    /// They have parted: each is a flight of its own.
    Independent,
    /// They have not (yet): all are one flight, and errors are those of its beats.
    OneFlight,
    /// They do not part at all: the same start makes the same flight, and there is nothing to take a mean of
    /// but its beats.
    Deterministic,
}

/// An ensemble.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ensemble {
    /// Members that flew.
    pub members: usize,
    /// The beats that all of them finished; those before the members have parted are without errors.
    pub beats: Vec<EnsembleBeat>,
    /// Whether each member has noise of its own.
    #[serde(default)]
    pub is_noisy: bool,
    /// As what the members count.
    pub members_are: Members,
    /// The beats after the one in which members have parted (after those left out, if they have not) as one: its number is
    /// that of the first. None where no beat is left.
    pub means: Option<EnsembleBeat>,
    /// The means over the members, beat by beat after those left out, as those of one flight: whether the beats
    /// still change.
    #[serde(default)]
    pub course: Option<ManyBeats>,
}

impl Ensemble {
    /// Of the beats of two members or more, whose noise differs if they are `noisy`; none of fewer, or if one
    /// has no whole beat. Means leave out the first `left_out` beats ([`super::left_out`]).
    pub fn of(members: &[Vec<BeatMeans>], is_noisy: bool, left_out: usize) -> Option<Self> {
        let count = members.iter().map(Vec::len).min().filter(|n| *n > 0)?;
        if members.len() < 2 {
            return None;
        }
        let parted = match is_noisy {
            true => Some(0),
            false => first_parted(members, [left_out, count]),
        };
        let members_are = match parted {
            Some(_) => Members::Independent,
            None if is_deterministic(members, [left_out, count]) => Members::Deterministic,
            None => Members::OneFlight,
        };
        let beat = |k: usize| match parted.is_some_and(|p| k >= p) {
            true => over(members, [k, k + 1], Members::Independent),
            false => over(members, [k, k + 1], Members::OneFlight),
        };
        let from = parted.map_or(left_out, |p| p.max(left_out));
        Some(Self {
            members: members.len(),
            beats: (0..count).map(beat).collect(),
            is_noisy,
            members_are,
            course: ManyBeats::of(
                &(0..count).map(|k| mean_of(members, k)).collect::<Vec<_>>(),
                left_out,
            ),
            means: (count > from).then(|| over(members, [from, count], members_are)),
        })
    }

    /// What the errors of its means are, and whether its beats are steady.
    pub fn remark(&self) -> String {
        let errors = self.errors();
        let course = self.course.as_ref().map(steadiness);
        course.map_or_else(|| errors.clone(), |course| format!("{errors}; {course}"))
    }

    /// What the errors of its means are, in a sentence.
    fn errors(&self) -> String {
        let errors = match &self.means {
            Some(means) if means.estimate.lift_newton.standard_error.is_some() => {
                "the error is that of the beats of one flight"
            }
            _ => "of so few beats the mean has no error",
        };
        match (self.members_are, &self.means) {
            (Members::Independent, _) if self.is_noisy => {
                "every flight has noise of its own, and counts as a flight of its own".to_owned()
            }
            (Members::Independent, means) => format!(
                "the flights have parted by beat {}; the mean from there on counts each of them as a flight of its own",
                means.as_ref().map_or(0, |m| m.beat)
            ),
            (Members::OneFlight, _) => format!(
                "the flights have not parted: they count as one, and {errors}; fly longer (time.beats); flights without separation may never part, and turbulence is the same in all of them: flights that differ by it are a campaign over air.gust[0].turbulence.seed"
            ),
            (Members::Deterministic, _) => "the flights do not part: the case is deterministic, there is no scatter over flights and no error of the mean".to_owned(),
        }
    }
}

/// A beat as the mean over the members.
fn mean_of(members: &[Vec<BeatMeans>], beat: usize) -> BeatMeans {
    BeatMeans {
        beat: members[0][beat].beat,
        mean: PerBeat::joined(members.iter().map(|m| &m[beat].mean), mean),
    }
}

fn mean(values: &[f64]) -> f64 {
    moments(values).0
}

/// Index of the first beat behind the one, after those left out, in which the forces of members scatter as
/// those of beats do: in that one they still have much in common.
fn first_parted(members: &[Vec<BeatMeans>], [left_out, count]: [usize; 2]) -> Option<usize> {
    let counted = left_out..count;
    if counted.len() < FEWEST {
        return None; // how beats scatter is not known
    }
    let within = members.iter().map(|m| variance(&m[counted.clone()]));
    let among_beats = within.sum::<f64>() / members.len() as f64;
    let has_parted = |k: &usize| {
        let scatter = scatter(members, *k);
        scatter >= PARTED * among_beats.sqrt() && scatter > ONE_FLIGHT * size(members, *k)
    };
    let first = 1 + counted.into_iter().find(has_parted)?;
    (first < count && !is_deterministic(members, [left_out, count])).then_some(first)
}

/// Whether the scatter over members neither grows nor has become large before it could be seen to grow.
fn is_deterministic(members: &[Vec<BeatMeans>], [left_out, count]: [usize; 2]) -> bool {
    let last = count - 1;
    let (early, late) = (scatter(members, 0), scatter(members, last));
    let [small, full] = [0, last].map(|k| size(members, k));
    // Scatter counts over the force: the first beat of a smooth start has little of either.
    count >= left_out + FEWEST
        && late * small <= NO_GROWTH * early * full
        && late <= ONE_FLIGHT * full
}

/// Mean magnitude of the force of a beat over the members \[N\].
fn size(members: &[Vec<BeatMeans>], beat: usize) -> f64 {
    let force = |m: &Vec<BeatMeans>| m[beat].mean.force();
    members.iter().map(force).sum::<f64>() / members.len() as f64
}

/// Standard deviation of the force of a beat over the members \[N\].
fn scatter(members: &[Vec<BeatMeans>], beat: usize) -> f64 {
    let all: Vec<BeatMeans> = members.iter().map(|m| m[beat].clone()).collect();
    variance(&all).sqrt()
}

/// Variance of the force, all its parts, over beats, at least two \[N2\].
fn variance(beats: &[BeatMeans]) -> f64 {
    let parts: [fn(&BeatMeans) -> f64; 3] = [
        |b| b.mean.lift_newton,
        |b| b.mean.thrust_newton,
        |b| b.mean.side_force_newton,
    ];
    let square = |of| moments(&beats.iter().map(of).collect::<Vec<f64>>()).1;
    parts.map(square).iter().sum::<f64>() / (beats.len() - 1) as f64
}

/// Beats `from` up to `to`, that excluded, as one.
fn over(members: &[Vec<BeatMeans>], [from, to]: [usize; 2], are: Members) -> EnsembleBeat {
    let of_member = |m: &Vec<BeatMeans>| PerBeat::joined(m[from..to].iter().map(|b| &b.mean), mean);
    let of_members: Vec<PerBeat> = members.iter().map(of_member).collect();
    let of_beats: Vec<PerBeat> = (from..to).map(|k| mean_of(members, k).mean).collect();
    let without_error = |values: &[f64]| Estimate {
        mean: mean(values),
        standard_error: None,
    };
    let estimate = match are {
        Members::Independent => PerBeat::joined(&of_members, Estimate::of_independent),
        Members::OneFlight => PerBeat::joined(&of_beats, Estimate::of),
        Members::Deterministic => PerBeat::joined(&of_beats, without_error),
    };
    let lift: Vec<f64> = of_members.iter().map(|m| m.lift_newton).collect();
    let size = lift.iter().map(|x| x.abs()).sum::<f64>() / lift.len() as f64;
    let deviation = (moments(&lift).1 / (lift.len() - 1) as f64).sqrt();
    EnsembleBeat {
        beat: members[0][from].beat,
        estimate,
        spread: if size > 0.0 { deviation / size } else { 0.0 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn member(lift: &[f64]) -> Vec<BeatMeans> {
        let beat = |(k, x): (usize, &f64)| BeatMeans {
            beat: k + 1,
            mean: PerBeat {
                lift_newton: *x,
                lift_over_weight: Some(x / 2.0),
                thrust_newton: 0.0,
                side_force_newton: 0.0,
                power_watt: 1.0,
                positive_power_watt: 2.0,
                lift_coefficient: Some(*x),
                thrust_coefficient: Some(0.0),
                inviscid_lift_newton: Some(*x),
                lift_by_impulse_newton: Some(*x),
            },
        };
        lift.iter().enumerate().map(beat).collect()
    }

    #[test]
    fn exact_means_and_errors_over_members_that_have_parted() {
        let members = [
            member(&[1.0, 1.0, 3.0, 3.0, 5.0]),
            member(&[1.0, 1.0, 1.0, 1.0, 3.0, 9.0]),
        ];
        let e = Ensemble::of(&members, false, 2).unwrap();
        assert_eq!((e.members, e.beats.len()), (2, 5));
        assert_eq!(
            (e.beats[0].spread, e.beats[0].estimate.lift_newton.mean),
            (0.0, 1.0)
        );
        assert_eq!(e.beats[2].estimate.lift_newton.standard_error, None);
        assert_eq!(e.members_are, Members::Independent);
        let fourth = e.beats[3].estimate.lift_newton;
        assert_eq!(fourth.mean, 2.0);
        // 3 and 1: deviation sqrt 2, error of the mean of two 1, Student's factor of one degree of freedom 1.8373.
        assert!((fourth.standard_error.unwrap() - 1.8373).abs() < 1e-4);
        let all = e.means.clone().unwrap();
        assert_eq!((all.beat, all.estimate.lift_newton.mean), (4, 3.0));
        assert_eq!(all.estimate.lift_over_weight.unwrap().mean, 1.5);
        assert!(e.remark().contains("parted by beat 4"), "{}", e.remark());
        assert_eq!(Ensemble::of(&members[..1], false, 2), None);
        assert_eq!(Ensemble::of(&[vec![], vec![]], false, 2), None);
    }

    /// Flights that are the same but for 1e-4 are one flight, whose beats scatter by a tenth: the mean is not known to
    /// 1e-5.
    #[test]
    fn limit_members_that_have_not_parted_count_as_one_flight() {
        let apart = |grown: f64| {
            let beats = [0.8, 0.9, 1.0, 1.1, 0.95, 1.05];
            let of = |m: f64| {
                let lift = |(k, x): (usize, &f64)| x + m * 1e-9 * grown.powi(k as i32);
                member(&beats.iter().enumerate().map(lift).collect::<Vec<_>>())
            };
            Ensemble::of(&[of(-1.0), of(1.0), of(0.5)], false, 2).unwrap()
        };
        let e = apart(10.0);
        assert_eq!(e.members_are, Members::OneFlight);
        let error = e
            .means
            .as_ref()
            .unwrap()
            .estimate
            .lift_newton
            .standard_error;
        assert!(error.is_some_and(|s| s > 0.03), "{error:?}");
        assert!(
            e.beats
                .iter()
                .all(|b| b.estimate.lift_newton.standard_error.is_none())
        );
        assert!(e.remark().contains("have not parted") && e.remark().contains("fly longer"));
        let same = apart(1.0);
        assert_eq!(same.members_are, Members::Deterministic);
        assert_eq!(
            same.means
                .as_ref()
                .unwrap()
                .estimate
                .lift_newton
                .standard_error,
            None
        );
        assert!(same.remark().contains("deterministic"));
        // Behind a smooth start forces and their scatter grow alike, and periodic flights hardly scatter from beat to beat.
        let begun = |m: f64| member(&[0.03, 0.6, 1.0, 1.0, 1.0, 1.0].map(|x| x * (1.0 + m * 1e-7)));
        let same = Ensemble::of(&[begun(-1.0), begun(1.0)], false, 2).unwrap();
        assert_eq!(same.members_are, Members::Deterministic);
    }

    /// Flights that part within the first beat scatter as much in each of them: their scatter does not grow, and they
    /// are independent none the less.
    #[test]
    fn limit_members_that_part_within_the_first_beat_are_independent() {
        let members = [
            member(&[1.03, 0.95, 1.06, 0.97, 1.01, 1.04]),
            member(&[0.96, 1.05, 0.98, 1.04, 0.95, 1.0]),
            member(&[1.0, 1.01, 0.94, 0.99, 1.05, 0.96]),
        ];
        let e = Ensemble::of(&members, false, 2).unwrap();
        assert_eq!(e.members_are, Members::Independent, "{}", e.remark());
        assert!(e.beats.iter().all(|b| b.spread > 0.02));
        let error = e
            .means
            .as_ref()
            .unwrap()
            .estimate
            .lift_newton
            .standard_error;
        assert!(error.is_some_and(|s| s > 2e-3), "{error:?}");
    }

    /// Members whose noise differs are flights of their own, however little the noise does; beats that fall are
    /// said to.
    #[test]
    fn exact_errors_over_members_with_noise_of_their_own() {
        let of = |m: f64| member(&[1.2, 1.1, 1.0 + m, 0.9 + m, 0.8 + m, 0.7 + m]);
        let members = [of(-1e-3), of(1e-3)];
        let e = Ensemble::of(&members, true, 2).unwrap();
        assert_eq!(e.members_are, Members::Independent);
        assert!((e.means.as_ref().unwrap().estimate.lift_newton.mean - 0.85).abs() < 1e-12);
        let error = e
            .means
            .as_ref()
            .unwrap()
            .estimate
            .lift_newton
            .standard_error
            .unwrap();
        // Deviation 1.41e-3, error of the mean of two 1e-3, Student's factor 1.8373.
        assert!((error - 1.8373e-3).abs() < 1e-7, "{error:e}");
        let said = e.remark();
        assert!(
            said.contains("noise of its own") && said.contains("NOT steady"),
            "{said}"
        );
        let same = Ensemble::of(&members, false, 2).unwrap();
        assert!(same.remark().contains("NOT steady"), "{}", same.remark());
    }
}
