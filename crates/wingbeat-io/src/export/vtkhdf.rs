//! Surfaces or wakes as a time series in VTKHDF, version 2.0: polygonal data whose points and
//! cells change from step to step (VTK documentation, *VTKHDF file format*).

use std::path::Path;

use super::Source;
use super::hdf5::{Attribute, Hdf5File, Kind, Layout};
use crate::error::IoError;
use crate::result::frames::{self, Frame, Mesh};

/// Kinds of cells in the order of their offsets; only polygons are used.
const KINDS: [&str; 4] = ["Vertices", "Lines", "Polygons", "Strips"];
const POLYGONS: usize = 2;

/// Writes `surfaces.vtkhdf` or `wakes.vtkhdf`.
pub(super) fn write(source: &Source, name: &str, path: &Path) -> Result<(), IoError> {
    let wakes = usize::from(name.starts_with("wakes"));
    let steps = frames::steps(source.dir.path())?;
    if steps.is_empty() {
        return Err(IoError::Damaged {
            path: source.dir.join("frames"),
            problem: "there are no frames to export: set output.frames_every and fly a case with a vortex lattice".to_owned(),
        });
    }
    let files: Vec<_> = steps
        .iter()
        .map(|k| Frame::paths(source.dir.path(), *k)[wakes].clone())
        .collect();
    let counts: Vec<[usize; 2]> = files
        .iter()
        .map(|f| Mesh::count(f))
        .collect::<Result<_, _>>()?;
    let part = |step: usize| Frame::part(source.dir.path(), step, wakes);
    let names = part(steps[0])?.cells.into_keys().collect();
    let mut layout = Layout::default();
    let places = Places::new(&counts, names, &mut layout);
    let mut file = layout.create(path).map_err(IoError::write(path))?;
    let step = source.case.setup.time.step;
    let times: Vec<f64> = steps.iter().map(|k| *k as f64 * step).collect();
    places
        .head(&mut file, &counts, &times)
        .map_err(IoError::write(path))?;
    let mut at = [0; 2];
    for (k, step) in steps.iter().enumerate() {
        let mesh = part(*step)?;
        places
            .frame(&mut file, k, at, &mesh)
            .map_err(IoError::write(path))?;
        at = [at[0] + mesh.points.len(), at[1] + mesh.quads.len()];
    }
    Ok(())
}

/// Numbers of the datasets.
struct Places {
    point_count: usize,
    points: usize,
    /// Per kind: NumberOfCells, NumberOfConnectivityIds, Connectivity, Offsets.
    kinds: [[usize; 4]; 4],
    cells: Vec<(String, usize, usize)>,
    values: usize,
    parts: usize,
    part_offsets: usize,
    point_offsets: usize,
    cell_offsets: usize,
    corner_offsets: usize,
}

impl Places {
    fn new(counts: &[[usize; 2]], names: Vec<String>, layout: &mut Layout) -> Self {
        let n = counts.len();
        let [points, quads] = counts
            .iter()
            .fold([0; 2], |s, c| [s[0] + c[0], s[1] + c[1]]);
        let whole = Kind::Integer;
        let mut add = |path: &str, kind: Kind, shape: &[usize]| {
            layout.dataset(&format!("VTKHDF/{path}"), kind, shape)
        };
        let places = Self {
            point_count: add("NumberOfPoints", whole, &[n]),
            points: add("Points", Kind::Float, &[points, 3]),
            kinds: std::array::from_fn(|k| {
                let cells = if k == POLYGONS { quads } else { 0 };
                [
                    add(&format!("{}/NumberOfCells", KINDS[k]), whole, &[n]),
                    add(
                        &format!("{}/NumberOfConnectivityIds", KINDS[k]),
                        whole,
                        &[n],
                    ),
                    add(&format!("{}/Connectivity", KINDS[k]), whole, &[4 * cells]),
                    add(&format!("{}/Offsets", KINDS[k]), whole, &[cells + n]),
                ]
            }),
            cells: names
                .into_iter()
                .map(|name| {
                    let data = add(&format!("CellData/{name}"), Kind::Float, &[quads]);
                    let offsets = add(&format!("Steps/CellDataOffsets/{name}"), whole, &[n]);
                    (name, data, offsets)
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
        let only_polygons =
            |v: Vec<i64>| -> Vec<i64> { v.into_iter().flat_map(|x| [0, 0, x, 0]).collect() };
        file.floats(self.values, 0, times)?;
        file.integers(self.parts, 0, &vec![1; n])?;
        let parts: Vec<i64> = (0..n as i64).collect();
        file.integers(self.part_offsets, 0, &parts)?;
        file.integers(self.point_count, 0, &list(0, 1))?;
        file.integers(self.point_offsets, 0, &before(0, 1))?;
        let [cells, corners, ..] = self.kinds[POLYGONS];
        file.integers(cells, 0, &list(1, 1))?;
        file.integers(corners, 0, &list(1, 4))?;
        file.integers(self.cell_offsets, 0, &only_polygons(before(1, 1)))?;
        file.integers(self.corner_offsets, 0, &only_polygons(before(1, 4)))?;
        for (_, _, offsets) in &self.cells {
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
        mesh: &Mesh,
    ) -> std::io::Result<()> {
        let [_, _, connectivity, offsets] = self.kinds[POLYGONS];
        let corners: Vec<i64> = mesh
            .quads
            .as_flattened()
            .iter()
            .map(|n| *n as i64)
            .collect();
        let ends: Vec<i64> = (0..=mesh.quads.len() as i64).map(|n| 4 * n).collect();
        file.floats(self.points, 3 * at[0], mesh.points.as_flattened())?;
        file.integers(connectivity, 4 * at[1], &corners)?;
        file.integers(offsets, at[1] + k, &ends)?;
        for (name, data, _) in &self.cells {
            file.floats(*data, at[1], mesh.cell(name))?;
        }
        Ok(())
    }
}
