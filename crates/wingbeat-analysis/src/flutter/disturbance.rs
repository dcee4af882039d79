//! Small velocities in the modes of the deformed wing, and where the response is looked at.

use wingbeat_flight::FlightState;
use wingbeat_math::{DQuat, DVec3, rotation_vector};
use wingbeat_structure::NODE;

use super::settings::FlutterSettings;
use super::steady::{ElasticRig, leading};
use crate::AnalysisError;

/// Stations along the span at which outputs are taken.
const STATIONS: usize = 4;

/// Velocities to be added, wing by wing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Disturbance {
    velocity: Vec<Vec<f64>>,
}

impl Disturbance {
    /// The leading modes of the first elastic wing about `state`, each of the amplitude that `settings` has;
    /// other wings have its mirror image or do as it does.
    ///
    /// # Errors
    /// Modes that cannot be found.
    pub fn new(
        rig: &ElasticRig,
        state: &FlightState,
        settings: &FlutterSettings,
    ) -> Result<Self, AnalysisError> {
        let leading = leading(rig, state, settings.modes)?;
        let size = rig.first().structure().size();
        let mut first = vec![0.0; NODE * state.wings[0].structure.configuration.len()];
        for mode in &leading {
            let places = mode.shape.chunks_exact(NODE);
            let moves = |six: &[f64]| {
                let turn = DVec3::from_slice(&six[3..]).length();
                DVec3::from_slice(six).length().max(turn * size)
            };
            let largest = places.map(moves).fold(0.0, f64::max);
            let rate = settings.disturbance * size * mode.frequency() / largest;
            for (v, x) in first.iter_mut().zip(&mode.shape) {
                *v += rate * x;
            }
        }
        let velocity = rig.mirrored().map(|other| match other {
            true => mirrored(&first),
            false => first.clone(),
        });
        Ok(Self {
            velocity: velocity.collect(),
        })
    }

    /// `state` with `part` of the disturbance.
    pub fn added(&self, state: &FlightState, part: f64) -> FlightState {
        let mut state = state.clone();
        for (wing, added) in state.wings.iter_mut().zip(&self.velocity) {
            let numbers = wing.structure.velocity.iter_mut().zip(added);
            numbers.for_each(|(v, x)| *v += part * x);
        }
        state
    }
}

/// The mirror image of velocities: places in W, turns in node components.
fn mirrored(velocity: &[f64]) -> Vec<f64> {
    const SIGNS: [f64; NODE] = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
    let numbers = velocity.iter().enumerate();
    numbers.map(|(k, v)| SIGNS[k % NODE] * v).collect()
}

/// Nodes of the first elastic wing that are looked at.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stations {
    nodes: Vec<usize>,
    rest: Vec<(DVec3, DQuat)>,
    size: f64,
}

impl Stations {
    /// Equally far apart from each other, the last at the tip.
    pub fn of(rig: &ElasticRig) -> Self {
        let structure = rig.first().structure();
        let (last, rest) = (structure.nodes() - 1, structure.rest());
        let nodes: Vec<usize> = (1..=STATIONS).map(|k| k * last / STATIONS).collect();
        let at = |&n: &usize| (rest.position[n], rest.rotation[n]);
        Self {
            rest: nodes.iter().map(at).collect(),
            nodes,
            size: structure.size(),
        }
    }

    /// Displacements over the size of the wing and rotation vectors, W components.
    pub fn outputs(&self, state: &FlightState) -> Vec<f64> {
        let at = &state.wings[0].structure.configuration;
        let of = |(&n, (x, r)): (&usize, &(DVec3, DQuat))| {
            let shift = (at.position[n] - *x) / self.size;
            let turn = rotation_vector(at.rotation[n] * r.inverse());
            [shift.to_array(), turn.to_array()].concat()
        };
        self.nodes.iter().zip(&self.rest).flat_map(of).collect()
    }
}
