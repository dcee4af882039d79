//! Wings whose shape is the mirror image of another's, in air of which one half is computed.
//!
//! With P the half turn about axis 2 of the wings, whose negative is the mirror, a node with the place u and
//! the attitude R has its image at `-P u` with the attitude `P R Q`, Q the proper rotation by which it is so at
//! rest. Velocities v and forces go over as places do; angular velocities and moments, in node components, by
//! `Q^T`.

use wingbeat_dynamics::{AddedMass, Wrench};
use wingbeat_math::six_by_six::from_entries;
use wingbeat_math::{DMat3, DQuat, DVec3, mirrored, mirrored_axial, six};
use wingbeat_structure::{Configuration, NODE, State};

/// The half turn P, as a quaternion and about axis 2.
const HALF_TURN: DQuat = DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0);

/// Whose image a wing is, and how attitudes of the nodes go over.
#[derive(Clone, Debug)]
pub(super) struct Image {
    /// Place of the original among the elastic wings.
    pub of: usize,
    /// Q of every node.
    turns: Vec<DQuat>,
}

impl Image {
    /// Of the elastic wing number `of`, the nodes at rest of both being mirror images.
    pub fn new(of: usize, original: &Configuration, image: &Configuration) -> Self {
        let both = original.rotation.iter().zip(&image.rotation);
        let turn = |(r, of_image): (&DQuat, &DQuat)| (HALF_TURN * *r).inverse() * *of_image;
        Self {
            of,
            turns: both.map(turn).collect(),
        }
    }

    /// Places and attitudes.
    pub fn configuration(&self, of: &Configuration, out: &mut Configuration) {
        let places = out.position.iter_mut().zip(&of.position);
        places.for_each(|(to, u)| *to = mirrored(*u));
        let attitudes = out.rotation.iter_mut().zip(&of.rotation);
        for ((to, r), turn) in attitudes.zip(&self.turns) {
            *to = HALF_TURN * *r * *turn;
        }
    }

    /// What an elastic body remembers.
    pub fn state(&self, of: &State, out: &mut State) {
        self.configuration(&of.configuration, &mut out.configuration);
        self.numbers(&of.velocity, &mut out.velocity);
        self.numbers(&of.acceleration, &mut out.acceleration);
        self.numbers(&of.algorithmic, &mut out.algorithmic);
        (out.dissipated, out.dissipation) = (of.dissipated, of.dissipation);
    }

    /// Six numbers a node: velocities, accelerations or loads.
    pub fn numbers(&self, of: &[f64], out: &mut [f64]) {
        let nodes = out.chunks_exact_mut(NODE).zip(of.chunks_exact(NODE));
        for ((to, six), turn) in nodes.zip(&self.turns) {
            let linear = mirrored(DVec3::from_slice(six));
            let angular = turn.inverse() * DVec3::from_slice(&six[3..]);
            linear.write_to_slice(to);
            angular.write_to_slice(&mut to[3..]);
        }
    }
}

/// The image of a load on a wing of the attitude `from` on one of the attitude `to`, both in N components.
pub(super) fn reflected(load: &Wrench, from: DMat3, to: DMat3) -> Wrench {
    load.turned(from.transpose()).mirrored().turned(to)
}

/// The image of an added mass as that of another `body`.
pub(super) fn reflected_mass(mass: &AddedMass, body: usize) -> AddedMass {
    let (of, sign) = (
        mass.matrix(),
        six(mirrored(DVec3::ONE), mirrored_axial(DVec3::ONE)),
    );
    AddedMass::new(body, from_entries(|i, j| sign[i] * sign[j] * of[i][j]))
}
