//! Internal forces and tangent of all elements.

use wingbeat_math::six_by_six::scaled;
use wingbeat_math::{DMat3, DVec3, SixBySix};

use crate::elements::element::ElementForces;
use crate::error::StructureError;
use crate::nodes::configuration::{Configuration, NODE};
use crate::solution::matrix::Matrix;
use crate::structure::{HELD, Structure};

/// Strain-rate damping in a step.
pub(crate) struct Viscous<'a> {
    /// Time constant \[s\].
    pub time: f64,
    /// Change of rates by change of increments [1/s].
    pub rate: f64,
    /// Rates, six numbers a node.
    pub velocity: &'a [f64],
}

/// Scratch of assembly and the tangent of the free unknowns.
#[derive(Debug)]
pub(crate) struct Assembly {
    pub matrix: Matrix,
    /// Strain energy of the last internal forces \[J\].
    pub energy: f64,
    /// Power that went into it at the last internal forces \[W\].
    pub power: f64,
    element: ElementForces,
    dissipation: Dissipation,
    /// Increments of the numbers of an element.
    numbers: Vec<f64>,
}

impl Assembly {
    pub fn new(structure: &Structure) -> Self {
        Self {
            matrix: Matrix::new(structure.unknowns(), structure.band),
            energy: 0.0,
            power: 0.0,
            element: ElementForces::default(),
            dissipation: Dissipation::default(),
            numbers: vec![],
        }
    }

    /// Adds the internal forces of all nodes, which move with `velocity`, six numbers each.
    pub fn internal(
        &mut self,
        structure: &Structure,
        at: &Configuration,
        velocity: &[f64],
        out: &mut [f64],
    ) {
        (self.energy, self.power) = (-structure.rest_energy, 0.0);
        for e in &structure.elements {
            self.energy += e.internal(at, false, &mut self.element);
            for (n, f) in e.nodes().iter().zip(self.element.force.chunks_exact(NODE)) {
                let own = NODE * n..NODE * (n + 1);
                let moving = f.iter().zip(&velocity[own.clone()]);
                self.power += moving.map(|(f, v)| f * v).sum::<f64>();
                out[own].iter_mut().zip(f).for_each(|(t, f)| *t += f);
            }
        }
    }

    /// Adds the forces of strain-rate damping for a time constant of one second.
    pub fn damping(
        &mut self,
        structure: &Structure,
        at: &Configuration,
        velocity: &[f64],
        out: &mut [f64],
    ) {
        self.dissipation.place(structure, at);
        let mut matrices = &self.dissipation.matrices[..];
        for e in &structure.elements {
            let (nodes, width) = (e.nodes(), NODE * e.nodes().len());
            let (own, others) = matrices.split_at(width * width);
            matrices = others;
            for (i, row) in own.chunks_exact(width).enumerate() {
                let part = |k: usize| row[k] * velocity[NODE * nodes[k / NODE] + k % NODE];
                out[NODE * nodes[i / NODE] + i % NODE] += (0..width).map(part).sum::<f64>();
            }
        }
    }

    /// Adds the tangent of all elements, and that of strain-rate damping where there is some; `turn` maps
    /// increments of the attitude of a node to rotations in its axes. Stresses are those of `at`, or ahead from
    /// a configuration by six numbers a node ([`crate::Element::tangent_ahead`]).
    pub fn tangent(
        &mut self,
        structure: &Structure,
        (at, ahead): (&Configuration, Option<(&Configuration, &[f64])>),
        damping: Option<&Viscous<'_>>,
        turn: &dyn Fn(usize) -> DMat3,
    ) {
        if damping.is_some() {
            self.dissipation.place(structure, at);
        }
        let mut matrices = &self.dissipation.matrices[..];
        for e in &structure.elements {
            match ahead {
                None => {
                    e.internal(at, true, &mut self.element);
                }
                Some((before, increment)) => {
                    gather(increment, e.nodes(), &mut self.numbers);
                    e.tangent_ahead(at, before, &self.numbers, &mut self.element);
                }
            }
            if let Some(d) = damping {
                gather(d.velocity, e.nodes(), &mut self.numbers);
                let out = &mut self.element.tangent;
                let before = ahead.map_or(at, |a| a.0);
                e.add_dissipation_tangent((at, before), &self.numbers, d.time, out);
            }
            let width = NODE * e.nodes().len();
            for (c, &n) in e.nodes().iter().enumerate() {
                let turn = turn(n).transpose();
                for row in self.element.tangent.chunks_exact_mut(width) {
                    let angles = &mut row[NODE * c + 3..NODE * c + 6];
                    (turn * DVec3::from_slice(angles)).write_to_slice(angles);
                }
            }
            if let Some(d) = damping {
                let (own, others) = matrices.split_at(width * width);
                matrices = others;
                let both = self.element.tangent.iter_mut().zip(own);
                both.for_each(|(k, c)| *k += d.time * d.rate * c);
            }
            scatter(
                &mut self.matrix,
                structure,
                e.nodes(),
                &self.element.tangent,
            );
        }
    }

    /// Adds a block of two nodes.
    pub fn add(&mut self, structure: &Structure, [a, b]: [usize; 2], block: &SixBySix) {
        for (i, j) in (0..NODE * NODE).map(|k| (k / NODE, k % NODE)) {
            let (row, col) = (
                structure.unknown[NODE * a + i],
                structure.unknown[NODE * b + j],
            );
            if row != HELD && col != HELD {
                self.matrix.add(row, col, block[i][j]);
            }
        }
    }

    /// Adds the block of a mass midway between two nodes: half of its force is on either, and half of the increment of
    /// either is its own.
    pub fn add_between(&mut self, structure: &Structure, nodes: [usize; 2], block: &SixBySix) {
        let quarter = scaled(block, 0.25);
        for pair in nodes.map(|a| nodes.map(|b| [a, b])).into_iter().flatten() {
            self.add(structure, pair, &quarter);
        }
    }

    /// Factorises the tangent.
    ///
    /// # Errors
    /// [`StructureError::Singular`].
    pub fn factor(&mut self, structure: &Structure) -> Result<(), StructureError> {
        self.matrix.factor().map_err(|unknown| {
            let (node, direction) = structure.direction(unknown);
            StructureError::Singular { node, direction }
        })
    }
}

/// The matrices that strain-rate damping multiplies ([`crate::Element::dissipation`]): the forces of a trial and its
/// tangent ask for those of the same configuration.
#[derive(Debug, Default)]
struct Dissipation {
    /// Where they are known.
    at: Configuration,
    /// Element by element, by rows.
    matrices: Vec<f64>,
    element: ElementForces,
}

impl Dissipation {
    /// Those in the configuration `at`.
    fn place(&mut self, structure: &Structure, at: &Configuration) {
        if self.at == *at {
            return;
        }
        self.matrices.clear();
        for e in &structure.elements {
            e.dissipation(at, &mut self.element);
            self.matrices.extend_from_slice(&self.element.tangent);
        }
        self.at.clone_from(at);
    }
}

/// The numbers of some nodes.
fn gather(all: &[f64], nodes: &[usize], out: &mut Vec<f64>) {
    out.clear();
    let own = nodes.iter().flat_map(|n| NODE * n..NODE * (n + 1));
    out.extend(own.map(|k| all[k]));
}

/// Adds the matrix of an element.
fn scatter(matrix: &mut Matrix, structure: &Structure, nodes: &[usize], tangent: &[f64]) {
    let width = NODE * nodes.len();
    let unknown = |k: usize| structure.unknown[NODE * nodes[k / NODE] + k % NODE];
    for (k, row) in tangent.chunks_exact(width).enumerate() {
        let i = unknown(k);
        if i == HELD {
            continue;
        }
        for (l, value) in row.iter().enumerate() {
            let j = unknown(l);
            if j != HELD {
                matrix.add(i, j, *value);
            }
        }
    }
}
