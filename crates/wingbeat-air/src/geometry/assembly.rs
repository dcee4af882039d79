//! Finds edges, shared edges and wake sheets of the surfaces.

use crate::edges::SheddingKinds;
use crate::error::AirError;
use crate::geometry::joined_edge::{JoinedEdge, check_joined_edges};
use crate::geometry::surface::{SheddingSegment, Surface};
use crate::geometry::topology::{Edge, JoinedColumns, PanelEdge, Sheet, Topology, WakeColumn};
use std::collections::BTreeMap;

/// In place of a panel: an edge that has been merged with one of another surface.
const MERGED: usize = usize::MAX;

/// Edge numbers of a surface by directed node pair (local), for the direction in which a ring runs.
type DirectedEdges = BTreeMap<[usize; 2], usize>;

impl Topology {
    /// Joins the surfaces.
    ///
    /// # Errors
    /// [`AirError`] names the first panel, edge, joined edge or shedding segment that fits nowhere.
    pub(crate) fn new(
        surfaces: &[Surface],
        joined: &[JoinedEdge],
        kinds: SheddingKinds,
    ) -> Result<Self, AirError> {
        let mut t = Self {
            first_node: vec![0],
            first_panel: vec![0],
            surface_names: surfaces.iter().map(|s| s.name.clone()).collect(),
            ..Self::default()
        };
        check_joined_edges(joined, surfaces)?;
        let mut directed = Vec::new();
        for (s, surface) in surfaces.iter().enumerate() {
            t.add_panels(s, surface)?;
            directed.push(t.add_edges(s, surface)?);
        }
        for (k, joined) in joined.iter().enumerate() {
            t.merge_edges(k, joined, surfaces, &mut directed)?;
        }
        t.remove_merged(&mut directed);
        for (s, surface) in surfaces.iter().enumerate() {
            t.add_sheets(s, surface, kinds, &directed[s])?;
        }
        if t.panels.is_empty() {
            return Err(AirError::Empty);
        }
        t.joined_columns = joined_columns(&t.joined_nodes, &t.sheets);
        t.plane_columns = plane_columns(&t.plane_lines, &t.sheets);
        t.join_panels_to_edges();
        Ok(t)
    }

    /// Makes the edges of a joined edge line those of the first surface, shared with the panels of the
    /// second; those of the second are left without a panel.
    fn merge_edges(
        &mut self,
        k: usize,
        joined: &JoinedEdge,
        surfaces: &[Surface],
        directed: &mut [DirectedEdges],
    ) -> Result<(), AirError> {
        let wrong = |problem: &'static str| AirError::JoinedEdge { edge: k, problem };
        let [a, b] = joined.surfaces;
        let offset = [a, b].map(|s| self.first_node[s]);
        if joined.is_on_plane() {
            return self.join_to_image(k, joined, &directed[a]);
        }
        for ends in joined.nodes.windows(2) {
            let run = |side: usize| {
                let [m, n] = [ends[0][side], ends[1][side]];
                let of = &directed[joined.surfaces[side]];
                let forward = of.get(&[m, n]).map(|&e| (e, true));
                forward.or_else(|| of.get(&[n, m]).map(|&e| (e, false)))
            };
            let (Some((one, along)), Some((other, alike))) = (run(0), run(1)) else {
                return Err(wrong("two nodes in succession are no edge"));
            };
            let [first, second] = [one, other].map(|e| &self.edges[e]);
            if first.minus.is_some() || second.minus.is_some() {
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
            let panel = second.plus;
            self.edges[one].minus = Some(panel);
            self.edges[other].plus = MERGED;
            directed[b].values_mut().for_each(|e| {
                if *e == other {
                    *e = one;
                }
            });
        }
        let nodes = joined.nodes.iter();
        self.joined_nodes
            .extend(nodes.map(|n| [n[0] + offset[0], n[1] + offset[1]]));
        Ok(())
    }

    /// Makes the edges of a line on a plane of images those of a panel and its own image.
    fn join_to_image(
        &mut self,
        k: usize,
        joined: &JoinedEdge,
        directed: &DirectedEdges,
    ) -> Result<(), AirError> {
        let wrong = |problem: &'static str| AirError::JoinedEdge { edge: k, problem };
        for ends in joined.nodes.windows(2) {
            let [m, n] = [ends[0][0], ends[1][0]];
            let edge = directed.get(&[m, n]).or_else(|| directed.get(&[n, m]));
            let &e = edge.ok_or_else(|| wrong("two nodes in succession are no edge"))?;
            if self.edges[e].minus.is_some() {
                return Err(wrong("an edge is shared already"));
            }
            self.edges[e].minus = Some(self.edges[e].plus);
        }
        let first = self.first_node[joined.surfaces[0]];
        let nodes = joined.nodes.iter().map(|n| n[0] + first);
        self.plane_lines.push(nodes.collect());
        Ok(())
    }

    /// Takes out the edges that merging has left without panels.
    fn remove_merged(&mut self, directed: &mut [DirectedEdges]) {
        if self.joined_nodes.is_empty() {
            return;
        }
        let mut number = Vec::with_capacity(self.edges.len());
        let mut next = 0;
        for edge in &self.edges {
            number.push(next);
            next += usize::from(edge.plus != MERGED);
        }
        self.edges.retain(|e| e.plus != MERGED);
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

    /// Finds the edges of surface `s`.
    fn add_edges(&mut self, s: usize, surface: &Surface) -> Result<DirectedEdges, AirError> {
        let (offset, first) = (self.first_node[s], self.first_panel[s]);
        let mut directed = DirectedEdges::new();
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
                            is_end: false,
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
        directed: &DirectedEdges,
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
            // Joined edges are no border any more.
            let is_joined = |g: &SheddingSegment| {
                let edge = directed.get(&[g.from, g.to]);
                let edge = edge.or_else(|| directed.get(&[g.to, g.from]));
                edge.map(|&e| &self.edges[e]).is_some_and(|e| {
                    let surface = |p: usize| self.panel_surface[p];
                    e.is_on_plane() || e.minus.is_some_and(|p| surface(p) != surface(e.plus))
                })
            };
            let sheds: Vec<bool> = segments
                .iter()
                .map(|g| kinds.sheds(g.kind) && !is_joined(g))
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
        directed: &DirectedEdges,
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
            let mut join = |panel: usize, sign| {
                self.panel_edges[panel].push(PanelEdge { edge: e, sign });
            };
            join(edge.plus, 1.0);
            if let Some(panel) = edge.minus.filter(|_| !edge.is_on_plane()) {
                join(panel, -1.0);
            }
        }
    }
}

/// Columns of wake nodes that leave joined nodes.
fn joined_columns(joined: &[[usize; 2]], sheets: &[Sheet]) -> Vec<JoinedColumns> {
    let columns_at = |node: usize| {
        let of = move |(s, sheet): (usize, &Sheet)| -> Vec<(usize, usize)> {
            let here = |(_, n): &(usize, &usize)| **n == node;
            let columns = sheet.nodes.iter().enumerate().filter(here);
            columns.map(|(column, _)| (s, column)).collect()
        };
        sheets.iter().enumerate().flat_map(of)
    };
    let pairs = |&[a, b]: &[usize; 2]| {
        columns_at(a)
            .flat_map(move |x| columns_at(b).map(move |y| JoinedColumns([x, y])))
            .collect::<Vec<_>>()
    };
    // A sheet that leaves a surface all around ends where it begins.
    let around = |(s, sheet): (usize, &Sheet)| {
        let ends = JoinedColumns([(s, 0), (s, sheet.panels.len())]);
        sheet.is_closed().then_some(ends)
    };
    let closed = sheets.iter().enumerate().filter_map(around);
    joined.iter().flat_map(pairs).chain(closed).collect()
}

/// Columns of wake nodes that leave lines on planes of images.
fn plane_columns(lines: &[Vec<usize>], sheets: &[Sheet]) -> Vec<(usize, usize)> {
    let columns = |(s, sheet): (usize, &Sheet)| -> Vec<(usize, usize)> {
        let nodes = sheet.nodes.iter().enumerate();
        let here = nodes.filter(|(_, n)| lines.iter().flatten().any(|m| m == *n));
        here.map(|(column, _)| (s, column)).collect()
    };
    sheets.iter().enumerate().flat_map(columns).collect()
}

/// Directed edges of the ring of a panel, `c0 -> c3 -> c2 -> c1 -> c0`: left-handed about the
/// normal, so that its circulation is the jump of the potential across the panel along the
/// normal. Edges between repeated corners do not exist.
fn ring(c: [usize; 4]) -> impl Iterator<Item = [usize; 2]> {
    [[c[0], c[3]], [c[3], c[2]], [c[2], c[1]], [c[1], c[0]]]
        .into_iter()
        .filter(|[a, b]| a != b)
}
