//! What is joined to what: edges of the lattice, the panels they bound, the wakes they shed.

use crate::error::AirError;
use crate::seams::{self, Seam, Tie};
use crate::settings::SheddingKinds;
use crate::surface::{EdgeKind, SheddingSegment, Surface};
use std::collections::BTreeMap;

/// In place of a panel: an edge that a seam has made superfluous.
const GONE: usize = usize::MAX;

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
    /// Pairs of nodes that are one, on joined surfaces (global).
    pub seams: Vec<[usize; 2]>,
    /// Columns of wake nodes that leave them.
    pub ties: Vec<Tie>,
}

impl Topology {
    /// Joins the surfaces.
    ///
    /// # Errors
    /// [`AirError`] names the first panel, edge, seam or shedding segment that fits nowhere.
    pub fn new(
        surfaces: &[Surface],
        seams: &[Seam],
        kinds: SheddingKinds,
    ) -> Result<Self, AirError> {
        let mut t = Self {
            first_node: vec![0],
            first_panel: vec![0],
            ..Self::default()
        };
        seams::check(seams, surfaces)?;
        let mut directed = Vec::new();
        for (s, surface) in surfaces.iter().enumerate() {
            t.add_panels(s, surface)?;
            directed.push(t.add_edges(s, surface)?);
        }
        for (k, seam) in seams.iter().enumerate() {
            t.sew(k, seam, surfaces, &mut directed)?;
        }
        t.close_gaps(&mut directed);
        for (s, surface) in surfaces.iter().enumerate() {
            t.add_sheets(s, surface, kinds, &directed[s])?;
        }
        if t.panels.is_empty() {
            return Err(AirError::Empty);
        }
        t.ties = seams::ties(&t.seams, &t.sheets);
        t.join_panels_to_edges();
        Ok(t)
    }

    /// Makes the edges of a seam those of the first surface, shared with the panels of the second;
    /// those of the second are left without a panel of their own.
    fn sew(
        &mut self,
        k: usize,
        seam: &Seam,
        surfaces: &[Surface],
        directed: &mut [BTreeMap<[usize; 2], usize>],
    ) -> Result<(), AirError> {
        let wrong = |problem: &'static str| AirError::Seam { seam: k, problem };
        let [a, b] = seam.surfaces;
        let offset = [a, b].map(|s| self.first_node[s]);
        for ends in seam.nodes.windows(2) {
            let run = |side: usize| {
                let [m, n] = [ends[0][side], ends[1][side]];
                let of = &directed[seam.surfaces[side]];
                let forward = of.get(&[m, n]).map(|&e| (e, true));
                forward.or_else(|| of.get(&[n, m]).map(|&e| (e, false)))
            };
            let (Some((one, along)), Some((other, alike))) = (run(0), run(1)) else {
                return Err(wrong("two nodes in succession are no edge"));
            };
            let [own, theirs] = [one, other].map(|e| &self.edges[e]);
            if own.minus.is_some() || theirs.minus.is_some() {
                return Err(wrong("an edge is shared already"));
            }
            if along == alike {
                return Err(AirError::Orientation {
                    surface: surfaces[b].name.clone(),
                    from: ends[0][1],
                    to: ends[1][1],
                    count: 2,
                });
            }
            let panel = theirs.plus;
            self.edges[one].minus = Some(panel);
            self.edges[other].plus = GONE;
            directed[b].values_mut().for_each(|e| {
                if *e == other {
                    *e = one;
                }
            });
        }
        let nodes = seam.nodes.iter();
        self.seams
            .extend(nodes.map(|n| [n[0] + offset[0], n[1] + offset[1]]));
        Ok(())
    }

    /// Takes out the edges that seams have left without panels.
    fn close_gaps(&mut self, directed: &mut [BTreeMap<[usize; 2], usize>]) {
        if self.seams.is_empty() {
            return;
        }
        let mut number = Vec::with_capacity(self.edges.len());
        let mut next = 0;
        for edge in &self.edges {
            number.push(next);
            next += usize::from(edge.plus != GONE);
        }
        self.edges.retain(|e| e.plus != GONE);
        for e in directed.iter_mut().flat_map(BTreeMap::values_mut) {
            *e = number[*e];
        }
    }

    fn add_panels(&mut self, s: usize, surface: &Surface) -> Result<(), AirError> {
        let offset = self.first_node[s];
        if let Some(rest) = &surface.rest {
            let (nodes, expected) = (rest.len(), surface.node_count);
            if nodes != expected || !rest.iter().all(|x| x.is_finite()) {
                let surface = surface.name.clone();
                return Err(AirError::Rest {
                    surface,
                    nodes,
                    expected,
                });
            }
        }
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
            // The edges of a seam are no border any more.
            let sewn = |g: &SheddingSegment| {
                let edge = directed.get(&[g.from, g.to]);
                let edge = edge.or_else(|| directed.get(&[g.to, g.from]));
                edge.map(|&e| &self.edges[e]).is_some_and(|e| {
                    let surface = |p: usize| self.panel_surface[p];
                    e.minus.is_some_and(|p| surface(p) != surface(e.plus))
                })
            };
            let sheds: Vec<bool> = segments
                .iter()
                .map(|g| kinds.sheds(g.kind) && !sewn(g))
                .collect();
            let mut from = 0;
            for same in sheds.chunk_by(|a, b| a == b) {
                let run = &segments[from..from + same.len()];
                from += same.len();
                if same[0] {
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
