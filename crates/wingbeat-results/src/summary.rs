//! What happened, in words and numbers, and how far it can be trusted.

mod statistics;
mod trust;
mod words;

use std::path::Path;

use serde::{Deserialize, Serialize};
use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use super::{History, Outcome};
use statistics::Statistics;
use wingbeat_case::IoError;
use wingbeat_case::LoadedCase;

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
    /// Mean power that hinge actuators and prescribed deformation give \[W\].
    pub power_watt: f64,
    /// Mean air force against gravity by another way, the rate of the vortex impulse \[N\]; zero
    /// without a lattice.
    #[serde(default)]
    pub lift_by_impulse_newton: f64,
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
    /// Vortex particles at the end.
    #[serde(default)]
    pub wake_particles: usize,
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

/// Total power of hinge actuators and prescribed deformation, row by row \[W\].
pub fn hinge_power(history: &History) -> Vec<f64> {
    let gives = |n: &str| n.starts_with("hinge_") || n.starts_with("deformation_");
    history.sum(|n| gives(n) && n.ends_with("_power_watt"))
}

impl Summary {
    /// From the history of a run, read row by row.
    ///
    /// # Errors
    /// A history that cannot be read.
    pub fn read(case: &LoadedCase, history: &Path, outcome: &Outcome) -> Result<Self, IoError> {
        let setup = &case.setup;
        let s = Statistics::read(history, setup)?;
        let passes = s.of("corrector_passes_count");
        let [lift, thrust] = s.last_force;
        let mut summary = Self {
            case: case.name.clone(),
            outcome: outcome.clone(),
            steps: s.rows.saturating_sub(1),
            time_s: s.of("time_s").last,
            mass_kg: setup.animal.mass(),
            final_lift_newton: lift,
            final_thrust_newton: thrust,
            displacement_m: ["x", "y", "z"].map(|k| s.of(&format!("body_{k}_m")).change()),
            turn_deg: ["phi", "theta", "psi"]
                .map(|k| s.of(&format!("body_{k}_rad")).change().to_degrees()),
            energy_residual_relative: energy_residual(&s),
            momentum_residual_relative: momentum_residual(setup, &s),
            violation_position_m: s.of("violation_position_m").most,
            violation_orientation: s.of("violation_orientation_dimensionless").most,
            euler_regularity: s.of("euler_regularity_dimensionless").least.min(1.0),
            corrector_passes_most: passes.most as usize,
            corrector_passes_mean: passes.sum / s.rows.max(1) as f64,
            regularised: s.of("regularised_count").sum as usize,
            wake_rings: s.of("wake_rings_count").last as usize,
            wake_particles: s.of("wake_particles_count").last as usize,
            leak_velocity_m_s: s.of("leak_velocity_m_per_s").most,
            warnings: vec![],
            beats: s.beats,
        };
        summary.warnings = trust::warnings(setup, &summary);
        Ok(summary)
    }

    /// The numbers of two runs beside each other: what, this, the other; wingbeats as far as both
    /// have them.
    pub fn beside(&self, other: &Self) -> Vec<(String, f64, f64)> {
        let mut rows = vec![];
        for (k, (a, b)) in self.beats.iter().zip(&other.beats).enumerate() {
            let of = |what: &str| format!("{what}, beat {}", k + 1);
            if let (Some(x), Some(y)) = (a.lift_over_weight, b.lift_over_weight) {
                rows.push((of("lift over weight"), x, y));
            }
            rows.push((of("lift [N]"), a.lift_newton, b.lift_newton));
            rows.push((of("forward force [N]"), a.thrust_newton, b.thrust_newton));
            rows.push((of("power [W]"), a.power_watt, b.power_watt));
        }
        let [a, b] = [self.numbers(), other.numbers()];
        rows.extend(
            a.into_iter()
                .zip(b)
                .map(|((what, x), (_, y))| (what.to_owned(), x, y)),
        );
        rows
    }

    fn numbers(&self) -> [(&'static str, f64); 18] {
        let [x, y, z] = self.displacement_m;
        let [pitch, yaw, roll] = self.turn_deg;
        [
            ("steps", self.steps as f64),
            ("time [s]", self.time_s),
            ("mass [kg]", self.mass_kg),
            ("moved forward n1 [m]", x),
            ("moved right n2 [m]", y),
            ("moved down n3 [m]", z),
            ("turned in pitch [deg]", pitch),
            ("turned in yaw [deg]", yaw),
            ("turned in roll [deg]", roll),
            ("lift at the end [N]", self.final_lift_newton),
            ("forward force at the end [N]", self.final_thrust_newton),
            ("energy residual, relative", self.energy_residual_relative),
            (
                "momentum residual, relative",
                self.momentum_residual_relative,
            ),
            ("constraint violation [m]", self.violation_position_m),
            (
                "constraint violation, orientation",
                self.violation_orientation,
            ),
            ("corrector passes, mean", self.corrector_passes_mean),
            ("wake rings", self.wake_rings as f64),
            ("regularised events", self.regularised as f64),
        ]
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

/// Largest residual over the largest of the energies and works.
fn energy_residual(s: &Statistics) -> f64 {
    let names = [
        "kinetic_energy_joule",
        "hinge_work_joule",
        "air_work_joule",
        "deformation_work_joule",
        "potential_energy_joule",
    ];
    let range = |name: &str| (s.of(name).highest - s.of(name).least).max(0.0);
    let scale = names.map(range).into_iter().fold(0.0, f64::max);
    ratio(s.of("energy_residual_joule").most, scale)
}

/// Largest residual over the impulse of weight and the largest momentum.
fn momentum_residual(setup: &FlightSetup, s: &Statistics) -> f64 {
    let impulse = setup.animal.mass() * setup.gravity.length() * s.of("time_s").last;
    let [momentum, residual] = s.largest_momentum;
    ratio(residual, impulse.max(momentum))
}

fn ratio(x: f64, scale: f64) -> f64 {
    if scale > 0.0 { x / scale } else { x }
}
