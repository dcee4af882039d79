//! Lumped masses on a beam.

use wingbeat_math::{DMat3, DVec3, MassProperties};

use crate::error::{ModelError, require};

/// A rigid body on the beam of a wing: ballast, a store at the tip, the parts of a wing beside its spar. It
/// moves with a node of the beam of its own, or with one that it lies at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamMass {
    /// Its place along the beam, r/R \[1\].
    pub at: f64,
    /// Mass \[kg\].
    pub mass: f64,
    /// Mass centre from the elastic axis there, wing components of a right wing \[m\]; that of a left one is
    /// its mirror image.
    pub offset: DVec3,
    /// Inertia about the mass centre, wing components of a right wing \[kg m2\].
    pub inertia: DMat3,
}

impl BeamMass {
    /// Mass properties about a node, in wing axes: `axis` is the place of the elastic axis seen from the node
    /// \[m\], `side` 1 on a right wing and -1 on a left one.
    pub(super) fn about_node(&self, axis: DVec3, side: f64) -> MassProperties {
        let mirror = DMat3::from_diagonal(DVec3::new(1.0, side, 1.0));
        let inertia = mirror * self.inertia * mirror;
        MassProperties::about_centre(self.mass, axis + mirror * self.offset, inertia)
    }

    pub(super) fn scaled(&self, s: f64) -> Self {
        Self {
            at: self.at,
            mass: s.powi(3) * self.mass,
            offset: s * self.offset,
            inertia: s.powi(5) * self.inertia,
        }
    }

    /// Checks the mass at `key` on a surface that begins at `root` = r/R.
    pub(super) fn check(&self, key: &str, root: f64) -> Result<(), ModelError> {
        let of = |k: &str| format!("{key}.{k}");
        let on = (root..=1.0).contains(&self.at);
        require(
            &of("at"),
            self.at,
            on,
            "on the surface, r/R from its root to 1",
        )?;
        let sound = self.mass.is_finite() && self.mass >= 0.0;
        require(&of("mass"), self.mass, sound, "a finite number >= 0")?;
        let far = self.offset.length();
        require(&of("offset"), far, far.is_finite(), "finite numbers")?;
        let body = MassProperties::about_centre(self.mass, DVec3::ZERO, self.inertia);
        let largest = self.inertia.to_cols_array().into_iter().fold(0.0, f64::max);
        let allowed = "moments of inertia that some distribution of mass has";
        require(&of("inertia"), largest, body.validate().is_ok(), allowed)?;
        Ok(())
    }
}
