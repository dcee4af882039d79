//! An elastic body: nodes, masses, elements, supports and damping.

use wingbeat_math::{DMat3, DVec3, MassProperties};

use crate::elements::element::{Element, MassBetween};
use crate::nodes::configuration::{Configuration, NODE};

/// Number of a held unknown in the order of the free ones.
pub(crate) const HELD: usize = usize::MAX;

/// Damping of an elastic body.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Damping {
    /// Time \[s\] by which rates of strain are multiplied (Kelvin and Voigt): the damping ratio of a mode of frequency
    /// omega [rad/s] is half this times omega.
    pub strain_rate: f64,
    /// Rate [1/s] by which momentum relative to the frame is multiplied: the damping ratio of a mode is half this over
    /// omega. Its reaction is on the body that carries the frame.
    pub mass: f64,
}

/// An elastic body, constant once built.
#[derive(Debug)]
pub struct Structure {
    pub(crate) rest: Configuration,
    pub(crate) masses: Vec<MassProperties>,
    pub(crate) between: Vec<MassBetween>,
    pub(crate) elements: Vec<Box<dyn Element>>,
    pub(crate) damping: Damping,
    /// Unknown of each of the six numbers of each node, or [`HELD`].
    pub(crate) unknown: Vec<usize>,
    /// Number (node and direction) of each unknown.
    pub(crate) number: Vec<usize>,
    /// Largest distance of unknowns of one element.
    pub(crate) band: usize,
    pub(crate) size: f64,
    /// Strain energy \[J\] at rest, from which that of other configurations is counted.
    pub(crate) rest_energy: f64,
}

impl Structure {
    /// The configuration at rest, in equilibrium without loads: as built, unless elements have a stress there
    /// that pulls at free edges, which then give way.
    pub fn rest(&self) -> &Configuration {
        &self.rest
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.rest.len()
    }

    /// Number of free unknowns.
    pub fn unknowns(&self) -> usize {
        self.number.len()
    }

    /// The number (six a node: place, attitude) that each free unknown is, in the order of the unknowns.
    pub fn free_numbers(&self) -> &[usize] {
        &self.number
    }

    /// Mass properties of the nodes, each about its node in node components.
    pub fn masses(&self) -> &[MassProperties] {
        &self.masses
    }

    /// Masses midway between two nodes, which those of the nodes lack.
    pub fn masses_between(&self) -> &[MassBetween] {
        &self.between
    }

    /// Its elements.
    pub fn elements(&self) -> &[Box<dyn Element>] {
        &self.elements
    }

    /// Its damping.
    pub fn damping(&self) -> Damping {
        self.damping
    }

    /// Largest extent \[m\] of the nodes at rest along an axis of W: what changes of places are measured by.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// Mass properties of the whole in a configuration, about the origin of W in W components.
    pub fn mass_properties(&self, at: &Configuration) -> MassProperties {
        let nodes = at.rotation.iter().zip(&at.position);
        let moved =
            |(m, (r, x)): (&MassProperties, (&_, &DVec3))| m.moved(DMat3::from_quat(*r), *x);
        let all = self.masses.iter().zip(nodes).map(moved);
        let point = |m: &MassBetween| {
            let [a, b] = m.nodes.map(|n| at.position[n]);
            MassProperties::point(m.mass, a.midpoint(b))
        };
        let all = all.chain(self.between.iter().map(point));
        all.fold(MassProperties::ZERO, |a, b| a + b)
    }

    /// What all these masses lack of first moment and inertia of the elements as built, about the origin of W in
    /// W components; no mass.
    pub fn remainder(&self) -> MassProperties {
        let elements = self.elements.iter().map(|e| e.remainder());
        elements.fold(MassProperties::ZERO, |a, b| a + b)
    }

    /// Node and direction of an unknown.
    pub(crate) fn direction(&self, unknown: usize) -> (usize, usize) {
        let number = self.number.get(unknown).copied().unwrap_or(0);
        (number / NODE, number % NODE)
    }
}
