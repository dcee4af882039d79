//! Wings that deform, as morph targets with animated weights: a node is at its place at rest plus the sum of
//! weights times displacements, wing axes (glTF 2.0, section 3.7.2.2).
//!
//! Shapes are read again for every displacement and need no memory. Between shapes weights, and so displacements, are
//! linear in time.

use serde_json::json;

use super::basis::Basis;
use super::document::{Document, FLOAT};
use super::shapes::Shapes;
use crate::export::source::Source;
use crate::snapshots::poses::Poses;
use wingbeat_case::IoError;

/// How far a node may be from its place in any shape, in lengths of the wing \[1\].
const TOLERANCE: f64 = 1e-3;

/// The wings that deform.
pub(super) struct Deforming {
    shapes: Shapes,
    bases: Vec<Basis>,
    /// Of every wing: where times and weights stand in the binary part.
    places: Vec<[usize; 2]>,
}

impl Deforming {
    /// Reads all shapes, once more than they need vectors.
    pub fn plan(source: &Source, poses: &Poses) -> Result<Self, IoError> {
        let shapes = Shapes::of(source)?;
        let reports = source.case.setup.animal.wing_reports();
        let basis = |surface: usize| Basis::new(surface, TOLERANCE * reports[surface].length);
        let mut bases: Vec<Basis> = shapes.surfaces().map(basis).collect();
        loop {
            bases.iter_mut().for_each(Basis::begin);
            shapes.each(source, poses, |k, time, shape| {
                bases[k].see(time, shape);
                Ok(())
            })?;
            let grown = bases.iter_mut().map(Basis::grow);
            if grown.filter(|g| *g).count() == 0 {
                break;
            }
        }
        Ok(Self {
            shapes,
            bases,
            places: vec![],
        })
    }

    /// What the shapes of a surface are made of; none of one that keeps its shape.
    pub fn of(&self, surface: usize) -> Option<&Basis> {
        let mut all = self.bases.iter();
        all.find(|b| b.surface == surface && b.size() > 0)
    }

    /// Animates the weights of all wings; bodies are the nodes of the file.
    pub fn animate(&mut self, d: &mut Document, poses: &Poses, slower: f64) {
        for b in &self.bases {
            if b.size() == 0 {
                self.places.push([0; 2]);
                continue;
            }
            let times = d.room(b.count, 4);
            let [from, until] = b.ends.map(|t| json!([(t * slower) as f32]));
            let input = d.accessor("SCALAR", FLOAT, b.count, Some([from, until]));
            let count = b.count * b.size();
            self.places.push([times, d.room(count, 4)]);
            let output = d.accessor("SCALAR", FLOAT, count, None);
            let node = poses.surfaces[b.surface].body;
            d.animate(node, "weights", [input, output], "LINEAR");
        }
    }

    /// Reads all shapes once more and hands over times and weights: where they stand, bytes.
    pub fn write(
        &self,
        source: &Source,
        (poses, slower): (&Poses, f64),
        mut put: impl FnMut(usize, &[u8]) -> Result<(), IoError>,
    ) -> Result<(), IoError> {
        let mut written = vec![0; self.bases.len()];
        self.shapes.each(source, poses, |k, time, shape| {
            let [times, weights] = self.places[k];
            if self.bases[k].size() == 0 {
                return Ok(());
            }
            let time = (time * slower) as f32;
            put(times + 4 * written[k], &time.to_le_bytes())?;
            let bytes: Vec<u8> = self.bases[k]
                .weights(&shape)
                .flat_map(f32::to_le_bytes)
                .collect();
            put(weights + bytes.len() * written[k], &bytes)?;
            written[k] += 1;
            Ok(())
        })
    }
}
