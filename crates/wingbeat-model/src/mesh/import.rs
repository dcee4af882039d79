//! Closed body surfaces from OBJ and STL text or bytes (files are opened elsewhere).
//!
//! The lattice wants quadrilaterals. A mesh wholly of quadrilaterals is taken as it is. If any
//! face has another number of corners, every face of n corners is cut into n quadrilaterals by
//! its centre and its edge midpoints: the surface and its closedness stay, triangles give three
//! times as many panels. Nodes at the same place are joined.

use crate::ModelError;
use crate::error::positive;
use crate::mesh::QuadMesh;
use crate::mesh::integrate::volume;
use std::collections::BTreeMap;
use std::io::{BufRead, Cursor};
use wingbeat_math::DVec3;

/// An imported surface and what was done to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The closed surface, normals outward \[m\].
    pub mesh: QuadMesh,
    /// Faces were cut into quadrilaterals.
    pub subdivided: bool,
    /// The normals pointed inward and were reversed.
    pub reversed: bool,
}

/// A closed surface from Wavefront OBJ; coordinates times `unit` are metres. All objects of the
/// text together form the surface.
///
/// # Errors
/// [`ModelError::Import`] for unreadable text or no faces; errors of
/// [`QuadMesh::check_closed`] for a surface that is open or in pieces.
pub fn obj(name: &str, reader: &mut dyn BufRead, unit: f64) -> Result<Imported, ModelError> {
    positive(&format!("{name}.unit"), unit)?;
    let options = tobj::LoadOptions {
        triangulate: false,
        single_index: false,
        ignore_points: true,
        ignore_lines: true,
    };
    let mut reader = reader;
    let no_materials = |_: &std::path::Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut reader, &options, no_materials)
        .map_err(|e| import_error(name, "OBJ", &e.to_string()))?;
    let mut soup = Soup::default();
    for model in &models {
        soup.add_obj(&model.mesh, unit);
    }
    soup.finish(name, "OBJ")
}

/// A closed surface from STL, text or binary; coordinates times `unit` are metres. STL holds
/// triangles in single precision: each becomes three quadrilaterals.
///
/// # Errors
/// As [`obj`].
pub fn stl(name: &str, bytes: &[u8], unit: f64) -> Result<Imported, ModelError> {
    positive(&format!("{name}.unit"), unit)?;
    let found = stl_io::read_stl(&mut Cursor::new(bytes))
        .map_err(|e| import_error(name, "STL", &e.to_string()))?;
    let point =
        |v: &stl_io::Vertex| DVec3::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[2])) * unit;
    let mut soup = Soup::default();
    for face in &found.faces {
        soup.add_face(face.vertices.iter().map(|&k| point(&found.vertices[k])));
    }
    soup.finish(name, "STL")
}

fn import_error(name: &str, format: &'static str, problem: &str) -> ModelError {
    ModelError::Import {
        name: name.to_owned(),
        format,
        problem: problem.to_owned(),
    }
}

/// Faces with nodes joined where all coordinates are equal.
#[derive(Default)]
struct Soup {
    nodes: Vec<DVec3>,
    index: BTreeMap<[u64; 3], usize>,
    faces: Vec<Vec<usize>>,
}

impl Soup {
    fn add_obj(&mut self, mesh: &tobj::Mesh, unit: f64) {
        let point = |&k: &u32| {
            let at = 3 * k as usize;
            DVec3::from_slice(&mesh.positions[at..at + 3]) * unit
        };
        // The library leaves the list of corner counts empty when all faces are triangles.
        let triangles = vec![3; mesh.indices.len() / 3];
        let arities = if mesh.face_arities.is_empty() {
            &triangles
        } else {
            &mesh.face_arities
        };
        let mut from = 0;
        for &n in arities {
            let to = from + n as usize;
            self.add_face(mesh.indices[from..to].iter().map(point));
            from = to;
        }
    }

    fn add_face(&mut self, points: impl Iterator<Item = DVec3>) {
        let face = points.map(|p| self.node(p)).collect();
        self.faces.push(face);
    }

    fn node(&mut self, p: DVec3) -> usize {
        let key = (p + DVec3::ZERO).to_array().map(f64::to_bits); // -0 + 0 = 0
        let next = self.nodes.len();
        let found = *self.index.entry(key).or_insert(next);
        if found == next {
            self.nodes.push(p);
        }
        found
    }

    fn finish(self, name: &str, format: &'static str) -> Result<Imported, ModelError> {
        if self.faces.is_empty() {
            return Err(import_error(name, format, "it has no faces"));
        }
        let subdivided = self.faces.iter().any(|f| f.len() != 4);
        let mesh = if subdivided {
            self.cut()
        } else {
            self.into_quads()
        };
        let reversed = volume(&mesh) < 0.0;
        let mesh = if reversed { mesh.reversed() } else { mesh };
        mesh.check_closed(name)?;
        Ok(Imported {
            mesh,
            subdivided,
            reversed,
        })
    }

    fn into_quads(self) -> QuadMesh {
        let quads = self.faces.iter().map(|f| [f[0], f[1], f[2], f[3]]);
        QuadMesh {
            quads: quads.collect(),
            nodes: self.nodes,
        }
    }

    /// Every face of n corners into n quadrilaterals.
    fn cut(self) -> QuadMesh {
        let mut nodes = self.nodes;
        let mut middles: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        let mut quads = Vec::new();
        for face in &self.faces {
            let n = face.len();
            let centre = nodes.len();
            let sum: DVec3 = face.iter().map(|&k| nodes[k]).sum();
            nodes.push(sum / n as f64);
            let mut middle = |k: usize| {
                let (a, b) = (face[k % n], face[(k + 1) % n]);
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    nodes.push((nodes[a] + nodes[b]) * 0.5);
                    nodes.len() - 1
                })
            };
            for k in 0..n {
                quads.push([face[k], middle(k), centre, middle(k + n - 1)]);
            }
        }
        QuadMesh { nodes, quads }
    }
}
