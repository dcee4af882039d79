//! `wingbeat run` and `wingbeat resume`: fly a case, write its results, say what happened.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use wingbeat::case::{IoError, LoadedCase, presets, shell_path};
use wingbeat::draw::draw_run;
use wingbeat::flight::{FlightError, Simulation};
use wingbeat::results::{Outcome, RESULTS, RecordedFlight, ResultDir, Summary, saver};

use crate::command::case::programs::name_program;
use crate::command::options::{CaseArgs, RunOptions};
use crate::command::output::failure::{self, FAILED, Failure, INTERRUPTED};
use crate::command::output::target::folder;
use crate::command::output::terminal::{self, say, tell};
use crate::command::progress::bar::Progress;
use crate::command::signals::Interrupts;

/// Arguments of `wingbeat run`.
#[derive(Args)]
#[command(mut_arg("case", |a| a.required(false).default_value(presets::DEFAULT)))]
pub(crate) struct RunArgs {
    #[command(flatten)]
    case: CaseArgs,
    /// Result directory; default results/NAME, with a number appended if that exists.
    #[arg(long, value_name = "DIR", value_parser = folder())]
    out: Option<PathBuf>,
    /// Replace an earlier run in the result directory.
    #[arg(long, requires = "out")]
    overwrite: bool,
    #[command(flatten)]
    options: RunOptions,
}

/// Arguments of `wingbeat resume`.
#[derive(Args)]
pub(crate) struct ResumeArgs {
    /// Result directory of the run.
    dir: PathBuf,
    #[command(flatten)]
    options: RunOptions,
}

/// A flight that is written, and its case.
struct Run {
    case: LoadedCase,
    flight: RecordedFlight,
}

/// `wingbeat run`.
pub(crate) fn run(args: &RunArgs) -> Result<(), Failure> {
    let threads = set_threads(args.options.threads)?;
    let interrupts = Interrupts::while_building();
    let run = prepare(args, threads, &interrupts)?;
    start(&args.options, run, &interrupts)
}

/// `wingbeat resume`.
pub(crate) fn resume(args: &ResumeArgs) -> Result<(), Failure> {
    let threads = set_threads(args.options.threads)?;
    let interrupts = Interrupts::while_building();
    match go_back(args, threads, &interrupts)? {
        Some(run) => start(&args.options, run, &interrupts),
        None => Ok(()),
    }
}

fn start(options: &RunOptions, run: Run, interrupts: &Interrupts) -> Result<(), Failure> {
    if !options.silent() {
        let dir = run.flight.dir().path().display();
        tell!("{}: results go to {dir}", run.case.name);
    }
    fly(options, run, interrupts.stop())
}

/// The number of threads in use.
fn set_threads(wanted: Option<usize>) -> Result<usize, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(wanted.unwrap_or(0));
    let built = pool.build_global();
    built.map_err(|e| Failure::Option(format!("cannot start threads: {e}")))?;
    Ok(rayon::current_num_threads())
}

/// Everything that can be refused before a step is made; the directory is made last.
fn prepare(args: &RunArgs, threads: usize, interrupts: &Interrupts) -> Result<Run, IoError> {
    let case = args.case.load()?;
    if let Some(out) = args
        .out
        .as_deref()
        .filter(|out| out.exists() && !args.overwrite)
    {
        ResultDir::create_or_fill(out)?; // refuses before the flight is built
    }
    let flight = build(&case, interrupts)?;
    let dir = match &args.out {
        Some(out) if args.overwrite => ResultDir::overwrite(out)?,
        Some(out) => ResultDir::create_or_fill(out)?,
        None => ResultDir::next_free(Path::new(RESULTS), &case.name)?,
    };
    begin(dir, case, flight, threads)
}

fn build(case: &LoadedCase, interrupts: &Interrupts) -> Result<Simulation, IoError> {
    name_program(case);
    let flight = Simulation::new(case.setup.clone());
    interrupts.flight_is_built();
    Ok(flight.map_err(|e| case.refused(&e))?)
}

/// Writes what there is before the first step.
fn begin(
    dir: ResultDir,
    case: LoadedCase,
    flight: Simulation,
    threads: usize,
) -> Result<Run, IoError> {
    let flight = RecordedFlight::begin(dir, &case, flight, threads)?;
    Ok(Run { case, flight })
}

/// Goes back to the last checkpoint; to the start, where a run was killed before its first one;
/// nowhere, where it flew to its end.
fn go_back(
    args: &ResumeArgs,
    threads: usize,
    interrupts: &Interrupts,
) -> Result<Option<Run>, IoError> {
    let dir = ResultDir::open(&args.dir)?;
    let saved = saver::read(dir.path())?;
    if saved.manifest.outcome == Outcome::Finished {
        dir.remove_half_written();
        if !dir.case()?.output.save.keep {
            // A kill at the very end may have left it; where nothing can be written it stays.
            let _ = saver::forget(dir.path());
        }
        if args.options.json {
            let history = dir.join("history.csv");
            let summary = Summary::read(&dir.case()?, &history, &saved.manifest.outcome)?;
            say!("{}", summary.to_json_line(dir.path()));
        } else {
            say!("{} has already finished.", dir.path().display());
        }
        return Ok(None);
    }
    let case = dir.case()?;
    let Some((header, state)) = saved.checkpoint else {
        let why = match case.setup.air.is_saved(None) {
            true if saved.manifest.steps > 0 => Some("it has no checkpoint (checkpoint.bin)"),
            true => None,
            false => Some("the memory of the program that computes its air is not saved"),
        };
        if let Some(why) = why {
            tell!("{}: {why}: it is flown from the start again", case.name);
        }
        let flight = build(&case, interrupts)?;
        dir.remove_derived()?;
        return begin(dir, case, flight, threads).map(Some);
    };
    if case.program().is_none() {
        name_program(&case); // a flight in external air is not resumed
    }
    let flight = Simulation::resume(case.setup.clone(), state).map_err(|e| IoError::Damaged {
        path: dir.join("checkpoint.bin"),
        problem: format!("the flight cannot go on from it: {e}"),
    })?;
    interrupts.flight_is_built();
    let flight = RecordedFlight::resume(dir, &case, flight, (&header, saved.manifest), threads)?;
    if !args.options.silent() {
        tell!(
            "{}: goes on after step {} of {}",
            case.name,
            header.step,
            case.setup.time.steps
        );
    }
    for lost in flight.lost_frames() {
        tell!("warning: {lost}");
    }
    Ok(Some(Run { case, flight }))
}

fn fly(options: &RunOptions, mut run: Run, stop: &AtomicBool) -> Result<(), Failure> {
    let from = run.flight.flight().state().step;
    let mut progress = Progress::new(&run.case.setup, options, from);
    // Within the pool: handing it work from outside wakes a thread for every sum.
    let flown = rayon::scope(|_| steps(&mut run, &mut progress, stop));
    progress.clear();
    let outcome = match flown {
        Ok(outcome) => outcome,
        Err(StepError::Flight(e)) => Outcome::Failed(e.to_string()),
        Err(StepError::Writing(e)) => return Err(unwritten(run.flight, &e)),
    };
    let path = run.flight.dir().path().to_owned();
    match run.flight.finish(outcome.clone(), draw_run) {
        Ok(summary) if options.json => say!("{}", summary.to_json_line(&path)),
        Ok(summary) if !options.quiet => {
            let text = terminal::judged(&summary);
            say!("\n{text}\nResults: {}", path.display());
        }
        Ok(_) => {}
        Err(e @ IoError::Damaged { .. }) if outcome == Outcome::Finished => {
            tell!(
                "error: {e}\nThe flight is at its end and its summary is written, `wingbeat show {0}`; what needs that file is not drawn.",
                shell_path(&path)
            );
            return Err(Failure::Told(FAILED));
        }
        Err(e) => {
            let said = failure::in_words(&e);
            tell!(
                "{said}\nThe flight itself is kept: `wingbeat resume {0}` goes on from its last checkpoint.",
                shell_path(&path)
            );
            return Err(Failure::Told(FAILED));
        }
    }
    report(&outcome, &path)
}

/// A result that cannot be written any more, e.g. on a full disk.
fn unwritten(flight: RecordedFlight, e: &IoError) -> Failure {
    let path = flight.dir().path().to_owned();
    flight.abandon(e.to_string());
    tell!(
        "error: {e}\nThe run stopped. What was written up to there is kept; when there is space again, `wingbeat resume {}` goes on from the last checkpoint, bit for bit.",
        shell_path(&path)
    );
    Failure::Told(FAILED)
}

fn report(outcome: &Outcome, path: &Path) -> Result<(), Failure> {
    let dir = path.display();
    match outcome {
        Outcome::Finished | Outcome::Running => Ok(()),
        Outcome::Interrupted => {
            tell!(
                "interrupted: everything up to here is written to {dir}; `wingbeat resume {}` takes it up again",
                shell_path(path)
            );
            Err(Failure::Told(INTERRUPTED))
        }
        Outcome::Unwritten(why) | Outcome::Failed(why) => {
            tell!("error: {why}\nEverything up to there is written to {dir}");
            Err(Failure::Told(FAILED))
        }
    }
}

enum StepError {
    Flight(FlightError),
    Writing(IoError),
}

impl From<FlightError> for StepError {
    fn from(e: FlightError) -> Self {
        Self::Flight(e)
    }
}

impl From<IoError> for StepError {
    fn from(e: IoError) -> Self {
        Self::Writing(e)
    }
}

/// Shows the steps as they are made, until the flight is at its end or asked to stop.
fn steps(run: &mut Run, progress: &mut Progress, stop: &AtomicBool) -> Result<Outcome, StepError> {
    let history = run.flight.dir().join("history.csv");
    let from = run.flight.flight().state().step;
    run.flight.fly(|flight| {
        if flight.state().step > from {
            progress.show(flight, &history, &run.case.output);
        }
        Ok(match stop.load(Ordering::SeqCst) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        })
    })
}
