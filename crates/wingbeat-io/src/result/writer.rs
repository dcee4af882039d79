//! The sink of a flight: takes every accepted step, keeps the result directory readable.

use std::time::{Duration, Instant};

use wingbeat_flight::{Record, Snapshot};

use super::columns::body_names;
use super::directory::write_whole;
use super::history::HistoryWriter;
use super::manifest::{Manifest, Outcome, sha256};
use super::vtp::{PolyData, frame_name, pvd};
use super::{History, ResultDir, Summary};
use crate::case::LoadedCase;
use crate::error::IoError;
use crate::figures;

/// The index is rewritten after this many frames, so that writing it stays a small part.
const FRAMES_PER_INDEX: usize = 16;

/// Writes one run.
pub struct RunWriter {
    dir: ResultDir,
    case: LoadedCase,
    history: HistoryWriter,
    frames: Vec<(f64, usize)>,
    manifest: Manifest,
    started: Instant,
    writing: Duration,
}

impl RunWriter {
    /// Starts the result: case and manifest are written at once.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn new(dir: ResultDir, case: &LoadedCase, threads: usize) -> Result<Self, IoError> {
        let resolved = case.resolved();
        dir.write("case.toml", resolved.as_bytes())?;
        let bodies = body_names(&case.setup.animal);
        let history = HistoryWriter::create(&dir.join("history.csv"), bodies)?;
        if case.output.frames_every > 0 {
            dir.folder("frames")?;
        }
        let manifest = Manifest {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            case: case.name.clone(),
            origin: case.origin().to_owned(),
            case_sha256: sha256(resolved.as_bytes()),
            outcome: Outcome::Running,
            threads,
            steps: 0,
            steps_planned: case.setup.time.steps,
            frames: 0,
            panels: 0,
            wake_rings: 0,
            wall_time_s: 0.0,
            writing_time_s: 0.0,
            warnings: vec![],
            frame_axes: "n1, -n2, -n3 (x forward, y left, z up)".to_owned(),
        };
        dir.write("manifest.json", manifest.to_json().as_bytes())?;
        Ok(Self {
            dir,
            case: case.clone(),
            history,
            frames: vec![],
            manifest,
            started: Instant::now(),
            writing: Duration::ZERO,
        })
    }

    /// The directory.
    pub fn dir(&self) -> &ResultDir {
        &self.dir
    }

    /// Takes an accepted step; the snapshot is asked for only where a frame is due.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(
        &mut self,
        record: &Record,
        snapshot: impl FnOnce() -> Snapshot,
    ) -> Result<(), IoError> {
        let begun = Instant::now();
        self.history.append(record)?;
        self.manifest.steps = record.step;
        self.manifest.wake_rings = record.wake_rings;
        let every = self.case.output.frames_every;
        let last = record.step == self.case.setup.time.steps;
        if every > 0 && (record.step.is_multiple_of(every) || last) {
            self.frame(&snapshot())?;
        }
        self.writing += begun.elapsed();
        Ok(())
    }

    fn frame(&mut self, snapshot: &Snapshot) -> Result<(), IoError> {
        if snapshot.surfaces.is_empty() {
            return Ok(());
        }
        let folder = self.dir.join("frames");
        let surfaces = PolyData::surfaces(snapshot);
        self.manifest.panels = surfaces.quads.len();
        for (stem, data) in [("surfaces", surfaces), ("wakes", PolyData::wakes(snapshot))] {
            let path = folder.join(frame_name(stem, snapshot.step));
            write_whole(&path, data.to_vtp().as_bytes())?;
        }
        self.frames.push((snapshot.time, snapshot.step));
        if self.frames.len() % FRAMES_PER_INDEX == 1 {
            self.index()?;
        }
        Ok(())
    }

    fn index(&self) -> Result<(), IoError> {
        if self.frames.is_empty() {
            return Ok(());
        }
        self.dir.write("flight.pvd", pvd(&self.frames).as_bytes())
    }

    /// Ends the result: index, figures, summary, manifest.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn finish(mut self, outcome: Outcome) -> Result<Summary, IoError> {
        let begun = Instant::now();
        self.index()?;
        let history = History::read(&self.dir.join("history.csv"))?;
        let summary = Summary::new(&self.case, &history, &outcome);
        if self.case.output.figures && history.rows() > 2 {
            figures::draw_all(&self.dir, &self.case, &history)?;
        }
        self.dir
            .write("summary.txt", summary.to_text().as_bytes())?;
        self.dir
            .write("summary.json", summary.to_json().as_bytes())?;
        self.writing += begun.elapsed();
        self.manifest.outcome = outcome;
        self.manifest.frames = self.frames.len();
        self.manifest.warnings.clone_from(&summary.warnings);
        self.manifest.wall_time_s = self.started.elapsed().as_secs_f64();
        self.manifest.writing_time_s = self.writing.as_secs_f64();
        self.dir
            .write("manifest.json", self.manifest.to_json().as_bytes())?;
        Ok(summary)
    }
}
