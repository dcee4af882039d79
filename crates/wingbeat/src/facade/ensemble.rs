//! The same flight many times over.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use wingbeat_analysis::ensemble as analysis;
use wingbeat_campaign::KeptMembers;
use wingbeat_case::IoError;
use wingbeat_flight::{FlightError, FlightSetup, Simulation};
use wingbeat_results::Outcome;
use wingbeat_results::summary::{BeatMeans, Ensemble, left_out};

use super::batch::over_threads;
use super::error::Error;
use super::flight::Flight;

/// Flies `flight` so many times as there are `members`, at least two, over `threads` (0: as many as the machine
/// has): the first as it is, in the others the air moves by a millionth of the wings' speed (length over
/// period, or that of the stream), each in a direction of its own, all along a ground and, where half is
/// computed, the plane of symmetry. What separated flow makes of that is its uncertainty, as soon as the members have parted; until
/// then they are one flight. Where the senses of a controller are noisy, each member has noise of its own
/// (seeds that count on from that of the case), and is a flight of its own from the start. The same bits on any
/// number of threads.
///
/// ```
/// let flight = wingbeat::Flight::preset("fruit-fly-blade")?.beats(2.0);
/// let found = wingbeat::ensemble(&flight, 3, 0)?;
/// assert_eq!((found.members, found.beats.len()), (3, 2));
/// assert!(found.beats[1].spread < 1e-4); // blade elements forget
/// assert_eq!(found.beats[1].estimate.lift_newton.standard_error, None); // and members that have not parted are one flight
/// # Ok::<(), wingbeat::Error>(())
/// ```
///
/// # Errors
/// Air without a stream; fewer than two members, or flights without a whole wingbeat; those of [`Flight::fly`]
/// of the first member that fails: [`ensemble_watched`] has the means of the others.
pub fn ensemble(flight: &Flight, members: usize, threads: usize) -> Result<Ensemble, Error> {
    let all = |_: usize, _: &Simulation| ControlFlow::Continue(());
    let mut whole = ensemble_watched(flight, members, threads, None, all)?;
    match whole.failed.is_empty() {
        true => whole.found().cloned(),
        false => Err(whole.failed.swap_remove(0).error),
    }
}

/// What was flown of an ensemble that was watched. Members count from 1.
#[derive(Debug)]
pub struct WatchedEnsemble {
    /// The ensemble of [`Self::members`]; none of fewer than two with a whole wingbeat.
    pub ensemble: Option<Ensemble>,
    /// The members it is of: those that flew to their end, or, where it was stopped before two did, all with a
    /// whole wingbeat but those that failed, over the wingbeats that each of these has.
    pub members: Vec<usize>,
    /// Members that were stopped on their way, or did not begin.
    pub unfinished: Vec<usize>,
    /// Members that could not go on.
    pub failed: Vec<FailedMember>,
    /// Why members that flew to their end could not be kept.
    pub not_kept: Option<IoError>,
}

/// A member that could not go on.
#[derive(Debug)]
pub struct FailedMember {
    /// Its number, from 1.
    pub member: usize,
    /// The last step it made.
    pub step: usize,
    /// Why.
    pub error: Error,
}

impl WatchedEnsemble {
    /// Whether all members flew to their end.
    pub fn is_complete(&self) -> bool {
        self.unfinished.is_empty() && self.failed.is_empty()
    }

    /// The ensemble.
    ///
    /// # Errors
    /// Fewer than two members with a whole wingbeat.
    pub fn found(&self) -> Result<&Ensemble, Error> {
        self.ensemble.as_ref().ok_or(TOO_FEW)
    }
}

/// Nothing to take a mean of.
const TOO_FEW: Error = Error::Ensemble {
    problem: "an ensemble is of two members or more",
    remedy: "more members",
};

/// Too short for means.
const TOO_SHORT: Error = Error::Ensemble {
    problem: "members are compared by the means of whole wingbeats, and the flight has none",
    remedy: "time.beats of 1 or more",
};

/// No wingbeats.
const BEATLESS: Error = Error::Ensemble {
    problem: "members are compared by the means of wingbeats, and this flight has no wingbeat frequency",
    remedy: "a flyer that beats (motion.frequency_hz), and fly a glider alone (`run`)",
};

/// [`ensemble`] while `watch`, which sees the number of a member, from 1, and its flight at the start and after
/// every step, lets it: once it breaks, flights under way end after their step, and no others begin. What was
/// flown is kept, and a member that cannot go on takes none of the others with it. With a `folder` all who fly to
/// their end are written there, so that the same call flies those only that are missing, whatever ended the one
/// before; once none is missing they are removed.
///
/// ```
/// use std::ops::ControlFlow::{Break, Continue};
/// let flight = wingbeat::Flight::preset("fruit-fly-blade")?.beats(2.0);
/// use wingbeat::flight::Simulation;
/// let three = |member: usize, _: &Simulation| if member < 4 { Continue(()) } else { Break(()) };
/// let found = wingbeat::ensemble_watched(&flight, 5, 1, None, three)?;
/// assert_eq!((found.members, found.unfinished), (vec![1, 2, 3], vec![4, 5]));
/// assert_eq!(found.ensemble.map(|e| e.members), Some(3));
/// # Ok::<(), wingbeat::Error>(())
/// ```
///
/// # Errors
/// Fewer than two members, a flight shorter than a wingbeat, air without a stream, a setup that is refused; with a
/// `folder` as [`Flight::to_case`], and a folder that holds something else or cannot be read; where all members
/// fail, that of the first.
pub fn ensemble_watched(
    flight: &Flight,
    members: usize,
    threads: usize,
    folder: Option<&Path>,
    watch: impl Fn(usize, &Simulation) -> ControlFlow<()> + Sync,
) -> Result<WatchedEnsemble, Error> {
    let flights = members_of(flight, members)?;
    let kept = folder.map(|f| kept_in(flight, members, f)).transpose()?;
    let stopped = AtomicBool::new(false);
    let fly = |k: usize, flight: &Flight| {
        if let Some(beats) = kept.as_ref().map_or(Ok(None), |kept| kept.get(k))? {
            return Ok(Flown::whole(beats));
        }
        if stopped.load(Ordering::Relaxed) {
            return Ok(Flown::default());
        }
        let each = |f: &Simulation| match stopped.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => watch(k + 1, f).map_break(|()| stopped.store(true, Ordering::Relaxed)),
        };
        let failed = |step: usize, error: Error| {
            if is_refused(&error) {
                stopped.store(true, Ordering::Relaxed); // none of the others begins
            }
            let member = k + 1;
            Ok(Flown::failed(FailedMember {
                member,
                step,
                error,
            }))
        };
        let run = match flight.fly_watched(None, each) {
            Ok((run, None)) => run,
            Ok((run, Some(error))) => {
                return failed(run.records.last().map_or(0, |r| r.step), error);
            }
            Err(error) => return failed(0, error),
        };
        let beats = run.summary().beats;
        if run.outcome != Outcome::Finished {
            return Ok(Flown {
                beats,
                ..Flown::default()
            });
        }
        let written = kept.as_ref().map_or(Ok(()), |kept| kept.put(k, &beats));
        Ok(Flown {
            not_kept: written.err(),
            ..Flown::whole(beats)
        })
    };
    let flown = over_threads(&flights, threads, fly)?.into_iter();
    let flown = flown.collect::<Result<Vec<Flown>, Error>>()?;
    let found = of_flown(&flight.setup, flown)?;
    if let Some(kept) = kept.filter(|_| found.is_complete()) {
        kept.forget()?;
    }
    Ok(found)
}

/// How many members an ensemble of this flight has in the `folder` of [`ensemble_watched`] that are not flown again.
///
/// # Errors
/// As [`Flight::to_case`]; a folder that holds something else.
pub fn members_kept(flight: &Flight, members: usize, folder: &Path) -> Result<usize, Error> {
    Ok(kept_in(flight, members, folder)?.known())
}

fn kept_in(flight: &Flight, members: usize, folder: &Path) -> Result<KeptMembers, Error> {
    Ok(KeptMembers::open(folder, &flight.to_case()?, members)?)
}

/// The flights of all members.
fn members_of(flight: &Flight, members: usize) -> Result<Vec<Flight>, Error> {
    let time = &flight.setup.time;
    if members < 2 {
        return Err(TOO_FEW);
    }
    if time.period.is_none() {
        return Err(BEATLESS);
    }
    if time.steps_per_beat().is_none_or(|beat| time.steps < beat) {
        return Err(TOO_SHORT);
    }
    let member = |k| {
        let mut member = flight.clone();
        member.setup = analysis::member(&flight.setup, k, members)?;
        Some(member)
    };
    let flights: Option<Vec<Flight>> = (0..members).map(member).collect();
    flights.ok_or(Error::Ensemble {
        problem: "members differ by a small disturbance of the air in a vortex lattice or blade elements, and this flight has other air",
        remedy: "air.model = \"vortex_lattice\" or \"blade_element\"",
    })
}

/// What a member flew.
#[derive(Default)]
struct Flown {
    /// Whether it flew to its end.
    is_whole: bool,
    beats: Vec<BeatMeans>,
    failed: Option<FailedMember>,
    /// Why it could not be kept.
    not_kept: Option<IoError>,
}

impl Flown {
    /// To its end.
    fn whole(beats: Vec<BeatMeans>) -> Self {
        Self {
            is_whole: true,
            beats,
            ..Self::default()
        }
    }

    /// Of one that failed no wingbeat counts.
    fn failed(member: FailedMember) -> Self {
        Self {
            failed: Some(member),
            ..Self::default()
        }
    }
}

/// Whether no member can begin with a setup that one is refused for.
fn is_refused(error: &Error) -> bool {
    matches!(error, Error::Flight(FlightError::Setup { .. }))
}

/// What was flown of all members.
///
/// # Errors
/// That of the first member, where all have failed or are refused.
fn of_flown(setup: &FlightSetup, mut flown: Vec<Flown>) -> Result<WatchedEnsemble, Error> {
    let mut failed: Vec<FailedMember> = flown.iter_mut().filter_map(|f| f.failed.take()).collect();
    let is_refused = failed.iter().any(|f| is_refused(&f.error));
    if is_refused || !failed.is_empty() && failed.len() == flown.len() {
        return Err(failed.swap_remove(0).error);
    }
    let not_kept = flown.iter_mut().find_map(|f| f.not_kept.take());
    let numbers = |of: &dyn Fn(&Flown) -> bool| -> Vec<usize> {
        (1..=flown.len()).filter(|k| of(&flown[k - 1])).collect()
    };
    let whole = numbers(&|f| f.is_whole);
    let mut unfinished = numbers(&|f| !f.is_whole);
    unfinished.retain(|k| failed.iter().all(|f| f.member != *k));
    let members = match whole.len() >= 2 || unfinished.is_empty() {
        true => whole,
        false => numbers(&|f| !f.beats.is_empty()),
    };
    let beats: Vec<_> = members.iter().map(|k| flown[k - 1].beats.clone()).collect();
    Ok(WatchedEnsemble {
        ensemble: Ensemble::of(&beats, analysis::is_noisy(setup), left_out(setup)),
        members,
        unfinished,
        failed,
        not_kept,
    })
}
