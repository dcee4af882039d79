//! The same flight many times over.

use wingbeat_analysis::ensemble as analysis;
use wingbeat_results::summary::{BeatMeans, Ensemble, left_out};

use super::batch::fly_all;
use super::error::Error;
use super::flight::Flight;
use super::run::Run;

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
    let member = |k| {
        let mut member = flight.clone();
        member.setup = analysis::member(&flight.setup, k, members)?;
        Some(member)
    };
    let flights: Option<Vec<Flight>> = (0..members).map(member).collect();
    let flights = flights.ok_or(Error::Ensemble {
        problem: "members differ by a small disturbance of the air in a vortex lattice or blade elements, and this flight has other air",
        remedy: "air.model = \"vortex_lattice\" or \"blade_element\"",
    })?;
    let beats = fly_all(&flights, threads, |run: Run| run.summary().beats)?;
    let beats: Vec<Vec<BeatMeans>> = beats.into_iter().collect::<Result<_, Error>>()?;
    Ensemble::of(
        &beats,
        analysis::is_noisy(&flight.setup),
        left_out(&flight.setup),
    )
    .ok_or(Error::Ensemble {
        problem: "an ensemble is of two members or more that fly a whole wingbeat",
        remedy: "more members, or time.beats of 1 or more",
    })
}
