//! Vortex filaments: networks of segments that share nodes.

use crate::sources::points::Points;
use glam::DVec3;

/// Vortex segments between shared nodes, as in a lattice or a wake sheet.
///
/// Distances to a node serve every segment that meets there, so that they are summed about twice as
/// fast as with nodes of their own, with the same bits if the order is the same. Neighbours in space
/// should be neighbours in the edge order (row by row of a sheet).
#[derive(Debug, Default, PartialEq)]
pub struct Network {
    /// Nodes \[m\].
    pub nodes: Points,
    /// Node pairs (from, to).
    pub edges: Vec<[u32; 2]>,
    /// Circulation of each edge \[m^2/s\].
    pub gamma: Vec<f64>,
    /// Regularisation number of each edge, [`crate::CoreModel::core`].
    pub core: Vec<f64>,
}

impl Network {
    /// Whether this is `other` but for the core radii of its nodes, which differ by no more than `near` \[m\].
    pub fn is_near(&self, other: &Self, near: f64) -> bool {
        self.edges == other.edges
            && self.gamma == other.gamma
            && self.core == other.core
            && self.nodes.has_places_of(&other.nodes)
            && self.nodes.has_cores_near(&other.nodes, near)
    }

    /// Appends nodes and edges of `other`; either both have cores at their nodes, or none.
    pub fn append(&mut self, other: &Self) {
        let first = self.nodes.len() as u32;
        self.nodes.append(&other.nodes);
        let edges = other.edges.iter().map(|edge| edge.map(|n| first + n));
        self.edges.extend(edges);
        self.gamma.extend_from_slice(&other.gamma);
        self.core.extend_from_slice(&other.core);
    }

    /// Number of edges.
    pub fn len(&self) -> usize {
        self.edges.len()
    }

    /// True when there is no edge.
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    /// Removes all nodes and edges and keeps the memory.
    pub fn clear(&mut self) {
        self.nodes.clear();
        self.edges.clear();
        self.gamma.clear();
        self.core.clear();
    }

    /// Appends an edge between two nodes that exist already.
    pub fn push_edge(&mut self, from: usize, to: usize, gamma: f64, core: f64) {
        assert!(
            from.max(to) < self.nodes.len(),
            "edge {from}-{to} beyond {} nodes",
            self.nodes.len()
        );
        self.edges.push([from as u32, to as u32]);
        self.gamma.push(gamma);
        self.core.push(core);
    }

    /// Appends an edge from `a` to `b` \[m\] with nodes of its own.
    pub fn push_segment(&mut self, a: DVec3, b: DVec3, gamma: f64, core: f64) {
        let first = self.nodes.len();
        self.nodes.push(a);
        self.nodes.push(b);
        self.push_edge(first, first + 1, gamma, core);
    }

    /// Start and end of edge `e` \[m\].
    pub fn ends(&self, e: usize) -> (DVec3, DVec3) {
        let [i, j] = self.edges[e];
        (self.nodes.get(i as usize), self.nodes.get(j as usize))
    }
}

impl Clone for Network {
    fn clone(&self) -> Self {
        Self {
            nodes: self.nodes.clone(),
            edges: self.edges.clone(),
            gamma: self.gamma.clone(),
            core: self.core.clone(),
        }
    }

    /// Keeps the memory.
    fn clone_from(&mut self, other: &Self) {
        self.nodes.clone_from(&other.nodes);
        self.edges.clone_from(&other.edges);
        self.gamma.clone_from(&other.gamma);
        self.core.clone_from(&other.core);
    }
}
