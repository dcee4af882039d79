//! Trim over a range of velocities: power and strokes against speed.
//!
//! Each trim begins at the point of the one before, extrapolated (natural continuation). Where Newton's method
//! does not arrive, the way there is halved, a few times; where it does not arrive then, the range ends. The first
//! is sought from the controls of the case, then by way of slower flights; where it is not found, the next is the
//! first.

use std::f64::consts::PI;

use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use crate::AnalysisError;
use crate::plausibility::stroke_amplitude;
use crate::power::{Power, power_of_trim};
use crate::problem::TrimProblem;
use crate::progress;
use crate::trim::{Trim, trim, trim_from};
use crate::unknown::Unknown;

/// A trimmed flight of a sweep.
#[derive(Clone, Debug)]
pub struct Swept {
    /// Mean velocity, N components [m/s].
    pub velocity: DVec3,
    /// How it flies.
    pub trim: Trim,
    /// What it costs over the free wingbeat.
    pub power: Power,
    /// Stroke angle of the first wing from end to end \[rad\]; 0 where it does not flap by itself.
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
}

/// Why a velocity was not reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lost {
    /// No point there has residuals within the tolerance; the largest of the best, if one was finite.
    NotTrimmed(Option<f64>),
    /// This unknown would lie outside the bounds of the problem.
    Bound(Unknown),
    /// The first wing would stroke over more than half a circle \[rad\]: right and left wings pass through each other.
    Stroke(f64),
}

impl Sweep {
    /// The flight for which `cost` is least.
    fn least(&self, cost: impl Fn(&Swept) -> f64) -> Option<&Swept> {
        let finite = self.flights.iter().filter(|f| cost(f).is_finite());
        finite.min_by(|a, b| cost(a).total_cmp(&cost(b)))
    }

    /// The flight of least power (muscles, perfect elastic storage).
    pub fn least_power(&self) -> Option<&Swept> {
        self.least(muscle_power)
    }

    /// The flight of least work per distance (muscles, perfect elastic storage); none in hover alone.
    pub fn least_work(&self) -> Option<&Swept> {
        self.least(work_per_distance)
    }

    /// Speed forward (along n1) of least power, between the flights: that of the parabola through the least and its
    /// neighbours [m/s]; none at an end.
    pub fn least_power_forward(&self) -> Option<f64> {
        self.vertex(muscle_power)
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

/// Mean power of muscles with perfect elastic storage [W].
fn muscle_power(f: &Swept) -> f64 {
    f.power.perfect_storage
}

/// The same over the speed [N]; infinite in hover.
fn work_per_distance(f: &Swept) -> f64 {
    match f.velocity.length() {
        v if v > 0.0 => f.power.perfect_storage / v,
        _ => f64::INFINITY,
    }
}

/// Halvings of the way to a velocity.
const HALVINGS: usize = 4;

/// Trims at each of the `velocities` [m/s], N components, in their order.
///
/// # Errors
/// As [`trim`], for the first of them; as [`power`].
pub fn sweep(
    setup: &FlightSetup,
    problem: &TrimProblem,
    velocities: &[DVec3],
) -> Result<Sweep, AnalysisError> {
    let mut path = Path::new(setup, problem);
    let mut found = Sweep::default();
    for (k, &velocity) in velocities.iter().enumerate() {
        progress::task("sweep", k, velocities.len());
        match flight_at(&mut path, velocity)? {
            Ok(flight) => found.flights.push(flight),
            Err(why) if found.flights.is_empty() => found.missed.push((velocity, why)),
            Err(why) => {
                found.lost = Some((velocity, why));
                break;
            }
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
    let stroke_amplitude = first_stroke(&trim);
    if stroke_amplitude > PI {
        return Ok(Err(Lost::Stroke(stroke_amplitude)));
    }
    if let Some(&unknown) = trim.solution.outside.first() {
        return Ok(Err(Lost::Bound(unknown)));
    }
    let power = power_of_trim(&trim)?;
    Ok(Ok(Swept {
        velocity,
        stroke_amplitude,
        trim,
        power,
    }))
}

/// Stroke angle of the first wing from end to end \[rad\]; 0 without wings.
fn first_stroke(trim: &Trim) -> f64 {
    let wing = trim.setup.animal.wings.first();
    wing.map_or(0.0, stroke_amplitude)
}

/// Parts of a velocity from which the way to it begins where it is not trimmed from the controls of the case, the
/// nearest first \[1\].
const SLOWER: [f64; 4] = [0.75, 0.5, 0.25, 0.0];

/// The trim of `problem` from the controls of the case; where that finds nothing, by way of the fastest of some slower
/// flights that it finds, unless the first wing strokes over more than half a circle there.
///
/// # Errors
/// As [`trim`].
pub(crate) fn trim_by_way(
    setup: &FlightSetup,
    problem: &TrimProblem,
) -> Result<Trim, AnalysisError> {
    let direct = trim(setup, problem)?;
    if direct.solution.converged || problem.velocity == DVec3::ZERO {
        return Ok(direct);
    }
    for part in SLOWER {
        let slower = part * problem.velocity;
        let what = format!("by way of {:.3} m/s", slower.length());
        progress::task(&what, 0, 0);
        let mut path = Path::new(setup, problem);
        let first = trim(setup, &path.at(slower)).ok();
        let Some(first) = first.filter(|t| t.solution.converged) else {
            continue;
        };
        path.points.push((slower, first.point));
        let found = path.reach(problem.velocity)?.ok();
        return Ok(found.filter(|t| first_stroke(t) <= PI).unwrap_or(direct));
    }
    Ok(direct)
}

/// The points found so far.
struct Path<'a> {
    setup: &'a FlightSetup,
    problem: &'a TrimProblem,
    points: Vec<(DVec3, Vec<f64>)>,
}

impl<'a> Path<'a> {
    /// A path without points.
    fn new(setup: &'a FlightSetup, problem: &'a TrimProblem) -> Self {
        Self {
            setup,
            problem,
            points: vec![],
        }
    }

    /// The trim at a velocity, or the residual of what was found instead.
    fn reach(&mut self, velocity: DVec3) -> Result<Result<Trim, Option<f64>>, AnalysisError> {
        let Some(from) = self.points.last().map(|p| p.0) else {
            return self.first(velocity).map(arrived);
        };
        // Parts of the way that lie ahead, the nearest last.
        let mut ahead = vec![velocity];
        let mut at = from;
        let mut residual = None;
        while let Some(&next) = ahead.last() {
            match self.try_at(next) {
                Ok(trim) if trim.solution.converged => {
                    at = next;
                    ahead.pop();
                    if ahead.is_empty() {
                        return Ok(Ok(trim));
                    }
                }
                other => {
                    residual = other.ok().map(|t| t.solution.error()).or(residual);
                    if ahead.len() > HALVINGS {
                        break;
                    }
                    ahead.push(at.midpoint(next));
                }
            }
        }
        Ok(Err(residual))
    }

    fn first(&mut self, velocity: DVec3) -> Result<Trim, AnalysisError> {
        let found = trim_by_way(self.setup, &self.at(velocity))?;
        if found.solution.converged {
            self.points.push((velocity, found.point.clone()));
        }
        Ok(found)
    }

    fn at(&self, velocity: DVec3) -> TrimProblem {
        TrimProblem {
            velocity,
            ..self.problem.clone()
        }
    }

    /// Trims at a velocity from the points found, extrapolated along the way.
    fn try_at(&mut self, velocity: DVec3) -> Result<Trim, AnalysisError> {
        let guess = match self.points.as_slice() {
            [.., (v0, x0), (v1, x1)] => {
                let way = (*v1 - *v0).length();
                let share = if way > 0.0 {
                    (velocity - *v1).length() / way
                } else {
                    0.0
                };
                let along = |(a, b): (&f64, &f64)| b + share.min(2.0) * (b - a);
                x0.iter().zip(x1).map(along).collect()
            }
            [.., (_, x)] => x.clone(),
            [] => return self.first(velocity),
        };
        let found = trim_from(self.setup, &self.at(velocity), guess)?;
        if found.solution.converged {
            self.points.push((velocity, found.point.clone()));
        }
        Ok(found)
    }
}

fn arrived(trim: Trim) -> Result<Trim, Option<f64>> {
    match trim.solution.converged {
        true => Ok(trim),
        false => Err(Some(trim.solution.error())),
    }
}
