//! The shell element: strain energy, its derivatives, its mass.

use wingbeat_math::{DMat3, DVec3, MassProperties};

use super::energy::{Gradient, Tangent};
use super::geometry::{Lumps, Quad, lumps};
use super::stiffness::stiffness;
use super::strain::{BENDING, CURVATURE, STRAINS, Stiffness, Term, Vectors, terms};
use super::{ShellError, ShellSection};
use crate::elements::element::{Element, ElementForces, MassBetween};
use crate::nodes::block::pair;
use crate::nodes::configuration::{Configuration, NODE};

/// Strains whose rates are damped: those that bend.
const DAMPED: [[usize; 2]; 1] = [[CURVATURE, BENDING]];

/// A quadrilateral of shell between four nodes, or a triangle between three.
#[derive(Clone, Debug)]
pub struct Shell {
    /// Numbers of the nodes, each once.
    nodes: Vec<usize>,
    /// Which of them stands at each corner.
    corner: [usize; 4],
    /// Axes of the element at rest in node components, by corner.
    axes: [DMat3; 4],
    terms: Vec<Term>,
    /// Values of the strains' forms at rest.
    rest: [f64; STRAINS],
    stiffness: Box<Stiffness>,
    tension: [f64; STRAINS],
    /// The mass at the corners, and midway between those at the ends of long sides; W components at rest.
    lumps: Lumps,
    area: f64,
}

impl Shell {
    /// A shell of `section` between the nodes at the `corners`, counted about its normal, in the rest configuration.
    /// Two neighbouring corners may be the same node: a triangle.
    ///
    /// # Errors
    /// [`ShellError`] names what is wrong with the corners (no such node, no area) or with the section (a
    /// stiffness that is not positive definite, a fibre axis along the normal).
    pub fn new(
        rest: &Configuration,
        corners: [usize; 4],
        section: &ShellSection,
    ) -> Result<Self, ShellError> {
        section.check()?;
        if let Some(&node) = corners.iter().find(|&&n| n >= rest.len()) {
            let nodes = rest.len();
            return Err(ShellError::NoNode { node, nodes });
        }
        let places = corners.map(|n| rest.position[n]);
        let quad = Quad::new(places, section.axis)?;
        let (nodes, corner) = distinct(corners);
        let (stiffness, tension) = stiffness(&quad, section);
        let turned = corners.map(|n| DMat3::from_quat(rest.rotation[n].inverse()) * quad.axes);
        let mut shell = Self {
            nodes,
            corner,
            axes: turned,
            terms: terms(&quad),
            rest: [0.0; STRAINS],
            stiffness,
            tension,
            lumps: lumps(places, quad.axes, section),
            area: quad.area,
        };
        shell.rest = shell.strains(&shell.pose(rest));
        Ok(shell)
    }

    /// Area at rest \[m2\], projected on the tangent plane at the centre.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// How the corners stand in a configuration.
    fn pose(&self, at: &Configuration) -> Pose {
        let rotations = (self.corner).map(|k| DMat3::from_quat(at.rotation[self.nodes[k]]));
        let axis = |k: usize| std::array::from_fn(|i| rotations[i] * self.axes[i].col(k));
        let places = self.corner.map(|k| at.position[self.nodes[k]]);
        let vectors = [places, axis(0), axis(1), axis(2)];
        Pose { rotations, vectors }
    }

    /// Derivatives of the strains by the numbers of the corners.
    fn gradient(&self, pose: &Pose) -> Gradient {
        Gradient::new(&self.terms, &pose.vectors, &pose.rotations, &self.axes)
    }

    /// Changes of the strains' forms from rest.
    fn strains(&self, pose: &Pose) -> [f64; STRAINS] {
        let mut s = self.rest.map(|r| -r);
        for term in &self.terms {
            let [left, right] = term.vectors(&pose.vectors);
            s[term.strain] += left.dot(right);
        }
        s
    }

    /// Forces of the strains, and the energy.
    fn stresses(&self, strains: &[f64; STRAINS]) -> ([f64; STRAINS], f64) {
        let mut energy = 0.0;
        let stress = std::array::from_fn(|i| {
            let elastic: f64 = (0..STRAINS)
                .map(|j| self.stiffness[i][j] * strains[j])
                .sum();
            energy += strains[i] * (0.5 * elastic + self.tension[i]);
            elastic + self.tension[i]
        });
        (stress, energy)
    }

    /// Adds the tangent under the forces `stress` of the strains.
    fn add_tangent(
        &self,
        (pose, gradient): (&Pose, &Gradient),
        stress: &[f64; STRAINS],
        out: &mut [f64],
    ) {
        let mut sum = self.tangent(out);
        sum.material(gradient, &self.stiffness);
        sum.geometric(
            &self.terms,
            stress,
            &pose.vectors,
            &pose.rotations,
            &self.axes,
        );
    }

    fn tangent<'a>(&'a self, out: &'a mut [f64]) -> Tangent<'a> {
        Tangent::new(&self.corner, NODE * self.nodes.len(), out)
    }
}

/// How the corners stand.
struct Pose {
    /// Rotations of their nodes.
    rotations: [DMat3; 4],
    /// Places and axes.
    vectors: Vectors,
}

/// Each node once, and which of them stands at each corner.
fn distinct(corners: [usize; 4]) -> (Vec<usize>, [usize; 4]) {
    let mut nodes: Vec<usize> = vec![];
    let corner = corners.map(|n| {
        nodes.iter().position(|&m| m == n).unwrap_or_else(|| {
            nodes.push(n);
            nodes.len() - 1
        })
    });
    (nodes, corner)
}

impl Element for Shell {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn internal(&self, at: &Configuration, tangent: bool, out: &mut ElementForces) -> f64 {
        let pose = self.pose(at);
        let (stress, energy) = self.stresses(&self.strains(&pose));
        let size = NODE * self.nodes.len();
        out.force.clear();
        out.force.resize(size, 0.0);
        let gradient = self.gradient(&pose);
        gradient.force(&stress, &self.corner, &mut out.force);
        if tangent {
            out.tangent.clear();
            out.tangent.resize(size * size, 0.0);
            self.add_tangent((&pose, &gradient), &stress, &mut out.tangent);
        }
        energy
    }

    fn is_stressed_at_rest(&self) -> bool {
        self.tension.iter().any(|t| t.abs() > 0.0)
    }

    /// Of the tangent the material's part, of bending alone. In a sheet that turns by much in a step the rates
    /// of its stretching are errors of the step times its large stiffness; what they damp is beyond what steps
    /// resolve.
    fn dissipation(&self, at: &Configuration, out: &mut ElementForces) {
        out.resize(NODE * self.nodes.len());
        let gradient = self.gradient(&self.pose(at));
        let mut sum = self.tangent(&mut out.tangent);
        sum.between([&gradient, &gradient], &self.stiffness, 1.0, &DAMPED);
    }

    fn add_dissipation_tangent(
        &self,
        (at, before): (&Configuration, &Configuration),
        velocity: &[f64],
        factor: f64,
        tangent: &mut [f64],
    ) {
        let pose = self.pose(at);
        let gradient = self.gradient(&pose);
        let mut rates = [0.0; STRAINS];
        let foreseen = self.gradient(&self.pose(before));
        foreseen.add_strains(velocity, &self.corner, &mut rates);
        let mut stress = [0.0; STRAINS];
        for [first, count] in DAMPED {
            let all = first..first + count;
            for i in all.clone() {
                let of = all.clone().map(|j| self.stiffness[i][j] * rates[j]);
                stress[i] = factor * of.sum::<f64>();
            }
        }
        let corners = self.corner.map(|k| pair(velocity, k));
        let (vectors, rotations) = (&pose.vectors, &pose.rotations);
        let turned = Gradient::of_rates(&self.terms, vectors, rotations, &self.axes, &corners);
        let mut sum = self.tangent(tangent);
        sum.geometric(&self.terms, &stress, vectors, rotations, &self.axes);
        sum.between([&gradient, &turned], &self.stiffness, factor, &DAMPED);
    }

    fn tangent_ahead(
        &self,
        at: &Configuration,
        before: &Configuration,
        increment: &[f64],
        out: &mut ElementForces,
    ) {
        let from = self.pose(before);
        let mut strains = self.strains(&from);
        let foreseen = self.gradient(&from);
        foreseen.add_strains(increment, &self.corner, &mut strains);
        let (stress, _) = self.stresses(&strains);
        let pose = self.pose(at);
        out.resize(NODE * self.nodes.len());
        self.add_tangent((&pose, &self.gradient(&pose)), &stress, &mut out.tangent);
    }

    fn add_mass(&self, rest: &Configuration, masses: &mut [MassProperties]) {
        for (lump, &k) in self.lumps.corners.iter().zip(&self.corner) {
            let node = self.nodes[k];
            let to_node = DMat3::from_quat(rest.rotation[node].inverse());
            masses[node] = masses[node] + lump.moved(to_node, DVec3::ZERO);
        }
    }

    fn masses_between(&self) -> Vec<MassBetween> {
        let middles = self.lumps.middles.iter();
        let named = middles.map(|(ends, mass)| MassBetween {
            nodes: ends.map(|k| self.nodes[self.corner[k]]),
            mass: *mass,
        });
        named.collect()
    }

    fn remainder(&self) -> MassProperties {
        self.lumps.remainder
    }
}
