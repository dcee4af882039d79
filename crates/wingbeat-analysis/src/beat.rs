//! One wingbeat of free flight in air without memory, as a map of the state.
//!
//! The equations are those of a flight ([`FreeFlight`]): any bodies and joints, loops among them whose motion
//! is driven, any air that depends on the present motion alone. As the wings' motion is prescribed and
//! periodic, everything that depends on time alone is known beforehand at the half steps of the classical
//! Runge-Kutta method.
//!
//! State: mass centre, quaternion, linear momentum, angular momentum about the mass centre (13
//! numbers, N components), then coordinates and speeds of the free joints.

pub(crate) mod glide;
pub(crate) mod level;
pub(crate) mod mean;
pub(crate) mod periodic;

use std::ops::Range;
use std::sync::Arc;

use wingbeat_dynamics::{
    BodyMotion, Composite, Configuration, Formulation, Joint, JointOffsets, MomentumState,
};
use wingbeat_flight::{
    AirModel, AppliedLoad, FlightSetup, FreeFlight, FreeFlightScratch, MotionBlend, MotionMode,
    is_driven,
};
use wingbeat_math::ode::Rk4;
use wingbeat_math::{DMat3, DQuat, DVec3, RotationLaw, rotation_vector};
use wingbeat_model::Wing;
use wingbeat_model::motion::Adjustment;

use crate::AnalysisError;
use glide::period_of_glide;
use periodic::check_periodic;

/// The state of the momentum form.
pub type State = Vec<f64>;

/// Where the coordinates of the joints begin in a [`State`].
pub(crate) const JOINTS: usize = MomentumState::NUMBERS;

/// Free flight over one wingbeat in equal steps.
#[derive(Clone, Debug)]
pub struct Beat {
    flight: FreeFlight,
    mass: f64,
    gravity: DVec3,
    weights: Vec<AppliedLoad>,
    stream: DVec3,
    steps: usize,
    period: f64,
    wing_length: f64,
    joint_sizes: Vec<f64>,
}

impl Beat {
    /// The wingbeat of a setup, its wings beating steadily from the first instant, in `steps` equal steps.
    /// Start state, mode and time grid of the setup do not matter; of the start of the strokes what remains is
    /// by how much it delays them behind joints that are driven in time.
    ///
    /// # Errors
    /// Air with a memory or that changes with time or place; applied loads; no wings, or wings that beat at different
    /// frequencies; joints that are not back after a wingbeat; loops whose motion
    /// the laws of joints do not determine; what bodies and air refuse.
    pub fn new(setup: &FlightSetup, steps: usize) -> Result<Self, AnalysisError> {
        let beat = Self::with_law(setup, steps, |_, wing| Arc::new(wing.motion.clone()))?;
        check_periodic(beat.flight.system(), beat.period)?;
        Ok(beat)
    }

    /// A wingbeat in which the motion of every wing goes over smoothly from one adjustment to
    /// another. Frequencies stay.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn between(
        setup: &FlightSetup,
        steps: usize,
        from: &[Adjustment],
        to: &[Adjustment],
    ) -> Result<Self, AnalysisError> {
        let window = [0.0, common_period(setup)?];
        Self::passing(setup, steps, from, to, window)
    }

    /// The same, which begins and takes as long as `window` says [s].
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn passing(
        setup: &FlightSetup,
        steps: usize,
        from: &[Adjustment],
        to: &[Adjustment],
        [start, duration]: [f64; 2],
    ) -> Result<Self, AnalysisError> {
        Self::with_law(setup, steps, |k, wing| {
            let motion = |a: &Adjustment| wing.motion.adjusted(wing.side, a);
            Arc::new(MotionBlend {
                from: motion(&from[k]),
                to: motion(&to[k]),
                start,
                duration,
            })
        })
    }

    fn with_law(
        setup: &FlightSetup,
        steps: usize,
        law: impl Fn(usize, &Wing) -> Arc<dyn RotationLaw>,
    ) -> Result<Self, AnalysisError> {
        let period = common_period(setup)?;
        check_steady(setup)?;
        let half = period / (2 * steps) as f64;
        let setup = &steadied(setup); // deformations of wings follow their phase too
        let flight = FreeFlight::new(setup, &law, half, 2 * steps)?;
        if !flight.air().is_steady_and_uniform() {
            return Err(changing_air(setup));
        }
        Ok(Self {
            mass: flight.system().total_mass(),
            gravity: setup.gravity,
            weights: setup.loads.clone(),
            stream: setup.air.stream().unwrap_or(DVec3::ZERO),
            steps,
            period,
            wing_length: setup.animal.wing_length(),
            joint_sizes: flight.form().scales().split_off(JOINTS),
            flight,
        })
    }

    /// Velocity of the undisturbed air, N components [m/s].
    pub(crate) fn stream(&self) -> DVec3 {
        self.stream
    }

    /// The equations.
    pub fn flight(&self) -> &FreeFlight {
        &self.flight
    }

    /// Configuration and whole at all half steps of one period, the end left out; free joints at their
    /// start.
    pub(crate) fn configurations(&self) -> impl Iterator<Item = (&Configuration, &Composite)> {
        let table = self.flight.form().table().expect("made with one");
        (0..2 * self.steps).map(|k| table.configuration(k))
    }

    /// Half a step [s].
    pub(crate) fn half_step(&self) -> f64 {
        self.period / (2 * self.steps) as f64
    }

    /// Period T of the wingbeat [s]; of a glide, in which nothing beats, sqrt(R / g) / 4.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Total mass m [kg].
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Acceleration of gravity, N components [m/s2].
    pub fn gravity(&self) -> DVec3 {
        self.gravity
    }

    /// Wing length R of the longest wing, hinge to tip along the span [m].
    pub fn wing_length(&self) -> f64 {
        self.wing_length
    }

    /// Steps per wingbeat.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Coordinates and speeds of the free joints at their start, as they stand in a [`State`].
    pub fn joints_at_start(&self) -> Vec<f64> {
        let (q, u) = self.flight.system().start();
        [q, u].concat()
    }

    /// Natural sizes of the joints' coordinates and speeds.
    pub fn joint_sizes(&self) -> &[f64] {
        &self.joint_sizes
    }

    /// The whole at `time` [s] with the free joints at `joints` (coordinates, speeds).
    fn whole(&self, time: f64, joints: &[f64]) -> Composite {
        let system = self.flight.system();
        let mut configuration = Configuration::new(system);
        configuration.update_free(system, time, joints.split_at(system.coordinates()));
        configuration.composite(system)
    }

    /// Mass centre at the start of the beat, root components [m]; free joints at their start.
    pub fn mass_centre(&self) -> DVec3 {
        self.whole(0.0, &self.joints_at_start()).c
    }

    /// The state at the start of a beat in which the mass centre is at `centre` [m] with
    /// `velocity` [m/s] (N components), the root has the attitude `rotation` (root to N) and the
    /// angular velocity `rate` [rad/s] (root components); free joints at their start.
    pub fn state(&self, centre: DVec3, rotation: DMat3, velocity: DVec3, rate: DVec3) -> State {
        let centre = BodyMotion {
            p: centre,
            r: rotation,
            v: velocity,
            w: rate,
        };
        self.state_at(0.0, &centre, &self.joints_at_start())
    }

    /// The state at `time` [s] within the beat in which the mass centre moves like `centre`, the frame of the root put
    /// there, and the free joints are at `joints` (coordinates [rad or m], then speeds).
    pub fn state_at(&self, time: f64, centre: &BodyMotion, joints: &[f64]) -> State {
        let whole = self.whole(time, joints);
        let h = centre.r * (whole.inertia * centre.w + whole.h);
        let state = MomentumState {
            centre: centre.p,
            attitude: DQuat::from_mat3(&centre.r).normalize(),
            momentum: self.mass * centre.v,
            angular: h,
        };
        let mut y = vec![0.0; JOINTS];
        state.write(&mut y);
        y.extend_from_slice(joints);
        y
    }

    /// Motion of the root (origin of its frame) in the state `y` at the start of a beat.
    pub fn root(&self, y: &[f64]) -> BodyMotion {
        self.root_at(0.0, y)
    }

    /// The same at `time` [s] within the beat.
    pub fn root_at(&self, time: f64, y: &[f64]) -> BodyMotion {
        let whole = self.whole(time, &y[JOINTS..]);
        let state = MomentumState::of(y);
        let r = state.rotation();
        let back = r.transpose();
        let w = whole.inertia.inverse() * (back * state.angular - whole.h);
        let v = back * (state.momentum / self.mass) - w.cross(whole.c) - whole.c_dot;
        BodyMotion {
            p: state.centre - r * whole.c,
            r,
            v: r * v,
            w,
        }
    }

    /// Velocity of the mass centre in the state `y`, N components [m/s].
    pub fn velocity(&self, y: &[f64]) -> DVec3 {
        MomentumState::of(y).momentum / self.mass
    }

    /// Coordinates and rates of every free joint in the state `y`, by the joint's name; of
    /// spherical joints the rotation vector [rad or m, per s].
    pub fn joints(&self, y: &[f64]) -> Vec<(String, Vec<f64>, Vec<f64>)> {
        let system = self.flight.system();
        let (q, u) = y[JOINTS..].split_at(system.coordinates());
        let hinges = system.hinges().iter().zip(system.offsets());
        let free = hinges.filter(|(_, offsets)| offsets.speeds > 0);
        let of = |(hinge, s): (&Joint, &JointOffsets)| {
            let q = &q[s.q..s.q + s.coordinates];
            let coordinates = match s.coordinates {
                4 => rotation_vector(DQuat::from_slice(q)).to_array().to_vec(),
                _ => q.to_vec(),
            };
            (
                hinge.name.clone(),
                coordinates,
                u[s.u..s.u + s.speeds].to_vec(),
            )
        };
        free.map(of).collect()
    }

    /// The state one wingbeat later.
    ///
    /// # Errors
    /// Numbers that are not finite, equations that are singular.
    pub fn advance(&self, y: &[f64]) -> Result<State, AnalysisError> {
        crate::progress::beat();
        self.advance_over(0..self.steps, y)
    }

    /// Mean attitude of the root over the wingbeat from `y`, root to N: that about which loads are averaged.
    ///
    /// # Errors
    /// As [`Self::advance`].
    pub fn mean_attitude(&self, y: &[f64]) -> Result<DMat3, AnalysisError> {
        let mut integration = Integration::new(self);
        let mut y = y.to_vec();
        let first = MomentumState::of(&y).attitude;
        let mut sum = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        for step in 0..self.steps {
            let q = MomentumState::of(&y).attitude;
            sum = if q.dot(first) < 0.0 { sum - q } else { sum + q };
            integration.step(self, step, &mut y)?;
        }
        Ok(DMat3::from_quat(sum.normalize()))
    }

    /// The state after these steps of the beat.
    ///
    /// # Errors
    /// As [`Self::advance`].
    pub fn advance_over(&self, steps: Range<usize>, y: &[f64]) -> Result<State, AnalysisError> {
        let mut integration = Integration::new(self);
        let mut y = y.to_vec();
        for step in steps {
            integration.step(self, step, &mut y)?;
        }
        self.flight.form().to_unit_length(&mut y);
        Ok(y)
    }

    /// Rates of the state at half step number `half` of the beat.
    ///
    /// # Errors
    /// As [`Self::advance`].
    pub fn rates(&self, half: usize, y: &[f64]) -> Result<State, AnalysisError> {
        let t = (half % (2 * self.steps)) as f64 * self.half_step();
        let mut dy = vec![0.0; y.len()];
        (self.flight).rates(t, y, &mut self.flight.scratch(), &mut dy)?;
        Ok(dy)
    }
}

/// The classical Runge-Kutta method over a beat, with its scratch.
pub struct Integration {
    method: Rk4,
    scratch: FreeFlightScratch,
}

impl Integration {
    /// Room for the wingbeat `beat`.
    pub fn new(beat: &Beat) -> Self {
        Self {
            method: Rk4::new(beat.flight.dim()),
            scratch: beat.flight.scratch(),
        }
    }

    /// One step, from step number `step` of the beat.
    ///
    /// # Errors
    /// As [`Beat::advance`].
    pub fn step(&mut self, beat: &Beat, step: usize, y: &mut [f64]) -> Result<(), AnalysisError> {
        let h = beat.period / beat.steps as f64;
        let (t, scratch) = (step as f64 * h, &mut self.scratch);
        let rates = |t: f64, y: &[f64], dy: &mut [f64]| beat.flight.rates(t, y, scratch, dy);
        Ok(self.method.advance(t, h, y, rates)?)
    }
}

/// An error if a wingbeat of the setup is not like the next.
pub(crate) fn check_steady(setup: &FlightSetup) -> Result<(), AnalysisError> {
    check_weights(setup)?;
    if setup.feedback.is_some() {
        return Err(AnalysisError::not_covered(
            "the case has feedback ([control]), which has a memory of its own",
            "analyse the flight without [control]",
        ));
    }
    Ok(())
}

/// An error if applied loads are others than buoyancy and constant weights: these are as steady as gravity, and as
/// symmetric about it.
pub(crate) fn check_weights(setup: &FlightSetup) -> Result<(), AnalysisError> {
    match setup.loads.iter().all(|load| load.is_weight(setup.gravity)) {
        true => Ok(()),
        false => Err(AnalysisError::not_covered(
            "the case has applied loads ([[load]]) that are not constant forces along gravity",
            "remove them, or fly the case with `run`",
        )),
    }
}

/// That no wingbeat is like the next because of the air.
pub(crate) fn changing_air(setup: &FlightSetup) -> AnalysisError {
    if matches!(setup.air, AirModel::Own(_)) {
        return AnalysisError::not_covered(
            "the air is a model of your own that may change with time or place: no wingbeat need be like the next",
            "if its loads depend on the motion of the bodies alone, say so by its `is_steady_and_uniform`; or fly it",
        );
    }
    AnalysisError::not_covered(
        "the air changes with time or place (gust, shear, vortex street, ground): no wingbeat is like the next",
        "leave air.gust, air.shear_1_s, air.vortex_street and air.ground out, or fly it with `run`",
    )
}

/// The setup without the start of its strokes and of its tether: wings that beat at full rate from the first
/// instant, the beat beginning at the phase of the case. Where joints are driven in time, a start that delays
/// the wings does not delay the joints; so that a beat of both is one of the flight, it begins where the
/// joints' laws do, at the phase of the wings that have risen
/// ([`WingMotion::risen`](wingbeat_model::WingMotion::risen)).
pub(crate) fn steadied(setup: &FlightSetup) -> FlightSetup {
    let mut steady = setup.clone();
    let driven = setup.joints.iter().any(is_driven);
    for wing in &mut steady.animal.wings {
        wing.motion = match driven {
            true => wing.motion.risen(),
            false => wing.motion.impulsive(),
        };
    }
    if let MotionMode::Tethered(motion) = &mut steady.mode {
        *motion = motion.impulsive();
    }
    steady
}

/// The common period of all wings; of a glide, in which nothing beats, the time by which it is analysed [s].
fn common_period(setup: &FlightSetup) -> Result<f64, AnalysisError> {
    let animal = &setup.animal;
    let Some(first) = animal.wings.first().map(|w| w.motion.frequency) else {
        return Err(AnalysisError::not_covered(
            "the case has no beating wings, and what is analysed are wingbeats",
            "analyse the case whose wings beat, as that of which a table of derivatives was made; fly this one with `run`",
        ));
    };
    let is_alike = animal.wings.iter().all(|w| w.motion.frequency == first);
    if first <= 0.0 && is_alike {
        return period_of_glide(setup).ok_or_else(|| {
            AnalysisError::not_covered(
                "no wing beats, but joints are driven in time, or there is no gravity in which to glide",
                "give the frequency of the drives as that of the wingbeat (motion.frequency_hz); what glides has gravity and no drives",
            )
        });
    }
    if !is_alike {
        return Err(AnalysisError::not_covered(
            "the wings beat at different frequencies",
            "analyse wings of one frequency",
        ));
    }
    Ok(1.0 / first)
}
