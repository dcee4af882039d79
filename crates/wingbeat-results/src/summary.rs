//! What happened, in words and numbers, and how far it can be trusted.

pub mod beats;
mod statistics;
mod trust;
mod words;

use std::path::Path;

use serde::{Deserialize, Serialize};
use wingbeat_flight::FlightSetup;

use super::Outcome;
pub use beats::{BeatMeans, down, over_weight, steps_per_beat};
use statistics::Statistics;
use wingbeat_case::IoError;
use wingbeat_case::LoadedCase;

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
    /// Largest energy residual over the largest energy or work in play \[1\].
    pub energy_residual_relative: f64,
    /// Largest momentum residual over the largest impulse or momentum in play \[1\].
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

impl Summary {
    /// From the history of a run, read row by row.
    ///
    /// # Errors
    /// A history that cannot be read.
    pub fn read(case: &LoadedCase, history: &Path, outcome: &Outcome) -> Result<Self, IoError> {
        let setup = &case.setup;
        let s = Statistics::read(history, setup)?;
        let mut summary = Self {
            case: case.name.clone(),
            outcome: outcome.clone(),
            steps: s.last.step,
            time_s: s.last.time,
            mass_kg: setup.animal.mass(),
            final_lift_newton: s.last.lift(down(setup)),
            final_thrust_newton: s.last.air_force().x,
            displacement_m: [0, 1, 2].map(|k| s.change(k)),
            turn_deg: [3, 4, 5].map(|k| s.change(k).to_degrees()),
            energy_residual_relative: energy_residual(&s),
            momentum_residual_relative: momentum_residual(setup, &s),
            violation_position_m: s.violation_position.most,
            violation_orientation: s.violation_orientation.most,
            euler_regularity: s.euler_regularity.least.min(1.0),
            corrector_passes_most: s.corrector_passes.most as usize,
            corrector_passes_mean: s.passes_sum as f64 / s.rows.max(1) as f64,
            regularised: s.regularised,
            wake_rings: s.last.wake_rings,
            wake_particles: s.last.wake_particles,
            leak_velocity_m_s: s.leak_velocity.most,
            warnings: vec![],
            beats: s.beats,
        };
        summary.warnings = trust::warnings(setup, &summary);
        summary.warnings.extend(thinning(case));
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

/// Part of the largest potential energy, which has no natural zero, that always counts as turned
/// over: far above its round-off.
const POTENTIAL_FLOOR: f64 = 1e-6;

/// Largest residual over the largest of what is in play: kinetic energy, change of potential energy,
/// works.
fn energy_residual(s: &Statistics) -> f64 {
    let works = [s.hinge_work, s.air_work, s.deformation_work, s.applied_work];
    let energies = [
        s.kinetic_energy.most,
        s.potential_energy.range(),
        POTENTIAL_FLOOR * s.potential_energy.most,
    ];
    let works = works.map(|w| w.most);
    let scale = energies.into_iter().chain(works).fold(0.0, f64::max);
    ratio(s.energy_residual.most, scale)
}

/// Largest residual over the largest of what is in play: the momentum, the impulse of the weight, and
/// the momentum that the kinetic energy stands for where that of the parts cancels.
fn momentum_residual(setup: &FlightSetup, s: &Statistics) -> f64 {
    let mass = setup.animal.mass();
    let impulse = mass * setup.gravity.length() * s.last.time;
    let of_parts = (2.0 * mass * s.kinetic_energy.most).sqrt();
    let scale = impulse.max(s.momentum.most).max(of_parts);
    ratio(s.momentum_residual.most, scale)
}

/// What a thinned history leaves out.
fn thinning(case: &LoadedCase) -> Option<String> {
    let every = case.output.history_every;
    (every > 1).then(|| format!("The history holds every {every}th step and the ends of wingbeats: means of wingbeats, sums and extremes are those of all steps, residuals of balances those of its rows."))
}

fn ratio(x: f64, scale: f64) -> f64 {
    if scale > 0.0 { x / scale } else { x }
}

/// Total air force along a direction, row by row \[N\].
pub fn air_force(history: &super::History, direction: wingbeat_math::DVec3) -> Vec<f64> {
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
pub fn hinge_power(history: &super::History) -> Vec<f64> {
    let gives = |n: &str| n.starts_with("hinge_") || n.starts_with("deformation_");
    history.sum(|n| gives(n) && n.ends_with("_power_watt"))
}
