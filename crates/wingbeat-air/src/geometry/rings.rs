//! Where the rings lie: on the panels' edges, or a little inside edges that do not shed and aft.
//!
//! A lattice represents a sheet a quarter panel larger on every free side than its outermost
//! filaments [Hough 1973, J. Aircraft 10:314]: rings on the true edges overrate lift slope and added
//! mass at first order of the panel size, rings inset by a quarter panel are good to second. Control
//! point, normal and area of a panel are those of its ring.

use crate::edges::EdgeKind;
use crate::geometry::aft::{Aft, nodes_of_strips};
use crate::geometry::control::{has_cosine_columns, has_cosine_rows};
use crate::geometry::node_motion::NodeMotion;
use crate::geometry::strips::Strip;
use crate::geometry::surface::Surface;
use crate::geometry::topology::{Topology, edge_kinds};
use crate::settings::AirSettings;
use std::collections::BTreeSet;
use wingbeat_math::DVec3;

/// A ring node lies off its surface node, towards the node `to`, by a part of the way (away from it if
/// negative).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Offset {
    node: usize,
    to: usize,
    part: f64,
}

/// Where the rings lie.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Rings {
    offsets: Vec<Offset>,
    /// Nodes of the strips behind leading edges, and the part of a panel by which all lie aft.
    aft: Vec<Aft>,
    shift: f64,
}

/// Where the rings of the surfaces lie, whose strips these are. A lifting wing that sheds from its trailing
/// edge has all rings aft by the same part of a panel, vortices at a quarter and control points at three
/// quarters of each panel [Katz & Plotkin, Low-Speed Aerodynamics, sec. 12.3]. Without it the lattice is that
/// of a wing a quarter panel ahead.
pub(crate) fn rings(
    topology: &Topology,
    surfaces: &[Surface],
    strips: &[Strip],
    settings: &AirSettings,
) -> Rings {
    let mut rings = Rings {
        aft: nodes_of_strips(strips),
        ..Rings::default()
    };
    if settings.inset > 0.0 {
        let reach = Reach::of_surfaces(topology, surfaces, strips, settings);
        inset(topology, (surfaces, &reach), settings, &mut rings);
        rings.shift = settings.ring_shift();
    }
    rings.offsets.sort_by_key(|o| o.node);
    rings
}

/// Side edges that do not shed: rings stay inside, but where a root lies on another one. So do those of roots on bodies, which are no free edges
/// (docs/wings-on-bodies.md, "Wings on a body").
fn inset(
    topology: &Topology,
    (surfaces, reach): (&[Surface], &[Reach]),
    settings: &AirSettings,
    rings: &mut Rings,
) {
    let kinds = edge_kinds(topology, surfaces);
    let mut found = BTreeSet::new();
    for edge in &topology.edges {
        let s = topology.panel_surface[edge.plus];
        let pair = [edge.from.min(edge.to), edge.from.max(edge.to)];
        let kept = match kinds.get(&pair) {
            Some(EdgeKind::Leading) => settings.shedding.trailing || reach[s].edges,
            Some(EdgeKind::Trailing) => reach[s].edges,
            Some(EdgeKind::Root) => reach[s].tips || surfaces[s].reaches_root,
            Some(EdgeKind::Tip) => reach[s].tips,
            _ => false,
        };
        // Plane flow has no side edges, however many columns reach from end to end.
        let kept = kept || edge.is_end;
        if edge.minus.is_some() || edge.wake.is_some() || kept || surfaces[s].closed {
            continue;
        }
        let c = topology.panels[edge.plus];
        for i in 0..4 {
            let side = [c[i], c[(i + 1) % 4]];
            let inward = [c[(i + 3) % 4], c[(i + 2) % 4]];
            let is_here = [side[0].min(side[1]), side[0].max(side[1])] == pair;
            // Not where a single panel reaches from edge to edge.
            if is_here && !is_free(topology, edge.plus, inward) {
                let ends = side.into_iter().zip(inward);
                found.extend(ends.filter(|(_, inward)| !side.contains(inward)));
            }
        }
    }
    let part = settings.inset;
    (rings.offsets).extend(
        found
            .into_iter()
            .map(|(node, to)| Offset { node, to, part }),
    );
}

/// Which side edges of a surface its rings reach that shed nothing: those across spacing by the cosine.
struct Reach {
    tips: bool,
    /// Leading and trailing edges.
    edges: bool,
}

impl Reach {
    fn of_surfaces(
        topology: &Topology,
        surfaces: &[Surface],
        strips: &[Strip],
        settings: &AirSettings,
    ) -> Vec<Self> {
        let of = |s: usize| {
            let is_here = |strip: &&Strip| topology.panel_surface[strip.panels[0]] == s;
            let columns = || strips.iter().filter(is_here);
            let on_surface = (&surfaces[s], topology.first_node[s]);
            Self {
                tips: has_cosine_columns(&surfaces[s], columns().count(), settings),
                edges: has_cosine_rows(columns(), on_surface, settings),
            }
        };
        (0..surfaces.len()).map(of).collect()
    }
}

/// Whether the edge of `panel` between these nodes is its surface's border.
fn is_free(topology: &Topology, panel: usize, [a, b]: [usize; 2]) -> bool {
    topology.panel_edges[panel].iter().any(|e| {
        let edge = &topology.edges[e.edge];
        let same = [edge.from, edge.to] == [a, b] || [edge.to, edge.from] == [a, b];
        same && edge.minus.is_none()
    })
}

impl Rings {
    /// What takes positions of nodes, or their velocities `of`, from the surfaces to the rings: (node, difference).
    pub(crate) fn offsets<'a>(
        &'a self,
        position: &'a [DVec3],
        of: &'a [DVec3],
    ) -> impl Iterator<Item = (usize, DVec3)> + 'a {
        let offset = |o: &Offset| (o.node, o.part * (of[o.to] - of[o.node]));
        let shift = |a: &Aft| (a.node, self.shift * a.way(position, of));
        let shifted = self.aft.iter().filter(|_| self.shift > 0.0);
        self.offsets.iter().map(offset).chain(shifted.map(shift))
    }

    /// What a force on ring node `n` does to the nodes of the surface, which are at `position`:
    /// [`Self::place`], transposed.
    pub(crate) fn spread(
        &self,
        (n, position): (usize, &[DVec3]),
        force: DVec3,
        mut add: impl FnMut(usize, DVec3),
    ) {
        add(n, force);
        let first = self.offsets.partition_point(|o| o.node < n);
        for o in self.offsets[first..].iter().take_while(|o| o.node == n) {
            add(o.node, -o.part * force);
            add(o.to, o.part * force);
        }
        if self.shift > 0.0
            && let Ok(k) = self.aft.binary_search_by_key(&n, |a| a.node)
        {
            self.aft[k].spread(position, self.shift * force, add);
        }
    }

    /// Nodes of the strips behind leading edges.
    pub(crate) fn aft(&self) -> &[Aft] {
        &self.aft
    }

    /// Nodes of the rings from those of the surfaces.
    pub(crate) fn place(&self, motion: &NodeMotion, rings: &mut NodeMotion) {
        rings.position.clone_from(&motion.position);
        rings.velocity.clone_from(&motion.velocity);
        for (n, d) in self.offsets(&motion.position, &motion.position) {
            rings.position[n] += d;
        }
        for (n, d) in self.offsets(&motion.position, &motion.velocity) {
            rings.velocity[n] += d;
        }
    }
}
