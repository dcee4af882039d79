//! The elastic body of a wing, and what it is made from.

use wingbeat_structure::{Follower, Structure};

use crate::deformation::SpanLaw;
use crate::error::{ModelError, require};
use crate::mesh::GridMesh;

/// A wing before it is elastic.
#[derive(Clone, Copy, Debug)]
pub struct Blank<'a> {
    /// Name of the wing.
    pub name: &'a str,
    /// Surface in the wing frame.
    pub mesh: &'a GridMesh,
    /// Mass \[kg\].
    pub mass: f64,
}

/// A wing as an elastic body.
#[derive(Debug)]
pub struct ElasticBody {
    /// Nodes, elements, masses; clamped to the wing frame.
    pub structure: Structure,
    /// How the nodes of the wing's mesh follow, in their order.
    pub followers: Vec<Follower>,
    /// The node at the tip: of a sheet that of its trailing edge, of a pointed one the point.
    pub tip: usize,
}

/// Values of a law are looked for at so many places.
const PLACES: usize = 65;

/// Refuses a law that is not above 0 all along the span of a wing whose surface begins at `root` = r/R.
pub(super) fn check_positive(key: &str, law: &SpanLaw, root: f64) -> Result<(), ModelError> {
    let allowed = "above 0 all along the span, and at one end no less than 1e-15 of the other";
    for x in places(root).map(|r| law.at(r, root)) {
        require(key, x, x > 0.0, allowed)?;
    }
    Ok(())
}

/// Refuses a law that is below 0 somewhere.
pub(super) fn check_not_negative(key: &str, law: &SpanLaw, root: f64) -> Result<(), ModelError> {
    let allowed = "0 or above all along the span";
    for x in places(root).map(|r| law.at(r, root)) {
        require(key, x, x >= 0.0, allowed)?;
    }
    Ok(())
}

/// What gives the fibres of a sheet a direction: moduli and tensions along and across them \[Pa, N/m\], and a
/// shear modulus that may be that of no sheet alike in all directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fibres {
    pub young: [f64; 2],
    pub shear: Option<f64>,
    pub prestress: [f64; 2],
}

impl Fibres {
    /// Whether they have a direction.
    pub fn count(&self) -> bool {
        let differ = |[a, b]: [f64; 2]| (a - b).abs() > 0.0;
        differ(self.young) || self.shear.is_some() || differ(self.prestress)
    }

    /// Refuses an `angle` \[rad\] of fibres without direction.
    pub fn check(&self, key: &str, angle: f64) -> Result<(), ModelError> {
        let allowed = "0 in a sheet alike in all directions: different moduli or tensions along and across, or a shear modulus, give its fibres a direction";
        require(key, angle, angle.abs() <= 0.0 || self.count(), allowed).map(drop)
    }
}

/// Refuses a ratio of lateral contraction that no sheet of moduli along and across its fibres has \[Pa\].
pub(super) fn check_poisson(key: &str, poisson: f64, [e1, e2]: [f64; 2]) -> Result<(), ModelError> {
    let allowed =
        "above -1 and below sqrt(E_along / E_across), 1 for a sheet alike in all directions";
    let stable = poisson > -1.0 && poisson * poisson < e1 / e2;
    require(key, poisson, stable, allowed).map(drop)
}

/// Refuses a sheet that is pushed at rest: `tension` \[N/m\] along and across its fibres.
pub(super) fn check_tension(key: &str, tension: [f64; 2]) -> Result<(), ModelError> {
    let allowed = "0 or above: a sheet that is pushed buckles";
    (tension.into_iter()).try_for_each(|n| require(key, n, n >= 0.0, allowed).map(drop))
}

/// r/R at which laws are looked at.
fn places(root: f64) -> impl Iterator<Item = f64> {
    (0..PLACES).map(move |i| root + (1.0 - root) * i as f64 / (PLACES - 1) as f64)
}
