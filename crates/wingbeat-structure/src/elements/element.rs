//! What joins nodes elastically.

use wingbeat_math::{DVec3, MassProperties};

use crate::nodes::configuration::Configuration;

/// Internal force and tangent of one element, for its own nodes in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ElementForces {
    /// Derivative of the strain energy by the six numbers of each node (dx in W components, dtheta in node components)
    /// \[N, N m\].
    pub force: Vec<f64>,
    /// Derivative of `force` by the same numbers, row by row \[N/m, N, N m\].
    pub tangent: Vec<f64>,
}

impl ElementForces {
    /// Room for `numbers` of the nodes, all zero; allocates nothing if there was as much before.
    pub fn resize(&mut self, numbers: usize) {
        self.force.clear();
        self.force.resize(numbers, 0.0);
        self.tangent.clear();
        self.tangent.resize(numbers * numbers, 0.0);
    }
}

/// A point mass midway between two nodes: it moves as the mean of both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassBetween {
    /// The nodes.
    pub nodes: [usize; 2],
    /// Mass \[kg\].
    pub mass: f64,
}

impl MassBetween {
    /// About its own place.
    pub(crate) fn point(&self) -> MassProperties {
        MassProperties::point(self.mass, DVec3::ZERO)
    }
}

/// An element: strain energy between nodes.
pub trait Element: std::fmt::Debug + Send + Sync {
    /// Numbers of its nodes.
    fn nodes(&self) -> &[usize];

    /// Strain energy \[J\] in the configuration `at`, with its first derivative and, if `out.tangent` is asked for by
    /// `tangent`, its second into `out`.
    fn internal(&self, at: &Configuration, tangent: bool, out: &mut ElementForces) -> f64;

    /// Whether it has stress as built.
    fn is_stressed_at_rest(&self) -> bool {
        false
    }

    /// Fills `out.tangent` with the matrix that strain-rate damping multiplies: symmetric, positive
    /// semidefinite, and blind to rigid motion if energy is to be dissipated by nothing else than deformation.
    /// Unless an element says better, the symmetric part of its tangent, which is all of this at rest.
    fn dissipation(&self, at: &Configuration, out: &mut ElementForces) {
        self.internal(at, true, out);
        let n = out.force.len();
        for (i, j) in (0..n * n).map(|k| (k / n, k % n)).filter(|(i, j)| i < j) {
            let mean = 0.5 * (out.tangent[i * n + j] + out.tangent[j * n + i]);
            out.tangent[i * n + j] = mean;
            out.tangent[j * n + i] = mean;
        }
    }

    /// Adds to `tangent` (by rows) `factor` times the derivative of the damping force `C v` by the six numbers
    /// of the nodes, C the matrix of [`Self::dissipation`], the six rates v of each node held: damping forces
    /// turn with the element, and so do its rates of strain. The force that turns is that of rates of strain
    /// linear in v from the configuration `before`: `at` itself, or one that v was foreseen from, as in
    /// [`Self::tangent_ahead`]. Unless an element says better, nothing: Newton's iteration then needs more
    /// passes.
    fn add_dissipation_tangent(
        &self,
        (_at, _before): (&Configuration, &Configuration),
        _velocity: &[f64],
        _factor: f64,
        _tangent: &mut [f64],
    ) {
    }

    /// Fills `out.tangent` with the tangent in the configuration `at`, its stresses replaced by those that
    /// strains linear in the `increment` (six numbers of each of its nodes) from the configuration `before`
    /// would have. Thin elements that turn are stretched at second order by increments that strain nothing at
    /// first; with that stress in the tangent Newton's iteration goes astray [Magisano, Leonetti & Garcea 2017,
    /// Comput. Methods Appl. Mech. Engrg 313:986]. Unless an element says better, its tangent.
    fn tangent_ahead(
        &self,
        at: &Configuration,
        _before: &Configuration,
        _increment: &[f64],
        out: &mut ElementForces,
    ) {
        self.internal(at, true, out);
    }

    /// Adds the element's mass, lumped at its nodes, to the mass properties of all nodes, each about its node in node
    /// components at rest.
    fn add_mass(&self, rest: &Configuration, masses: &mut [MassProperties]);

    /// Its masses midway between nodes of its own, which those lumps lack.
    fn masses_between(&self) -> Vec<MassBetween> {
        vec![]
    }

    /// What all these masses lack of the element's first moment and inertia, about the origin of W in W components; they
    /// hold all of its mass. It stays where it is at rest and belongs to the frame.
    fn remainder(&self) -> MassProperties {
        MassProperties::ZERO
    }
}
