//! Trim: steady flight as a periodic orbit of the full model.
//!
//! Unknowns are the state at the start of a beat and controls of the wings; equations are that one beat later
//! nothing has changed but place and heading, which have moved as asked ([`crate::trim::preconditions`]). Coordinates and
//! speeds of free joints are unknowns too, and come back to where they were. Newton's method with differences
//! for the Jacobian and a line search; a failure keeps the best point found. A search with bounds stays inside;
//! only where it finds nothing there, another one says where beyond them steady flight is.

pub(crate) mod glide;
pub(crate) mod lost;
pub(crate) mod preconditions;
pub(crate) mod problem;
pub(crate) mod request;
pub(crate) mod residuals;
pub(crate) mod root;
pub(crate) mod solution;
pub(crate) mod tail;
pub(crate) mod unknown;

use wingbeat_dynamics::{BodyMotion, MomentumState};
use wingbeat_flight::{
    AirModel, FlightSetup, FormulationChoice, IntegratorChoice, MotionMode, PrescribedMotion,
    StabilizationChoice, StartState, TimeGrid, closes_loop,
};
use wingbeat_math::{DMat3, DVec3, EulerSequence};

use crate::AnalysisError;
use crate::beat::{Beat, JOINTS, State, steadied};
use crate::progress;
use crate::trim::preconditions::{AT_START, check_determined, check_symmetric};
use crate::trim::problem::{TrimProblem, first_unknowns};
use crate::trim::residuals::{FlyerMotion, Measures, Residuals, attitude, turning};
use crate::trim::root::{Map, Search, largest, matrix_of, moved};
use crate::trim::solution::TrimSolution;

/// A trimmed flight, or the best point found.
#[derive(Clone, Debug)]
pub struct Trim {
    /// The controls found, and the residuals.
    pub solution: TrimSolution,
    /// Mean velocity that was asked for, or found where it is unknown, N components [m/s]; in a turn that at the start
    /// of a beat.
    pub velocity: DVec3,
    /// Turn of the heading [rad/s].
    pub turn_rate: f64,
    /// State at the start of the beat, mass centre at the origin.
    pub state: State,
    /// The point that Newton's method found: velocity over R f and angular velocity times T (of symmetric flight
    /// those of its plane), the unknowns that were chosen, speeds over sqrt(g R), then coordinates and speeds of free joints over their natural sizes \[1 or
    /// rad\].
    pub point: Vec<f64>,
    /// The wingbeat of the adjusted animal.
    pub beat: Beat,
    /// The adjusted setup, its wings beating from the first instant at the phases of the trimmed beat (state at
    /// the start and time are those given).
    pub setup: FlightSetup,
}

impl Trim {
    /// The adjusted animal carried in its trimmed attitude with the mean velocity of the trimmed flight, for
    /// two beats of the trim's steps; with free joints, which begin as on the trimmed orbit and find the one of
    /// a body that is held, for many.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn tethered(&self) -> Result<FlightSetup, AnalysisError> {
        let mut setup = self.at_its_start();
        let angles = DVec3::new(self.solution.body_pitch, 0.0, self.solution.body_roll);
        let motion = PrescribedMotion::straight(DVec3::ZERO, self.mean_velocity()?, angles);
        setup.mode = MotionMode::Tethered(motion);
        let beats = if self.beat.joint_sizes().is_empty() {
            2
        } else {
            MAX_HELD_BEATS
        };
        self.in_its_steps(&mut setup, beats);
        Ok(setup)
    }

    /// The adjusted setup with free joints that begin as on the trimmed orbit.
    fn at_its_start(&self) -> FlightSetup {
        let mut setup = self.setup.clone();
        let joints = self.beat.joints(&self.state);
        for joint in &mut setup.joints {
            if let Some((_, q, u)) = joints.iter().find(|j| j.0 == joint.name) {
                joint.model = joint.model.clone().starting(q, u);
            }
        }
        setup
    }

    /// Flies `setup` for `beats` wingbeats in the trim's steps by the trim's method; joints that close loops by
    /// the form that has them.
    fn in_its_steps(&self, setup: &mut FlightSetup, beats: usize) {
        let mut joints = 0..setup.joints.len();
        setup.formulation = match joints.any(|k| closes_loop(&setup.joints, k)) {
            true => FormulationChoice::Quaternion(StabilizationChoice::Projection),
            false => FormulationChoice::Momentum,
        };
        setup.integrator = IntegratorChoice::RungeKutta;
        let steps = self.beat.steps();
        setup.time = TimeGrid {
            step: self.beat.period() / steps as f64,
            steps: beats * steps,
            period: Some(self.beat.period()),
        };
    }

    /// The adjusted animal in free flight from the start of its periodic beat, joints and all, for
    /// one beat of the trim's steps by the trim's method.
    pub fn free(&self) -> FlightSetup {
        let mut setup = self.at_its_start();
        let root = self.beat.root(&self.state);
        setup.mode = MotionMode::Free(StartState {
            position: root.p,
            angles: EulerSequence::BODY_231.angles(root.r),
            velocity: root.v,
            angular_velocity: root.w,
            held_steps: 0,
            held_motion: None,
        });
        self.in_its_steps(&mut setup, 1);
        setup
    }

    /// Mean velocity of the mass centre over the beat, N components [m/s].
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn mean_velocity(&self) -> Result<DVec3, AnalysisError> {
        let end = self.beat.advance(&self.state)?;
        Ok((DVec3::from_slice(&end) - DVec3::from_slice(&self.state)) / self.beat.period())
    }
}

/// Trims the flight of `setup`.
///
/// # Errors
/// A setup that [`Beat`] does not cover; unknowns that the problem does not determine, or too few; numbers that
/// stop being finite at the very start; right and left that part, where only what is in the plane of symmetry
/// is asked. A trim that does not converge is no error: see [`TrimSolution::converged`].
pub fn trim(setup: &FlightSetup, problem: &TrimProblem) -> Result<Trim, AnalysisError> {
    if matches!(setup.air, AirModel::None) {
        return Err(AnalysisError::not_covered(
            "there is no air, and nothing carries the weight",
            "choose one: air.model = \"blade_element\", for instance",
        ));
    }
    check_determined(setup, problem)?;
    let first = Beat::new(setup, problem.settings.steps)?;
    let speed = first.wing_length() / first.period();
    let rate = turning(problem, problem.angles()) * first.period();
    let mut x = Residuals::of(problem).point(problem.velocity / speed, rate);
    x.extend(first_unknowns(setup, problem));
    x.extend(periodic_joints(&first, attitude(problem.angles()))?);
    let begun = evaluate(&steadied(setup), problem, &x)?;
    check_symmetric(begun.solution.lateral, AT_START * ROUNDING)?;
    if !problem.bounds.is_empty() && problem.given.is_empty() {
        let inside = search(setup, problem, x.clone(), true)?;
        if inside.solution.converged {
            return Ok(inside);
        }
        let beyond = trim_from(setup, problem, x).ok();
        let steady = beyond.filter(|found| found.solution.converged);
        return Ok(steady.unwrap_or(inside));
    }
    trim_from(setup, problem, x)
}

/// The same from a [`Trim::point`] near the one that is sought.
///
/// # Errors
/// As [`trim`].
pub fn trim_from(
    setup: &FlightSetup,
    problem: &TrimProblem,
    x: Vec<f64>,
) -> Result<Trim, AnalysisError> {
    search(setup, problem, x, false)
}

/// The search from a point, within the bounds of the problem or anywhere.
fn search(
    setup: &FlightSetup,
    problem: &TrimProblem,
    x: Vec<f64>,
    is_confined: bool,
) -> Result<Trim, AnalysisError> {
    let search = Search {
        tolerance: problem.settings.tolerance,
        iterations: problem.settings.iterations,
        updates: false,
        reach: 0.5, // radians, relative changes, R f
        shortening: (0.5, 20),
    };
    let mut map = BeatMap {
        setup: &steadied(setup),
        problem,
        is_confined,
        steps: 0,
    };
    let (x, iterations) = search.from(&mut map, x)?;
    let mut found = evaluate(map.setup, problem, &x)?;
    found
        .solution
        .conclude(iterations, problem.settings.tolerance, ROUNDING)?;
    Ok(found)
}

/// Beats within which free joints find their periodic motion while the body is held.
const MAX_HELD_BEATS: usize = 400;

/// Beats after which free joints with any damping have found their periodic motion.
const SETTLING_BEATS: usize = 5;

/// Coordinates and speeds of the free joints over their natural sizes after some beats of a body
/// that is put back into its place after each: a start from which Newton's method finds their
/// periodic motion.
fn periodic_joints(beat: &Beat, attitude: DMat3) -> Result<Vec<f64>, AnalysisError> {
    let mut joints = beat.joints_at_start();
    if joints.is_empty() {
        return Ok(joints);
    }
    let still = BodyMotion {
        r: attitude,
        ..BodyMotion::REST
    };
    for _ in 0..SETTLING_BEATS {
        let y = beat.state_at(0.0, &still, &joints);
        joints = beat.advance(&y)?[JOINTS..].to_vec();
    }
    let sizes = beat.joint_sizes();
    Ok(joints.iter().zip(sizes).map(|(x, s)| x / s).collect())
}

/// Right and left of a trimmed wingbeat in air without memory part by less than this by rounding \[1\].
const ROUNDING: f64 = 1e-5;

/// The residual at the point `x`, with everything that belongs to it.
fn evaluate(setup: &FlightSetup, problem: &TrimProblem, x: &[f64]) -> Result<Trim, AnalysisError> {
    let residuals = Residuals::of(problem);
    let n = residuals.controls();
    let chosen = problem.values(setup, &x[n..2 * n]);
    let (mut solution, setup) = TrimSolution::at(setup, problem, &chosen);
    let problem = &problem.at_speeds(&solution.unknowns, &solution.values);
    let beat = Beat::new(&setup, problem.settings.steps)?;
    let (length, period) = (beat.wing_length(), beat.period());
    let [velocity, rate] = residuals.motion(x);
    let (velocity, rate) = (velocity * (length / period), rate / period);
    let sizes = beat.joint_sizes();
    let joints = x[2 * n..].iter().zip(sizes).map(|(x, s)| x * s);
    let joints: Vec<f64> = joints.collect();
    let centre = BodyMotion {
        p: DVec3::ZERO,
        r: attitude([solution.body_pitch, solution.body_roll]),
        v: velocity,
        w: rate,
    };
    let state = beat.state_at(0.0, &centre, &joints);
    let end = beat.advance(&state)?;
    let size = Measures {
        length,
        period,
        weight: beat.mass() * beat.gravity().length(),
    };
    let seen = |y: &[f64]| {
        let state = MomentumState::of(y);
        FlyerMotion {
            centre: state.centre,
            momentum: state.momentum,
            spin: state.angular,
            rotation: beat.root(y).r,
        }
    };
    (solution.residual, solution.lateral) =
        residuals.between(problem, &size, &[seen(&state), seen(&end)]);
    let changes = end[JOINTS..].iter().zip(&state[JOINTS..]).zip(sizes);
    let changes = changes.map(|((end, start), size)| (end - start) / size);
    solution.residual.extend(changes);
    Ok(Trim {
        solution,
        velocity: problem.velocity,
        turn_rate: problem.turn_rate,
        state,
        point: x.to_vec(),
        beat,
        setup,
    })
}

/// The residuals of one beat as a map of the point.
struct BeatMap<'a> {
    setup: &'a FlightSetup,
    problem: &'a TrimProblem,
    /// Whether the search stays within the bounds.
    is_confined: bool,
    /// Newton steps begun.
    steps: usize,
}

impl Map for BeatMap<'_> {
    fn residual(&mut self, x: &[f64]) -> Result<Vec<f64>, AnalysisError> {
        evaluate(self.setup, self.problem, x).map(|found| found.solution.residual)
    }

    fn confine(&self, x: &mut [f64]) {
        if self.is_confined {
            let n = Residuals::of(self.problem).controls();
            self.problem.confine(self.setup, &mut x[n..2 * n]);
        }
    }

    /// By central differences.
    fn slopes(&mut self, x: &[f64], r: &[f64]) -> Result<Vec<f64>, AnalysisError> {
        // The cube root of the rounding of the map: central differences are then best.
        const STEP: f64 = 1e-5;
        let (step, error) = (self.steps, largest(r));
        progress::task(&format!("Newton step {step}, residual {error:.1e}"), 0, 0);
        self.steps += 1;
        matrix_of(x.len(), |k| {
            let plus = self.residual(&moved(x, k, STEP))?;
            let minus = self.residual(&moved(x, k, -STEP))?;
            let slopes = plus.iter().zip(&minus).map(|(p, m)| (p - m) / (2.0 * STEP));
            let column: Vec<f64> = slopes.collect();
            check_effect(self.problem, k, &column)?;
            Ok(column)
        })
    }
}

/// An error if the control that unknown `k` is changes nothing.
fn check_effect(problem: &TrimProblem, k: usize, column: &[f64]) -> Result<(), AnalysisError> {
    // Differences of residuals that are known to 1e-13 over steps of 1e-5.
    const NOTHING: f64 = 1e-7;
    let motions = Residuals::of(problem).controls();
    let control = (k.checked_sub(motions)).and_then(|c| problem.unknowns.get(c));
    match control {
        Some(unknown) if largest(column) < NOTHING => Err(AnalysisError::not_covered(
            format!(
                "{} changes nothing in this flight: what it adjusts is not what moves the wings, or they do not move",
                unknown.name()
            ),
            "choose other unknowns; wings that joints drive answer to drive_amplitude, frequency, body_pitch and mass_centre, and to what their own motion still does",
        )),
        _ => Ok(()),
    }
}
