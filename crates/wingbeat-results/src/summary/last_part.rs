//! Means over the last part of a flight without wingbeats: of wings held in a stream, say, whose flow has
//! become steady.

use serde::{Deserialize, Serialize};
use wingbeat_flight::{FlightSetup, Record};

use super::beats::BeatMeans;
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
}

/// The records that bound the last part and its halves, as far as they were seen.
#[derive(Clone, Debug, Default)]
pub(super) struct Bounds([Option<Record>; 2]);

impl Bounds {
    /// Takes the next record of the flight.
    pub fn take(&mut self, record: &Record, setup: &FlightSetup) {
        if setup.time.period.is_some() {
            return;
        }
        for (bound, part) in self.0.iter_mut().zip(FROM) {
            if bound.is_none() && record.step as f64 >= part * setup.time.steps as f64 {
                *bound = Some(record.clone());
            }
        }
    }

    /// The last part of a flight that ends with `last`; none where it ended early or has too few rows.
    pub fn ended_by(&self, last: &Record, setup: &FlightSetup) -> Option<LastPart> {
        let [from, middle] = [self.0[0].as_ref()?, self.0[1].as_ref()?];
        let in_order = from.step < middle.step && middle.step < last.step;
        if !in_order || last.step < setup.time.steps {
            return None;
        }
        let mean = |from: &Record, to: &Record| BeatMeans::between(setup, 0, from, to).mean;
        let [all, first, second] = [mean(from, last), mean(from, middle), mean(middle, last)];
        let size = all.lift_newton.hypot(all.thrust_newton);
        let size = size.max(f64::MIN_POSITIVE);
        Some(LastPart {
            from_s: from.time,
            to_s: last.time,
            change_of_lift: (second.lift_newton - first.lift_newton) / size,
            change_of_thrust: (second.thrust_newton - first.thrust_newton) / size,
            mean: all,
        })
    }
}
