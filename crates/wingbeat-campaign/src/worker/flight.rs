//! One flight: in memory, or in a result directory from which it goes on after a kill, bit for bit.

use std::fs;
use std::ops::ControlFlow::{Break, Continue};
use std::path::Path;

use wingbeat_case::{IoError, LoadedCase};
use wingbeat_draw::draw_run;
use wingbeat_flight::{FlightError, Simulation};
use wingbeat_results::directory::remove_directory;
use wingbeat_results::history::is_locked;
use wingbeat_results::{Outcome, RecordedFlight, Records, ResultDir, Summary, saver};

use crate::worker::evaluate::Flown;

/// Why a flight has no end.
#[derive(Debug)]
pub enum Halt {
    /// It was asked to stop.
    Stopped,
    /// It took longer than it may.
    Slow,
    /// It cannot begin.
    Refused(String),
    /// It has fewer wingbeats than means are taken over.
    Short(String),
    /// It cannot go on.
    Diverged(String),
    /// A file cannot be read or written.
    Io(IoError),
}

impl From<IoError> for Halt {
    fn from(e: IoError) -> Self {
        Self::Io(e)
    }
}

impl From<FlightError> for Halt {
    fn from(e: FlightError) -> Self {
        Self::Diverged(e.to_string())
    }
}

/// Asked before every step whether the flight goes on.
pub type Watch<'a> = &'a mut dyn FnMut() -> Result<(), Halt>;

fn begin(case: &LoadedCase) -> Result<Simulation, Halt> {
    let flight = Simulation::new(case.setup.clone());
    flight.map_err(|e| Halt::Refused(case.refused(&e).problem))
}

/// Flies a case in memory.
///
/// # Errors
/// Why it has no end.
pub fn in_memory(case: &LoadedCase, watch: Watch) -> Result<Flown, Halt> {
    let mut flight = begin(case)?;
    let mut records = Vec::with_capacity(case.setup.time.steps + 1);
    flight.fly(|flight| {
        records.push(flight.record().clone());
        if !flight.finished() {
            watch()?;
        }
        Ok::<_, Halt>(Continue(()))
    })?;
    Ok(Flown {
        setup: flight.setup().clone(),
        summary: Summary::of(flight.setup(), &records, &Outcome::Finished),
        records,
    })
}

/// Flies a case in the result directory `path`, which may hold a part of it already.
///
/// # Errors
/// Why it has no end; where it was asked to stop, its state is saved. [`IoError::Busy`] where another process
/// writes there.
pub fn in_directory(path: &Path, case: &LoadedCase, watch: Watch) -> Result<Flown, Halt> {
    let history = path.join("history.csv");
    if is_locked(&history) {
        return Err(IoError::Busy { path: history }.into()); // nothing of it may be removed
    }
    match resumed(path, case)? {
        Some(flight) => fly(flight, watch)?,
        None if is_finished(path) => {}
        None => {
            remove_directory(path)?;
            let flight = begin(case)?;
            let dir = ResultDir::create(path)?;
            fly(RecordedFlight::begin(dir, case, flight, 1)?, watch)?;
        }
    }
    let mut rows = Records::open(&history, &case.setup)?;
    let mut records = vec![];
    while let Some(record) = rows.next_record()? {
        records.push(record.clone());
    }
    Ok(Flown {
        setup: case.setup.clone(),
        records,
        // As it was written: of all steps, also where the history leaves some out.
        summary: Summary::read(case, &history, &Outcome::Finished)?,
    })
}

/// Whether the flight in a directory has ended, and is what was written.
fn is_finished(path: &Path) -> bool {
    let outcome = ResultDir::read(path).and_then(|d| d.manifest());
    outcome.is_ok_and(|m| m.outcome == Outcome::Finished)
}

/// The flight at the last checkpoint in `path`; none where there is none that can be used.
fn resumed(path: &Path, case: &LoadedCase) -> Result<Option<RecordedFlight>, IoError> {
    let Ok(saved) = saver::read(path) else {
        return Ok(None); // nothing there, or damaged: from the start
    };
    let Some((header, state)) = saved.checkpoint else {
        return Ok(None);
    };
    if saved.manifest.outcome == Outcome::Finished {
        return Ok(None);
    }
    // The case in the directory has the lines of this one; programs beside us do not go on.
    let same = fs::read_to_string(path.join("case.toml")).is_ok_and(|t| t == case.resolved());
    let flight = match same && case.program().is_none() {
        true => Simulation::resume(case.setup.clone(), state).ok(),
        false => None,
    };
    let Some(flight) = flight else {
        return Ok(None);
    };
    let dir = ResultDir::open(path)?;
    RecordedFlight::resume(dir, case, flight, (&header, saved.manifest), 1).map(Some)
}

/// To the end; where it is asked to stop, its state is saved.
fn fly(mut flight: RecordedFlight, watch: Watch) -> Result<(), Halt> {
    let mut is_stopped = false;
    let flown = flight.fly(|_| match watch() {
        Err(Halt::Stopped) => {
            is_stopped = true;
            Ok(Break(()))
        }
        watched => watched.map(Continue),
    });
    match flown {
        Ok(_) if is_stopped => Err(Halt::Stopped),
        Ok(outcome) => {
            flight.finish(outcome, draw_run)?;
            Ok(())
        }
        Err(Halt::Diverged(why)) => {
            let _ = flight.finish(Outcome::Failed(why.clone()), draw_run); // the reason counts
            Err(Halt::Diverged(why))
        }
        Err(halt) => Err(halt),
    }
}

/// Step of the last checkpoint in a result directory, as its manifest tells; 0 without one.
pub fn saved_step(path: &Path) -> usize {
    match path.join("checkpoint.bin").is_file() {
        true => saver::read_manifest(path).map_or(0, |m| m.steps),
        false => 0,
    }
}
