//! Surfaces as the caller describes them: panels and the edges that shed, topology only.

use crate::edges::EdgeKind;
use wingbeat_math::DVec3;

/// One edge of one panel from which a wake leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SheddingSegment {
    /// First node, counted in the surface.
    pub from: usize,
    /// Second node, counted in the surface.
    pub to: usize,
    /// The panel whose circulation is shed, counted in the surface.
    pub panel: usize,
    /// Which edge of the wing this is; [`crate::AirSettings::shedding`] switches each kind.
    pub kind: EdgeKind,
}

/// One thin lifting surface, or the closed skin of a thick body.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Name for messages and results.
    pub name: String,
    /// Number of nodes.
    pub node_count: usize,
    /// Corners c0, c1, c2, c3 of each panel as node numbers; the normal is along
    /// `(c2 - c0) x (c3 - c1)`, outward on a closed surface. A triangle repeats a corner.
    pub panels: Vec<[usize; 4]>,
    /// Lines of segments that shed wakes; consecutive segments of a line share a node.
    pub shedding: Vec<Vec<SheddingSegment>>,
    /// Whether the surface encloses a volume.
    pub closed: bool,
    /// Whether it is no surface of the animal but leads from the root of a wing to the middle of the body it
    /// stands on, joined to the wing and, there, to its like of the other wing: it carries the mean circulation
    /// of the panels beside both roots through the body, lets air through and holds no wake back. One column of
    /// panels, as many as the wing has along its chord.
    pub carry_through: bool,
    /// Nodes at rest [m], in any frame that moves with the surface. On large lattices, what a surface does to itself is
    /// computed once from them, for as long as it has this shape, and when it has another they speed up the solution
    /// still, if it is not too different. None: everything is computed at every step. The lengths of panels along the
    /// chord, by which control points lie at three quarters of each, are those of this shape; none: as if all were equal.
    pub rest: Option<Vec<DVec3>>,
    /// Whether the columns of panels have cosine spacing along the span, edges at `(1 - cos (pi j / n)) / 2` of it:
    /// where rings are inset ([`crate::AirSettings::inset`]) control points are midway in that angle then, and rings reach
    /// to the tips.
    pub cosine_columns: bool,
    /// Whether rings reach to the root, which lies on that of another surface: filaments of both on each other leave no
    /// gap through which air passes.
    pub reaches_root: bool,
}

impl Surface {
    /// An open sheet of `rows` x `cols` quadrilaterals, nodes numbered row by row
    /// (`i (cols + 1) + j`), row 0 the leading edge, column 0 the root. The normal is along
    /// (leading to trailing) x (root to tip). One line may shed, running along the whole border:
    /// leading edge root to tip, tip, trailing edge tip to root, root.
    ///
    /// ```
    /// let wing = wingbeat_air::Surface::grid("wing", 4, 10);
    /// assert_eq!(wing.panels.len(), 40);
    /// assert_eq!(wing.shedding[0].len(), 2 * (10 + 4));
    /// ```
    pub fn grid(name: &str, rows: usize, cols: usize) -> Self {
        let node = |i: usize, j: usize| i * (cols + 1) + j;
        let panels = (0..rows * cols)
            .map(|k| (k / cols, k % cols))
            .map(|(i, j)| {
                [
                    node(i, j),
                    node(i + 1, j),
                    node(i + 1, j + 1),
                    node(i, j + 1),
                ]
            })
            .collect();
        let segment = |from, to, panel, kind| SheddingSegment {
            from,
            to,
            panel,
            kind,
        };
        let leading = (0..cols).map(|j| segment(node(0, j), node(0, j + 1), j, EdgeKind::Leading));
        let tip = (0..rows).map(|i| {
            let panel = i * cols + cols - 1;
            segment(node(i, cols), node(i + 1, cols), panel, EdgeKind::Tip)
        });
        let trailing = (0..cols).rev().map(|j| {
            let panel = (rows - 1) * cols + j;
            segment(node(rows, j + 1), node(rows, j), panel, EdgeKind::Trailing)
        });
        let root = (0..rows)
            .rev()
            .map(|i| segment(node(i + 1, 0), node(i, 0), i * cols, EdgeKind::Root));
        Self {
            name: name.to_owned(),
            node_count: (rows + 1) * (cols + 1),
            panels,
            shedding: vec![leading.chain(tip).chain(trailing).chain(root).collect()],
            closed: false,
            carry_through: false,
            rest: None,
            cosine_columns: false,
            reaches_root: false,
        }
    }

    /// The same surface with its shape at rest, see [`Self::rest`].
    pub fn with_rest(self, nodes: Vec<DVec3>) -> Self {
        Self {
            rest: Some(nodes),
            ..self
        }
    }

    /// A closed skin that sheds nothing.
    pub fn closed(name: &str, node_count: usize, panels: Vec<[usize; 4]>) -> Self {
        Self {
            name: name.to_owned(),
            node_count,
            panels,
            shedding: Vec::new(),
            closed: true,
            carry_through: false,
            rest: None,
            cosine_columns: false,
            reaches_root: false,
        }
    }
}
