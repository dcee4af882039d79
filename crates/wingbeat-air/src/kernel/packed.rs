//! Segments cut into patches that fit the first-level cache: the sources as the vector loop eats them.

use super::model::CoreModel;
use super::reference::STRENGTH;
use super::sources::{Network, Points, Segments};
use std::ops::Range;
use wingbeat_math::DVec3;

/// Most nodes of a patch; four vectors of eight lanes each make 32 KiB.
pub(crate) const PATCH_NODES: usize = 128;

/// An edge between two nodes of its patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PackedEdge {
    /// First node, counted in the patch.
    pub from: u32,
    /// Second node, counted in the patch.
    pub to: u32,
    /// Gamma / (4 pi) [m^2/s].
    pub strength: f64,
    /// [`CoreModel::kernel_term`].
    pub term: f64,
}

/// A run of edges and the nodes they use.
#[derive(Clone, Debug)]
pub(crate) struct Patch {
    /// Its nodes in [`Packed::nodes`].
    pub nodes: Range<usize>,
    /// Its edges in [`Packed::edges`].
    pub edges: Range<usize>,
}

/// All patches; edges stay in the order given.
#[derive(Clone, Debug, Default)]
pub(crate) struct Packed {
    pub nodes: Vec<DVec3>,
    pub edges: Vec<PackedEdge>,
    pub patches: Vec<Patch>,
    /// Global node -> (patch that holds it, index there); the first half of a network's node reuse.
    home: Vec<(u32, u32)>,
}

impl Packed {
    /// Forgets all sources and keeps the memory.
    pub fn clear(&mut self) {
        self.nodes.clear();
        self.edges.clear();
        self.patches.clear();
    }

    /// Takes free segments: two nodes each.
    pub fn load_segments(&mut self, model: CoreModel, s: &Segments) {
        self.clear();
        for first in (0..s.len()).step_by(PATCH_NODES / 2) {
            self.open_patch();
            for i in first..s.len().min(first + PATCH_NODES / 2) {
                let (from, to) = (self.add_node(s.a(i)), self.add_node(s.b(i)));
                self.add_edge(model, from, to, s.gamma[i], s.core[i]);
            }
        }
    }

    /// Takes a network: every node once per patch.
    pub fn load_network(&mut self, model: CoreModel, network: &Network) {
        self.clear();
        self.forget_homes(network.nodes.len());
        self.load_edges(model, network, 0..network.len() as u32);
    }

    /// Marks all of `n` global nodes as in no patch.
    pub fn forget_homes(&mut self, n: usize) {
        self.home.clear();
        self.home.resize(n, (u32::MAX, 0));
    }

    /// Appends these edges of a network, in this order, as new patches.
    pub fn load_edges(
        &mut self,
        model: CoreModel,
        network: &Network,
        edges: impl IntoIterator<Item = u32>,
    ) {
        self.open_patch();
        for e in edges {
            let e = e as usize;
            if self.patch_is_full() {
                self.open_patch();
            }
            let [a, b] = network.edges[e];
            let (from, to) = (self.adopt(&network.nodes, a), self.adopt(&network.nodes, b));
            self.add_edge(model, from, to, network.gamma[e], network.core[e]);
        }
    }

    fn open_patch(&mut self) {
        let (n, e) = (self.nodes.len(), self.edges.len());
        self.patches.push(Patch {
            nodes: n..n,
            edges: e..e,
        });
    }

    fn patch_is_full(&self) -> bool {
        self.patches
            .last()
            .is_some_and(|p| p.nodes.len() + 2 > PATCH_NODES)
    }

    /// Index of global node `g` in the open patch, which gets it if it has it not.
    fn adopt(&mut self, nodes: &Points, g: u32) -> u32 {
        let patch = self.patches.len() as u32 - 1;
        let (home, index) = self.home[g as usize];
        if home == patch {
            return index;
        }
        let index = self.add_node(nodes.get(g as usize));
        self.home[g as usize] = (patch, index);
        index
    }

    fn add_node(&mut self, p: DVec3) -> u32 {
        let patch = self.patches.last_mut().expect("a patch is open");
        let index = patch.nodes.len();
        assert!(index < PATCH_NODES, "patch overflows");
        self.nodes.push(p);
        patch.nodes.end += 1;
        index as u32
    }

    fn add_edge(&mut self, model: CoreModel, from: u32, to: u32, gamma: f64, core: f64) {
        let patch = self.patches.last_mut().expect("a patch is open");
        let first = patch.nodes.start;
        let r0 = self.nodes[first + to as usize] - self.nodes[first + from as usize];
        let l2 = r0.x * r0.x + r0.y * r0.y + r0.z * r0.z;
        let (strength, term) = (gamma * STRENGTH, model.kernel_term(core, l2));
        self.edges.push(PackedEdge {
            from,
            to,
            strength,
            term,
        });
        patch.edges.end += 1;
    }
}
