//! Means over the last part of a flight without wingbeats: of wings held in a stream, say, whose flow has
//! become steady.

use serde::{Deserialize, Serialize};
use wingbeat_flight::{FlightSetup, Record};

use super::beats::{BeatMeans, Integrals};
use super::per_beat::PerBeat;

/// Parts of the steps of a flight after which the last part begins, and at which it is halved.
const FROM: [f64; 2] = [0.8, 0.9];

/// Means over the last fifth of a flight without wingbeats that was flown to its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LastPart {
    /// When it begins \[s\].
    pub from_s: f64,
    /// When it ends \[s\].
    pub to_s: f64,
    /// The means over it.
    #[serde(flatten)]
    pub mean: PerBeat,
    /// Change of lift from its first half to its second, over the mean force \[1\]: small where the flow is
    /// steady.
    pub change_of_lift: f64,
    /// The same of the thrust \[1\].
    pub change_of_thrust: f64,
    /// The same of the force along n2 \[1\].
    #[serde(default)]
    pub change_of_side_force: f64,
}

/// The steps that bound the last part and its halves, as far as they were seen.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Bounds([Option<Integrals>; 2]);

impl Bounds {
    /// Takes the next step of the flight.
    pub fn take(&mut self, record: &Record, setup: &FlightSetup) {
        if setup.time.period.is_some() {
            return;
        }
        for (bound, part) in self.0.iter_mut().zip(FROM) {
            if bound.is_none() && record.step as f64 >= part * setup.time.steps as f64 {
                *bound = Some(record.into());
            }
        }
    }

    /// The last part of a flight that ends with `last`; none where it ended early or has too few steps.
    pub fn ended_by(&self, last: &Record, setup: &FlightSetup) -> Option<LastPart> {
        let [from, middle] = [self.0[0].as_ref()?, self.0[1].as_ref()?];
        let last = &Integrals::from(last);
        let in_order = from.step < middle.step && middle.step < last.step;
        if !in_order || last.step < setup.time.steps {
            return None;
        }
        let mean = |ends| BeatMeans::between(setup, 0, ends).mean;
        let [all, first, second] = [[from, last], [from, middle], [middle, last]].map(mean);
        let size = all.force().max(f64::MIN_POSITIVE);
        Some(LastPart {
            from_s: from.time,
            to_s: last.time,
            change_of_lift: (second.lift_newton - first.lift_newton) / size,
            change_of_thrust: (second.thrust_newton - first.thrust_newton) / size,
            change_of_side_force: (second.side_force_newton - first.side_force_newton) / size,
            mean: all,
        })
    }
}

#[cfg(test)]
mod tests {
    use wingbeat_case::LoadedCase;
    use wingbeat_flight::TimeGrid;
    use wingbeat_math::DVec3;

    use super::*;

    /// A lift of `2 t` N and a dynamic pressure of 3 N from 0 to 20 s: 36 N on average over the last 4 s, 34 and 38 N
    /// over its halves.
    #[test]
    fn exact_last_fifth_of_a_lift_that_rises_steadily() {
        let mut setup = LoadedCase::find("rectangular-wing", &[]).unwrap().setup;
        setup.time = TimeGrid {
            step: 1.0,
            steps: 20,
            period: None,
        };
        let record = |k: usize| Record {
            step: k,
            time: k as f64,
            air_impulse: DVec3::new(0.0, 0.0, -((k * k) as f64)),
            dynamic_impulse: 3.0 * k as f64,
            ..Record::default()
        };
        let part = |setup: &FlightSetup, rows: &[usize]| {
            let mut bounds = Bounds::default();
            rows.iter().for_each(|&k| bounds.take(&record(k), setup));
            bounds.ended_by(&record(rows[rows.len() - 1]), setup)
        };
        let every: Vec<usize> = (0..=20).collect();
        let last = part(&setup, &every).unwrap();
        assert_eq!([last.from_s, last.to_s], [16.0, 20.0]);
        assert_eq!(last.mean.lift_newton, 36.0);
        assert_eq!(last.mean.lift_coefficient, Some(12.0));
        assert_eq!(last.change_of_lift, 4.0 / 36.0);
        assert_eq!(part(&setup, &[0, 16, 18, 20]), Some(last));
        // Ended early; too few rows; wingbeats.
        assert_eq!(part(&setup, &every[..20]), None);
        assert_eq!(part(&setup, &[0, 10, 20]), None);
        setup.time.period = Some(5.0);
        assert_eq!(part(&setup, &every), None);
    }
}
