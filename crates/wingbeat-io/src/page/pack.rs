//! Numbers of the frames as 16-bit whole numbers, for the page to unpack.
//!
//! A frame is: points of the surfaces (3 each), circulation and pressure jump of their panels,
//! points of the wake sheets, circulation of their rings. Points are counted in steps from the
//! lowest corner of the frame's box; signed numbers in 1/32767 of the largest of the frame.

use serde::Serialize;

use crate::result::frames::{Mesh, Sheet};

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
    /// Largest circulation \[m2/s\].
    pub circulation: f64,
    /// Largest pressure jump \[Pa\].
    pub pressure: f64,
}

/// Surfaces of one frame.
#[derive(Clone, Debug, Default)]
pub struct Surfaces {
    /// Points, picture axes \[m\].
    pub points: Vec<[f64; 3]>,
    /// Ring circulation per panel \[m2/s\].
    pub circulation: Vec<f64>,
    /// Pressure jump per panel \[Pa\].
    pub pressure: Vec<f64>,
}

impl Surfaces {
    /// Bytes they take.
    pub fn bytes(points: usize, panels: usize) -> usize {
        6 * points + 4 * panels
    }
}

/// Frames packed one after the other.
#[derive(Clone, Debug, Default)]
pub struct Blob {
    /// The numbers.
    pub bytes: Vec<u8>,
    /// Rings per row of each sheet met so far.
    pub columns: Vec<usize>,
    /// Frames whose older wake rows were left out.
    pub shortened: usize,
}

impl Blob {
    /// Adds a frame that may take `most` bytes; the oldest wake rows are left out beyond that.
    pub fn add(&mut self, surfaces: &Surfaces, wakes: &Mesh, most: usize) -> Packed {
        let own = Surfaces::bytes(surfaces.points.len(), surfaces.circulation.len());
        let (sheets, cut) = fitting(&wakes.sheets(), most.saturating_sub(own));
        self.shortened += usize::from(cut);
        let (nodes, rings) = kept(&sheets, wakes);
        let (low, step_m) = grid(surfaces.points.iter().chain(&nodes));
        let largest = |v: &[f64]| v.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        let circulation = largest(&surfaces.circulation).max(largest(&rings));
        let pressure = largest(&surfaces.pressure);
        let at = self.bytes.len();
        self.points(&surfaces.points, low, step_m);
        self.signed(&surfaces.circulation, circulation);
        self.signed(&surfaces.pressure, pressure);
        self.points(&nodes, low, step_m);
        self.signed(&rings, circulation);
        let rows = self.note(&sheets);
        Packed {
            at,
            low,
            step_m,
            rows,
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

/// The newest rows of all sheets that fit into so many bytes, and whether rows were left out.
fn fitting(sheets: &[Sheet], bytes: usize) -> (Vec<Sheet>, bool) {
    let cost = |rows: usize| -> usize {
        let one = |s: &Sheet| {
            let rows = rows.min(s.rows());
            6 * (rows + 1) * (s.cols + 1) + 2 * rows * s.cols
        };
        sheets.iter().map(one).sum()
    };
    let longest = sheets.iter().map(Sheet::rows).max().unwrap_or(0);
    let all: Vec<usize> = (0..=longest).collect();
    let rows = all.partition_point(|r| cost(*r) <= bytes).saturating_sub(1);
    let short = |s: &Sheet| Sheet {
        rings: rows.min(s.rows()) * s.cols,
        ..*s
    };
    let list: Vec<Sheet> = sheets.iter().map(short).filter(|s| s.rings > 0).collect();
    (list, rows < longest)
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
            circulation: vec![-4.0],
            pressure: vec![0.0],
        };
        let mut blob = Blob::default();
        let packed = blob.add(&surfaces, &wake(4), usize::MAX);
        assert_eq!((packed.rows, &blob.columns[..]), (vec![0, 4], &[0, 2][..]));
        let word = |k: usize| u16::from_le_bytes([blob.bytes[2 * k], blob.bytes[2 * k + 1]]);
        for (k, p) in surfaces.points.iter().flatten().enumerate() {
            let back = packed.low[k % 3] + f64::from(word(k)) * packed.step_m;
            assert!((back - p).abs() <= 0.5001 * packed.step_m, "{back} {p}");
        }
        assert_eq!(packed.circulation, 4.0);
        assert_eq!(word(6) as i16, -32767);
        assert_eq!(blob.bytes.len(), Surfaces::bytes(2, 1) + 6 * 15 + 2 * 8);
    }

    #[test]
    fn exact_old_wake_rows_give_way() {
        let mut blob = Blob::default();
        let most = 6 * 9 + 2 * 4 + 5; // two of the four rows
        let packed = blob.add(&Surfaces::default(), &wake(4), most);
        assert_eq!((packed.rows, blob.shortened), (vec![0, 2], 1));
        assert!(blob.bytes.len() <= most);
    }
}
