//! Surfaces, wakes or particles as a time series in VTKHDF, version 2.0: polygonal data whose points
//! and cells change from step to step (VTK documentation, *VTKHDF file format*).

use std::path::Path;

use super::hdf5::{Attribute, Hdf5File, Kind, Layout};
use super::source::Source;
use super::tables::particle_counts;
use crate::snapshots::frames::{self, Frame, Mesh};
use crate::snapshots::particles::NUMBERS;
use wingbeat_case::IoError;

/// Kinds of cells in the order of their offsets.
const KINDS: [&str; 4] = ["Vertices", "Lines", "Polygons", "Strips"];

/// What the cells of a file are, and where their numbers stand.
#[derive(Clone, Copy)]
struct Cells {
    /// Number in [`KINDS`].
    kind: usize,
    /// Corners of a cell.
    corners: usize,
    /// Group of the numbers.
    data: &'static str,
}

const PANELS: Cells = Cells {
    kind: 2,
    corners: 4,
    data: "CellData",
};
const VERTICES: Cells = Cells {
    kind: 0,
    corners: 1,
    data: "PointData",
};

/// Points, corners of cells and numbers of one frame.
struct Piece {
    points: Vec<[f64; 3]>,
    corners: Vec<i64>,
    values: Vec<Vec<f64>>,
}

/// The file that is written.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    /// Surfaces (0) or wakes (1).
    Panels(usize),
    Particles,
}

impl Part {
    fn cells(self) -> Cells {
        match self {
            Self::Panels(_) => PANELS,
            Self::Particles => VERTICES,
        }
    }

    /// Points and cells of each frame.
    fn counts(self, source: &Source, steps: &[usize]) -> Result<Vec<[usize; 2]>, IoError> {
        let panels =
            |k: &usize, part: usize| Mesh::count(&Frame::paths(source.dir.path(), *k)[part]);
        match self {
            Self::Panels(part) => steps.iter().map(|k| panels(k, part)).collect(),
            Self::Particles => {
                let counts = particle_counts(source, steps)?;
                Ok(counts.into_iter().map(|n| [n, n]).collect())
            }
        }
    }

    /// Names of the numbers and how many there are of each per cell.
    fn names(self, source: &Source, steps: &[usize]) -> Result<Vec<(String, usize)>, IoError> {
        Ok(match self {
            Self::Panels(part) => {
                let names = Frame::numbers(source.dir.path(), steps, part)?;
                names.into_iter().map(|name| (name, 1)).collect()
            }
            Self::Particles => NUMBERS.map(|(name, n)| (name.to_owned(), n)).into(),
        })
    }

    /// A frame, its numbers in the order of `names`.
    fn piece(
        self,
        source: &Source,
        step: usize,
        names: &[(String, usize)],
    ) -> Result<Piece, IoError> {
        Ok(match self {
            Self::Panels(part) => {
                let mesh = Frame::part(source.dir.path(), step, part)?;
                let corners = mesh.quads.as_flattened();
                Piece {
                    corners: corners.iter().map(|n| *n as i64).collect(),
                    values: names.iter().map(|n| mesh.cell(&n.0).to_vec()).collect(),
                    points: mesh.points,
                }
            }
            Self::Particles => {
                let cloud = Frame::cloud(source.dir.path(), step)?;
                Piece {
                    corners: (0..cloud.len() as i64).collect(),
                    values: cloud.numbers().map(<[f64]>::to_vec).into(),
                    points: cloud.points,
                }
            }
        })
    }
}

/// Writes `surfaces.vtkhdf`, `wakes.vtkhdf` or `particles.vtkhdf`.
pub(super) fn write(source: &Source, name: &str, path: &Path) -> Result<(), IoError> {
    let part = match name.split('.').next() {
        Some("particles") => Part::Particles,
        stem => Part::Panels(usize::from(stem == Some("wakes"))),
    };
    let steps = frames::steps(source.dir.path())?;
    if steps.is_empty() {
        return Err(IoError::Damaged {
            path: source.dir.join("frames"),
            problem: "there are no frames to export: set output.frames_every and fly a case with a vortex lattice".to_owned(),
        });
    }
    let counts = part.counts(source, &steps)?;
    let names = part.names(source, &steps)?;
    let mut layout = Layout::default();
    let places = Places::new(part.cells(), &counts, &names, &mut layout);
    let mut file = layout.create(path).map_err(IoError::write(path))?;
    let step = source.case.setup.time.step;
    let times: Vec<f64> = steps.iter().map(|k| *k as f64 * step).collect();
    places
        .head(&mut file, &counts, &times)
        .map_err(IoError::write(path))?;
    let mut at = [0; 2];
    for (k, step) in steps.iter().enumerate() {
        let piece = part.piece(source, *step, &names)?;
        places
            .frame(&mut file, k, at, &piece)
            .map_err(IoError::write(path))?;
        let cells = piece.corners.len() / places.of.corners;
        at = [at[0] + piece.points.len(), at[1] + cells];
    }
    Ok(())
}

/// Numbers of the datasets.
struct Places {
    of: Cells,
    point_count: usize,
    points: usize,
    /// Per kind: NumberOfCells, NumberOfConnectivityIds, Connectivity, Offsets.
    kinds: [[usize; 4]; 4],
    /// Components of the numbers of a cell, their dataset, their offsets.
    numbers: Vec<[usize; 3]>,
    values: usize,
    parts: usize,
    part_offsets: usize,
    point_offsets: usize,
    cell_offsets: usize,
    corner_offsets: usize,
}

impl Places {
    fn new(
        of: Cells,
        counts: &[[usize; 2]],
        names: &[(String, usize)],
        layout: &mut Layout,
    ) -> Self {
        let n = counts.len();
        let [points, all] = counts
            .iter()
            .fold([0; 2], |s, c| [s[0] + c[0], s[1] + c[1]]);
        let whole = Kind::Integer;
        let mut add = |path: &str, kind: Kind, shape: &[usize]| {
            layout.dataset(&format!("VTKHDF/{path}"), kind, shape)
        };
        let places = Self {
            of,
            point_count: add("NumberOfPoints", whole, &[n]),
            points: add("Points", Kind::Float, &[points, 3]),
            kinds: std::array::from_fn(|k| {
                let cells = if k == of.kind { all } else { 0 };
                [
                    add(&format!("{}/NumberOfCells", KINDS[k]), whole, &[n]),
                    add(
                        &format!("{}/NumberOfConnectivityIds", KINDS[k]),
                        whole,
                        &[n],
                    ),
                    add(
                        &format!("{}/Connectivity", KINDS[k]),
                        whole,
                        &[of.corners * cells],
                    ),
                    add(&format!("{}/Offsets", KINDS[k]), whole, &[cells + n]),
                ]
            }),
            numbers: names
                .iter()
                .map(|(name, components)| {
                    let shape = [all, *components];
                    let shape = &shape[..if *components > 1 { 2 } else { 1 }];
                    let data = add(&format!("{}/{name}", of.data), Kind::Float, shape);
                    let offsets = format!("Steps/{}Offsets/{name}", of.data);
                    [*components, data, add(&offsets, whole, &[n])]
                })
                .collect(),
            values: add("Steps/Values", Kind::Float, &[n]),
            parts: add("Steps/NumberOfParts", whole, &[n]),
            part_offsets: add("Steps/PartOffsets", whole, &[n]),
            point_offsets: add("Steps/PointOffsets", whole, &[n]),
            cell_offsets: add("Steps/CellOffsets", whole, &[n, 4]),
            corner_offsets: add("Steps/ConnectivityIdOffsets", whole, &[n, 4]),
        };
        let text = |s: &str| Attribute::Text(s.to_owned());
        layout.note_group("VTKHDF", "Version", Attribute::Integers(vec![2, 0]));
        layout.note_group("VTKHDF", "Type", text("PolyData"));
        layout.note_group("VTKHDF/Steps", "NSteps", Attribute::Integer(n as i64));
        places
    }

    /// What does not need the frames themselves.
    fn head(
        &self,
        file: &mut Hdf5File,
        counts: &[[usize; 2]],
        times: &[f64],
    ) -> std::io::Result<()> {
        let n = counts.len();
        let list = |c: usize, factor: usize| -> Vec<i64> {
            counts.iter().map(|k| (k[c] * factor) as i64).collect()
        };
        let before = |c: usize, factor: usize| -> Vec<i64> {
            let sum = |s: &mut i64, x: i64| Some(std::mem::replace(s, *s + x));
            list(c, factor).into_iter().scan(0, sum).collect()
        };
        let kind = self.of.kind;
        let alone = |x: i64| std::array::from_fn(|k| if k == kind { x } else { 0 });
        let only = |v: Vec<i64>| -> Vec<i64> {
            v.into_iter()
                .flat_map(|x| -> [i64; 4] { alone(x) })
                .collect()
        };
        file.floats(self.values, 0, times)?;
        file.integers(self.parts, 0, &vec![1; n])?;
        let parts: Vec<i64> = (0..n as i64).collect();
        file.integers(self.part_offsets, 0, &parts)?;
        file.integers(self.point_count, 0, &list(0, 1))?;
        file.integers(self.point_offsets, 0, &before(0, 1))?;
        let [cells, corners, ..] = self.kinds[kind];
        file.integers(cells, 0, &list(1, 1))?;
        file.integers(corners, 0, &list(1, self.of.corners))?;
        file.integers(self.cell_offsets, 0, &only(before(1, 1)))?;
        file.integers(self.corner_offsets, 0, &only(before(1, self.of.corners)))?;
        for [_, _, offsets] in &self.numbers {
            file.integers(*offsets, 0, &before(1, 1))?;
        }
        Ok(())
    }

    /// Frame `k`, before which there are `at` points and cells.
    fn frame(
        &self,
        file: &mut Hdf5File,
        k: usize,
        at: [usize; 2],
        piece: &Piece,
    ) -> std::io::Result<()> {
        let [_, _, connectivity, offsets] = self.kinds[self.of.kind];
        let per = self.of.corners;
        let cells = piece.corners.len() / per;
        let ends: Vec<i64> = (0..=cells).map(|n| (per * n) as i64).collect();
        file.floats(self.points, 3 * at[0], piece.points.as_flattened())?;
        file.integers(connectivity, per * at[1], &piece.corners)?;
        file.integers(offsets, at[1] + k, &ends)?;
        for ([components, data, _], values) in self.numbers.iter().zip(&piece.values) {
            file.floats(*data, components * at[1], values)?;
        }
        Ok(())
    }
}
