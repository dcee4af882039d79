//! The moving animal and its wakes as glTF 2.0 in one binary file (.glb): a mesh per body, its way and turning
//! as an animation, shapes of wings that deform as morph targets, and the wakes of the frames one after the
//! other. Numbers are those of the Khronos specification.
//!
//! Viewers show metres and seconds, and an insect as a speck that trembles: a node over all others
//! magnifies the animal to about the size of a hand, and the time runs slower, one second per wingbeat. Both
//! factors are powers of ten, or noted in `extras`.

mod basis;
mod deforming;
mod document;
mod shapes;
mod wake;

use std::io::{Seek as _, SeekFrom, Write as _};
use std::path::Path;

use serde_json::json;
use wingbeat_math::{DMat3, DQuat, DVec3};

use super::block::Block;
use super::source::Source;
use crate::series::rows::Rows;
use crate::snapshots::poses::Poses;
use deforming::Deforming;
use document::{Document, FLOAT, Shown};
use wake::Wakes;
use wingbeat_case::IoError;

/// Axes of glTF (x forward, y up, z to the right) from N.
const AXES: DMat3 = DMat3::from_cols(
    DVec3::new(1.0, 0.0, 0.0),
    DVec3::new(0.0, 0.0, 1.0),
    DVec3::new(0.0, -1.0, 0.0),
);

/// Writes the animation.
///
/// # Errors
/// A history or frames that cannot be read, or a file that cannot be written.
pub(super) fn write(source: &Source, path: &Path) -> Result<(), IoError> {
    let mut rows = source.rows()?;
    let animal = &source.case.setup.animal;
    let poses = source.poses(rows.names())?;
    let wings = animal.wings.iter().map(|w| w.name.as_str());
    let segments = animal.segments.iter().map(|s| s.name.as_str());
    let names: Vec<&str> = ["body"].into_iter().chain(wings).chain(segments).collect();
    let count = source.row_count()?;
    let mut d = Document::default();
    let mut deforming = Deforming::plan(source, &poses)?;
    let basis = |body: usize| poses.wing_of(body).and_then(|k| deforming.of(k));
    let bodies = 0..poses.bodies();
    let meshes: Vec<_> = bodies.map(|b| d.mesh(&poses, b, basis(b))).collect();
    let start = d.room(count, 4);
    let shown = Shown::of(source);
    let last = Rows::times(&source.history())?.pop().unwrap_or(0.0) * shown.slower;
    let bounds = [json!([0.0]), json!([last as f32])];
    let times = d.accessor("SCALAR", FLOAT, count, Some(bounds));
    let mut places = vec![start];
    for (body, mesh) in meshes.iter().enumerate() {
        let mut node = json!({ "name": names[body] });
        if let Some(mesh) = mesh {
            node["mesh"] = json!(mesh);
        }
        d.nodes.push(node);
        places.extend(d.channel(body, times, count));
    }
    deforming.animate(&mut d, &poses, shown.slower);
    let wakes = Wakes::plan(source, &mut d, shown.slower)?;
    let wrote = IoError::write(path);
    let (mut file, binary) = d.begin(&source.case.name, &shown, path).map_err(wrote)?;
    let mut put = |at: usize, bytes: &[u8]| {
        let seek = file.seek(SeekFrom::Start((binary + at) as u64));
        seek.and_then(|_| file.write_all(bytes))
            .map_err(IoError::write(path))
    };
    let size = |k: usize| if k == 0 { 4 } else { [16, 12][k % 2] };
    let mut column = |k: usize, first: usize, items: &[Vec<f32>]| {
        let numbers = items.iter().flatten().flat_map(|x| x.to_le_bytes());
        put(places[k] + first * size(k), &numbers.collect::<Vec<u8>>())
    };
    let mut block = Block::new(places.len());
    let mut before = vec![DQuat::IDENTITY; meshes.len()];
    while let Some(row) = rows.next_row()? {
        let items = keys(&poses, row, shown.slower, &mut before);
        block.row(items, &mut column)?;
    }
    block.flush(&mut column)?;
    deforming.write(source, (&poses, shown.slower), &mut put)?;
    wakes.write(source, put)
}

/// Time, then place and attitude of every body; quaternions take the short way.
fn keys(poses: &Poses, row: &[f64], slower: f64, before: &mut [DQuat]) -> Vec<Vec<f32>> {
    let mut items = vec![vec![(row[1] * slower) as f32]];
    for (body, before) in before.iter_mut().enumerate() {
        let (p, r) = poses.pose(row, body);
        let q = DQuat::from_mat3(&(AXES * r)).normalize();
        *before = if q.dot(*before) < 0.0 { -q } else { q };
        items.push((AXES * p).to_array().map(|x| x as f32).to_vec());
        items.push(before.to_array().map(|x| x as f32).to_vec());
    }
    items
}
