//! Trim and Floquet's modes in air that remembers: the vortex lattice.
//!
//! A periodic orbit of body **and** wake has thousands of unknowns. What is done instead: the body
//! is held for some wingbeats with constant velocity and attitude while the wake grows, then
//! released; the free wingbeat that follows is the map of the state. Trim asks that this beat
//! changes nothing but the place (the residuals of [`crate::steady`]). For stability the map is
//! differentiated, and two things can be held fixed:
//!
//! - [`WakeMemory::Given`]: the wake of the trimmed hold; the disturbance is put on the body at
//!   its release (its velocities and attitude jump, the wake does not).
//! - [`WakeMemory::Carried`]: the hold is flown in the disturbed motion already, so the wake is that
//!   of a steadily disturbed flight; only angular velocity, which a hold cannot have, jumps.
//!
//! Neither is the full monodromy of body and wake; the two bracket what the memory does within
//! a wingbeat.

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::{AirModel, FlightSetup, MotionMode, Record, Simulation, StartState};
use wingbeat_math::{DMat3, DQuat, DVec3, EulerSequence, solve_small};
use wingbeat_model::motion::Adjustment;

use crate::AnalysisError;
use crate::eigen::eigen;
use crate::level::{Level, Perturbation};
use crate::modes::{ModeSet, Scales};
use crate::progress;
use crate::steady::TrimProblem;
use crate::steady::{self, Measures, Residuals, Snapshot};
use crate::trim::largest;
use crate::unknown::{Unknown, adjusted};

/// What is held fixed when the state of the body is disturbed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WakeMemory {
    /// The wake of the trimmed flight.
    Given,
    /// The disturbed motion during the hold: the wake goes with it.
    Carried,
}

/// How the flights are flown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WakeSettings {
    /// Wingbeats during which the body is held.
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

/// A trimmed flight in air with memory, or the best point found.
#[derive(Clone, Debug)]
pub struct WakeTrim {
    /// Whether the residual is within the tolerance.
    pub converged: bool,
    /// As [`crate::Trim::residual`].
    pub residual: Vec<f64>,
    /// As [`crate::Trim::aside`].
    pub aside: f64,
    /// Quasi-Newton steps made.
    pub iterations: usize,
    /// Flights flown.
    pub flights: usize,
    /// What was chosen, and what was given.
    pub unknowns: Vec<Unknown>,
    /// Unknowns whose values are outside the bounds of the problem: steady flight, but not as asked.
    pub outside: Vec<Unknown>,
    /// Unknowns at a bound.
    pub at_bound: Vec<Unknown>,
    /// The adjustment of all wings.
    pub adjustment: Adjustment,
    /// What right wings have more of it than left ones.
    pub difference: Adjustment,
    /// Shift of the mass centre along b1 [m].
    pub mass_centre: f64,
    /// Pitch of the body at its release \[rad\].
    pub body_pitch: f64,
    /// Roll of the body at its release, right side down \[rad\].
    pub body_roll: f64,
    /// The adjusted flight: held, released, one free wingbeat.
    pub setup: FlightSetup,
}

impl WakeTrim {
    /// Largest residual.
    pub fn error(&self) -> f64 {
        largest(&self.residual)
    }

    /// How it starts.
    pub fn start(&self) -> &StartState {
        start(&self.setup)
    }
}

fn start(setup: &FlightSetup) -> &StartState {
    match &setup.mode {
        MotionMode::Free(start) => start,
        MotionMode::Tethered(_) => unreachable!("trimmed flights are free"),
    }
}

/// Wingbeat of a setup in steps.
fn steps_per_beat(setup: &FlightSetup) -> Result<usize, AnalysisError> {
    let period = setup.time.period.unwrap_or(0.0);
    let steps = (period / setup.time.step).round();
    let fits = steps >= 4.0 && (steps * setup.time.step / period - 1.0).abs() < 1e-9;
    if fits {
        return Ok(steps as usize);
    }
    Err(AnalysisError::not_covered(
        "a wingbeat is not a whole number of steps",
        "give time.steps_per_beat",
    ))
}

/// Trims the flight of `setup` in air with memory.
///
/// # Errors
/// No wingbeat, or one that is not a whole number of steps; a steady turn, which a body that is held cannot fly;
/// unknowns that the problem does not determine, or too few; a first flight that fails. A trim that does not converge
/// is no error: see [`WakeTrim::converged`].
pub fn trim_with_wake(
    setup: &FlightSetup,
    problem: &TrimProblem,
    settings: &WakeSettings,
) -> Result<WakeTrim, AnalysisError> {
    steady::check_determined(setup, problem)?;
    if problem.turn_rate != 0.0 {
        return Err(AnalysisError::not_covered(
            "in air with memory the body is held straight while its wake grows, and a steady turn was asked for",
            "trim the turn in blade elements (air.model = \"blade_element\")",
        ));
    }
    let residuals = Residuals::of(problem);
    let mut setup = setup.clone();
    if let (AirModel::VortexLattice(air), Residuals::All) = (&mut setup.air, residuals) {
        air.mirror = false; // right and left part
    }
    let mut search = Search {
        setup: &setup,
        problem,
        residuals,
        settings,
        steps: steps_per_beat(&setup)?,
        flights: 0,
        best: f64::INFINITY,
    };
    let mut x = search.start();
    let mut r = search.fly(&x)?.residual;
    let mut iterations = 0;
    let mut jacobian = vec![];
    if largest(&r) > settings.tolerance {
        jacobian = search.jacobian(&x, &r)?;
    }
    let mut fresh = true;
    while iterations < settings.iterations && largest(&r) > settings.tolerance {
        let found = search.step(&x, &r, &jacobian);
        let Some((x_new, r_new)) = found else {
            if fresh {
                break;
            }
            jacobian = search.jacobian(&x, &r)?;
            fresh = true;
            continue;
        };
        // A step that hardly helps: the slopes have become old.
        let poor = largest(&r_new) > 0.5 * largest(&r) && !fresh;
        broyden(&mut jacobian, &x, &r, &x_new, &r_new);
        (x, r) = (x_new, r_new);
        fresh = false;
        iterations += 1;
        if poor && largest(&r) > settings.tolerance {
            jacobian = search.jacobian(&x, &r)?;
            fresh = true;
        }
    }
    let mut found = search.fly(&x)?;
    found.converged = found.error() <= settings.tolerance;
    found.iterations = iterations;
    steady::check_symmetric(found.aside, ROUNDING)?;
    Ok(found)
}

/// Right and left of a wingbeat after a hold part by less than this where wakes are chaotic \[1\].
const ROUNDING: f64 = 1e-2;

/// The search: what to fly and how often it was.
struct Search<'a> {
    setup: &'a FlightSetup,
    problem: &'a TrimProblem,
    residuals: Residuals,
    settings: &'a WakeSettings,
    steps: usize,
    flights: usize,
    /// Smallest of the largest residuals so far.
    best: f64,
}

impl Search<'_> {
    fn scales(&self) -> (f64, f64) {
        let nodes = self.setup.animal.wings.iter().flat_map(|w| &w.mesh.nodes);
        let length = nodes.fold(0.0_f64, |m, r| m.max(r.length()));
        (length, self.setup.time.period.unwrap_or(1.0))
    }

    /// The point at which the search begins.
    fn start(&self) -> Vec<f64> {
        let problem = self.problem;
        let (length, period) = self.scales();
        let (v, w) = match &self.setup.mode {
            // A case that was trimmed before: its motion at the release.
            MotionMode::Free(s) if s.held_steps > 0 => (s.velocity, s.angular_velocity),
            _ => (problem.velocity, DVec3::ZERO),
        };
        let scaled = DVec3::new(
            v.x * period / length,
            v.y * period / length,
            v.z * period / length,
        );
        let mut x = self.residuals.point(scaled, w * period);
        x.extend(steady::first_controls(problem));
        x
    }

    /// The flight at the point (velocity over R f, angular velocity times T, controls).
    fn fly(&mut self, x: &[f64]) -> Result<WakeTrim, AnalysisError> {
        self.flights += 1;
        progress::task(
            &format!("flight {}, residual {:.1e}", self.flights, self.best),
            0,
            0,
        );
        let problem = self.problem;
        let (unknowns, values) = problem.with_given(&x[self.residuals.controls()..]);
        let a = adjusted(self.setup, &unknowns, problem.angles(), &values);
        let mut setup = a.setup;
        let first = setup.animal.wings.first();
        let period = 1.0 / first.map_or(0.0, |w| w.motion.frequency);
        let (length, old) = self.scales();
        let [velocity, rate] = self.residuals.motion(x);
        setup.time.step = period / self.steps as f64;
        setup.time.period = Some(period);
        setup.time.steps = (self.settings.held_beats + 1) * self.steps;
        setup.mode = MotionMode::Free(StartState {
            position: DVec3::ZERO,
            angles: DVec3::new(a.pitch, 0.0, a.roll),
            velocity: velocity * length / old,
            angular_velocity: rate / old,
            held_steps: self.settings.held_beats * self.steps,
        });
        let ends = free_beat(&setup, self.steps, None)?;
        let size = Measures {
            length,
            period,
            weight: setup.animal.mass() * setup.gravity.length(),
        };
        let seen = ends.map(|r| Snapshot {
            centre: r.mass_centre,
            momentum: r.momentum,
            spin: spin(&r),
            rotation: rotation(&r),
        });
        let (residual, aside) = self.residuals.between(problem, &size, &seen);
        self.best = self.best.min(largest(&residual));
        let [outside, at_bound] = problem.beyond(&unknowns, &values);
        Ok(WakeTrim {
            converged: false,
            residual,
            aside,
            iterations: 0,
            flights: self.flights,
            unknowns,
            outside,
            at_bound,
            adjustment: a.adjustment,
            difference: a.difference,
            mass_centre: a.mass_centre,
            body_pitch: a.pitch,
            body_roll: a.roll,
            setup,
        })
    }

    /// Slopes of the residuals at `x`, rows by residual, by one-sided differences, over steps beside which the
    /// roughness of the map is small.
    fn jacobian(&mut self, x: &[f64], r: &[f64]) -> Result<Vec<f64>, AnalysisError> {
        let step = if self.settings.tolerance < SMOOTH {
            1e-4
        } else {
            2e-2
        };
        let n = x.len();
        let mut j = vec![0.0; n * n];
        for k in 0..n {
            let mut moved = x.to_vec();
            moved[k] += step;
            let at = self.fly(&moved)?.residual;
            (0..n).for_each(|i| j[n * i + k] = (at[i] - r[i]) / step);
        }
        Ok(j)
    }

    /// A point on the quasi-Newton direction with smaller residuals.
    fn step(&mut self, x: &[f64], r: &[f64], jacobian: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let mut direction = r.to_vec();
        solve_small(&mut jacobian.to_vec(), &mut direction).ok()?;
        let longest = direction.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
        let squares = |r: &[f64]| r.iter().map(|x| x * x).sum::<f64>();
        let mut length = (0.3 / longest).min(1.0);
        for _ in 0..6 {
            let trial: Vec<f64> = (x.iter().zip(&direction))
                .map(|(x, d)| x - length * d)
                .collect();
            if let Ok(found) = self.fly(&trial)
                && squares(&found.residual) < squares(r)
            {
                return Some((trial, found.residual));
            }
            length *= 0.4;
        }
        None
    }
}

/// Broyden's update of the slopes by what a step showed [Broyden 1965].
fn broyden(j: &mut [f64], x: &[f64], r: &[f64], x1: &[f64], r1: &[f64]) {
    let s: Vec<f64> = x1.iter().zip(x).map(|(a, b)| a - b).collect();
    let square: f64 = s.iter().map(|a| a * a).sum();
    for (i, row) in j.chunks_mut(x.len()).enumerate() {
        let predicted: f64 = row.iter().zip(&s).map(|(j, s)| j * s).sum();
        let gap = r1[i] - r[i] - predicted;
        row.iter_mut()
            .zip(&s)
            .for_each(|(j, s)| *j += gap * s / square);
    }
}

/// Angular momentum about the mass centre, N components.
fn spin(r: &Record) -> DVec3 {
    r.angular_momentum - r.mass_centre.cross(r.momentum)
}

fn rotation(r: &Record) -> DMat3 {
    let [w, x, y, z] = r.root_quaternion;
    DMat3::from_quat(DQuat::from_xyzw(x, y, z, w))
}

/// The motion into which the root is released, from that at the end of the hold.
type Release<'a> = dyn Fn(BodyMotion, &Record) -> BodyMotion + 'a;

/// Records at the release and one wingbeat later; `release` sets the root into another motion
/// then.
fn free_beat(
    setup: &FlightSetup,
    steps: usize,
    release: Option<&Release>,
) -> Result<[Record; 2], AnalysisError> {
    let held = start(setup).held_steps;
    let mut flight = Simulation::new(setup.clone())?;
    while flight.state().step < held {
        if flight.state().step + 1 == held
            && let Some(change) = release
        {
            // The hold is prescribed: what it will be at the release is known beforehand.
            let mut probe = Simulation::resume(setup.clone(), flight.state().clone())?;
            probe.step()?;
            let root = change(probe.root(), probe.record());
            flight.release_into(root);
        }
        flight.step()?;
    }
    let first = flight.record().clone();
    for _ in 0..steps {
        flight.step()?;
    }
    Ok([first, flight.record().clone()])
}

/// The derivative of the free beat by the nine components of [`Perturbation`] at the release, 9 x 9
/// by rows, about the trimmed flight.
///
/// # Errors
/// A flight that fails; disturbances that do not reach all nine components.
pub fn wake_monodromy(trim: &WakeTrim, memory: WakeMemory) -> Result<Vec<f64>, AnalysisError> {
    let steps = steps_per_beat(&trim.setup)?;
    let level = Level::new(start(&trim.setup).rotation(), trim.setup.gravity);
    let scales = scales(&trim.setup).array();
    let seen = |r: &Record| {
        let velocity = r.momentum / trim.setup.animal.mass();
        Perturbation::seen(&level, rotation(r), velocity, r.root_angular_velocity).to_array()
    };
    let (mut before, mut after) = (vec![0.0; 81], vec![0.0; 81]);
    for k in 0..9 {
        let h = 1e-3 * scales[k];
        let fly = |s: f64| -> Result<[[f64; 9]; 2], AnalysisError> {
            progress::task("disturbed flights", 2 * k + usize::from(s < 0.0), 18);
            let mut x = [0.0; 9];
            x[k] = s * h;
            let [a, b] = disturbed(trim, &level, &Perturbation::from_array(x), memory, steps)?;
            Ok([seen(&a), seen(&b)])
        };
        let (plus, minus) = (fly(1.0)?, fly(-1.0)?);
        for i in 0..9 {
            before[9 * i + k] = (plus[0][i] - minus[0][i]) / (2.0 * h);
            after[9 * i + k] = (plus[1][i] - minus[1][i]) / (2.0 * h);
        }
    }
    // after = M before: rows of M solve before^T m = after row.
    let mut m = vec![0.0; 81];
    for i in 0..9 {
        let mut transposed: Vec<f64> = (0..81).map(|e| before[9 * (e % 9) + e / 9]).collect();
        let mut row = after[9 * i..9 * i + 9].to_vec();
        solve_small(&mut transposed, &mut row)
            .map_err(|e| AnalysisError::Numbers(format!("the disturbances are dependent: {e}")))?;
        m[9 * i..9 * i + 9].copy_from_slice(&row);
    }
    Ok(m)
}

/// The free beat with a disturbance.
fn disturbed(
    trim: &WakeTrim,
    level: &Level,
    by: &Perturbation,
    memory: WakeMemory,
    steps: usize,
) -> Result<[Record; 2], AnalysisError> {
    // Rotation in N that carries the trimmed attitude to the disturbed one.
    let tilt = DMat3::from_quat(DQuat::from_scaled_axis(by.tilt));
    let turn = level.to_n * tilt * level.to_n.transpose();
    let push = level.to_n * tilt * by.velocity;
    let rate = level.to_root * by.rate;
    let trimmed = start(&trim.setup);
    let mut setup = trim.setup.clone();
    if let AirModel::VortexLattice(air) = &mut setup.air {
        air.mirror = false; // lateral disturbances need both sides
    }
    match memory {
        WakeMemory::Carried => {
            let attitude = turn * trimmed.rotation();
            setup.mode = MotionMode::Free(StartState {
                angles: EulerSequence::BODY_231.angles(attitude),
                velocity: turn * trimmed.velocity + push,
                angular_velocity: trimmed.angular_velocity + rate,
                ..*trimmed
            });
            free_beat(&setup, steps, None)
        }
        WakeMemory::Given => {
            let change = |root: BodyMotion, record: &Record| {
                let arm = root.p - record.mass_centre;
                let r = turn * root.r;
                BodyMotion {
                    p: record.mass_centre + turn * arm,
                    r,
                    v: turn * root.v + push + (r * rate).cross(turn * arm),
                    w: root.w + rate,
                }
            };
            free_beat(&setup, steps, Some(&change))
        }
    }
}

fn scales(setup: &FlightSetup) -> Scales {
    let nodes = setup.animal.wings.iter().flat_map(|w| &w.mesh.nodes);
    let length = nodes.fold(0.0_f64, |m, r| m.max(r.length()));
    let period = setup.time.period.unwrap_or(1.0);
    Scales {
        velocity: length / period,
        rate: 1.0 / period,
        period,
    }
}

/// Floquet's modes of the free beat about the trimmed flight.
///
/// # Errors
/// As [`wake_monodromy`].
pub fn wake_floquet(trim: &WakeTrim, memory: WakeMemory) -> Result<ModeSet, AnalysisError> {
    wake_modes(trim, &wake_monodromy(trim, memory)?)
}

/// The same of a derivative that is known, [`wake_monodromy`].
///
/// # Errors
/// Numbers that are not finite.
pub fn wake_modes(trim: &WakeTrim, monodromy: &[f64]) -> Result<ModeSet, AnalysisError> {
    let pairs = eigen(monodromy, 9)?;
    Ok(ModeSet::of_multipliers(pairs, &scales(&trim.setup), &[]))
}
