//! Lines of nodes along the chord of a mesh.

use wingbeat_math::DVec3;

use crate::mesh::GridMesh;

/// Height of an edge above the plane of axes 1 and 2 over the wing length that is rounding \[1\].
const FLAT: f64 = 1e-9;

/// Whether both edges lie in the plane of axes 1 and 2.
pub(crate) fn is_flat(mesh: &GridMesh) -> bool {
    let length = span(mesh)[1];
    let edge = |i: usize| (0..=mesh.cols).map(move |j| mesh.nodes[mesh.node(i, j)].z.abs());
    edge(0).chain(edge(mesh.rows)).all(|z| z <= FLAT * length)
}

/// Leading edge and chord, from the trailing to the leading edge, of a column of nodes \[m\], wing components.
/// On a flat mesh chords are along axis 1.
pub(crate) fn chord_line(mesh: &GridMesh, j: usize) -> [DVec3; 2] {
    let [lead, trail] = [0, mesh.rows].map(|i| mesh.nodes[mesh.node(i, j)]);
    let chord = lead - trail;
    match is_flat(mesh) {
        true => [lead, DVec3::new(chord.x, 0.0, 0.0)],
        false => [lead, chord],
    }
}

/// Place of node (i, j) behind the leading edge over the chord \[1\].
pub(crate) fn behind(mesh: &GridMesh, i: usize, j: usize) -> f64 {
    let node = mesh.nodes[mesh.node(i, j)];
    match is_flat(mesh) {
        true => {
            let (_, lead, chord) = column(mesh, j);
            (lead - node.x) / chord
        }
        false => {
            let [lead, chord] = chord_line(mesh, j);
            (lead - node).dot(chord) / chord.length_squared()
        }
    }
}

/// Directions of chord (forward) and span (outward) of the strip between columns j and j + 1, wing components;
/// axes 1 and 2 on a flat mesh.
pub(crate) fn strip_axes(mesh: &GridMesh, j: usize) -> [DVec3; 2] {
    let [[a, inner], [b, outer]] = [j, j + 1].map(|j| chord_line(mesh, j));
    if is_flat(mesh) {
        let root = mesh.nodes[mesh.node(0, 0)].y;
        let tip = mesh.nodes[mesh.node(0, mesh.cols)].y;
        return [DVec3::X, DVec3::new(0.0, (tip - root).signum(), 0.0)];
    }
    let e1 = (inner + outer).normalize();
    let along = (b - 0.5 * outer) - (a - 0.5 * inner);
    [e1, (along - along.dot(e1) * e1).normalize()]
}

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
