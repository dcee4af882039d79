//! Which filaments are wide: what the sum costs decides.

use crate::multilevel::gaussians::{count, gaussian};
use crate::multilevel::mesh::nodes_along;

/// What a node, and a filament or target at one Gaussian cost, in pairs of filament and target summed one by
/// one; measured.
const NODE: f64 = 450.0;
const SPREAD: f64 = 500.0;
const READ: f64 = 250.0;

/// The same of a pair of narrow ones.
const NEAR: f64 = 1.1;

/// Targets of a source: in a wake its nodes and the middles of its filaments.
const TARGETS: f64 = 1.5;

/// Nodes of all meshes for each source, at most, and in any case: memory.
const NODES: f64 = 150.0;
pub(super) const MOST_NODES: f64 = 3e6;

/// Standard deviation of a Gaussian over the distance of its nodes, and how far its stencil reaches: the first
/// ones, whose mesh has the most nodes, are coarser, for only the cores of the narrowest see them whole.
pub(super) const FINENESS: [(f64, usize); 3] = [(1.2, 4), (1.7, 6), (2.4, 8)];

/// Fineness of Gaussian number k.
pub(super) fn fineness(k: usize) -> usize {
    k.min(FINENESS.len() - 1)
}

/// Distance of the nodes for an exponent.
pub(super) fn spacing(k: usize, exponent: f64) -> f64 {
    1.0 / (FINENESS[fineness(k)].0 * (2.0 * exponent).sqrt())
}

/// Nodes of all meshes in a box of these sides for distances whose square is from `least` to `most`.
pub(super) fn nodes(sides: [f64; 3], least: f64, most: f64) -> f64 {
    let count = count(most / least);
    let of = |k: usize| {
        let spacing = spacing(k, gaussian(k, count, least)[0]);
        sides
            .map(|side| nodes_along(side, spacing))
            .iter()
            .product::<f64>()
    };
    (0..count).map(of).sum()
}

/// The softening from which sources are wide, and what a sum then costs for each target, in pairs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    pub least: f64,
    pub cost: f64,
}

impl Plan {
    /// The cheapest one for sources with these softenings, in rising order, in a box of these sides; None if
    /// memory forbids all of them.
    pub fn cheapest(softenings: &[f64], sides: [f64; 3]) -> Option<Self> {
        const PARTS: usize = 32;
        let sources = softenings.len();
        let widest = *softenings.last()?;
        let square: f64 = sides.iter().map(|side| side * side).sum();
        let plan = |part: usize| {
            let narrow = part * sources / PARTS;
            let least = softenings[narrow];
            let most = square + 2.0 * widest;
            let is_sound = least > 0.0 && (most / least).is_finite() && square.is_finite();
            if !is_sound {
                return None;
            }
            let nodes = nodes(sides, least, most);
            let (narrow, sources) = (narrow as f64, sources as f64);
            let each = (SPREAD + TARGETS * READ) * count(most / least) as f64 * sources;
            let cost = NEAR * TARGETS * narrow * narrow + NODE * nodes + each;
            let is_small = nodes <= (NODES * sources).min(MOST_NODES);
            is_small.then_some(Self {
                least,
                cost: cost / (TARGETS * sources),
            })
        };
        let plans = (0..PARTS).filter_map(plan);
        plans.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }
}
