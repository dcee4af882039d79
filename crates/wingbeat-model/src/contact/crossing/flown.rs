//! Wings that pass through each other as they are flown.

use super::bent::{Bending, Column, bend};
use super::{Crossing, Shared, are_joined, edge_gap, meet, pairs};
use crate::animal::{Animal, Wing};
use crate::contact::sheet::{LINES, Sheet};
use wingbeat_math::{DMat3, DVec3};

/// Counts how often wings pass through each other as they are flown, elastic wings with the shapes that loads give them.
#[derive(Clone, Debug)]
pub struct FlownCrossings {
    sheets: Vec<Sheet>,
    /// Of elastic wings.
    columns: Vec<Option<Vec<Column>>>,
    pairs: Vec<Pair>,
    /// Instants that were looked at.
    instants: usize,
}

/// Two wings, the edge that they share, and at how many instants they met.
#[derive(Clone, Debug)]
struct Pair {
    wings: [usize; 2],
    shared: Option<Shared>,
    met: usize,
}

impl FlownCrossings {
    /// For all pairs of wings of the animal; those `joined` at their roots as in [`super::crossings`], and in the
    /// same way those of which the first carries the second at its tip, `tips`.
    pub fn new(animal: &Animal, joined: &[[usize; 2]], tips: &[[usize; 2]]) -> Self {
        let wings = &animal.wings;
        let elastic = |w: &Wing| {
            let is_elastic = w.structure.is_some();
            is_elastic.then(|| Column::all(&w.mesh, LINES))
        };
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
                met: 0,
            }
        };
        Self {
            sheets: wings.iter().map(Sheet::new).collect(),
            columns: wings.iter().map(elastic).collect(),
            pairs: pairs(0..wings.len()).map(pair).collect(),
            instants: 0,
        }
    }

    /// Looks at an instant: places of the hinges \[m\] and attitudes of all wings in one frame, and how the elastic ones
    /// are bent, in their order.
    pub fn see(&mut self, poses: &[(DVec3, DMat3)], bent: impl Iterator<Item = Bending>) {
        self.instants += 1;
        let mut bent = bent;
        let wings = self.sheets.iter().zip(&self.columns).zip(poses);
        let placed = wings.map(|((sheet, columns), pose)| {
            let bending = columns.as_ref().and_then(|c| Some((c, bent.next()?)));
            match bending {
                None => sheet.placed(*pose),
                Some((columns, bending)) => {
                    let mut nodes = sheet.nodes.clone();
                    bend(&mut nodes, columns, &bending);
                    nodes.iter().map(|x| pose.0 + pose.1 * *x).collect()
                }
            }
        });
        let nodes: Vec<Vec<DVec3>> = placed.collect();
        for pair in &mut self.pairs {
            let sheets = pair.wings.map(|w| &self.sheets[w]);
            let nodes = pair.wings.map(|w| nodes[w].clone());
            pair.met += usize::from(meet(sheets, nodes, pair.shared));
        }
    }

    /// What was counted so far: instants, then those at which each pair met.
    pub fn counts(&self) -> Vec<usize> {
        let met = self.pairs.iter().map(|p| p.met);
        std::iter::once(self.instants).chain(met).collect()
    }

    /// Goes on from [`Self::counts`] of the same wings.
    pub fn count_on(&mut self, counts: &[usize]) {
        let [instants, met @ ..] = counts else { return };
        self.instants = *instants;
        for (pair, met) in self.pairs.iter_mut().zip(met) {
            pair.met = *met;
        }
    }

    /// The pairs that passed through each other, and in which part of the instants.
    pub fn found(&self) -> Vec<Crossing> {
        let met = self.pairs.iter().filter(|p| p.met > 0);
        let crossing = |p: &Pair| Crossing {
            wings: p.wings,
            part: p.met as f64 / self.instants as f64,
        };
        met.map(crossing).collect()
    }
}
