//! An elastic wing held in a stream, and its deformed steady state.

use std::f64::consts::TAU;

use wingbeat_flight::elastic::{ElasticWing, ElasticWings};
use wingbeat_flight::{AirModel, FlightError, FlightSetup, FlightState, MotionMode, Simulation};
use wingbeat_math::{DVec3, rotation_vector};
use wingbeat_structure::{Configuration, FrameMotion, Mode, slowest_modes};

use super::settings::FlutterSettings;
use super::settling::{STEADY, Settling, drift};
use crate::AnalysisError;
use crate::vibration::moving::{enough, moving};

/// Steps of the setup in a long step.
const LONG: usize = 4;

/// Long steps before the steady state is looked at, a quarter of the short ones after them.
const LEAST: usize = 60;

/// Part of a period of the slowest mode before which a wing that ends has not diverged: loads bend it that were there at
/// once.
const SUDDEN: f64 = 0.25;

/// Difference of two shapes, or of two frequencies, that is none \[1\].
pub(super) const SAME: f64 = 1e-6;

/// The deformed steady state of an elastic wing.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyWing {
    /// Number of the wing.
    pub wing: usize,
    /// Displacement of the tip, wing components \[m\].
    pub tip: DVec3,
    /// Rotation vector of the tip, wing components \[rad\].
    pub turn: DVec3,
    /// Displacement \[m\] and rotation vector \[rad\] of the tip under weight alone, the wing as it is held, wing
    /// components; none where it has no equilibrium so.
    pub by_weight: Option<[DVec3; 2]>,
    /// Velocity of the fastest node of all elastic wings that is left over that of the stream \[1\].
    pub drift: f64,
    /// Angular frequencies of the leading modes about it without air [rad/s].
    pub vacuum: Vec<f64>,
}

impl SteadyWing {
    /// What the air adds to the displacement \[m\] and the rotation vector \[rad\] of the tip under weight alone.
    pub fn by_air(&self) -> Option<[DVec3; 2]> {
        let [tip, turn] = self.by_weight?;
        Some([self.tip - tip, self.turn - turn])
    }
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

    /// Whether a steady state is sought at all: `setup` is none of what [`Self::new`] refuses at its own speed.
    pub fn covers(setup: &FlightSetup) -> bool {
        let speed = setup.air.stream().map_or(0.0, |s| s.length());
        Self::new(setup, speed).is_ok()
    }

    /// Elastic wing number `k`.
    pub(super) fn wing(&self, k: usize) -> &ElasticWing {
        &self.elastic.wings()[k]
    }

    /// How many elastic wings there are.
    pub(super) fn count(&self) -> usize {
        self.elastic.wings().len()
    }

    /// Flies to the steady state: much damping, long steps, then those of the setup. Returns with it how each elastic
    /// wing is deformed.
    ///
    /// # Errors
    /// A steady state that is not reached, what the flight reports.
    pub fn to_steady(
        &self,
        settings: &FlutterSettings,
    ) -> Result<(FlightState, Vec<SteadyWing>), AnalysisError> {
        let slowest = self.slowest(settings)?;
        let (settling, period) = (self.settling(&slowest, settings), period(&slowest));
        let ended = |e| self.ended(e, period);
        // Steps that are too long for loads that act at once are none where a flight of the setup is.
        let long = match settling(LONG, LEAST, STEADY).to_rest(None) {
            Err(AnalysisError::Flight(e)) if is_sudden(&e, period) => None,
            found => Some(found.map_err(ended)?),
        };
        let found = settling(1, 4 * LEAST, STEADY).to_rest(long);
        self.with_shapes(found.map_err(ended)?, settings)
    }

    /// The same from `state`, which is steady, on to where the fastest node moves by `drift` of the speed of the stream.
    ///
    /// # Errors
    /// As [`Self::to_steady`].
    pub(super) fn steadier(
        &self,
        settings: &FlutterSettings,
        state: FlightState,
        drift: f64,
    ) -> Result<(FlightState, Vec<SteadyWing>), AnalysisError> {
        let slowest = self.slowest(settings)?;
        let further = self.settling(&slowest, settings)(1, 0, drift);
        let found = further.to_rest(Some(state));
        self.with_shapes(
            found.map_err(|e| self.ended(e, period(&slowest)))?,
            settings,
        )
    }

    /// Angular frequencies of the two slowest modes of each elastic wing at the start of the setup [rad/s].
    fn slowest(&self, settings: &FlutterSettings) -> Result<Vec<[f64; 2]>, AnalysisError> {
        let built = Simulation::new(self.damped(1, &vec![[0.0; 2]; self.count()]))?;
        let slowest = |k: usize| -> Result<[f64; 2], AnalysisError> {
            let modes = leading(self, built.state(), k, settings.modes)?;
            Ok([0, 1].map(|m| modes[m.min(modes.len() - 1)].frequency()))
        };
        let mut slowest: Vec<[f64; 2]> =
            (0..self.count()).map(slowest).collect::<Result<_, _>>()?;
        same_where_alike(&mut slowest);
        Ok(slowest)
    }

    /// How wings come to rest that have these slowest modes: in steps so many times as long, after so many at least, where
    /// they move no faster than so.
    fn settling(
        &self,
        slowest: &[[f64; 2]],
        settings: &FlutterSettings,
    ) -> impl Fn(usize, usize, f64) -> Settling {
        let damping: Vec<[f64; 2]> = slowest.iter().map(|[a, b]| [1.0 / b, *a]).collect();
        let period = period(slowest);
        move |long, least, steady| Settling {
            setup: self.damped(long, &damping),
            speed: self.speed,
            sizes: (self.elastic.wings().iter())
                .map(|w| w.structure().size())
                .collect(),
            period,
            least,
            most: settings.settling,
            steady,
        }
    }

    /// A steady state, and how each elastic wing is deformed in it.
    fn with_shapes(
        &self,
        state: FlightState,
        settings: &FlutterSettings,
    ) -> Result<(FlightState, Vec<SteadyWing>), AnalysisError> {
        let weighs = self.setup.gravity != DVec3::ZERO;
        let flight = weighs.then(|| Simulation::resume(self.setup.clone(), state.clone()));
        let flight = flight.transpose()?;
        let wings = (0..self.count()).map(|k| self.steady(&state, (k, flight.as_ref()), settings));
        let steady = wings.collect::<Result<_, _>>()?;
        Ok((state, steady))
    }

    /// The error of a flight to the steady state, of which the speed is said; `period` of the slowest mode \[s\].
    fn ended(&self, error: AnalysisError, period: f64) -> AnalysisError {
        let AnalysisError::Flight(error) = error else {
            return error;
        };
        if matches!(error, FlightError::Setup { .. }) {
            return AnalysisError::Flight(error);
        }
        AnalysisError::NoSteadyState {
            speed: self.speed,
            is_sudden: is_sudden(&error, period),
            error,
        }
    }

    /// The setup with other steps and damping added, by strain rate and by mass of each elastic wing.
    fn damped(&self, long: usize, damping: &[[f64; 2]]) -> FlightSetup {
        let mut setup = self.setup.clone();
        setup.time.step *= long as f64;
        let wings = setup.animal.wings.iter_mut();
        let structures = wings.filter_map(|w| w.structure.as_mut());
        for (structure, [strain_rate, mass]) in structures.zip(damping) {
            structure.damping.strain_rate += strain_rate;
            structure.damping.mass += mass;
        }
        if let AirModel::VortexLattice(options) = &mut setup.air {
            let rows = &mut options.lattice.max_rows;
            *rows = rows.map(|r| r.div_ceil(long));
        }
        setup
    }

    /// Elastic wing number `k`; the `flight` in the same state where it has weight.
    fn steady(
        &self,
        state: &FlightState,
        (k, flight): (usize, Option<&Simulation>),
        settings: &FlutterSettings,
    ) -> Result<SteadyWing, AnalysisError> {
        let rest = self.wing(k).structure().rest();
        let tip = self.wing(k).tip_node();
        let tip_moved = |at: &Configuration| {
            [
                at.position[tip] - rest.position[tip],
                rotation_vector(at.rotation[tip] * rest.rotation[tip].inverse()),
            ]
        };
        let [tip, turn] = tip_moved(&state.wings[k].structure.configuration);
        let modes = leading(self, state, k, settings.modes)?;
        Ok(SteadyWing {
            wing: self.wing(k).wing(),
            tip,
            turn,
            by_weight: match flight {
                Some(flight) => flight.bent_by_weight(k).ok().as_ref().map(tip_moved),
                None => Some([DVec3::ZERO; 2]),
            },
            drift: drift(state, self.speed),
            vacuum: modes.iter().map(Mode::frequency).collect(),
        })
    }
}

/// Period of the slowest of all modes \[s\].
fn period(slowest: &[[f64; 2]]) -> f64 {
    TAU / slowest.iter().map(|s| s[0]).fold(f64::INFINITY, f64::min)
}

/// Makes frequencies of wings that differ by rounding the same: mirror images stay so to the last bit.
fn same_where_alike(all: &mut [[f64; 2]]) {
    for k in 1..all.len() {
        let (before, here) = (&all[..k], all[k]);
        let is_alike = |other: &&[f64; 2]| (0..2).all(|m| (other[m] / here[m] - 1.0).abs() < SAME);
        if let Some(&other) = before.iter().find(is_alike) {
            all[k] = other;
        }
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

/// Leading modes in vacuum of elastic wing number `k` about a state.
pub(super) fn leading(
    rig: &ElasticRig,
    state: &FlightState,
    k: usize,
    count: usize,
) -> Result<Vec<Mode>, AnalysisError> {
    let (wing, at) = (rig.wing(k), &state.wings[k].structure.configuration);
    let still = (&FrameMotion::REST, None);
    let found = slowest_modes(wing.structure(), at, still, &enough(wing, count));
    let mut found = found.map_err(FlightError::from)?.modes;
    found.retain(|m| m.square > 0.0);
    let found = moving(wing, found, count).modes;
    match found.is_empty() {
        true => Err(AnalysisError::Numbers("the wing has no vibration".into())),
        false => Ok(found),
    }
}

/// Whether a flight has ended so early, beside the period \[s\] of the slowest mode, that its wing has not diverged.
fn is_sudden(error: &FlightError, period: f64) -> bool {
    matches!(error, FlightError::ElasticNotConverged { time, .. } if *time < SUDDEN * period)
}
