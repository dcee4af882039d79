//! Trim by flights.

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::{
    AirModel, FlightSetup, MotionMode, Past, PrescribedMotion, Record, StartState,
};
use wingbeat_math::{DVec3, larger};

use super::free_beat::{free_beat, start, steps_per_beat};
use super::orbit::{check_alike, check_orbit, has_orbit, periodic_beat};
use super::sway::sway;
use super::tow::{Tow, steps_of_glide};
use crate::AnalysisError;
use crate::beat::glide::glides;
use crate::beat::steadied;
use crate::progress;
use crate::trim::glide::Glide;
use crate::trim::preconditions::{AT_START, check_determined, check_symmetric};
use crate::trim::problem::{TrimProblem, first_unknowns};
use crate::trim::residuals::{FlyerMotion, Measures, Residuals};
use crate::trim::root::{Map, Search, matrix_of, moved};
use crate::trim::solution::TrimSolution;
use crate::trim::unknown::UnknownKind;

/// How the flights are flown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WakeSettings {
    /// Wingbeats during which the body is held; of a glider the times of [`period_of_glide`](crate::period_of_glide) of
    /// the first tow, which is doubled until the start of the wake is hardly felt.
    pub held_beats: usize,
    /// Largest residual that counts as trimmed \[1\]. Where wakes meet wings or leave leading edges, the map of a
    /// beat is rough, at some 1e-4 in coarse lattices and 1e-3 in fine ones: smaller ones are not to be had there.
    pub tolerance: f64,
    /// Most quasi-Newton steps.
    pub iterations: usize,
}

/// Trims within less than this are asked of smooth maps: small steps show their slopes \[1\].
const SMOOTH: f64 = 1e-5;

impl Default for WakeSettings {
    fn default() -> Self {
        Self {
            held_beats: 2,
            tolerance: 2e-3,
            iterations: 40,
        }
    }
}

impl WakeSettings {
    /// Those for a setup unless told otherwise: where no wake meets wings or leaves leading edges, maps are smooth.
    pub fn of(setup: &FlightSetup) -> Self {
        let usual = Self::default();
        Self {
            tolerance: match setup.air.keeps_wake() {
                true if glides(setup) => 1e-5,
                true => usual.tolerance,
                false => 1e-6,
            },
            ..usual
        }
    }
}

/// A trimmed flight in air with memory, or the best point found.
#[derive(Clone, Debug)]
pub struct WakeTrim {
    /// The controls found, and the residuals.
    pub solution: TrimSolution,
    /// Flights flown.
    pub flights: usize,
    /// Mean velocity that was asked for, or found where it is unknown, N components [m/s].
    pub velocity: DVec3,
    /// Elastic wings and wakes of strips at the start of the periodic beat, where the air has no wakes in
    /// space; else empty.
    pub past: Past,
    /// Motion of the body over that beat, whose means are velocity and attitude; where [`Self::past`] is empty, none.
    pub orbit: Option<PrescribedMotion>,
    /// Wingbeats flown.
    pub beats: usize,
    /// How rough the map of a wingbeat is at the best point, where a flight in air with wakes was not trimmed: the largest
    /// change of a residual by changes of the unknowns of 0.001, but for what is linear in them \[1\]. Smaller residuals are
    /// found by chance alone. None where it was not measured.
    pub roughness: Option<f64>,
    /// How a glider was towed through air that keeps wakes; of others none.
    pub tow: Option<Tow>,
    /// The adjusted flight: held, released, one free wingbeat; with [`Self::past`] the free wingbeat alone.
    pub setup: FlightSetup,
}

impl WakeTrim {
    /// Whether the whole orbit is periodic: body, elastic wings, wakes of strips.
    pub fn is_orbit(&self) -> bool {
        !self.past.is_empty()
    }

    /// How it starts.
    pub fn start(&self) -> &StartState {
        start(&self.setup)
    }

    /// The glide, where nothing of the flyer beats.
    pub fn glide(&self) -> Option<Glide> {
        let setup = &self.setup;
        let through = self.velocity - setup.air.stream().unwrap_or(DVec3::ZERO);
        glides(setup).then(|| Glide::of(setup.animal.mass(), through, setup.gravity))
    }
}

/// Trims the flight of `setup` in air with memory, or with elastic wings: where the air has no wakes in space,
/// as a periodic orbit of body, wings and wakes of strips. A flyer in which nothing beats is towed until its glide is
/// steady.
///
/// # Errors
/// As [`check_trim_with_wake`]; a first flight that fails. A trim that does not converge is no error: see
/// [`TrimSolution::converged`].
pub fn trim_with_wake(
    setup: &FlightSetup,
    problem: &TrimProblem,
    settings: &WakeSettings,
) -> Result<WakeTrim, AnalysisError> {
    check_trim_with_wake(setup, problem)?;
    let is_glide = glides(setup);
    let residuals = Residuals::of(problem);
    let has_orbit = has_orbit(setup);
    let mut setup = setup.clone();
    if is_glide {
        setup.time.period = Some(steps_of_glide(&setup) as f64 * setup.time.step);
    }
    if has_orbit {
        setup = steadied(&setup);
    }
    if let (AirModel::VortexLattice(air), Residuals::All) = (&mut setup.air, residuals) {
        air.mirror = false; // right and left part
    }
    let mut flights = Flights {
        setup: &setup,
        problem,
        residuals,
        settings,
        steps: steps_per_beat(&setup)?,
        has_orbit,
        is_glide,
        held_beats: match has_orbit {
            true => 0, // its wakes are there from its start
            false => settings.held_beats,
        },
        past: None,
        newest: None,
        flights: 0,
        beats: 0,
        best: f64::INFINITY,
    };
    match is_glide {
        true => flights.run_glide(),
        false => flights.run(),
    }
}

/// What keeps a flight from being trimmed by [`trim_with_wake`] and shows before one is flown, which takes its time.
///
/// # Errors
/// As [`check_alike`]; a wingbeat that is not a whole number of steps; a steady turn, which a body that is held
/// cannot fly; joints that move freely beside elastic wings or wakes of strips; unknowns that the problem does not
/// determine, or too few.
pub fn check_trim_with_wake(
    setup: &FlightSetup,
    problem: &TrimProblem,
) -> Result<(), AnalysisError> {
    check_alike(setup)?;
    check_determined(setup, problem)?;
    if problem.turn_rate != 0.0 {
        return Err(AnalysisError::not_covered(
            "with a memory of wakes or elastic wings flight is trimmed straight, and a steady turn was asked for",
            "trim the turn in blade elements (air.model = \"blade_element\", no air.blade.unsteady) with rigid wings",
        ));
    }
    if has_orbit(setup) {
        check_orbit(setup)?;
    }
    if glides(setup) {
        return Ok(());
    }
    check_speeds(problem)?;
    steps_per_beat(setup).map(drop)
}

/// An error if a speed is unknown: the body is held at the speed asked while its wake grows.
fn check_speeds(problem: &TrimProblem) -> Result<(), AnalysisError> {
    let mut all = problem.unknowns.iter();
    match all.find(|u| u.kind() == UnknownKind::Speed) {
        None => Ok(()),
        Some(unknown) => Err(AnalysisError::not_covered(
            format!(
                "the speed `{}` is no unknown where wakes or elastic wings have a memory",
                unknown.name()
            ),
            "give it (--forward, --climb) and choose another unknown, or trim rigid wings in blade elements",
        )),
    }
}

/// Right and left of a wingbeat after a hold part by less than this where wakes are chaotic, and where there
/// are none \[1\].
const ROUNDING: [f64; 2] = [1e-2, 1e-5];

/// What to fly, and how often it was.
pub(super) struct Flights<'a> {
    pub(super) setup: &'a FlightSetup,
    pub(super) problem: &'a TrimProblem,
    pub(super) residuals: Residuals,
    pub(super) settings: &'a WakeSettings,
    pub(super) steps: usize,
    /// Whether a periodic orbit is sought, and its wings and wakes at the point flown last.
    pub(super) has_orbit: bool,
    pub(super) past: Option<Past>,
    /// Whether nothing beats.
    pub(super) is_glide: bool,
    /// Wingbeats during which the body is held.
    pub(super) held_beats: usize,
    /// The glide flown last, and the point at which it was.
    pub(super) newest: Option<(Vec<f64>, WakeTrim)>,
    pub(super) flights: usize,
    pub(super) beats: usize,
    /// Smallest of the largest residuals so far.
    pub(super) best: f64,
}

impl Flights<'_> {
    /// Wing length [m] and period [s] of the case, by which points are scaled.
    pub(super) fn scales(&self) -> (f64, f64) {
        let length = self.setup.animal.wing_length();
        (length, self.setup.time.period.unwrap_or(1.0))
    }

    /// Quasi-Newton steps until the residuals are within the tolerance, or nothing helps.
    fn run(&mut self) -> Result<WakeTrim, AnalysisError> {
        let search = Search {
            tolerance: self.settings.tolerance,
            iterations: self.settings.iterations,
            updates: true,
            reach: 0.3, // radians, relative changes, R f
            shortening: (0.4, 6),
        };
        let start = self.start();
        let (x, iterations) = search.from(self, start)?;
        let mut found = self.fly(&x)?;
        let rounding = self.rounding();
        found
            .solution
            .conclude(iterations, self.settings.tolerance, rounding)?;
        if !found.solution.converged && !self.has_orbit {
            found.roughness = self.roughness(&x, &found.solution.residual);
            (found.flights, found.beats) = (self.flights, self.beats);
        }
        Ok(found)
    }

    /// Half of the second difference of the residuals `r` about the point `x`, over small steps of all unknowns that were
    /// chosen; none where a flight beside it fails.
    fn roughness(&mut self, x: &[f64], r: &[f64]) -> Option<f64> {
        const STEP: f64 = 1e-3;
        let first = self.residuals.controls();
        let mut beside = |s: f64| {
            let mut x = x.to_vec();
            x[first..].iter_mut().for_each(|x| *x += s);
            self.residual(&x).ok()
        };
        let (plus, minus) = (beside(STEP)?, beside(-STEP)?);
        let sides = plus.iter().zip(&minus).zip(r);
        let parts = sides.map(|((p, m), r)| (0.5 * (p + m) - r).abs());
        Some(parts.fold(0.0, larger))
    }

    /// By how much right and left part by rounding at the end \[1\].
    pub(super) fn rounding(&self) -> f64 {
        ROUNDING[usize::from(self.has_orbit)]
    }

    /// The point at which the search begins.
    pub(super) fn start(&self) -> Vec<f64> {
        let problem = self.problem;
        let (length, period) = self.scales();
        let (v, w) = match &self.setup.mode {
            // A case that was trimmed before: its motion at the release.
            MotionMode::Free(s) if s.held_steps > 0 => {
                let root = s.released(s.held_steps as f64 * self.setup.time.step);
                (root.v, root.w)
            }
            _ => (problem.velocity, DVec3::ZERO),
        };
        let mut x = match self.is_glide {
            true => vec![],
            false => self.residuals.point(v * period / length, w * period),
        };
        x.extend(first_unknowns(self.setup, problem));
        x
    }

    /// Numbers of a point that are the motion at the release: none of a glide, which moves as it is asked to.
    fn motions(&self) -> usize {
        match self.is_glide {
            true => 0,
            false => self.residuals.controls(),
        }
    }

    /// The flight at the point (velocity over R f, angular velocity times T, controls).
    pub(super) fn fly(&mut self, x: &[f64]) -> Result<WakeTrim, AnalysisError> {
        if let Some((_, newest)) = self.newest.as_ref().filter(|(at, _)| at == x) {
            return Ok(newest.clone());
        }
        self.flights += 1;
        let best = match self.best.is_finite() {
            true => format!(", residual {:.1e}", self.best),
            false => String::new(), // the first
        };
        progress::task(&format!("flight {}{best}", self.flights), 0, 0);
        let problem = self.problem;
        let chosen = problem.values(self.setup, &x[self.motions()..]);
        let (mut solution, setup) = TrimSolution::at(self.setup, problem, &chosen);
        if self.is_glide {
            return self.glide(x, solution, setup);
        }
        let (period, angles) = (period(&setup), [solution.body_pitch, solution.body_roll]);
        let setup = self.timed(setup, period, self.start_at(x, angles));
        let (ends, past, roots) = self.beat(&setup)?;
        (solution.residual, solution.lateral) = self.residuals_between(&setup, period, &ends);
        self.best = self.best.min(solution.error());
        Ok(WakeTrim {
            solution,
            flights: self.flights,
            velocity: problem.velocity,
            past,
            orbit: self.has_orbit.then(|| sway(&roots, 1.0 / period)),
            beats: self.beats,
            roughness: None,
            tow: None,
            setup,
        })
    }

    /// How the body starts at the point `x`, with these angles \[rad\]: as it is released.
    fn start_at(&self, x: &[f64], [pitch, roll]: [f64; 2]) -> StartState {
        let (length, period) = self.scales();
        let [velocity, rate] = self.residuals.motion(x);
        StartState {
            position: DVec3::ZERO,
            angles: DVec3::new(pitch, 0.0, roll),
            velocity: velocity * length / period,
            angular_velocity: rate / period,
            held_steps: self.held_beats * self.steps,
            held_motion: None,
        }
    }

    /// The adjusted flight over the beats that are held and a free one, of this period [s].
    pub(super) fn timed(
        &self,
        mut setup: FlightSetup,
        period: f64,
        start: StartState,
    ) -> FlightSetup {
        setup.time.step = period / self.steps as f64;
        setup.time.period = Some(period);
        setup.time.steps = (self.held_beats + 1) * self.steps;
        setup.mode = MotionMode::Free(start);
        setup
    }

    /// What is not periodic between the ends of the free beat, and how far right and left part (see
    /// [`Residuals::between`]).
    fn residuals_between(
        &self,
        setup: &FlightSetup,
        period: f64,
        ends: &[Record; 2],
    ) -> (Vec<f64>, f64) {
        let size = Measures {
            length: self.scales().0,
            period,
            weight: setup.animal.mass() * setup.gravity.length(),
        };
        let seen = ends.each_ref().map(|r| FlyerMotion {
            centre: r.mass_centre,
            momentum: r.momentum,
            spin: spin(r),
            rotation: r.root_rotation(),
        });
        self.residuals.between(self.problem, &size, &seen)
    }

    /// The free beat of `setup`: its ends; of a periodic orbit elastic wings and wakes at its start, and the
    /// motion of the root.
    fn beat(
        &mut self,
        setup: &FlightSetup,
    ) -> Result<([Record; 2], Past, Vec<BodyMotion>), AnalysisError> {
        if !self.has_orbit {
            self.beats += self.held_beats + 1;
            let ends = free_beat(setup, self.steps, None)?;
            return Ok((ends, Past::default(), vec![]));
        }
        let found = periodic_beat(
            setup,
            self.steps,
            self.past.clone(),
            self.settings.tolerance,
        )?;
        let [at_start, at_end] = found.pasts;
        self.past = Some(at_end);
        self.beats += found.beats;
        Ok((found.ends, at_start, found.roots))
    }
}

impl Map for Flights<'_> {
    fn residual(&mut self, x: &[f64]) -> Result<Vec<f64>, AnalysisError> {
        let found = self.fly(x)?;
        if self.flights == 1 {
            check_symmetric(found.solution.lateral, AT_START * self.rounding())?;
        }
        Ok(found.solution.residual)
    }

    fn confine(&self, x: &mut [f64]) {
        let motions = self.motions();
        self.problem.confine(self.setup, &mut x[motions..]);
    }

    /// By one-sided differences, over steps beside which the roughness of the map is small.
    fn slopes(&mut self, x: &[f64], r: &[f64]) -> Result<Vec<f64>, AnalysisError> {
        let step = match () {
            () if self.is_glide => 1e-3,
            () if self.settings.tolerance < SMOOTH => 1e-4,
            () => 2e-2,
        };
        matrix_of(x.len(), |k| {
            let at = self.residual(&moved(x, k, step))?;
            Ok(at.iter().zip(r).map(|(at, r)| (at - r) / step).collect())
        })
    }
}

/// Period of the first wing [s].
fn period(setup: &FlightSetup) -> f64 {
    let first = setup.animal.wings.first();
    1.0 / first.map_or(0.0, |w| w.motion.frequency)
}

/// Angular momentum about the mass centre, N components.
fn spin(r: &Record) -> DVec3 {
    r.angular_momentum - r.mass_centre.cross(r.momentum)
}
