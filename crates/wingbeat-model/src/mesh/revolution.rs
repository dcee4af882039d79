//! Closed surfaces of revolution for head, thorax and abdomen (seed sec. 2).
//!
//! Rings of nodes stand at cosine-spaced stations between the two poles. The caps are true
//! quadrilaterals without coincident nodes: (pole, ring j, ring j+1, ring j+2) with an even
//! number of meridians.

use crate::ModelError;
use crate::error::{finite, in_row, positive, require, require_count};
use crate::mesh::QuadMesh;
use crate::mesh::integrate::{GAUSS, from_moments};
use statrs::function::beta::beta;
use std::f64::consts::{PI, TAU};
use wingbeat_math::{DMat3, DVec3, MassProperties, interpolate_pairs, outer};

/// Radius along the axis, relative to the largest, over the station s in [0, 1] from front pole
/// to rear pole.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// `r^2 + (2s - 1)^2 = 1`.
    Ellipsoid,
    /// `r^n + |2s - 1|^n = 1`, exponent n > 1: 2 is the ellipsoid, larger is fuller.
    Superellipse {
        /// Exponent n \[1\].
        exponent: f64,
    },
    /// Rows (station, relative radius), linear between rows, from (0, 0) to (1, 0).
    Table(Vec<(f64, f64)>),
}

impl Profile {
    /// Relative radius at station `s`.
    pub fn radius(&self, s: f64) -> f64 {
        let z: f64 = 2.0 * s - 1.0;
        match self {
            Profile::Ellipsoid => (1.0 - z * z).max(0.0).sqrt(),
            Profile::Superellipse { exponent: n } => {
                (1.0 - z.abs().powf(*n)).max(0.0).powf(1.0 / n)
            }
            Profile::Table(rows) => interpolate_pairs(rows, s),
        }
    }

    /// The largest of `along (1 - 2 s) + across r(s)` over the stations, `across` not negative: how far a tilted shape
    /// reaches.
    fn reach(&self, [along, across]: [f64; 2]) -> f64 {
        match self {
            Profile::Ellipsoid => along.hypot(across),
            // With |z|^n + r^n = 1 it is the norm of the conjugate exponent [Hoelder].
            Profile::Superellipse { exponent: n } if across > 0.0 => {
                let q = n / (n - 1.0);
                (along.abs().powf(q) + across.powf(q)).powf(1.0 / q)
            }
            Profile::Superellipse { .. } => along.abs(),
            Profile::Table(rows) => (rows.iter())
                .map(|(s, r)| along * (1.0 - 2.0 * s) + across * r)
                .fold(f64::NEG_INFINITY, f64::max),
        }
    }

    /// The integrals over the station of `r^2`, `r^2 z`, `r^2 z^2` and `r^4`, with `z = s - 1/2` \[1\]: exact.
    fn moments(&self) -> [f64; 4] {
        match self {
            // Polynomials of the fourth degree at most, on the whole and between two rows.
            Profile::Ellipsoid => over_station(&[0.0, 1.0], |s| self.radius(s)),
            Profile::Table(rows) => {
                let ends: Vec<f64> = rows.iter().map(|&(s, _)| s).collect();
                over_station(&ends, |s| self.radius(s))
            }
            &Profile::Superellipse { exponent: n } => {
                // With t = |2 z|, the integral of t^k (1 - t^n)^(p / n) from 0 to 1.
                let half = |k: f64, p: f64| beta((k + 1.0) / n, p / n + 1.0) / n;
                [half(0.0, 2.0), 0.0, 0.25 * half(2.0, 2.0), half(0.0, 4.0)]
            }
        }
    }

    fn check(&self, key: &str) -> Result<(), ModelError> {
        match self {
            Profile::Ellipsoid => Ok(()),
            Profile::Superellipse { exponent: n } => {
                require(&format!("{key}.exponent"), *n, *n > 1.0, "> 1").map(|_| ())
            }
            Profile::Table(rows) => check_table(key, rows),
        }
    }
}

/// [`Profile::moments`] by three Gauss points between each two of `ends`.
fn over_station(ends: &[f64], radius: impl Fn(f64) -> f64) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for pair in ends.windows(2) {
        let width = pair[1] - pair[0];
        for (u, weight) in GAUSS {
            let s = pair[0] + u * width;
            let (z, square) = (s - 0.5, radius(s).powi(2));
            let values = [square, square * z, square * z * z, square * square];
            for (sum, value) in sum.iter_mut().zip(values) {
                *sum += weight * width * value;
            }
        }
    }
    sum
}

fn check_table(key: &str, rows: &[(f64, f64)]) -> Result<(), ModelError> {
    let n = rows.len();
    let bad = |row: usize, problem: &str| Err(in_row(key, row - 1, problem));
    if n < 3 || rows[0] != (0.0, 0.0) {
        return bad(1, "a profile has at least 3 rows and starts with (0, 0)");
    }
    if rows[n - 1] != (1.0, 0.0) {
        return bad(n, "a profile ends with (1, 0)");
    }
    for k in 1..n {
        let (s, r) = rows[k];
        if !(s > rows[k - 1].0 && r.is_finite() && (r > 0.0 || k == n - 1)) {
            return bad(
                k + 1,
                "stations must increase and radii between the poles be > 0",
            );
        }
    }
    Ok(())
}

/// A surface of revolution: where it lies, its size, its profile and its mesh density.
#[derive(Clone, Debug, PartialEq)]
pub struct Revolution {
    /// Middle of the axis in the body frame \[m\].
    pub centre: DVec3,
    /// Direction of the axis from rear to front pole, body components \[1\]; any length but zero.
    pub direction: DVec3,
    /// Distance between the poles \[m\].
    pub length: f64,
    /// Largest radius \[m\].
    pub radius: f64,
    /// Shape.
    pub profile: Profile,
    /// Panels from pole to pole, >= 2.
    pub stations: usize,
    /// Panels around, even, >= 4.
    pub meridians: usize,
}

impl Revolution {
    /// An ellipsoid along b1.
    pub fn ellipsoid(centre: DVec3, length: f64, radius: f64, density: [usize; 2]) -> Self {
        Self {
            centre,
            direction: DVec3::X,
            length,
            radius,
            profile: Profile::Ellipsoid,
            stations: density[0],
            meridians: density[1],
        }
    }

    /// The closed mesh, normals outward. An axis in the 1-3 plane gives a mesh that is its own
    /// mirror image bit for bit.
    ///
    /// # Errors
    /// A size, density or profile that is not allowed; `name` names the part.
    pub fn mesh(&self, name: &str) -> Result<QuadMesh, ModelError> {
        self.check(name)?;
        Ok(QuadMesh {
            nodes: self.nodes(),
            quads: quads(self.stations, self.meridians),
        })
    }

    /// Mass properties about the origin of the body frame of the solid of density `density` \[kg/m3\] within the
    /// surface itself, whatever the panels of its mesh: exact.
    ///
    /// # Errors
    /// As [`Self::mesh`].
    pub fn solid(&self, name: &str, density: f64) -> Result<MassProperties, ModelError> {
        self.check(name)?;
        let [volume, first, axial, across] = self.profile.moments();
        let axis = self.direction.normalize();
        let mass_per_volume = density * PI * self.radius.powi(2) * self.length;
        // Stations count from the front pole to the rear, against the axis.
        let first_moment = axis * (-first * mass_per_volume * self.length);
        let along = axial * mass_per_volume * self.length.powi(2);
        let across = 0.25 * across * mass_per_volume * self.radius.powi(2);
        let second = DMat3::from_diagonal(DVec3::splat(across)) + outer(axis) * (along - across);
        let about_middle = from_moments(volume * mass_per_volume, first_moment, second);
        Ok(about_middle.moved(DMat3::IDENTITY, self.centre))
    }

    /// Where the surface itself begins and ends along b1 \[m\], whatever the panels of its mesh.
    ///
    /// # Errors
    /// As [`Self::mesh`].
    pub fn ends_along_b1(&self, name: &str) -> Result<[f64; 2], ModelError> {
        self.check(name)?;
        let axis = self.direction.normalize();
        let across = (axis.y * axis.y + axis.z * axis.z).sqrt();
        let reach = |forward: f64| {
            let along = 0.5 * self.length * axis.x * forward;
            self.profile.reach([along, self.radius * across])
        };
        Ok([self.centre.x - reach(-1.0), self.centre.x + reach(1.0)])
    }

    /// All lengths multiplied by `s`.
    pub fn scaled(&self, s: f64) -> Self {
        Self {
            centre: self.centre * s,
            length: self.length * s,
            radius: self.radius * s,
            ..self.clone()
        }
    }

    fn check(&self, name: &str) -> Result<(), ModelError> {
        for k in 0..3 {
            finite(&format!("{name}.centre[{k}]"), self.centre[k])?;
        }
        let length = self.direction.length();
        require(
            &format!("{name}.direction"),
            length,
            length > 0.0,
            "not zero",
        )?;
        positive(&format!("{name}.length"), self.length)?;
        positive(&format!("{name}.radius"), self.radius)?;
        let (s, m) = (self.stations, self.meridians);
        require_count(&format!("{name}.stations"), s, s >= 2, ">= 2")?;
        let even = m >= 4 && m % 2 == 0;
        require_count(&format!("{name}.meridians"), m, even, "even and >= 4")?;
        self.profile.check(&format!("{name}.profile"))
    }

    /// Front pole, rear pole, then the rings from front to rear.
    fn nodes(&self) -> Vec<DVec3> {
        let [axis, side, up] = basis(self.direction);
        let circle = circle(self.meridians);
        let along = |s: f64| self.centre + axis * (self.length * (0.5 - s));
        let mut nodes = vec![along(0.0), along(1.0)];
        for k in 1..self.stations {
            let s = 0.5 * (1.0 - (PI * k as f64 / self.stations as f64).cos());
            let radius = self.radius * self.profile.radius(s);
            let ring = circle.iter().map(|&(c, sn)| up * c + side * sn);
            nodes.extend(ring.map(|e| along(s) + e * radius));
        }
        nodes
    }
}

/// Unit vectors along the axis, to the right, and up.
fn basis(direction: DVec3) -> [DVec3; 3] {
    let axis = direction.normalize();
    let side = if axis.y == 0.0 {
        DVec3::Y
    } else if axis.x == 0.0 && axis.z == 0.0 {
        DVec3::Z
    } else {
        (DVec3::Y - axis * axis.y).normalize()
    };
    [axis, side, side.cross(axis)]
}

/// (cos, sin) of the meridians from up towards the right; the left half mirrors the right half
/// bit for bit.
fn circle(n: usize) -> Vec<(f64, f64)> {
    let at = |k: usize| {
        let (s, c) = (TAU * k as f64 / n as f64).sin_cos();
        if 2 * k == n { (-1.0, 0.0) } else { (c, s) }
    };
    let mirrored = |k: usize| {
        let (c, s) = at(n - k);
        (c, -s)
    };
    (0..n)
        .map(|k| if 2 * k <= n { at(k) } else { mirrored(k) })
        .collect()
}

fn quads(stations: usize, meridians: usize) -> Vec<[usize; 4]> {
    let node = |ring: usize, k: usize| 2 + ring * meridians + k % meridians;
    let last = stations - 2;
    let mut quads = Vec::with_capacity(meridians * (stations - 1));
    for k in (0..meridians).step_by(2) {
        quads.push([0, node(0, k), node(0, k + 1), node(0, k + 2)]);
    }
    for ring in 0..last {
        for k in 0..meridians {
            let (a, b) = (node(ring, k), node(ring, k + 1));
            quads.push([a, node(ring + 1, k), node(ring + 1, k + 1), b]);
        }
    }
    for k in (0..meridians).step_by(2) {
        quads.push([1, node(last, k + 2), node(last, k + 1), node(last, k)]);
    }
    quads
}
