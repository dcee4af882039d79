//! The moving animal as glTF 2.0 in one binary file (.glb): a rigid mesh per body, its way and
//! turning as an animation. Numbers are those of the Khronos specification.
//!
//! Viewers show metres and seconds, and an insect as a speck that trembles: a node over all others
//! magnifies the animal to about the size of a hand, and the time runs slower, one second per wingbeat. Both
//! factors are powers of ten, or noted in `extras`.

use std::fs::File;
use std::io::{Seek as _, SeekFrom, Write as _};
use std::path::Path;

use serde_json::{Value, json};
use wingbeat_math::{DMat3, DQuat, DVec3};

use super::block::Block;
use super::source::Source;
use crate::poses::Poses;
use wingbeat_case::IoError;

const FLOAT: u32 = 5126;
const UNSIGNED: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// Axes of glTF (x forward, y up, z to the right) from N.
const AXES: DMat3 = DMat3::from_cols(
    DVec3::new(1.0, 0.0, 0.0),
    DVec3::new(0.0, 0.0, 1.0),
    DVec3::new(0.0, -1.0, 0.0),
);

/// Everything of the file but the numbers of the animation.
#[derive(Default)]
struct Document {
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
    /// Numbers of the meshes, at the start of the binary part.
    fixed: Vec<u8>,
    /// Length of the binary part.
    length: usize,
}

impl Document {
    /// Room for `count` items of `size` bytes; returns where.
    fn room(&mut self, count: usize, size: usize) -> usize {
        let at = self.length;
        self.views
            .push(json!({ "buffer": 0, "byteOffset": at, "byteLength": count * size }));
        self.length += count * size;
        at
    }

    /// Says what the room taken last is for.
    fn aim(&mut self, target: u32) {
        if let Some(view) = self.views.last_mut() {
            view["target"] = json!(target);
        }
    }

    /// Describes the room taken last; returns the number of the accessor.
    fn accessor(
        &mut self,
        kind: &str,
        component: u32,
        count: usize,
        bounds: Option<[Value; 2]>,
    ) -> usize {
        let mut a = json!({
            "bufferView": self.views.len() - 1, "type": kind, "componentType": component, "count": count,
        });
        if let Some([low, high]) = bounds {
            a["min"] = low;
            a["max"] = high;
        }
        self.accessors.push(a);
        self.accessors.len() - 1
    }

    /// The surfaces of one body as one mesh; none without panels.
    fn mesh(&mut self, poses: &Poses, body: usize) -> Option<usize> {
        let (mut points, mut corners) = (vec![], vec![]);
        for s in poses.surfaces.iter().filter(|s| s.body == body) {
            let first = points.len();
            points.extend(s.nodes.iter().map(|x| x.to_array().map(|v| v as f32)));
            for [a, b, c, d] in &s.quads {
                corners.extend([a, b, c, a, c, d].map(|n| (n + first) as u32));
            }
        }
        if corners.is_empty() {
            return None;
        }
        self.room(corners.len(), 4);
        self.aim(INDICES);
        self.fixed
            .extend(corners.iter().flat_map(|n| n.to_le_bytes()));
        let indices = self.accessor("SCALAR", UNSIGNED, corners.len(), None);
        self.room(points.len(), 12);
        self.aim(VERTICES);
        self.fixed
            .extend(points.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        let bound = |f: fn(f32, f32) -> f32| {
            json!([0, 1, 2].map(|k| points.iter().map(|p| p[k]).reduce(f)))
        };
        let bounds = [bound(f32::min), bound(f32::max)];
        let position = self.accessor("VEC3", FLOAT, points.len(), Some(bounds));
        self.room(points.len(), 12);
        self.aim(VERTICES);
        let normals = normals(&points, &corners);
        self.fixed
            .extend(normals.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        let normal = self.accessor("VEC3", FLOAT, points.len(), None);
        let material = usize::from(poses.is_wing(body));
        self.meshes.push(json!({ "primitives": [{
            "attributes": { "POSITION": position, "NORMAL": normal }, "indices": indices, "material": material,
        }] }));
        Some(self.meshes.len() - 1)
    }

    /// Room for an animation of a body; returns where its way and its turning stand.
    fn channel(&mut self, body: usize, times: usize, rows: usize) -> [usize; 2] {
        [("translation", "VEC3", 12), ("rotation", "VEC4", 16)].map(|(path, kind, size)| {
            let at = self.room(rows, size);
            let output = self.accessor(kind, FLOAT, rows, None);
            self.samplers
                .push(json!({ "input": times, "output": output, "interpolation": "LINEAR" }));
            let target = json!({ "node": body, "path": path });
            self.channels
                .push(json!({ "sampler": self.samplers.len() - 1, "target": target }));
            at
        })
    }

    fn json(&self, case: &str, shown: &Shown) -> Value {
        let children: Vec<usize> = (0..self.nodes.len()).collect();
        let mut nodes = self.nodes.clone();
        let [slower, larger] = [shown.slower, shown.larger];
        nodes.push(json!({
            "name": format!("{larger} times larger"), "children": children, "scale": [larger, larger, larger],
        }));
        let paint = |rgb: [f64; 3]| {
            json!({ "doubleSided": true, "pbrMetallicRoughness": {
                "baseColorFactor": [rgb[0], rgb[1], rgb[2], 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8,
            } })
        };
        json!({
            "asset": { "version": "2.0", "generator": concat!("wingbeat ", env!("CARGO_PKG_VERSION")) },
            "extras": {
                "case": case, "axes": "x = n1 (forward), y = -n3 (up), z = n2 (right), metres",
                "times_slower": slower, "times_larger": larger,
            },
            "scene": 0,
            "scenes": [{ "nodes": [nodes.len() - 1] }],
            "nodes": nodes,
            "meshes": self.meshes,
            "materials": [paint([0.55, 0.42, 0.28]), paint([0.35, 0.60, 0.80])],
            "animations": [{ "name": format!("flight, {slower:.4} times slower"), "samplers": self.samplers, "channels": self.channels }],
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.length }],
        })
    }
}

/// How the flight is shown.
struct Shown {
    /// Seconds of the animation per second of the flight.
    slower: f64,
    /// Lengths of the scene per length of the animal.
    larger: f64,
}

impl Shown {
    /// A wingbeat takes a second; the longest wing, or the body, is 1 to 10 decimetres long.
    fn of(source: &Source) -> Self {
        let setup = &source.case.setup;
        let reports = setup.animal.wing_reports();
        let wing = reports.iter().map(|r| r.length).fold(0.0, f64::max);
        let length = wing.max(setup.animal.body_length());
        let larger = match length > 0.0 {
            true => 10f64.powf((0.0999 / length).log10().ceil()),
            false => 1.0,
        };
        Self {
            slower: setup.time.period.map_or(1.0, |p| 1.0 / p),
            larger,
        }
    }
}

/// Unit normals of the nodes: means over the triangles around them, by their areas.
fn normals(points: &[[f32; 3]], corners: &[u32]) -> Vec<[f32; 3]> {
    let mut sums = vec![DVec3::ZERO; points.len()];
    for triangle in corners.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| triangle[k] as usize);
        let [p, q, r] = [a, b, c].map(|n| DVec3::from_array(points[n].map(f64::from)));
        let area = (q - p).cross(r - p);
        for n in [a, b, c] {
            sums[n] += area;
        }
    }
    let unit = |n: DVec3| n.try_normalize().unwrap_or(DVec3::Z); // of a node without triangles, any
    sums.into_iter()
        .map(|n| unit(n).to_array().map(|x| x as f32))
        .collect()
}

/// Writes the animation.
///
/// # Errors
/// A history that cannot be read or a file that cannot be written.
pub(super) fn write(source: &Source, path: &Path) -> Result<(), IoError> {
    let mut rows = source.rows()?;
    let animal = &source.case.setup.animal;
    let poses = source.poses(rows.names())?;
    let wings = animal.wings.iter().map(|w| w.name.as_str());
    let segments = animal.segments.iter().map(|s| s.name.as_str());
    let names: Vec<&str> = ["body"].into_iter().chain(wings).chain(segments).collect();
    let count = source.row_count()?;
    let mut d = Document::default();
    let meshes: Vec<_> = (0..poses.bodies()).map(|b| d.mesh(&poses, b)).collect();
    let start = d.room(count, 4);
    let shown = Shown::of(source);
    let last = (count.max(1) - 1) as f64 * source.case.setup.time.step * shown.slower;
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
    let wrote = IoError::write(path);
    let (mut file, binary) = begin(&d, &source.case.name, &shown, path).map_err(wrote)?;
    let size = |k: usize| if k == 0 { 4 } else { [16, 12][k % 2] };
    let mut put = |k: usize, first: usize, items: &[Vec<f32>]| {
        let bytes: Vec<u8> = items
            .iter()
            .flatten()
            .flat_map(|x| x.to_le_bytes())
            .collect();
        file.seek(SeekFrom::Start(
            (binary + places[k] + first * size(k)) as u64,
        ))?;
        file.write_all(&bytes)
    };
    let mut block = Block::new(places.len());
    let mut before = vec![DQuat::IDENTITY; meshes.len()];
    while let Some(row) = rows.next_row()? {
        let items = keys(&poses, row, shown.slower, &mut before);
        block.row(items, &mut put).map_err(IoError::write(path))?;
    }
    block.flush(&mut put).map_err(IoError::write(path))
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

/// Head, JSON and meshes of the file, and where its binary part begins.
fn begin(d: &Document, case: &str, shown: &Shown, path: &Path) -> std::io::Result<(File, usize)> {
    let mut text = d.json(case, shown).to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let length = d.length.next_multiple_of(4);
    let total = 12 + 8 + text.len() + 8 + length;
    let whole =
        |n: usize| u32::try_from(n).map_err(|_| std::io::Error::other("glTF files end at 4 GiB"));
    let mut front = b"glTF\x02\0\0\0".to_vec();
    front.extend(whole(total)?.to_le_bytes());
    front.extend(whole(text.len())?.to_le_bytes());
    front.extend(b"JSON");
    front.extend(text);
    front.extend(whole(length)?.to_le_bytes());
    front.extend(b"BIN\0");
    let binary = front.len();
    front.extend(&d.fixed);
    let mut file = File::create(path)?;
    file.write_all(&front)?;
    file.set_len(total as u64)?;
    Ok((file, binary))
}
