//! The same flight many times over.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use wingbeat_analysis::ensemble as analysis;
use wingbeat_flight::{FlightSetup, Simulation};
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
/// of the first member that fails.
pub fn ensemble(flight: &Flight, members: usize, threads: usize) -> Result<Ensemble, Error> {
    let whole = ensemble_watched(flight, members, threads, |_, _| ControlFlow::Continue(()))?;
    whole.found().cloned()
}

/// What was flown of an ensemble that was watched. Members count from 1.
#[derive(Clone, Debug)]
pub struct WatchedEnsemble {
    /// The ensemble of [`Self::members`]; none of fewer than two with a whole wingbeat.
    pub ensemble: Option<Ensemble>,
    /// The members it is of: where it was stopped those that flew to their end, or, where fewer than two did,
    /// all with a whole wingbeat, over the wingbeats that each of these has.
    pub members: Vec<usize>,
    /// Members that did not fly to their end.
    pub unfinished: Vec<usize>,
}

impl WatchedEnsemble {
    /// The ensemble.
    ///
    /// # Errors
    /// Fewer than two members with a whole wingbeat.
    pub fn found(&self) -> Result<&Ensemble, Error> {
        self.ensemble.as_ref().ok_or(Error::Ensemble {
            problem: "an ensemble is of two members or more that fly a whole wingbeat",
            remedy: "more members, or time.beats of 1 or more",
        })
    }
}

/// [`ensemble`] while `watch`, which sees the number of a member, from 1, and its flight at the start and after
/// every step, lets it: once it breaks, flights under way end after their step, and no others begin. What was
/// flown is kept.
///
/// ```
/// use std::ops::ControlFlow::{Break, Continue};
/// let flight = wingbeat::Flight::preset("fruit-fly-blade")?.beats(2.0);
/// use wingbeat::flight::Simulation;
/// let three = |member: usize, _: &Simulation| if member < 4 { Continue(()) } else { Break(()) };
/// let found = wingbeat::ensemble_watched(&flight, 5, 1, three)?;
/// assert_eq!((found.members, found.unfinished), (vec![1, 2, 3], vec![4, 5]));
/// assert_eq!(found.ensemble.map(|e| e.members), Some(3));
/// # Ok::<(), wingbeat::Error>(())
/// ```
///
/// # Errors
/// Air without a stream; those of [`Flight::fly`] of the first member that fails.
pub fn ensemble_watched(
    flight: &Flight,
    members: usize,
    threads: usize,
    watch: impl Fn(usize, &Simulation) -> ControlFlow<()> + Sync,
) -> Result<WatchedEnsemble, Error> {
    let flights = members_of(flight, members)?;
    let stopped = AtomicBool::new(false);
    let fly = |k: usize, flight: &Flight| {
        if stopped.load(Ordering::Relaxed) {
            return Ok(Flown::default());
        }
        let each = |f: &Simulation| match stopped.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => watch(k + 1, f).map_break(|()| stopped.store(true, Ordering::Relaxed)),
        };
        let (run, error) = flight.fly_watched(None, each)?;
        error.map_or(Ok(()), Err)?;
        Ok(Flown {
            is_whole: run.outcome == Outcome::Finished,
            beats: run.summary().beats,
        })
    };
    let flown = over_threads(&flights, threads, fly)?.into_iter();
    let flown = flown.collect::<Result<Vec<Flown>, Error>>()?;
    Ok(of_flown(&flight.setup, &flown))
}

/// The flights of all members.
fn members_of(flight: &Flight, members: usize) -> Result<Vec<Flight>, Error> {
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
}

fn of_flown(setup: &FlightSetup, flown: &[Flown]) -> WatchedEnsemble {
    let numbers = |of: &dyn Fn(&Flown) -> bool| -> Vec<usize> {
        (1..=flown.len()).filter(|k| of(&flown[k - 1])).collect()
    };
    let whole = numbers(&|f| f.is_whole);
    let members = match whole.len() >= 2 {
        true => whole,
        false => numbers(&|f| !f.beats.is_empty()),
    };
    let beats: Vec<_> = members.iter().map(|k| flown[k - 1].beats.clone()).collect();
    WatchedEnsemble {
        ensemble: Ensemble::of(&beats, analysis::is_noisy(setup), left_out(setup)),
        members,
        unfinished: numbers(&|f| !f.is_whole),
    }
}
