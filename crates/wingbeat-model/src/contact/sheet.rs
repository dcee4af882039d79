//! Wings as sheets of nodes that are looked at against others.

use crate::animal::Wing;
use crate::motion::{Start, WingMotion};
use wingbeat_math::{DMat3, DVec3, RotationLaw};

/// Lines of nodes along chord and span that are compared at most.
pub(super) const LINES: [usize; 2] = [9, 17];
/// What is no crossing but a touch, over the longest way across a wing.
const TOUCH: f64 = 1e-6;
/// What is on the edge of a triangle, over its area: lines of mirrored wings meet each other \[1\].
const EDGE: f64 = 1e-9;

/// Nodes of a wing at rest, and what moves them.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    motion: WingMotion,
    hinge: DVec3,
    /// Lines of nodes along the span.
    pub rows: usize,
    /// Lines of nodes along the chord.
    pub columns: usize,
    /// Nodes at rest, wing axes \[m\].
    pub nodes: Vec<DVec3>,
    /// Longest way across it \[m\].
    pub size: f64,
}

impl Sheet {
    pub fn new(wing: &Wing) -> Self {
        let mesh = &wing.mesh;
        let rows = lines(mesh.rows, LINES[0]);
        let columns = lines(mesh.cols, LINES[1]);
        let row = |&i: &usize| columns.iter().map(move |&j| mesh.nodes[mesh.node(i, j)]);
        let nodes: Vec<DVec3> = rows.iter().flat_map(row).collect();
        let motion = WingMotion {
            start: Start::Impulsive,
            ..wing.motion.clone()
        };
        let far = |x: &DVec3| x.distance(nodes[0]);
        Self {
            motion,
            hinge: wing.hinge_b,
            rows: rows.len(),
            columns: columns.len(),
            size: 2.0 * nodes.iter().map(far).fold(0.0, f64::max),
            nodes,
        }
    }

    /// Its nodes at time `t` \[s\], body components \[m\].
    pub fn at(&self, t: f64) -> Vec<DVec3> {
        self.placed((self.hinge, self.motion.at(t).c))
    }

    /// Its nodes \[m\] where the hinge is here and the wing has this attitude.
    pub fn placed(&self, (hinge, r): (DVec3, DMat3)) -> Vec<DVec3> {
        self.nodes.iter().map(|x| hinge + r * *x).collect()
    }

    /// Lines of this sheet, whose nodes are at `a`, that pass through the other, whose are at `b`, with the triangle
    /// that each passes through first.
    pub fn piercing<'a>(
        &'a self,
        a: &'a [DVec3],
        other: &'a Self,
        b: &'a [DVec3],
    ) -> impl Iterator<Item = ([usize; 2], [DVec3; 3])> + 'a {
        let touch = self.touch(other);
        self.near(a, b).filter_map(move |line| {
            let mut triangles = other.triangles().map(|t| t.map(|n| b[n]));
            let pierced = triangles.find(|t| pierces(line.map(|n| a[n]), *t, touch));
            pierced.map(|triangle| (line, triangle))
        })
    }

    /// What is no more than a touch of the other sheet \[m\].
    pub fn touch(&self, other: &Self) -> f64 {
        TOUCH * (self.size + other.size)
    }

    /// Lines of this sheet, whose nodes are at `a`, that reach into the box around `b`.
    pub fn near<'a>(
        &'a self,
        a: &'a [DVec3],
        b: &[DVec3],
    ) -> impl Iterator<Item = [usize; 2]> + use<'a> {
        let low = b.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = b.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let near =
            move |x: DVec3, y: DVec3| x.min(y).cmple(high).all() && x.max(y).cmpge(low).all();
        self.lines().filter(move |[m, n]| near(a[*m], a[*n]))
    }

    /// Nodes at the ends of the lines between neighbours.
    pub fn lines(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let (rows, columns) = (self.rows, self.columns);
        let along = (0..rows * columns).filter(move |n| n % columns + 1 < columns);
        let across = 0..(rows - 1) * columns;
        along
            .map(|n| [n, n + 1])
            .chain(across.map(move |n| [n, n + columns]))
    }

    pub fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let columns = self.columns;
        let corners = (0..(self.rows - 1) * columns).filter(move |n| n % columns + 1 < columns);
        corners.flat_map(move |n| {
            let m = n + columns;
            [[n, m, m + 1], [n, m + 1, n + 1]]
        })
    }
}

/// Indices of at most `most` of the lines of nodes of `panels`, the first and the last among them.
pub(super) fn lines(panels: usize, most: usize) -> Vec<usize> {
    let count = panels.min(most - 1);
    (0..=count).map(|k| k * panels / count).collect()
}

/// Whether the line passes through the triangle, and does not only `touch` \[m\] it.
pub(crate) fn pierces(line: [DVec3; 2], triangle: [DVec3; 3], touch: f64) -> bool {
    pierced(line, triangle, touch).is_some()
}

/// Where the line passes through the triangle, if it does and does not only `touch` \[m\] it.
pub(super) fn pierced([x, y]: [DVec3; 2], [a, b, c]: [DVec3; 3], touch: f64) -> Option<DVec3> {
    let normal = (b - a).cross(c - a);
    let area = normal.length();
    if area <= touch * touch {
        return None;
    }
    let n = normal / area;
    let [over, under] = [x, y].map(|p| (p - a).dot(n));
    if over * under >= 0.0 || over.abs().min(under.abs()) <= touch {
        return None;
    }
    let p = x.lerp(y, over / (over - under));
    let inside = |[u, v]: [DVec3; 2]| (v - u).cross(p - u).dot(n) >= -EDGE * area;
    [[a, b], [b, c], [c, a]]
        .into_iter()
        .all(inside)
        .then_some(p)
}
