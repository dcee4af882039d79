//! Trim of flyers in which nothing beats, by tows.

use wingbeat_flight::{FlightSetup, PrescribedMotion, Simulation, StartState};
use wingbeat_math::DVec3;

use super::tow::{COARSE, LONG, MAX_PERIODS, Tow, tow_to_rest, tow_with_wake};
use super::trim::{Flights, WakeTrim};
use crate::AnalysisError;
use crate::trim::root::Search;
use crate::trim::solution::TrimSolution;

impl Flights<'_> {
    /// Quasi-Newton steps to a glide, by tows that are doubled until the start of the wake is hardly felt, then the last digits.
    pub(super) fn run_glide(&mut self) -> Result<WakeTrim, AnalysisError> {
        self.check_free()?;
        let (mut x, mut iterations, mut slopes) = (self.start(), 0, None);
        let last = self.settings.tolerance;
        let mut tolerance = if self.has_orbit {
            last
        } else {
            COARSE.max(last)
        };
        loop {
            let search = Search {
                tolerance,
                iterations: self.settings.iterations,
                updates: true,
                reach: 0.5, // radians, wing lengths, speeds over sqrt(g R)
                shortening: (0.4, 6),
            };
            let (found, steps) = search.with_slopes(self, x, &mut slopes)?;
            (x, iterations) = (found, iterations + steps);
            let mut found = self.fly(&x)?;
            let is_near = found.solution.error() <= tolerance;
            let is_short = found.tow.is_some_and(|tow| tow.change > LONG);
            if is_near && is_short && 2 * self.held_beats <= MAX_PERIODS {
                self.held_beats *= 2;
                self.newest = None;
                self.best = f64::INFINITY;
            } else if is_near && tolerance > last {
                tolerance = last;
            } else {
                let rounding = self.rounding();
                found.solution.conclude(iterations, last, rounding)?;
                (found.flights, found.beats) = (self.flights, self.beats);
                return Ok(found);
            }
        }
    }

    /// What a flight of the flyer would refuse that is free, which a tow is not.
    ///
    /// # Errors
    /// As [`Simulation::new`].
    fn check_free(&self) -> Result<(), AnalysisError> {
        let free = self.timed(self.setup.clone(), self.scales().1, StartState::default());
        Ok(Simulation::new(free).map(drop)?)
    }

    /// The glide at the point `x`, of which `solution` lacks the residuals: what a tow of `setup` has to carry.
    pub(super) fn glide(
        &mut self,
        x: &[f64],
        mut solution: TrimSolution,
        setup: FlightSetup,
    ) -> Result<WakeTrim, AnalysisError> {
        let problem = (self.problem).at_speeds(&solution.unknowns, &solution.values);
        let start = StartState {
            velocity: problem.velocity,
            angles: DVec3::new(solution.body_pitch, 0.0, solution.body_roll),
            held_steps: self.held_beats * self.steps,
            ..StartState::default()
        };
        let period = self.scales().1;
        let setup = self.timed(setup, period, start);
        let (towed, beats) = match self.has_orbit {
            true => tow_to_rest(
                &setup,
                self.steps,
                self.past.clone(),
                self.settings.tolerance,
            )?,
            false => (tow_with_wake(&setup)?, self.held_beats),
        };
        self.beats += beats;
        if self.has_orbit {
            self.past = Some(towed.past.clone());
        }
        (solution.residual, solution.lateral) = self.residuals.of_tow(towed.lacks);
        self.best = self.best.min(solution.error());
        let through = problem.velocity - setup.air.stream().unwrap_or(DVec3::ZERO);
        let steps = self.held_beats * self.steps;
        let way = through.length() * steps as f64 * setup.time.step;
        let angles = DVec3::new(solution.body_pitch, 0.0, solution.body_roll);
        let found = WakeTrim {
            solution,
            flights: self.flights,
            velocity: problem.velocity,
            past: towed.past,
            orbit: self
                .has_orbit
                .then(|| PrescribedMotion::straight(DVec3::ZERO, problem.velocity, angles)),
            beats: self.beats,
            roughness: None,
            tow: (!self.has_orbit).then(|| Tow {
                steps,
                chords: way / setup.animal.mean_chord().unwrap_or(1.0),
                change: towed.change,
            }),
            setup,
        };
        self.newest = Some((x.to_vec(), found.clone()));
        Ok(found)
    }
}
