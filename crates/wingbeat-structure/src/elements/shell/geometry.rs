//! A quadrilateral at rest: axes, gradients, hourglass, area.

use wingbeat_math::{DMat3, DVec2, DVec3, MassProperties, outer};

use super::{ShellError, ShellSection};

/// Natural coordinates of the corners.
pub(super) const CORNER: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// Products of the natural coordinates at the corners: the hourglass.
const HOURGLASS: [f64; 4] = [1.0, -1.0, 1.0, -1.0];

/// Gauss' points of two, weight one each \[1\].
pub(super) const GAUSS: f64 = 0.577_350_269_189_625_8;

/// Part of the longest diagonal's square that the area has at least: below, the quadrilateral is a line \[1\].
const MIN_AREA: f64 = 1e-9;

/// A quadrilateral at rest. Two neighbouring corners may coincide: a triangle.
#[derive(Clone, Debug)]
pub(super) struct Quad {
    /// Fibre axis, its perpendicular in the tangent plane and the normal at the centre, as columns, W components.
    pub axes: DMat3,
    /// Gradients of the shape functions at the centre \[1/m\].
    pub gradient: [DVec2; 4],
    /// Amplitudes of the hourglass, orthogonal to linear fields \[1\] [Flanagan & Belytschko 1981, eq. 41].
    pub gamma: [f64; 4],
    /// Integrals of products of the hourglass' gradients: 11, 22, 12 \[1\].
    pub roughness: [f64; 3],
    /// Area \[m2\].
    pub area: f64,
    /// Covariant basis at the centre \[m\], in the axes.
    pub basis: [DVec2; 2],
    /// Corners in the tangent plane \[m\], in the axes, from corner 0.
    pub flat: [DVec2; 4],
}

impl Quad {
    /// From its corners \[m\], W components, counted about the normal, and the direction of the fibres.
    pub fn new(corners: [DVec3; 4], axis: DVec3) -> Result<Self, ShellError> {
        let axes = axes(corners, axis)?;
        let flat = corners.map(|x| {
            let r = axes.transpose() * (x - corners[0]);
            DVec2::new(r.x, r.y)
        });
        let basis = jacobian(flat, [0.0; 2]);
        let gradient = CORNER.map(|n| contravariant(basis, DVec2::from_array(n) * 0.25));
        let gamma = gamma(flat, gradient);
        Ok(Self {
            axes,
            gradient,
            gamma,
            roughness: roughness(flat),
            area: 4.0 * basis[0].perp_dot(basis[1]),
            basis,
            flat,
        })
    }
}

/// Axes at the centre: the fibres' direction in the tangent plane, its perpendicular, the normal.
fn axes(c: [DVec3; 4], axis: DVec3) -> Result<DMat3, ShellError> {
    let (p, q) = (c[2] - c[0], c[3] - c[1]);
    let normal = p.cross(q);
    let size = p.length_squared().max(q.length_squared());
    if normal.length().partial_cmp(&(MIN_AREA * size)) != Some(std::cmp::Ordering::Greater) {
        return Err(ShellError::NoArea { corners: c });
    }
    let n = normal.normalize();
    let fibre = axis - axis.dot(n) * n;
    if fibre.length().partial_cmp(&(1e-6 * axis.length())) != Some(std::cmp::Ordering::Greater) {
        return Err(ShellError::Axis { axis, normal: n });
    }
    let e1 = fibre.normalize();
    Ok(DMat3::from_cols(e1, n.cross(e1), n))
}

/// Derivatives of the position by the natural coordinates.
pub(super) fn jacobian(x: [DVec2; 4], at: [f64; 2]) -> [DVec2; 2] {
    let mut basis = [DVec2::ZERO; 2];
    for (x, n) in x.iter().zip(CORNER) {
        basis[0] += 0.25 * n[0] * (1.0 + n[1] * at[1]) * *x;
        basis[1] += 0.25 * n[1] * (1.0 + n[0] * at[0]) * *x;
    }
    basis
}

/// The gradient whose products with the basis are `d`.
pub(super) fn contravariant(basis: [DVec2; 2], d: DVec2) -> DVec2 {
    let [a, b] = basis;
    DVec2::new(d.x * b.y - d.y * a.y, d.y * a.x - d.x * b.x) / a.perp_dot(b)
}

/// `gamma_i = (h_i - (h . x) b_i) / 4`: the amplitude of the hourglass in nodal values.
fn gamma(x: [DVec2; 4], gradient: [DVec2; 4]) -> [f64; 4] {
    let moment: DVec2 = (0..4).map(|i| HOURGLASS[i] * x[i]).sum();
    std::array::from_fn(|i| 0.25 * (HOURGLASS[i] - moment.dot(gradient[i])))
}

/// Integrals of `h,a h,b` over the area, h = xi eta, by two by two points of Gauss.
fn roughness(x: [DVec2; 4]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for [xi, eta] in CORNER {
        let at = [GAUSS * xi, GAUSS * eta];
        let basis = jacobian(x, at);
        let d = contravariant(basis, DVec2::new(at[1], at[0]));
        let weight = basis[0].perp_dot(basis[1]);
        for (s, product) in sum.iter_mut().zip([d.x * d.x, d.y * d.y, d.x * d.y]) {
            *s += weight * product;
        }
    }
    sum
}

/// A side is long if its square is more than this times that of the sides across \[1\]: no ratio of whole numbers, on
/// which rounding would decide, lies on the border.
///
/// Where waves run along the long sides themselves, and where sheets buckle, quarters that turn are the better ones: ten
/// panels along the short sides of ones four times as long have the first three waves 0.3, 8 and 36 % low so, four
/// along the long sides the first five within 10 %, and 17 % with the other rule.
const LONG: f64 = 35.0;

/// Corners at the ends of the sides along the first natural coordinate and along the second.
const SIDES: [[[usize; 2]; 2]; 2] = [[[0, 1], [3, 2]], [[0, 3], [1, 2]]];

/// The mass of a quadrilateral: quarters at its corners, and a part of them at the middles of long sides.
#[derive(Clone, Debug)]
pub(super) struct Lumps {
    /// Rigid bodies, each about its corner, W components.
    pub corners: [MassProperties; 4],
    /// Masses \[kg\] midway between two corners.
    pub middles: Vec<([usize; 2], f64)>,
    /// What both lack of the first moment and the inertia of the whole, about the origin of W in W components; no
    /// mass.
    pub remainder: MassProperties,
}

/// Mass of the quadrilateral at its corners and at the middles of long sides.
///
/// A quarter that is fixed to its corner as it lies has first moment and inertia of the sheet. But it also moves where
/// corners turn and the sheet stays, as they do at both ends of a long side: a bulge that mass has and bending along the
/// other side has not. Where the bulge is soft, because the side is long, it takes waves along the other side out of
/// their frequencies. So of long sides mass does not turn with their ends: it has the velocity that is linear from one
/// to the other, by Simpson's rule, two thirds at the middle. Mass that is not alike at both ends goes to the
/// middle as the smaller one does.
pub(super) fn lumps(corners: [DVec3; 4], axes: DMat3, section: &ShellSection) -> Lumps {
    let [a, b] = spans(corners).map(DVec3::length_squared);
    let long = [a > LONG * b, b > LONG * a];
    let whole = quarters(corners, axes, section, [false; 2]);
    let mut lumps = Lumps {
        corners: quarters(corners, axes, section, long),
        middles: vec![],
        remainder: MassProperties::ZERO,
    };
    for (sides, _) in SIDES.into_iter().zip(long).filter(|(_, long)| *long) {
        for ends in sides {
            let each = ends
                .map(|i| whole[i].mass)
                .into_iter()
                .fold(f64::INFINITY, f64::min)
                * 2.0
                / 3.0;
            for i in ends {
                lumps.corners[i] = lumps.corners[i].scaled(1.0 - each / whole[i].mass);
            }
            lumps.middles.push((ends, 2.0 * each));
        }
    }
    for ((whole, lump), corner) in whole.iter().zip(&lumps.corners).zip(corners) {
        let lack = *whole + lump.scaled(-1.0);
        lumps.remainder = lumps.remainder + lack.moved(DMat3::IDENTITY, corner);
    }
    for ([a, b], mass) in &lumps.middles {
        let middle = corners[*a].midpoint(corners[*b]);
        lumps.remainder = lumps.remainder + MassProperties::point(-mass, middle);
    }
    lumps
}

/// Quarters of the quadrilateral as rigid bodies about their corners, W components, without lever along sides that are
/// `long`; of others mass, first moment and inertia add to those of the whole without error.
fn quarters(
    corners: [DVec3; 4],
    axes: DMat3,
    section: &ShellSection,
    long: [bool; 2],
) -> [MassProperties; 4] {
    let n = axes.z_axis;
    let plane = DMat3::IDENTITY - outer(n);
    std::array::from_fn(|i| {
        let mut sum = MassProperties::ZERO;
        for [u, v] in CORNER {
            let at = [u, v].map(|g| 0.5 * GAUSS * g);
            let to: [f64; 2] = std::array::from_fn(|k| 0.5 * CORNER[i][k] + at[k]);
            let (mut x, area) = surface(corners, to);
            if long != [false; 2] {
                let near = std::array::from_fn(|k| if long[k] { CORNER[i][k] } else { to[k] });
                (x, _) = surface(corners, near);
            }
            let point = MassProperties::point(0.25 * area * section.area_density, x - corners[i]);
            let turn = plane * (0.25 * area * section.rotary_inertia);
            sum = sum
                + point
                + MassProperties {
                    inertia: turn,
                    ..MassProperties::ZERO
                };
        }
        sum
    })
}

/// Half the lines between the middles of opposite sides \[m\]: along the first natural coordinate and the second.
fn spans(c: [DVec3; 4]) -> [DVec3; 2] {
    [0, 1].map(|k| (0..4).map(|i| 0.25 * CORNER[i][k] * c[i]).sum())
}

/// Point of the bilinear surface \[m\] and area per area of natural coordinates \[m2\].
fn surface(c: [DVec3; 4], at: [f64; 2]) -> (DVec3, f64) {
    let (mut x, mut a, mut b) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
    for (c, n) in c.iter().zip(CORNER) {
        let (p, q) = (1.0 + n[0] * at[0], 1.0 + n[1] * at[1]);
        x += 0.25 * p * q * *c;
        a += 0.25 * n[0] * q * *c;
        b += 0.25 * n[1] * p * *c;
    }
    (x, a.cross(b).length())
}
