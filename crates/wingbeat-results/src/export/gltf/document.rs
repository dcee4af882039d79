//! The glTF document: its JSON, and where its numbers stand in the binary part.

use std::array::from_fn;
use std::fs::File;
use std::io::{Seek as _, SeekFrom, Write as _};
use std::path::Path;

use serde_json::{Value, json};
use wingbeat_math::DVec3;

use super::basis::Basis;
use crate::export::source::Source;
use crate::snapshots::poses::Poses;

pub(super) const FLOAT: u32 = 5126;
pub(super) const UNSIGNED: u32 = 5125;
/// Unsigned bytes, read as 0 to 1.
pub(super) const BYTE: u32 = 5121;
pub(super) const VERTICES: u32 = 34962;
pub(super) const INDICES: u32 = 34963;

/// Materials, by their numbers in the file: body, wings, wakes.
const BODY: usize = 0;
const WING: usize = 1;
pub(super) const WAKE: usize = 2;

/// How the flight is shown.
pub(super) struct Shown {
    /// Seconds of the animation per second of the flight.
    pub slower: f64,
    /// Lengths of the scene per length of the animal.
    pub larger: f64,
}

impl Shown {
    /// A wingbeat takes a second; the longest wing, or the body, is 1 to 10 decimetres long.
    pub fn of(source: &Source) -> Self {
        let setup = &source.case.setup;
        let length = setup.animal.wing_length().max(setup.animal.body_length());
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

/// Everything of the file but the numbers of the animation and of the wakes.
#[derive(Default)]
pub(super) struct Document {
    views: Vec<Value>,
    accessors: Vec<Value>,
    pub meshes: Vec<Value>,
    pub nodes: Vec<Value>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
    /// Numbers that are known beforehand, and where they stand in the binary part.
    fixed: Vec<(usize, Vec<u8>)>,
    /// Length of the binary part.
    length: usize,
}

impl Document {
    /// Room for `count` items of `size` bytes; returns where.
    pub fn room(&mut self, count: usize, size: usize) -> usize {
        let at = self.length;
        self.views
            .push(json!({ "buffer": 0, "byteOffset": at, "byteLength": count * size }));
        self.length += count * size;
        at
    }

    /// Says what the room taken last is for.
    pub fn aim(&mut self, target: u32) {
        if let Some(view) = self.views.last_mut() {
            view["target"] = json!(target);
        }
    }

    /// Describes the room taken last; returns the number of the accessor.
    pub fn accessor(
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
        if component == BYTE {
            a["normalized"] = json!(true);
        }
        self.accessors.push(a);
        self.accessors.len() - 1
    }

    /// Corners of triangles; returns their accessor.
    pub fn indices(&mut self, corners: &[u32]) -> usize {
        let at = self.room(corners.len(), 4);
        self.aim(INDICES);
        let bytes = corners.iter().flat_map(|n| n.to_le_bytes());
        self.fixed.push((at, bytes.collect()));
        self.accessor("SCALAR", UNSIGNED, corners.len(), None)
    }

    /// Numbers that are known; returns their accessor.
    pub fn floats<const N: usize>(
        &mut self,
        items: &[[f32; N]],
        bounds: Option<[Value; 2]>,
    ) -> usize {
        let at = self.room(items.len(), 4 * N);
        let bytes = items.as_flattened().iter().flat_map(|x| x.to_le_bytes());
        self.fixed.push((at, bytes.collect()));
        let kind = if N == 1 { "SCALAR" } else { "VEC3" };
        self.accessor(kind, FLOAT, items.len(), bounds)
    }

    /// The surfaces of one body as one mesh; none without panels. Those of a wing that deforms (`basis`) have
    /// morph targets.
    pub fn mesh(&mut self, poses: &Poses, body: usize, basis: Option<&Basis>) -> Option<usize> {
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
        let indices = self.indices(&corners);
        let position = self.floats(&points, Some(bounds(&points)));
        self.aim(VERTICES);
        let normal = self.floats(&normals(&points, &corners), None);
        self.aim(VERTICES);
        let material = if poses.is_wing(body) { WING } else { BODY };
        let mut mesh = json!({ "primitives": [{
            "attributes": { "POSITION": position, "NORMAL": normal }, "indices": indices, "material": material,
        }] });
        if let Some(basis) = basis {
            let targets = basis.targets();
            let targets: Vec<Value> = targets
                .map(|t| self.target(&points, &corners, &t))
                .collect();
            let names: Vec<String> = (1..=targets.len()).map(|k| format!("shape {k}")).collect();
            mesh["extras"] = json!({ "targetNames": names, "nodes_within_m": basis.tolerance });
            mesh["primitives"][0]["targets"] = json!(targets);
        }
        self.meshes.push(mesh);
        Some(self.meshes.len() - 1)
    }

    /// A morph target: displacements of nodes \[m\], and what they change of the normals, to first order.
    fn target(&mut self, points: &[[f32; 3]], corners: &[u32], displacements: &[DVec3]) -> Value {
        let moved = |sign: f64| {
            let all = points.iter().zip(displacements);
            let place = |(p, d): (&[f32; 3], &DVec3)| from_fn(|k| p[k] + (sign * d[k]) as f32);
            normals(&all.map(place).collect::<Vec<_>>(), corners)
        };
        let both = moved(1.0).into_iter().zip(moved(-1.0));
        let turned = both.map(|(a, b)| from_fn(|k| 0.5 * (a[k] - b[k])));
        let turned: Vec<[f32; 3]> = turned.collect();
        let places = displacements.iter().map(|d| d.to_array().map(|x| x as f32));
        let places: Vec<[f32; 3]> = places.collect();
        let position = self.floats(&places, Some(bounds(&places)));
        self.aim(VERTICES);
        let normal = self.floats(&turned, None);
        self.aim(VERTICES);
        json!({ "POSITION": position, "NORMAL": normal })
    }

    /// An animation of a node: `output` at the times `input`, both accessors.
    pub fn animate(
        &mut self,
        node: usize,
        path: &str,
        [input, output]: [usize; 2],
        interpolation: &str,
    ) {
        self.samplers
            .push(json!({ "input": input, "output": output, "interpolation": interpolation }));
        let target = json!({ "node": node, "path": path });
        self.channels
            .push(json!({ "sampler": self.samplers.len() - 1, "target": target }));
    }

    /// Room for an animation of a body; returns where its way and its turning stand.
    pub fn channel(&mut self, body: usize, times: usize, rows: usize) -> [usize; 2] {
        [("translation", "VEC3", 12), ("rotation", "VEC4", 16)].map(|(path, kind, size)| {
            let at = self.room(rows, size);
            let output = self.accessor(kind, FLOAT, rows, None);
            self.animate(body, path, [times, output], "LINEAR");
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
            "materials": materials(),
            "animations": [{ "name": format!("flight, {slower:.4} times slower"), "samplers": self.samplers, "channels": self.channels }],
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.length }],
        })
    }

    /// Writes head, JSON and what is known beforehand; returns the file, as long as it will be, and where its
    /// binary part begins.
    pub fn begin(&self, case: &str, shown: &Shown, path: &Path) -> std::io::Result<(File, usize)> {
        let mut text = self.json(case, shown).to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = self.length.next_multiple_of(4);
        let total = 12 + 8 + text.len() + 8 + length;
        let whole = |n: usize| {
            u32::try_from(n).map_err(|_| std::io::Error::other("glTF files end at 4 GiB"))
        };
        let mut front = b"glTF\x02\0\0\0".to_vec();
        front.extend(whole(total)?.to_le_bytes());
        front.extend(whole(text.len())?.to_le_bytes());
        front.extend(b"JSON");
        front.extend(text);
        front.extend(whole(length)?.to_le_bytes());
        front.extend(b"BIN\0");
        let binary = front.len();
        let mut file = File::create(path)?;
        file.write_all(&front)?;
        file.set_len(total as u64)?;
        for (at, bytes) in &self.fixed {
            file.seek(SeekFrom::Start((binary + at) as u64))?;
            file.write_all(bytes)?;
        }
        Ok((file, binary))
    }
}

/// The paints, in the order of their numbers.
fn materials() -> [Value; 3] {
    let paint = |name: &str, rgb: [f64; 3]| {
        json!({ "name": name, "doubleSided": true, "pbrMetallicRoughness": {
            "baseColorFactor": [rgb[0], rgb[1], rgb[2], 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8,
        } })
    };
    let mut wake = paint("wake", [1.0; 3]); // times the colours of its nodes
    wake["alphaMode"] = json!("BLEND");
    [
        paint("body", [0.55, 0.42, 0.28]),
        paint("wing", [0.35, 0.60, 0.80]),
        wake,
    ]
}

/// Smallest and largest coordinates.
pub(super) fn bounds(points: &[[f32; 3]]) -> [Value; 2] {
    let bound =
        |f: fn(f32, f32) -> f32| json!([0, 1, 2].map(|k| points.iter().map(|p| p[k]).reduce(f)));
    [bound(f32::min), bound(f32::max)]
}

/// Unit normals of the nodes: means over the triangles around them, by their areas.
pub(super) fn normals(points: &[[f32; 3]], corners: &[u32]) -> Vec<[f32; 3]> {
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
