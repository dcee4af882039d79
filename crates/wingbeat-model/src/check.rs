//! Sanity of a whole animal, and a report of the sizes its meshes really have.

use std::collections::BTreeSet;

use wingbeat_math::{DVec3, MassProperties};
use wingbeat_structure::NODE;

use crate::animal::{Animal, BodyPart, Wing};
use crate::error::{ModelError, require};
use crate::mesh::integrate;
use crate::mesh::{QuadMesh, Side};
use crate::structure::Members;

/// Sizes of one wing, measured on its mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct WingReport {
    /// Name of the wing.
    pub name: String,
    /// Wing length R: distance of the tip from the hinge along the span \[m\].
    pub length: f64,
    /// Area S \[m2\].
    pub area: f64,
    /// Mean chord S/R \[m\].
    pub mean_chord: f64,
    /// Largest chord on a line of nodes \[m\].
    pub max_chord: f64,
    /// Radius of the first moment of area about the hinge over R \[1\].
    pub r1_hat: f64,
    /// Radius of the second moment of area about the hinge over R \[1\].
    pub r2_hat: f64,
    /// Mass \[kg\].
    pub mass: f64,
    /// Number of panels.
    pub panels: usize,
}

/// What the elastic body of a wing consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticReport {
    /// Name of the wing.
    pub name: String,
    /// Whether it is a sheet, or else a beam.
    pub is_sheet: bool,
    /// Number of nodes of the structure.
    pub nodes: usize,
    /// How many of them do not move against the frame of the wing.
    pub held: usize,
    /// By how much nodes of the mesh are off at rest, where tension pulls at free edges and these give way \[m\].
    pub slack: f64,
}

/// Displacement over the length of a wing that is rounding \[1\].
const ROUNDING: f64 = 1e-12;

impl Wing {
    /// What its elastic body consists of; none of a rigid wing.
    pub fn elastic_report(&self) -> Option<ElasticReport> {
        let made = self.structure.as_ref()?;
        let body = made.body(&self.blank()).ok()?; // checked when the wing was made of it
        let structure = &body.structure;
        let free: BTreeSet<usize> = structure.free_numbers().iter().map(|k| k / NODE).collect();
        let places = body.followers.iter().zip(&self.mesh.nodes);
        let moved = places.map(|(f, x)| f.position(structure.rest()).distance(*x));
        let slack = moved.fold(0.0, f64::max);
        Some(ElasticReport {
            name: self.name.clone(),
            is_sheet: matches!(made.members, Members::Shell(_)),
            nodes: structure.nodes(),
            held: structure.nodes() - free.len(),
            slack: if slack > ROUNDING * structure.size() {
                slack
            } else {
                0.0
            },
        })
    }

    /// Sizes measured on the mesh.
    pub fn report(&self) -> WingReport {
        let quads = self.mesh.to_quads(Side::Right);
        let moments = integrate::shell(&quads, |_| 1.0);
        let area = moments.mass;
        let length = self.length();
        let chord = |j: usize| {
            let (lead, trail) = (self.mesh.node(0, j), self.mesh.node(self.mesh.rows, j));
            (self.mesh.nodes[lead] - self.mesh.nodes[trail]).length()
        };
        let max_chord = (0..=self.mesh.cols).map(chord).fold(0.0, f64::max);
        let j = moments.inertia;
        let second = 0.5 * (j.x_axis.x + j.z_axis.z - j.y_axis.y); // int y^2 dA
        WingReport {
            name: self.name.clone(),
            length,
            area,
            mean_chord: area / length,
            max_chord,
            r1_hat: moments.first_moment.y.abs() / (area * length),
            r2_hat: (second / area).sqrt() / length,
            mass: self.mass.mass,
            panels: quads.quads.len(),
        }
    }
}

impl Animal {
    /// Sizes of all wings, measured on their meshes.
    pub fn wing_reports(&self) -> Vec<WingReport> {
        self.wings.iter().map(Wing::report).collect()
    }

    /// Mean chord of all wings, the sum of their areas over that of their lengths \[m\]: what lengths in mean chords
    /// mean; none without wings.
    pub fn mean_chord(&self) -> Option<f64> {
        let wings = self.wing_reports();
        let area = wings.iter().map(|w| w.area).sum::<f64>();
        let length = wings.iter().map(|w| w.length).sum::<f64>();
        (!wings.is_empty()).then(|| area / length)
    }

    /// Checks meshes, masses, hinges and motions.
    ///
    /// # Errors
    /// The first thing that makes the animal unfit for simulation, see [`ModelError`].
    pub fn check(&self) -> Result<(), ModelError> {
        self.check_with(|_| false)
    }

    /// The same; wings that others carry (`is_carried`) hinge far from the body.
    ///
    /// # Errors
    /// As [`Self::check`].
    pub fn check_with(&self, is_carried: impl Fn(&Wing) -> bool) -> Result<(), ModelError> {
        check_mass("body", &self.body)?;
        let m = self.mass();
        require("mass of the animal", m, m > 0.0, "> 0 kg")?;
        for part in &self.parts {
            part.mesh.check_closed(&part.name)?;
            check_mass(&part.name, &part.mass)?;
        }
        for s in &self.segments {
            check_mass(&s.name, &s.mass)?;
            for part in &s.parts {
                part.mesh.check_closed(&part.name)?;
                check_mass(&part.name, &part.mass)?;
            }
        }
        for wing in &self.wings {
            wing.mesh.check(&wing.name)?;
            check_mass(&wing.name, &wing.mass)?;
            wing.motion.check(&wing.name)?;
            if let Some(deformation) = &wing.deformation {
                deformation.check(&wing.name, wing.root(), &wing.motion)?;
            }
            if let Some(structure) = &wing.structure {
                structure.check(&wing.name, wing.root())?;
            }
            self.check_hinge(wing, is_carried(wing))?;
        }
        Ok(())
    }

    /// A hinge farther from every surface of body and segments, in the posture of reference, than half the extent of
    /// them all is a mistake of unit or sign, but of a wing that another one carries.
    fn check_hinge(&self, wing: &Wing, is_carried: bool) -> Result<(), ModelError> {
        for k in 0..3 {
            crate::error::finite(&format!("{}.hinge[{k}]", wing.name), wing.hinge_b[k])?;
        }
        let own = self.parts.iter().map(|p| (p, DVec3::ZERO));
        let others = (self.segments.iter()).flat_map(|s| s.parts.iter().map(|p| (p, s.origin_b)));
        let all = || own.clone().chain(others.clone());
        let to_part = |(p, origin): (&BodyPart, DVec3)| distance(&p.mesh, wing.hinge_b - origin);
        let nearest = all().map(to_part).fold(f64::INFINITY, f64::min);
        let limit = 0.5 * extent(all());
        if all().next().is_none() || nearest <= limit || is_carried {
            return Ok(());
        }
        Err(ModelError::FarHinge {
            wing: wing.name.clone(),
            distance: nearest,
            limit,
        })
    }
}

/// Largest extent of parts, each with the origin of its frame, along an axis of the body \[m\].
fn extent<'a>(parts: impl Iterator<Item = (&'a BodyPart, DVec3)>) -> f64 {
    let far = DVec3::splat(f64::INFINITY);
    let grown = |[lo, hi]: [DVec3; 2], (p, origin): (&BodyPart, DVec3)| {
        let [a, b] = p.mesh.bounds().map(|x| x + origin);
        [lo.min(a), hi.max(b)]
    };
    let [lo, hi] = parts.fold([far, -far], grown);
    (hi - lo).max_element()
}

fn check_mass(of: &str, mass: &MassProperties) -> Result<(), ModelError> {
    mass.validate().map_err(|source| ModelError::Mass {
        of: of.to_owned(),
        source,
    })
}

/// Distance from a point to a surface, panels taken as two triangles \[m\].
pub fn distance(mesh: &QuadMesh, p: DVec3) -> f64 {
    let to_panel = |k: usize| {
        let [a, b, c, d] = mesh.corners(k);
        triangle_distance(p, [a, b, c]).min(triangle_distance(p, [a, c, d]))
    };
    (0..mesh.quads.len())
        .map(to_panel)
        .fold(f64::INFINITY, f64::min)
}

/// Distance to the plane where the foot of the perpendicular is inside, else to the edges.
fn triangle_distance(p: DVec3, t: [DVec3; 3]) -> f64 {
    let n = (t[1] - t[0]).cross(t[2] - t[0]);
    let left_of = |k: usize| n.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k])) >= 0.0;
    if n.length_squared() > 0.0 && (0..3).all(left_of) {
        return (p - t[0]).dot(n).abs() / n.length();
    }
    let to_edge = |k: usize| segment_distance(p, t[k], t[(k + 1) % 3]);
    (0..3).map(to_edge).fold(f64::INFINITY, f64::min)
}

fn segment_distance(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let ab = b - a;
    let s = ((p - a).dot(ab) / ab.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (p - a - ab * s).length()
}
