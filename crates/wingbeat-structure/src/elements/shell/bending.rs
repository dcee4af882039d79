//! Bending and transverse shear of a quadrilateral: discrete Kirchhoff-Mindlin.
//!
//! An edge whose chord and mean normal are not perpendicular bends as a cubic: between its ends the normal has
//! a quadratic part along the edge, `-3 gamma / (l (1 + phi))` at the middle, that the curvature of the element
//! takes up; transverse shear proper is the part `phi / (1 + phi)` of gamma, `phi = 12 D / (S l^2)`. So shear
//! never locks, nothing is stiffer than bending however thin the sheet is, and thick plates keep their shear
//! [Batoz & Ben Tahar 1982 (DKQ); Katili 1993 (DKMQ)].

use wingbeat_math::{DMat3, DVec2, DVec3};

use super::ShellSection;
use super::geometry::{CORNER, GAUSS, Quad, contravariant, jacobian};
use super::strain::{BENDING, CURVATURE, EDGES, SHEAR, Stiffness};

/// Strains that bend per unit of each strain, at one point.
type Interpolation = [DVec3; BENDING];

/// An edge of the quadrilateral.
#[derive(Clone, Copy)]
struct Edge {
    /// Quadratic part of the normal per unit of shear, in the axes \[1/m\].
    bulge: DVec2,
    /// Part of its shear that is transverse shear of the sheet \[1\].
    part: f64,
}

/// Adds the stiffness of curvature, its hourglass and shear, all of which are coupled.
pub(super) fn bending(quad: &Quad, section: &ShellSection, c: &mut Stiffness) {
    if section.bending == DMat3::ZERO {
        return;
    }
    let edges = EDGES.map(|[from, to]| edge(quad.flat[to] - quad.flat[from], section));
    for point in CORNER {
        let at = point.map(|n| GAUSS * n);
        let basis = jacobian(quad.flat, at);
        let weight = basis[0].perp_dot(basis[1]);
        let curvature = interpolation(&edges, basis, at);
        for (i, a) in curvature.iter().enumerate() {
            let moment = weight * (section.bending * *a);
            for (j, b) in curvature.iter().enumerate() {
                c[CURVATURE + i][CURVATURE + j] += moment.dot(*b);
            }
        }
    }
    shear(quad, section, &edges, c);
}

/// Bulge and shear of the edge `r` \[m\].
fn edge(r: DVec2, section: &ShellSection) -> Edge {
    let square = r.length_squared();
    if square == 0.0 {
        return Edge {
            bulge: DVec2::ZERO,
            part: 0.0,
        };
    }
    let phi = 12.0 * strip(section, r) / (section.shear * square);
    Edge {
        bulge: r * (-3.0 / (square * (1.0 + phi))),
        part: phi / (1.0 + phi),
    }
}

/// Bending stiffness of a strip in direction `r` \[N m\].
fn strip(section: &ShellSection, r: DVec2) -> f64 {
    let [c, s] = r.normalize().to_array();
    let v = DVec3::new(c * c, s * s, 2.0 * c * s);
    v.dot(section.bending * v)
}

/// Curvatures 11, 22, 2 x 12 per unit of each strain that bends, at a point with the covariant basis `basis`.
fn interpolation(edges: &[Edge; 4], basis: [DVec2; 2], [xi, eta]: [f64; 2]) -> Interpolation {
    let mut all = [DVec3::ZERO; BENDING];
    (all[0], all[1], all[2]) = (DVec3::X, DVec3::Y, DVec3::Z);
    let h = contravariant(basis, DVec2::new(eta, xi));
    (all[3], all[4]) = (DVec3::new(h.x, 0.0, h.y), DVec3::new(0.0, h.y, h.x));
    // Derivatives of (1 - xi^2) (1 -+ eta) / 2 and (1 - eta^2) (1 -+ xi) / 2.
    let (p, q) = (0.5 * (1.0 - xi * xi), 0.5 * (1.0 - eta * eta));
    let slopes = [
        DVec2::new(-xi * (1.0 - eta), -p),
        DVec2::new(-xi * (1.0 + eta), p),
        DVec2::new(-q, -eta * (1.0 - xi)),
        DVec2::new(q, -eta * (1.0 + xi)),
    ];
    for ((out, edge), slope) in all[5..].iter_mut().zip(edges).zip(slopes) {
        let (b, d) = (edge.bulge, contravariant(basis, slope));
        *out = DVec3::new(b.x * d.x, b.y * d.y, b.x * d.y + b.y * d.x);
    }
    all
}

/// Transverse shear, covariant, linear between opposite edges [Dvorkin & Bathe 1984].
fn shear(quad: &Quad, section: &ShellSection, edges: &[Edge; 4], c: &mut Stiffness) {
    let [a, b] = quad.basis;
    let (aa, bb, ab) = (a.length_squared(), b.length_squared(), a.dot(b));
    let scale = quad.area * section.shear / (aa * bb - ab * ab);
    for i in 0..4 {
        for j in 0..4 {
            // Mean of two edges' products; their difference varies linearly, its mean square is a third.
            let metric = match (i / 2, j / 2) {
                (0, 0) => bb,
                (1, 1) => aa,
                _ => -ab,
            };
            let share = match (i / 2 == j / 2, i == j) {
                (true, true) => 1.0 / 3.0,
                (true, false) => 1.0 / 6.0,
                _ => 0.25,
            };
            let both = edges[i].part * edges[j].part;
            c[SHEAR + i][SHEAR + j] += scale * metric * share * both;
        }
    }
}
