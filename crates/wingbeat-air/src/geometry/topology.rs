//! What is joined to what: edges of the lattice, the panels they bound, the wakes they shed.

use crate::edges::EdgeKind;
use crate::geometry::surface::Surface;
use std::collections::BTreeMap;

/// One edge of the lattice: a straight vortex filament from node `from` to node `to`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// First node (global).
    pub from: usize,
    /// Second node (global).
    pub to: usize,
    /// The panel whose ring runs this edge from `from` to `to` (global).
    pub plus: usize,
    /// The panel whose ring runs it the other way, none at a free edge (global). On a plane of images it is the panel
    /// of `plus`: what lies behind the plane is that panel's image, which has the same circulation.
    pub minus: Option<usize>,
    /// The wake ring column it sheds into, if it sheds.
    pub wake: Option<WakeColumn>,
    /// Whether it is an end of a section of plane flow (`AirSettings::plane_wakes`), which moves no air.
    pub is_end: bool,
}

/// A column of a wake sheet, seen from the edge that sheds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WakeColumn {
    /// Wake sheet.
    pub sheet: usize,
    /// Column of rings.
    pub column: usize,
    /// Circulation of a shed ring = sign x circulation of the panel \[1\].
    pub sign: f64,
}

/// An unbroken run of shedding segments: the root of one wake sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Surface it leaves.
    pub surface: usize,
    /// Lattice nodes along the shedding edge (global), one more than columns.
    pub nodes: Vec<usize>,
    /// Shedding panel of each column (global).
    pub panels: Vec<usize>,
    /// Circulation of a shed ring = sign x circulation of the panel \[1\].
    pub signs: Vec<f64>,
    /// Kind of edge of each column.
    pub kinds: Vec<EdgeKind>,
}

impl Sheet {
    /// Whether it leaves its surface all around: it ends where it begins.
    pub(crate) fn is_closed(&self) -> bool {
        self.panels.len() > 2 && self.nodes.first() == self.nodes.last()
    }
}

/// One edge as a panel sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelEdge {
    /// Edge (global).
    pub edge: usize,
    /// +1 if the panel's ring runs the edge forward, -1 if backward \[1\].
    pub sign: f64,
}

/// Two columns of wake nodes that left one place: (sheet, column) of both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JoinedColumns(pub [(usize, usize); 2]);

/// Topology of all surfaces with global numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Topology {
    /// Corners of each panel (global nodes).
    pub panels: Vec<[usize; 4]>,
    /// Surface of each panel.
    pub panel_surface: Vec<usize>,
    /// First node of each surface, and the total at the end.
    pub first_node: Vec<usize>,
    /// First panel of each surface, and the total at the end.
    pub first_panel: Vec<usize>,
    /// All edges, each once.
    pub edges: Vec<Edge>,
    /// Edges of each panel; a triangle has three.
    pub panel_edges: Vec<Vec<PanelEdge>>,
    /// Wake sheets.
    pub sheets: Vec<Sheet>,
    /// Names of the surfaces.
    pub surface_names: Vec<String>,
    /// Pairs of nodes that are one, on joined surfaces (global).
    pub joined_nodes: Vec<[usize; 2]>,
    /// Columns of wake nodes that leave them.
    pub joined_columns: Vec<JoinedColumns>,
    /// Lines of nodes that lie on a plane of images, joined to their own mirror images there (global).
    pub plane_lines: Vec<Vec<usize>>,
    /// Columns of wake nodes that leave them: (sheet, column).
    pub plane_columns: Vec<(usize, usize)>,
}

impl Edge {
    /// Whether it lies on a plane of images, with its own panel's image behind it.
    pub(crate) fn is_on_plane(&self) -> bool {
        self.minus == Some(self.plus)
    }
}

impl Topology {
    /// Marks the ends of sections of plane flow, those free edges of open surfaces at tips and roots that shed
    /// nothing; `surfaces` are those of the topology.
    pub(crate) fn mark_ends(&mut self, surfaces: &[Surface]) {
        let kinds = edge_kinds(self, surfaces);
        for edge in &mut self.edges {
            let pair = [edge.from.min(edge.to), edge.from.max(edge.to)];
            let is_side = matches!(kinds.get(&pair), Some(EdgeKind::Tip | EdgeKind::Root));
            let is_free = edge.minus.is_none() && edge.wake.is_none();
            let is_open = !surfaces[self.panel_surface[edge.plus]].closed;
            edge.is_end = is_side && is_free && is_open;
        }
    }

    /// The surface of a node.
    pub(crate) fn surface_of(&self, node: usize) -> usize {
        self.first_node.partition_point(|&f| f <= node) - 1
    }

    /// Name of the surface of a node, and the node's number there.
    pub(crate) fn locate_node(&self, node: usize) -> (String, usize) {
        let s = self.surface_of(node);
        (self.surface_names[s].clone(), node - self.first_node[s])
    }

    /// Name of the surface of a panel, and the panel's number there.
    pub(crate) fn locate_panel(&self, panel: usize) -> (String, usize) {
        let s = self.panel_surface[panel];
        (self.surface_names[s].clone(), panel - self.first_panel[s])
    }
}

/// What the surfaces call their border edges (global nodes).
pub(crate) fn edge_kinds(
    topology: &Topology,
    surfaces: &[Surface],
) -> BTreeMap<[usize; 2], EdgeKind> {
    let mut kinds = BTreeMap::new();
    for (s, surface) in surfaces.iter().enumerate() {
        let offset = topology.first_node[s];
        for g in surface.shedding.iter().flatten() {
            let (a, b) = (g.from + offset, g.to + offset);
            kinds.insert([a.min(b), a.max(b)], g.kind);
        }
    }
    kinds
}
