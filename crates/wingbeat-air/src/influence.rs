//! The no-penetration condition: influence matrix, closed surfaces, circulation.

use crate::error::AirError;
use crate::filaments::Filaments;
use crate::kernel::reference::segment_velocity;
use crate::lattice::Lattice;
use crate::panels::Panels;
use crate::topology::Edge;
use rayon::prelude::*;
use wingbeat_math::{DVec3, DenseLu};

/// Influence equations `A gamma = b`: A the normal velocity at control point i of the ring of
/// panel j with unit circulation, b the normal velocity that the rings have to make.
///
/// The rings of a closed surface have one combination that induces nothing: all alike. It is
/// removed exactly by adding `alpha` to all entries of the surface's own block: the sum of its
/// circulations then times `alpha` is a uniform normal velocity that A cannot make (the *leak*,
/// zero for a flow that conserves volume through the discrete surface), and the mean of the
/// circulations is set to zero afterwards, which changes no velocity.
pub(crate) struct Influence {
    matrix: Vec<f64>,
    lu: DenseLu,
    /// `alpha` of each surface, zero for open ones [1/m].
    alpha: Vec<f64>,
}

impl Default for Influence {
    fn default() -> Self {
        Self {
            matrix: Vec::new(),
            lu: DenseLu::new(0),
            alpha: Vec::new(),
        }
    }
}

impl Influence {
    /// Assembles and factorises the matrix.
    pub(crate) fn factor(
        &mut self,
        lattice: &Lattice,
        filaments: &Filaments,
        panels: &Panels,
        step: u64,
    ) -> Result<(), AirError> {
        self.fit(lattice);
        self.assemble(lattice, filaments, panels);
        self.augment(lattice);
        self.lu
            .factor(&self.matrix)
            .map_err(|source| AirError::Singular { step, source })
    }

    /// Makes room for the lattice, if there is none yet.
    fn fit(&mut self, lattice: &Lattice) {
        let n = lattice.panel_count();
        self.matrix.resize(n * n, 0.0);
        self.alpha.clear();
        self.alpha.resize(lattice.surfaces().len(), 0.0);
        if self.lu.order() != n {
            self.lu = DenseLu::new(n);
        }
    }

    /// Rows are independent, so the bits do not depend on how threads share them.
    fn assemble(&mut self, lattice: &Lattice, filaments: &Filaments, panels: &Panels) {
        let n = lattice.panel_count();
        let edges = &lattice.topology().edges;
        let model = lattice.settings().bound_core;
        let bound = &filaments.bound;
        let normal_velocity = |point: DVec3, normal: DVec3, edge: &Edge, core: f64| {
            let a = bound.nodes.get(edge.from);
            let b = bound.nodes.get(edge.to);
            let mut v = segment_velocity(model, point, a, b, 1.0, core);
            for mirror in lattice.mirrors() {
                v += mirror.vector(segment_velocity(
                    model,
                    mirror.place(point),
                    a,
                    b,
                    1.0,
                    core,
                ));
            }
            v.dot(normal)
        };
        self.matrix
            .par_chunks_mut(n)
            .enumerate()
            .for_each(|(i, row)| {
                row.fill(0.0);
                for (edge, &core) in edges.iter().zip(&bound.core) {
                    let u = normal_velocity(panels.point[i], panels.normal[i], edge, core);
                    row[edge.plus] += u;
                    if let Some(minus) = edge.minus {
                        row[minus] -= u;
                    }
                }
            });
    }

    fn augment(&mut self, lattice: &Lattice) {
        let n = lattice.panel_count();
        for (s, surface) in lattice.surfaces().iter().enumerate() {
            let own = lattice.panels_of(s);
            if !surface.closed {
                continue;
            }
            let diagonal: f64 = own.clone().map(|i| self.matrix[i * n + i].abs()).sum();
            self.alpha[s] = diagonal / (own.len() * own.len()) as f64;
            for i in own.clone() {
                for a in &mut self.matrix[i * n..][own.clone()] {
                    *a += self.alpha[s];
                }
            }
        }
    }

    /// Solves for the circulations in place of the right-hand side; `leak` is the uniform normal
    /// velocity [m/s] of each surface that the rings could not make.
    pub(crate) fn solve(&mut self, lattice: &Lattice, gamma: &mut [f64], leak: &mut Vec<f64>) {
        self.lu.solve_in_place(gamma);
        leak.clear();
        leak.resize(lattice.surfaces().len(), 0.0);
        for (s, surface) in lattice.surfaces().iter().enumerate() {
            if surface.closed {
                let own = &mut gamma[lattice.panels_of(s)];
                let sum: f64 = own.iter().sum();
                leak[s] = self.alpha[s] * sum;
                let mean = sum / own.len() as f64;
                own.iter_mut().for_each(|g| *g -= mean);
            }
        }
    }
}
