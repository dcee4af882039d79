//! Wings as sheets of nodes that are looked at against others.

use crate::animal::Wing;
use crate::deformation::DeformingMesh;
use crate::motion::WingMotion;
use wingbeat_math::{DMat3, DVec3, RotationLaw};

/// Lines of nodes along chord and span that are compared at most.
pub(super) const LINES: [usize; 2] = [9, 17];
/// What is no crossing but a touch, over the longest way across a wing.
const TOUCH: f64 = 1e-6;
/// What is on the edge of a triangle, over its area: lines of mirrored wings meet each other \[1\].
pub(super) const EDGE: f64 = 1e-9;

/// Place of the origin \[m\] and attitude.
pub type Pose = (DVec3, DMat3);

/// Nodes of a wing at rest, and what moves them.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    motion: WingMotion,
    hinge: DVec3,
    shape: Option<Shape>,
    /// Lines of nodes along the span.
    pub rows: usize,
    /// Lines of nodes along the chord.
    pub columns: usize,
    /// Nodes at rest, wing axes \[m\].
    pub nodes: Vec<DVec3>,
    /// Longest way across it \[m\].
    pub size: f64,
}

/// What a prescribed deformation makes of a wing.
#[derive(Clone, Debug)]
struct Shape {
    mesh: DeformingMesh,
    /// The nodes of the mesh that are those of the sheet.
    nodes: Vec<usize>,
}

impl Sheet {
    pub fn new(wing: &Wing) -> Self {
        let mesh = &wing.mesh;
        let rows = lines(mesh.rows, LINES[0]);
        let columns = lines(mesh.cols, LINES[1]);
        let row = |&i: &usize| columns.iter().map(move |&j| mesh.node(i, j));
        let places: Vec<usize> = rows.iter().flat_map(row).collect();
        let nodes: Vec<DVec3> = places.iter().map(|&n| mesh.nodes[n]).collect();
        let shape = wing.deformation.as_ref().map(|d| Shape {
            mesh: DeformingMesh::new(mesh, d),
            nodes: places,
        });
        let far = |x: &DVec3| x.distance(nodes[0]);
        Self {
            motion: wing.motion.impulsive(),
            hinge: wing.hinge_b,
            shape,
            rows: rows.len(),
            columns: columns.len(),
            size: 2.0 * nodes.iter().map(far).fold(0.0, f64::max),
            nodes,
        }
    }

    /// Its nodes at time `t` \[s\], body components \[m\].
    pub fn at(&self, t: f64) -> Vec<DVec3> {
        self.carried((self.hinge, self.motion.at(t).c), t)
    }

    /// Its nodes at time `t` \[s\] where the hinge is here and the wing has this attitude \[m\].
    pub fn carried(&self, pose: Pose, t: f64) -> Vec<DVec3> {
        self.placed(pose, self.motion.phase_at(t)[0])
    }

    /// Its nodes \[m\] where the hinge is here and the wing has this attitude, at the `phase` of the beat \[wingbeats\].
    pub fn placed(&self, (hinge, r): Pose, phase: f64) -> Vec<DVec3> {
        let moved = |x: DVec3| hinge + r * x;
        match &self.shape {
            None => self.nodes.iter().copied().map(moved).collect(),
            Some(shape) => {
                let places = shape.mesh.places(phase);
                shape.nodes.iter().map(|&n| moved(places[n])).collect()
            }
        }
    }

    /// Lines of this sheet, whose nodes are at `a`, that pass through triangles of the other, whose are at `b`, with the
    /// triangle and the point: lines between neighbours, and those over a node that lies in the triangle.
    pub fn piercing<'a>(
        &'a self,
        a: &'a [DVec3],
        other: &'a Self,
        b: &'a [DVec3],
    ) -> impl Iterator<Item = ([usize; 2], [DVec3; 3], DVec3)> + 'a {
        let touch = self.touch(other);
        let lines = self.near(a, b, self.lines().chain(self.lines_over_nodes()));
        lines.flat_map(move |[m, n]| {
            let over = self.node_between([m, n]);
            let over = over.map(|k| (a[k], self.is_between(a, k, b, touch)));
            let triangles = other.triangles().map(|t| t.map(|n| b[n]));
            triangles.filter_map(move |t| {
                let at = match over {
                    None => pierced([a[m], a[n]], t, touch),
                    Some((_, false)) => None,
                    Some((node, true)) => pierced_at(node, [a[m], a[n]], t, touch),
                };
                Some(([m, n], t, at?))
            })
        })
    }

    /// What is no more than a touch of the other sheet \[m\].
    pub fn touch(&self, other: &Self) -> f64 {
        TOUCH * (self.size + other.size)
    }

    /// Those of `lines` of this sheet, whose nodes are at `a`, that reach into the box around `b`.
    fn near<'a>(
        &'a self,
        a: &'a [DVec3],
        b: &[DVec3],
        lines: impl Iterator<Item = [usize; 2]> + 'a,
    ) -> impl Iterator<Item = [usize; 2]> + 'a {
        let [low, high] = bounds(b);
        let near =
            move |x: DVec3, y: DVec3| x.min(y).cmple(high).all() && x.max(y).cmpge(low).all();
        lines.filter(move |[m, n]| near(a[*m], a[*n]))
    }

    /// Nodes at the ends of the lines between neighbours.
    pub fn lines(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.lines_of(1)
    }

    /// Nodes at the ends of the lines over one node.
    fn lines_over_nodes(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.lines_of(2)
    }

    /// Nodes at the ends of the lines over so many panels, along the span and along the chord.
    fn lines_of(&self, panels: usize) -> impl Iterator<Item = [usize; 2]> + '_ {
        let (rows, columns) = (self.rows, self.columns);
        let along = (0..rows * columns).filter(move |n| n % columns + panels < columns);
        let across = 0..rows.saturating_sub(panels) * columns;
        along
            .map(move |n| [n, n + panels])
            .chain(across.map(move |n| [n, n + panels * columns]))
    }

    /// Whether a line goes along the span.
    pub fn is_along(&self, [m, n]: [usize; 2]) -> bool {
        n - m < self.columns
    }

    /// Whether nodes `b` of another sheet lie on both sides of this one, whose nodes are at `a`, as it is at its node `k`:
    /// one whose edge stands on it does not.
    fn is_between(&self, a: &[DVec3], k: usize, b: &[DVec3], touch: f64) -> bool {
        let (row, column) = (k / self.columns, k % self.columns);
        let beside = |at: usize, count: usize| [at.saturating_sub(1), (at + 1).min(count - 1)];
        let [left, right] = beside(column, self.columns).map(|j| a[row * self.columns + j]);
        let [fore, aft] = beside(row, self.rows).map(|i| a[i * self.columns + column]);
        let normal = (right - left).cross(aft - fore).normalize_or_zero();
        let heights = || b.iter().map(|x| (*x - a[k]).dot(normal));
        heights().any(|h| h > touch) && heights().any(|h| h < -touch)
    }

    /// The node in the middle of a line over one node.
    fn node_between(&self, line: [usize; 2]) -> Option<usize> {
        let [m, n] = line;
        let panels = match self.is_along(line) {
            true => n - m,
            false => (n - m) / self.columns,
        };
        (panels == 2).then(|| m.midpoint(n))
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

/// Corners of the box around points.
pub(super) fn bounds(points: &[DVec3]) -> [DVec3; 2] {
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    [low, high]
}

/// Where the line passes through the triangle, if it does and does not only `touch` \[m\] it.
fn pierced([x, y]: [DVec3; 2], triangle: [DVec3; 3], touch: f64) -> Option<DVec3> {
    let face = Face::new(triangle, touch)?;
    let [over, under] = face.heights_apart([x, y], touch)?;
    let p = x.lerp(y, over / (over - under));
    face.holds(p).then_some(p)
}

/// The node over which the line goes, if it lies in the triangle and the ends of the line on both sides of that.
fn pierced_at(node: DVec3, ends: [DVec3; 2], triangle: [DVec3; 3], touch: f64) -> Option<DVec3> {
    let face = Face::new(triangle, touch)?;
    face.heights_apart(ends, touch)?;
    (face.height(node).abs() <= touch && face.holds(node)).then_some(node)
}

/// A triangle with its unit normal and twice its area \[m2\].
struct Face {
    corners: [DVec3; 3],
    normal: DVec3,
    area: f64,
}

impl Face {
    /// None of one without area beside what is a `touch` \[m\].
    fn new([a, b, c]: [DVec3; 3], touch: f64) -> Option<Self> {
        let normal = (b - a).cross(c - a);
        let area = normal.length();
        (area > touch * touch).then(|| Self {
            corners: [a, b, c],
            normal: normal / area,
            area,
        })
    }

    /// Above its plane \[m\].
    fn height(&self, p: DVec3) -> f64 {
        (p - self.corners[0]).dot(self.normal)
    }

    /// Of two points on different sides of its plane, by more than a `touch` \[m\].
    fn heights_apart(&self, [x, y]: [DVec3; 2], touch: f64) -> Option<[f64; 2]> {
        let [over, under] = [self.height(x), self.height(y)];
        (over * under < 0.0 && over.abs().min(under.abs()) > touch).then_some([over, under])
    }

    /// Whether a point of its plane is in it.
    fn holds(&self, p: DVec3) -> bool {
        let [a, b, c] = self.corners;
        let inside =
            |[u, v]: [DVec3; 2]| (v - u).cross(p - u).dot(self.normal) >= -EDGE * self.area;
        [[a, b], [b, c], [c, a]].into_iter().all(inside)
    }
}
