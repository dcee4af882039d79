//! What happened, in words and numbers, and how far it can be trusted.

mod trust;
mod words;

use serde::{Deserialize, Serialize};
use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use super::{History, Outcome};
use crate::case::LoadedCase;

/// Means over one wingbeat.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeatMeans {
    /// Number of the beat, from 1.
    pub beat: usize,
    /// Mean air force against gravity \[N\].
    pub lift_newton: f64,
    /// The same over the weight; none without gravity.
    pub lift_over_weight: Option<f64>,
    /// Mean air force along n1 (forward) \[N\].
    pub thrust_newton: f64,
    /// Mean power the hinge actuators give \[W\].
    pub power_watt: f64,
}

/// Numbers of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Case name.
    pub case: String,
    /// How the run ended.
    pub outcome: Outcome,
    /// Steps made.
    pub steps: usize,
    /// Time flown \[s\].
    pub time_s: f64,
    /// Mass of the animal \[kg\].
    pub mass_kg: f64,
    /// Means of each whole wingbeat.
    pub beats: Vec<BeatMeans>,
    /// Air force against gravity at the end \[N\].
    pub final_lift_newton: f64,
    /// Air force along n1 (forward) at the end \[N\].
    pub final_thrust_newton: f64,
    /// Way of the body origin from start to end, N components \[m\].
    pub displacement_m: [f64; 3],
    /// Change of pitch, yaw, roll from start to end \[deg\].
    pub turn_deg: [f64; 3],
    /// Largest energy residual over the energy that was turned over \[1\].
    pub energy_residual_relative: f64,
    /// Largest momentum residual over the largest impulse or momentum \[1\].
    pub momentum_residual_relative: f64,
    /// Largest violation of a connection constraint \[m\].
    pub violation_position_m: f64,
    /// Largest violation of an orientation constraint \[1\].
    pub violation_orientation: f64,
    /// Smallest |cos theta| of all bodies \[1\].
    pub euler_regularity: f64,
    /// Most corrector passes in a step.
    pub corrector_passes_most: usize,
    /// Mean corrector passes.
    pub corrector_passes_mean: f64,
    /// Near-singular velocities that were regularised, all steps.
    pub regularised: usize,
    /// Wake rings at the end.
    pub wake_rings: usize,
    /// Largest uniform leak velocity of closed surfaces \[m/s\].
    pub leak_velocity_m_s: f64,
    /// What a reader should know before using the numbers.
    pub warnings: Vec<String>,
}

/// Unit vector along gravity; n3 without gravity.
pub fn down(setup: &FlightSetup) -> DVec3 {
    setup.gravity.try_normalize().unwrap_or(DVec3::Z)
}

/// Total air force along a direction, row by row \[N\].
pub fn air_force(history: &History, direction: DVec3) -> Vec<f64> {
    let mut total = vec![0.0; history.rows()];
    for k in 0..3 {
        let suffix = format!("_force_n{}_newton", k + 1);
        let part = history.sum(|n| n.starts_with("air_") && n.ends_with(&suffix));
        for (t, x) in total.iter_mut().zip(part) {
            *t += direction[k] * x;
        }
    }
    total
}

fn final_force(history: &History, direction: DVec3) -> f64 {
    air_force(history, direction).last().copied().unwrap_or(0.0)
}

/// Total power of the hinge actuators, row by row \[W\].
pub fn hinge_power(history: &History) -> Vec<f64> {
    history.sum(|n| n.starts_with("hinge_") && n.ends_with("_power_watt"))
}

/// Mean of `y` over rows `range` by the trapezoidal rule (exact to the ends of a period).
fn mean(y: &[f64], range: std::ops::RangeInclusive<usize>) -> f64 {
    let part = &y[range];
    let n = part.len() - 1;
    let inner: f64 = part[1..n].iter().sum();
    (inner + 0.5 * (part[0] + part[n])) / n as f64
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |a, x| a.max(x.abs()))
}

/// Largest length of the vectors in three columns.
fn largest_vector(history: &History, stem: &str, unit: &str) -> f64 {
    let column = |k: usize| history.column(&format!("{stem}_n{k}_{unit}"));
    let [a, b, c] = [column(1), column(2), column(3)];
    let lengths = a
        .iter()
        .zip(b)
        .zip(c)
        .map(|((x, y), z)| DVec3::new(*x, *y, *z).length());
    largest(lengths)
}

impl Summary {
    /// From the history of a run.
    pub fn new(case: &LoadedCase, history: &History, outcome: &Outcome) -> Self {
        let setup = &case.setup;
        let time_s = history.column("time_s").last().copied().unwrap_or(0.0);
        let total = |name: &str| history.column(name).iter().sum::<f64>();
        let last = |name: &str| history.column(name).last().copied().unwrap_or(0.0);
        let most = |name: &str| largest(history.column(name).iter().copied());
        let change = |name: String| {
            let c = history.column(&name);
            c.last().unwrap_or(&0.0) - c.first().unwrap_or(&0.0)
        };
        let regularity = history.column("euler_regularity_dimensionless");
        let passes = history.column("corrector_passes_count");
        let mut summary = Self {
            case: case.name.clone(),
            outcome: outcome.clone(),
            steps: history.rows().saturating_sub(1),
            time_s,
            mass_kg: setup.animal.mass(),
            beats: beats(setup, history),
            final_lift_newton: final_force(history, -down(setup)),
            final_thrust_newton: final_force(history, DVec3::X),
            displacement_m: ["x", "y", "z"].map(|k| change(format!("body_{k}_m"))),
            turn_deg: ["phi", "theta", "psi"].map(|k| change(format!("body_{k}_rad")).to_degrees()),
            energy_residual_relative: energy_residual(history),
            momentum_residual_relative: momentum_residual(setup, history, time_s),
            violation_position_m: most("violation_position_m"),
            violation_orientation: most("violation_orientation_dimensionless"),
            euler_regularity: regularity.iter().copied().fold(1.0, f64::min),
            corrector_passes_most: most("corrector_passes_count") as usize,
            corrector_passes_mean: passes.iter().sum::<f64>() / passes.len().max(1) as f64,
            regularised: total("regularised_count") as usize,
            wake_rings: last("wake_rings_count") as usize,
            leak_velocity_m_s: most("leak_velocity_m_per_s"),
            warnings: vec![],
        };
        summary.warnings = trust::warnings(setup, &summary);
        summary
    }

    /// As JSON in one line, with the directory it belongs to.
    pub fn to_json_line(&self, dir: &std::path::Path) -> String {
        serde_json::json!({ "directory": dir, "summary": self }).to_string()
    }

    /// As JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a summary is JSON") + "\n"
    }
}

fn beats(setup: &FlightSetup, history: &History) -> Vec<BeatMeans> {
    let Some(period) = setup.time.period else {
        return vec![];
    };
    let per_beat = (period / setup.time.step).round() as usize;
    if per_beat == 0 || history.rows() == 0 {
        return vec![];
    }
    let weight = setup.animal.mass() * setup.gravity.length();
    let lift = air_force(history, -down(setup));
    let thrust = air_force(history, DVec3::X);
    let power = hinge_power(history);
    let whole = (history.rows() - 1) / per_beat;
    let beat = |k: usize| {
        let rows = k * per_beat..=(k + 1) * per_beat;
        let lift_newton = mean(&lift, rows.clone());
        BeatMeans {
            beat: k + 1,
            lift_newton,
            lift_over_weight: (weight > 0.0).then(|| lift_newton / weight),
            thrust_newton: mean(&thrust, rows.clone()),
            power_watt: mean(&power, rows),
        }
    };
    (0..whole).map(beat).collect()
}

/// Largest residual over the largest of the energies and works.
fn energy_residual(history: &History) -> f64 {
    let range = |name: &str| {
        let c = history.column(name);
        let [lo, hi] = c
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &x| {
                [a.min(x), b.max(x)]
            });
        (hi - lo).max(0.0)
    };
    let names = [
        "kinetic_energy_joule",
        "hinge_work_joule",
        "air_work_joule",
        "potential_energy_joule",
    ];
    let scale = largest(names.map(range));
    ratio(
        largest(history.column("energy_residual_joule").iter().copied()),
        scale,
    )
}

/// Largest residual over the impulse of weight and the largest momentum.
fn momentum_residual(setup: &FlightSetup, history: &History, time: f64) -> f64 {
    let unit = "kg_m_per_s";
    let impulse = setup.animal.mass() * setup.gravity.length() * time;
    let scale = impulse.max(largest_vector(history, "momentum", unit));
    ratio(largest_vector(history, "momentum_residual", unit), scale)
}

fn ratio(x: f64, scale: f64) -> f64 {
    if scale > 0.0 { x / scale } else { x }
}
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_mean_of_a_period() {
        // cos^2 over a whole period has the mean 1/2; the trapezoidal rule is exact for it.
        let angle = |k: i32| f64::from(k) * std::f64::consts::FRAC_PI_4;
        let y: Vec<f64> = (0..=8).map(|k| angle(k).cos().powi(2)).collect();
        assert!((mean(&y, 0..=8) - 0.5).abs() < 1e-15); // one rounding
    }
}
