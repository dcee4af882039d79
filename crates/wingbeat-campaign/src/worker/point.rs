//! A point: its tasks one after the other, its numbers, the files that are kept of it.

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use wingbeat_analysis::{AnalysisError, Trim, power_of_trim};
use wingbeat_case::{IoError, LoadedCase, trimmed_case};
use wingbeat_flight::FlightError;
use wingbeat_results::directory::{remove_directory, remove_file};
use wingbeat_results::saver;
use wingbeat_results::summary::Verdict;

use crate::campaign::Campaign;
use crate::plan::raw::{FRAMES_EVERY, FileKind, HISTORY_EVERY, Task};
use crate::plan::trimming;
use crate::store::{PointResult, Reason, Store};
use crate::worker::evaluate;
use crate::worker::flight::{Halt, in_directory, in_memory};

/// What came of a point.
#[derive(Debug)]
pub enum Done {
    /// Numbers, or why there are none.
    Result(PointResult),
    /// It was asked to stop.
    Stopped,
    /// Another process is flying it.
    Busy,
    /// Files could not be written.
    Unwritten(IoError),
}

/// Files and folders of a result directory by what is kept.
const KEPT: [(FileKind, &[&str]); 5] = [
    (FileKind::Page, &["flight.html"]),
    (FileKind::History, &["history.csv"]),
    (FileKind::Figures, &["figures"]),
    (FileKind::Frames, &["frames", INDEX]),
    (FileKind::Summary, &["summary.txt", "summary.json"]),
];
/// Index of the frames, where there are any.
const INDEX: &str = "flight.pvd";
/// Steps of a flight that has a page, at least.
const DRAWN: usize = 2;
/// What is kept beside any of them.
const ALWAYS: [&str; 2] = ["case.toml", "manifest.json"];

/// Whether the files that point `i` keeps are there, of figures and frames their folders: a short flight has
/// none in them.
pub fn has_files(campaign: &Campaign, i: usize, hash: &str, store: &Store) -> bool {
    if !campaign.keeps_files(i) {
        return true;
    }
    let place = store.path("files").join(hash);
    let Ok(manifest) = saver::read_manifest(&place) else {
        return false;
    };
    let frames = !campaign.plan().varies(FRAMES_EVERY);
    let written = |kind: FileKind| match kind {
        FileKind::Page => manifest.steps >= DRAWN,
        FileKind::Frames => frames,
        FileKind::Figures | FileKind::History | FileKind::Summary => true,
    };
    let kept = KEPT
        .iter()
        .filter(|(kind, _)| campaign.raw().files.contains(kind) && written(*kind));
    let names = kept.flat_map(|(_, names)| names.iter().copied());
    let mut names = names.filter(|name| *name != INDEX).chain(ALWAYS);
    names.all(|name| place.join(name).exists())
}

/// Does what is to be done at point `i`, whose hash is `hash`; with a `store`, flights that take long or keep
/// files have a directory there.
pub fn fly(
    campaign: &Campaign,
    i: usize,
    hash: &str,
    store: Option<&Store>,
    stop: &AtomicBool,
) -> Done {
    let work = store.map(|s| s.path("work").join(hash));
    let mut point = Point {
        campaign,
        i,
        work: work.as_deref(),
        stop,
        end: (campaign.raw().budget.time_per_point_s)
            .map(|s| Instant::now() + Duration::from_secs_f64(s)),
        values: vec![f64::NAN; campaign.numbers.len()],
        verdict: None,
    };
    let found = point.tasks().and_then(|()| match store {
        Some(store) => Ok(point.keep_files(store, hash)?),
        None => Ok(()),
    });
    let failed = |reason, words| Done::Result(PointResult::failure(reason, words));
    let done = match found {
        Ok(()) => Done::Result(PointResult::of(&point.values, point.verdict)),
        Err(Halt::Stopped) => return Done::Stopped,
        Err(Halt::Io(IoError::Busy { .. })) => return Done::Busy,
        Err(Halt::Io(e)) => return Done::Unwritten(e),
        Err(Halt::Slow) => {
            let limit = campaign.raw().budget.time_per_point_s.unwrap_or(0.0);
            failed(Reason::Slow, format!("it took longer than {limit} s"))
        }
        Err(Halt::Refused(words)) => failed(Reason::Refused, words),
        Err(Halt::Short(words)) => failed(Reason::Short, words),
        Err(Halt::Diverged(words)) => failed(Reason::Diverged, words),
    };
    if let Some(work) = work.filter(|w| !campaign.raw().retention.failed && w.exists()) {
        let _ = remove_directory(&work); // at worst it stays
    }
    done
}

struct Point<'a> {
    campaign: &'a Campaign,
    i: usize,
    work: Option<&'a Path>,
    stop: &'a AtomicBool,
    end: Option<Instant>,
    values: Vec<f64>,
    verdict: Option<Verdict>,
}

impl Point<'_> {
    /// One task after the other.
    fn tasks(&mut self) -> Result<(), Halt> {
        let campaign = self.campaign;
        let mut case = self.case()?;
        let mut trim = None;
        for task in &campaign.raw().tasks {
            self.watch()?;
            match (task, &trim) {
                (Task::Run, None) => self.run(&case)?,
                (Task::Run, Some(trim)) => {
                    case = self.trimmed(&case, trim)?;
                    self.run(&case)?;
                }
                (Task::Trim, _) => trim = Some(self.trim(&case)?),
                (Task::Stability, Some(trim)) => {
                    evaluate::of_stability(trim, &campaign.numbers, &mut self.values)
                        .map_err(analysis)?;
                }
                (Task::Power, Some(trim)) => {
                    let power = power_of_trim(trim).map_err(analysis)?;
                    evaluate::of_power(&power, &campaign.numbers, &mut self.values);
                }
                (Task::Stability | Task::Power, None) => {
                    unreachable!("a campaign has a trim before them")
                }
            }
        }
        Ok(())
    }

    /// Whether the point goes on.
    fn watch(&self) -> Result<(), Halt> {
        if self.stop.load(Ordering::Relaxed) {
            return Err(Halt::Stopped);
        }
        match self.end.is_some_and(|end| Instant::now() > end) {
            true => Err(Halt::Slow),
            false => Ok(()),
        }
    }

    /// What is drawn and written of this point.
    fn output(&self) -> Vec<String> {
        let keeps = |kind| {
            let kept = self.campaign.raw().files.contains(&kind);
            kept && self.campaign.keeps_files(self.i)
        };
        let mut set = vec![
            format!("output.page={}", keeps(FileKind::Page)),
            format!("output.figures={}", keeps(FileKind::Figures)),
        ];
        if !keeps(FileKind::Page) && !keeps(FileKind::Frames) {
            set.push(format!("{FRAMES_EVERY}=0"));
        }
        set
    }

    fn case(&self) -> Result<LoadedCase, Halt> {
        let case = self.campaign.case(self.i, &self.output());
        case.map_err(|e| match e {
            IoError::Case(e) => {
                let words = match e.key.is_empty() {
                    true => e.problem.clone(),
                    false => format!("{}: {}", e.key, e.problem),
                };
                Halt::Refused(words)
            }
            e => Halt::Refused(e.to_string()),
        })
    }

    fn run(&mut self, case: &LoadedCase) -> Result<(), Halt> {
        let campaign = self.campaign;
        if case.output.history_every > 1 && evaluate::need_every_step(&campaign.numbers) {
            let words = format!(
                "{HISTORY_EVERY} leaves steps out, which means and extremes of columns need"
            );
            return Err(Halt::Refused(words));
        }
        let place = self.work.filter(|_| campaign.has_directory(self.i, case));
        let flown = match place {
            Some(path) => {
                let folder = path.parent().unwrap_or(path);
                fs::create_dir_all(folder).map_err(IoError::write(folder))?;
                in_directory(path, case, &mut || self.watch())?
            }
            None => in_memory(case, &mut || self.watch())?,
        };
        let beats = campaign.raw().mean_beats();
        if let Some(words) = flown.lacks(&campaign.numbers, beats) {
            return Err(Halt::Short(words));
        }
        let filled = flown.fill(&campaign.numbers, beats, &mut self.values);
        filled.map_err(Halt::Diverged)?;
        self.verdict = Some(flown.summary.verdict);
        Ok(())
    }

    fn trim(&mut self, case: &LoadedCase) -> Result<Trim, Halt> {
        let options = self.campaign.trim_options(self.i);
        let options = options.map_err(|e| Halt::Refused(e.to_string()))?;
        let trim = trimming::trim(&case.setup, &options.unwrap_or_default()).map_err(analysis)?;
        evaluate::of_trim(&trim, &self.campaign.numbers, &mut self.values);
        Ok(trim)
    }

    /// The case of the trimmed flight.
    fn trimmed(&self, case: &LoadedCase, trim: &Trim) -> Result<LoadedCase, Halt> {
        let text = trimmed_case(case, trim).map_err(analysis)?;
        let trimmed = LoadedCase::from_text(case.origin(), &text, Path::new(""), &[]);
        trimmed.map_err(|e| Halt::Refused(format!("the trimmed flight: {e}")))
    }

    /// Leaves of the result directory what is kept, and puts it in its place.
    fn keep_files(&self, store: &Store, hash: &str) -> Result<(), IoError> {
        let Some(work) = self.work.filter(|w| w.exists()) else {
            return Ok(());
        };
        if !self.campaign.keeps_files(self.i) {
            return remove_directory(work).map(drop);
        }
        let kept = KEPT
            .iter()
            .filter(|(kind, _)| self.campaign.raw().files.contains(kind));
        let names: Vec<&str> = kept
            .flat_map(|(_, names)| names.iter().copied())
            .chain(ALWAYS)
            .collect();
        for entry in fs::read_dir(work).map_err(IoError::read(work))?.flatten() {
            let (name, path) = (entry.file_name(), entry.path());
            if !name.to_str().is_some_and(|n| names.contains(&n)) {
                match path.is_dir() {
                    true => remove_directory(&path)?,
                    false => remove_file(&path)?,
                };
            }
        }
        let place = store.path("files").join(hash);
        remove_directory(&place)?;
        store.make(&store.path("files"))?;
        fs::rename(work, &place).map_err(IoError::write(&place))
    }
}

fn analysis(e: AnalysisError) -> Halt {
    match e {
        AnalysisError::NotCovered { .. }
        | AnalysisError::Asymmetric { .. }
        | AnalysisError::Flight(FlightError::Setup { .. }) => Halt::Refused(e.to_string()),
        e => Halt::Diverged(e.to_string()),
    }
}
