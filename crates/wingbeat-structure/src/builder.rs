//! How an elastic body is put together: its parts, their checks, its rest.

use wingbeat_math::{DVec3, MassProperties, largest};

use crate::elements::element::{Element, ElementForces};
use crate::error::StructureError;
use crate::nodes::configuration::{Configuration, NODE};
use crate::nodes::frame::FrameMotion;
use crate::solution::matrix::order;
use crate::solution::statics::{StaticSettings, equilibrium};
use crate::structure::{Damping, HELD, Structure};

/// Collects the parts of a [`Structure`].
#[derive(Debug, Default)]
pub struct StructureBuilder {
    rest: Configuration,
    masses: Vec<(usize, MassProperties)>,
    elements: Vec<Box<dyn Element>>,
    held: Vec<(usize, [bool; NODE])>,
    damping: Damping,
}

impl StructureBuilder {
    /// Nodes at rest, without mass of their own, all free.
    pub fn new(rest: Configuration) -> Self {
        Self {
            rest,
            ..Self::default()
        }
    }

    /// Adds an element, with its mass.
    #[must_use]
    pub fn element(mut self, element: impl Element + 'static) -> Self {
        self.elements.push(Box::new(element));
        self
    }

    /// Adds mass to a node, about the node in node components.
    #[must_use]
    pub fn mass(mut self, node: usize, mass: MassProperties) -> Self {
        self.masses.push((node, mass));
        self
    }

    /// Holds numbers of a node at their rest values in W: three of the place (W axes), three of the attitude
    /// (node axes).
    #[must_use]
    pub fn hold(mut self, node: usize, held: [bool; NODE]) -> Self {
        self.held.push((node, held));
        self
    }

    /// Clamps a node to the body that carries W.
    #[must_use]
    pub fn clamp(self, node: usize) -> Self {
        self.hold(node, [true; NODE])
    }

    /// Sets the damping.
    #[must_use]
    pub fn damping(mut self, damping: Damping) -> Self {
        self.damping = damping;
        self
    }

    /// The elastic body.
    ///
    /// # Errors
    /// [`StructureError`]: counts that differ, nodes that are not there, impossible masses, free nodes without inertia,
    /// negative damping, nothing free, stress at rest that finds no equilibrium.
    pub fn build(self) -> Result<Structure, StructureError> {
        self.check_nodes()?;
        self.check_damping()?;
        let masses = self.lumped()?;
        let held = self.held_numbers();
        check_inertia(&masses, &held)?;
        let sequence = order(&self.neighbours());
        let (unknown, number) = numbered(&sequence, &held);
        if number.is_empty() {
            return Err(StructureError::NothingFree);
        }
        let built = Structure {
            band: band(&self.elements, &unknown),
            size: extent(&self.rest),
            rest_energy: 0.0,
            rest: self.rest,
            masses,
            between: self
                .elements
                .iter()
                .flat_map(|e| e.masses_between())
                .collect(),
            elements: self.elements,
            damping: self.damping,
            unknown,
            number,
        };
        if built.elements.iter().any(|e| e.is_stressed_at_rest()) {
            return relaxed(built);
        }
        Ok(built)
    }

    fn check_nodes(&self) -> Result<(), StructureError> {
        let nodes = self.rest.len();
        if self.rest.rotation.len() != nodes {
            return Err(StructureError::Count {
                what: "attitudes of the rest configuration",
                found: self.rest.rotation.len(),
                nodes,
            });
        }
        let elements = self.elements.iter().flat_map(|e| e.nodes());
        let named = (elements.map(|&n| ("an element", n)))
            .chain(self.masses.iter().map(|m| ("a mass", m.0)))
            .chain(self.held.iter().map(|h| ("a support", h.0)));
        match named.into_iter().find(|(_, node)| *node >= nodes) {
            Some((what, node)) => Err(StructureError::Node { what, node, nodes }),
            None => Ok(()),
        }
    }

    fn check_damping(&self) -> Result<(), StructureError> {
        let d = self.damping;
        for (what, value) in [
            ("strain-rate damping [s]", d.strain_rate),
            ("mass-proportional damping [1/s]", d.mass),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                let allowed = "a finite number >= 0";
                return Err(StructureError::Number {
                    what,
                    value,
                    allowed,
                });
            }
        }
        Ok(())
    }

    /// Masses of nodes and elements together.
    fn lumped(&self) -> Result<Vec<MassProperties>, StructureError> {
        let mut masses = vec![MassProperties::ZERO; self.rest.len()];
        for &(n, m) in &self.masses {
            masses[n] = masses[n] + m;
        }
        for e in &self.elements {
            e.add_mass(&self.rest, &mut masses);
        }
        for (node, m) in masses.iter().enumerate() {
            m.validate()
                .map_err(|error| StructureError::Mass { node, error })?;
        }
        Ok(masses)
    }

    fn held_numbers(&self) -> Vec<bool> {
        let mut held = vec![false; NODE * self.rest.len()];
        for (n, h) in &self.held {
            let at = &mut held[NODE * n..NODE * (n + 1)];
            at.iter_mut().zip(h).for_each(|(a, b)| *a |= b);
        }
        held
    }

    fn neighbours(&self) -> Vec<Vec<usize>> {
        let mut all = vec![vec![]; self.rest.len()];
        for e in &self.elements {
            for &a in e.nodes() {
                all[a].extend(e.nodes().iter().filter(|&&b| b != a));
            }
        }
        for around in &mut all {
            around.sort_unstable();
            around.dedup();
        }
        all
    }
}

/// Largest displacement, over the size of the body, by which stress at rest may change its shape \[1\].
const MAX_SLACK: f64 = 0.05;

/// The body with its stresses in equilibrium.
fn relaxed(built: Structure) -> Result<Structure, StructureError> {
    let none = |_: &Configuration, _: &mut [f64]| {};
    let settings = StaticSettings::default();
    let rest = equilibrium(&built, &built.rest, &FrameMotion::REST, &none, &settings)
        .map_err(|error| StructureError::Stressed(Box::new(error)))?;
    let places = rest.position.iter().zip(&built.rest.position);
    let moved = largest(places.map(|(a, b)| a.distance(*b)));
    if moved.is_nan() || moved > MAX_SLACK * built.size {
        return Err(StructureError::Slack {
            moved,
            size: built.size,
        });
    }
    let mut forces = ElementForces::default();
    let energies = built.elements.iter();
    let rest_energy = energies
        .map(|e| e.internal(&rest, false, &mut forces))
        .sum();
    Ok(Structure {
        rest,
        rest_energy,
        ..built
    })
}

/// A free node needs mass, and inertia about its mass centre, in every free direction.
fn check_inertia(masses: &[MassProperties], held: &[bool]) -> Result<(), StructureError> {
    for (node, m) in masses.iter().enumerate() {
        let free = |d: usize| !held[NODE * node + d];
        let about = m.inertia_about_centre();
        let lacks = |d: usize| match d {
            0..3 => m.mass <= 0.0,
            _ => about.col(d - 3)[d - 3] <= 0.0,
        };
        if let Some(direction) = (0..NODE).find(|&d| free(d) && lacks(d)) {
            return Err(StructureError::Inertia { node, direction });
        }
    }
    Ok(())
}

/// Numbers the free unknowns, nodes in a sequence.
fn numbered(sequence: &[usize], held: &[bool]) -> (Vec<usize>, Vec<usize>) {
    let mut unknown = vec![HELD; held.len()];
    let numbers = sequence.iter().flat_map(|n| NODE * n..NODE * (n + 1));
    let number: Vec<usize> = numbers.filter(|&k| !held[k]).collect();
    number.iter().enumerate().for_each(|(i, &k)| unknown[k] = i);
    (unknown, number)
}

/// Largest distance of free unknowns of one element or node.
fn band(elements: &[Box<dyn Element>], unknown: &[usize]) -> usize {
    let spread = |nodes: &[usize]| {
        let all = nodes.iter().flat_map(|n| NODE * n..NODE * (n + 1));
        let free = all.map(|k| unknown[k]).filter(|&u| u != HELD);
        let (low, high) = free.fold((HELD, 0), |(l, h), u| (l.min(u), h.max(u)));
        high.saturating_sub(low)
    };
    let widest = elements.iter().map(|e| spread(e.nodes())).max();
    widest.unwrap_or(0).max(NODE - 1)
}

/// Largest extent along an axis \[m\].
fn extent(rest: &Configuration) -> f64 {
    let fold = |f: fn(DVec3, DVec3) -> DVec3| rest.position.iter().copied().reduce(f);
    match (fold(DVec3::min), fold(DVec3::max)) {
        (Some(low), Some(high)) => (high - low).max_element(),
        _ => 0.0,
    }
}
