//! Numbers of a run.

use serde::{Deserialize, Serialize};
use wingbeat_math::larger;

use super::beats::BeatMeans;
use super::bent::BentWing;
use super::held::Departures;
use super::impulse::ImpulseBudget;
use super::last_part::LastPart;
use super::means::ManyBeats;
use super::verdict::Verdict;
use crate::Outcome;

/// Numbers of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Case name.
    pub case: String,
    /// How the run ended.
    pub outcome: Outcome,
    /// How far it can be trusted, at a glance.
    #[serde(default)]
    pub verdict: Verdict,
    /// Why.
    #[serde(default)]
    pub verdict_reason: String,
    /// Steps made.
    pub steps: usize,
    /// Time flown \[s\].
    pub time_s: f64,
    /// Mass of the animal \[kg\].
    pub mass_kg: f64,
    /// Means of each whole wingbeat.
    pub beats: Vec<BeatMeans>,
    /// Means over all but the first of them ([`super::left_out`]: two or more), with standard errors; none of fewer than
    /// three besides.
    #[serde(default)]
    pub means: Option<ManyBeats>,
    /// Means over the last fifth of a flight without wingbeats; none of one with them, or that ended early.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub last_part: Option<LastPart>,
    /// Unit vector of gravity, against which lift counts, N components \[1\]; left out of files where it is n3.
    #[serde(default = "n3", skip_serializing_if = "is_n3")]
    pub gravity_direction: [f64; 3],
    /// Air force against gravity at the end \[N\].
    pub final_lift_newton: f64,
    /// Air force along n1 (forward) at the end \[N\].
    pub final_thrust_newton: f64,
    /// Way of the body origin from start to end, N components \[m\].
    pub displacement_m: [f64; 3],
    /// Change of pitch, yaw, roll from start to end \[deg\].
    pub turn_deg: [f64; 3],
    /// Largest energy residual over the energy turned over \[1\].
    pub energy_residual_relative: f64,
    /// What passive joints lose or gain beside their springs, dampers and stops, over the same \[1\]; 0 where
    /// there are none.
    #[serde(default)]
    pub joint_residual_relative: f64,
    /// Largest momentum residual over the impulse in play \[1\].
    pub momentum_residual_relative: f64,
    /// Largest violation of a connection constraint \[m\].
    pub violation_position_m: f64,
    /// Largest violation of an orientation constraint \[1\].
    pub violation_orientation: f64,
    /// Smallest |cos theta| of all bodies \[1\].
    pub euler_regularity: f64,
    /// Most corrector passes in a step.
    pub corrector_passes_most: usize,
    /// Mean corrector passes \[1\].
    pub corrector_passes_mean: f64,
    /// Near-singular velocities that were regularised, all steps.
    pub regularised: usize,
    /// Of these, ways of wake nodes (`air.max_displacement_m`) and strengths of particles that were limited, and leading
    /// edges that shed what they had too much.
    #[serde(default)]
    pub limited: usize,
    /// Those over all ways of wake nodes; where nothing but leading edges without a solution can be limited,
    /// over all chordwise strips in all steps \[1\].
    #[serde(default)]
    pub limited_part: f64,
    /// Wake rings with circulation that left leading edges, all steps, with `air.mirror` on the half computed \[1\]; none
    /// without a lattice and of results that do not say it.
    #[serde(default)]
    pub leading_rings: Option<f64>,
    /// Most steps in a row in which the force of the air on a wing turned back by no much smaller a change:
    /// some 2 in sound flights, up to 7 where wings turn among their wakes.
    #[serde(default)]
    pub alternating_steps: usize,
    /// Wake rings at the end.
    pub wake_rings: usize,
    /// Vortex particles at the end.
    #[serde(default)]
    pub wake_particles: usize,
    /// Largest net-flux residual of closed surfaces: a uniform normal velocity \[m/s\].
    pub net_flux_residual_m_s: f64,
    /// What became of the impulse that surfaces gave to the air; none without a lattice.
    #[serde(default)]
    pub impulse_budget: Option<ImpulseBudget>,
    /// How far loads bent the elastic wings.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub elastic_wings: Vec<BentWing>,
    /// Under feedback: how far the flight was from what it is to hold.
    #[serde(default)]
    pub departures: Option<Departures>,
    /// What a reader should know before using the numbers.
    pub warnings: Vec<String>,
}

fn n3() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

fn is_n3(direction: &[f64; 3]) -> bool {
    *direction == n3()
}

impl Summary {
    /// Whether n3 points down, as frames and words take it.
    pub(super) fn has_n3_down(&self) -> bool {
        is_n3(&self.gravity_direction)
    }

    /// The numbers of two runs beside each other: what, this, the other; wingbeats as far as both
    /// have them.
    pub fn beside(&self, other: &Self) -> Vec<(String, f64, f64)> {
        let mut rows = vec![];
        for (k, (a, b)) in self.beats.iter().zip(&other.beats).enumerate() {
            let of_beat = |(what, x, y)| (format!("{what}, beat {}", k + 1), x, y);
            rows.extend(a.mean.beside(&b.mean).into_iter().map(of_beat));
        }
        let moved = without_rounding([self.displacement_m, other.displacement_m], 0.0);
        let turned = without_rounding([self.turn_deg, other.turn_deg], 1.0);
        let kept = |summary: &Self, k: usize| Self {
            displacement_m: moved[k],
            turn_deg: turned[k],
            ..summary.clone()
        };
        let [a, b] = [kept(self, 0), kept(other, 1)];
        rows.extend(Self::NUMBERS.into_iter().filter_map(|q| {
            let label = q.label?.to_owned();
            Some((label, (q.of)(&a)?, (q.of)(&b)?))
        }));
        rows
    }

    /// The largest of all elastic wings; none where no wing is elastic.
    pub(super) fn largest_bent(&self, of: impl Fn(&BentWing) -> f64) -> Option<f64> {
        self.elastic_wings.iter().map(of).reduce(larger)
    }

    /// As JSON in one line, with the directory it belongs to.
    pub fn to_json_line(&self, dir: &std::path::Path) -> String {
        serde_json::json!({ "directory": dir.to_string_lossy(), "summary": self }).to_string()
    }

    /// As JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a summary is JSON") + "\n"
    }
}

/// The vectors of two flights with 0 for components that are rounding beside the largest of them all, or beside
/// `least`. What a flight that broke down has beyond a kilometre, or some turns, does not count for the other.
fn without_rounding(both: [[f64; 3]; 2], least: f64) -> [[f64; 3]; 2] {
    const ROUNDING: f64 = 1e-12;
    const FAR: f64 = 1e3;
    let size = |v: &[f64; 3]| v.iter().fold(least, |m, x| m.max(x.abs()));
    let all = size(&both[0]).max(size(&both[1]));
    both.map(|v| {
        let largest = all.min(size(&v).max(FAR));
        v.map(|x| if x.abs() > ROUNDING * largest { x } else { 0.0 })
    })
}

#[cfg(test)]
mod tests {
    use super::without_rounding;

    #[test]
    fn exact_rounding_of_a_component_is_no_change() {
        let moved = [[2e-3, -1.7e-19, 1e-3], [1e-9, 1.7e-16, 0.0]];
        let kept = without_rounding(moved, 0.0);
        assert_eq!(kept, [[2e-3, 0.0, 1e-3], [1e-9, 0.0, 0.0]]);
        let turned = without_rounding([[0.0, 3e-15, 1e-6], [0.0; 3]], 1.0);
        assert_eq!(turned[0], [0.0, 0.0, 1e-6]);
        let broken = without_rounding([[2e-3, 1e-5, 0.0], [3e20, 1e5, -1e19]], 0.0);
        assert_eq!(broken, [[2e-3, 1e-5, 0.0], [3e20, 0.0, -1e19]]);
    }
}
