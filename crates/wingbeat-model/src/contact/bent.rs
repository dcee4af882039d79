//! The shape of a wing that loads bend, from its sections at quarters of its length.

use crate::contact::sheet::lines;
use crate::mesh::GridMesh;
use wingbeat_math::{DMat3, DVec2, DVec3};

/// Sections at 1/4, 1/2, 3/4 and the whole of the length of a wing.
const SECTIONS: usize = 4;

/// How a wing is bent, against its shape at rest: what a history knows of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bending {
    /// Per section: displacement of the middle of its chord along axis 3 of the wing \[m\], twist, positive like
    /// feathering \[rad\], camber over the chord, positive towards -axis 3 \[1\].
    pub sections: [[f64; 3]; SECTIONS],
    /// Displacement of the middle of the tip along axes 1 and 2 of the wing \[m\].
    pub tip: DVec2,
    /// Whether the root keeps its place; else it goes on as the sections do.
    pub is_held: bool,
}

impl Bending {
    /// Displacement, twist and camber at this part of the length from the root \[1\]: the polynomial through those
    /// of the sections and, where it is held, of the root.
    fn at(&self, part: f64) -> [f64; 3] {
        let first = usize::from(!self.is_held);
        let place = |k: usize| k as f64 / SECTIONS as f64;
        let mut sum = [0.0; 3];
        for k in 1..=SECTIONS {
            let others = (first..=SECTIONS).filter(|j| *j != k);
            let weight: f64 = others
                .map(|j| (part - place(j)) / (place(k) - place(j)))
                .product();
            for (s, of) in sum.iter_mut().zip(self.sections[k - 1]) {
                *s += weight * of;
            }
        }
        sum
    }
}

/// Which of the nodes of a sheet lie in a section of the wing.
#[derive(Clone, Debug)]
pub(super) struct Column {
    /// Distance from the root over the length \[1\].
    part: f64,
    /// From the leading edge backwards: distance over the chord \[1\].
    along: Vec<f64>,
}

impl Column {
    /// Those of the sheet of a wing with this mesh, on these of its rows and columns.
    pub fn all(mesh: &GridMesh, most: [usize; 2]) -> Vec<Self> {
        let rows = lines(mesh.rows, most[0]);
        let out = |j: usize| (mesh.nodes[mesh.node(0, j)].y - mesh.nodes[0].y).abs();
        let column = |j: usize| {
            let place = |i: usize| mesh.nodes[mesh.node(i, j)];
            let (lead, trail) = (place(0), place(mesh.rows));
            let chord = (trail - lead).length_squared().max(f64::MIN_POSITIVE);
            let along = |&i: &usize| (place(i) - lead).dot(trail - lead) / chord;
            Column {
                part: out(j) / out(mesh.cols).max(f64::MIN_POSITIVE),
                along: rows.iter().map(along).collect(),
            }
        };
        lines(mesh.cols, most[1]).into_iter().map(column).collect()
    }
}

/// Moves nodes of a sheet from rest to where the wing is bent \[m\], wing components: every section turns about the
/// middle of its chord and is cambered by a parabola; displacements in the plane of the wing grow with the square of
/// the distance from the root.
pub(super) fn bend(nodes: &mut [DVec3], columns: &[Column], bending: &Bending) {
    let (count, rows) = (columns.len(), nodes.len() / columns.len());
    for (j, column) in columns.iter().enumerate() {
        let [deflection, twist, camber] = bending.at(column.part);
        let (lead, trail) = (nodes[j], nodes[(rows - 1) * count + j]);
        let (middle, chord) = (lead.midpoint(trail), lead.distance(trail));
        let turn = DMat3::from_rotation_y(twist);
        let moved = middle + (column.part.powi(2) * bending.tip).extend(deflection);
        for (i, along) in column.along.iter().enumerate() {
            let x = &mut nodes[i * count + j];
            let height = 4.0 * camber * chord * along * (1.0 - along);
            *x = moved + turn * (*x - middle - DVec3::new(0.0, 0.0, height));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::sheet::LINES;
    use crate::{Planform, Side, WingShape};

    /// A cantilever of length 1 under a force at its tip is bent by `(3 s^2 - s^3) / 2` of the displacement there, a
    /// clamped shaft under a moment at its tip turned in proportion to s: between the sections, too.
    #[test]
    fn exact_shape_of_a_cantilever_that_bends_and_twists() {
        let planform = Planform::Outline {
            leading: vec![(0.0, 0.2), (1.0, 0.2)],
            trailing: vec![(0.0, -0.3), (1.0, -0.3)],
            least_chord: 0.1,
        };
        let mesh = WingShape::uniform(planform, 4, 10)
            .mesh("wing", Side::Right)
            .unwrap();
        let bent = |s: f64| 0.1 * (3.0 * s * s - s.powi(3));
        let bending = Bending {
            sections: [0.25, 0.5, 0.75, 1.0].map(|s| [bent(s), 0.3 * s, 0.0]),
            tip: DVec2::new(0.0, -0.02),
            is_held: true,
        };
        let mut nodes = mesh.nodes.clone();
        bend(&mut nodes, &Column::all(&mesh, LINES), &bending);
        for (x, rest) in nodes.iter().zip(&mesh.nodes) {
            let (s, ahead) = (rest.y, rest.x + 0.05); // of the middle of the chord
            let (sin, cos) = (0.3 * s).sin_cos();
            let middle = DVec3::new(-0.05, s - 0.02 * s * s, bent(s));
            let expected = middle + ahead * DVec3::new(cos, 0.0, -sin);
            assert!(x.distance(expected) < 1e-14, "{x} {expected}"); // roundings
        }
    }

    /// Of a free root no more is known than of the sections: a motion in proportion to the span goes on to it, and a
    /// section that is an arc of a parabola keeps its edges.
    #[test]
    fn exact_shape_of_a_free_and_cambered_wing() {
        let planform = Planform::Outline {
            leading: vec![(0.0, 0.2), (1.0, 0.2)],
            trailing: vec![(0.0, -0.3), (1.0, -0.3)],
            least_chord: 0.1,
        };
        let mesh = WingShape::uniform(planform, 4, 10)
            .mesh("wing", Side::Right)
            .unwrap();
        let bending = Bending {
            sections: [0.25, 0.5, 0.75, 1.0].map(|s| [0.1 - 0.2 * s, 0.0, 0.04]),
            ..Bending::default()
        };
        let mut nodes = mesh.nodes.clone();
        bend(&mut nodes, &Column::all(&mesh, LINES), &bending);
        for (x, rest) in nodes.iter().zip(&mesh.nodes) {
            let part = (rest.x + 0.05) / 0.25;
            let height = 0.04 * 0.5 * (1.0 - part * part);
            let expected = *rest + DVec3::new(0.0, 0.0, 0.1 - 0.2 * rest.y - height);
            assert!(x.distance(expected) < 1e-14, "{x} {expected}"); // roundings
        }
    }
}
