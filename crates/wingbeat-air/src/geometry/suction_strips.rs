//! Strips whose leading edges hold suction and shed what is beyond it.

use crate::edges::EdgeKind;
use crate::geometry::strips::Strip;
use crate::geometry::symmetry::Symmetry;
use crate::geometry::topology::{Sheet, Topology};

/// Strips behind leading edges that shed, each with an unknown circulation that leaves within a step: one for
/// both of a pair of mirror images.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SuctionStrips {
    /// Strips of the half that is computed, by their number among all strips.
    pub computed: Vec<usize>,
    /// The unknown of each strip; none where its edge does not shed.
    pub unknown: Vec<Option<usize>>,
    /// The strip of each column of each wake sheet.
    of_column: Vec<Vec<Option<usize>>>,
    /// Whether each node lies on such a leading edge.
    is_front: Vec<bool>,
}

impl SuctionStrips {
    /// None of so many strips.
    pub fn none(strips: usize) -> Self {
        Self {
            unknown: vec![None; strips],
            ..Self::default()
        }
    }

    /// Of all strips but those within bodies, from which the wake sheets come for which `is_within`.
    pub fn new(
        topology: &Topology,
        strips: &[Strip],
        symmetry: Option<&Symmetry>,
        is_within: impl Fn(&Sheet) -> bool,
    ) -> Self {
        let columns = topology.sheets.iter().map(|s| vec![None; s.panels.len()]);
        let mut found = Self {
            of_column: columns.collect(),
            unknown: vec![None; strips.len()],
            is_front: vec![false; *topology.first_node.last().unwrap_or(&0)],
            ..Self::default()
        };
        for (s, strip) in strips.iter().enumerate() {
            let Some(wake) = topology.edges[strip.edge].wake else {
                continue;
            };
            found.of_column[wake.sheet][wake.column] = Some(s);
            strip.front().iter().for_each(|&n| found.is_front[n] = true);
            if symmetry.is_none_or(|m| strip.panels[0] <= m.panel[strip.panels[0]]) {
                found.unknown[s] = Some(found.computed.len());
                found.computed.push(s);
            }
        }
        // Front edges within bodies go on from those of the wings.
        let fronts = topology.sheets.iter().filter(|s| is_within(s));
        for sheet in fronts.filter(|s| s.kinds[0] == EdgeKind::Leading) {
            sheet.nodes.iter().for_each(|&n| found.is_front[n] = true);
        }
        found.join_images(strips, symmetry);
        found
    }

    /// Strips that are not computed share the unknown of their mirror image.
    fn join_images(&mut self, strips: &[Strip], symmetry: Option<&Symmetry>) {
        let Some(symmetry) = symmetry else { return };
        for (u, &s) in self.computed.iter().enumerate() {
            let image = symmetry.panel[strips[s].panels[0]];
            let image = strips.iter().position(|t| t.panels[0] == image);
            self.unknown[image.expect("panels are paired")] = Some(u);
        }
    }

    /// The strip whose edge sheds into a column of a wake sheet.
    pub fn of_column(&self, sheet: usize, column: usize) -> Option<usize> {
        *self.of_column.get(sheet)?.get(column)?
    }

    /// Whether a node lies on such a leading edge.
    pub fn is_front(&self, node: usize) -> bool {
        self.is_front.get(node).is_some_and(|is| *is)
    }
}
