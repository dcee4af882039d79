//! A controller in the loop of the flight: looks at its own rate, commands adjustments of the
//! wings' motion.
//!
//! From one look to the next the angles of every wing go over smoothly from the command before to
//! the new one ([`MotionBlend`]), so that wing inertia does its part and nothing jumps. A command acts
//! some looks after it was formed (the latency).

use std::collections::VecDeque;
use std::sync::{Arc, RwLock};

use wingbeat_math::{DMat3, DVec3, MovingRotation, RotationLaw, smoothstep7};
use wingbeat_model::motion::{Adjustment, wing_rotation};
use wingbeat_model::{Side, Wing, WingMotion};

use crate::error::{FlightError, RESUME_AS_SAVED};
use crate::interface::air_probe::AirProbe;
pub use crate::interface::controller::{Aim, Controller, Sensed, check_heeded, fits, for_all};
use crate::setup::{AirModel, FlightSetup, MotionMode};
pub use crate::setup::{ControlModel, Feedback};

/// Parts of the swing, angles [rad] and leads [wingbeats] that a controller may ask for, at most: ten times the
/// stroke, and more than a whole turn.
const MAX_COMMAND: f64 = 10.0;

/// Shortest interval of looks [time steps]: the starting values of a multistep method must not
/// see a change of command.
pub const MIN_INTERVAL: usize = 4;

/// The share of the way to a command that actuators go within `time`, in units of their time constant
/// (infinity: no lag).
pub fn share(time: f64) -> f64 {
    -(-time).exp_m1()
}

/// A wing whose angles and stroke plane go over from one motion to another by [`smoothstep7`].
#[derive(Clone, Debug)]
pub struct MotionBlend {
    /// The motion before.
    pub from: WingMotion,
    /// The motion after.
    pub to: WingMotion,
    /// When it begins [s].
    pub start: f64,
    /// How long it takes [s].
    pub duration: f64,
}

impl MotionBlend {
    /// Pitch of the stroke plane and angles phi, theta, psi at time `t` [s], each value, rate,
    /// acceleration [rad].
    pub fn angles(&self, t: f64) -> [[f64; 3]; 4] {
        let s = smoothstep7(t, self.start, self.duration);
        let blend = |a: [f64; 3], b: [f64; 3]| {
            let d: [f64; 3] = std::array::from_fn(|i| b[i] - a[i]);
            [
                a[0] + s[0] * d[0],
                a[1] + s[0] * d[1] + s[1] * d[0],
                a[2] + s[0] * d[2] + 2.0 * s[1] * d[1] + s[2] * d[0],
            ]
        };
        let plane = |m: &WingMotion| [m.stroke_plane_pitch, 0.0, 0.0];
        let (a, b) = (self.from.angles(t), self.to.angles(t));
        [
            blend(plane(&self.from), plane(&self.to)),
            blend(a[0], b[0]),
            blend(a[1], b[1]),
            blend(a[2], b[2]),
        ]
    }
}

impl RotationLaw for MotionBlend {
    fn at(&self, t: f64) -> MovingRotation {
        let [plane, phi, theta, psi] = self.angles(t);
        wing_rotation(plane, [phi, theta, psi])
    }
}

/// The motion of a wing under commands.
#[derive(Debug)]
pub struct CommandedMotion {
    motion: WingMotion,
    side: Side,
    blend: RwLock<MotionBlend>,
}

impl CommandedMotion {
    /// The wing's own motion until the first command.
    pub fn new(wing: &Wing) -> Self {
        let own = MotionBlend {
            from: wing.motion.clone(),
            to: wing.motion.clone(),
            start: 0.0,
            duration: 1.0,
        };
        Self {
            motion: wing.motion.clone(),
            side: wing.side,
            blend: RwLock::new(own),
        }
    }

    /// From `start` [s] on the wing goes over from one command to another, within `duration` [s].
    fn pass(&self, from: &Adjustment, to: &Adjustment, start: f64, duration: f64) {
        let motion = |by: &Adjustment| self.motion.adjusted(self.side, by);
        let next = MotionBlend {
            from: motion(from),
            to: motion(to),
            start,
            duration,
        };
        *self.blend.write().expect("no writer panicked") = next;
    }

    /// Angles phi, theta, psi at time `t` [s] [rad].
    pub fn angles(&self, t: f64) -> DVec3 {
        let [_, phi, theta, psi] = self.blend.read().expect("no writer panicked").angles(t);
        DVec3::new(phi[0], theta[0], psi[0])
    }
}

impl RotationLaw for CommandedMotion {
    fn at(&self, t: f64) -> MovingRotation {
        self.blend.read().expect("no writer panicked").at(t)
    }
}

/// What feedback remembers.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ControlState {
    /// Looks so far.
    pub looks: usize,
    /// Those at which the command stood at a limit.
    pub limited_looks: usize,
    /// Start of the present blend [s].
    pub since: f64,
    /// Command before the present blend, wing by wing.
    pub from: Vec<Adjustment>,
    /// Command at its end.
    pub to: Vec<Adjustment>,
    /// Commands under way, oldest first.
    pub queue: VecDeque<Vec<Adjustment>>,
    /// What the controller remembers \[units of the controller\].
    pub memory: Vec<f64>,
}

/// What wings go over to from the commands `now`: the `command` joins those under way, the oldest of these is
/// due, and actuators that lag go this `share` of the way to it.
pub fn due(
    queue: &mut VecDeque<Vec<Adjustment>>,
    command: Vec<Adjustment>,
    now: &[Adjustment],
    share: f64,
) -> Vec<Adjustment> {
    queue.push_back(command);
    let mut due = queue.pop_front().expect("one was just pushed");
    if share < 1.0 {
        let pairs = due.iter_mut().zip(now);
        pairs.for_each(|(due, now)| *due = now.toward(due, share));
    }
    due
}

/// Feedback in a flight: controller, latency, and the wings it moves.
pub struct FeedbackLoop {
    controller: Box<dyn Controller>,
    follows: bool,
    holds_attitude: bool,
    interval: usize,
    /// An interval [s].
    duration: f64,
    /// Share of the way to a command that actuators go within an interval.
    share: f64,
    wings: Vec<Arc<CommandedMotion>>,
    state: ControlState,
}

impl FeedbackLoop {
    /// Feedback of a flight of `setup` on `wings`.
    ///
    /// # Errors
    /// An interval that is too short; a flight that the controller refuses.
    pub fn new(
        setup: &FlightSetup,
        feedback: &Feedback,
        wings: Vec<Arc<CommandedMotion>>,
    ) -> Result<Self, FlightError> {
        if feedback.interval < MIN_INTERVAL {
            return Err(FlightError::setup(
                "control.interval",
                feedback.interval.to_string(),
                format!("looks must lie at least {MIN_INTERVAL} time steps apart"),
            ));
        }
        let none = vec![Adjustment::default(); wings.len()];
        let duration = feedback.interval as f64 * setup.time.step;
        Ok(Self {
            controller: feedback.controller.open(setup)?,
            follows: feedback.controller.follows(),
            holds_attitude: feedback.controller.holds_attitude(),
            interval: feedback.interval,
            duration,
            share: share(duration / feedback.lag),
            state: ControlState {
                from: none.clone(),
                to: none.clone(),
                queue: vec![none; feedback.latency].into(),
                ..ControlState::default()
            },
            wings,
        })
    }

    /// Whether the controller looks `steps` time steps after the release.
    pub fn looks_at(&self, steps: usize) -> bool {
        steps.is_multiple_of(self.interval)
    }

    /// What is remembered.
    pub fn state(&self) -> ControlState {
        ControlState {
            memory: self.controller.memory(),
            ..self.state.clone()
        }
    }

    /// Goes on from what was remembered.
    ///
    /// # Errors
    /// What is not the memory of this feedback.
    pub fn restore(&mut self, state: &ControlState) -> Result<(), FlightError> {
        let own = &self.state;
        let commands = [&state.from, &state.to].into_iter().chain(&state.queue);
        let wings = self.wings.len();
        if state.queue.len() != own.queue.len() || commands.into_iter().any(|c| c.len() != wings) {
            let due = own.queue.len();
            return Err(FlightError::misfit(
                format!("{} commands under way", state.queue.len()),
                format!("the case has {due}, of {wings} wings; {RESUME_AS_SAVED}"),
            ));
        }
        let restored = self.controller.restore(&state.memory);
        restored.map_err(|e| FlightError::misfit("what the controller remembers", e))?;
        self.state = state.clone();
        self.apply();
        Ok(())
    }

    /// The wings.
    pub fn wings(&self) -> &[Arc<CommandedMotion>] {
        &self.wings
    }

    /// Number of this look.
    pub fn look(&self) -> usize {
        self.state.looks
    }

    /// Looks so far at which the command stood at a limit.
    pub fn limited_looks(&self) -> usize {
        self.state.limited_looks
    }

    /// Commands in force at the end of the present blend, wing by wing.
    pub fn commands(&self) -> &[Adjustment] {
        &self.state.to
    }

    /// Where the flyer is to be at `time` [s] since the release, if the reference moves; before that is known, where
    /// it is `held`.
    pub fn reference(&self, time: f64, held: impl FnOnce() -> Aim) -> Option<Aim> {
        self.follows
            .then(|| self.controller.aim(time).unwrap_or_else(held))
    }

    /// Attitude R_NB of the root that is held `steps` time steps after the release, `time` [s], if it does not follow
    /// from that at the release: that of the newest look.
    pub fn attitude(&self, steps: usize, time: f64) -> Option<DMat3> {
        let attitude = self.controller.attitude(steps / self.interval, time);
        attitude.filter(|_| self.holds_attitude)
    }

    /// Angles of the wings at time `t` [s].
    pub fn angles(&self, t: f64) -> impl Iterator<Item = DVec3> {
        self.wings.iter().map(move |w| w.angles(t))
    }

    /// Whether the controller is given the air before each look.
    pub fn feels_air(&self) -> bool {
        self.controller.feels_air()
    }

    /// Gives it the air at the look that follows.
    pub fn feel(&mut self, air: Option<AirProbe>) {
        self.controller.feel(air);
    }

    /// Asks the controller at time `t` [s]; the blend to the command that is due begins.
    ///
    /// # Errors
    /// A controller that has no command; commands that are not finite, ask for another frequency, or are not one per
    /// wing.
    pub fn update(&mut self, t: f64, sensed: &Sensed) -> Result<(), FlightError> {
        let refused = |problem| FlightError::Control { time: t, problem };
        let command = self.controller.command(sensed).map_err(refused)?;
        self.check(&command, t)?;
        self.state.limited_looks += usize::from(self.controller.is_limited());
        let due = due(&mut self.state.queue, command, &self.state.to, self.share);
        self.state.from = std::mem::replace(&mut self.state.to, due);
        self.state.since = t;
        self.state.looks += 1;
        self.apply();
        Ok(())
    }

    fn apply(&self) {
        let commands = self.state.from.iter().zip(&self.state.to);
        for (wing, (from, to)) in self.wings.iter().zip(commands) {
            wing.pass(from, to, self.state.since, self.duration);
        }
    }

    fn check(&self, command: &[Adjustment], t: f64) -> Result<(), FlightError> {
        let wrong = |problem: String| Err(FlightError::Control { time: t, problem });
        if command.len() != self.wings.len() {
            let wings = self.wings.len();
            return wrong(format!("{} adjustments for {wings} wings", command.len()));
        }
        for (k, a) in command.iter().enumerate() {
            if let Some((name, x)) = a.numbers().iter().find(|(_, x)| !x.is_finite()) {
                return wrong(format!("{name} of wing {k} is not finite: {x}"));
            }
            if let Some((name, x)) = a.numbers().iter().find(|(_, x)| x.abs() > MAX_COMMAND) {
                return wrong(format!(
                    "{name} of wing {k} is {x:e}: no wing moves so; parts of the swing, angles in radians and leads in wingbeats are from -{MAX_COMMAND} to {MAX_COMMAND}: look at gains and units of the controller"
                ));
            }
            if a.frequency != 0.0 {
                return wrong(format!("wing {k}: the frequency cannot change in flight"));
            }
        }
        Ok(())
    }
}

/// Feedback of a setup that has it, and the wings it moves.
pub(crate) fn feedback(setup: &FlightSetup) -> Result<Option<FeedbackLoop>, FlightError> {
    let Some(feedback) = &setup.feedback else {
        return Ok(None);
    };
    if let Some(problem) = unsteered(setup) {
        return Err(FlightError::setup("control", "", problem));
    }
    let wings = setup.animal.wings.iter();
    let wings = wings.map(|w| Arc::new(CommandedMotion::new(w))).collect();
    Ok(Some(FeedbackLoop::new(setup, feedback, wings)?))
}

/// Why commands to the wings of `setup` would move nothing; none where they act.
fn unsteered(setup: &FlightSetup) -> Option<&'static str> {
    let wings = &setup.animal.wings;
    match &setup.air {
        _ if matches!(setup.mode, MotionMode::Tethered(_)) => Some(
            "the flyer is tethered, and feedback steers a free flight: set flight.mode = \"free\", or leave it out",
        ),
        _ if wings.is_empty() => Some(
            "a controller steers by the wings, and there are none: give wings, or leave it out",
        ),
        AirModel::Derivatives(_) => Some(
            "no wing steers in air that follows from a table of derivatives: choose another air.model, or leave it out",
        ),
        AirModel::None if wings.iter().all(|w| w.mass.mass == 0.0) => Some(
            "no wing without mass steers without air: choose another air.model, give the wings mass, or leave it out",
        ),
        _ => None,
    }
}
