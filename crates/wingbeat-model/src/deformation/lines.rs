//! Lines of nodes along the chord of a mesh.

use crate::mesh::GridMesh;

/// Distance from the hinge along the span, leading edge and chord of a column of nodes \[m\].
pub(crate) fn column(mesh: &GridMesh, j: usize) -> (f64, f64, f64) {
    let (lead, trail) = (
        mesh.nodes[mesh.node(0, j)],
        mesh.nodes[mesh.node(mesh.rows, j)],
    );
    (lead.y.abs(), lead.x, lead.x - trail.x)
}

/// Least and largest distance of the leading edge from the hinge along the span \[m\].
pub(crate) fn span(mesh: &GridMesh) -> [f64; 2] {
    let r = (0..=mesh.cols).map(|j| column(mesh, j).0);
    r.fold([f64::INFINITY, 0.0], |[a, b], r| [a.min(r), b.max(r)])
}
