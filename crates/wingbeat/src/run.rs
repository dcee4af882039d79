//! `wingbeat run`: fly a case, write its results, say what happened.

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use wingbeat::flight::{FlightError, Simulation};
use wingbeat::io::{IoError, LoadedCase, Outcome, ResultDir, RunWriter};

use crate::progress::Progress;
use crate::{RunArgs, refuse};

const INTERRUPTED: u8 = 130;

/// The whole command.
pub(crate) fn run(args: &RunArgs) -> ExitCode {
    let threads = match set_threads(args.threads) {
        Ok(n) => n,
        Err(problem) => {
            eprintln!("error: {problem}");
            return ExitCode::from(2);
        }
    };
    let prepared = prepare(args, threads);
    let (case, flight, writer) = match prepared {
        Ok(ready) => ready,
        Err(e) => return refuse(&e),
    };
    if !args.quiet {
        eprintln!(
            "{}: results go to {}",
            case.name,
            writer.dir().path().display()
        );
    }
    let stop = stop_flag();
    fly(args, &case, flight, writer, &stop)
}

/// The number of threads in use.
fn set_threads(wanted: Option<usize>) -> Result<usize, String> {
    if wanted == Some(0) {
        return Err(
            "--threads 0: give a whole number >= 1, or leave the option out to use all".to_owned(),
        );
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(wanted.unwrap_or(0));
    pool.build_global()
        .map_err(|e| format!("cannot start threads: {e}"))?;
    Ok(rayon::current_num_threads())
}

/// Everything that can be refused before a step is made; the directory is made last.
fn prepare(args: &RunArgs, threads: usize) -> Result<(LoadedCase, Simulation, RunWriter), IoError> {
    let case = LoadedCase::find(&args.case, &args.set)?;
    if let Some(out) = args
        .out
        .as_deref()
        .filter(|out| out.exists() && !args.overwrite)
    {
        ResultDir::create(out)?; // refuses before the flight is built
    }
    let flight = Simulation::new(case.setup.clone());
    let flight = flight.map_err(|e| {
        case.fault(
            "",
            e.to_string(),
            "correct the case; `wingbeat check` tells whether it can be flown",
        )
    })?;
    let dir = match &args.out {
        Some(out) if args.overwrite => ResultDir::overwrite(out)?,
        Some(out) => ResultDir::create(out)?,
        None => ResultDir::next_free(Path::new("results"), &case.name)?,
    };
    let writer = RunWriter::new(dir, &case, threads)?;
    Ok((case, flight, writer))
}

/// Set by Ctrl-C or SIGTERM; a second one ends the program at once.
fn stop_flag() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    let handler = move || {
        if flag.swap(true, Ordering::SeqCst) {
            std::process::exit(i32::from(INTERRUPTED));
        }
    };
    if let Err(e) = ctrlc::set_handler(handler) {
        eprintln!("warning: Ctrl-C will not end the run cleanly ({e})");
    }
    stop
}

fn fly(
    args: &RunArgs,
    case: &LoadedCase,
    mut flight: Simulation,
    mut writer: RunWriter,
    stop: &AtomicBool,
) -> ExitCode {
    let progress = Progress::new(&case.setup, args.quiet);
    let flown = steps(&mut flight, &mut writer, &progress, stop);
    progress.clear();
    let outcome = match flown {
        Ok(outcome) => outcome,
        Err(Trouble::Flight(e)) => Outcome::Failed(e.to_string()),
        Err(Trouble::Writing(e)) => Outcome::Unwritten(e.to_string()),
    };
    let path = writer.dir().path().to_owned();
    match writer.finish(outcome.clone()) {
        Ok(summary) if !args.quiet => {
            println!("\n{}\nResults: {}", summary.to_text(), path.display())
        }
        Ok(_) => {}
        Err(e) => {
            eprintln!("error: {e}");
            return ExitCode::from(1);
        }
    }
    report(&outcome, &path)
}

fn report(outcome: &Outcome, path: &Path) -> ExitCode {
    match outcome {
        Outcome::Finished | Outcome::Running => ExitCode::SUCCESS,
        Outcome::Interrupted => {
            eprintln!(
                "interrupted: everything up to here is written to {}",
                path.display()
            );
            ExitCode::from(INTERRUPTED)
        }
        Outcome::Unwritten(why) | Outcome::Failed(why) => {
            eprintln!(
                "error: {why}\nEverything up to there is written to {}",
                path.display()
            );
            ExitCode::from(1)
        }
    }
}

enum Trouble {
    Flight(FlightError),
    Writing(IoError),
}

/// The loop of the flight.
fn steps(
    flight: &mut Simulation,
    writer: &mut RunWriter,
    progress: &Progress,
    stop: &AtomicBool,
) -> Result<Outcome, Trouble> {
    loop {
        writer
            .write(flight.record(), || flight.snapshot())
            .map_err(Trouble::Writing)?;
        progress.show(flight.record());
        if flight.finished() {
            return Ok(Outcome::Finished);
        }
        if stop.load(Ordering::SeqCst) {
            return Ok(Outcome::Interrupted);
        }
        flight.step().map_err(Trouble::Flight)?;
    }
}
