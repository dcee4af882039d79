//! The sources in single precision, for sums whose tolerance allows it: twice the lanes to a vector.
//!
//! Digits are lost where places are subtracted. So nodes are measured from the centre of their cluster,
//! some hundred edges that are neighbours, in units of the root mean square length of the edges: what is near
//! keeps its digits wherever the wake has gone, and powers of lengths stay far from the ends of the range.

use crate::cores::CoreModel;
use crate::direct::packed::Sources;
use crate::direct::packed::{Packed, PackedEdge};
use std::ops::Range;

/// The tolerance from which single precision serves: its error is some 1e-6 of the velocity.
pub(crate) const SINGLE: f64 = 1e-5;

/// Patches of a cluster of the direct sum: some 250 edges of a sheet.
pub(crate) const CLUSTER: usize = 16;

/// The part of l^2 below which t^2 - l^2 loses more than a digit.
const CLOSE: f32 = 0.1;

/// Largest number passed on: its square root times itself is still a number.
const LARGEST: f64 = 1e30;

/// All sources, the patches those of a [`Packed`].
#[derive(Clone, Debug, Default)]
pub(crate) struct Single {
    nodes: Vec<[f32; 4]>,
    edges: Vec<PackedEdge<f32>>,
    patches: Vec<crate::direct::packed::Patch>,
    /// Patches of each cluster.
    pub clusters: Vec<Range<usize>>,
    /// Where the places of its nodes are measured from [m].
    pub centres: Vec<[f64; 3]>,
    /// Inverse of the unit of length [1/m].
    pub per_unit: f64,
}

impl Single {
    /// Replaces the sources by these clusters of patches, which follow each other.
    pub fn load(
        &mut self,
        model: CoreModel,
        packed: &Packed,
        clusters: impl Iterator<Item = Range<usize>>,
    ) {
        let l2: f64 = packed.edges.iter().map(|e| e.l2).sum();
        let mean = (l2 / packed.edges.len().max(1) as f64).sqrt();
        self.per_unit = if mean > 0.0 { mean.recip() } else { 1.0 };
        self.clusters.clear();
        self.clusters.extend(clusters);
        self.patches.clone_from(&packed.patches);
        self.centres.clear();
        self.nodes.clear();
        for cluster in &self.clusters {
            let patches = &packed.patches[cluster.clone()];
            let (first, last) = (patches.first(), patches.last());
            let ends = first.zip(last).map(|(a, b)| a.nodes.start..b.nodes.end);
            let nodes = &packed.nodes[ends.unwrap_or_default()];
            let centre = middle(nodes);
            let place = |p: &[f64; 4]| {
                let [x, y, z] = [0, 1, 2].map(|i| ((p[i] - centre[i]) * self.per_unit) as f32);
                [x, y, z, (p[3] * self.per_unit * self.per_unit) as f32]
            };
            self.centres.push(centre);
            self.nodes.extend(nodes.iter().map(place));
        }
        let unit = self.unit_of_term(model);
        self.edges.clear();
        self.edges.extend(packed.edges.iter().map(|e| {
            let l2 = (e.l2 * self.per_unit * self.per_unit) as f32;
            PackedEdge {
                from: e.from,
                to: e.to,
                strength: (e.strength * self.per_unit) as f32,
                l2,
                close: CLOSE * l2,
                term: (e.term * unit).min(LARGEST) as f32,
            }
        }));
    }

    /// What a [`CoreModel::kernel_term`] is multiplied by: m^4, m^8 for Vatistas, m^-4 for Lamb-Oseen.
    fn unit_of_term(&self, model: CoreModel) -> f64 {
        let unit4 = self.per_unit.powi(4);
        match model {
            CoreModel::CutOff { .. } | CoreModel::Scully { .. } => unit4,
            CoreModel::Algebraic { .. } => 1.0,
            CoreModel::Vatistas { .. } => unit4 * unit4,
            CoreModel::LambOseen { .. } => unit4.recip(),
        }
    }

    /// What the loop takes.
    pub fn sources(&self) -> Sources<'_, f32> {
        Sources {
            nodes: &self.nodes,
            edges: &self.edges,
            patches: &self.patches,
        }
    }
}

/// Middle of the box around the nodes.
fn middle(nodes: &[[f64; 4]]) -> [f64; 3] {
    let ends = |i: usize| {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) =
            (nodes.iter()).fold(ends, |(low, high), p| (low.min(p[i]), high.max(p[i])));
        if low <= high { 0.5 * (low + high) } else { 0.0 }
    };
    [ends(0), ends(1), ends(2)]
}
