//! Bounds of what trim chooses, and least power where more may be chosen than steady flight determines.
//!
//! The unknowns that are determined follow from the spare ones by a trim; over the spare ones the power of that trim is
//! least, within all bounds. The search is Powell's COBYLA (linear interpolation of cost and constraints), which asks
//! for no slopes.

use std::cell::{Cell, RefCell};
use std::f64::consts::PI;

use cobyla::{RhoBeg, StopTols, minimize};
use wingbeat_flight::FlightSetup;

use crate::AnalysisError;
use crate::power::power_of_trim;
use crate::progress;
use crate::sweep::continuation::{largest_stroke, trim_by_continuation};
use crate::trim::preconditions::check;
use crate::trim::problem::TrimProblem;
use crate::trim::residuals::Residuals;
use crate::trim::solution::TrimSolution;
use crate::trim::unknown::{Bound, Unknown};
use crate::trim::{Trim, trim_from};

/// Trims the flight of `setup` within the bounds of the problem. What is named beyond what steady flight determines is
/// chosen such that the mean power of muscles with perfect elastic storage is least. Where Newton's method finds nothing
/// from the controls of the case, the trim of a slower flight is followed up to the speed asked, and the order of the
/// unknowns does not decide whether a flight is found.
///
/// # Errors
/// As [`trim`] and [`power_of_trim`], at the start of the search; a flight that takes no power.
pub fn trim_within(setup: &FlightSetup, problem: &TrimProblem) -> Result<Trim, AnalysisError> {
    let needed = Residuals::of(problem).controls();
    if problem.unknowns.len() <= needed {
        return trim_by_continuation(setup, problem, PI);
    }
    check(setup, problem)?;
    let (search, start, first) = begun(setup, problem, needed)?;
    if !first.solution.converged {
        return Ok(first);
    }
    let unit = power_of_trim(&first)?.perfect_storage;
    if unit.is_nan() || unit <= 0.0 {
        return Err(AnalysisError::not_covered(
            "this flight takes no power, so there is no least one",
            "name as many unknowns as steady flight determines",
        ));
    }
    let best = search.least(&start, unit);
    let mut found = search.trim(&best)?;
    found.solution.iterations = search.iterations.get();
    found.solution.at_bound = search.at_bound(&found.solution);
    found.solution.in_order_of(&problem.unknowns);
    Ok(found)
}

/// A search from a trim, its spare unknowns there, and the trim: as many unknowns as are `needed` determined, in the
/// order in which they are named; where that finds nothing, one of them exchanged for a spare one. The best point in
/// the order named, where no exchange finds anything.
fn begun<'a>(
    setup: &'a FlightSetup,
    problem: &TrimProblem,
    needed: usize,
) -> Result<(Search<'a>, Vec<f64>, Trim), AnalysisError> {
    let from = |names: &[Unknown]| {
        let (determined, spare) = names.split_at(needed);
        let search = Search::new(setup, problem, determined, spare);
        let start = search.start();
        let first = search.trim(&start)?;
        Ok((search, start, first))
    };
    let named = from(&problem.unknowns)?;
    if named.2.solution.converged {
        return Ok(named);
    }
    for spare in needed..problem.unknowns.len() {
        for determined in (0..needed).rev() {
            let mut names = problem.unknowns.clone();
            names.swap(determined, spare);
            let exchanged: Result<_, AnalysisError> = from(&names);
            if let Ok(found) = exchanged
                && found.2.solution.converged
            {
                return Ok(found);
            }
        }
    }
    Ok(named)
}

/// To what the search determines the spare unknowns \[1, rad\].
const RESOLUTION: f64 = 1e-5;

/// By how much the search is kept inside the bounds of determined unknowns: more than it ends beyond its own limits, less
/// than it resolves \[1, rad\].
const MARGIN: f64 = 2e-6;

/// Cost of a point without a trim, over that of the first.
const LOST: f64 = 10.0;

/// First steps of the search at most \[1, rad\].
const FIRST_STEP: f64 = 0.1;

/// Trims at most.
const TRIMS: usize = 400;

/// What was found at a point.
#[derive(Clone)]
struct Outcome {
    power: f64,
    /// Inside the bounds of the determined unknowns, and the stroke inside half a circle.
    room: Vec<f64>,
}

/// Values of the spare unknowns, and the point of the trim that was found with them.
type Known = (Vec<f64>, Vec<f64>);

/// The search.
struct Search<'a> {
    setup: &'a FlightSetup,
    /// With the determined unknowns alone.
    problem: TrimProblem,
    determined: Vec<Bound>,
    spare: Vec<Bound>,
    known: RefCell<Vec<Known>>,
    last: RefCell<Option<(Vec<f64>, Option<Outcome>)>>,
    /// The point of least power inside all bounds so far, and that power [W].
    best: RefCell<Option<(Vec<f64>, f64)>>,
    trims: Cell<usize>,
    /// Newton's, of all trims.
    iterations: Cell<usize>,
}

impl<'a> Search<'a> {
    fn new(
        setup: &'a FlightSetup,
        problem: &TrimProblem,
        determined: &[Unknown],
        spare: &[Unknown],
    ) -> Self {
        let of = |list: &[Unknown]| list.iter().map(|&u| problem.bound(u)).collect();
        Self {
            setup,
            determined: of(determined),
            spare: of(spare),
            problem: TrimProblem {
                unknowns: determined.to_vec(),
                ..problem.clone()
            },
            known: RefCell::default(),
            last: RefCell::default(),
            best: RefCell::default(),
            trims: Cell::default(),
            iterations: Cell::default(),
        }
    }

    /// The animal as the case has it, within the bounds.
    fn start(&self) -> Vec<f64> {
        let value = |b: &Bound| self.problem.first(b.unknown);
        let inside = self.spare.iter().map(|b| value(b).clamp(b.from, b.to));
        inside.collect()
    }

    /// The unknowns whose bounds ended the search, as far as it resolves that.
    fn at_bound(&self, found: &TrimSolution) -> Vec<Unknown> {
        let bounds = self.spare.iter().chain(&self.determined);
        let is_reached = |b: &&Bound| {
            let within = (3.0 * RESOLUTION).min(0.01 * (b.to - b.from));
            (found.value(b.unknown)).is_some_and(|x| b.is_reached(x, within))
        };
        bounds.filter(is_reached).map(|b| b.unknown).collect()
    }

    /// Values of the spare unknowns with least power over `unit` [W], from `start` on: the best point that is inside all
    /// bounds; where there is none, that at which the search ended.
    fn least(&self, start: &[f64], unit: f64) -> Vec<f64> {
        let cost = |x: &[f64], (): &mut ()| self.at(x).map_or(LOST, |f| f.power / unit);
        let room = |k: usize| {
            move |x: &[f64], (): &mut ()| self.at(x).map_or(-1.0, |f| f.room[k] - MARGIN)
        };
        let constraints: Vec<_> = (0..=self.determined.len()).map(room).collect();
        let ranges: Vec<(f64, f64)> = self.spare.iter().map(|b| (b.from, b.to)).collect();
        let steps = ranges.iter().map(|(a, b)| (0.25 * (b - a)).min(FIRST_STEP));
        let tolerances = StopTols {
            ftol_rel: 1e-7,
            xtol_abs: vec![RESOLUTION; start.len()],
            ..StopTols::default()
        };
        let found = minimize(
            cost,
            start,
            &ranges,
            &constraints,
            (),
            TRIMS,
            RhoBeg::Set(steps.collect()),
            Some(tolerances),
        );
        let (Ok((_, x, _)) | Err((_, x, _))) = found;
        let best = self.best.take();
        best.map_or(x, |(inside, _)| inside)
    }

    /// The trim with the spare unknowns at `x`, from the nearest that is known.
    fn trim(&self, x: &[f64]) -> Result<Trim, AnalysisError> {
        let spare = self.spare.iter().map(|b| b.unknown);
        let problem = TrimProblem {
            given: spare.zip(x.iter().copied()).collect(),
            ..self.problem.clone()
        };
        self.trims.update(|n| n + 1);
        progress::task(&format!("trim {}", self.trims.get()), 0, 0);
        let away = |p: &Known| -> f64 { p.0.iter().zip(x).map(|(a, b)| (a - b) * (a - b)).sum() };
        let nearest = {
            let known = self.known.borrow();
            let nearest = known.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
            nearest.map(|k| k.1.clone())
        };
        let found = match nearest {
            Some(point) => trim_from(self.setup, &problem, point)?,
            None => trim_by_continuation(self.setup, &problem, f64::INFINITY)?,
        };
        self.iterations.update(|n| n + found.solution.iterations);
        if found.solution.converged {
            let known = (x.to_vec(), found.point.clone());
            self.known.borrow_mut().push(known);
        }
        Ok(found)
    }

    /// Cost and constraints at `x`; none without a trim.
    fn at(&self, x: &[f64]) -> Option<Outcome> {
        if let Some((at, outcome)) = &*self.last.borrow()
            && at == x
        {
            return outcome.clone();
        }
        let outcome = self.outcome(x);
        if let Some(found) = &outcome {
            self.keep_best(x, found);
        }
        *self.last.borrow_mut() = Some((x.to_vec(), outcome.clone()));
        outcome
    }

    fn keep_best(&self, x: &[f64], found: &Outcome) {
        let is_inside = found.room.iter().all(|r| *r >= 0.0);
        let mut best = self.best.borrow_mut();
        if is_inside && best.as_ref().is_none_or(|b| found.power < b.1) {
            *best = Some((x.to_vec(), found.power));
        }
    }

    fn outcome(&self, x: &[f64]) -> Option<Outcome> {
        let trim = self.trim(x).ok().filter(|t| t.solution.converged)?;
        let power = power_of_trim(&trim).ok()?.perfect_storage;
        let inside = |b: &Bound| trim.solution.value(b.unknown).map_or(-1.0, |x| b.room(x));
        let mut room: Vec<f64> = self.determined.iter().map(inside).collect();
        room.push(PI - largest_stroke(&trim));
        let finite = power.is_finite() && room.iter().all(|r| r.is_finite());
        finite.then_some(Outcome { power, room })
    }
}
