//! Wings that pass through each other as they are flown.

use super::depth::deeper;
use super::{Crossing, Shared, are_joined, edge_gap, joined, pairs, pass_through};
use crate::animal::Animal;
use crate::contact::bent::Bending;
use crate::contact::flown_sheets::FlownSheets;
use crate::contact::sheet::Pose;
use crate::motion::WingMotion;
use serde::{Deserialize, Serialize};

/// Counts how often wings pass through each other as they are flown, and how deep, elastic wings with the shapes that
/// loads give them and deforming ones with those prescribed.
#[derive(Clone, Debug)]
pub struct FlownCrossings {
    wings: FlownSheets,
    pairs: Vec<Pair>,
    counts: FlownCounts,
}

/// Two wings, and the edge that they share.
#[derive(Clone, Debug)]
struct Pair {
    wings: [usize; 2],
    shared: Option<Shared>,
}

/// What was counted of the wings of an animal.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FlownCounts {
    /// Instants that were looked at.
    instants: usize,
    /// Of each pair: instants at which they met, and how deep they reached through each other at most \[m\].
    met: Vec<(usize, f64)>,
}

impl FlownCrossings {
    /// For all pairs of wings of the animal; those `joined` at their roots as in [`super::crossings`], and in the
    /// same way those of which the first carries the second at its tip, `tips`.
    pub fn new(animal: &Animal, joined: &[[usize; 2]], tips: &[[usize; 2]]) -> Self {
        let wings = &animal.wings;
        let pair = |of: [usize; 2]| {
            let meshes = of.map(|w| &wings[w].mesh);
            let roots = are_joined(joined, of).then(|| Shared::roots(meshes));
            let tip = are_joined(tips, of).then(|| {
                let is_tip = [tips.contains(&of), !tips.contains(&of)];
                let gap = edge_gap(meshes, is_tip);
                Shared { is_tip, gap }
            });
            Pair {
                wings: of,
                shared: roots.or(tip),
            }
        };
        let pairs: Vec<Pair> = pairs(0..wings.len()).map(pair).collect();
        let met = vec![(0, 0.0); pairs.len()];
        Self {
            wings: FlownSheets::new(animal),
            pairs,
            counts: FlownCounts { instants: 0, met },
        }
    }

    /// Looks at an instant: places of the hinges \[m\] and attitudes of all wings in one frame, and how the elastic ones
    /// are bent, in their order; `phase` of the beat of a wing of some motion \[wingbeats\].
    pub fn see(
        &mut self,
        poses: &[Pose],
        bent: impl Iterator<Item = Bending>,
        phase: impl Fn(&WingMotion) -> f64,
    ) {
        self.counts.instants += 1;
        let nodes = self
            .wings
            .placed(poses.iter().copied().map(Some), bent, phase);
        for (pair, (met, deepest)) in self.pairs.iter().zip(&mut self.counts.met) {
            let sheets = pair.wings.map(|w| &self.wings.sheets[w]);
            let [Some(a), Some(b)] = pair.wings.map(|w| nodes[w].clone()) else {
                continue;
            };
            let [a, b] = joined(sheets, [a, b], pair.shared);
            if pass_through(sheets, [&a, &b]) {
                *met += 1;
                *deepest = deeper(sheets, [a, b], *deepest);
            }
        }
    }

    /// What was counted so far.
    pub fn counts(&self) -> &FlownCounts {
        &self.counts
    }

    /// Goes on from [`Self::counts`] of the same wings.
    pub fn count_on(&mut self, counts: FlownCounts) {
        if counts.met.len() == self.pairs.len() {
            self.counts = counts;
        }
    }

    /// The pairs that passed through each other, in which part of the instants, and how deep at most \[m\].
    pub fn found(&self) -> Vec<(Crossing, f64)> {
        let pairs = self.pairs.iter().zip(&self.counts.met);
        let met = pairs.filter(|(_, (met, _))| *met > 0);
        let crossing = |(pair, &(met, deepest)): (&Pair, &(usize, f64))| {
            let part = met as f64 / self.counts.instants as f64;
            let wings = pair.wings;
            (Crossing { wings, part }, deepest)
        };
        met.map(crossing).collect()
    }
}
