//! The history as Parquet; history, frames, case and summary as HDF5.
//!
//! Layout of the HDF5 file, version 5: see docs/exports.md.

use std::path::Path;

use super::block::Block;
use super::hdf5::{Attribute, Hdf5File, Kind, Layout};
use super::parquet::{Cells, ParquetWriter};
use super::source::Source;
use crate::Summary;
use crate::series::columns::{Column, TIME};
use crate::snapshots::frames::{self, Frame, Mesh};
use crate::snapshots::particles::{Cloud, NUMBERS};
use crate::snapshots::vtp::SHARED;
use wingbeat_case::IoError;

/// Version of the layout of the HDF5 file.
const LAYOUT: i64 = 5;

/// The history as a table.
pub(super) fn parquet(source: &Source, path: &Path) -> Result<(), IoError> {
    let mut rows = source.rows()?;
    let columns = source.columns()?;
    let cells = |c: &Column| match c.is_count {
        true => (c.name.clone(), Cells::Counts),
        false => (c.name.clone(), Cells::Numbers),
    };
    let names = columns.iter().map(cells).collect();
    let table = ParquetWriter::create(path, "history", names);
    let mut table = table.map_err(IoError::write(path))?;
    while let Some(row) = rows.next_row()? {
        table.row(row).map_err(IoError::write(path))?;
    }
    let note = |of: &dyn Fn(&Column) -> String| {
        let all = columns.iter().map(|c| (c.name.clone(), of(c).into()));
        serde_json::Value::Object(all.collect()).to_string()
    };
    let notes = [
        ("wingbeat_version", source.manifest.version.as_str()),
        ("case_toml", source.case.text()),
        ("units", &note(&|c| c.unit.to_owned())),
        ("frames", &note(&|c| c.frame.to_owned())),
        ("meanings", &note(&|c| c.about.clone())),
    ];
    table.finish(&notes).map_err(IoError::write(path))
}

/// Everything in one file.
pub(super) fn hdf5(source: &Source, path: &Path) -> Result<(), IoError> {
    let steps = frames::steps(source.dir.path())?;
    let mut layout = Layout::default();
    describe(source, &mut layout);
    let texts = texts(source, &mut layout)?;
    let columns = history_layout(source, &mut layout)?;
    let frames = FrameArrays::new(source, &steps, &mut layout)?;
    let mut file = layout.create(path).map_err(IoError::write(path))?;
    for (dataset, text) in texts {
        file.put(dataset, 0, text.as_bytes())
            .map_err(IoError::write(path))?;
    }
    history(source, &columns, &mut file, path)?;
    match frames {
        Some(arrays) => arrays.fill(source, &steps, &mut file, path),
        None => Ok(()),
    }
}

fn describe(source: &Source, layout: &mut Layout) {
    let m = &source.manifest;
    let text = |s: &str| Attribute::Text(s.to_owned());
    layout.note_group("", "layout_version", Attribute::Integer(LAYOUT));
    layout.note_group("", "wingbeat_version", text(&m.version));
    layout.note_group("", "case", text(&m.case));
    layout.note_group("", "case_sha256", text(&m.case_sha256));
}

/// Case and summary as texts.
fn texts(source: &Source, layout: &mut Layout) -> Result<Vec<(usize, String)>, IoError> {
    let summary = Summary::read(&source.case, &source.history(), &source.manifest.outcome)?;
    let list = [
        ("case_toml", source.case.text().to_owned()),
        ("summary_json", summary.to_json()),
    ];
    let add =
        |(name, text): (&str, String)| (layout.dataset(name, Kind::Text(text.len()), &[]), text);
    Ok(list.map(add).into())
}

/// A dataset per column, the time being the scale of the others; each with whether it counts.
fn history_layout(source: &Source, layout: &mut Layout) -> Result<Vec<(usize, bool)>, IoError> {
    let rows = source.row_count()?;
    let columns = source.columns()?;
    let first = layout.datasets.len();
    let time = first + TIME;
    for c in &columns {
        let kind = if c.is_count {
            Kind::Integer
        } else {
            Kind::Float
        };
        let dataset = layout.dataset(&format!("history/{}", c.name), kind, &[rows]);
        layout.text(dataset, "units", c.unit);
        layout.text(dataset, "frame", c.frame);
        layout.text(dataset, "long_name", &c.about);
        if dataset == time {
            layout.text(dataset, "CLASS", "DIMENSION_SCALE");
            layout.text(dataset, "NAME", &c.name);
        } else {
            layout.note(dataset, "DIMENSION_LIST", Attribute::Scales(vec![time]));
        }
    }
    let all = columns.iter().enumerate();
    Ok(all.map(|(k, c)| (first + k, c.is_count)).collect())
}

fn history(
    source: &Source,
    datasets: &[(usize, bool)],
    file: &mut Hdf5File,
    path: &Path,
) -> Result<(), IoError> {
    let mut rows = source.rows()?;
    let mut block = Block::new(datasets.len());
    let mut put = |k: usize, first: usize, values: &[f64]| {
        let written = match datasets[k] {
            (dataset, true) => {
                let counts: Vec<i64> = values.iter().map(|n| *n as i64).collect();
                file.integers(dataset, first, &counts)
            }
            (dataset, false) => file.floats(dataset, first, values),
        };
        written.map_err(IoError::write(path))
    };
    while let Some(row) = rows.next_row()? {
        block.row(row.iter().copied(), &mut put)?;
    }
    block.flush(&mut put)
}

/// The arrays of the frames.
struct FrameArrays {
    steps: usize,
    times: usize,
    surface: Arrays,
    wake: Arrays,
    particles: Option<PointArrays>,
}

/// The arrays of surfaces or of wakes: all frames one after the other, with offsets.
struct Arrays {
    cells: Vec<&'static str>,
    point_offsets: usize,
    cell_offsets: usize,
    points: usize,
    quads: usize,
    values: Vec<usize>,
}

impl FrameArrays {
    fn new(source: &Source, steps: &[usize], layout: &mut Layout) -> Result<Option<Self>, IoError> {
        if steps.is_empty() {
            return Ok(None);
        }
        let mut sums = [[0; 2]; 2];
        for &step in steps {
            for (sum, path) in sums.iter_mut().zip(Frame::paths(source.dir.path(), step)) {
                let count = Mesh::count(&path)?;
                *sum = [sum[0] + count[0], sum[1] + count[1]];
            }
        }
        let n = steps.len();
        let at = layout.dataset("frames/step_count", Kind::Integer, &[n]);
        let times = layout.dataset("frames/time_s", Kind::Float, &[n]);
        layout.text(times, "units", "s");
        let axes =
            Attribute::Text("picture axes (n1, -n2, -n3): x forward, y left, z up".to_owned());
        layout.note_group("frames", "axes", axes);
        let surface = vec!["circulation_m2_per_s", "pressure_jump_pascal", "surface"];
        let mut wake = vec!["circulation_m2_per_s", "age_rows", "sheet"];
        // Of flights with particles alone.
        let known = Frame::numbers(source.dir.path(), steps, 1)?;
        wake.extend(
            [SHARED]
                .iter()
                .filter(|&&name| known.iter().any(|k| k == name)),
        );
        Ok(Some(Self {
            steps: at,
            times,
            surface: Arrays::new("frames/surfaces", n, sums[0], surface, layout),
            wake: Arrays::new("frames/wakes", n, sums[1], wake, layout),
            particles: PointArrays::new(source, steps, layout)?,
        }))
    }

    fn fill(
        &self,
        source: &Source,
        steps: &[usize],
        file: &mut Hdf5File,
        path: &Path,
    ) -> Result<(), IoError> {
        let (mut at, mut points) = ([[0; 2]; 2], 0);
        let h = source.case.setup.time.step;
        for (k, &step) in steps.iter().enumerate() {
            let frame = Frame::read(source.dir.path(), step)?;
            let written = file
                .integers(self.steps, k, &[step as i64])
                .and_then(|()| file.floats(self.times, k, &[step as f64 * h]))
                .and_then(|()| self.surface.put(file, k, &mut at[0], &frame.surfaces))
                .and_then(|()| self.wake.put(file, k, &mut at[1], &frame.wakes));
            written.map_err(IoError::write(path))?;
            if let Some(arrays) = &self.particles {
                let put = arrays.put(file, k, &mut points, &frame.particles);
                put.map_err(IoError::write(path))?;
            }
        }
        Ok(())
    }
}

impl Arrays {
    fn new(
        group: &str,
        frames: usize,
        [points, quads]: [usize; 2],
        cells: Vec<&'static str>,
        layout: &mut Layout,
    ) -> Self {
        let mut add = |name: &str, kind: Kind, shape: &[usize], unit: &str| {
            let dataset = layout.dataset(&format!("{group}/{name}"), kind, shape);
            layout.text(dataset, "units", unit);
            dataset
        };
        let units = |name: &str| match name {
            "circulation_m2_per_s" | SHARED => "m2 s-1",
            "pressure_jump_pascal" => "Pa",
            _ => "1",
        };
        Self {
            point_offsets: add("point_offsets", Kind::Integer, &[frames + 1], "1"),
            cell_offsets: add("cell_offsets", Kind::Integer, &[frames + 1], "1"),
            points: add("points_m", Kind::Float, &[points, 3], "m"),
            quads: add("quads", Kind::Integer, &[quads, 4], "1"),
            values: (cells.iter())
                .map(|name| add(name, Kind::Float, &[quads], units(name)))
                .collect(),
            cells,
        }
    }

    /// Puts frame `k` where the frames before it end.
    fn put(
        &self,
        file: &mut Hdf5File,
        k: usize,
        at: &mut [usize; 2],
        mesh: &Mesh,
    ) -> std::io::Result<()> {
        let corners: Vec<i64> = mesh
            .quads
            .as_flattened()
            .iter()
            .map(|n| *n as i64)
            .collect();
        file.floats(self.points, 3 * at[0], mesh.points.as_flattened())?;
        file.integers(self.quads, 4 * at[1], &corners)?;
        for (name, dataset) in self.cells.iter().zip(&self.values) {
            file.floats(*dataset, at[1], mesh.cell(name))?;
        }
        *at = [at[0] + mesh.points.len(), at[1] + mesh.quads.len()];
        file.integers(self.point_offsets, k + 1, &[at[0] as i64])?;
        file.integers(self.cell_offsets, k + 1, &[at[1] as i64])
    }
}

/// The arrays of the vortex particles: all frames one after the other, with offsets.
struct PointArrays {
    offsets: usize,
    points: usize,
    values: [usize; 3],
}

impl PointArrays {
    /// None where the flight has no particles.
    fn new(source: &Source, steps: &[usize], layout: &mut Layout) -> Result<Option<Self>, IoError> {
        let counts = particle_counts(source, steps)?;
        if counts.is_empty() {
            return Ok(None);
        }
        let n: usize = counts.iter().sum();
        let mut add = |name: &str, kind: Kind, shape: &[usize], unit: &str| {
            let dataset = layout.dataset(&format!("frames/particles/{name}"), kind, shape);
            layout.text(dataset, "units", unit);
            dataset
        };
        Ok(Some(Self {
            offsets: add("point_offsets", Kind::Integer, &[steps.len() + 1], "1"),
            points: add("points_m", Kind::Float, &[n, 3], "m"),
            values: NUMBERS.map(|(name, components)| match name {
                "strength_m3_per_s" => add(name, Kind::Float, &[n, components], "m3 s-1"),
                "radius_m" => add(name, Kind::Float, &[n], "m"),
                _ => add(name, Kind::Float, &[n], "1"),
            }),
        }))
    }

    /// Puts frame `k` where the frames before it end.
    fn put(
        &self,
        file: &mut Hdf5File,
        k: usize,
        at: &mut usize,
        cloud: &Cloud,
    ) -> std::io::Result<()> {
        file.floats(self.points, 3 * *at, cloud.points.as_flattened())?;
        let all = self.values.iter().zip(NUMBERS).zip(cloud.numbers());
        for ((dataset, (_, components)), values) in all {
            file.floats(*dataset, components * *at, values)?;
        }
        *at += cloud.len();
        file.integers(self.offsets, k + 1, &[*at as i64])
    }
}

/// Particles of each frame; empty where the flight has none.
pub(super) fn particle_counts(source: &Source, steps: &[usize]) -> Result<Vec<usize>, IoError> {
    let path = |step: usize| Frame::particles_path(source.dir.path(), step);
    match steps.first() {
        Some(first) if path(*first).is_file() => {
            let count = |step: &usize| Ok(Mesh::count(&path(*step))?[0]);
            steps.iter().map(count).collect()
        }
        _ => Ok(vec![]),
    }
}
