//! Meshes of four-node quadrilaterals: flat wing grids and closed surfaces (seed sec. 2).

use crate::error::{ModelError, in_row, require_count};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use wingbeat_math::{DVec3, mirrored};

/// Left or right wing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// Spans along -axis 2 of the wing frame.
    Left,
    /// Spans along +axis 2 of the wing frame.
    Right,
}

impl Side {
    /// Sign of axis 2 along the span: -1 left, +1 right.
    pub fn sign(self) -> f64 {
        match self {
            Side::Left => -1.0,
            Side::Right => 1.0,
        }
    }

    /// The other side.
    pub fn other(self) -> Self {
        match self {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }
}

/// Spacing of grid lines between 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Spacing {
    /// Equal.
    Uniform,
    /// `(1 - cos(pi k / n)) / 2`: dense at both ends.
    Cosine,
}

impl Spacing {
    /// Line `k` of `n`.
    pub fn at(self, k: usize, n: usize) -> f64 {
        match self {
            Spacing::Uniform => k as f64 / n as f64,
            Spacing::Cosine if k == n => 1.0,
            Spacing::Cosine => 0.5 * (1.0 - (PI * k as f64 / n as f64).cos()),
        }
    }
}

/// A wing's grid of `rows` (chordwise) x `cols` (spanwise) quadrilaterals.
///
/// Node (i, j) is `nodes[i * (cols + 1) + j]`; i = 0 is the leading edge, i = rows the trailing
/// edge, j = 0 the root, j = cols the tip.
#[derive(Clone, Debug, PartialEq)]
pub struct GridMesh {
    /// Panels along the chord.
    pub rows: usize,
    /// Panels along the span.
    pub cols: usize,
    /// Nodes \[m\], wing frame.
    pub nodes: Vec<DVec3>,
    /// Law of the columns along the span; uniform where nodes follow none.
    pub columns: Spacing,
}

impl GridMesh {
    /// Index of node (i, j).
    pub fn node(&self, i: usize, j: usize) -> usize {
        i * (self.cols + 1) + j
    }

    /// Corner nodes of panel (i, j), ordered so that the normal `(c2-c0) x (c3-c1)` is +axis 3
    /// of the wing frame on either side.
    pub fn panel(&self, side: Side, i: usize, j: usize) -> [usize; 4] {
        let [a, b] = [self.node(i, j), self.node(i, j + 1)];
        let [d, c] = [self.node(i + 1, j), self.node(i + 1, j + 1)];
        match side {
            Side::Right => [a, b, c, d],
            Side::Left => [a, d, c, b],
        }
    }

    /// All panels, leading row first, root to tip inside a row: panel (i, j) is number
    /// `i * cols + j`.
    pub fn panels(&self, side: Side) -> Vec<[usize; 4]> {
        let row = |i| (0..self.cols).map(move |j| self.panel(side, i, j));
        (0..self.rows).flat_map(row).collect()
    }

    /// The mirror image in the 1-3 plane: axis 2 changes sign, bit for bit.
    pub fn mirrored(&self) -> Self {
        Self {
            nodes: self.nodes.iter().map(|&x| mirrored(x)).collect(),
            ..*self
        }
    }

    /// Whether it is the mirror image of `other`, node by node to `off` \[m\].
    pub fn is_image_of(&self, other: &Self, off: f64) -> bool {
        let mut nodes = self.nodes.iter().zip(&other.nodes);
        [self.rows, self.cols] == [other.rows, other.cols]
            && nodes.all(|(&x, &y)| x.distance(mirrored(y)) <= off)
    }

    /// All lengths multiplied by `s`.
    pub fn scaled(&self, s: f64) -> Self {
        Self {
            nodes: self.nodes.iter().map(|&x| x * s).collect(),
            ..*self
        }
    }

    /// As a general mesh.
    pub fn to_quads(&self, side: Side) -> QuadMesh {
        QuadMesh {
            nodes: self.nodes.clone(),
            quads: self.panels(side),
        }
    }

    /// Node numbers, panels that are not there, coordinates that are not finite.
    ///
    /// # Errors
    /// [`ModelError::Count`] for no panels or a wrong number of nodes, [`ModelError::Table`] for
    /// a node that is not finite, [`ModelError::FlatPanel`] for a panel without area.
    pub fn check(&self, name: &str) -> Result<(), ModelError> {
        require_count(&format!("{name}.rows"), self.rows, self.rows > 0, ">= 1")?;
        require_count(&format!("{name}.cols"), self.cols, self.cols > 0, ">= 1")?;
        let n = self.nodes.len();
        let fits = n == (self.rows + 1) * (self.cols + 1);
        let key = format!("{name}.nodes");
        require_count(&key, n, fits, "(rows + 1) * (cols + 1)")?;
        self.to_quads(Side::Right).check_panels(name)
    }
}

/// The side that a name tells: whether `left` or `right` is among its words, which end where no small letter follows.
/// None where neither is, or both are.
///
/// ```
/// use wingbeat_model::{Side, side_in_name};
/// assert_eq!(side_in_name("fore-right"), Some(Side::Right));
/// assert_eq!(side_in_name("upright-left"), Some(Side::Left));
/// assert_eq!(side_in_name("left-of-right"), None);
/// ```
pub fn side_in_name(name: &str) -> Option<Side> {
    let has = |side: &str| {
        name.split(|c: char| !c.is_lowercase())
            .any(|word| word == side)
    };
    match (has("left"), has("right")) {
        (true, false) => Some(Side::Left),
        (false, true) => Some(Side::Right),
        _ => None,
    }
}

/// The name of a wing with the words `left` and `right` exchanged: that of its mirror image.
pub fn mirror_name(name: &str) -> Option<String> {
    let [this, other] = match side_in_name(name)? {
        Side::Left => ["left", "right"],
        Side::Right => ["right", "left"],
    };
    let pieces = name.split_inclusive(|c: char| !c.is_lowercase());
    let mirrored = pieces.map(|piece| match piece.strip_prefix(this) {
        Some(rest) if !rest.starts_with(char::is_lowercase) => format!("{other}{rest}"),
        _ => piece.to_owned(),
    });
    Some(mirrored.collect())
}

/// A surface of quadrilaterals. On a closed surface `(c2-c0) x (c3-c1)` points outward.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadMesh {
    /// Nodes, components of the frame of the body or wing \[m\].
    pub nodes: Vec<DVec3>,
    /// Corner nodes of each panel.
    pub quads: Vec<[usize; 4]>,
}

impl QuadMesh {
    /// Corner points of a panel \[m\].
    pub fn corners(&self, panel: usize) -> [DVec3; 4] {
        self.quads[panel].map(|n| self.nodes[n])
    }

    /// Corner points of the two halves of all panels \[m\].
    pub(crate) fn triangles(&self) -> Vec<[DVec3; 3]> {
        let halves = |q: usize| {
            let [a, b, c, d] = self.corners(q);
            [[a, b, c], [a, c, d]]
        };
        (0..self.quads.len()).flat_map(halves).collect()
    }

    /// Every node through `f`.
    pub fn map(&self, f: impl Fn(DVec3) -> DVec3) -> Self {
        Self {
            nodes: self.nodes.iter().map(|&x| f(x)).collect(),
            quads: self.quads.clone(),
        }
    }

    /// The same surface with all normals reversed.
    pub fn reversed(&self) -> Self {
        Self {
            nodes: self.nodes.clone(),
            quads: self
                .quads
                .iter()
                .map(|&[a, b, c, d]| [a, d, c, b])
                .collect(),
        }
    }

    /// Mean width of the panels \[m\], weighted with their areas: area over the longest side.
    pub fn mean_width(&self) -> f64 {
        let [mut areas, mut widths] = [0.0; 2];
        for q in 0..self.quads.len() {
            let [a, b, c, d] = self.corners(q);
            let area = 0.5 * (c - a).cross(d - b).length();
            let sides = [[a, b], [b, c], [c, d], [d, a]].map(|[a, b]| a.distance(b));
            let longest = sides.into_iter().fold(0.0, f64::max);
            if longest > 0.0 {
                areas += area;
                widths += area * area / longest;
            }
        }
        widths / areas
    }

    /// Smallest and largest coordinate along each axis \[m\].
    pub fn bounds(&self) -> [DVec3; 2] {
        let far = DVec3::splat(f64::INFINITY);
        let fold = |[lo, hi]: [DVec3; 2], x: &DVec3| [lo.min(*x), hi.max(*x)];
        self.nodes.iter().fold([far, -far], fold)
    }

    /// Finite nodes and panels with area.
    pub(crate) fn check_panels(&self, name: &str) -> Result<(), ModelError> {
        if let Some(row) = self.nodes.iter().position(|x| !x.is_finite()) {
            let problem = format!("{} is not a finite point", self.nodes[row]);
            return Err(in_row(&format!("nodes of `{name}`"), row, problem));
        }
        let flat = |p: &usize| {
            let [a, b, c, d] = self.corners(*p);
            (c - a).cross(d - b).length() == 0.0
        };
        match (0..self.quads.len()).find(flat) {
            None => Ok(()),
            Some(panel) => Err(ModelError::FlatPanel {
                part: name.to_owned(),
                panel,
                nodes: self.quads[panel],
            }),
        }
    }

    /// Each edge is shared by exactly two panels in opposite directions.
    pub(crate) fn check_edges(&self, name: &str) -> Result<(), ModelError> {
        let edges = self.directed_edges();
        for (&(a, b), &panels) in &edges {
            let opposite = edges.get(&(b, a)).copied().unwrap_or(0);
            if (panels, opposite) != (1, 1) {
                return Err(ModelError::NotClosed {
                    part: name.to_owned(),
                    edge: [a, b],
                    panels,
                    opposite,
                });
            }
        }
        Ok(())
    }

    /// All nodes hang together.
    pub(crate) fn check_one_piece(&self, name: &str) -> Result<(), ModelError> {
        let pieces = self.pieces();
        if pieces == 1 {
            return Ok(());
        }
        Err(ModelError::Pieces {
            part: name.to_owned(),
            pieces,
        })
    }

    /// Directed edges with the number of panels that use them, in a fixed order.
    fn directed_edges(&self) -> BTreeMap<(usize, usize), usize> {
        let mut edges = BTreeMap::new();
        for q in &self.quads {
            for k in 0..4 {
                *edges.entry((q[k], q[(k + 1) % 4])).or_insert(0) += 1;
            }
        }
        edges
    }

    /// Number of sets of nodes joined by panels; a node without a panel is a piece.
    fn pieces(&self) -> usize {
        let mut root: Vec<usize> = (0..self.nodes.len()).collect();
        fn find(root: &mut [usize], mut n: usize) -> usize {
            while root[n] != n {
                root[n] = root[root[n]];
                n = root[n];
            }
            n
        }
        for q in &self.quads {
            let first = find(&mut root, q[0]);
            for &n in &q[1..] {
                let other = find(&mut root, n);
                root[other] = first;
            }
        }
        (0..root.len()).filter(|&n| root[n] == n).count()
    }
}
