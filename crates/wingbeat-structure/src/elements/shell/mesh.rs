//! Shells on the panels of a lattice.

use wingbeat_math::{DQuat, DVec3};

use super::{Shell, ShellError, ShellSection};
use crate::nodes::configuration::Configuration;

/// Nodes of a structure on the points of a lattice, points that coincide being one node, and the quadrilaterals between
/// them.
///
/// ```
/// use wingbeat_math::DVec3;
/// use wingbeat_structure::ShellMesh;
/// // Two panels of a wing that ends in a point: both tip points are one node.
/// let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
/// let points = [at(0.0, 0.0), at(0.1, 1.0), at(0.5, 2.0), at(1.0, 0.0), at(0.9, 1.0), at(0.5, 2.0)];
/// let mesh = ShellMesh::grid(&points, 1, 2).unwrap();
/// assert_eq!(mesh.node_of, [0, 1, 2, 3, 4, 2]);
/// assert_eq!(mesh.panels, [Some([0, 1, 4, 3]), Some([1, 2, 2, 4])]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ShellMesh {
    /// Nodes of the structure at rest, W components, attitudes those of W.
    pub rest: Configuration,
    /// Node of each point of the lattice.
    pub node_of: Vec<usize>,
    /// Nodes of each panel of the lattice, counted about its normal; none where the panel has no area.
    pub panels: Vec<Option<[usize; 4]>>,
}

/// Distance below which points are one node, in parts of the lattice's largest extent.
const COINCIDENT: f64 = 1e-9;

impl ShellMesh {
    /// From the points \[m\] of a lattice of `rows` x `cols` panels, point (i, j) at `i (cols + 1) + j`, panel
    /// (i, j) at `i cols + j` with the points (i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j).
    ///
    /// # Errors
    /// [`ShellError::Lattice`] if the number of points is not `(rows + 1) (cols + 1)` or one is not finite.
    pub fn grid(points: &[DVec3], rows: usize, cols: usize) -> Result<Self, ShellError> {
        let expected = (rows + 1) * (cols + 1);
        if points.len() != expected || points.iter().any(|x| !x.is_finite()) {
            let found = points.len();
            return Err(ShellError::Lattice { found, expected });
        }
        let (position, node_of) = merged(points);
        let nodes = |i: usize, j: usize| {
            let p = i * (cols + 1) + j;
            [p, p + 1, p + cols + 2, p + cols + 1].map(|p| node_of[p])
        };
        let panel = |k: usize| proper(nodes(k / cols, k % cols));
        let panels = (0..rows * cols).map(panel).collect();
        let rotation = vec![DQuat::IDENTITY; position.len()];
        Ok(Self {
            rest: Configuration { position, rotation },
            node_of,
            panels,
        })
    }

    /// A shell on each panel that has an area and a section: `section` answers for panel k, none where there is a hole.
    ///
    /// # Errors
    /// As [`Shell::new`].
    pub fn shells(
        &self,
        mut section: impl FnMut(usize) -> Option<ShellSection>,
    ) -> Result<Vec<Shell>, ShellError> {
        let mut all = vec![];
        for (k, panel) in self.panels.iter().enumerate() {
            if let (Some(nodes), Some(section)) = (panel, section(k)) {
                all.push(Shell::new(&self.rest, *nodes, &section)?);
            }
        }
        Ok(all)
    }
}

/// Points without those that coincide with an earlier one, and the number each got.
fn merged(points: &[DVec3]) -> (Vec<DVec3>, Vec<usize>) {
    let extent = points.iter().map(|x| x.distance(points[0]));
    let near = COINCIDENT * extent.fold(0.0, f64::max);
    let mut kept: Vec<DVec3> = vec![];
    let number = |x: &DVec3| {
        let known = kept.iter().position(|y| y.distance(*x) <= near);
        known.unwrap_or_else(|| {
            kept.push(*x);
            kept.len() - 1
        })
    };
    let node_of = points.iter().map(number).collect();
    (kept, node_of)
}

/// The nodes, if they are at least three, equal ones being neighbours.
fn proper(n: [usize; 4]) -> Option<[usize; 4]> {
    let sides = (0..4).filter(|&k| n[k] != n[(k + 1) % 4]).count();
    (sides >= 3 && n[0] != n[2] && n[1] != n[3]).then_some(n)
}
