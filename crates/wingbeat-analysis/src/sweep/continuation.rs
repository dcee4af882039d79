//! Trims from point to point (natural continuation): by way of slower flights to one that Newton's method does not find
//! from the controls of the case.
//!
//! Slower is by the speed through the air, so the trim is the same from axes that move with the stream (Galilei).

use std::f64::consts::PI;

use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use crate::AnalysisError;
use crate::plausibility::stroke_amplitude;
use crate::progress;
use crate::trim::lost::{Lost, Way};
use crate::trim::problem::TrimProblem;
use crate::trim::{Trim, trim, trim_from};

/// Largest stroke angle of all wings from end to end \[rad\]; 0 without wings.
pub(crate) fn largest_stroke(trim: &Trim) -> f64 {
    let strokes = trim.setup.animal.wings.iter().map(stroke_amplitude);
    strokes.fold(0.0, f64::max)
}

/// Parts of the velocity through the air from which the way to it begins where it is not trimmed from the controls of
/// the case, the nearest first \[1\].
const SLOWER: [f64; 4] = [0.75, 0.5, 0.25, 0.0];

/// Halvings of the way to a velocity.
const HALVINGS: usize = 4;

/// The trim of `problem` from the controls of the case; where that finds nothing, by way of the fastest of some slower
/// flights that it finds, unless a wing strokes over more than `widest` \[rad\] there.
///
/// # Errors
/// As [`trim`].
pub(crate) fn trim_by_continuation(
    setup: &FlightSetup,
    problem: &TrimProblem,
    widest: f64,
) -> Result<Trim, AnalysisError> {
    let mut direct = trim(setup, problem)?;
    let stream = setup.air.stream().unwrap_or(DVec3::ZERO);
    let through = problem.velocity - stream;
    if direct.solution.converged || through == DVec3::ZERO {
        return Ok(direct);
    }
    for part in SLOWER {
        let what = format!("by way of {:.3} m/s", part * through.length());
        progress::task(&what, 0, 0);
        let slower = stream + part * through;
        let mut path = Path::new(setup, problem);
        let first = tried(trim(setup, &path.at(slower)))?;
        let Some(first) = first.filter(|t| t.solution.converged) else {
            continue;
        };
        path.push(&first);
        let ended = match path.reach(problem.velocity)? {
            Ok(found) if largest_stroke(&found) <= widest => return Ok(found),
            Ok(found) => Lost::Stroke(largest_stroke(&found)),
            Err(residual) => Lost::NotTrimmed(residual),
        };
        let last = path.last_within_half_a_circle();
        direct.solution.way = last.map(|v| Way {
            airspeed: (v - stream).length(),
            ended,
        });
        return Ok(direct);
    }
    Ok(direct)
}

/// A trim on the way.
struct Passed {
    /// N components [m/s].
    velocity: DVec3,
    /// As [`Trim::point`].
    point: Vec<f64>,
    /// Largest of all wings, from end to end \[rad\].
    stroke: f64,
}

/// The points found so far.
pub(crate) struct Path<'a> {
    setup: &'a FlightSetup,
    problem: &'a TrimProblem,
    points: Vec<Passed>,
}

impl<'a> Path<'a> {
    /// A path without points.
    pub(crate) fn new(setup: &'a FlightSetup, problem: &'a TrimProblem) -> Self {
        Self {
            setup,
            problem,
            points: vec![],
        }
    }

    /// Forgets the points.
    pub(crate) fn clear(&mut self) {
        self.points.clear();
    }

    /// The trim at a velocity, or the residual of what was found instead.
    pub(crate) fn reach(
        &mut self,
        velocity: DVec3,
    ) -> Result<Result<Trim, Option<f64>>, AnalysisError> {
        let Some(from) = self.points.last().map(|p| p.velocity) else {
            return self.first(velocity).map(arrived);
        };
        // Parts of the way that lie ahead, the nearest last.
        let mut ahead = vec![velocity];
        let mut at = from;
        let mut residual = None;
        while let Some(&next) = ahead.last() {
            match tried(self.try_at(next))? {
                Some(trim) if trim.solution.converged => {
                    at = next;
                    ahead.pop();
                    if ahead.is_empty() {
                        return Ok(Ok(trim));
                    }
                }
                other => {
                    residual = other.map(|t| t.solution.error()).or(residual);
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
        let found = trim_by_continuation(self.setup, &self.at(velocity), PI)?;
        if found.solution.converged {
            self.push(&found);
        }
        Ok(found)
    }

    fn push(&mut self, trim: &Trim) {
        self.points.push(Passed {
            velocity: trim.velocity,
            point: trim.point.clone(),
            stroke: largest_stroke(trim),
        });
    }

    /// Velocity of the last point with strokes of at most half a circle, N components [m/s].
    fn last_within_half_a_circle(&self) -> Option<DVec3> {
        let last = self.points.iter().rfind(|p| p.stroke <= PI);
        last.map(|p| p.velocity)
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
            [.., a, b] => {
                let way = (b.velocity - a.velocity).length();
                let share = if way > 0.0 {
                    (velocity - b.velocity).length() / way
                } else {
                    0.0
                };
                let along = |(a, b): (&f64, &f64)| b + share.min(2.0) * (b - a);
                a.point.iter().zip(&b.point).map(along).collect()
            }
            [only] => only.point.clone(),
            [] => return self.first(velocity),
        };
        let found = trim_from(self.setup, &self.at(velocity), guess)?;
        if found.solution.converged {
            self.push(&found);
        }
        Ok(found)
    }
}

/// A trim that was tried; none of a flight that cannot be flown.
///
/// # Errors
/// What is wrong with any flight.
fn tried(found: Result<Trim, AnalysisError>) -> Result<Option<Trim>, AnalysisError> {
    match found {
        Err(error) if error.is_of_one_flight() => Ok(None),
        found => found.map(Some),
    }
}

fn arrived(trim: Trim) -> Result<Trim, Option<f64>> {
    match trim.solution.converged {
        true => Ok(trim),
        false => Err(Some(trim.solution.error())),
    }
}
