//! Trim over a range of velocities: power and strokes against speed.
//!
//! Each trim begins at the point of the one before, extrapolated (natural continuation). Where Newton's method
//! does not arrive, the way there is halved, a few times; where it does not arrive then, the range ends. The first
//! is sought from the controls of the case, then by way of slower flights; where it is not found, the next is the
//! first. A range that falls in speed through the air is trimmed from its slow end, so it has the flights of the range
//! that rises.

pub(crate) mod continuation;
pub(crate) mod least_power;

use std::f64::consts::PI;
use std::ops::ControlFlow;

use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use crate::AnalysisError;
use crate::power::{Power, power_of_trim};
use crate::progress;
use crate::sweep::continuation::{Path, largest_stroke};
use crate::trim::Trim;
use crate::trim::glide::Glide;
use crate::trim::lost::Lost;
use crate::trim::problem::TrimProblem;
use crate::trim::unknown::Unknown;

/// A trimmed flight of a sweep.
#[derive(Clone, Debug)]
pub struct Swept {
    /// Mean velocity, N components [m/s].
    pub velocity: DVec3,
    /// How it flies.
    pub trim: Trim,
    /// What it costs over the free wingbeat.
    pub power: Power,
    /// The glide, where nothing beats.
    pub glide: Option<Glide>,
    /// Largest stroke angle of all wings from end to end \[rad\]; 0 where none flaps by itself.
    pub stroke_amplitude: f64,
}

/// A sweep: the flights found, in order.
#[derive(Clone, Debug, Default)]
pub struct Sweep {
    /// One for each velocity that was reached.
    pub flights: Vec<Swept>,
    /// The velocities before the first that was reached, N components [m/s], and why they were not; all, where none
    /// was.
    pub missed: Vec<(DVec3, Lost)>,
    /// The first velocity after those reached that was not, N components [m/s], and why.
    pub lost: Option<(DVec3, Lost)>,
    /// The velocities that were left when [`sweep_watched`] was stopped, N components [m/s], in the order asked.
    pub untried: Vec<DVec3>,
}

impl Sweep {
    /// The flight for which `cost` is least.
    fn least(&self, cost: impl Fn(&Swept) -> f64) -> Option<&Swept> {
        let finite = self.flights.iter().filter(|f| cost(f).is_finite());
        finite.min_by(|a, b| cost(a).total_cmp(&cost(b)))
    }

    /// The flight of least power (actuators, perfect elastic storage).
    pub fn least_power(&self) -> Option<&Swept> {
        self.least(actuator_power)
    }

    /// The flight of least work per distance (actuators, perfect elastic storage); none in hover alone.
    pub fn least_work(&self) -> Option<&Swept> {
        self.least(work_per_distance)
    }

    /// The glide of least sink; none of flyers that beat.
    pub fn least_sink(&self) -> Option<&Swept> {
        self.least(|f| f.glide.map_or(f64::INFINITY, |g| g.power))
    }

    /// The flattest glide; none of flyers that beat.
    pub fn flattest(&self) -> Option<&Swept> {
        self.least(|f| f.glide.map_or(f64::INFINITY, |g| g.angle))
    }

    /// Speed forward (along n1) of least power, between the flights: that of the parabola through the least and its
    /// neighbours [m/s]; none at an end.
    pub fn least_power_forward(&self) -> Option<f64> {
        self.vertex(actuator_power)
    }

    /// The same of least work per distance [m/s].
    pub fn least_work_forward(&self) -> Option<f64> {
        self.vertex(work_per_distance)
    }

    /// Where the parabola through the flight of least `cost` and its two neighbours is least.
    fn vertex(&self, cost: impl Fn(&Swept) -> f64) -> Option<f64> {
        let costs: Vec<f64> = self.flights.iter().map(cost).collect();
        let least = (0..costs.len()).min_by(|&i, &j| costs[i].total_cmp(&costs[j]))?;
        let before = least.checked_sub(1)?;
        let [a, b, c] = self.flights.get(before..before + 3)? else {
            return None;
        };
        let [a, b, c] = [a, b, c].map(|f| f.velocity.x);
        let [fa, fb, fc] = [costs[before], costs[least], costs[least + 1]];
        let (left, right) = ((b - a) * (fb - fc), (b - c) * (fb - fa));
        let at = b - 0.5 * ((b - a) * left - (b - c) * right) / (left - right);
        at.is_finite().then_some(at)
    }
}

/// Mean power of actuators with perfect elastic storage [W].
fn actuator_power(f: &Swept) -> f64 {
    f.power.perfect_storage
}

/// The same over the speed [N]; infinite in hover.
fn work_per_distance(f: &Swept) -> f64 {
    match f.velocity.length() {
        v if v > 0.0 => f.power.perfect_storage / v,
        _ => f64::INFINITY,
    }
}

/// Trims at each of the `velocities` [m/s], N components, in their order; where all lie on a line along which the speed
/// through the air is less at the end than at the beginning, from the end on. The flights stand in the order asked.
///
/// # Errors
/// As [`trim`](crate::trim()), for the first of them; as [`power`](crate::power()).
pub fn sweep(
    setup: &FlightSetup,
    problem: &TrimProblem,
    velocities: &[DVec3],
) -> Result<Sweep, AnalysisError> {
    sweep_watched(setup, problem, velocities, |_, _| ControlFlow::Continue(()))
}

/// The same, `watch`ed: it hears of each velocity [m/s], N components, as soon as that is trimmed, or why it was not, and
/// may stop there: what was found so far is the sweep, and the rest are [`Sweep::untried`].
///
/// # Errors
/// As [`sweep`].
pub fn sweep_watched(
    setup: &FlightSetup,
    problem: &TrimProblem,
    velocities: &[DVec3],
    watch: impl FnMut(DVec3, Option<Lost>) -> ControlFlow<()>,
) -> Result<Sweep, AnalysisError> {
    if problem.unknowns.contains(&Unknown::Forward) {
        return Err(AnalysisError::not_covered(
            "a sweep gives the speed forward, and `forward` is among the unknowns",
            "leave it out; `climb` may be one",
        ));
    }
    if !is_falling(setup, velocities) {
        return rising(setup, problem, velocities, watch);
    }
    let upwards: Vec<DVec3> = velocities.iter().rev().copied().collect();
    let found = rising(setup, problem, &upwards, watch)?;
    Ok(turned(found, velocities))
}

/// Whether velocities lead one way, to a lower speed through the air.
fn is_falling(setup: &FlightSetup, velocities: &[DVec3]) -> bool {
    let stream = setup.air.stream().unwrap_or(DVec3::ZERO);
    let airspeed = |v: &DVec3| (*v - stream).length();
    let (Some(first), Some(last)) = (velocities.first(), velocities.last()) else {
        return false;
    };
    let way = *last - *first;
    let is_onward = |pair: &[DVec3]| (pair[1] - pair[0]).dot(way) > 0.0;
    airspeed(last) < airspeed(first) && velocities.windows(2).all(is_onward)
}

/// What was found over velocities from their last to their first, in their order.
fn turned(found: Sweep, velocities: &[DVec3]) -> Sweep {
    let Sweep {
        mut flights,
        missed: mut slow,
        lost: fast,
        mut untried,
    } = found;
    flights.reverse();
    slow.reverse();
    untried.reverse();
    if flights.is_empty() {
        return Sweep {
            missed: slow,
            untried,
            ..Sweep::default()
        };
    }
    let not_tried = |v: &DVec3| (*v, Lost::Beyond);
    let missed = fast.map_or(vec![], |end| {
        let beyond = velocities.iter().take_while(|v| **v != end.0);
        beyond.map(not_tried).chain([end]).collect()
    });
    Sweep {
        flights,
        missed,
        lost: slow.first().copied(),
        untried,
    }
}

/// The sweep in the order of the velocities.
fn rising(
    setup: &FlightSetup,
    problem: &TrimProblem,
    velocities: &[DVec3],
    mut watch: impl FnMut(DVec3, Option<Lost>) -> ControlFlow<()>,
) -> Result<Sweep, AnalysisError> {
    let mut path = Path::new(setup, problem);
    let mut found = Sweep::default();
    for (k, &velocity) in velocities.iter().enumerate() {
        progress::task("sweep", k, velocities.len());
        let reached = flight_at(&mut path, velocity)?;
        let goes_on = watch(velocity, reached.as_ref().err().copied());
        match reached {
            Ok(flight) => found.flights.push(flight),
            Err(why) if found.flights.is_empty() => {
                found.missed.push((velocity, why));
                path.clear(); // no way leads on from what is no flight
            }
            Err(why) => {
                found.lost = Some((velocity, why));
                break;
            }
        }
        if goes_on.is_break() {
            found.untried = velocities[k + 1..].to_vec();
            break;
        }
    }
    Ok(found)
}

/// The flight at a velocity, or why there is none.
fn flight_at(path: &mut Path, velocity: DVec3) -> Result<Result<Swept, Lost>, AnalysisError> {
    let trim = match path.reach(velocity)? {
        Ok(trim) => trim,
        Err(residual) => return Ok(Err(Lost::NotTrimmed(residual))),
    };
    let stroke_amplitude = largest_stroke(&trim);
    if stroke_amplitude > PI {
        return Ok(Err(Lost::Stroke(stroke_amplitude)));
    }
    if let Some(&unknown) = trim.solution.outside.first() {
        return Ok(Err(Lost::Bound(unknown)));
    }
    let power = power_of_trim(&trim)?;
    Ok(Ok(Swept {
        velocity: trim.velocity,
        glide: trim.glide()?,
        stroke_amplitude,
        trim,
        power,
    }))
}
