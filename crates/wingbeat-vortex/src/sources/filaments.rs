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

    /// Regularisation number of edge `e` at its node `n`: that of the node, if nodes have one, or its own.
    pub(crate) fn core_at(&self, e: usize, n: usize) -> f64 {
        *self.nodes.core.get(n).unwrap_or(&self.core[e])
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A line of edges whose nodes have these core radii [m].
    fn line(radii: &[f64]) -> Network {
        let mut net = Network::default();
        for (k, radius) in radii.iter().enumerate() {
            net.nodes
                .push_with_core(k as f64 * DVec3::X, radius * radius);
        }
        (1..radii.len()).for_each(|k| net.push_edge(k - 1, k, k as f64, 0.5));
        net
    }

    #[test]
    fn exact_networks_after_each_other_keep_their_nodes_and_cores() {
        let (mut both, other) = (line(&[0.1, 0.2]), line(&[0.3, 0.4, 0.5]));
        both.append(&other);
        assert_eq!(both.edges, [[0, 1], [2, 3], [3, 4]]);
        assert_eq!(both.gamma, [1.0, 1.0, 2.0]);
        assert_eq!(both.ends(2), other.ends(1));
        assert_eq!(both.nodes.core[2..], other.nodes.core[..]);
        let mut none = Network::default();
        none.append(&other);
        assert_eq!(none, other);
    }

    #[test]
    #[cfg(debug_assertions)]
    #[should_panic(expected = "cores of some points")]
    fn refuses_networks_of_which_one_has_cores_at_its_nodes() {
        let mut bare = line(&[0.1, 0.2]);
        bare.nodes.core.clear();
        bare.append(&line(&[0.1, 0.2]));
    }

    #[test]
    fn exact_near_networks_differ_in_core_radii_alone() {
        let net = line(&[0.1, 0.2, 0.3]);
        let wider = line(&[0.1, 0.2, 0.3 + 1e-3]);
        assert!(net.is_near(&net, 0.0) && !net.is_near(&wider, 0.0));
        assert!(net.is_near(&wider, 2e-3) && !net.is_near(&wider, 5e-4));
        let mut moved = net.clone();
        moved.nodes.x[1] += 1e-12;
        assert!(!net.is_near(&moved, 1.0));
        assert!(!net.is_near(&line(&[0.1, 0.2]), 1.0));
    }
}
