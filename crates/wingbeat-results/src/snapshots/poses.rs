//! Where the surfaces of an animal are, from a row of its history: wings and body parts carried
//! along by their bodies, wings deformed as the case says or bent as their sections are.

mod bent;

use wingbeat_math::{DMat3, DVec3, EulerSequence};
use wingbeat_model::{Animal, BodyPart, DeformingMesh, Wing, WingMotion};

use self::bent::Bent;
use crate::series::columns::column_stems;

/// Column of the time.
const TIME: usize = 1;

/// A surface that its body carries along.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Name of the wing or body part.
    pub name: String,
    /// Body: 0 the central body, then the wings, then the segments.
    pub body: usize,
    /// Nodes in the axes of the body \[m\]; at rest where they are deformed.
    pub nodes: Vec<DVec3>,
    shape: SurfaceShape,
    /// Panels as four nodes.
    pub quads: Vec<[usize; 4]>,
}

/// How nodes move in the axes of their body.
#[derive(Clone, Debug)]
enum SurfaceShape {
    Rigid,
    /// As prescribed, in the phase of the motion.
    Deforming(Box<(DeformingMesh, WingMotion)>),
    /// By what the history says of sections.
    Bent(Bent),
}

impl SurfaceShape {
    fn of(wing: &Wing, names: &[String]) -> Self {
        let bent = wing.structure.as_ref().and_then(|_| Bent::new(wing, names));
        match (&wing.deformation, bent) {
            (Some(d), _) => {
                let mesh = DeformingMesh::new(&wing.mesh, d);
                Self::Deforming(Box::new((mesh, wing.motion.clone())))
            }
            (None, Some(bent)) => Self::Bent(bent),
            (None, None) => Self::Rigid,
        }
    }
}

impl Surface {
    /// A part of the central body or of a segment.
    fn part(part: &BodyPart, body: usize) -> Self {
        Self {
            name: part.name.clone(),
            body,
            nodes: part.mesh.nodes.clone(),
            shape: SurfaceShape::Rigid,
            quads: part.mesh.quads.clone(),
        }
    }
}

/// The surfaces of an animal and where its coordinates stand in a row.
#[derive(Clone, Debug)]
pub struct Poses {
    /// Wings first, in the animal's order, then the parts of the central body, then those of the
    /// segments, as in the lattice.
    pub surfaces: Vec<Surface>,
    /// Wings of the animal.
    wings: usize,
    /// Per body: where its coordinates begin.
    places: Vec<usize>,
}

impl Poses {
    /// For an animal and the columns of a history; none if they do not fit together.
    pub fn new(animal: &Animal, names: &[String]) -> Option<Self> {
        let wings = animal.wings.iter().enumerate().map(|(k, w)| Surface {
            name: w.name.clone(),
            body: k + 1,
            nodes: w.mesh.nodes.clone(),
            shape: SurfaceShape::of(w, names),
            quads: w.panels(),
        });
        let own = animal.parts.iter().map(|p| Surface::part(p, 0));
        let first = animal.wings.len() + 1;
        let others = animal.segments.iter().enumerate();
        let others =
            others.flat_map(|(i, s)| s.parts.iter().map(move |p| Surface::part(p, first + i)));
        let place = |body: &String| names.iter().position(|n| *n == format!("{body}_x_m"));
        let places: Option<Vec<usize>> = column_stems(animal).iter().map(place).collect();
        Some(Self {
            surfaces: wings.chain(own).chain(others).collect(),
            wings: animal.wings.len(),
            places: places?,
        })
    }

    /// Bodies of the animal.
    pub fn bodies(&self) -> usize {
        self.places.len()
    }

    /// Whether a body is a wing.
    pub fn is_wing(&self, body: usize) -> bool {
        (1..=self.wings).contains(&body)
    }

    /// Number of the surface that is the wing of a body; none of other bodies.
    pub fn wing_of(&self, body: usize) -> Option<usize> {
        self.is_wing(body).then(|| body - 1)
    }

    /// Position of the origin \[m, N\] and rotation to N of a body.
    pub fn pose(&self, row: &[f64], body: usize) -> (DVec3, DMat3) {
        let q = &row[self.places[body]..][..6];
        let sequence = match self.is_wing(body) {
            true => EulerSequence::WING_132,
            false => EulerSequence::BODY_231,
        };
        let angles = DVec3::from_slice(&q[3..]);
        (DVec3::from_slice(q), sequence.rotation(angles))
    }

    /// Nodes of a surface in the axes of its body \[m\].
    pub fn shape(&self, row: &[f64], surface: usize) -> Vec<DVec3> {
        let s = &self.surfaces[surface];
        match &s.shape {
            SurfaceShape::Rigid => s.nodes.clone(),
            SurfaceShape::Deforming(prescribed) => {
                let (mesh, motion) = &**prescribed;
                mesh.places(motion.phase_at(row[TIME])[0])
            }
            SurfaceShape::Bent(bent) => bent.places(&s.nodes, row),
        }
    }

    /// Nodes of a surface, N components \[m\].
    pub fn nodes(&self, row: &[f64], surface: usize) -> impl Iterator<Item = DVec3> {
        let (p, r) = self.pose(row, self.surfaces[surface].body);
        let nodes = self.shape(row, surface);
        nodes.into_iter().map(move |x| p + r * x)
    }
}

/// Picture axes (n1, -n2, -n3): x forward, y to the left, z up.
pub fn picture(x: DVec3) -> [f64; 3] {
    [x.x, -x.y, -x.z]
}
