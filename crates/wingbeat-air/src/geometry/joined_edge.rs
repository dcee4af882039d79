//! Surfaces joined along an edge: two halves of one lifting surface.
//!
//! Joined edges are interior edges like any other: filaments with the difference of the
//! circulations on either side, so no vortex leaves there and the sheet is continuous. The joined
//! nodes exist on both surfaces, and so do the wake nodes they leave; both are kept in one place.

use crate::edges::EdgeKind;
use crate::error::AirError;
use crate::geometry::surface::{SheddingSegment, Surface};

/// An edge line that two open surfaces share, whose normals must agree across it; or that one surface shares with its
/// own mirror image, on one of [`crate::AirSettings::images`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JoinedEdge {
    /// Numbers of the surfaces; twice the same of an edge on a plane.
    pub surfaces: [usize; 2],
    /// Nodes along the line, each counted in its surface: one of the first, one of the second.
    pub nodes: Vec<[usize; 2]>,
}

impl JoinedEdge {
    /// The edge of a surface with these nodes, in succession, that lies on a plane of images.
    pub fn on_plane(surface: usize, nodes: impl IntoIterator<Item = usize>) -> Self {
        Self {
            surfaces: [surface; 2],
            nodes: nodes.into_iter().map(|n| [n; 2]).collect(),
        }
    }

    /// Whether it lies on a plane of images.
    pub(crate) fn is_on_plane(&self) -> bool {
        self.surfaces[0] == self.surfaces[1] && self.nodes.iter().all(|n| n[0] == n[1])
    }
}

/// Checks joined edges against the surfaces.
///
/// # Errors
/// [`AirError::JoinedEdge`] says what does not fit.
pub(crate) fn check_joined_edges(
    joined: &[JoinedEdge],
    surfaces: &[Surface],
) -> Result<(), AirError> {
    for (edge, j) in joined.iter().enumerate() {
        let wrong = |problem: &'static str| Err(AirError::JoinedEdge { edge, problem });
        let [a, b] = j.surfaces;
        let (Some(first), Some(second)) = (surfaces.get(a), surfaces.get(b)) else {
            return wrong("there is no such surface");
        };
        if (a == b && !j.is_on_plane()) || first.closed || second.closed {
            return wrong(
                "a joined edge belongs to two different open surfaces, or lies on a plane of images",
            );
        }
        if j.nodes.len() < 2 {
            return wrong("a joined edge needs at least two pairs of nodes");
        }
        let inside = |n: &[usize; 2]| n[0] < first.node_count && n[1] < second.node_count;
        if !j.nodes.iter().all(inside) {
            return wrong("a node does not exist");
        }
        let along_strips = |side: usize| {
            let ends = |s: &SheddingSegment| {
                let is = |pair: &[[usize; 2]]| [pair[0][side], pair[1][side]];
                (j.nodes.windows(2)).any(|w| is(w) == [s.from, s.to] || is(w) == [s.to, s.from])
            };
            let segments = surfaces[j.surfaces[side]].shedding.iter().flatten();
            let across =
                |s: &&SheddingSegment| matches!(s.kind, EdgeKind::Leading | EdgeKind::Trailing);
            segments.filter(across).any(ends)
        };
        if along_strips(0) || along_strips(1) {
            return wrong("leading and trailing edges are not joined: roots and tips are");
        }
    }
    Ok(())
}
