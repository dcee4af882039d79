//! An elastic wing held in a stream, and its deformed steady state.

use std::f64::consts::TAU;

use wingbeat_flight::elastic::{ElasticWing, ElasticWings};
use wingbeat_flight::{AirModel, FlightSetup, FlightState, MotionMode, Simulation};
use wingbeat_math::{DVec3, rotation_vector};
use wingbeat_structure::{FrameMotion, Mode, modes};

use super::settings::FlutterSettings;
use super::settling::{Settling, drift};
use crate::AnalysisError;
use crate::moving::moving;

/// Steps of the setup in a long step.
const LONG: usize = 4;

/// Long steps before the steady state is looked at, a quarter of the short ones after them.
const LEAST: usize = 60;

/// The deformed steady state.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyWing {
    /// Displacement of the tip of the first elastic wing, wing components \[m\].
    pub tip: DVec3,
    /// Rotation vector of the tip, wing components \[rad\].
    pub turn: DVec3,
    /// Velocity of the fastest node that is left over that of the stream \[1\].
    pub drift: f64,
    /// Angular frequencies of the leading modes about it without air [rad/s].
    pub vacuum: Vec<f64>,
}

/// Elastic wings held in a stream of one speed.
pub struct ElasticRig {
    /// The setup at that speed.
    pub setup: FlightSetup,
    elastic: ElasticWings,
    speed: f64,
}

impl ElasticRig {
    /// `setup` with its stream at `speed` [m/s], the step so that the stream passes the same way in it.
    ///
    /// # Errors
    /// What flutter is not sought in.
    pub fn new(setup: &FlightSetup, speed: f64) -> Result<Self, AnalysisError> {
        let mut setup = setup.clone();
        check(&setup)?;
        let stream = setup.air.stream_mut().map_or(0.0, |s| {
            let before = s.length();
            *s *= speed / before;
            before
        });
        if !(stream > 0.0 && speed > 0.0) {
            return Err(AnalysisError::not_covered(
                "there is no stream",
                "give air.stream_m_s, whose direction and way per step are kept, and speeds above 0",
            ));
        }
        setup.time.step *= stream / speed;
        setup.time.steps = usize::MAX;
        let elastic = ElasticWings::new(&setup.animal, setup.gravity)?;
        Ok(Self {
            setup,
            elastic,
            speed,
        })
    }

    /// The first elastic wing.
    pub fn first(&self) -> &ElasticWing {
        &self.elastic.wings()[0]
    }

    /// Of each elastic wing whether it is on the other side than the first.
    pub fn mirrored(&self) -> impl Iterator<Item = bool> + '_ {
        let side = |w: &ElasticWing| self.setup.animal.wings[w.wing()].side;
        let first = side(self.first());
        (self.elastic.wings().iter()).map(move |w| side(w) != first)
    }

    /// Flies to the steady state: much damping, long steps, then those of the setup.
    ///
    /// # Errors
    /// A steady state that is not reached, what the flight reports.
    pub fn to_steady(
        &self,
        settings: &FlutterSettings,
    ) -> Result<(FlightState, SteadyWing), AnalysisError> {
        let built = Simulation::new(self.damped(1, [0.0; 2]))?;
        let rest = leading(self, built.state(), settings.modes)?;
        let [first, second] = [0, 1].map(|k| rest[k.min(rest.len() - 1)].frequency());
        let damping = [1.0 / second, first];
        let settling = |long: usize, least: usize| Settling {
            setup: self.damped(long, damping),
            speed: self.speed,
            size: self.first().structure().size(),
            period: TAU / first,
            least,
            most: settings.settling,
        };
        let long = settling(LONG, LEAST).to_rest(None)?;
        let state = settling(1, 4 * LEAST).to_rest(Some(long))?;
        let steady = self.steady(&state, settings)?;
        Ok((state, steady))
    }

    /// The setup with other steps and damping added.
    fn damped(&self, long: usize, [strain_rate, mass]: [f64; 2]) -> FlightSetup {
        let mut setup = self.setup.clone();
        setup.time.step *= long as f64;
        for wing in &mut setup.animal.wings {
            if let Some(structure) = &mut wing.structure {
                structure.damping.strain_rate += strain_rate;
                structure.damping.mass += mass;
            }
        }
        if let AirModel::VortexLattice(options) = &mut setup.air {
            let rows = &mut options.lattice.max_rows;
            *rows = rows.map(|r| r.div_ceil(long));
        }
        setup
    }

    fn steady(
        &self,
        state: &FlightState,
        settings: &FlutterSettings,
    ) -> Result<SteadyWing, AnalysisError> {
        let (at, rest) = (
            &state.wings[0].structure.configuration,
            self.first().structure().rest(),
        );
        let tip = at.len() - 1;
        let modes = leading(self, state, settings.modes)?;
        Ok(SteadyWing {
            tip: at.position[tip] - rest.position[tip],
            turn: rotation_vector(at.rotation[tip] * rest.rotation[tip].inverse()),
            drift: drift(state, self.speed),
            vacuum: modes
                .iter()
                .map(wingbeat_structure::Mode::frequency)
                .collect(),
        })
    }
}

/// An error for what flutter is not sought in.
fn check(setup: &FlightSetup) -> Result<(), AnalysisError> {
    let wings = &setup.animal.wings;
    // Before anything that holding the body would mend.
    if wings.iter().all(|w| w.structure.is_none()) {
        return Err(AnalysisError::not_covered(
            "no wing is elastic",
            "give one a structure: [wing.NAME.structure]",
        ));
    }
    let MotionMode::Tethered(motion) = &setup.mode else {
        return Err(AnalysisError::not_covered(
            "the flight is free",
            "hold the body: flight.mode = \"tethered\"",
        ));
    };
    let is_held = motion.rests();
    let changes = (setup.air.wind()).is_some_and(|w| !w.gusts.is_empty() || w.street.is_some());
    let refused = [
        (
            wings.iter().any(|w| w.motion.frequency > 0.0),
            "the wings beat",
            "leave motion.frequency_hz out: flutter is sought of wings that are held in a stream",
        ),
        (
            !is_held,
            "the body moves",
            "leave its velocity and the motion of the tether out; the stream is air.stream_m_s",
        ),
        (
            !(matches!(setup.air, AirModel::VortexLattice(_)) || setup.air.has_strip_wakes()),
            "the air has no wakes",
            "air.model = \"vortex_lattice\", or blade elements with air.blade.unsteady",
        ),
        (
            changes,
            "the air changes with time (gusts, turbulence, a vortex street)",
            "leave air.gust and air.vortex_street out, or fly it with `run`",
        ),
    ];
    match refused.into_iter().find(|r| r.0) {
        Some((_, what, remedy)) => Err(AnalysisError::not_covered(what, remedy)),
        None => Ok(()),
    }
}

/// Leading modes in vacuum of the first elastic wing about a state.
pub(super) fn leading(
    rig: &ElasticRig,
    state: &FlightState,
    count: usize,
) -> Result<Vec<Mode>, AnalysisError> {
    let at = &state.wings[0].structure.configuration;
    let found = modes(rig.first().structure(), at, &FrameMotion::REST, None);
    let mut found = found.map_err(wingbeat_flight::FlightError::from)?;
    found.retain(|m| m.square > 0.0);
    let found = moving(rig.first(), found, count).modes;
    match found.is_empty() {
        true => Err(AnalysisError::Numbers("the wing has no vibration".into())),
        false => Ok(found),
    }
}
