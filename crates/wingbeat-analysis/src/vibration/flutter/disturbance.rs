//! Small velocities in the modes of the deformed wings, and where the response is looked at.

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
pub(crate) struct ModalVelocities {
    velocity: Vec<Vec<f64>>,
}

impl ModalVelocities {
    /// The leading modes of each elastic wing about `state`, each of the amplitude that `settings` has; mirror
    /// images of wings before them (`image_of`) have theirs mirrored, or the opposite of that.
    ///
    /// # Errors
    /// Modes that cannot be found; wings that are to be disturbed against each other and are not two, or one half
    /// of the air computed.
    pub fn new(
        rig: &ElasticRig,
        (state, image_of): (&FlightState, &[Option<usize>]),
        settings: &FlutterSettings,
    ) -> Result<Self, AnalysisError> {
        let sense = if settings.antisymmetric { -1.0 } else { 1.0 };
        if settings.antisymmetric {
            check_antisymmetric(rig, image_of)?;
        }
        let mut velocity: Vec<Vec<f64>> = vec![];
        for (k, image_of) in image_of.iter().enumerate() {
            velocity.push(match image_of {
                Some(other) => mirrored(&velocity[*other], sense),
                None => in_modes(rig, state, k, settings)?,
            });
        }
        Ok(Self { velocity })
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

/// Velocities of elastic wing number `k` in its leading modes about `state`.
fn in_modes(
    rig: &ElasticRig,
    state: &FlightState,
    k: usize,
    settings: &FlutterSettings,
) -> Result<Vec<f64>, AnalysisError> {
    let leading = leading(rig, state, k, settings.modes)?;
    let size = rig.wing(k).structure().size();
    let mut velocity = vec![0.0; NODE * state.wings[k].structure.configuration.len()];
    for mode in &leading {
        let places = mode.shape.chunks_exact(NODE);
        let moves = |six: &[f64]| {
            let turn = DVec3::from_slice(&six[3..]).length();
            DVec3::from_slice(six).length().max(turn * size)
        };
        let largest = places.map(moves).fold(0.0, f64::max);
        let rate = settings.disturbance * size * mode.frequency() / largest;
        for (v, x) in velocity.iter_mut().zip(&mode.shape) {
            *v += rate * x;
        }
    }
    Ok(velocity)
}

/// Signs of the numbers of a node in its mirror image.
pub(super) const SIGNS: [f64; NODE] = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];

/// The mirror image of velocities, places in W, turns in node components; of sense -1 its opposite.
fn mirrored(velocity: &[f64], sense: f64) -> Vec<f64> {
    let numbers = velocity.iter().enumerate();
    numbers.map(|(k, v)| sense * SIGNS[k % NODE] * v).collect()
}

/// Refuses wings against each other where there are no two, or where the air is one half and its image.
fn check_antisymmetric(rig: &ElasticRig, image_of: &[Option<usize>]) -> Result<(), AnalysisError> {
    if rig.setup.air.is_mirrored() {
        return Err(AnalysisError::not_covered(
            "one half of the air is computed, so both sides move alike",
            "air.mirror = false",
        ));
    }
    match image_of.iter().any(Option::is_some) {
        true => Ok(()),
        false => Err(AnalysisError::not_covered(
            "no two elastic wings are deformed as mirror images of each other",
            "leave --antisymmetric out: wings that differ are looked at one by one",
        )),
    }
}

/// Nodes of an elastic wing that are looked at.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stations {
    wing: usize,
    nodes: Vec<usize>,
    rest: Vec<(DVec3, DQuat)>,
    size: f64,
}

impl Stations {
    /// Numbers that are taken of a wing.
    pub const OUTPUTS: usize = NODE * STATIONS;

    /// Of elastic wing number `wing`, equally far apart from each other in the order of its nodes, the last at the tip.
    pub fn of(rig: &ElasticRig, wing: usize) -> Self {
        let structure = rig.wing(wing).structure();
        let (last, rest) = (structure.nodes() - 1, structure.rest());
        let along = (1..STATIONS).map(|k| k * last / STATIONS);
        let nodes: Vec<usize> = along.chain([rig.wing(wing).tip_node()]).collect();
        let at = |&n: &usize| (rest.position[n], rest.rotation[n]);
        Self {
            wing,
            rest: nodes.iter().map(at).collect(),
            nodes,
            size: structure.size(),
        }
    }

    /// Displacements over the size of the wing and rotation vectors, W components.
    pub fn outputs(&self, state: &FlightState) -> Vec<f64> {
        let at = &state.wings[self.wing].structure.configuration;
        let of = |(&n, (x, r)): (&usize, &(DVec3, DQuat))| {
            let shift = (at.position[n] - *x) / self.size;
            let turn = rotation_vector(at.rotation[n] * r.inverse());
            [shift.to_array(), turn.to_array()].concat()
        };
        self.nodes.iter().zip(&self.rest).flat_map(of).collect()
    }
}
