//! Material and thickness of a region of a shell, as stiffness of its section.

use wingbeat_math::{DMat3, DVec3};

use super::ShellError;

/// Shear correction of a homogeneous plate \[1\] [Reissner 1945].
const SHEAR_CORRECTION: f64 = 5.0 / 6.0;

/// A homogeneous orthotropic sheet in plane stress.
///
/// ```
/// use wingbeat_structure::Lamina;
/// let cuticle = Lamina::isotropic(3.0e9, 0.49, 2e-6, 1200.0); // 2 um thick
/// let d11 = 3.0e9 * 2e-6_f64.powi(3) / 12.0 / (1.0 - 0.49 * 0.49); // E h^3 / (12 (1 - nu^2))
/// assert!((cuticle.section().unwrap().bending.x_axis.x - d11).abs() < 1e-15 * d11);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Lamina {
    /// Young's moduli along and across the fibres \[Pa\].
    pub young: [f64; 2],
    /// Poisson's ratio nu_12: contraction across for tension along the fibres \[1\].
    pub poisson: f64,
    /// Shear modulus G_12 \[Pa\], also that of transverse shear.
    pub shear: f64,
    /// Thickness \[m\].
    pub thickness: f64,
    /// Density \[kg/m3\].
    pub density: f64,
    /// Mass per area that carries nothing \[kg/m2\]: scales, paint.
    pub added_mass: f64,
    /// Direction of the fibres \[1\], W components at rest; only its part in the tangent plane counts.
    pub axis: DVec3,
    /// Tension at rest in fibre axes \[N/m\]: N_11, N_22, N_12.
    pub prestress: [f64; 3],
}

impl Lamina {
    /// A sheet alike in all directions: Young's modulus \[Pa\], Poisson's ratio \[1\], thickness \[m\], density
    /// \[kg/m3\].
    pub fn isotropic(young: f64, poisson: f64, thickness: f64, density: f64) -> Self {
        Self {
            young: [young; 2],
            poisson,
            shear: young / (2.0 * (1.0 + poisson)),
            thickness,
            density,
            added_mass: 0.0,
            axis: DVec3::X,
            prestress: [0.0; 3],
        }
    }

    /// Stiffness per area and thickness in plane stress, fibre axes, rows and columns 11, 22, 12 (engineering shear)
    /// \[Pa\].
    fn plane_stress(&self) -> DMat3 {
        let [e1, e2] = self.young;
        let q = 1.0 / (1.0 - self.poisson * self.poisson * e2 / e1);
        let coupling = q * self.poisson * e2;
        DMat3::from_cols(
            DVec3::new(q * e1, coupling, 0.0),
            DVec3::new(coupling, q * e2, 0.0),
            DVec3::new(0.0, 0.0, self.shear),
        )
    }

    /// Stiffness and mass of the sheet.
    ///
    /// # Errors
    /// [`ShellError::Material`] names the first number that no material has.
    pub fn section(&self) -> Result<ShellSection, ShellError> {
        self.check()?;
        let (q, h) = (self.plane_stress(), self.thickness);
        Ok(ShellSection {
            membrane: q * h,
            bending: q * (h.powi(3) / 12.0),
            shear: SHEAR_CORRECTION * self.shear * h,
            prestress: DVec3::from_array(self.prestress),
            area_density: self.density * h + self.added_mass,
            rotary_inertia: self.density * h.powi(3) / 12.0,
            axis: self.axis,
        })
    }

    /// Refuses numbers that no material has.
    fn check(&self) -> Result<(), ShellError> {
        let positive = [
            ("young[0]", self.young[0]),
            ("young[1]", self.young[1]),
            ("shear", self.shear),
            ("thickness", self.thickness),
        ];
        for (name, value) in positive {
            ShellError::require(name, value, value > 0.0, "> 0")?;
        }
        for (name, value) in [("density", self.density), ("added_mass", self.added_mass)] {
            ShellError::require(name, value, value >= 0.0, ">= 0")?;
        }
        let limit = self.young[0] / self.young[1];
        let stable = self.poisson * self.poisson < limit;
        ShellError::require("poisson", self.poisson, stable, "below sqrt(E1/E2) in size")?;
        for tension in self.prestress {
            ShellError::require("prestress", tension, true, "finite")?;
        }
        Ok(())
    }
}

/// Stiffness and mass per area of a shell: of a [`Lamina`], or of a corrugated or layered sheet by its own numbers.
/// Matrices have rows and columns 11, 22, 12 in fibre axes and work on (e_11, e_22, 2 e_12).
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ShellSection {
    /// Membrane stiffness A: tensions of strains \[N/m\], positive definite.
    pub membrane: DMat3,
    /// Bending stiffness D: moments of curvatures \[N m\], positive definite, or zero for a membrane, without stiffness
    /// in shear, too: attitudes of its nodes have no stiffness but about the normal, and are to be held or joined to
    /// beams.
    pub bending: DMat3,
    /// Stiffness of transverse shear \[N/m\], correction included.
    pub shear: f64,
    /// Tension at rest N_11, N_22, N_12 \[N/m\].
    pub prestress: DVec3,
    /// Mass per area \[kg/m2\].
    pub area_density: f64,
    /// Rotary inertia per area, `rho h^3 / 12` \[kg\].
    pub rotary_inertia: f64,
    /// Direction of fibre axis 1, W components at rest; only its part in the tangent plane counts.
    pub axis: DVec3,
}

impl ShellSection {
    /// Refuses a stiffness that is not symmetric and positive definite (bending may vanish) and negative masses.
    pub(super) fn check(&self) -> Result<(), ShellError> {
        let definite = |m: DMat3| {
            let minor = m.x_axis.x * m.y_axis.y - m.x_axis.y * m.y_axis.x;
            m == m.transpose() && m.x_axis.x > 0.0 && minor > 0.0 && m.determinant() > 0.0
        };
        let stiff = self.membrane.x_axis.x;
        let word = "a symmetric positive definite matrix";
        ShellError::require("membrane[0][0]", stiff, definite(self.membrane), word)?;
        let bending = self.bending == DMat3::ZERO || definite(self.bending);
        ShellError::require("bending[0][0]", self.bending.x_axis.x, bending, word)?;
        let resists = self.shear > 0.0 || self.bending == DMat3::ZERO;
        ShellError::require("shear", self.shear, resists, "> 0 where bending is")?;
        let (m, j) = (self.area_density, self.rotary_inertia);
        ShellError::require("area_density", m, m >= 0.0, ">= 0")?;
        ShellError::require("rotary_inertia", j, j >= 0.0, ">= 0")?;
        let tension = self.prestress.length();
        ShellError::require("prestress", tension, tension.is_finite(), "finite")
    }
}
