//! The wakes in the animation: one mesh per frame, seen from its time to that of the next.
//!
//! glTF has no meshes whose number of nodes changes; a node whose scale is animated to zero is not drawn
//! (specification 2.0, section 3.5.3), and that is how frames take turns. Nodes are as opaque as their
//! vorticity is strong, fade with age and change from yellow to violet with it. What is older than
//! [`AGE`] wingbeats is left out.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::document::{BYTE, Document, FLOAT, VERTICES, WAKE, bounds};
use crate::export::source::Source;
use crate::snapshots::frames::{self, Frame, JoinedEdges, Mesh, Sheet};
use crate::snapshots::particles::Cloud;
use wingbeat_case::IoError;

/// Wake older than this is not shown \[wingbeats\].
const AGE: f64 = 1.5;

/// Colours with age, from new to old, sRGB.
const RAMP: [[f64; 3]; 4] = [
    [255.0, 240.0, 184.0],
    [240.0, 112.0, 58.0],
    [139.0, 47.0, 134.0],
    [43.0, 31.0, 107.0],
];

/// The wakes of all frames: what their rooms in the file are.
pub(super) struct Wakes {
    frames: Vec<Planned>,
    /// Rows of a sheet that are shown.
    rows: usize,
    /// Strongest filament of the flight \[m2/s\], and strongest particle \[m3/s\].
    strongest: [f64; 2],
}

struct Planned {
    step: usize,
    /// Where points and colours of sheets and of particles stand in the binary part.
    places: Vec<[usize; 2]>,
}

/// What is shown of one frame, axes of glTF.
#[derive(Default)]
struct Piece {
    /// Rows of rings and rings per row, sheet by sheet.
    layout: Vec<[usize; 2]>,
    points: Vec<[f32; 3]>,
    /// Strength of the strongest filament at a node \[m2/s\], and its age over [`AGE`].
    nodes: Vec<[f64; 2]>,
    particles: Vec<[f32; 3]>,
    /// Vorticity times volume \[m3/s\].
    sizes: Vec<f64>,
}

impl Wakes {
    /// Reads all frames once and takes room for what they will show; nothing without frames.
    pub fn plan(source: &Source, d: &mut Document, slower: f64) -> Result<Self, IoError> {
        let time = &source.case.setup.time;
        let rows = time.period.map(|p| (AGE * p / time.step).ceil() as usize);
        let mut wakes = Self {
            frames: vec![],
            rows: rows.unwrap_or(usize::MAX).max(1),
            strongest: [0.0; 2],
        };
        let steps = frames::steps(source.dir.path())?;
        let last = *steps.last().unwrap_or(&0);
        let mut shared = Shared::default();
        for (k, &step) in steps.iter().enumerate() {
            let piece = wakes.piece(source, step)?;
            let most = |list: &mut dyn Iterator<Item = f64>| list.fold(0.0, f64::max);
            let found = [
                most(&mut piece.nodes.iter().map(|n| n[0])),
                most(&mut piece.sizes.iter().copied()),
            ];
            for (all, found) in wakes.strongest.iter_mut().zip(found) {
                *all = f64::max(*all, found);
            }
            let until = steps.get(k + 1).copied().unwrap_or(last);
            let times = [step, until].map(|k| (k as f64 * time.step * slower) as f32);
            if !piece.points.is_empty() || !piece.particles.is_empty() {
                let places = shared.show(d, &piece, times);
                wakes.frames.push(Planned { step, places });
            }
        }
        Ok(wakes)
    }

    /// Reads all frames once more and hands over what they show: where it stands, bytes.
    pub fn write(
        &self,
        source: &Source,
        mut put: impl FnMut(usize, &[u8]) -> Result<(), IoError>,
    ) -> Result<(), IoError> {
        let bytes = |points: &[[f32; 3]]| -> Vec<u8> {
            let numbers = points.as_flattened().iter();
            numbers.flat_map(|x| x.to_le_bytes()).collect()
        };
        for frame in &self.frames {
            let piece = self.piece(source, frame.step)?;
            let mut places = frame.places.iter();
            let parts = [
                (&piece.points, self.node_colours(&piece)),
                (&piece.particles, self.particle_colours(&piece)),
            ];
            for (points, colours) in parts.iter().filter(|p| !p.0.is_empty()) {
                if let Some([points_at, colours_at]) = places.next() {
                    put(*points_at, &bytes(points))?;
                    put(*colours_at, colours.as_flattened())?;
                }
            }
        }
        Ok(())
    }

    fn piece(&self, source: &Source, step: usize) -> Result<Piece, IoError> {
        let mesh = Frame::part(source.dir.path(), step, 1)?;
        let cloud = Frame::cloud(source.dir.path(), step)?;
        let mut piece = Piece::default();
        let (sheets, joined) = (mesh.sheets(), mesh.joined_edges(&source.case.setup));
        for sheet in &sheets {
            piece.sheet(&mesh, sheet, (&sheets, &joined), self.rows);
        }
        piece.cloud(&cloud);
        Ok(piece)
    }

    fn node_colours(&self, piece: &Piece) -> Vec<[u8; 4]> {
        let colour = |[strength, age]: &[f64; 2]| {
            let fade = (1.0 - age).clamp(0.0, 1.0).powf(1.5);
            colour(*age, 0.7 * fade * share(*strength, self.strongest[0]))
        };
        piece.nodes.iter().map(colour).collect()
    }

    /// Of particles the age is not known.
    fn particle_colours(&self, piece: &Piece) -> Vec<[u8; 4]> {
        let sizes = piece.sizes.iter();
        sizes
            .map(|s| colour(0.5, share(*s, self.strongest[1])))
            .collect()
    }
}

impl Piece {
    /// Takes the newest rows of a sheet. An edge that it shares with another has their common circulation.
    fn sheet(&mut self, mesh: &Mesh, sheet: &Sheet, all: (&[Sheet], &[JoinedEdges]), most: usize) {
        let (rows, cols) = (sheet.rows().min(most), sheet.cols);
        if rows == 0 {
            return;
        }
        let circulation = &mesh.cell("circulation_m2_per_s")[sheet.first_cell..];
        let ring = |r: isize, c: isize| {
            if r < 0 || r >= sheet.rows() as isize {
                return 0.0;
            }
            match usize::try_from(c) {
                Ok(c) if c < cols => circulation[r as usize * cols + c],
                Ok(_) => mesh.ring_beyond(all, sheet, (r as usize, cols)),
                Err(_) => mesh.ring_beyond(all, sheet, (r as usize, 0)),
            }
        };
        for r in 0..=rows {
            for c in 0..=cols {
                let node = mesh.points[sheet.first_node + r * (cols + 1) + c];
                self.points.push(axes(node));
                let (r, c) = (r as isize, c as isize);
                // The rings around the node: filaments are where neighbours differ. The newest edge is bound.
                let above = if r == 0 { 0 } else { r - 1 };
                let around = [
                    ring(above, c - 1),
                    ring(above, c),
                    ring(r, c),
                    ring(r, c - 1),
                ];
                let filament = |k: usize| (around[k] - around[(k + 1) % 4]).abs();
                let strength = (0..4).map(filament).fold(0.0, f64::max);
                self.nodes.push([strength, r as f64 / most as f64]);
            }
        }
        self.layout.push([rows, cols]);
    }

    fn cloud(&mut self, cloud: &Cloud) {
        self.particles.extend(cloud.points.iter().map(|p| axes(*p)));
        self.sizes.extend(cloud.sizes());
    }

    /// Corners of the triangles of all sheets.
    fn corners(&self) -> Vec<u32> {
        let mut corners = vec![];
        let mut first = 0;
        for &[rows, cols] in &self.layout {
            let at = |r: usize, c: usize| (first + r * (cols + 1) + c) as u32;
            for (r, c) in (0..rows).flat_map(|r| (0..cols).map(move |c| (r, c))) {
                let [p, q, s, t] = [at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c)];
                corners.extend([p, q, s, p, s, t]);
            }
            first += (rows + 1) * (cols + 1);
        }
        corners
    }
}

/// Parts of the file that many frames share.
#[derive(Default)]
struct Shared {
    /// Accessors of corners by the layout of the sheets.
    corners: BTreeMap<Vec<[usize; 2]>, usize>,
    /// Accessors of scales by what they are.
    scales: BTreeMap<Vec<u8>, usize>,
}

impl Shared {
    /// A node that shows a frame between two times; returns where points and colours will stand.
    fn show(
        &mut self,
        d: &mut Document,
        piece: &Piece,
        [from, until]: [f32; 2],
    ) -> Vec<[usize; 2]> {
        let mut primitives = vec![];
        let mut places = vec![];
        let mut room = |d: &mut Document, points: &[[f32; 3]]| {
            let mut take = |size, kind, component, bounds: Option<[Value; 2]>| {
                let at = d.room(points.len(), size);
                d.aim(VERTICES);
                (at, d.accessor(kind, component, points.len(), bounds))
            };
            let (points_at, position) = take(12, "VEC3", FLOAT, Some(bounds(points)));
            let (colours_at, colour) = take(4, "VEC4", BYTE, None);
            places.push([points_at, colours_at]);
            json!({ "attributes": { "POSITION": position, "COLOR_0": colour }, "material": WAKE })
        };
        if !piece.points.is_empty() {
            let indices = *(self.corners.entry(piece.layout.clone()))
                .or_insert_with(|| d.indices(&piece.corners()));
            let mut sheets = room(d, &piece.points);
            sheets["indices"] = json!(indices);
            primitives.push(sheets);
        }
        if !piece.particles.is_empty() {
            let mut points = room(d, &piece.particles);
            points["mode"] = json!(0);
            primitives.push(points);
        }
        d.meshes.push(json!({ "primitives": primitives }));
        let node = d.nodes.len();
        let name = format!("wake at {from:.3} s");
        d.nodes
            .push(json!({ "name": name, "mesh": d.meshes.len() - 1, "scale": [0.0, 0.0, 0.0] }));
        let seen: Vec<(f32, u8)> = [(0.0, 0), (from, 1), (until, 0)]
            .into_iter()
            .filter(|(t, shown)| match shown {
                1 => true,
                _ if *t == 0.0 => from > 0.0,
                _ => until > from,
            })
            .collect();
        let times: Vec<[f32; 1]> = seen.iter().map(|s| [s.0]).collect();
        let ends = [json!([times[0][0]]), json!([times[times.len() - 1][0]])];
        let input = d.floats(&times, Some(ends));
        let scales: Vec<u8> = seen.iter().map(|s| s.1).collect();
        let output = *self.scales.entry(scales.clone()).or_insert_with(|| {
            let items: Vec<[f32; 3]> = scales.iter().map(|s| [f32::from(*s); 3]).collect();
            d.floats(&items, None)
        });
        d.animate(node, "scale", [input, output], "STEP");
        places
    }
}

/// Axes of glTF from picture axes.
fn axes([x, y, z]: [f64; 3]) -> [f32; 3] {
    [x as f32, z as f32, -y as f32]
}

/// Opacity of a strength: strong ones do not hide all others.
fn share(strength: f64, strongest: f64) -> f64 {
    if strongest > 0.0 {
        (strength / strongest).sqrt()
    } else {
        0.0
    }
}

/// A channel of sRGB from 0 to 255 as linear light from 0 to 1 [IEC 61966-2-1].
fn linear(channel: f64) -> f64 {
    match channel / 255.0 {
        c if c <= 0.04045 => c / 12.92,
        c => ((c + 0.055) / 1.055).powf(2.4),
    }
}

/// A colour of the ramp, linear as glTF has it, and an opacity.
fn colour(age: f64, opacity: f64) -> [u8; 4] {
    let at = age.clamp(0.0, 1.0) * (RAMP.len() - 1) as f64;
    let k = (at as usize).min(RAMP.len() - 2);
    let mix = |c: usize| {
        let x = RAMP[k][c] + (RAMP[k + 1][c] - RAMP[k][c]) * (at - k as f64);
        (255.0 * linear(x)).round() as u8
    };
    let alpha = (255.0 * opacity.clamp(0.0, 1.0)).round() as u8;
    [mix(0), mix(1), mix(2), alpha]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Dark, on both sides of the bend of the curve, and half way.
    #[test]
    fn exact_colours_go_from_srgb_to_linear_light() {
        for (srgb, light) in [
            (0.0, 0.0),
            (10.0, 0.003035),
            (11.0, 0.003347),
            (188.0, 0.502886),
            (255.0, 1.0),
        ] {
            assert!(
                (linear(srgb) - light).abs() < 1e-6,
                "{srgb}: {}",
                linear(srgb)
            );
        }
        assert_eq!(colour(0.0, 1.0), [255, 222, 122, 255]);
    }

    /// Two sheets of two rings, side by side, rows alike: without joint edges each root is as strong as its ring, as
    /// one line it has what parts the two.
    #[test]
    fn exact_an_edge_that_two_sheets_share_has_their_common_circulation() {
        for (second, left_out) in [([3.0, 2.0], 0.0), ([1.0, 2.0], 2.0)] {
            let node = |k: usize| [(k % 6 / 2) as f64, (k % 2 + k / 6) as f64, 0.0];
            let quad = |n: usize| {
                let first = (n / 2) * 6 + (n % 2) * 2;
                [first, first + 2, first + 3, first + 1]
            };
            let mut mesh = Mesh {
                points: (0..12).map(node).collect(),
                quads: (0..4).map(quad).collect(),
                ..Mesh::default()
            };
            let [upper, lower] = second;
            let gamma = vec![3.0, 2.0, upper, lower];
            mesh.cells.insert("circulation_m2_per_s".to_owned(), gamma);
            let of_sheets = vec![0.0, 0.0, 1.0, 1.0];
            mesh.cells.insert("sheet".to_owned(), of_sheets);
            let sheets = mesh.sheets();
            let newest = |joined: &[JoinedEdges]| {
                let mut piece = Piece::default();
                piece.sheet(&mesh, &sheets[0], (&sheets, joined), 2);
                piece.nodes[1][0] // right edge, newest row
            };
            assert_eq!(newest(&[]), 3.0);
            assert_eq!(newest(&[[(0, 1), (1, 0)]]), left_out);
        }
    }
}
