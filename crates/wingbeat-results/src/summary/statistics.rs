//! What a summary needs to know of a history, gathered row by row.

use std::collections::BTreeMap;
use std::path::Path;

use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use super::{BeatMeans, down};
use crate::rows::Rows;
use wingbeat_case::IoError;

/// One column.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    pub first: f64,
    pub last: f64,
    pub sum: f64,
    pub least: f64,
    pub highest: f64,
    /// Largest magnitude.
    pub most: f64,
}

const NOTHING: Column = Column {
    first: 0.0,
    last: 0.0,
    sum: 0.0,
    least: f64::INFINITY,
    highest: f64::NEG_INFINITY,
    most: 0.0,
};

impl Column {
    /// From start to end.
    pub fn change(&self) -> f64 {
        self.last - self.first
    }

    fn take(&mut self, value: f64, first: bool) {
        if first {
            self.first = value;
        }
        self.last = value;
        self.sum += value;
        self.least = self.least.min(value);
        self.highest = self.highest.max(value);
        self.most = self.most.max(value.abs());
    }
}

/// A whole history.
#[derive(Clone, Debug)]
pub(super) struct Statistics {
    pub rows: usize,
    columns: BTreeMap<String, Column>,
    /// Air force against gravity and along n1 in the last row \[N\].
    pub last_force: [f64; 2],
    /// Largest momentum and largest momentum residual \[kg m/s\].
    pub largest_momentum: [f64; 2],
    /// Means over whole wingbeats.
    pub beats: Vec<BeatMeans>,
}

impl Statistics {
    /// Reads the history once.
    pub fn read(path: &Path, setup: &FlightSetup) -> Result<Self, IoError> {
        let mut rows = Rows::open(path)?;
        let names = rows.names().to_vec();
        let places = Places::new(&names);
        let mut columns = vec![NOTHING; names.len()];
        let mut beats = Beats::new(setup);
        let (mut count, mut last_force, mut largest) = (0, [0.0; 2], [0.0_f64; 2]);
        while let Some(row) = rows.next_row()? {
            for (column, value) in columns.iter_mut().zip(row) {
                column.take(*value, count == 0);
            }
            let force = places.force(row);
            last_force = [-force.dot(down(setup)), force.x];
            let sizes = places.momenta.map(|at| vector(row, at).length());
            largest = [largest[0].max(sizes[0]), largest[1].max(sizes[1])];
            let impulse = vector(row, places.impulse).dot(down(setup));
            let values = [last_force[0], last_force[1], places.power(row)];
            beats.take(count, values, impulse);
            count += 1;
        }
        Ok(Self {
            rows: count,
            columns: names.into_iter().zip(columns).collect(),
            last_force,
            largest_momentum: largest,
            beats: beats.done,
        })
    }

    /// A column; nothing but zeros if there is none of this name.
    pub fn of(&self, name: &str) -> Column {
        self.columns.get(name).copied().unwrap_or(NOTHING)
    }
}

/// Where the summed quantities stand in a row.
struct Places {
    forces: Vec<usize>,
    powers: Vec<usize>,
    momenta: [Option<usize>; 2],
    impulse: Option<usize>,
}

impl Places {
    fn new(names: &[String]) -> Self {
        let all = |start: &str, end: &str| -> Vec<usize> {
            let fits = |n: &String| n.starts_with(start) && n.ends_with(end);
            (0..names.len()).filter(|&k| fits(&names[k])).collect()
        };
        let at = |name: &str| names.iter().position(|n| n == name);
        Self {
            forces: all("air_", "_force_n1_newton"),
            powers: ["hinge_", "deformation_"]
                .iter()
                .flat_map(|start| all(start, "_power_watt"))
                .collect(),
            momenta: [
                at("momentum_n1_kg_m_per_s"),
                at("momentum_residual_n1_kg_m_per_s"),
            ],
            impulse: at("vortex_impulse_n1_kg_m_per_s"),
        }
    }

    /// Force of the air on all bodies, N components.
    fn force(&self, row: &[f64]) -> DVec3 {
        self.forces.iter().map(|&k| vector(row, Some(k))).sum()
    }

    fn power(&self, row: &[f64]) -> f64 {
        self.powers.iter().map(|&k| row[k]).sum()
    }
}

/// Three columns from `at` on.
fn vector(row: &[f64], at: Option<usize>) -> DVec3 {
    let part = at.and_then(|k| row.get(k..k + 3));
    part.map_or(DVec3::ZERO, DVec3::from_slice)
}

/// Means over wingbeats by the trapezoidal rule (exact to the ends of a period).
struct Beats {
    per_beat: usize,
    weight: f64,
    sum: [f64; 3],
    /// Length of a beat [s], impulse along gravity at its start [kg m/s].
    period: f64,
    impulse: f64,
    done: Vec<BeatMeans>,
}

impl Beats {
    fn new(setup: &FlightSetup) -> Self {
        let steps = |period: f64| (period / setup.time.step).round() as usize;
        Self {
            per_beat: setup.time.period.map_or(0, steps),
            weight: setup.animal.mass() * setup.gravity.length(),
            sum: [0.0; 3],
            period: setup.time.period.unwrap_or(1.0),
            impulse: 0.0,
            done: vec![],
        }
    }

    /// Lift, thrust and power of a row; impulse of the vortices along gravity.
    fn take(&mut self, row: usize, values: [f64; 3], impulse: f64) {
        if self.per_beat == 0 {
            return;
        }
        let end = row.is_multiple_of(self.per_beat);
        let part = if end { 0.5 } else { 1.0 };
        let add = |sum: &mut [f64; 3]| {
            for (s, v) in sum.iter_mut().zip(values) {
                *s += part * v;
            }
        };
        add(&mut self.sum);
        if end {
            if row > 0 {
                self.close((impulse - self.impulse) / self.period);
            }
            self.impulse = impulse;
            self.sum = [0.0; 3];
            add(&mut self.sum);
        }
    }

    fn close(&mut self, lift_by_impulse_newton: f64) {
        let [lift_newton, thrust_newton, power_watt] = self.sum.map(|s| s / self.per_beat as f64);
        self.done.push(BeatMeans {
            beat: self.done.len() + 1,
            lift_newton,
            lift_over_weight: (self.weight > 0.0).then(|| lift_newton / self.weight),
            thrust_newton,
            power_watt,
            lift_by_impulse_newton,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_mean_of_a_period() {
        // cos^2 over a whole period has the mean 1/2; the trapezoidal rule is exact for it.
        let angle = |k: usize| k as f64 * std::f64::consts::FRAC_PI_4;
        let mut beats = Beats {
            per_beat: 8,
            weight: 0.0,
            sum: [0.0; 3],
            period: 2.0,
            impulse: 0.0,
            done: vec![],
        };
        for k in 0..=20 {
            beats.take(k, [angle(k).cos().powi(2), 1.0, 0.0], 3.0 * k as f64);
        }
        assert_eq!(beats.done.len(), 2);
        for beat in beats.done {
            assert!((beat.lift_newton - 0.5).abs() < 1e-15); // one rounding
            assert_eq!(beat.thrust_newton, 1.0);
            assert_eq!(beat.lift_by_impulse_newton, 12.0); // 24 in 2 s
        }
    }
}
