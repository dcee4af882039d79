//! A controller that is laid out when its flight is built: about the trimmed flight of the same
//! animal in blade elements, whatever the air it then flies in.
//!
//! Blade elements are smooth and have no memory, so gains follow from the map of one wingbeat. What
//! disturbs a flight (applied loads, gusts) has no part in the layout.

use std::sync::Arc;

use wingbeat_flight::{
    AirModel, BladeOptions, ControlModel, Controller, FlightError, FlightSetup, MotionMode,
};
use wingbeat_math::DVec3;

use crate::AnalysisError;
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
    /// Mean velocity to fly with, N components, in the plane n1-n3 [m/s].
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
        let body_pitch = match &setup.mode {
            MotionMode::Free(start) => start.angles.x,
            MotionMode::Tethered(motion) => motion.angles[0].constant,
        };
        let problem = TrimProblem {
            settings: self.settings(),
            ..TrimProblem::straight(self.velocity, body_pitch)
        };
        let mut plain = FlightSetup {
            air: AirModel::BladeElement(self.air.clone()),
            loads: vec![],
            feedback: None,
            ..setup.clone()
        };
        // The beat begins at the phase that the wings have at the looks of a beat's start, once they have risen.
        for wing in &mut plain.animal.wings {
            wing.motion = wing.motion.risen();
        }
        let found = trim(&plain, &problem).map_err(symmetric)?;
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
                let (gravity, velocity) = (setup.gravity, self.velocity);
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
            remedy: "feedback is laid out for symmetric flight: make right and left wings alike (no [wing.left] of its own, no motion.difference), and let the wind blow along the plane of symmetry (air.stream_m_s without a part along n2); `control.controller = \"external\"` steers any flight",
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

    fn holds_attitude(&self) -> bool {
        self.target == Target::Trimmed
    }

    fn velocity(&self) -> Option<DVec3> {
        Some(self.velocity)
    }

    fn redrawn(&self, by: u64) -> Option<Arc<dyn ControlModel>> {
        let sensors = self.sensors?.redrawn(by)?;
        Some(Arc::new(Self {
            sensors: Some(sensors),
            ..self.clone()
        }))
    }
}
