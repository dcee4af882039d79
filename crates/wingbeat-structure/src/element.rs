//! What joins nodes elastically.

use wingbeat_math::MassProperties;

use crate::configuration::Configuration;

/// Internal force and tangent of one element, for its own nodes in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ElementForces {
    /// Derivative of the strain energy by the six numbers of each node (dx in W components, dtheta in node components)
    /// \[N, N m\].
    pub force: Vec<f64>,
    /// Derivative of `force` by the same numbers, row by row.
    pub tangent: Vec<f64>,
}

/// An element: strain energy between nodes.
pub trait Element: std::fmt::Debug + Send + Sync {
    /// Numbers of its nodes.
    fn nodes(&self) -> &[usize];

    /// Strain energy \[J\] in the configuration `at`, with its first derivative and, if `out.tangent` is asked for by
    /// `tangent`, its second into `out`.
    fn internal(&self, at: &Configuration, tangent: bool, out: &mut ElementForces) -> f64;

    /// Adds the element's mass, lumped at its nodes, to the mass properties of all nodes, each about its node in node
    /// components at rest.
    fn add_mass(&self, rest: &Configuration, masses: &mut [MassProperties]);
}
