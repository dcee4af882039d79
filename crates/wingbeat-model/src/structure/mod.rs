//! What a wing is made of: how it bends and twists under loads.
//!
//! A wing with a structure is an elastic body that is clamped to the wing frame at its root; the nodes of its
//! mesh follow the nodes of the elastic body. Stiffness is given from a few numbers, as laws along the span;
//! mass is the wing's, spread over the structure.

mod beam;
mod body;
mod region;
mod shell;
mod vein;

pub use crate::error::{MemberError, WingStructureError};
pub use beam::{BeamMass, Coupling, WingBeam};
pub use body::{Blank, ElasticBody};
pub use region::Region;
pub use shell::WingShell;
pub use vein::{Vein, VeinStiffness};

pub use wingbeat_structure::Damping;

use crate::error::{ModelError, require};

/// What a wing is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct WingStructure {
    /// Its members.
    pub members: Members,
    /// Damping.
    pub damping: Damping,
    /// Part of its amplitude that a motion of the highest frequencies keeps in a step \[1\].
    pub spectral_radius: f64,
}

/// What carries the loads of a wing.
#[derive(Clone, Debug, PartialEq)]
pub enum Members {
    /// A beam along the span: whole slender wings, leading-edge spars, shafts of feathers.
    Beam(WingBeam),
    /// A shell on the panels of the mesh, with veins: membranes of insects, plates, foils that bend along the chord.
    Shell(WingShell),
}

impl WingStructure {
    /// The elastic body of a wing.
    ///
    /// # Errors
    /// What the elastic body refuses.
    pub fn body(&self, wing: &Blank<'_>) -> Result<ElasticBody, WingStructureError> {
        let body = match &self.members {
            Members::Beam(beam) => beam.body(wing, self.damping).map_err(MemberError::from),
            Members::Shell(shell) => shell.body(wing, self.damping),
        };
        body.map_err(|source| WingStructureError {
            wing: wing.name.to_owned(),
            source: Box::new(source),
        })
    }

    /// Of a wing `s` times as large of the same materials: stiffnesses of sections (forces times areas) go with
    /// the fourth power, periods of vibrations so with the first. Times of damping belong to the material and
    /// stay: of the same mode the damping ratio by strain rates (time times frequency) falls with the size,
    /// that by mass rises.
    pub fn scaled(&self, s: f64) -> Self {
        let members = match &self.members {
            Members::Beam(beam) => Members::Beam(beam.scaled(s)),
            Members::Shell(shell) => Members::Shell(shell.scaled(s)),
        };
        Self { members, ..*self }
    }

    /// Checks that the wing `name` has the `mass` \[kg\] that its structure takes from it.
    ///
    /// # Errors
    /// Lumped masses heavier than the wing that they are part of.
    pub fn check_mass(&self, name: &str, mass: f64) -> Result<(), ModelError> {
        match &self.members {
            Members::Beam(beam) => beam.check_mass(&format!("{name}.structure.beam"), mass),
            Members::Shell(_) => Ok(()),
        }
    }

    /// Checks every number of the structure of the wing `name`, whose surface begins at `root` = r/R.
    ///
    /// # Errors
    /// A number that is not allowed, a law that does not cover the span.
    pub fn check(&self, name: &str, root: f64) -> Result<(), ModelError> {
        let key = |k: &str| format!("{name}.structure.{k}");
        let rho = self.spectral_radius;
        let inside = (0.0..=1.0).contains(&rho);
        require(&key("spectral_radius"), rho, inside, "from 0 to 1")?;
        for (k, x) in [
            ("damping_s", self.damping.strain_rate),
            ("mass_damping_per_s", self.damping.mass),
        ] {
            require(
                &key(k),
                x,
                x.is_finite() && x >= 0.0,
                "a finite number >= 0",
            )?;
        }
        match &self.members {
            Members::Beam(beam) => beam.check(&key("beam"), root),
            Members::Shell(shell) => shell.check(&key("shell"), root),
        }
    }
}
