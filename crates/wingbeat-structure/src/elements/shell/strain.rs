//! Strains of a quadrilateral as bilinear forms of the nodes' positions and axes.
//!
//! Every strain is a sum of products `(sum_i a_i x_i) . (sum_j b_j v_j)` where x are the places of the nodes
//! and v places or one of three axes that turn with a node (the fibre axis, its perpendicular, the normal).
//! Such forms do not change under any rigid motion, and their second derivatives are constants.

use wingbeat_math::DVec3;

use super::geometry::Quad;

/// Number of strains.
pub(super) const STRAINS: usize = 18;

/// Stiffness by strain and strain.
pub(super) type Stiffness = [[f64; STRAINS]; STRAINS];

/// Strains that are coupled by stiffness lie in one block; first number and length.
pub(super) const BLOCKS: [[usize; 2]; 4] = [
    [MEMBRANE, 3],
    [IN_PLANE_BENDING, 2],
    [CURVATURE, BENDING],
    [DRILL, 4],
];

/// Number of strains that bend: curvature, its hourglass, transverse shear.
pub(super) const BENDING: usize = 9;

/// Mean strains of Green 11, 22, 2 x 12 \[1\].
pub(super) const MEMBRANE: usize = 0;
/// Amplitudes of in-plane bending along axes 1 and 2 \[m\].
pub(super) const IN_PLANE_BENDING: usize = 3;
/// Changes of curvature at the centre 11, 22, 2 x 12 \[1/m\].
pub(super) const CURVATURE: usize = 5;
/// Amplitudes of the part of the curvature that varies over the element \[1\].
pub(super) const CURVATURE_HOURGLASS: usize = 8;
/// Transverse shear at the middle of the [`EDGES`], covariant: half the edge times the shear \[m\].
pub(super) const SHEAR: usize = 10;
/// Turn of each node about the normal against that of the surface \[1\].
pub(super) const DRILL: usize = 14;

/// Corners of the edges whose transverse shear counts.
pub(super) const EDGES: [[usize; 2]; 4] = [[0, 1], [3, 2], [0, 3], [1, 2]];

/// Places of the nodes among the vectors of [`Vectors`]; 1 to 3 are the axes.
const PLACE: usize = 0;
const NORMAL: usize = 3;

/// Places and axes of the four corners, W components.
pub(super) type Vectors = [[DVec3; 4]; 4];

/// One product in one strain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Term {
    /// Number of the strain.
    pub strain: usize,
    /// Weights of the places in the left vector, with the product's factor.
    pub left: [f64; 4],
    /// Which vectors the right one combines.
    pub family: usize,
    /// Their weights.
    pub right: [f64; 4],
}

impl Term {
    /// The two vectors of the product.
    pub fn vectors(&self, v: &Vectors) -> [DVec3; 2] {
        [
            combine(&self.left, &v[PLACE]),
            combine(&self.right, &v[self.family]),
        ]
    }

    /// Whether the right vector is one of places.
    pub fn quadratic(&self) -> bool {
        self.family == PLACE
    }
}

fn combine(weights: &[f64; 4], v: &[DVec3; 4]) -> DVec3 {
    weights[0] * v[0] + weights[1] * v[1] + weights[2] * v[2] + weights[3] * v[3]
}

fn scaled(factor: f64, weights: [f64; 4]) -> [f64; 4] {
    weights.map(|w| factor * w)
}

/// All products of all strains of a quadrilateral.
pub(super) fn terms(quad: &Quad) -> Vec<Term> {
    let mut all = vec![];
    membrane(quad, &mut all);
    curvature(quad, &mut all);
    shear(&mut all);
    drill(quad, &mut all);
    all
}

/// Weights of the derivative along axis 1 and 2 at the centre.
fn derivatives(quad: &Quad) -> [[f64; 4]; 2] {
    [quad.gradient.map(|b| b.x), quad.gradient.map(|b| b.y)]
}

/// Mean of Green's strain, and its linear part: `(x,a . x,b - rest) / 2` with x,a = F_a + g h,a; the latter is
/// in-plane bending, whose shear is left out [Belytschko & Bachrach 1986].
fn membrane(quad: &Quad, all: &mut Vec<Term>) {
    let [b1, b2] = derivatives(quad);
    let [h11, h22, h12] = quad.roughness.map(|h| h / quad.area);
    let g = quad.gamma;
    let mut place = |strain, left, right| {
        all.push(Term {
            strain,
            left,
            family: PLACE,
            right,
        });
    };
    place(MEMBRANE, scaled(0.5, b1), b1);
    place(MEMBRANE, scaled(0.5 * h11, g), g);
    place(MEMBRANE + 1, scaled(0.5, b2), b2);
    place(MEMBRANE + 1, scaled(0.5 * h22, g), g);
    place(MEMBRANE + 2, b1, b2);
    place(MEMBRANE + 2, scaled(h12, g), g);
    place(IN_PLANE_BENDING, b1, g);
    place(IN_PLANE_BENDING + 1, b2, g);
}

/// `(x,a . t,b + x,b . t,a) / 2 - rest` with x,a at the centre and t,b = T_b + tau h,b.
fn curvature(quad: &Quad, all: &mut Vec<Term>) {
    let [b1, b2] = derivatives(quad);
    let mut bend = |strain, left, right| {
        all.push(Term {
            strain,
            left,
            family: NORMAL,
            right,
        });
    };
    bend(CURVATURE, b1, b1);
    bend(CURVATURE + 1, b2, b2);
    bend(CURVATURE + 2, b1, b2);
    bend(CURVATURE + 2, b2, b1);
    bend(CURVATURE_HOURGLASS, b1, quad.gamma);
    bend(CURVATURE_HOURGLASS + 1, b2, quad.gamma);
}

/// Half the edge times the mean normal of its ends [Dvorkin & Bathe 1984].
fn shear(all: &mut Vec<Term>) {
    for (k, [from, to]) in EDGES.into_iter().enumerate() {
        let (mut left, mut right) = ([0.0; 4], [0.0; 4]);
        (left[from], left[to]) = (-0.5, 0.5);
        (right[from], right[to]) = (0.5, 0.5);
        all.push(Term {
            strain: SHEAR + k,
            left,
            family: NORMAL,
            right,
        });
    }
}

/// `(x,2 . d_1 - x,1 . d_2) / 2` for the axes d of each node [Hughes & Brezzi 1989].
fn drill(quad: &Quad, all: &mut Vec<Term>) {
    let [b1, b2] = derivatives(quad);
    for node in 0..4 {
        let mut right = [0.0; 4];
        right[node] = 1.0;
        for (family, left) in [(1, scaled(0.5, b2)), (2, scaled(-0.5, b1))] {
            all.push(Term {
                strain: DRILL + node,
                left,
                family,
                right,
            });
        }
    }
}
