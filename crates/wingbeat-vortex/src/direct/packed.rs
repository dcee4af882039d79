//! The sources as the vector loop eats them: a stream of "look at these nodes, sum these edges".
//!
//! The loop keeps the last [`WINDOW`] nodes it looked at (vector to the targets and its length) in
//! the first-level cache. An edge whose nodes are still there costs no square root, so a sheet given
//! row by row pays one for two edges.

use crate::cores::CoreModel;
use crate::cores::INV_4PI;
use crate::direct::reference::CLOSE;
use crate::sources::Network;
use glam::DVec3;
use std::ops::Range;

/// Nodes kept in sight; four vectors of eight lanes each make 32 KiB.
pub const WINDOW: usize = 128;

/// New nodes after which a patch ends; the last edge may add one more.
const PATCH_NODES: usize = 8;

/// How far back an edge may look: the nodes of the next patch come into the window before the edges of
/// this one are done.
const SIGHT: usize = WINDOW - (PATCH_NODES + 1);

/// An edge between two nodes in the window.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PackedEdge<E> {
    /// Place of its first node in the window.
    pub from: u32,
    /// Place of its second node in the window.
    pub to: u32,
    /// Gamma / (2 pi) [m^2/s].
    pub strength: E,
    /// Squared length [m^2].
    pub l2: E,
    /// t^2 - l^2 below this is too small a difference of large numbers [m^2].
    pub close: E,
    /// [`CoreModel::kernel_term`].
    pub term: E,
}

/// A run of nodes to look at, then a run of edges to sum. Node k stands at place k mod [`WINDOW`].
#[derive(Clone, Debug)]
pub(crate) struct Patch {
    /// Its new nodes in [`Packed::nodes`].
    pub nodes: Range<usize>,
    /// Its edges in [`Packed::edges`].
    pub edges: Range<usize>,
    /// Oldest node its edges use.
    oldest: usize,
}

/// Nodes, edges between them, and the order to take them in.
#[derive(Clone, Copy)]
pub(crate) struct Sources<'a, E> {
    pub nodes: &'a [[E; 4]],
    pub edges: &'a [PackedEdge<E>],
    pub patches: &'a [Patch],
}

/// All sources; edges stay in the order given.
#[derive(Clone, Debug, Default)]
pub(crate) struct Packed {
    /// Places of nodes [m], and what softens them [m2], [`CoreModel::softening`].
    pub nodes: Vec<[f64; 4]>,
    pub edges: Vec<PackedEdge<f64>>,
    pub patches: Vec<Patch>,
    /// Node of the network -> where in `nodes` it was last put.
    last_seen: Vec<usize>,
    /// First node of the open group: a group of patches never leans on another one's nodes.
    group: usize,
}

impl Packed {
    /// Forgets all sources and keeps the memory; the next ones have `n` shared nodes.
    pub fn clear(&mut self, n: usize) {
        self.nodes.clear();
        self.edges.clear();
        self.patches.clear();
        self.last_seen.clear();
        self.last_seen.resize(n, usize::MAX);
    }

    /// What the loop takes.
    pub fn sources(&self) -> Sources<'_, f64> {
        Sources {
            nodes: &self.nodes,
            edges: &self.edges,
            patches: &self.patches,
        }
    }

    /// Takes a network: nodes in sight are used again.
    pub fn load_network(&mut self, model: CoreModel, network: &Network) {
        self.clear(network.nodes.len());
        self.load_group(model, network, 0..network.len() as u32);
    }

    /// The same without the edges that have no circulation.
    pub fn load_moving(&mut self, model: CoreModel, network: &Network) {
        self.clear(network.nodes.len());
        let moves = |&e: &u32| network.gamma[e as usize] != 0.0;
        let edges = (0..network.len() as u32).filter(moves);
        self.load_group(model, network, edges);
    }

    /// Appends these edges of the network, in this order; returns their patches, which can be summed
    /// without those before.
    pub fn load_group(
        &mut self,
        model: CoreModel,
        network: &Network,
        edges: impl IntoIterator<Item = u32>,
    ) -> Range<usize> {
        let first = self.patches.len();
        self.group = self.nodes.len();
        self.open_patch();
        for e in edges {
            let (e, ends) = (e as usize, network.edges[e as usize]);
            self.make_room(
                ends.iter()
                    .map(|&g| self.in_sight(g))
                    .min()
                    .expect("two ends"),
            );
            let places = ends.map(|g| self.place(model, network, (e, g)));
            self.add_edge(model, places, network.gamma[e], network.core[e]);
        }
        first..self.patches.len()
    }

    /// Where node `g` of the network is in `nodes` if an edge added now may use it, else the end.
    fn in_sight(&self, g: u32) -> usize {
        let (k, end) = (self.last_seen[g as usize], self.nodes.len());
        if k < end && k >= self.group && k + SIGHT >= end + 2 {
            k
        } else {
            end
        }
    }

    /// Where node `g` of edge `e` is, which is looked at now if it is not in sight.
    fn place(&mut self, model: CoreModel, network: &Network, (e, g): (usize, u32)) -> usize {
        let k = self.in_sight(g);
        if k < self.nodes.len() {
            return k;
        }
        self.last_seen[g as usize] = k;
        let softening = model.softening(network.core_at(e, g as usize));
        self.look_at(network.nodes.get(g as usize), softening)
    }

    /// Ends the patch if it is full, or if two more nodes would hide one that its edges, or an edge
    /// to come that uses node `k`, need.
    fn make_room(&mut self, k: usize) {
        let end = self.nodes.len();
        let patch = self.patches.last_mut().expect("a patch is open");
        patch.oldest = patch.oldest.min(k);
        if patch.nodes.len() >= PATCH_NODES || patch.oldest + SIGHT < end + 2 {
            self.open_patch();
            self.patches.last_mut().expect("just opened").oldest = k;
        }
    }

    fn open_patch(&mut self) {
        let (n, e) = (self.nodes.len(), self.edges.len());
        self.patches.push(Patch {
            nodes: n..n,
            edges: e..e,
            oldest: n,
        });
    }

    /// Puts a node at the end of the stream; returns where.
    fn look_at(&mut self, p: DVec3, softening: f64) -> usize {
        self.nodes.push([p.x, p.y, p.z, softening]);
        self.patches.last_mut().expect("a patch is open").nodes.end = self.nodes.len();
        self.nodes.len() - 1
    }

    fn add_edge(&mut self, model: CoreModel, [from, to]: [usize; 2], gamma: f64, core: f64) {
        let at = |k: usize| DVec3::from_slice(&self.nodes[k]);
        let r0 = at(to) - at(from);
        let l2 = r0.x * r0.x + r0.y * r0.y + r0.z * r0.z;
        let (strength, term) = (gamma * (2.0 * INV_4PI), model.kernel_term(core, l2));
        let [from, to] = [from, to].map(|k| (k % WINDOW) as u32);
        self.edges.push(PackedEdge {
            from,
            to,
            strength,
            l2,
            close: l2 * CLOSE,
            term,
        });
        self.patches.last_mut().expect("a patch is open").edges.end = self.edges.len();
    }
}
