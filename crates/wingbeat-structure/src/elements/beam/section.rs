//! Sections of beams: stiffness and mass per length.

use wingbeat_math::six_by_six::from_entries;
use wingbeat_math::{DMat3, DVec3, MassProperties, SixBySix};

use crate::error::StructureError;

/// Section of a beam, in its own axes: axis 1 along the beam, axes 2 and 3 across, about a reference line that may lie
/// anywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamSection {
    /// Stiffness \[N, N m, N m2\]: forces and moments by stretch, two shears, twist and two curvatures; symmetric.
    pub stiffness: SixBySix,
    /// Mass per length \[kg/m\], its first moment \[kg\] and inertia \[kg m\] about the reference line.
    pub mass: MassProperties,
}

/// Stiffness of a section without coupling, about its own centres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness {
    /// EA \[N\].
    pub axial: f64,
    /// GA \[N\] along axes 2 and 3, times the shear correction; large for a slender beam without shear.
    pub shear: [f64; 2],
    /// GJ \[N m2\].
    pub torsion: f64,
    /// EI \[N m2\]: bending moments about axes 2 and 3.
    pub bending: [f64; 2],
}

impl BeamSection {
    /// Section with its reference line through the tension centre and shear centre, without mass.
    pub fn new(s: &Stiffness) -> Self {
        Self::with_offsets(s, [0.0; 2], [0.0; 2])
    }

    /// Section whose tension centre (where an axial force does not bend) and shear centre (where a transverse
    /// force does not twist: the elastic axis) lie at `tension` and `shear` \[m\] along axes 2 and 3. Strains
    /// there are `gamma + kappa x r`.
    pub fn with_offsets(s: &Stiffness, tension: [f64; 2], shear: [f64; 2]) -> Self {
        let mut to_centres = [[0.0; 6]; 6];
        (0..6).for_each(|i| to_centres[i][i] = 1.0);
        to_centres[0][4] = tension[1];
        to_centres[0][5] = -tension[0];
        to_centres[1][3] = -shear[1];
        to_centres[2][3] = shear[0];
        let [e2, e3] = s.bending;
        let diagonal = [s.axial, s.shear[0], s.shear[1], s.torsion, e2, e3];
        let entry = |i: usize, j: usize| -> f64 {
            let part = |k: usize| to_centres[k][i] * diagonal[k] * to_centres[k][j];
            (0..6).map(part).sum()
        };
        Self {
            stiffness: from_entries(entry),
            mass: MassProperties::ZERO,
        }
    }

    /// With mass: per length \[kg/m\], mass centre along axes 2 and 3 \[m\], and inertia per length \[kg m\]
    /// about the mass centre for axes 2 and 3; that about axis 1 is their sum.
    #[must_use]
    pub fn with_mass(mut self, per_length: f64, centre: [f64; 2], inertia: [f64; 2]) -> Self {
        let [j2, j3] = inertia;
        let j = DMat3::from_diagonal(DVec3::new(j2 + j3, j2, j3));
        let centre = DVec3::new(0.0, centre[0], centre[1]);
        self.mass = MassProperties::about_centre(per_length, centre, j);
        self
    }

    /// The same section seen in axes turned by `angle` \[rad\] about axis 1: its axis 2 stands at `angle` from
    /// axis 2 of the new axes towards axis 3.
    #[must_use]
    pub fn turned(mut self, angle: f64) -> Self {
        let r = wingbeat_math::r1(angle);
        let entry = |i: usize, j: usize| -> f64 {
            let (row, col) = (3 * (i / 3), 3 * (j / 3));
            let mut sum = 0.0;
            for (a, b) in (0..9).map(|k| (k / 3, k % 3)) {
                sum += r.col(a)[i % 3] * self.stiffness[row + a][col + b] * r.col(b)[j % 3];
            }
            sum
        };
        let stiffness = from_entries(entry);
        self.stiffness = stiffness;
        self.mass = self.mass.moved(r, DVec3::ZERO);
        self
    }

    /// Solid rectangle of `width` along axis 2 and `thickness` along axis 3 \[m\] of a material with Young's
    /// modulus and shear modulus \[Pa\] and density \[kg/m3\]; torsion by Saint-Venant's series, shear
    /// correction 5/6.
    pub fn rectangle([young, shear]: [f64; 2], density: f64, [width, thickness]: [f64; 2]) -> Self {
        let area = width * thickness;
        let second = [width * thickness.powi(3), thickness * width.powi(3)].map(|i| i / 12.0);
        let stiffness = Stiffness {
            axial: young * area,
            shear: [shear * area * 5.0 / 6.0; 2],
            torsion: shear * saint_venant(width.max(thickness), width.min(thickness)),
            bending: second.map(|i| young * i),
        };
        let inertia = second.map(|i| density * i);
        Self::new(&stiffness).with_mass(density * area, [0.0; 2], inertia)
    }

    /// Solid circle of a radius \[m\]; materials as in [`Self::rectangle`]. Shear correction 9/10.
    pub fn circle([young, shear]: [f64; 2], density: f64, radius: f64) -> Self {
        let area = std::f64::consts::PI * radius * radius;
        let second = area * radius * radius / 4.0;
        let stiffness = Stiffness {
            axial: young * area,
            shear: [0.9 * shear * area; 2],
            torsion: 2.0 * shear * second,
            bending: [young * second; 2],
        };
        Self::new(&stiffness).with_mass(density * area, [0.0; 2], [density * second; 2])
    }
}

/// Torsion constant \[m4\] of a rectangle a x b, a >= b [Timoshenko & Goodier, Theory of Elasticity, art. 109].
fn saint_venant(a: f64, b: f64) -> f64 {
    use std::f64::consts::PI;
    let term = |n: f64| (n * PI * a / (2.0 * b)).tanh() / n.powi(5);
    let series: f64 = (0..12).map(|k| term(f64::from(2 * k + 1))).sum();
    a * b.powi(3) / 3.0 * (1.0 - 192.0 * b / (PI.powi(5) * a) * series)
}

/// Stiffness \[N/m, N, N m\] of an element of `length` \[m\] whose axis points along `axis` in the section: the
/// section's compliance, with that of the linear part of the bending moment, which an element of constant
/// strain leaves out (residual bending flexibility [MacNeal, Comput. Struct. 8:175, 1978]). A straight element
/// under loads at its ends is then exact.
///
/// # Errors
/// [`StructureError::Stiffness`].
pub(super) fn element_stiffness(
    section: &BeamSection,
    axis: DVec3,
    length: f64,
) -> Result<SixBySix, StructureError> {
    let mut compliance = inverse(&section.stiffness)?;
    let moment = wingbeat_math::tilde(axis);
    let bending = DMat3::from_cols_array_2d(&std::array::from_fn(|j| {
        std::array::from_fn(|i| compliance[3 + i][3 + j])
    }));
    let linear = moment.transpose() * bending * moment * (length * length / 12.0);
    for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
        compliance[i][j] += linear.col(j)[i];
    }
    let stiffness = inverse(&compliance)?;
    Ok(stiffness.map(|row| row.map(|k| k / length)))
}

/// Inverse of a symmetric positive definite block by Cholesky factors of the matrix with its diagonal scaled to one.
fn inverse(m: &SixBySix) -> Result<SixBySix, StructureError> {
    let scale: [f64; 6] = std::array::from_fn(|i| m[i][i].sqrt());
    let mut l = [[0.0; 6]; 6];
    for row in 0..6 {
        for col in 0..=row {
            let known: f64 = (0..col).map(|k| l[row][k] * l[col][k]).sum();
            let rest = m[row][col] / (scale[row] * scale[col]) - known;
            let skew = (m[row][col] - m[col][row]).abs() / (scale[row] * scale[col]);
            let is_sound = skew < 1e-9 && (row > col || rest > 1e-14);
            if !is_sound {
                return Err(StructureError::Stiffness { row, pivot: rest });
            }
            l[row][col] = if row == col {
                rest.sqrt()
            } else {
                rest / l[col][col]
            };
        }
    }
    let column = |j: usize| {
        let mut x = [0.0; 6];
        x[j] = 1.0 / scale[j];
        for i in 0..6 {
            let known: f64 = (0..i).map(|k| l[i][k] * x[k]).sum();
            x[i] = (x[i] - known) / l[i][i];
        }
        for i in (0..6).rev() {
            let known: f64 = (i + 1..6).map(|k| l[k][i] * x[k]).sum();
            x[i] = (x[i] - known) / l[i][i];
        }
        std::array::from_fn(|i| x[i] / scale[i])
    };
    Ok(std::array::from_fn(column)) // symmetric: columns are rows
}
