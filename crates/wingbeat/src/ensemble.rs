//! The same flight many times over.

use wingbeat_flight::Feedback;
use wingbeat_math::DVec3;
use wingbeat_results::summary::{BeatMeans, Ensemble};

use crate::batch::fly_all;
use crate::flown::Run;
use crate::refusal::Error;
use crate::value::Flight;

/// Velocity by which the streams of members differ, over the speed of the wings.
const DIFFERENCE: f64 = 1e-6;

/// Flies `flight` so many times as there are `members`, at least two, over `threads` (0: as many as the machine has): the
/// first as it is, in the others the air moves by a millionth of the wings' speed (length over period, or that of the
/// stream), each in a direction of its own, all in the plane of symmetry where half is computed. What separated flow makes of
/// that is its uncertainty, as soon as the members have parted; until then they are one flight. Where the senses of a
/// controller are noisy, each member has noise of its own (seeds that count on from that of the case), and is a flight of its
/// own from the start. The same bits on any number of threads.
///
/// ```
/// let flight = wingbeat::Flight::preset("fruit-fly-blade")?.beats(2.0);
/// let found = wingbeat::ensemble(&flight, 3, 0)?;
/// assert_eq!((found.members, found.beats.len()), (3, 2));
/// assert!(found.beats[1].spread < 1e-4); // blade elements forget
/// assert_eq!(found.beats[1].lift_newton.standard_error, None); // and members that have not parted are one flight
/// # Ok::<(), wingbeat::Error>(())
/// ```
///
/// # Errors
/// Air without a stream; fewer than two members, or flights without a whole wingbeat; those of [`Flight::fly`] of the first
/// member that fails.
pub fn ensemble(flight: &Flight, members: usize, threads: usize) -> Result<Ensemble, Error> {
    let flights: Option<Vec<Flight>> = (0..members).map(|k| member(flight, k, members)).collect();
    let flights = flights.ok_or(Error::Ensemble {
        problem: "members differ by the stream of the air, and this air has none",
        remedy: "a vortex lattice, or blade elements",
    })?;
    let beats = fly_all(&flights, threads, |run: Run| run.summary().beats)?;
    let beats: Vec<Vec<BeatMeans>> = beats.into_iter().collect::<Result<_, Error>>()?;
    let is_noisy = noisy(flight, 1).is_some();
    Ensemble::of(&beats, is_noisy).ok_or(Error::Ensemble {
        problem: "an ensemble is of two members or more that fly a whole wingbeat",
        remedy: "more members, or time.beats of 1 or more",
    })
}

/// The flight's feedback with the noise of member `k`; none without noise.
fn noisy(flight: &Flight, k: usize) -> Option<Feedback> {
    let feedback = flight.setup.feedback.as_ref()?;
    let controller = feedback.controller.redrawn(k as u64)?;
    Some(Feedback {
        controller,
        ..feedback.clone()
    })
}

/// Member `k`; none where the air has no stream.
fn member(flight: &Flight, k: usize, members: usize) -> Option<Flight> {
    let mut member = flight.clone();
    let setup = &mut member.setup;
    let reports = setup.animal.wing_reports();
    let length = reports.iter().map(|r| r.length).fold(0.0, f64::max);
    let flapping = setup.time.period.map_or(0.0, |p| length / p);
    let is_mirrored = setup.air.is_mirrored();
    if let Some(feedback) = (k > 0).then(|| noisy(flight, k)).flatten() {
        setup.feedback = Some(feedback);
    }
    let stream = setup.air.stream_mut()?;
    if k > 0 {
        let mut along = direction(k, members);
        if is_mirrored {
            along = DVec3::new(along.x, 0.0, along.z)
                .try_normalize()
                .unwrap_or(DVec3::X);
        }
        *stream += DIFFERENCE * flapping.max(stream.length()) * along;
    }
    Some(member)
}

/// Direction `k` of `count` that are spread evenly over the sphere, on a spiral by the golden angle.
fn direction(k: usize, count: usize) -> DVec3 {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let z = 1.0 - 2.0 * (k as f64 + 0.5) / count as f64;
    let (sine, cosine) = (golden * k as f64).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    DVec3::new(r * cosine, r * sine, z)
}
