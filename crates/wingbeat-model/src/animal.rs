//! The animal as the solver sees it: meshes, masses, hinges, motions; checks and scaling.

use crate::deformation::{Deformation, span};
use crate::error::ModelError;
use crate::mesh::integrate::scaled_properties;
use crate::mesh::{GridMesh, QuadMesh, Side};
use crate::motion::WingMotion;
use crate::structure::{Blank, WingStructure};
use wingbeat_math::{DVec3, MassProperties, mirrored};

/// A wing: flat or cambered surface with its hinge, mass and prescribed motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Wing {
    /// Name, unique in the animal.
    pub name: String,
    /// Left or right.
    pub side: Side,
    /// Hinge in the body frame \[m\].
    pub hinge_b: DVec3,
    /// Surface in the wing frame (origin = hinge) \[m\].
    pub mesh: GridMesh,
    /// Mass properties about the origin of the wing frame.
    pub mass: MassProperties,
    /// Prescribed rotation relative to the body.
    pub motion: WingMotion,
    /// Prescribed deformation of the surface, if any; the mass stays where it is.
    pub deformation: Option<Deformation>,
    /// What it is made of, if loads bend it; rigid otherwise.
    pub structure: Option<WingStructure>,
}

impl Wing {
    /// The wing on the other side by mirror symmetry: mesh, hinge, mass and motion.
    pub fn mirrored(&self, name: &str) -> Self {
        let flip = wingbeat_math::DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0));
        Self {
            name: name.to_owned(),
            side: self.side.other(),
            hinge_b: mirrored(self.hinge_b),
            mesh: self.mesh.mirrored(),
            mass: MassProperties {
                mass: self.mass.mass,
                first_moment: flip * self.mass.first_moment,
                inertia: flip * self.mass.inertia * flip,
            },
            motion: self.motion.mirrored(),
            deformation: self.deformation.clone(),
            structure: self.structure.clone(),
        }
    }

    /// Whether all its angles are constant, and its shape is, too.
    pub fn is_still(&self) -> bool {
        let shape = self.deformation.as_ref();
        self.motion.angles.are_constant() && shape.is_none_or(Deformation::is_steady)
    }

    /// Corner nodes of all panels, normal +axis 3.
    pub fn panels(&self) -> Vec<[usize; 4]> {
        self.mesh.panels(self.side)
    }

    /// The same wing with a prescribed deformation.
    ///
    /// # Errors
    /// As [`Deformation::check`]; a panel that loses its area at rest is found by the air.
    pub fn deformed_by(self, deformation: Deformation) -> Result<Self, ModelError> {
        deformation.check(&self.name, self.root(), &self.motion)?;
        Ok(Self {
            deformation: Some(deformation),
            ..self
        })
    }

    /// Whether its surface is given as it was measured.
    pub fn has_measured_surface(&self) -> bool {
        (self.deformation.as_ref()).is_some_and(|d| d.surface.is_some())
    }

    /// The same wing made of `structure`: its mass becomes that of the elastic body.
    ///
    /// # Errors
    /// A number that is not allowed; a wing whose shape is prescribed; what the elastic body refuses.
    pub fn made_of(self, structure: WingStructure) -> Result<Self, ModelError> {
        structure.check(&self.name, self.root())?;
        structure.check_mass(&self.name, self.mass.mass)?;
        if self.deformation.is_some() {
            return Err(ModelError::TwoShapes(self.name));
        }
        let body = structure.body(&self.blank())?.structure;
        Ok(Self {
            mass: body.mass_properties(body.rest()) + body.remainder(),
            structure: Some(structure),
            ..self
        })
    }

    /// What an elastic body is made from.
    pub fn blank(&self) -> Blank<'_> {
        Blank {
            name: &self.name,
            mesh: &self.mesh,
            mass: self.mass.mass,
        }
    }

    /// Wing length R: distance of the tip from the hinge along the span \[m\].
    pub fn length(&self) -> f64 {
        (self.mesh.nodes.iter()).fold(0.0, |most, x| most.max(x.y.abs()))
    }

    /// Least distance of the surface from the hinge along the span over the largest.
    pub fn root(&self) -> f64 {
        let [root, tip] = span(&self.mesh);
        root / tip
    }
}

/// A closed part of the body: head, thorax, abdomen.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyPart {
    /// Name, unique in the animal.
    pub name: String,
    /// Closed surface in the body frame \[m\], normals outward.
    pub mesh: QuadMesh,
    /// Volume \[m3\] and centre of what it encloses, body frame \[m\]: of a surface of revolution those of the round
    /// solid, whatever the panels.
    pub enclosed: (f64, DVec3),
    /// Mass properties about the origin of the body frame (zero where the mass is given for the
    /// whole body).
    pub mass: MassProperties,
}

/// A rigid body beside the central body and the wings: an abdomen that moves, a head, the arm of a
/// wing. How it is joined to the others is the dynamics' matter.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Name, unique in the animal.
    pub name: String,
    /// Origin of its frame in the body frame \[m\] in the posture of reference, in which the axes
    /// of both frames are parallel.
    pub origin_b: DVec3,
    /// Mass properties about the origin of its frame.
    pub mass: MassProperties,
    /// Closed surfaces in its frame; may be empty.
    pub parts: Vec<BodyPart>,
}

/// Body and wings.
#[derive(Clone, Debug, PartialEq)]
pub struct Animal {
    /// Name.
    pub name: String,
    /// Mass properties of the central body (without wings) about the body frame origin.
    pub body: MassProperties,
    /// Closed surfaces of the body; may be empty.
    pub parts: Vec<BodyPart>,
    /// Wings; may be empty.
    pub wings: Vec<Wing>,
    /// Further bodies; mostly empty.
    pub segments: Vec<Segment>,
}

impl Animal {
    /// Whether loads bend any of its wings.
    pub fn is_elastic(&self) -> bool {
        self.wings.iter().any(|w| w.structure.is_some())
    }

    /// Wing length R of the longest wing, hinge to tip along the span \[m\]; 0 without wings.
    pub fn wing_length(&self) -> f64 {
        self.wings.iter().map(Wing::length).fold(0.0, f64::max)
    }

    /// Distance of the farthest wing node from its hinge \[m\]; 0 without wings. With its chord it is more than
    /// the wing length: by 0.1 % in a fruit fly, by a fifth in wings that are wide at the tip.
    pub fn wing_reach(&self) -> f64 {
        let nodes = self.wings.iter().flat_map(|w| &w.mesh.nodes);
        nodes.fold(0.0, |m, r| m.max(r.length()))
    }

    /// Total mass \[kg\].
    pub fn mass(&self) -> f64 {
        let wings = self.wings.iter().map(|w| w.mass.mass);
        let segments = self.segments.iter().map(|s| s.mass.mass);
        self.body.mass + wings.sum::<f64>() + segments.sum::<f64>()
    }

    /// Volumes that closed parts enclose \[m3\] with their centres \[m\], each in the frame of its body: the index of the
    /// body (0 the central one, then the wings, then the segments) and both, where there is any.
    pub fn solids(&self) -> Vec<(usize, f64, DVec3)> {
        let own = std::iter::once((0, &self.parts));
        let first = 1 + self.wings.len();
        let others = self.segments.iter().enumerate();
        let all = own.chain(others.map(|(k, s)| (first + k, &s.parts)));
        all.filter_map(|(body, parts)| {
            let (volume, centre) = solid(parts)?;
            Some((body, volume, centre))
        })
        .collect()
    }

    /// Centre of the volume that the parts of the central body enclose, without parts its mass centre \[m\],
    /// body frame. What is rounding beside the size of the parts is zero.
    pub fn body_centre(&self) -> DVec3 {
        solid(&self.parts).map_or_else(|| self.body.centre(), |(_, centre)| centre)
    }

    /// Body length L \[m\]: extent of the parts of body and segments along b1 in the posture of
    /// reference; 0 without parts.
    pub fn body_length(&self) -> f64 {
        let own = self.parts.iter().map(|p| p.mesh.bounds());
        let others = self.segments.iter().flat_map(|s| {
            let shifted = |p: &BodyPart| p.mesh.bounds().map(|x| x + s.origin_b);
            s.parts.iter().map(shifted)
        });
        let ends = own.chain(others);
        let fold = |[lo, hi]: [f64; 2], [a, b]: [DVec3; 2]| [lo.min(a.x), hi.max(b.x)];
        let [lo, hi] = ends.fold([f64::INFINITY, f64::NEG_INFINITY], fold);
        (hi - lo).max(0.0)
    }

    /// The same animal `s` times as large, with the same proportions and materials: lengths x s,
    /// masses x s^3, inertias x s^5. Angles, frequency and starting time stay as they are.
    pub fn scaled(&self, s: f64) -> Result<Self, ModelError> {
        crate::error::positive("scale", s)?;
        let wing = |w: &Wing| Wing {
            hinge_b: w.hinge_b * s,
            mesh: w.mesh.scaled(s),
            mass: scaled_properties(&w.mass, s),
            deformation: w.deformation.as_ref().map(|d| d.scaled(s)),
            structure: w.structure.as_ref().map(|x| x.scaled(s)),
            ..w.clone()
        };
        let part = |p: &BodyPart| BodyPart {
            name: p.name.clone(),
            mesh: p.mesh.map(|x| x * s),
            enclosed: (p.enclosed.0 * s.powi(3), p.enclosed.1 * s),
            mass: scaled_properties(&p.mass, s),
        };
        let segment = |x: &Segment| Segment {
            name: x.name.clone(),
            origin_b: x.origin_b * s,
            mass: scaled_properties(&x.mass, s),
            parts: x.parts.iter().map(part).collect(),
        };
        Ok(Self {
            name: self.name.clone(),
            body: scaled_properties(&self.body, s),
            parts: self.parts.iter().map(part).collect(),
            wings: self.wings.iter().map(wing).collect(),
            segments: self.segments.iter().map(segment).collect(),
        })
    }
}

/// Volume \[m3\] that parts enclose together, and its centre \[m\], what is rounding beside their size zero; none where
/// they enclose nothing.
fn solid(parts: &[BodyPart]) -> Option<(f64, DVec3)> {
    /// Part of the size of the parts that moving the origin leaves as rounding.
    const ROUNDING: f64 = 1e-12;
    let solids = parts.iter().map(|p| p.enclosed);
    let (volume, moment) = solids.fold((0.0, DVec3::ZERO), |(v, s), (volume, centre)| {
        (v + volume, s + volume * centre)
    });
    if volume <= 0.0 {
        return None;
    }
    let nodes = parts.iter().flat_map(|p| &p.mesh.nodes);
    let size = nodes.fold(0.0, |most: f64, x| most.max(x.length()));
    let felt = |x: f64| if x.abs() < ROUNDING * size { 0.0 } else { x };
    let centre = (moment / volume).to_array().map(felt);
    Some((volume, DVec3::from_array(centre)))
}
