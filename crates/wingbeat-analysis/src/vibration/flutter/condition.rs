//! The elastic wings at one speed: steady state, response, modes.

use wingbeat_flight::{FlightSetup, FlightState, Simulation};

use super::disturbance::{ModalVelocities, Stations};
use super::images::images;
use super::response::{LINEAR, Response};
use super::sampling::Sampling;
use super::settings::FlutterSettings;
use super::steady::{ElasticRig, SteadyWing};
use super::uncertainty::uncertainties;
use crate::AnalysisError;
use crate::plausibility::slowest_on_springs;
use crate::progress;
use crate::vibration::realisation::{Realisation, Sampled, Vibration, realise_sampled};

/// An elastic wing at one speed.
#[derive(Clone, Debug)]
pub struct Condition {
    /// Speed of the stream [m/s].
    pub speed: f64,
    /// The deformed steady state.
    pub steady: SteadyWing,
    /// Motions found in the response, of rising frequency, those that take part with less than [`MIN_SHARE`] or
    /// than what is not linear, or hardly vibrate, left out.
    pub modes: Vec<Vibration>,
    /// What is not known of the growth of each of them [1/s] (see `uncertainty.rs`).
    pub uncertainty: Vec<f64>,
    /// Motions that take part as much and whose frequency is not known, as they appear in the samples.
    pub untold: Vec<Vibration>,
    /// The motion that grows fastest without vibrating, and what is not known of its growth [1/s]; none where
    /// none grows.
    pub divergence: Option<(Vibration, f64)>,
    /// The whole response as a linear system.
    pub response: Realisation,
    /// Difference to twice the response to half the disturbance, over the response \[1\].
    pub nonlinearity: f64,
    /// Disturbance of this response, [`FlutterSettings::disturbance`] or smaller \[1\].
    pub disturbance: f64,
    /// Length of this response \[s\].
    pub length: f64,
    /// The joint on whose springs what it carries vibrates most slowly, and the period \[s\], if that is longer than
    /// this response: what moves on it is not found.
    pub slow_joint: Option<(String, f64)>,
}

/// Least share in a response of a motion that is reported \[1\].
pub const MIN_SHARE: f64 = 1e-3;

/// Damping over critical above which a motion is that of the wake, or dies within a period \[1\].
pub const MAX_DAMPING: f64 = 0.8;

/// Most of that share below which motions are left out because the response is not linear \[1\]: with more, the
/// modes are told, and that they are doubtful.
const MAX_LEFT_OUT: f64 = 0.1;

/// Quarters of a response from which its modes are found a second time.
const KEPT: usize = 3;

/// The elastic wings of `setup` in its stream at `speed` [m/s], one after the other. Of wings that are deformed as mirror
/// images of each other only the first is taken: they are disturbed as mirror images, too, and answer so.
///
/// # Errors
/// No elastic wing; wings or a root that move; no stream, no wake; a steady state that is not reached; a
/// response that is too short; what flights and the identification report.
pub fn condition(
    setup: &FlightSetup,
    speed: f64,
    settings: &FlutterSettings,
) -> Result<Vec<Condition>, AnalysisError> {
    let rig = ElasticRig::new(setup, speed)?;
    progress::task("steady state", 0, 0);
    let (state, steady) = rig.to_steady(settings)?;
    let mut taken = Taken::from(&rig, state, steady, settings)?;
    for _ in 0..STEADIER {
        let of_the_base = taken.response.of_the_base();
        let drift = taken.steady.iter().map(|s| s.drift).fold(0.0, f64::max);
        if of_the_base <= LINEAR || drift == 0.0 {
            break;
        }
        progress::task("steady state", 0, 0);
        let next = 0.5 * drift * LINEAR / of_the_base;
        match rig.steadier(settings, taken.state.clone(), next) {
            Ok((state, steady)) => taken = Taken::from(&rig, state, steady, settings)?,
            Err(AnalysisError::NotSteady { .. }) => break, // by rounding: what is not linear is left out
            Err(e) => return Err(e),
        }
    }
    let Taken {
        steady,
        images,
        sampling,
        response: found,
        ..
    } = taken;
    let step = rig.setup.time.step;
    let length = sampling.length(step);
    let slow = |wing: usize| slowest_on_springs(setup, wing).filter(|(_, t)| *t > length);
    let wings = (0..images.len()).filter(|&k| images[k].is_none());
    let of_wing = |(place, k): (usize, usize)| {
        let found = found.outputs(place * Stations::OUTPUTS..(place + 1) * Stations::OUTPUTS);
        let identified = Identified::of(&found, step, &sampling)?;
        let modes = identified.modes();
        let uncertainty = identified.uncertainties(&modes)?;
        Ok(Condition {
            speed,
            modes,
            uncertainty,
            untold: identified.untold(),
            divergence: identified.divergence()?,
            steady: steady[k].clone(),
            nonlinearity: found.nonlinearity,
            disturbance: found.part * settings.disturbance,
            length,
            slow_joint: slow(steady[k].wing),
            response: identified.response,
        })
    };
    wings.enumerate().map(of_wing).collect()
}

impl Condition {
    /// Whether the wing diverges: a motion that does not vibrate grows, beyond what is known of it.
    pub fn diverges(&self) -> bool {
        (self.divergence.as_ref()).is_some_and(|(motion, uncertainty)| motion.growth > *uncertainty)
    }

    /// Whether mode `k` grows or dies out; none where its growth is neutral within what is known of it.
    pub fn grows(&self, k: usize) -> Option<bool> {
        let growth = self.modes[k].growth;
        (growth.abs() > self.uncertainty[k]).then_some(growth > 0.0)
    }
}

/// Most times that wings come further to rest because the undisturbed flight leaves where it began.
const STEADIER: usize = 3;

/// The response about a steady state.
struct Taken {
    state: FlightState,
    steady: Vec<SteadyWing>,
    /// Of each elastic wing the one that it is the mirror image of.
    images: Vec<Option<usize>>,
    sampling: Sampling,
    response: Response,
}

impl Taken {
    /// From the steady state `state`, in which the wings are `steady`.
    fn from(
        rig: &ElasticRig,
        state: FlightState,
        steady: Vec<SteadyWing>,
        settings: &FlutterSettings,
    ) -> Result<Self, AnalysisError> {
        progress::task("response", 0, 0);
        let images = images(rig, &state, &steady);
        let disturbance = ModalVelocities::new(rig, (&state, &images), settings)?;
        let sampling = Sampling::new(rig.setup.time.step, &steady, settings)?;
        let wings = (0..images.len()).filter(|&k| images[k].is_none());
        let stations: Vec<Stations> = wings.map(|k| Stations::of(rig, k)).collect();
        let start: Vec<f64> = stations.iter().flat_map(|s| s.outputs(&state)).collect();
        let response = Response::linear(&start, |part| {
            let from = disturbance.added(&state, part);
            flown(&rig.setup, from, &stations, &sampling)
        })?;
        Ok(Self {
            state,
            steady,
            images,
            sampling,
            response,
        })
    }
}

/// A response as a linear system, and others by which what is not known of it is judged.
struct Identified<'a> {
    response: Realisation,
    taken: Sampled<'a>,
    others: [Sampled<'a>; 2],
    /// Share below which motions are left out \[1\].
    least: f64,
}

impl<'a> Identified<'a> {
    /// From a response and twice that to half the disturbance, in steps of `step` [s]: to the first of the samplings by
    /// which all frequencies are known, or that by which the smallest share has unknown ones.
    fn of(found: &'a Response, step: f64, sampling: &Sampling) -> Result<Self, AnalysisError> {
        let mut best: Option<(f64, Self)> = None;
        for every in sampling.tried() {
            let next = Self::sampled(found, step, every)?;
            let unknown: f64 = next.untold().iter().map(|v| v.share).sum();
            if best.as_ref().is_none_or(|b| unknown < b.0) {
                best = Some((unknown, next));
            }
            if unknown == 0.0 {
                break;
            }
        }
        let none = || AnalysisError::Numbers("a response without samples".into());
        best.map(|b| b.1).ok_or_else(none)
    }

    /// By samples so many steps apart.
    fn sampled(found: &'a Response, step: f64, every: usize) -> Result<Self, AnalysisError> {
        let of = |steps: &'a [Vec<f64>]| Sampled { steps, step, every };
        let taken = of(&found.whole);
        let kept = KEPT * taken.count() / 4 * every;
        Ok(Self {
            response: realise_sampled(&taken)?,
            others: [of(&found.doubled), of(&found.whole[..kept])],
            taken,
            least: found.not_linear().clamp(MIN_SHARE, MAX_LEFT_OUT),
        })
    }

    /// Motions that take part and vibrate.
    fn modes(&self) -> Vec<Vibration> {
        let vibrates = |v: &&Vibration| {
            v.frequency > 0.0 && v.share >= self.least && v.damping() <= MAX_DAMPING
        };
        let found = self.response.vibrations.iter().filter(vibrates);
        found.copied().collect()
    }

    /// Motions that take part and may vibrate, whose frequency is not known.
    fn untold(&self) -> Vec<Vibration> {
        let all = self.response.untold.iter().copied();
        all.filter(|v| v.share >= self.least && v.damping() <= MAX_DAMPING)
            .collect()
    }

    /// The motion that grows fastest without vibrating, and what is not known of its growth [1/s].
    fn divergence(&self) -> Result<Option<(Vibration, f64)>, AnalysisError> {
        let grows = |v: &&Vibration| v.frequency == 0.0 && v.growth > 0.0 && v.share >= self.least;
        let growing = self.response.vibrations.iter().filter(grows).copied();
        let fastest = growing.max_by(|a, b| a.growth.total_cmp(&b.growth));
        fastest
            .map(|v| Ok((v, self.uncertainties(&[v])?[0])))
            .transpose()
    }

    /// What is not known of the growth of each of these motions [1/s].
    fn uncertainties(&self, modes: &[Vibration]) -> Result<Vec<f64>, AnalysisError> {
        uncertainties(modes, &self.response, &self.taken, &self.others)
    }
}

/// Outputs after each step of a flight that goes on from `state`.
fn flown(
    setup: &FlightSetup,
    state: FlightState,
    stations: &[Stations],
    sampling: &Sampling,
) -> Result<Vec<Vec<f64>>, AnalysisError> {
    let mut flight = Simulation::resume(setup.clone(), state)?;
    let mut samples = vec![];
    for _ in 0..sampling.steps() {
        flight.step()?;
        let outputs = stations.iter().flat_map(|s| s.outputs(flight.state()));
        samples.push(outputs.collect());
    }
    Ok(samples)
}
