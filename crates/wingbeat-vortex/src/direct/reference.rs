//! The kernel in plain scalar arithmetic, operation by operation as the vector kernel does it.
//!
//! Readable form, oracle of the vector code, and the right tool for a handful of evaluations.

pub use crate::cores::exp2::one_minus_exp2;
use crate::cores::{CoreModel, INV_4PI};
use crate::sources::{Network, Points};
use glam::DVec3;

/// Velocity \[m/s\] at `p` induced by the segment a -> b (frame N, m) of circulation `gamma`
/// \[m^2/s\] and regularisation number `core` ([`CoreModel::core`]).
///
/// With n = abs(r), t = n1 + n2, l = abs(b - a), c = r1 x r2, the bare filament is 2 c t / (n1 n2 (t^2 - l^2)),
/// for t^2 - l^2 = 2 (n1 n2 + r1.r2). Where the textbook difference of cosines cancels, near the extension
/// of the filament, this sum does not. Beside the filament, where t^2 - l^2 does, it is taken from
/// (t^2 - l^2) (4 n1 n2 - t^2 + l^2) = 4 c^2, but for the cut-off.
///
/// The cut-off adds to the denominator; the others multiply by a function of h^2 = c^2 / l^2: c^2 / (c^2 + e)
/// for Scully, c^2 / sqrt(c^4 + e^2) for Vatistas, e = r_c^2 l^2. The algebraic one adds to n1^2 and n2^2 half
/// of the squared core radius, here of a filament seen from a point: that is the integral along the filament of
/// its kernel, for the squared distance stays a quadratic along it.
///
/// On the line of the filament, its nodes included, the result is zero.
///
/// ```
/// use wingbeat_vortex::{reference, CoreModel};
/// use wingbeat_vortex::DVec3;
/// // One metre from the middle of two metres of bare filament: Gamma/(4 pi h) 2 cos 45 deg.
/// let bare = CoreModel::Scully { radius: 0.0 };
/// let v = reference::segment_velocity(bare, DVec3::Z, -DVec3::X, DVec3::X, 1.0, 0.0);
/// let expected = -DVec3::Y * 2f64.sqrt() / (4.0 * std::f64::consts::PI);
/// assert!((v - expected).length() < 1e-16);
/// ```
pub fn segment_velocity(
    model: CoreModel,
    p: DVec3,
    a: DVec3,
    b: DVec3,
    gamma: f64,
    core: f64,
) -> DVec3 {
    let (r1, r2, soft) = (p - a, p - b, model.softening(core));
    let [n1, n2] = [r1, r2].map(|r| (dot(r, r) + soft).sqrt());
    let (sum, c, l2) = (n1 + n2, cross(r1, r2), dot(b - a, b - a));
    let (nn, c2, rest) = (n1 * n2, dot(c, c), sum * sum - l2);
    let other = nn * 4.0 - rest;
    let has_distance = !matches!(
        model,
        CoreModel::CutOff { .. } | CoreModel::Algebraic { .. }
    );
    let is_close = has_distance && l2 * CLOSE > rest && other > rest;
    let (bare, scale) = match is_close {
        true => (nn * (c2 * 4.0), other),
        false => (nn * rest, 1.0),
    };
    let (num, term) = (
        sum * (gamma * (2.0 * INV_4PI)) * scale,
        model.kernel_term(core, l2),
    );
    let (num, den) = match model {
        CoreModel::CutOff { .. } => (num, bare + scale * term),
        CoreModel::Algebraic { .. } => (num, bare),
        CoreModel::Scully { .. } => (num * c2, bare * (c2 + term)),
        CoreModel::Vatistas { .. } => (num * c2, bare * (c2 * c2 + term).sqrt()),
        CoreModel::LambOseen { .. } => (num * one_minus_exp2(c2 * term), bare),
    };
    let k = if den > 0.0 { num / den } else { 0.0 };
    c * k
}

/// The part of l^2 below which t^2 - l^2 is too small a difference: it keeps ten digits.
pub(crate) const CLOSE: f64 = 1e-6;

/// Adds to `out` the velocities \[m/s\] of all edges at all targets, one after the other, with the edges' own cores.
pub fn add_velocity(model: CoreModel, network: &Network, targets: &Points, out: &mut Points) {
    for t in 0..targets.len() {
        let p = targets.get(t);
        let mut v = DVec3::ZERO;
        for e in 0..network.len() {
            let (a, b) = network.ends(e);
            v += segment_velocity(model, p, a, b, network.gamma[e], network.core[e]);
        }
        out.add(t, v);
    }
}

/// Scalar product, summed from the left (the order is part of the bits).
fn dot(a: DVec3, b: DVec3) -> f64 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// Vector product.
fn cross(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(
        a.y * b.z - a.z * b.y,
        a.z * b.x - a.x * b.z,
        a.x * b.y - a.y * b.x,
    )
}
