//! The sink of a flight: takes every accepted step, keeps the result directory readable.

use std::time::{Duration, Instant};

use wingbeat_air::Tally;
use wingbeat_flight::{AirModel, FlightState, Record, Snapshot};

use crate::common::checkpoint::Header;
use crate::common::manifest::{Manifest, Outcome, sha256};
use crate::common::other_build::FORMAT;
use crate::run::framer::Framer;
use crate::run::saver::{self, Schedule};
use crate::series::history::HistoryWriter;
use crate::snapshots::vtp::pvd;
use crate::summary::EachStep;
use crate::{ResultDir, Summary};
use wingbeat_case::IoError;
use wingbeat_case::LoadedCase;

/// The index is rewritten when it has grown by one part in this many, so that writing it stays a
/// small part however long the run is.
const INDEX_GROWTH: usize = 4;

/// Writes one run.
pub struct RunWriter {
    dir: ResultDir,
    case: LoadedCase,
    history: HistoryWriter,
    /// Of a thinned history: what the summary is to know of every step; none where a checkpoint lacks it.
    each: Option<EachStep>,
    /// The thread that writes frames; none before the first.
    framer: Option<Framer>,
    frames: Vec<(f64, usize)>,
    /// As [`Self::lost_frames`].
    lost_frames: Vec<IoError>,
    indexed: usize,
    manifest: Manifest,
    started: Instant,
    writing: Duration,
    flown_before: Duration,
    schedule: Schedule,
}

impl RunWriter {
    /// Starts the result: case and manifest are written at once.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn new(dir: ResultDir, case: &LoadedCase, threads: usize) -> Result<Self, IoError> {
        let resolved = case.resolved();
        let manifest = Manifest {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            case: case.name.clone(),
            origin: case.origin().to_owned(),
            case_sha256: sha256(resolved.as_bytes()),
            history_bytes: 0,
            history_sha256: sha256(b""),
            outcome: Outcome::Running,
            threads,
            steps: 0,
            steps_planned: case.setup.time.steps,
            frames: 0,
            panels: case.setup.panels(),
            wake_rings: 0,
            wall_time_s: 0.0,
            writing_time_s: 0.0,
            checked_sums: 0,
            discarded_sums: 0,
            warnings: vec![],
            frame_axes: "n1, -n2, -n3 (x forward, y left, z up)".to_owned(),
        };
        dir.write("manifest.json", manifest.to_json().as_bytes())?;
        dir.write("case.toml", resolved.as_bytes())?;
        let history = HistoryWriter::create(&dir.join("history.csv"), &case.setup)?;
        // What a run that was killed before its first checkpoint has left here.
        dir.remove_half_written();
        saver::go_back(dir.path(), 0)?;
        if case.output.frames_every > 0 {
            dir.folder("frames")?;
        }
        Ok(Self {
            dir,
            case: case.clone(),
            history,
            each: is_thinned(case).then(|| EachStep::new(&case.setup)),
            framer: None,
            frames: vec![],
            lost_frames: vec![],
            indexed: 0,
            manifest,
            started: Instant::now(),
            writing: Duration::ZERO,
            flown_before: Duration::ZERO,
            schedule: Schedule::new(case.output.save),
        })
    }

    /// Goes on with a run from its checkpoint: what was written later is cut off. Frames that were lost stay so, see
    /// [`Self::lost_frames`].
    ///
    /// # Errors
    /// A file that cannot be changed.
    pub fn resume(
        dir: ResultDir,
        case: &LoadedCase,
        header: &Header,
        manifest: Manifest,
        threads: usize,
    ) -> Result<Self, IoError> {
        let every = case.output.frames_every;
        let written = (0..=header.step).step_by(every.max(1));
        let lost_frames = match manifest.frames > 0 {
            true => saver::lost_frames(dir.path(), written, parts(case))?,
            false => vec![],
        };
        let path = dir.join("history.csv");
        let mut history = HistoryWriter::reopen(&path, &case.setup, header)?;
        let manifest = Manifest {
            history_bytes: header.history_bytes,
            history_sha256: header.history_sha256.clone(),
            outcome: Outcome::Running,
            threads,
            steps: header.step,
            ..manifest
        };
        // A manifest never promises more of the history than there is.
        dir.write("manifest.json", manifest.to_json().as_bytes())?;
        history.cut()?;
        dir.remove_half_written();
        dir.remove_derived()?;
        let steps = saver::go_back(dir.path(), header.step)?;
        let step = case.setup.time.step;
        let writer = Self {
            case: case.clone(),
            history,
            each: match is_thinned(case) {
                true => EachStep::restored(&case.setup, &header.each_step),
                false => None,
            },
            framer: None,
            frames: steps.iter().map(|k| (*k as f64 * step, *k)).collect(),
            lost_frames,
            indexed: 0,
            started: Instant::now(),
            writing: Duration::from_secs_f64(manifest.writing_time_s),
            flown_before: Duration::from_secs_f64(manifest.wall_time_s),
            schedule: Schedule::new(case.output.save),
            manifest,
            dir,
        };
        writer.note()?;
        Ok(writer)
    }

    /// Saves the state if it is time to; to be called after [`Self::write`] of the same step.
    ///
    /// # Errors
    /// A file that cannot be written; the last checkpoint stays valid.
    pub fn save_if_due(&mut self, state: &FlightState) -> Result<(), IoError> {
        let last = state.step == self.case.setup.time.steps && self.case.output.save.keep;
        if last || self.schedule.due(state.step) {
            self.save(state)?;
        }
        Ok(())
    }

    /// Saves the state now.
    ///
    /// # Errors
    /// A file that cannot be written; the last checkpoint stays valid.
    pub fn save(&mut self, state: &FlightState) -> Result<(), IoError> {
        let begun = Instant::now();
        self.finish_frames()?;
        let (history_bytes, history_sha256) = self.seal()?;
        let header = Header {
            version: self.manifest.version.clone(),
            case_sha256: self.manifest.case_sha256.clone(),
            step: state.step,
            history_bytes,
            history_sha256,
            pending: self.history.pending(),
            each_step: self.each.as_ref().map_or(vec![], EachStep::saved),
        };
        saver::write(self.dir.path(), &header, state)?;
        self.schedule.done();
        self.writing += begun.elapsed();
        self.note()
    }

    /// Sees the history onto the disk; its length and hash.
    fn seal(&mut self) -> Result<(u64, String), IoError> {
        let (bytes, hash) = self.history.seal()?;
        self.manifest.history_bytes = bytes;
        self.manifest.history_sha256.clone_from(&hash);
        Ok((bytes, hash))
    }

    /// Writes the manifest as it is now.
    fn note(&self) -> Result<(), IoError> {
        let mut manifest = self.manifest.clone();
        manifest.frames = self.frames.len();
        manifest.wall_time_s = (self.flown_before + self.started.elapsed()).as_secs_f64();
        manifest.writing_time_s = self.writing.as_secs_f64();
        self.dir
            .write("manifest.json", manifest.to_json().as_bytes())
    }

    /// Frames of earlier steps that are missing or damaged, each with what is wrong: they are not made again by going on.
    pub fn lost_frames(&self) -> &[IoError] {
        &self.lost_frames
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
        let output = &self.case.output;
        let (every, time) = (output.frames_every, &self.case.setup.time);
        let last = record.step == time.steps;
        let framed = every > 0 && (record.step.is_multiple_of(every) || last);
        let due = record.step.is_multiple_of(output.history_every);
        let beat_ends = time
            .steps_per_beat()
            .is_some_and(|n| record.step.is_multiple_of(n));
        self.history.take(record)?;
        if due || beat_ends || framed || last {
            self.history.flush()?;
        }
        if let Some(each) = &mut self.each {
            each.take(record, &self.case.setup);
        }
        self.manifest.steps = record.step;
        self.manifest.wake_rings = record.wake_rings;
        if framed {
            self.frame(snapshot())?;
        }
        self.writing += begun.elapsed();
        Ok(())
    }

    fn frame(&mut self, snapshot: Snapshot) -> Result<(), IoError> {
        if snapshot.surfaces.is_empty() {
            return Ok(());
        }
        self.frames.push((snapshot.time, snapshot.step));
        let (folder, parts) = (self.dir.join("frames"), parts(&self.case));
        let framer = self
            .framer
            .get_or_insert_with(|| Framer::new(folder, parts));
        framer.put(snapshot)?;
        if self.frames.len() >= self.indexed + self.indexed.div_ceil(INDEX_GROWTH).max(1) {
            self.index()?;
        }
        Ok(())
    }

    /// Waits until the frames taken so far are on the disk.
    fn finish_frames(&mut self) -> Result<(), IoError> {
        self.framer.as_mut().map_or(Ok(()), Framer::wait)
    }

    fn index(&mut self) -> Result<(), IoError> {
        if self.frames.is_empty() {
            return Ok(());
        }
        self.finish_frames()?;
        self.indexed = self.frames.len();
        self.dir.write(
            "flight.pvd",
            pvd(&self.frames, parts(&self.case)).as_bytes(),
        )
    }

    /// Takes note of sums over the wakes that were checked.
    pub(super) fn count(&mut self, sums: Tally) {
        self.manifest.checked_sums += sums.checked;
        self.manifest.discarded_sums += sums.discarded;
    }

    /// Ends a result that cannot be written any more: only the reason is noted, if that still goes.
    pub fn abandon(mut self, why: String) {
        self.manifest.outcome = Outcome::Unwritten(why);
        let _ = self.note(); // on a full disk not even this may go
    }

    /// Ends the result: index, what `draw` draws (`wingbeat_draw::draw_run`, or nothing), summary,
    /// manifest.
    ///
    /// # Errors
    /// A file that cannot be written. One that `draw` cannot read ([`IoError::Damaged`]): of a flight at its
    /// end all else is written nevertheless, for no flying on mends it.
    pub fn finish(
        mut self,
        outcome: Outcome,
        draw: impl FnOnce(&ResultDir, &LoadedCase, &Summary) -> Result<(), IoError>,
    ) -> Result<Summary, IoError> {
        let begun = Instant::now();
        self.index()?;
        self.history.flush()?; // of a thinned history, the step where the flight stopped
        self.seal()?;
        let path = self.dir.join("history.csv");
        let summary = Summary::of_run(&self.case, &path, &outcome, self.each.take())?;
        // Before what draws, which reads it.
        self.dir
            .write("summary.txt", summary.to_text().as_bytes())?;
        self.dir
            .write("summary.json", summary.to_json().as_bytes())?;
        let drawn = match draw(&self.dir, &self.case, &summary) {
            Err(e) if outcome != Outcome::Finished || !matches!(e, IoError::Damaged { .. }) => {
                return Err(e);
            }
            drawn => drawn,
        };
        self.writing += begun.elapsed();
        self.manifest.outcome = outcome;
        self.manifest.warnings.clone_from(&summary.warnings);
        self.note()?;
        if self.manifest.outcome == Outcome::Finished && !self.case.output.save.keep {
            saver::forget(self.dir.path())?;
        }
        drawn.map(|()| summary)
    }
}

/// Whether the history of a case leaves steps out.
fn is_thinned(case: &LoadedCase) -> bool {
    case.output.history_every > 1
}

/// What a frame of the flight of a case is made of.
fn parts(case: &LoadedCase) -> &'static [&'static str] {
    let parts: &'static [&'static str] = &["surfaces", "wakes", "particles"];
    match &case.setup.air {
        AirModel::VortexLattice(air) if air.lattice.particles.is_some() => parts,
        _ => &parts[..2],
    }
}
