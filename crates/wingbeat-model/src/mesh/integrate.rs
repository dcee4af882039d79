//! Integrals over meshes: volume, area and mass properties (seed eq. 19).
//!
//! Each panel is the bilinear patch `x(u, v)` of its four corners (a plane quadrilateral is its
//! own patch), so a mesh with nodes in common is watertight and no diagonal is preferred.
//! Volume integrals go to the surface by the divergence theorem, `x.n` the flux of position:
//! `V = 1/3 int x.n`, `S = 1/4 int x (x.n)`, `int x x^T dV = 1/5 int x x^T (x.n)`.
//! The integrands are polynomials of at most fourth degree in u and v: three Gauss points each
//! way are exact.

use crate::error::{ModelError, check_rising, in_row, not_negative, positive};
use crate::mesh::{GridMesh, QuadMesh, Side};
use wingbeat_math::{DMat3, DVec3, MassProperties, interpolate_pairs, outer, trace};

/// Abscissas on [0, 1] and weights of the three-point Gauss rule (exact to degree five).
pub(crate) const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// Sum of `f(x, n dA)` over the Gauss points of one patch: point \[m\] and area vector \[m2\].
fn over_patch(c: [DVec3; 4], f: &mut impl FnMut(DVec3, DVec3)) {
    for (u, wu) in GAUSS {
        for (v, wv) in GAUSS {
            let x = c[0] * ((1.0 - u) * (1.0 - v))
                + c[1] * (u * (1.0 - v))
                + c[2] * (u * v)
                + c[3] * ((1.0 - u) * v);
            let x_u = (c[1] - c[0]) * (1.0 - v) + (c[2] - c[3]) * v;
            let x_v = (c[3] - c[0]) * (1.0 - u) + (c[2] - c[1]) * u;
            f(x, x_u.cross(x_v) * (wu * wv));
        }
    }
}

fn over_mesh(mesh: &QuadMesh, mut f: impl FnMut(DVec3, DVec3)) {
    for p in 0..mesh.quads.len() {
        over_patch(mesh.corners(p), &mut f);
    }
}

/// Volume enclosed by a closed surface \[m3\], positive for outward normals.
pub fn volume(mesh: &QuadMesh) -> f64 {
    let mut sum = 0.0;
    over_mesh(mesh, |x, n| sum += x.dot(n));
    sum / 3.0
}

/// Area of a surface \[m2\].
pub fn area(mesh: &QuadMesh) -> f64 {
    let mut sum = 0.0;
    over_mesh(mesh, |_, n| sum += n.length());
    sum
}

/// Mass properties about the mesh frame's origin of the solid inside a closed surface with a
/// constant density \[kg/m3\]: exact for the mesh.
pub fn solid(mesh: &QuadMesh, density: f64) -> MassProperties {
    let (mut v, mut s, mut second) = (0.0, DVec3::ZERO, DMat3::ZERO);
    over_mesh(mesh, |x, n| {
        let flux = x.dot(n);
        v += flux / 3.0;
        s += x * (flux / 4.0);
        second += outer(x) * (flux / 5.0);
    });
    let (s, second) = without_rounding(v, s, second);
    from_moments(v, s, second).scaled(density)
}

/// Part of a sum over panels that is rounding: a symmetric mesh of a thousand panels leaves less.
const ROUNDING: f64 = 1e-14;

/// First and second moments of the volume `v` without what is left of those that symmetry makes zero: a body
/// that does not tell left from right must not turn by roundings.
fn without_rounding(v: f64, s: DVec3, second: DMat3) -> (DVec3, DMat3) {
    let trace = trace(second);
    // |s|^2 <= v trace, by Cauchy and Schwarz.
    let size = (v * trace).abs().sqrt();
    let above = |x: f64, size: f64| if x.abs() < ROUNDING * size { 0.0 } else { x };
    let columns = second.to_cols_array().map(|x| above(x, trace));
    let first = s.to_array().map(|x| above(x, size));
    (DVec3::from_array(first), DMat3::from_cols_array(&columns))
}

/// Mass properties of a shell with areal density `sigma(x)` \[kg/m2\]: exact for plane panels and
/// a density that is linear on each; a kink of the density inside a panel costs second order.
pub fn shell(mesh: &QuadMesh, sigma: impl Fn(DVec3) -> f64) -> MassProperties {
    let (mut m, mut s, mut second) = (0.0, DVec3::ZERO, DMat3::ZERO);
    over_mesh(mesh, |x, n| {
        let dm = sigma(x) * n.length();
        m += dm;
        s += x * dm;
        second += outer(x) * dm;
    });
    from_moments(m, s, second)
}

/// `J = tr(P) I - P` with `P = int rho r r^T`.
pub(crate) fn from_moments(mass: f64, first_moment: DVec3, second: DMat3) -> MassProperties {
    let trace = trace(second);
    MassProperties {
        mass,
        first_moment,
        inertia: DMat3::from_diagonal(DVec3::splat(trace)) - second,
    }
}

/// The mass of a body part or a wing.
#[derive(Clone, Debug, PartialEq)]
pub enum MassInput {
    /// Constant density: of volume \[kg/m3\] for a body part, of area \[kg/m2\] for a wing.
    Density(f64),
    /// Total mass \[kg\], spread evenly.
    Total(f64),
    /// Wing only: areal density \[kg/m2\] at distances from the hinge along the span \[m\], rows
    /// (distance, density), linear between rows and constant beyond the ends.
    SpanTable(Vec<(f64, f64)>),
    /// Given as numbers, about the frame origin.
    Given(MassProperties),
}

impl MassInput {
    /// Mass properties of a closed part about the origin of its frame; `solid` is that of the part filled with
    /// density 1 kg/m3.
    ///
    /// # Errors
    /// A negative or non-finite number, or impossible given moments.
    pub fn of_solid(
        &self,
        name: &str,
        solid: &MassProperties,
    ) -> Result<MassProperties, ModelError> {
        let key = format!("{name}.mass");
        let found = match *self {
            MassInput::Density(rho) => solid.scaled(not_negative(&key, rho)?),
            MassInput::Total(m) => solid.scaled(not_negative(&key, m)? / solid.mass),
            MassInput::Given(given) => given,
            MassInput::SpanTable(_) => {
                return Err(in_row(&key, 0, "a table along the span is for wings only"));
            }
        };
        validated(name, found)
    }

    /// Mass properties of a wing about the origin of the wing frame (the hinge).
    ///
    /// # Errors
    /// A negative or non-finite number, or impossible given moments.
    pub fn of_wing(&self, name: &str, mesh: &GridMesh) -> Result<MassProperties, ModelError> {
        let key = format!("{name}.mass");
        let quads = mesh.to_quads(Side::Right);
        let found = match self {
            &MassInput::Density(sigma) => {
                let sigma = not_negative(&key, sigma)?;
                shell(&quads, |_| sigma)
            }
            &MassInput::Total(m) => {
                let sigma = not_negative(&key, m)? / area(&quads);
                shell(&quads, |_| sigma)
            }
            MassInput::SpanTable(rows) => {
                let tip = quads.nodes.iter().fold(0.0_f64, |a, x| a.max(x.y.abs()));
                check_span_table(&key, rows, tip)?;
                shell(&quads, |x| interpolate_pairs(rows, x.y.abs()))
            }
            &MassInput::Given(given) => given,
        };
        validated(name, found)
    }

    /// The input of a wing or part `s` times as large of the same material: volume densities are
    /// held, areal densities grow with the thickness (times s), masses times s^3, inertias s^5.
    pub fn scaled(&self, s: f64, wing: bool) -> Self {
        match self {
            MassInput::Density(d) => MassInput::Density(if wing { d * s } else { *d }),
            MassInput::Total(m) => MassInput::Total(m * s.powi(3)),
            MassInput::SpanTable(t) => {
                MassInput::SpanTable(t.iter().map(|&(r, d)| (r * s, d * s)).collect())
            }
            MassInput::Given(p) => MassInput::Given(scaled_properties(p, s)),
        }
    }
}

/// Mass properties of the body `s` times as large with the same densities.
pub(crate) fn scaled_properties(p: &MassProperties, s: f64) -> MassProperties {
    MassProperties {
        mass: p.mass * s.powi(3),
        first_moment: p.first_moment * s.powi(4),
        inertia: p.inertia * s.powi(5),
    }
}

fn validated(name: &str, p: MassProperties) -> Result<MassProperties, ModelError> {
    p.validate().map_err(|source| ModelError::Mass {
        of: name.to_owned(),
        source,
    })?;
    Ok(p)
}

/// Where the last row of a table of strips may lie, over the length of the wing: middles of few strips end
/// before the tip, and measured wings differ a little from their outlines.
const LAST_ROW: std::ops::RangeInclusive<f64> = 0.5..=1.1;

/// `tip`: distance of the tip from the hinge along the span \[m\].
fn check_span_table(key: &str, rows: &[(f64, f64)], tip: f64) -> Result<(), ModelError> {
    let bad = |row: usize, problem: &str| in_row(key, row, problem);
    let last = match rows {
        [] => return Err(bad(0, "the table is empty; give at least one row")),
        [_] => tip, // even all over
        [.., last] => last.0,
    };
    if !LAST_ROW.contains(&(last / tip)) {
        let problem = format!(
            "the table ends {last} m from the hinge, the wing at {tip:.4e} m: distances are in metres from the hinge"
        );
        return Err(bad(rows.len() - 1, &problem));
    }
    check_rising(key, "distance", rows)?;
    if let Some(k) = rows.iter().position(|row| row.1 < 0.0) {
        return Err(bad(k, "areal densities are at least 0"));
    }
    positive(key, rows.iter().map(|r| r.1).sum())?;
    Ok(())
}
