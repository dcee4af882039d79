//! Edges of wings that lie on planes of images, joined to their own mirror images there.

use wingbeat_air::{EdgeKind, JoinedEdge, NodeMotion, Plane};
use wingbeat_math::DVec3;
use wingbeat_model::GridMesh;

use crate::error::FlightError;

/// How far off a plane an edge lies that is on it, over its length \[1\].
pub const ON_PLANE: f64 = 1e-6;

/// An edge of a wing that lies on a plane of images, or near it.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeOnPlane {
    /// The wing, by its number.
    pub wing: usize,
    /// Root or tip.
    pub kind: EdgeKind,
    /// The plane.
    pub plane: Plane,
    /// How far it is from the plane at time zero and at most during the flight, over its length \[1\]; the latter is
    /// infinite where the flyer is free.
    pub off: [f64; 2],
}

impl EdgeOnPlane {
    /// What the edge is called.
    pub fn edge(&self) -> &'static str {
        match self.kind {
            EdgeKind::Tip => "tip",
            _ => "root",
        }
    }

    /// Whether it stays on the plane all along, and so is an interior edge of the wing and its image.
    pub fn is_joined(&self) -> bool {
        self.off[1] <= ON_PLANE
    }
}

/// An edge of a wing on a plane of images. Where its wing bends off the plane, the edge lies on it all the same, as
/// midway between wing and image.
#[derive(Clone, Debug)]
pub struct OnPlane {
    /// The wing, by its number.
    pub wing: usize,
    name: String,
    plane: Plane,
    /// Its nodes among all nodes.
    nodes: Vec<usize>,
    /// How far they may leave the plane [m]: a quarter of the width of the panels there.
    limit: f64,
}

impl OnPlane {
    /// An edge of the wing called `name`, with its nodes and those of the column next to it, all nodes being `local` \[m\]
    /// in the frames of their bodies.
    pub fn new(
        name: &str,
        edge: &EdgeOnPlane,
        [nodes, next]: [Vec<usize>; 2],
        local: &[DVec3],
    ) -> Self {
        let widths = nodes.iter().zip(next);
        let widths = widths.map(|(&a, b)| local[a].distance(local[b]));
        Self {
            wing: edge.wing,
            name: name.to_owned(),
            plane: edge.plane,
            limit: 0.25 * widths.fold(f64::INFINITY, f64::min),
            nodes,
        }
    }

    /// Its nodes among all nodes.
    pub fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    /// The same in the words of the lattice; `first` is the first node of the wing.
    pub fn joined_edge(&self, first: usize) -> JoinedEdge {
        JoinedEdge::on_plane(self.wing, self.nodes.iter().map(|n| n - first))
    }

    /// Puts its nodes on the plane at time `t` \[s\].
    ///
    /// # Errors
    /// They are too far from it.
    pub fn place(&self, t: f64, out: &mut NodeMotion) -> Result<(), FlightError> {
        for &n in &self.nodes {
            let gap = self.plane.height(out.position[n]).abs();
            if gap > self.limit {
                return Err(FlightError::OffPlane {
                    wing: self.name.clone(),
                    time: t,
                    gap,
                    limit: self.limit,
                });
            }
            out.position[n] = self.plane.foot(out.position[n]);
            out.velocity[n] = self.plane.along(out.velocity[n]);
        }
        Ok(())
    }
}

/// Nodes of the root or tip of a mesh whose first node has this number, from leading to trailing edge, and of the
/// column of nodes next to it.
pub fn columns_of(mesh: &GridMesh, first: usize, kind: EdgeKind) -> [Vec<usize>; 2] {
    let columns = match kind {
        EdgeKind::Tip => [mesh.cols, mesh.cols - 1],
        _ => [0, 1],
    };
    columns.map(|j| (0..=mesh.rows).map(|i| first + mesh.node(i, j)).collect())
}
