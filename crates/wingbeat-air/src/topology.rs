//! What is joined to what: edges of the lattice, the panels they bound, the wakes they shed.

use crate::error::AirError;
use crate::settings::SheddingKinds;
use crate::surface::{EdgeKind, SheddingSegment, Surface};
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
    /// The panel whose ring runs it the other way, none at a free edge (global).
    pub minus: Option<usize>,
    /// The wake ring column it sheds into, if it sheds.
    pub wake: Option<WakeColumn>,
}

/// A column of a wake sheet, seen from the edge that sheds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WakeColumn {
    /// Wake sheet.
    pub sheet: usize,
    /// Column of rings.
    pub column: usize,
    /// Circulation of a shed ring = sign x circulation of the panel.
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
    /// Circulation of a shed ring = sign x circulation of the panel.
    pub signs: Vec<f64>,
    /// Kind of edge of each column.
    pub kinds: Vec<EdgeKind>,
}

/// One edge as a panel sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelEdge {
    /// Edge (global).
    pub edge: usize,
    /// +1 if the panel's ring runs the edge forward, -1 if backward.
    pub sign: f64,
    /// Weight of the edge in the velocity jump: 1 at free edges, 1/2 at shared ones.
    pub weight: f64,
}

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
}

impl Topology {
    /// Joins the surfaces.
    ///
    /// # Errors
    /// [`AirError`] names the first panel, edge or shedding segment that fits nowhere.
    pub fn new(surfaces: &[Surface], kinds: SheddingKinds) -> Result<Self, AirError> {
        let mut t = Self {
            first_node: vec![0],
            first_panel: vec![0],
            ..Self::default()
        };
        for (s, surface) in surfaces.iter().enumerate() {
            t.add_panels(s, surface)?;
            let edges = t.add_edges(s, surface)?;
            t.add_sheets(s, surface, kinds, &edges)?;
        }
        if t.panels.is_empty() {
            return Err(AirError::Empty);
        }
        t.join_panels_to_edges();
        Ok(t)
    }

    fn add_panels(&mut self, s: usize, surface: &Surface) -> Result<(), AirError> {
        let offset = self.first_node[s];
        for (panel, corners) in surface.panels.iter().enumerate() {
            if let Some(&node) = corners.iter().find(|&&n| n >= surface.node_count) {
                return Err(AirError::NodeOutOfRange {
                    surface: surface.name.clone(),
                    panel,
                    node,
                    count: surface.node_count,
                });
            }
            self.panels.push(corners.map(|n| n + offset));
            self.panel_surface.push(s);
        }
        self.first_node.push(offset + surface.node_count);
        self.first_panel.push(self.panels.len());
        Ok(())
    }

    /// Finds the edges of surface `s`; returns edge numbers by directed node pair (local), for
    /// the direction in which a ring runs.
    fn add_edges(
        &mut self,
        s: usize,
        surface: &Surface,
    ) -> Result<BTreeMap<[usize; 2], usize>, AirError> {
        let (offset, first) = (self.first_node[s], self.first_panel[s]);
        let mut directed: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        for (p, corners) in surface.panels.iter().enumerate() {
            for [from, to] in ring(*corners) {
                if directed.contains_key(&[from, to]) {
                    return Err(AirError::Orientation {
                        surface: surface.name.clone(),
                        from,
                        to,
                        count: 2,
                    });
                }
                let edge = match directed.get(&[to, from]) {
                    Some(&e) => {
                        self.edges[e].minus = Some(first + p);
                        e
                    }
                    None => {
                        self.edges.push(Edge {
                            from: from + offset,
                            to: to + offset,
                            plus: first + p,
                            minus: None,
                            wake: None,
                        });
                        self.edges.len() - 1
                    }
                };
                directed.insert([from, to], edge);
            }
        }
        let free = directed.values().find(|&&e| self.edges[e].minus.is_none());
        match free {
            Some(&e) if surface.closed => Err(AirError::NotClosed {
                surface: surface.name.clone(),
                from: self.edges[e].from - offset,
                to: self.edges[e].to - offset,
            }),
            _ => Ok(directed),
        }
    }

    fn add_sheets(
        &mut self,
        s: usize,
        surface: &Surface,
        kinds: SheddingKinds,
        directed: &BTreeMap<[usize; 2], usize>,
    ) -> Result<(), AirError> {
        for (line, segments) in surface.shedding.iter().enumerate() {
            for (k, pair) in segments.windows(2).enumerate() {
                if pair[0].to != pair[1].from {
                    return Err(AirError::BrokenLine {
                        surface: surface.name.clone(),
                        line,
                        segment: k + 1,
                        start: pair[1].from,
                        end: pair[0].to,
                    });
                }
            }
            let sheds = |g: &&SheddingSegment| kinds.sheds(g.kind);
            for run in segments.chunk_by(|a, b| kinds.sheds(a.kind) == kinds.sheds(b.kind)) {
                if run.first().filter(sheds).is_some() {
                    self.add_sheet(s, surface, run, directed)?;
                }
            }
        }
        Ok(())
    }

    fn add_sheet(
        &mut self,
        s: usize,
        surface: &Surface,
        run: &[SheddingSegment],
        directed: &BTreeMap<[usize; 2], usize>,
    ) -> Result<(), AirError> {
        let (offset, first) = (self.first_node[s], self.first_panel[s]);
        let mut sheet = Sheet {
            surface: s,
            nodes: vec![run[0].from + offset],
            panels: Vec::new(),
            signs: Vec::new(),
            kinds: Vec::new(),
        };
        for (column, g) in run.iter().enumerate() {
            let forward = directed.get(&[g.from, g.to]);
            let found = forward.or_else(|| directed.get(&[g.to, g.from])).copied();
            let fits = |&e: &usize| {
                let edge = &self.edges[e];
                edge.minus.is_none() && edge.wake.is_none() && edge.plus == first + g.panel
            };
            let edge = found.filter(fits).ok_or_else(|| AirError::Shedding {
                surface: surface.name.clone(),
                kind: g.kind,
                from: g.from,
                to: g.to,
                panel: g.panel,
            })?;
            let sign = if forward.is_some() { 1.0 } else { -1.0 };
            self.edges[edge].wake = Some(WakeColumn {
                sheet: self.sheets.len(),
                column,
                sign,
            });
            sheet.nodes.push(g.to + offset);
            sheet.panels.push(first + g.panel);
            sheet.signs.push(sign);
            sheet.kinds.push(g.kind);
        }
        self.sheets.push(sheet);
        Ok(())
    }

    fn join_panels_to_edges(&mut self) {
        self.panel_edges = vec![Vec::with_capacity(4); self.panels.len()];
        for (e, edge) in self.edges.iter().enumerate() {
            let free = edge.minus.is_none() && edge.wake.is_none();
            let weight = if free { 1.0 } else { 0.5 };
            let mut join = |panel: usize, sign| {
                self.panel_edges[panel].push(PanelEdge {
                    edge: e,
                    sign,
                    weight,
                });
            };
            join(edge.plus, 1.0);
            if let Some(panel) = edge.minus {
                join(panel, -1.0);
            }
        }
    }
}

/// Directed edges of the ring of a panel, `c0 -> c3 -> c2 -> c1 -> c0`: left-handed about the
/// normal, so that its circulation is the jump of the potential across the panel along the
/// normal. Edges between repeated corners do not exist.
fn ring(c: [usize; 4]) -> impl Iterator<Item = [usize; 2]> {
    [[c[0], c[3]], [c[3], c[2]], [c[2], c[1]], [c[1], c[0]]]
        .into_iter()
        .filter(|[a, b]| a != b)
}
