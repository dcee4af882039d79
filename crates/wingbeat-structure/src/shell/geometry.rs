//! A quadrilateral at rest: axes, gradients, hourglass, area.

use wingbeat_math::{DMat3, DVec2, DVec3, MassProperties, outer};

use super::{Section, ShellError};

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

/// Quarters of the quadrilateral as rigid bodies about their corners, W components: mass, first moment and inertia
/// add to those of the whole without error.
pub(super) fn lumps(corners: [DVec3; 4], axes: DMat3, section: &Section) -> [MassProperties; 4] {
    let n = axes.z_axis;
    let plane = DMat3::IDENTITY - outer(n);
    std::array::from_fn(|i| {
        let mut sum = MassProperties::ZERO;
        for [u, v] in CORNER {
            let at = [u, v].map(|g| 0.5 * GAUSS * g);
            let [xi, eta] = std::array::from_fn(|k| 0.5 * CORNER[i][k] + at[k]);
            let (x, area) = surface(corners, [xi, eta]);
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
