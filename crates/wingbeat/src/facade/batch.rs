//! Many flights over the processor's threads.

use rayon::ThreadPoolBuilder;
use rayon::prelude::*;

use super::error::Error;
use super::flight::Flight;
use super::run::Run;

/// Flies all `flights`, so many at a time as there are `threads` (0: as many as the machine has), and keeps of
/// each run what `keep` makes of it, in the order of the flights. A flight that fails takes none of the others
/// with it. The same bits on any number of threads.
///
/// Ten starts of different pitch, of which the last attitude is kept:
/// ```
/// use wingbeat::prelude::*;
/// let fly = Flight::preset("fruit-fly-blade")?.beats(1.0);
/// let pitched = |k: i32| {
///     let angles = DVec3::new(0.1 * f64::from(k), 0.0, 0.0); // rad
///     fly.clone().start(StartState { angles, ..StartState::default() })
/// };
/// let flights: Vec<Flight> = (0..10).map(pitched).collect();
/// let pitch = |run: Run| run.records.last().map(|r| r.coordinates[3]);
/// let found = wingbeat::fly_all(&flights, 0, pitch)?;
/// let third = flights[3].fly()?.records.last().map(|r| r.coordinates[3]);
/// assert_eq!(found.len(), 10);
/// assert!(matches!(found[3], Ok(pitch) if pitch == third)); // to the bit
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// [`Error::Threads`]; of each flight those of [`Flight::fly`].
pub fn fly_all<T: Send>(
    flights: &[Flight],
    threads: usize,
    keep: impl Fn(Run) -> T + Sync,
) -> Result<Vec<Result<T, Error>>, Error> {
    over_threads(flights, threads, |_, flight| flight.fly().map(&keep))
}

/// What `fly` makes of each of `flights` and its place in the list, in their order, over so many `threads` (0:
/// as many as the machine has).
pub(super) fn over_threads<T: Send>(
    flights: &[Flight],
    threads: usize,
    fly: impl Fn(usize, &Flight) -> T + Sync,
) -> Result<Vec<T>, Error> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
    // One by one: some flights are longer than others.
    let all = flights.par_iter().with_max_len(1).enumerate();
    Ok(pool.install(|| all.map(|(k, flight)| fly(k, flight)).collect()))
}
