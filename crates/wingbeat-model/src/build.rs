//! From shapes, densities and motions to an animal.

use crate::animal::{Animal, BodyPart, Wing};
use crate::error::{ModelError, positive};
use crate::mesh::integrate::{self, MassInput};
use crate::mesh::revolution::Revolution;
use crate::mesh::{GridMesh, QuadMesh, Side};
use crate::motion::WingMotion;
use crate::planform::WingShape;
use wingbeat_math::{DMat3, DVec3, MassProperties};

impl BodyPart {
    /// A part from a closed mesh in the body frame.
    ///
    /// # Errors
    /// A mesh that is not closed and outward, a mass that is not allowed.
    pub fn new(name: &str, mesh: QuadMesh, mass: &MassInput) -> Result<Self, ModelError> {
        mesh.check_closed(name)?;
        let solid = integrate::solid(&mesh, 1.0);
        Self::enclosing(name, mesh, &solid, mass)
    }

    /// A surface of revolution. Its mass is that of the round solid, its panels are the surface in the air.
    ///
    /// # Errors
    /// As [`Self::new`], and sizes that are not allowed.
    pub fn revolution(
        name: &str,
        shape: &Revolution,
        mass: &MassInput,
    ) -> Result<Self, ModelError> {
        let round = shape.solid(name, 1.0)?;
        Self::enclosing(name, shape.mesh(name)?, &round, mass)
    }

    /// A part within this mesh, of the shape of a `solid` of density 1 kg/m3.
    fn enclosing(
        name: &str,
        mesh: QuadMesh,
        solid: &MassProperties,
        mass: &MassInput,
    ) -> Result<Self, ModelError> {
        Ok(Self {
            name: name.to_owned(),
            mesh,
            enclosed: (solid.mass, solid.centre()),
            mass: mass.of_solid(name, solid)?,
        })
    }

    /// The same in a frame whose origin is at `origin` \[m\]; axes keep their directions.
    pub fn about(&self, origin: DVec3) -> Self {
        Self {
            name: self.name.clone(),
            mesh: self.mesh.map(|x| x - origin),
            enclosed: (self.enclosed.0, self.enclosed.1 - origin),
            mass: self.mass.moved(DMat3::IDENTITY, -origin),
        }
    }
}

impl Wing {
    /// A flat wing.
    ///
    /// # Errors
    /// A planform, mass or motion that is not allowed.
    pub fn new(
        name: &str,
        side: Side,
        hinge_b: DVec3,
        shape: &WingShape,
        mass: &MassInput,
        motion: WingMotion,
    ) -> Result<Self, ModelError> {
        let mesh = shape.mesh(name, side)?;
        Self::with_mesh(name, side, hinge_b, mesh, mass, motion)
    }

    /// A wing of any shape.
    ///
    /// # Errors
    /// A mesh, mass or motion that is not allowed.
    pub fn with_mesh(
        name: &str,
        side: Side,
        hinge_b: DVec3,
        mesh: GridMesh,
        mass: &MassInput,
        motion: WingMotion,
    ) -> Result<Self, ModelError> {
        mesh.check(name)?;
        let mass = mass.of_wing(name, &mesh)?;
        motion.check(name)?;
        Ok(Self {
            name: name.to_owned(),
            side,
            hinge_b,
            mesh,
            mass,
            motion,
            deformation: None,
            structure: None,
        })
    }
}

/// The mass of the central body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyMass {
    /// The sum of its parts.
    FromParts,
    /// The sum of its parts, all scaled to this total \[kg\].
    Total(f64),
    /// Given, about the body frame origin; the parts are then surfaces only.
    Given(MassProperties),
}

impl Animal {
    /// An animal, checked.
    ///
    /// # Errors
    /// Everything [`Animal::check`] finds.
    pub fn new(
        name: &str,
        mass: BodyMass,
        mut parts: Vec<BodyPart>,
        wings: Vec<Wing>,
    ) -> Result<Self, ModelError> {
        let sum = |parts: &[BodyPart]| {
            let masses = parts.iter().map(|p| p.mass);
            masses.fold(MassProperties::ZERO, |a, b| a + b)
        };
        if let BodyMass::Total(total) = mass {
            let have = positive("sum of the masses of the body parts", sum(&parts).mass)?;
            let factor = positive("body.mass", total)? / have;
            parts
                .iter_mut()
                .for_each(|p| p.mass = p.mass.scaled(factor));
        }
        let body = match mass {
            BodyMass::Given(given) => given,
            BodyMass::FromParts | BodyMass::Total(_) => sum(&parts),
        };
        let animal = Self {
            name: name.to_owned(),
            body,
            parts,
            wings,
            segments: vec![],
        };
        animal.check()?;
        Ok(animal)
    }

    /// The same animal with the body frame origin moved to `origin` (body frame \[m\]); axes keep
    /// their directions.
    pub fn with_origin(&self, origin: DVec3) -> Self {
        let moved = |m: &MassProperties| m.moved(DMat3::IDENTITY, -origin);
        let wing = |w: &Wing| Wing {
            hinge_b: w.hinge_b - origin,
            ..w.clone()
        };
        let segment = |s: &crate::Segment| crate::Segment {
            origin_b: s.origin_b - origin,
            ..s.clone()
        };
        Self {
            name: self.name.clone(),
            body: moved(&self.body),
            parts: self.parts.iter().map(|p| p.about(origin)).collect(),
            wings: self.wings.iter().map(wing).collect(),
            segments: self.segments.iter().map(segment).collect(),
        }
    }
}

/// Scales surfaces of revolution about the origin so that they together extend `length` \[m\] along b1, as round as
/// they are: the body length L is kept as given.
///
/// # Errors
/// A length that is not positive, or a shape that is not allowed.
pub fn fit_body_length(shapes: &[Revolution], length: f64) -> Result<Vec<Revolution>, ModelError> {
    positive("body.length", length)?;
    let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
    for shape in shapes {
        let [low, high] = shape.ends_along_b1("body part")?;
        ends = [ends[0].min(low), ends[1].max(high)];
    }
    let factor = length / positive("extent of the body parts along b1", ends[1] - ends[0])?;
    Ok(shapes.iter().map(|s| s.scaled(factor)).collect())
}
