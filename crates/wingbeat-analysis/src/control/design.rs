//! A controller that is laid out when its flight is built: about the trimmed flight of the same
//! animal in blade elements, whatever the air it then flies in.
//!
//! Blade elements are smooth and have no memory, so gains follow from the map of one wingbeat. What
//! disturbs a flight (applied loads, gusts) has no part in the layout; buoyancy has.
//!
//! A trimmed flight heads along n1. A flight that is held as it begins may head anywhere: it is laid out about that of
//! axes which are turned with it about the vertical, in which the stream blows as it does seen from the flyer.

use std::sync::Arc;

use wingbeat_flight::{
    AirModel, AppliedLoad, BladeOptions, ControlModel, Controller, FlightError, FlightSetup,
    MotionMode,
};
use wingbeat_math::{DMat3, DVec3, EulerSequence};

use crate::AnalysisError;
use crate::beat::level::Level;
use crate::control::departure::{Limits, Reference};
use crate::control::part::Orbit;
use crate::control::regulator::observer::ProcessNoise;
use crate::control::regulator::{Regulator, Timing, Weights};
use crate::control::route::Route;
use crate::control::sensors::Sensors;
use crate::control::stabiliser::{ProportionalDerivative, Stiffness};
use crate::control::steering::{Held, Law, Steering};
use crate::plausibility::lift_over_weight;
use crate::trim::problem::{TrimProblem, TrimSettings};
use crate::trim::{Trim, trim};

/// Which law, and how it is laid out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LawDesign {
    /// Proportional-derivative loops.
    Stabiliser(Stiffness),
    /// Linear-quadratic regulator.
    Regulator(Weights),
}

/// Which flight is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The trimmed flight: its attitude, and its stroke amplitude and mean stroke angle are commanded.
    Trimmed,
    /// The flight as it begins, with the strokes of the setup.
    Begun,
}

/// What a controller is laid out by.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// The law.
    pub law: LawDesign,
    /// What is held.
    pub target: Target,
    /// Blade elements in which the flight is trimmed.
    pub air: BladeOptions,
    /// Buoyancy, with which it is trimmed: constant loads along gravity, among those of the flight.
    pub buoyancy: Vec<AppliedLoad>,
    /// Mean velocity to fly with: along the heading of the flight that is held, to the right of it (none), down [m/s].
    /// A trimmed flight heads along n1: N components.
    pub velocity: DVec3,
    /// When is looked, and when acted.
    pub timing: Timing,
    /// Looks from one command to the next.
    pub every: usize,
    /// Largest commands.
    pub limits: Limits,
    /// Noise and bias of what is seen.
    pub sensors: Option<Sensors>,
    /// Noise of the flight for which the regulator's observer filters what is seen; none: no observer.
    pub observer: Option<ProcessNoise>,
    /// Where the flight that is held is brought to.
    pub route: Route,
}

impl Design {
    /// The trimmed flight about which the controller of a flight of `setup` is laid out; its beat begins where
    /// the flight, its strokes once risen, is after whole wingbeats: a smooth start makes them late, not the
    /// looks.
    ///
    /// # Errors
    /// A flight that has none, or that [`trim()`] does not cover.
    pub fn trim(&self, setup: &FlightSetup) -> Result<Trim, AnalysisError> {
        let turn = self.turn(setup);
        let body_pitch = match &setup.mode {
            MotionMode::Free(start) => match turn {
                None => start.angles.x,
                Some(turn) => {
                    let ahead = turn.transpose() * start.rotation();
                    EulerSequence::BODY_231.angles(ahead).x
                }
            },
            MotionMode::Tethered(motion) => motion.angles[0].constant,
        };
        let problem = TrimProblem {
            settings: self.settings(),
            ..TrimProblem::straight(self.velocity, body_pitch)
        };
        let mut plain = FlightSetup {
            air: AirModel::BladeElement(self.air.clone()),
            loads: self.buoyancy.clone(),
            feedback: None,
            ..setup.clone()
        };
        // The beat begins at the phase that the wings have at the looks of a beat's start, once they have risen.
        for wing in &mut plain.animal.wings {
            wing.motion = wing.motion.risen();
        }
        let laid_out = FlightSetup {
            air: AirModel::BladeElement(self.air_ahead(turn)),
            ..plain.clone()
        };
        let found = trim(&laid_out, &problem).map_err(symmetric)?;
        if found.solution.is_as_asked() {
            return Ok(found);
        }
        // Held as it begins it may fail already, which says more than what is left over.
        let cause = match lift_over_weight(&plain) {
            Err(e) => format!(
                "; held as it begins, the flight ends in its second wingbeat or before: {e}"
            ),
            Ok(_) => String::new(),
        };
        Err(AnalysisError::not_covered(
            format!(
                "no trimmed flight in blade elements was found to lay the controller out about: largest residual {:.1e} of weight, weight times wing length, radian and wing length per beat{cause}",
                found.solution.error()
            ),
            "see what `wingbeat trim` says with air.model = \"blade_element\"; start nearer to it (flight.pitch_deg, motion.stroke_plane_pitch_deg), or change motion.frequency_hz, control.forward_m_s or the weight",
        ))
    }

    /// Rotation about the vertical from the axes in which the layout heads along n1 to N; none where they are the same.
    fn turn(&self, setup: &FlightSetup) -> Option<DMat3> {
        /// Headings by rounding, of cases that were trimmed \[rad\].
        const ROUNDING: f64 = 1e-6;
        if self.target == Target::Trimmed {
            return None;
        }
        let released = EulerSequence::BODY_231.rotation(setup.angles_at_release());
        let level = Level::new(released, setup.gravity);
        let heading = level.heading();
        let down = level.to_n.z_axis;
        (heading.abs() > ROUNDING).then(|| DMat3::from_axis_angle(down, heading))
    }

    /// The air of the layout in axes that are turned to N by `turn`.
    fn air_ahead(&self, turn: Option<DMat3>) -> BladeOptions {
        let mut air = self.air.clone();
        if let Some(turn) = turn {
            for flow in [&mut air.blade.free_stream, &mut air.induced] {
                *flow = turn.transpose() * *flow;
            }
        }
        air
    }

    /// Mean velocity of the flight that is held, N components [m/s].
    fn velocity_in_n(&self, setup: &FlightSetup) -> DVec3 {
        self.turn(setup)
            .map_or(self.velocity, |turn| turn * self.velocity)
    }

    /// Steps that the looks divide.
    fn settings(&self) -> TrimSettings {
        let default = TrimSettings::default();
        TrimSettings {
            steps: default.steps.next_multiple_of(self.timing.parts),
            ..default
        }
    }

    /// The controller of a flight of `setup`.
    ///
    /// # Errors
    /// As [`Self::trim`]; a flight that the strokes cannot steer.
    pub fn steering(&self, setup: &FlightSetup) -> Result<Steering, AnalysisError> {
        let trim = self.trim(setup)?;
        let law = match &self.law {
            LawDesign::Stabiliser(stiffness) => {
                let loops = ProportionalDerivative::new(&trim, stiffness)?;
                Law::Stabiliser(loops.looking(self.timing.parts))
            }
            LawDesign::Regulator(weights) => {
                let regulator = Regulator::timed(&trim, weights, &self.timing)?;
                let noise = self.sensors.unwrap_or_default().noise;
                Law::Regulator(match &self.observer {
                    Some(process) => regulator.observed(&trim, process, &noise)?,
                    None => regulator,
                })
            }
        };
        let mut steering = match self.target {
            Target::Trimmed => Steering::new(law, Held::Known(Reference::trimmed(&trim)?), setup)
                .adjusted(&trim.solution.adjustment),
            Target::Begun => {
                let (gravity, velocity) = (setup.gravity, self.velocity_in_n(setup));
                Steering::new(law, Held::Begun { gravity, velocity }, setup)
            }
        };
        steering.limits = self.limits;
        steering.every = self.every;
        steering.sensors = self.sensors;
        steering.route = self.route.clone();
        steering.orbit = Orbit::new(&trim, self.timing.parts)?.points;
        Ok(steering)
    }
}

/// The error of a trim whose flight parts right from left, as who lays feedback out has to know it.
fn symmetric(e: AnalysisError) -> AnalysisError {
    match e {
        AnalysisError::Asymmetric { lateral, .. } => AnalysisError::Asymmetric {
            lateral,
            remedy: "feedback is laid out for symmetric flight: make right and left wings alike (no [wing.left] of its own, no motion.difference), and let the wind blow along the plane of symmetry (air.stream_m_s without a part across the heading, which is along n1, with control.hold = \"start\" that at the release) and the weight act (gravity without a part along n2); `control.controller = \"external\"` steers any flight",
        },
        e => e,
    }
}

impl ControlModel for Design {
    fn open(&self, setup: &FlightSetup) -> Result<Box<dyn Controller>, FlightError> {
        let law = match self.law {
            LawDesign::Stabiliser(_) => "stabiliser",
            LawDesign::Regulator(_) => "regulator",
        };
        let refused = |e: AnalysisError| FlightError::setup("control", law, e.to_string());
        Ok(Box::new(self.steering(setup).map_err(refused)?))
    }

    fn follows(&self) -> bool {
        !self.route.0.is_empty()
    }

    fn every(&self) -> usize {
        self.every
    }

    fn arrivals(&self) -> Vec<f64> {
        self.route.arrivals()
    }

    fn holds_attitude(&self) -> bool {
        self.target == Target::Trimmed
    }

    fn velocity(&self, setup: &FlightSetup) -> Option<DVec3> {
        Some(self.velocity_in_n(setup))
    }

    fn holds_only_altitude(&self) -> bool {
        matches!(self.law, LawDesign::Stabiliser(_))
    }

    fn redrawn(&self, by: u64) -> Option<Arc<dyn ControlModel>> {
        let sensors = self.sensors?.redrawn(by)?;
        Some(Arc::new(Self {
            sensors: Some(sensors),
            ..self.clone()
        }))
    }
}
