//! The no-penetration condition: influence matrix, closed surfaces, circulation.

use crate::error::AirError;
use crate::filaments::Filaments;
use crate::front::{self, Row};
use crate::kernel::{BLOCK, UnitEdges};
use crate::lattice::Lattice;
use crate::panels::Panels;
use crate::state::AirState;
use crate::topology::Edge;
use rayon::prelude::*;
use wingbeat_math::DenseLu;

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
    /// Circulations of the lead panels, where only one half is computed.
    half: Vec<f64>,
    /// Normal velocity of every edge at a block of control points, for each block; then of the newest
    /// rows' edges at one block.
    rates: Vec<f64>,
    edges: UnitEdges,
    /// Part of the circulation of its panel that each edge keeps, the newest row taking the rest.
    keeps: Vec<f64>,
    lu: DenseLu,
    /// `alpha` of each surface, zero for open ones [1/m].
    alpha: Vec<f64>,
}

impl Default for Influence {
    fn default() -> Self {
        Self {
            matrix: Vec::new(),
            half: Vec::new(),
            rates: Vec::new(),
            edges: UnitEdges::default(),
            keeps: Vec::new(),
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
        state: &AirState,
        filaments: &Filaments,
        panels: &Panels,
    ) -> Result<(), AirError> {
        let step = state.step;
        self.fit(lattice);
        self.assemble(lattice, state, filaments, panels);
        let (edges, rates) = (&mut self.edges, &mut self.rates);
        front::add_influence(lattice, filaments, panels, edges, rates, &mut self.matrix);
        self.augment(lattice);
        self.lu
            .factor(&self.matrix)
            .map_err(|source| AirError::Singular { step, source })
    }

    /// Makes room for the lattice, if there is none yet.
    fn fit(&mut self, lattice: &Lattice) {
        let n = unknowns(lattice);
        self.matrix.resize(n * n, 0.0);
        self.alpha.clear();
        self.alpha.resize(lattice.surfaces().len(), 0.0);
        if self.lu.order() != n {
            self.lu = DenseLu::new(n);
        }
    }

    /// Blocks of rows are independent, so the bits do not depend on how threads share them.
    fn assemble(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        filaments: &Filaments,
        panels: &Panels,
    ) {
        let keeps = |edge: &Edge| {
            let part = edge.wake.map_or(0.0, |w| {
                let (s, lengths) = (w.sheet, &filaments.lengths[w.sheet]);
                let row = Row {
                    lattice,
                    state,
                    s,
                    lengths,
                };
                front::at_edge(&row, w.column)[1]
            });
            1.0 - part
        };
        self.keeps.clear();
        (self.keeps).extend(lattice.topology().edges.iter().map(keeps));
        let keeps = &self.keeps;
        let (n, model) = (unknowns(lattice), lattice.settings().bound_core);
        let lead = |i: usize| lattice.halves().map_or(i, |h| h.lead[i]);
        self.edges.load(model, &filaments.bound);
        let (edges, size) = (&self.edges, self.edges.len() * BLOCK);
        let room = n.div_ceil(BLOCK) * size;
        self.rates.resize(room.max(self.rates.len()), 0.0);
        self.matrix
            .par_chunks_mut(BLOCK * n)
            .zip(self.rates.par_chunks_mut(size))
            .enumerate()
            .for_each(|(b, (rows, rates))| {
                rows.fill(0.0);
                let own = b * BLOCK..n.min((b + 1) * BLOCK);
                let place = |p: usize| [panels.point[p], panels.normal[p]];
                let places = || own.clone().map(|i| place(lead(i)));
                edges.normal_velocities(model, places(), rates);
                add_edges(lattice, keeps, rates, rows);
                for mirror in lattice.mirrors() {
                    let images = places().map(|[x, n]| [mirror.place(x), mirror.vector(n)]);
                    edges.normal_velocities(model, images, rates);
                    add_edges(lattice, keeps, rates, rows);
                }
            });
    }

    fn augment(&mut self, lattice: &Lattice) {
        let n = unknowns(lattice);
        let unknown = |p: usize| lattice.halves().map_or(p, |h| h.unknown[p]);
        for (s, surface) in lattice.surfaces().iter().enumerate() {
            let own = lattice.panels_of(s);
            if !surface.closed {
                continue;
            }
            let leads = lattice
                .halves()
                .is_none_or(|h| h.panel[own.start] >= own.start);
            let diagonal = |p: usize| self.matrix[unknown(p) * n + unknown(p)].abs();
            self.alpha[s] = if leads {
                own.clone().map(diagonal).sum::<f64>() / (own.len() * own.len()) as f64
            } else {
                let panel = lattice.halves().expect("only halves follow").panel[own.start];
                self.alpha[lattice.topology().panel_surface[panel]]
            };
            for i in own
                .clone()
                .filter(|_| leads)
                .filter(|&p| is_lead(lattice, p))
            {
                for j in own.clone() {
                    self.matrix[unknown(i) * n + unknown(j)] += self.alpha[s];
                }
            }
        }
    }

    /// Solves for the circulations in place of the right-hand side, which stands in the first
    /// unknowns; `leak` is the uniform normal velocity [m/s] of each surface that the rings could
    /// not make.
    pub(crate) fn solve(&mut self, lattice: &Lattice, gamma: &mut [f64], leak: &mut Vec<f64>) {
        match lattice.halves() {
            None => self.lu.solve_in_place(gamma),
            Some(halves) => {
                self.half.clear();
                self.half.extend(&gamma[..halves.lead.len()]);
                self.lu.solve_in_place(&mut self.half);
                halves.spread(&self.half, gamma);
            }
        }
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

/// Number of circulations to be found.
pub(crate) fn unknowns(lattice: &Lattice) -> usize {
    lattice
        .halves()
        .map_or(lattice.panel_count(), |h| h.lead.len())
}

fn is_lead(lattice: &Lattice, panel: usize) -> bool {
    lattice.halves().is_none_or(|h| panel <= h.panel[panel])
}

/// Adds the normal velocities of the edges to the columns of the panels they bound.
fn add_edges(lattice: &Lattice, keeps: &[f64], rates: &[f64], rows: &mut [f64]) {
    let n = unknowns(lattice);
    let unknown = |p: usize| lattice.halves().map_or(p, |h| h.unknown[p]);
    let edges = lattice.topology().edges.iter().zip(keeps);
    for ((edge, keeps), rates) in edges.zip(rates.chunks(BLOCK)) {
        let (plus, minus) = (unknown(edge.plus), edge.minus.map(unknown));
        for (row, u) in rows.chunks_mut(n).zip(rates) {
            row[plus] += keeps * u;
            if let Some(minus) = minus {
                row[minus] -= u;
            }
        }
    }
}
