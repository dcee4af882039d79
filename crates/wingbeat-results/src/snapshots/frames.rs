//! Frames read back: the `.vtp` files of a result directory, one at a time.

use std::collections::BTreeMap;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use crate::common::other_build::refusal;
use crate::snapshots::arrays::{self, arrays, groups};
use crate::snapshots::particles::Cloud;
use crate::snapshots::vtp::{RIGHT_HANDED, frame_name, indexed};
use wingbeat_case::IoError;
use wingbeat_flight::{AirModel, FlightSetup};

/// Array that surfaces are known by.
const PRESSURE: &str = "pressure_jump_pascal";

/// Lines at the beginning of a frame that say what is in it.
const HEAD: usize = 4;

/// One `.vtp` file: points, quadrilaterals and numbers per quadrilateral.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Points in picture axes (n1, -n2, -n3) \[m\].
    pub points: Vec<[f64; 3]>,
    /// Corner points of each cell.
    pub quads: Vec<[usize; 4]>,
    /// Numbers per cell by name; circulations are right-handed about the corners.
    pub cells: BTreeMap<String, Vec<f64>>,
}

/// Surfaces and wakes of one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Step of the flight.
    pub step: usize,
    /// Bound surfaces: wings, then body parts.
    pub surfaces: Mesh,
    /// Wake sheets.
    pub wakes: Mesh,
    /// Vortex particles.
    pub particles: Cloud,
}

/// Steps of the frames in a result directory, in order.
///
/// # Errors
/// The index is damaged, or names a frame that is missing.
pub fn steps(dir: &Path) -> Result<Vec<usize>, IoError> {
    let folder = dir.join("frames");
    let mut steps: Vec<usize> = std::fs::read_dir(&folder)
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(|e| step_of(e.file_name().to_str()?))
        .filter(|k| folder.join(frame_name("wakes", *k)).is_file())
        .collect();
    steps.sort_unstable();
    let path = dir.join("flight.pvd");
    if !path.exists() {
        return Ok(steps); // killed at its first frame
    }
    let index = std::fs::read_to_string(&path).map_err(IoError::read(&path))?;
    let names = indexed(&index).map_err(|problem| IoError::Damaged {
        path,
        problem: format!("{problem}; fly the case.toml of this result again with `wingbeat run`"),
    })?;
    for name in names {
        if !folder.join(name).is_file() {
            return Err(IoError::Damaged {
                path: folder.join(name),
                problem: "this frame is missing though flight.pvd names it; put it back, or fly the case again".to_owned(),
            });
        }
    }
    Ok(steps)
}

fn step_of(file: &str) -> Option<usize> {
    let digits = file.strip_prefix("surfaces_")?.strip_suffix(".vtp")?;
    digits.parse().ok()
}

impl Frame {
    /// Files of the frame of a step: surfaces, wakes.
    pub fn paths(dir: &Path, step: usize) -> [PathBuf; 2] {
        ["surfaces", "wakes"].map(|stem| dir.join("frames").join(frame_name(stem, step)))
    }

    /// File of the particles of a step, which most flights have not.
    pub fn particles_path(dir: &Path, step: usize) -> PathBuf {
        dir.join("frames").join(frame_name("particles", step))
    }

    /// Files there are of a step.
    pub fn files(dir: &Path, step: usize) -> Vec<PathBuf> {
        let particles = Self::particles_path(dir, step);
        let particles = particles.is_file().then_some(particles);
        Self::paths(dir, step)
            .into_iter()
            .chain(particles)
            .collect()
    }

    /// Reads the particles of a step; none where the flight has none ([`steps`] notices a file that
    /// is missing).
    ///
    /// # Errors
    /// A file that cannot be read or is damaged.
    pub fn cloud(dir: &Path, step: usize) -> Result<Cloud, IoError> {
        let path = Self::particles_path(dir, step);
        match path.is_file() {
            true => Cloud::read(&path),
            false => Ok(Cloud::default()),
        }
    }

    /// Reads the frame of a step.
    ///
    /// # Errors
    /// A file that cannot be read or is damaged.
    pub fn read(dir: &Path, step: usize) -> Result<Self, IoError> {
        Ok(Self {
            step,
            surfaces: Self::part(dir, step, 0)?,
            wakes: Self::part(dir, step, 1)?,
            particles: Self::cloud(dir, step)?,
        })
    }

    /// Reads the surfaces (0) or the wakes (1) of a step.
    ///
    /// # Errors
    /// A file that cannot be read, is damaged, or holds the other part.
    pub fn part(dir: &Path, step: usize, part: usize) -> Result<Mesh, IoError> {
        let path = &Self::paths(dir, step)[part];
        Mesh::read(path)?.with(path, [PRESSURE, "sheet"][part])
    }

    /// Names of the numbers that the cells of surfaces (0) or wakes (1) have, in order: those of the last of
    /// the frames at `steps`, none without frames.
    ///
    /// # Errors
    /// Those of [`Self::part`].
    pub fn numbers(dir: &Path, steps: &[usize], part: usize) -> Result<Vec<String>, IoError> {
        let Some(&last) = steps.last() else {
            return Ok(vec![]);
        };
        Ok(Self::part(dir, last, part)?.cells.into_keys().collect())
    }
}

impl Mesh {
    /// Reads a `.vtp` file of wingbeat.
    ///
    /// # Errors
    /// A file that cannot be read or is damaged.
    pub fn read(path: &Path) -> Result<Self, IoError> {
        arrays::read(path, Self::parse)
    }

    /// The mesh, if it has the array that surfaces or wakes are known by.
    fn with(self, path: &Path, name: &str) -> Result<Self, IoError> {
        if self.cells.contains_key(name) && self.cells.contains_key("circulation_m2_per_s") {
            return Ok(self);
        }
        Err(IoError::Damaged {
            path: path.to_owned(),
            problem: format!(
                "this frame has no array `{name}`: another frame stands in its place; fly the case.toml of this result again with `wingbeat run`"
            ),
        })
    }

    /// Points and cells that the head of a `.vtp` file promises.
    ///
    /// # Errors
    /// A file that cannot be read or is no frame.
    pub fn count(path: &Path) -> Result<[usize; 2], IoError> {
        let mut head = vec![];
        let file = std::fs::File::open(path).map_err(IoError::read(path))?;
        file.take(1024)
            .read_to_end(&mut head)
            .map_err(IoError::read(path))?;
        let head = String::from_utf8_lossy(&head);
        let number = |name: &str| {
            let tag = format!("{name}=\"");
            head.split(&tag).nth(1)?.split('"').next()?.parse().ok()
        };
        match [number("NumberOfPoints"), number("NumberOfPolys")] {
            [Some(points), Some(quads)] => Ok([points, quads]),
            _ => Err(IoError::Damaged {
                path: path.to_owned(),
                problem: "this is no frame of wingbeat".to_owned(),
            }),
        }
    }

    /// From the text of a `.vtp` file.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &str) -> Result<Self, String> {
        if !text.lines().take(HEAD).any(|l| l.contains(RIGHT_HANDED)) {
            return Err(refusal(
                "this frame does not say that its circulations are right-handed",
            ));
        }
        let mut mesh = Self::default();
        for (name, words) in arrays(text)? {
            match name {
                "points" => mesh.points = groups(&words.map_to(f64::from_le_bytes), name)?,
                "connectivity" => {
                    let corners = words.map_to(|w| i64::from_le_bytes(w) as usize);
                    mesh.quads = groups(&corners, name)?;
                }
                "offsets" => {}
                _ => {
                    let numbers = words.map_to(f64::from_le_bytes);
                    mesh.cells.insert(name.to_owned(), numbers);
                }
            }
        }
        mesh.check().map(|()| mesh)
    }

    fn check(&self) -> Result<(), String> {
        let (points, quads) = (self.points.len(), self.quads.len());
        if self.quads.iter().flatten().any(|&n| n >= points) {
            return Err("a cell names a point that does not exist".to_owned());
        }
        match self.cells.iter().find(|c| c.1.len() != quads) {
            Some((name, values)) => Err(format!(
                "the array `{name}` has {} numbers for {quads} cells",
                values.len()
            )),
            None => Ok(()),
        }
    }

    /// Numbers per cell; none if there is no array of this name.
    pub fn cell(&self, name: &str) -> &[f64] {
        self.cells.get(name).map_or(&[], Vec::as_slice)
    }

    /// The wake sheets in a mesh of wakes.
    pub fn sheets(&self) -> Vec<Sheet> {
        let mut sheets: Vec<Sheet> = vec![];
        for (cell, (id, quad)) in self.cell("sheet").iter().zip(&self.quads).enumerate() {
            let id = *id as usize;
            match sheets.last_mut() {
                Some(sheet) if sheet.id == id => sheet.rings += 1,
                _ => sheets.push(Sheet {
                    id,
                    first_node: quad[0],
                    first_cell: cell,
                    cols: quad[1].saturating_sub(quad[0] + 1).max(1),
                    rings: 1,
                }),
            }
        }
        sheets.retain(|s| {
            let nodes = (s.rows() + 1) * (s.cols + 1);
            s.rings == s.rows() * s.cols && s.first_node + nodes <= self.points.len()
        });
        sheets
    }

    /// Edges along which the wake sheets of joined wings are one: of every pair, number and column of nodes in both
    /// sheets. Empty for wings that are neither joined nor carried through a body.
    pub fn joined_edges(&self, setup: &FlightSetup) -> Vec<JoinedEdges> {
        match &setup.air {
            AirModel::VortexLattice(air)
                if !(air.joined.is_empty()
                    && air.joined_tips.is_empty()
                    && setup.carried_pairs(air).is_empty()) =>
            {
                self.coincident_edges()
            }
            _ => vec![],
        }
    }

    /// Side edges of two sheets that lie on one line.
    fn coincident_edges(&self) -> Vec<JoinedEdges> {
        let sheets = self.sheets();
        let sides = |s: &Sheet| [(*s, 0), (*s, s.cols)];
        let all: Vec<(Sheet, usize)> = sheets.iter().flat_map(sides).collect();
        let is_one = |(a, i): (Sheet, usize), (b, j): (Sheet, usize)| {
            let node =
                |s: &Sheet, r: usize, c: usize| self.points[s.first_node + r * (s.cols + 1) + c];
            (0..=a.rows().min(b.rows())).all(|r| {
                let [p, q] = [node(&a, r, i), node(&b, r, j)];
                let size = p.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                (0..3).all(|c| (p[c] - q[c]).abs() <= COINCIDENT * size)
            })
        };
        let mut list = vec![];
        for (n, &a) in all.iter().enumerate() {
            let others = all[n + 1..].iter().filter(|b| b.0.id != a.0.id);
            let found = others.copied().find(|b| is_one(a, *b));
            list.extend(found.map(|b| [(a.0.id, a.1), (b.0.id, b.1)]));
        }
        list
    }

    /// Circulation of the ring in row `r` beyond the side edge of a sheet at column `c` of its nodes (0 or the
    /// last), in the sense of this sheet \[m2/s\]: that of the sheet whose edge is the same line (`joined`, as
    /// [`Mesh::joined_edges`] lists them); 0 beyond an edge of its own, and where the other sheet ends before.
    pub fn ring_beyond(
        &self,
        (sheets, joined): (&[Sheet], &[JoinedEdges]),
        sheet: &Sheet,
        (r, c): (usize, usize),
    ) -> f64 {
        let is_this = |edge: &(usize, usize)| *edge == (sheet.id, c);
        let pair = joined.iter().find(|p| p.iter().any(is_this));
        let Some((id, column)) = pair.and_then(|p| p.iter().copied().find(|e| !is_this(e))) else {
            return 0.0;
        };
        let Some(other) = sheets.iter().find(|s| s.id == id && r < s.rows()) else {
            return 0.0;
        };
        let beside = column.min(other.cols - 1);
        let gamma = self.cell("circulation_m2_per_s");
        let found = gamma.get(other.first_cell + r * other.cols + beside);
        // Two edges on the same side: columns of the other sheet run the other way.
        let sense = if (c == 0) == (column == 0) { -1.0 } else { 1.0 };
        sense * found.unwrap_or(&0.0)
    }

    /// Strength of the vortex filament along column `c` of the nodes of a sheet between rows `r` and `r + 1`, towards
    /// the older one \[m2/s\]: what parts the circulations on both sides, beyond an edge that two sheets share too.
    pub fn streamwise(
        &self,
        all: (&[Sheet], &[JoinedEdges]),
        sheet: &Sheet,
        (r, c): (usize, usize),
    ) -> f64 {
        let gamma = self.cell("circulation_m2_per_s");
        let ring = |c: usize| {
            gamma
                .get(sheet.first_cell + r * sheet.cols + c)
                .unwrap_or(&0.0)
        };
        let beyond = || self.ring_beyond(all, sheet, (r, c));
        let left = if c > 0 { *ring(c - 1) } else { beyond() };
        let right = if c < sheet.cols { *ring(c) } else { beyond() };
        right - left
    }
}

/// Two side edges of wake sheets that are one: number of the sheet and column of its nodes.
pub type JoinedEdges = [(usize, usize); 2];

/// How far nodes that are one may be apart, in parts of their coordinates: rounding \[1\].
const COINCIDENT: f64 = 1e-9;

/// Where a wake sheet stands in its mesh; nodes and rings are in rows, newest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// Number of the sheet in the flight.
    pub id: usize,
    /// Its first point.
    pub first_node: usize,
    /// Its first cell.
    pub first_cell: usize,
    /// Rings per row.
    pub cols: usize,
    /// Rings.
    pub rings: usize,
}

impl Sheet {
    /// Rows of rings.
    pub fn rows(&self) -> usize {
        self.rings / self.cols
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::snapshots::vtp::{CHECKSUM, PolyData, summed};

    #[test]
    fn refuses_frames_that_do_not_say_how_circulations_turn() {
        let data = PolyData {
            points: vec![wingbeat_math::DVec3::ZERO; 4],
            quads: vec![[0, 1, 2, 3]],
            cells: vec![("circulation_m2_per_s", vec![0.25])],
        };
        let text = data.to_vtp();
        let body = text.split(CHECKSUM).next().unwrap_or_default();
        let other = summed(body.replace(RIGHT_HANDED, ""));
        assert!(Mesh::parse(&text).is_ok());
        let problem = Mesh::parse(&other).unwrap_err();
        assert!(problem.contains("another build of wingbeat"), "{problem}");
    }
}
