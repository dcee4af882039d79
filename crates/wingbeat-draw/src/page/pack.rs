//! Numbers of the frames as 16-bit whole numbers, for the page to unpack.
//!
//! A frame is: points of the wings (3 each), pressure jumps of all panels, points of the wake sheets,
//! circulation of their rings, points of the vortex particles, their strengths (3 each). Points are counted in
//! steps from the lowest corner of the frame's box; signed numbers in 1/32767 of the largest of the frame.

use serde::Serialize;

use wingbeat_results::frames::{Mesh, Sheet};
use wingbeat_results::particles::Cloud;

/// Bytes of a particle.
const PARTICLE: usize = 12;

/// What the page needs to unpack a frame.
#[derive(Clone, Debug, Serialize)]
pub struct Packed {
    /// Where its numbers begin \[bytes\].
    pub at: usize,
    /// Lowest corner of its box \[m\].
    pub low: [f64; 3],
    /// Size of a step \[m\].
    pub step_m: f64,
    /// Rows of each wake sheet.
    pub rows: Vec<usize>,
    /// Vortex particles.
    pub particles: usize,
    /// Largest component of a particle's strength \[m3/s\].
    pub strength: f64,
    /// The strength nineteen in twenty do not exceed \[m3/s\].
    pub usual_strength: f64,
    /// Largest circulation of a wake ring \[m2/s\].
    pub circulation: f64,
    /// Largest pressure jump \[Pa\].
    pub pressure: f64,
}

/// Surfaces of one frame.
#[derive(Clone, Debug, Default)]
pub struct Surfaces {
    /// Points of the wings, picture axes \[m\].
    pub points: Vec<[f64; 3]>,
    /// Pressure jump per panel of wings and body \[Pa\].
    pub pressure: Vec<f64>,
}

impl Surfaces {
    /// Bytes they take.
    pub fn bytes(points: usize, panels: usize) -> usize {
        6 * points + 2 * panels
    }
}

/// Frames packed one after the other.
#[derive(Clone, Debug, Default)]
pub struct Blob {
    /// The numbers.
    pub bytes: Vec<u8>,
    /// Rings per row of each sheet met so far.
    pub columns: Vec<usize>,
    /// Most rows of a wake that are kept.
    pub most_rows: usize,
    /// Frames with more rows than that.
    pub aged: usize,
    /// Frames whose older wake rows were left out for their size.
    pub shortened: usize,
    /// Frames whose weaker particles were left out.
    pub weakened: usize,
}

impl Blob {
    /// Nothing yet; of wakes, at most this many rows are kept.
    pub fn with_rows(most_rows: usize) -> Self {
        Self {
            most_rows,
            ..Self::default()
        }
    }

    /// Adds a frame that may take `most` bytes; beyond that the weakest particles are left out until
    /// they take half of what wakes may take, then the oldest wake rows.
    pub fn add(&mut self, surfaces: &Surfaces, wakes: &Mesh, cloud: &Cloud, most: usize) -> Packed {
        let own = Surfaces::bytes(surfaces.points.len(), surfaces.pressure.len());
        let (all, aged) = newest(&wakes.sheets(), self.most_rows);
        self.aged += usize::from(aged);
        let room = most.saturating_sub(own);
        let longest = all.iter().map(Sheet::rows).max().unwrap_or(0);
        let share = room.saturating_sub(cost(&all, longest)).max(room / 2);
        let strongest = cloud.strongest(share / PARTICLE);
        self.weakened += usize::from(strongest.len() < cloud.len());
        let (sheets, cut) = fitting(&all, room - PARTICLE * strongest.len());
        self.shortened += usize::from(cut);
        let (nodes, rings) = kept(&sheets, wakes);
        let places: Vec<[f64; 3]> = strongest.iter().map(|&k| cloud.points[k]).collect();
        let sizes: Vec<f64> = cloud.sizes().collect();
        let sizes: Vec<f64> = strongest.iter().map(|&k| sizes[k]).collect();
        let vectors = strongest.iter().flat_map(|&k| cloud.strength[k]);
        let vectors: Vec<f64> = vectors.collect();
        let (low, step_m) = grid(surfaces.points.iter().chain(&nodes).chain(&places));
        let largest = |v: &[f64]| v.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        let circulation = largest(&rings);
        let pressure = largest(&surfaces.pressure);
        let strength = largest(&vectors);
        let at = self.bytes.len();
        self.points(&surfaces.points, low, step_m);
        self.signed(&surfaces.pressure, pressure);
        self.points(&nodes, low, step_m);
        self.signed(&rings, circulation);
        self.points(&places, low, step_m);
        self.signed(&vectors, strength);
        let rows = self.note(&sheets);
        Packed {
            at,
            low,
            step_m,
            rows,
            particles: places.len(),
            strength,
            usual_strength: usual(&sizes),
            circulation,
            pressure,
        }
    }

    /// Rows by number of the sheet.
    fn note(&mut self, sheets: &[Sheet]) -> Vec<usize> {
        let mut rows = vec![0; self.columns.len()];
        for s in sheets {
            let wanted = rows.len().max(s.id + 1);
            rows.resize(wanted, 0);
            self.columns.resize(wanted, 0);
            rows[s.id] = s.rows();
            self.columns[s.id] = s.cols;
        }
        rows
    }

    fn points(&mut self, points: &[[f64; 3]], low: [f64; 3], step: f64) {
        for p in points {
            for k in 0..3 {
                let whole = ((p[k] - low[k]) / step).round() as u16; // saturates
                self.bytes.extend(whole.to_le_bytes());
            }
        }
    }

    fn signed(&mut self, values: &[f64], largest: f64) {
        let factor = if largest > 0.0 {
            32767.0 / largest
        } else {
            0.0
        };
        for v in values {
            let whole = (v * factor).round() as i16; // saturates
            self.bytes.extend(whole.to_le_bytes());
        }
    }
}

/// What nineteen in twenty do not exceed; 0 of none.
fn usual(sizes: &[f64]) -> f64 {
    let mut sorted = sizes.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() * 19 / 20).copied().unwrap_or(0.0)
}

/// Bytes of so many rows of all sheets.
fn cost(sheets: &[Sheet], rows: usize) -> usize {
    let one = |s: &Sheet| {
        let rows = rows.min(s.rows());
        6 * (rows + 1) * (s.cols + 1) + 2 * rows * s.cols
    };
    sheets.iter().map(one).sum()
}

/// The newest rows of all sheets that fit into so many bytes, and whether rows were left out.
fn fitting(sheets: &[Sheet], bytes: usize) -> (Vec<Sheet>, bool) {
    let longest = sheets.iter().map(Sheet::rows).max().unwrap_or(0);
    let all: Vec<usize> = (0..=longest).collect();
    let rows = all
        .partition_point(|r| cost(sheets, *r) <= bytes)
        .saturating_sub(1);
    newest(sheets, rows)
}

/// So many of the newest rows of all sheets, and whether rows were left out.
fn newest(sheets: &[Sheet], rows: usize) -> (Vec<Sheet>, bool) {
    let short = |s: &Sheet| Sheet {
        rings: rows.min(s.rows()) * s.cols,
        ..*s
    };
    let list: Vec<Sheet> = sheets.iter().map(short).filter(|s| s.rings > 0).collect();
    (list, sheets.iter().any(|s| s.rows() > rows))
}

/// Bytes of a frame's wakes with at most so many rows.
pub(super) fn wake_bytes(wakes: &Mesh, rows: usize) -> usize {
    cost(&wakes.sheets(), rows)
}

/// Nodes and circulations of these sheets.
fn kept(sheets: &[Sheet], wakes: &Mesh) -> (Vec<[f64; 3]>, Vec<f64>) {
    let (mut nodes, mut rings) = (vec![], vec![]);
    let gamma = wakes.cell("circulation_m2_per_s");
    for s in sheets {
        let count = (s.rows() + 1) * (s.cols + 1);
        nodes.extend_from_slice(&wakes.points[s.first_node..][..count]);
        rings.extend(
            (s.first_cell..)
                .take(s.rings)
                .map(|k| gamma.get(k).copied().unwrap_or(0.0)),
        );
    }
    (nodes, rings)
}

/// Lowest corner of the box around points, and the step that divides its longest edge.
fn grid<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> ([f64; 3], f64) {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in points {
        for k in 0..3 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    }
    let edge = (0..3).fold(0.0_f64, |a, k| a.max(high[k] - low[k]));
    if edge > 0.0 && edge.is_finite() {
        (low, edge / 65535.0)
    } else {
        ([0.0; 3], 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet of `rows` x 2 rings with nodes on a unit grid, newest row first.
    fn wake(rows: usize) -> Mesh {
        let node = |k: usize| [(k / 3) as f64, (k % 3) as f64, 0.0];
        let quad = |n: usize| {
            let first = (n / 2) * 3 + n % 2;
            [first, first + 3, first + 4, first + 1]
        };
        let mut mesh = Mesh {
            points: (0..3 * (rows + 1)).map(node).collect(),
            quads: (0..2 * rows).map(quad).collect(),
            ..Mesh::default()
        };
        let gamma = (0..2 * rows).map(|k| k as f64 - 3.0).collect();
        mesh.cells.insert("circulation_m2_per_s".to_owned(), gamma);
        mesh.cells.insert("sheet".to_owned(), vec![1.0; 2 * rows]);
        mesh
    }

    #[test]
    fn exact_numbers_come_back_within_half_a_step() {
        let surfaces = Surfaces {
            points: vec![[-0.3, 0.2, 1.7], [5.0, 0.1, 0.0]],
            pressure: vec![-4.0],
        };
        let mut blob = Blob::with_rows(usize::MAX);
        let packed = blob.add(&surfaces, &wake(4), &Cloud::default(), usize::MAX);
        assert_eq!((packed.rows, &blob.columns[..]), (vec![0, 4], &[0, 2][..]));
        let word = |k: usize| u16::from_le_bytes([blob.bytes[2 * k], blob.bytes[2 * k + 1]]);
        for (k, p) in surfaces.points.iter().flatten().enumerate() {
            let back = packed.low[k % 3] + f64::from(word(k)) * packed.step_m;
            assert!((back - p).abs() <= 0.5001 * packed.step_m, "{back} {p}");
        }
        assert_eq!((packed.circulation, packed.pressure), (4.0, 4.0));
        assert_eq!(word(6) as i16, -32767);
        assert_eq!(blob.bytes.len(), Surfaces::bytes(2, 1) + 6 * 15 + 2 * 8);
    }

    #[test]
    fn exact_old_wake_rows_give_way() {
        let mut blob = Blob::with_rows(usize::MAX);
        let most = 6 * 9 + 2 * 4 + 5; // two of the four rows
        let packed = blob.add(&Surfaces::default(), &wake(4), &Cloud::default(), most);
        assert_eq!((packed.rows, blob.shortened), (vec![0, 2], 1));
        assert!(blob.bytes.len() <= most && blob.aged == 0);
        let mut blob = Blob::with_rows(3);
        let all = usize::MAX;
        let packed = blob.add(&Surfaces::default(), &wake(4), &Cloud::default(), all);
        assert_eq!((packed.rows, blob.aged, blob.shortened), (vec![0, 3], 1, 0));
    }

    #[test]
    fn exact_weak_particles_give_way_to_half_of_the_room() {
        let cloud = Cloud {
            points: (0..10).map(|k| [k as f64, 0.0, 0.0]).collect(),
            strength: (0..10).map(|k| [0.0, 0.0, -k as f64]).collect(),
            ..Cloud::default()
        };
        let mut blob = Blob::with_rows(usize::MAX);
        let none = Surfaces::default();
        let all = blob.add(&none, &wake(4), &cloud, usize::MAX);
        assert_eq!((all.particles, all.strength, blob.weakened), (10, 9.0, 0));
        let first = blob.bytes.len();
        assert_eq!(first, 6 * 15 + 2 * 8 + 120);
        let half = blob.add(&none, &wake(4), &cloud, 100);
        assert_eq!((half.particles, blob.weakened, blob.shortened), (4, 1, 1));
        assert!(blob.bytes.len() - first <= 100);
        // Strengths stand last, three numbers each: the fourth strongest is the first one kept.
        let third = &blob.bytes[blob.bytes.len() - 4 * 6..][4..6];
        let share = f64::from(i16::from_le_bytes([third[0], third[1]])) / 32767.0;
        assert!((share + 6.0 / 9.0).abs() < 1e-4, "{share}");
    }
}
