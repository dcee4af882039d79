//! What a wing is made of: how it bends and twists under loads.
//!
//! A wing with a structure is an elastic body that is clamped to the wing frame at its root; the nodes of its mesh follow
//! the nodes of the elastic body. Stiffness is given from a few numbers, as laws along the span; mass is the wing's,
//! spread over the structure.

mod beam;
mod shell;

pub use beam::WingBeam;
pub use shell::WingShell;

use std::fmt;

pub use wingbeat_structure::Damping;
use wingbeat_structure::{Follower, ShellError, Structure, StructureError};

use crate::animal::Wing;
use crate::deformation::SpanLaw;
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
    /// A shell on the panels of the mesh: membranes of insects, plates, foils that bend along the chord.
    Shell(WingShell),
}

/// A wing as an elastic body.
#[derive(Debug)]
pub struct ElasticBody {
    /// Nodes, elements, masses; clamped to the wing frame.
    pub structure: Structure,
    /// How the nodes of the wing's mesh follow, in their order.
    pub followers: Vec<Follower>,
}

/// Why a wing cannot be made of this.
#[derive(Clone, Debug, PartialEq)]
pub struct WingStructureError {
    /// Name of the wing.
    pub wing: String,
    /// What is wrong.
    pub source: Box<MemberError>,
}

/// What is wrong with the members of a wing.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MemberError {
    /// The elastic body.
    #[error(transparent)]
    Body(#[from] StructureError),
    /// A shell.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

impl fmt::Display for WingStructureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "structure of wing `{}`: {}", self.wing, self.source)
    }
}

impl std::error::Error for WingStructureError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(self.source.as_ref())
    }
}

impl WingStructure {
    /// The elastic body of `wing`.
    ///
    /// # Errors
    /// What the elastic body refuses.
    pub fn body(&self, wing: &Wing) -> Result<ElasticBody, WingStructureError> {
        let body = match &self.members {
            Members::Beam(beam) => beam.body(wing, self.damping).map_err(MemberError::from),
            Members::Shell(shell) => shell.body(wing, self.damping),
        };
        body.map_err(|source| WingStructureError {
            wing: wing.name.clone(),
            source: Box::new(source),
        })
    }

    /// Of a wing `s` times as large of the same materials: stiffnesses of sections (forces times areas) go with the fourth
    /// power, times with the first.
    pub fn scaled(&self, s: f64) -> Self {
        let members = match &self.members {
            Members::Beam(beam) => Members::Beam(beam.scaled(s)),
            Members::Shell(shell) => Members::Shell(shell.scaled(s)),
        };
        Self { members, ..*self }
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

/// Values of a law are looked for at so many places.
const PLACES: usize = 65;

/// Refuses a law that is not above 0 all along the span of a wing whose surface begins at `root` = r/R.
fn check_positive(key: &str, law: &SpanLaw, root: f64) -> Result<(), ModelError> {
    for i in 0..PLACES {
        let r = root + (1.0 - root) * i as f64 / (PLACES - 1) as f64;
        let x = law.at(r, root);
        require(key, x, x > 0.0, "above 0 all along the span")?;
    }
    Ok(())
}
