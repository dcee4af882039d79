//! Self-influence: what a surface does to itself, computed once from its shape at rest.
//!
//! Normal velocities do not change when a surface moves and turns as a whole. So as long as it has the shape it has
//! at rest, the influence of its rings on its own control points is known. The inverses of these blocks, one for
//! each surface, are together near the inverse of the whole matrix, for surfaces act less on each other than on
//! themselves; deformed ones too. Where factors of the whole would take long, a few iterations with them do instead.

use crate::lattice::{Identity, Lattice};
use crate::solve::row_blocks::RowBlocks;
use crate::solve::unknowns::{add_part, columns, is_computed, unknown, unknowns};
use std::ops::Range;
use wingbeat_math::{DMat3, DVec3, DenseLu};
use wingbeat_vortex::{BLOCK, Network, UnitEdges};

/// Unknowns from which it pays: below, factors take less time than iterations.
const LARGE: usize = 256;

/// How far a node of a surface of known shape may be from where it belongs, relative to the size of the
/// surface: far above round-off, and far too little for any effect.
const TOLERANCE: f64 = 1e-10;

/// What one surface does to itself.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SelfInfluence {
    pub surface: usize,
    shape: RestShape,
    /// Its unknowns among all.
    pub unknowns: Range<usize>,
    /// Normal velocity at its control points of the rings of its unknowns: ring after ring.
    rings: Vec<f64>,
    /// The same of its edges that shed.
    shedding: Vec<f64>,
    /// The numbers of these edges among all.
    edges: Vec<usize>,
    /// Inverse of its block of the influence matrix, if nothing shed stayed at the edges.
    pub inverse: RowBlocks,
}

/// The surfaces of a lattice that have a known shape, computed when the lattice is first met.
#[derive(Debug, Default)]
pub(crate) struct KnownShapes {
    lattice: Option<Identity>,
    surfaces: Vec<SelfInfluence>,
}

impl KnownShapes {
    /// Makes it those of this lattice.
    pub fn update(&mut self, lattice: &Lattice) {
        let is_known = |known: &Identity| known.is(lattice.identity());
        if !self.lattice.as_ref().is_some_and(is_known) {
            self.surfaces = known_shapes(lattice);
            self.lattice = Some(lattice.identity().clone());
        }
    }

    /// In the order of their unknowns.
    pub fn surfaces(&self) -> &[SelfInfluence] {
        &self.surfaces
    }
}

/// All surfaces of known shape, if the lattice is large enough.
fn known_shapes(lattice: &Lattice) -> Vec<SelfInfluence> {
    if unknowns(lattice) < LARGE {
        return Vec::new();
    }
    let mut rest = Vec::with_capacity(lattice.node_count());
    for surface in lattice.surfaces() {
        match &surface.rest {
            Some(nodes) => rest.extend_from_slice(nodes),
            None => rest.resize(rest.len() + surface.node_count, DVec3::ZERO),
        }
    }
    let mut nodes = rest.clone();
    for (n, d) in lattice.rings().offsets(&rest, &rest) {
        nodes[n] += d;
    }
    let known = |s: usize| SelfInfluence::new(lattice, s, &rest[lattice.nodes_of(s)], &nodes);
    (0..lattice.surfaces().len()).filter_map(known).collect()
}

/// Control point and unit normal of panel `p`; none without area.
fn point_and_normal(lattice: &Lattice, p: usize, nodes: &[DVec3]) -> Option<[DVec3; 2]> {
    let (controls, corners) = (lattice.controls(), &lattice.topology().panels[p]);
    let point = controls.point(p, corners, &corners.map(|n| nodes[n]));
    Some([point, controls.normal(p, corners, nodes)?])
}

impl SelfInfluence {
    /// Surface `s` with its nodes at `rest`; all nodes of the rings are at `nodes`. None if there is nothing to
    /// know: no shape, no unknowns, edges shared with another surface, rings that cannot be.
    fn new(lattice: &Lattice, s: usize, rest: &[DVec3], nodes: &[DVec3]) -> Option<Self> {
        let (topology, panels) = (lattice.topology(), lattice.panels_of(s));
        let is_mine = |node: &usize| lattice.nodes_of(s).contains(node);
        let is_joined = topology.joined_nodes.iter().flatten().any(is_mine);
        if lattice.surfaces()[s].rest.is_none() || is_joined {
            return None;
        }
        let computed = || panels.clone().filter(|&p| is_computed(lattice, p));
        let first = unknown(lattice, computed().next()?);
        let points = computed()
            .map(|p| point_and_normal(lattice, p, nodes))
            .collect::<Option<Vec<_>>>()?;
        let mut new = Self {
            surface: s,
            shape: RestShape::new(rest)?,
            unknowns: first..first + points.len(),
            rings: Vec::new(),
            shedding: Vec::new(),
            edges: Vec::new(),
            inverse: RowBlocks::default(),
        };
        new.compute(lattice, &points, nodes);
        new.invert(lattice)?;
        Some(new)
    }

    /// Rings and shedding edges at these control points.
    fn compute(&mut self, lattice: &Lattice, points: &[[DVec3; 2]], nodes: &[DVec3]) {
        let (topology, model) = (lattice.topology(), lattice.settings().bound_core);
        let is_mine = |e: &usize| topology.panel_surface[topology.edges[*e].plus] == self.surface;
        let edges: Vec<usize> = (0..topology.edges.len()).filter(is_mine).collect();
        let mut network = Network {
            nodes: nodes.iter().copied().collect(),
            ..Network::default()
        };
        for edge in edges.iter().map(|&e| &topology.edges[e]) {
            let length = nodes[edge.from].distance(nodes[edge.to]);
            network.push_edge(edge.from, edge.to, 0.0, model.core(length, 0.0));
        }
        let sheds = |e: &usize| topology.edges[*e].wake.is_some();
        self.edges = edges.iter().copied().filter(sheds).collect();
        let rows = points.len();
        self.rings = vec![0.0; rows * rows];
        self.shedding = vec![0.0; self.edges.len() * rows];
        let mut unit = UnitEdges::default();
        unit.load(model, &network, std::iter::once(0..edges.len()));
        let mut rates = vec![0.0; edges.len() * BLOCK];
        for (b, points) in points.chunks(BLOCK).enumerate() {
            unit.normal_velocities(0, points.iter().copied(), &mut rates);
            let here = |column: usize| {
                let from = column * rows + b * BLOCK;
                from..from + points.len()
            };
            let mut shed = 0;
            for (&e, rates) in edges.iter().zip(rates.as_chunks::<BLOCK>().0) {
                let (edge, rates) = (&topology.edges[e], &rates[..points.len()]);
                for (unknown, part) in columns(lattice, edge, 1.0) {
                    add_part(
                        &mut self.rings[here(unknown - self.unknowns.start)],
                        part,
                        rates,
                    );
                }
                if edge.wake.is_some() {
                    self.shedding[here(shed)].copy_from_slice(rates);
                    shed += 1;
                }
            }
        }
    }

    /// None if there is no inverse.
    fn invert(&mut self, lattice: &Lattice) -> Option<()> {
        let n = self.unknowns.len();
        let mut block = RowBlocks::from_columns(n, &self.rings);
        if lattice.surfaces()[self.surface].closed {
            augment(lattice, self.surface, self.unknowns.start, &mut block);
        }
        let (mut lu, mut rows, mut columns) = (DenseLu::new(n), Vec::new(), Vec::new());
        block.to_rows(&mut rows);
        lu.factor(&rows).ok()?;
        lu.inverse(&mut columns);
        self.inverse = RowBlocks::from_columns(n, &columns);
        Some(())
    }

    /// Whether the surface has the shape it has at rest, all nodes being at `nodes`.
    pub fn is_at_rest(&self, lattice: &Lattice, nodes: &[DVec3]) -> bool {
        self.shape.is(&nodes[lattice.nodes_of(self.surface)])
    }

    /// Adds the influence on the unknowns `rows`, of one block, to the block's columns. Edges that shed keep the part
    /// `keeps` of the circulation of their panel.
    pub fn add(&self, lattice: &Lattice, keeps: &[f64], rows: Range<usize>, block: &mut [f64]) {
        let n = self.unknowns.len();
        let lane = rows.start % BLOCK;
        let first = rows.start - self.unknowns.start;
        let mut add = |unknown: usize, part: f64, rates: &[f64]| {
            let from = unknown * BLOCK + lane;
            add_part(&mut block[from..from + rows.len()], part, &rates[first..]);
        };
        for (unknown, rates) in self.unknowns.clone().zip(self.rings.chunks(n)) {
            add(unknown, 1.0, rates);
        }
        for (&e, rates) in self.edges.iter().zip(self.shedding.chunks(n)) {
            let plus = lattice.topology().edges[e].plus;
            add(unknown(lattice, plus), keeps[e] - 1.0, rates);
        }
    }
}

/// Adds `alpha` to all entries of the block of a closed surface, see [`crate::solve::influence::Influence`],
/// whose unknowns begin at `first`; returns it.
pub(crate) fn augment(lattice: &Lattice, s: usize, first: usize, block: &mut RowBlocks) -> f64 {
    let panels = lattice.panels_of(s);
    let at = |p: usize| unknown(lattice, p) - first;
    let size = (panels.len() * panels.len()) as f64;
    let diagonal: f64 = panels
        .clone()
        .map(|p| block.entry(at(p), at(p)).abs())
        .sum();
    let alpha = diagonal / size;
    for i in panels.clone().filter(|&p| is_computed(lattice, p)) {
        for j in panels.clone() {
            *block.entry(at(i), at(j)) += alpha;
        }
    }
    alpha
}

/// Positions of nodes relative to each other.
#[derive(Clone, Debug, PartialEq)]
struct RestShape {
    /// Three nodes far apart: origin, along the first axis, in the plane of the first and second.
    base: [usize; 3],
    /// All nodes in these axes [m].
    nodes: Vec<DVec3>,
    size: f64,
}

impl RestShape {
    /// None if all nodes are on one line.
    fn new(nodes: &[DVec3]) -> Option<Self> {
        let farthest = |from: &dyn Fn(DVec3) -> f64| {
            let by = |a: &usize, b: &usize| from(nodes[*a]).total_cmp(&from(nodes[*b]));
            (0..nodes.len()).max_by(by)
        };
        let b = farthest(&|x| x.distance(nodes[0]))?;
        let along = (nodes[b] - nodes[0]).try_normalize()?;
        let c = farthest(&|x| (x - nodes[0]).cross(along).length())?;
        let base = [0, b, c];
        let axes = axes(base, nodes)?.transpose();
        Some(Self {
            base,
            nodes: nodes.iter().map(|&x| axes * (x - nodes[0])).collect(),
            size: nodes[b].distance(nodes[0]),
        })
    }

    fn is(&self, nodes: &[DVec3]) -> bool {
        let near = |axes: DMat3| {
            let position = |x: &DVec3| nodes[self.base[0]] + axes * *x;
            let mut pairs = nodes.iter().zip(&self.nodes);
            pairs.all(|(x, local)| x.distance(position(local)) <= TOLERANCE * self.size)
        };
        axes(self.base, nodes).is_some_and(near)
    }
}

/// The axes of three nodes, as columns.
fn axes([a, b, c]: [usize; 3], nodes: &[DVec3]) -> Option<DMat3> {
    let x = (nodes[b] - nodes[a]).try_normalize()?;
    let z = x.cross(nodes[c] - nodes[a]).try_normalize()?;
    Some(DMat3::from_cols(x, z.cross(x), z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AirLoads, AirSettings, NodeMotion, Surface};
    use wingbeat_math::{r1, r3};

    const ROWS: usize = 16;
    const COLUMNS: usize = 17; // blocks of rows that belong to both wings

    fn wing() -> Vec<DVec3> {
        let at = |k: usize| [k / (COLUMNS + 1), k % (COLUMNS + 1)].map(|i| i as f64);
        // Panels of one length along the chord: control points are the same without a shape at rest.
        let place =
            |[i, j]: [f64; 2]| DVec3::new(0.1 * i + 0.03 * j.cos(), 0.2 * j, 0.02 * j.sin());
        (0..(ROWS + 1) * (COLUMNS + 1))
            .map(|k| place(at(k)))
            .collect()
    }

    struct Seen {
        rows: Vec<f64>,
        at_rest: Vec<bool>,
        has_factors: bool,
    }

    /// The influence of two wings above each other.
    fn influence(rest: bool, bend: f64) -> Seen {
        let wings = ["upper", "lower"].map(|name| {
            let wing_surface = Surface::grid(name, ROWS, COLUMNS);
            if rest {
                wing_surface.with_rest(wing())
            } else {
                wing_surface
            }
        });
        let settings = AirSettings::accurate(1.0, DVec3::X);
        let lattice = Lattice::new(wings.to_vec(), settings).unwrap();
        let turn = r3(0.4) * r1(-1.1);
        let mut motion = NodeMotion::default();
        for (shift, bend) in [(0.0, bend), (0.7, 0.0)] {
            let bent = |x: DVec3| x + bend * x.y.powi(2) * DVec3::Z;
            let at = |x: DVec3| turn * bent(x) + DVec3::new(9.0, -5.0, shift);
            motion.position.extend(wing().into_iter().map(at));
        }
        motion.velocity.resize(motion.position.len(), DVec3::ZERO);
        let (mut state, mut ws) = (lattice.initial_state(&motion), lattice.workspace());
        let mut loads = AirLoads::default();
        for step in 0..2 {
            lattice
                .loads(&state, 0.1 * step as f64, 0.1, &motion, &mut ws, &mut loads)
                .unwrap();
            lattice.accept(&mut state, &motion, &loads).unwrap();
            lattice.convect(&mut state, 0.1, &mut ws).unwrap();
        }
        let mut rows = Vec::new();
        ws.boundary.influence.matrix().to_rows(&mut rows);
        Seen {
            rows,
            at_rest: ws.boundary.influence.at_rest().to_vec(),
            has_factors: ws.boundary.influence.circulation().has_factors(),
        }
    }

    #[test]
    fn exact_influence_is_that_of_the_surface_wherever_it_is() {
        let n = 2 * ROWS * COLUMNS;
        let cases = [
            (0.0, vec![true, true]),
            (1e-6, vec![false, true]),
            (-0.1, vec![false, true]),
        ];
        for (bend, known) in cases {
            let [without, with] = [false, true].map(|rest| influence(rest, bend));
            assert!(without.at_rest.is_empty() && with.at_rest == known);
            assert!(without.has_factors && !with.has_factors, "{bend}");
            let largest = without.rows.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
            for (k, (a, b)) in without.rows.iter().zip(&with.rows).enumerate() {
                // Roundings of places 10 from the origin, over panels of 0.1.
                let error = (a - b).abs();
                assert!(error < 1e-11 * largest, "({}, {}): {a} {b}", k / n, k % n);
            }
        }
    }
}
