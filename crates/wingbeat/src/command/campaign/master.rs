//! Worker processes: started, started again when they die, ended.

use std::ffi::OsString;
use std::io::{BufRead as _, BufReader};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget};

use wingbeat::case::operand;

use super::args::duration;
use crate::command::output::failure::{FAILED, Failure, INTERRUPTED};
use crate::command::output::terminal::tell;
use crate::command::progress::bar::bar;

/// Time between two looks at the processes.
const LOOK: Duration = Duration::from_millis(20);
/// Processes that may die one after the other while no point is done.
const MAX_DEATHS: usize = 200;

/// Processors of this machine.
pub(super) fn processors() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// Starts processes and looks after them.
pub(super) struct Master {
    arguments: Vec<OsString>,
    total: usize,
    bar: ProgressBar,
    /// Points that the processes have done.
    points: Arc<AtomicUsize>,
}

/// What became of a process.
enum End {
    Complete,
    Stopped,
    Failed,
    Died,
}

impl Master {
    pub(super) fn new(
        file: &Path,
        folder: &Path,
        plan: &str,
        range: Range<usize>,
        quiet: bool,
    ) -> Self {
        let target = if quiet {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let words = ["campaign", "work"].map(OsString::from).into_iter();
        let points = format!("{}..{}", range.start, range.end);
        let rest = [
            operand(file).into(),
            "--out".into(),
            folder.into(),
            "--points".into(),
            points.into(),
            "--plan".into(),
            plan.into(),
        ];
        Self {
            arguments: words.chain(rest).collect(),
            total: range.len(),
            bar: bar(target, range.len() as u64),
            points: Arc::default(),
        }
    }

    /// Has `jobs` processes work until all points are done; `done` of them were before.
    pub(super) fn work(
        &mut self,
        jobs: usize,
        done: usize,
        stop: &AtomicBool,
    ) -> Result<(), Failure> {
        let begun = Instant::now();
        let jobs = jobs.min(self.total - done).max(1);
        let mut workers: Vec<Child> = vec![];
        let mut failure = (0..jobs).find_map(|_| self.start_in(&mut workers));
        let (mut deaths, mut before) = (0, 0);
        while !workers.is_empty() {
            thread::sleep(LOOK);
            if failure.is_some() || stop.load(Ordering::SeqCst) {
                workers.iter_mut().for_each(|w| drop(w.stdin.take())); // they end after their point
            }
            let points = self.points.load(Ordering::Relaxed);
            if points > before {
                (before, deaths) = (points, 0);
            }
            self.show(done + points, points, begun.elapsed());
            let mut left = vec![];
            for mut worker in workers {
                match ended(&mut worker) {
                    None => left.push(worker),
                    Some(End::Complete | End::Stopped) => {}
                    Some(End::Failed) => failure = failure.or(Some(Failure::Told(FAILED))),
                    Some(End::Died) if stop.load(Ordering::SeqCst) || failure.is_some() => {}
                    Some(End::Died) if deaths >= MAX_DEATHS => {
                        tell!(
                            "error: {deaths} processes died one after the other before they did a point"
                        );
                        failure = Some(Failure::Told(FAILED));
                    }
                    Some(End::Died) => {
                        deaths += 1;
                        failure = self.start_in(&mut left);
                    }
                }
            }
            workers = left;
        }
        self.bar.finish_and_clear();
        match (failure, stop.load(Ordering::SeqCst)) {
            (Some(failure), _) => Err(failure),
            (None, true) => {
                tell!("interrupted: what is done is kept; the same command goes on");
                Err(Failure::Told(INTERRUPTED))
            }
            (None, false) => Ok(()),
        }
    }

    /// Starts a process among `workers`; why it cannot be started.
    fn start_in(&self, workers: &mut Vec<Child>) -> Option<Failure> {
        match self.start() {
            Ok(worker) => workers.push(worker),
            Err(failure) => return Some(failure),
        }
        None
    }

    /// Starts a process that counts its points on its standard output, and ends with its standard input.
    fn start(&self) -> Result<Child, Failure> {
        let (program, before) = own_program();
        let mut command = Command::new(program);
        command.args(before).args(&self.arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let child = command.spawn();
        let mut child =
            child.map_err(|e| Failure::Option(format!("cannot start a process: {e}")))?;
        let points = Arc::clone(&self.points);
        let output = child.stdout.take();
        thread::spawn(move || {
            let lines = output.into_iter().flat_map(|o| BufReader::new(o).lines());
            for line in lines.map_while(Result::ok) {
                points.fetch_add(line.trim().parse().unwrap_or(0), Ordering::Relaxed);
            }
        });
        Ok(child)
    }

    fn show(&self, done: usize, own: usize, since: Duration) {
        if self.bar.is_hidden() {
            return;
        }
        let rate = own as f64 / since.as_secs_f64();
        let left = match own {
            0 => String::new(),
            _ => format!(
                ", {rate:.1} a second, {} left",
                duration((self.total.saturating_sub(done)) as f64 / rate)
            ),
        };
        self.bar.set_position(done as u64);
        self.bar
            .set_message(format!("{done} of {} points{left}", self.total));
    }
}

/// What became of a process, if it has ended; one that cannot be asked is not waited for.
fn ended(worker: &mut Child) -> Option<End> {
    let Ok(status) = worker.try_wait() else {
        return Some(End::Died);
    };
    Some(match status?.code() {
        Some(0) => End::Complete,
        Some(code) if code == i32::from(INTERRUPTED) => End::Stopped,
        Some(1 | 2) => End::Failed, // it has told why
        _ => End::Died,
    })
}

/// The program that runs now, and what stands before its commands (a script, where an interpreter carries us:
/// that is called by the name that it was called by, which tells it its environment).
fn own_program() -> (PathBuf, Vec<OsString>) {
    let words: Vec<OsString> = std::env::args_os().collect();
    let command = words.iter().position(|w| w == "campaign").unwrap_or(1);
    let called = words.first().map(PathBuf::from).unwrap_or_default();
    let before = words.get(1..command).unwrap_or_default().to_vec();
    let program = match before.is_empty() {
        true => std::env::current_exe().unwrap_or(called),
        false => called,
    };
    (program, before)
}
