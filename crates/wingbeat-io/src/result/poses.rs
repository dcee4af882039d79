//! Where the surfaces of an animal are, from a row of its history: wings and body parts carried
//! along by their bodies, wings deformed as the case says.

use wingbeat_math::{DMat3, DVec3, EulerSequence};
use wingbeat_model::{Animal, DeformingMesh, WingMotion};

use super::columns::body_names;

/// Column of the time.
const TIME: usize = 1;

/// A surface that its body carries along.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Name of the wing or body part.
    pub name: String,
    /// Body: 0, or 1 + number of the wing.
    pub body: usize,
    /// Nodes in the axes of the body \[m\]; at rest where they are deformed.
    pub nodes: Vec<DVec3>,
    /// How it is deformed, in the phase of which motion.
    deforming: Option<(DeformingMesh, WingMotion)>,
    /// Panels as four nodes.
    pub quads: Vec<[usize; 4]>,
}

/// The surfaces of an animal and where its coordinates stand in a row.
#[derive(Clone, Debug)]
pub struct Poses {
    /// Wings first, in the animal's order, then the parts of the body.
    pub surfaces: Vec<Surface>,
    places: Vec<usize>,
}

impl Poses {
    /// For an animal and the columns of a history; none if they do not fit together.
    pub fn new(animal: &Animal, names: &[String]) -> Option<Self> {
        let wings = animal.wings.iter().enumerate().map(|(k, w)| Surface {
            name: w.name.clone(),
            body: k + 1,
            nodes: w.mesh.nodes.clone(),
            deforming: (w.deformation.as_ref())
                .map(|d| (DeformingMesh::new(&w.mesh, d), w.motion.clone())),
            quads: w.panels(),
        });
        let parts = animal.parts.iter().map(|p| Surface {
            name: p.name.clone(),
            body: 0,
            nodes: p.mesh.nodes.clone(),
            deforming: None,
            quads: p.mesh.quads.clone(),
        });
        let place = |body: &String| names.iter().position(|n| *n == format!("{body}_x_m"));
        let places: Option<Vec<usize>> = body_names(animal).iter().map(place).collect();
        Some(Self {
            surfaces: wings.chain(parts).collect(),
            places: places?,
        })
    }

    /// Position of the origin \[m, N\] and rotation to N of a body.
    pub fn pose(&self, row: &[f64], body: usize) -> (DVec3, DMat3) {
        let q = &row[self.places[body]..][..6];
        let sequence = match body {
            0 => EulerSequence::BODY_231,
            _ => EulerSequence::WING_132,
        };
        let angles = DVec3::from_slice(&q[3..]);
        (DVec3::from_slice(q), sequence.rotation(angles))
    }

    /// Nodes of a surface, N components \[m\].
    pub fn nodes(&self, row: &[f64], surface: usize) -> impl Iterator<Item = DVec3> {
        let s = &self.surfaces[surface];
        let (p, r) = self.pose(row, s.body);
        let nodes = match &s.deforming {
            None => s.nodes.clone(),
            Some((mesh, motion)) => mesh.places(motion.phase_at(row[TIME])[0]),
        };
        nodes.into_iter().map(move |x| p + r * x)
    }
}

/// Picture axes (n1, -n2, -n3): x forward, y to the left, z up.
pub fn picture(x: DVec3) -> [f64; 3] {
    [x.x, -x.y, -x.z]
}
