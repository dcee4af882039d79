//! The sources in single precision, for sums whose tolerance allows it: twice the lanes to a vector.
//!
//! Digits are lost where places are subtracted. So nodes are measured from the centre of their cluster,
//! some hundred edges that are neighbours, in units of the root mean square length of the edges: what is near
//! keeps its digits wherever the wake has gone, and powers of lengths stay far from the ends of the range.

use crate::cores::CoreModel;
use crate::direct::packed::{Packed, PackedEdge, Patch, Sources, WINDOW};
use glam::DVec3;
use std::ops::Range;

/// The tolerance from which single precision serves: its error is some 1e-6 of the velocity.
pub(crate) const SINGLE: f64 = 1e-5;

/// Patches of a cluster of the direct sum: some 250 edges of a sheet.
pub(crate) const CLUSTER: usize = 16;

/// The part of l^2 below which t^2 - l^2 loses more than a digit.
const CLOSE: f32 = 0.1;

/// Largest number passed on: its square root times itself is still a number.
const LARGEST: f64 = 1e30;

/// An edge of algebraic cores, by its moments about the middle of its patch ([`crate::direct::moments`]).
#[derive(Clone, Copy, Debug)]
pub(crate) struct MomentEdge {
    /// Places of its nodes in the window.
    pub ends: [u32; 2],
    /// Squared length.
    pub l2: f32,
    /// Gamma / (2 pi) times the vector l from its first node to its second one.
    pub vorticity: [f32; 3],
    /// Gamma / (2 pi) times l x r, r from the middle of the patch to its first node.
    pub moment: [f32; 3],
}

/// All sources, the patches those of a [`Packed`].
#[derive(Clone, Debug, Default)]
pub(crate) struct Single {
    pub nodes: Vec<[f32; 4]>,
    /// Edges of all cores but algebraic ones.
    edges: Vec<PackedEdge<f32>>,
    /// Edges of algebraic cores.
    pub moment_edges: Vec<MomentEdge>,
    /// Middles of the patches of those, from the centre of the cluster.
    pub middles: Vec<[f32; 3]>,
    pub patches: Vec<Patch>,
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
        self.clusters.clear();
        self.clusters.extend(clusters);
        self.load_clusters(model, packed);
    }

    /// The same by the clusters that are there.
    pub fn load_clusters(&mut self, model: CoreModel, packed: &Packed) {
        let l2: f64 = packed.edges.iter().map(|e| e.l2).sum();
        let mean = (l2 / packed.edges.len().max(1) as f64).sqrt();
        self.per_unit = if mean > 0.0 { mean.recip() } else { 1.0 };
        self.patches.clone_from(&packed.patches);
        self.centres.clear();
        self.nodes.clear();
        self.moment_edges.clear();
        self.middles.clear();
        let is_soft = matches!(model, CoreModel::Algebraic { .. });
        for k in 0..self.clusters.len() {
            let cluster = &self.clusters[k];
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
            if is_soft {
                self.add_moment_edges(packed, patches, centre);
            }
        }
        self.edges.clear();
        if !is_soft {
            self.add_edges(model, packed);
        }
    }

    fn add_edges(&mut self, model: CoreModel, packed: &Packed) {
        let unit = self.unit_of_term(model);
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

impl Single {
    /// Appends the edges of a cluster of patches, each measured from the middle of its patch; nodes are measured from
    /// `centre` \[m\].
    fn add_moment_edges(&mut self, packed: &Packed, patches: &[Patch], centre: [f64; 3]) {
        let (centre, per_unit) = (DVec3::from(centre), self.per_unit);
        for patch in patches {
            // A place in the window is the number of a node modulo its size.
            let newest = patch.nodes.end.wrapping_sub(1);
            let node = |place: u32| {
                let back = newest.wrapping_sub(place as usize) % WINDOW;
                (DVec3::from_slice(&packed.nodes[newest - back]) - centre) * per_unit
            };
            let edges = &packed.edges[patch.edges.clone()];
            let ends = || edges.iter().flat_map(|e| [node(e.from), node(e.to)]);
            let low = ends().fold(DVec3::INFINITY, DVec3::min);
            let high = ends().fold(DVec3::NEG_INFINITY, DVec3::max);
            let middle = match edges.is_empty() {
                true => glam::Vec3::ZERO,
                false => (0.5 * (low + high)).as_vec3(),
            };
            self.middles.push(middle.into());
            self.moment_edges.extend(edges.iter().map(|e| {
                let (a, b) = (node(e.from), node(e.to));
                let (l, strength) = (b - a, e.strength * per_unit);
                MomentEdge {
                    ends: [e.from, e.to],
                    l2: (e.l2 * per_unit * per_unit) as f32,
                    vorticity: (strength * l).as_vec3().into(),
                    moment: (strength * l.cross(a - middle.as_dvec3())).as_vec3().into(),
                }
            }));
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
