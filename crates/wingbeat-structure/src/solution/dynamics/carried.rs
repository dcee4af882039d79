//! What nodes do to the frame that carries them.

use wingbeat_math::six_by_six::{transpose, unit};
use wingbeat_math::{DQuat, DVec3, Six, SixBySix, six};

use crate::nodes::block::pair;
use crate::nodes::configuration::{Configuration, NODE};

/// Force and moment about the origin of W, W components, of six numbers at every node: forces in W, moments in
/// node components.
pub fn resultant(at: &Configuration, numbers: &[f64]) -> [DVec3; 2] {
    let (mut force, mut moment) = (DVec3::ZERO, DVec3::ZERO);
    for (n, (u, r)) in at.position.iter().zip(&at.rotation).enumerate() {
        let [f, m] = pair(numbers, n);
        force += f;
        moment += u.cross(f) + *r * m;
    }
    [force, moment]
}

/// Force and moment about the origin of W by its acceleration and angular acceleration, six by six by rows, of
/// loads that follow the accelerations of the nodes by the matrix `by` (rows of 6 N numbers) and nothing else.
pub fn carried_by_frame(at: &Configuration, by: &[f64]) -> SixBySix {
    let mut carried = Carried::default();
    let columns = std::array::from_fn(|j| carried.follow(at, by, j));
    transpose(&columns)
}

/// Nodes that a frame carries along, six numbers each.
#[derive(Debug, Default)]
pub(super) struct Carried {
    /// Their accelerations.
    accelerations: Vec<f64>,
    /// Loads that follow these.
    pub loads: Vec<f64>,
}

impl Carried {
    /// For a unit acceleration of W along its axis j or, from 3 on, a unit angular acceleration about its axis
    /// j - 3: the loads that follow the accelerations of the nodes by the matrix `by`, and their resultant,
    /// which is returned.
    pub fn follow(&mut self, at: &Configuration, by: &[f64], j: usize) -> Six {
        let [linear, angular] = unit(j);
        let node =
            |(u, r): (&DVec3, &DQuat)| six(linear + angular.cross(*u), r.inverse() * angular);
        self.accelerations.clear();
        let nodes = at.position.iter().zip(&at.rotation);
        self.accelerations.extend(nodes.flat_map(node));
        let load = |row: &[f64]| {
            let both = row.iter().zip(&self.accelerations);
            both.map(|(b, x)| b * x).sum::<f64>()
        };
        self.loads.clear();
        self.loads
            .extend(by.chunks_exact(NODE * at.len()).map(load));
        let [force, moment] = resultant(at, &self.loads);
        six(force, moment)
    }
}

/// Room for the response to accelerations of W: blocks of each node.
#[derive(Debug, Default)]
pub(super) struct ResponseScratch {
    /// Map of the node's force and moment to the origin.
    pub to_root: Vec<SixBySix>,
    /// Derivative of its inertial force by the acceleration and angular acceleration of W.
    pub by_frame: Vec<SixBySix>,
    /// Derivative of the resultant of inertial forces less loads about the origin by its increments.
    pub rows: Vec<SixBySix>,
    pub carried: Carried,
}
