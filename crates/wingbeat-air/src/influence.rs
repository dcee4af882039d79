//! The no-penetration condition: influence matrix, closed surfaces, circulation.

use crate::error::AirError;
use crate::filaments::Filaments;
use crate::front::{self, Row};
use crate::kernel::{BLOCK, UnitEdges};
use crate::lattice::Lattice;
use crate::own::{Own, augment};
use crate::panels::Panels;
use crate::row_blocks::RowBlocks;
use crate::settings::NewestRow;
use crate::state::{AirState, NodeMotion};
use crate::topology::Edge;
use rayon::prelude::*;
use std::ops::Range;
use wingbeat_math::{BiCgStab, DVec3, DenseLu};

/// Influence equations `A gamma = b`: A the normal velocity at control point i of the ring of
/// panel j with unit circulation, b the normal velocity that the rings have to make.
///
/// The rings of a closed surface have one combination that induces nothing: all alike. It is
/// removed exactly by adding `alpha` to all entries of the surface's own block: the sum of its
/// circulations then times `alpha` is a uniform normal velocity that A cannot make (the *leak*,
/// zero for a flow that conserves volume through the discrete surface), and the mean of the
/// circulations is set to zero afterwards, which changes no velocity.
#[derive(Default)]
pub(crate) struct Influence {
    matrix: RowBlocks,
    bound: Groups,
    /// Edges of the newest rows, if they have a part of the panels' present circulation.
    front: UnitEdges,
    /// Part of the circulation of its panel that each edge keeps, the newest row taking the rest.
    keeps: Vec<f64>,
    /// Which surfaces of known shape have it now.
    at_rest: Vec<bool>,
    /// Normal velocity of every edge at a block of control points, for each block.
    rates: Vec<f64>,
    /// `alpha` of each surface, zero for open ones [1/m].
    alpha: Vec<f64>,
    /// Right-hand side and circulations, of the lead panels where only one half is computed.
    wanted: Vec<f64>,
    found: Vec<f64>,
    iterations: BiCgStab,
    rows: Vec<f64>,
    lu: DenseLu,
}

/// The edges of the surfaces, one by one, in groups that belong to one surface.
#[derive(Default)]
struct Groups {
    edges: UnitEdges,
    /// Edges and surface of each group.
    groups: Vec<(Range<usize>, usize)>,
}

/// What is there at one instant.
#[derive(Clone, Copy)]
pub(crate) struct Instant<'a> {
    pub lattice: &'a Lattice,
    pub state: &'a AirState,
    pub filaments: &'a Filaments,
    pub panels: &'a Panels,
    pub motion: &'a NodeMotion,
}

impl Influence {
    /// Computes the matrix.
    pub(crate) fn assemble(&mut self, now: Instant) {
        let Instant {
            lattice, motion, ..
        } = now;
        self.load(now);
        self.at_rest.clear();
        let is_at_rest = |own: &Own| own.is_at_rest(lattice, &motion.position);
        self.at_rest.extend(lattice.own().iter().map(is_at_rest));
        let n = unknowns(lattice);
        self.matrix.resize(n);
        let size = (self.bound.edges.len() + self.front.len()) * BLOCK;
        let room = n.div_ceil(BLOCK) * size;
        self.rates.resize(room.max(self.rates.len()), 0.0);
        let (mut matrix, mut rates) = (
            std::mem::take(&mut self.matrix),
            std::mem::take(&mut self.rates),
        );
        let blocks = matrix.par_blocks().zip(rates.par_chunks_mut(size));
        // Independent of each other, so the bits do not depend on how threads share them.
        blocks.enumerate().for_each(|(b, (block, rates))| {
            let rows = b * BLOCK..n.min((b + 1) * BLOCK);
            self.fill(now, rows, block, rates);
        });
        (self.matrix, self.rates) = (matrix, rates);
        self.augment(lattice);
    }

    /// Takes the edges, and what they keep.
    fn load(&mut self, now: Instant) {
        let Instant {
            lattice, filaments, ..
        } = now;
        let settings = lattice.settings();
        self.bound.load(lattice, filaments);
        match settings.newest_row {
            NewestRow::Constant => self.front.clear(),
            NewestRow::Matched => {
                let all = std::iter::once(0..filaments.front.len());
                self.front.load(settings.wake_core, &filaments.front, all);
            }
        }
        let keeps = |edge: &Edge| {
            let part = edge.wake.map_or(0.0, |w| {
                let (s, lengths) = (w.sheet, &filaments.lengths[w.sheet]);
                let row = Row {
                    lattice,
                    state: now.state,
                    s,
                    lengths,
                };
                front::at_edge(&row, w.column)[1]
            });
            1.0 - part
        };
        self.keeps.clear();
        (self.keeps).extend(lattice.topology().edges.iter().map(keeps));
    }

    /// A block of rows of the matrix.
    fn fill(&self, now: Instant, rows: Range<usize>, block: &mut [f64], rates: &mut [f64]) {
        let Instant {
            lattice, panels, ..
        } = now;
        block.fill(0.0);
        let lead = |i: usize| lattice.halves().map_or(i, |h| h.lead[i]);
        let place = |i: usize| [panels.point[lead(i)], panels.normal[lead(i)]];
        for (own, rows) in self.parts(lattice, rows.clone()) {
            let places = rows.clone().map(place);
            let known = own.map(|own| own.surface);
            self.add_bound(lattice, known, places, rows.start % BLOCK, rates, block);
            if let Some(own) = own {
                own.add(lattice, &self.keeps, rows, block);
            }
        }
        let images = |mirror: &crate::images::Mirror| {
            let mirror = *mirror;
            (rows.clone().map(place)).map(move |[x, n]| [mirror.place(x), mirror.vector(n)])
        };
        for mirror in lattice.mirrors() {
            self.add_bound(lattice, None, images(mirror), 0, rates, block);
        }
        if self.front.is_empty() {
            return;
        }
        let model = lattice.settings().wake_core;
        let shares = &now.filaments.shares;
        let at = rows.clone().map(place);
        self.front.normal_velocities(model, 0, at, rates);
        front::add_shares(lattice, shares, rates, rows.len(), block);
        for mirror in lattice.mirrors() {
            let at = images(mirror);
            self.front.normal_velocities(model, 0, at, rates);
            front::add_shares(lattice, shares, rates, rows.len(), block);
        }
    }

    /// Cuts rows into runs of one surface whose influence on itself is known, and runs of others.
    fn parts<'a>(
        &'a self,
        lattice: &'a Lattice,
        rows: Range<usize>,
    ) -> impl Iterator<Item = (Option<&'a Own>, Range<usize>)> {
        let known = |i: usize| {
            let mut own = lattice.own().iter().zip(&self.at_rest);
            let here = own.find(|(own, at_rest)| **at_rest && own.unknowns.contains(&i));
            here.map(|(own, _)| own)
        };
        let mut from = rows.start;
        std::iter::from_fn(move || {
            let own = (from < rows.end).then(|| known(from))?;
            let is_other = |&i: &usize| known(i).map(|o| o.surface) != own.map(|o| o.surface);
            let to = (from..rows.end).find(is_other).unwrap_or(rows.end);
            let run = from..to;
            from = to;
            Some((own, run))
        })
    }

    /// Adds the influence of all surfaces but one at these places, which stand in the block from `lane` on.
    fn add_bound(
        &self,
        lattice: &Lattice,
        but: Option<usize>,
        places: impl ExactSizeIterator<Item = [DVec3; 2]> + Clone,
        lane: usize,
        rates: &mut [f64],
        block: &mut [f64],
    ) {
        let (model, edges) = (lattice.settings().bound_core, &lattice.topology().edges);
        let count = places.len();
        for (group, (range, surface)) in self.bound.groups.iter().enumerate() {
            if Some(*surface) == but {
                continue;
            }
            (self.bound.edges).normal_velocities(model, group, places.clone(), rates);
            for e in range.clone() {
                for (unknown, part) in columns(lattice, &edges[e], self.keeps[e]) {
                    let to = &mut block[unknown * BLOCK + lane..][..count];
                    add_part(to, part, &rates[e * BLOCK..]);
                }
            }
        }
    }

    fn augment(&mut self, lattice: &Lattice) {
        self.alpha.clear();
        self.alpha.resize(lattice.surfaces().len(), 0.0);
        for (s, surface) in lattice.surfaces().iter().enumerate() {
            let first = lattice.panels_of(s).start;
            if !surface.closed {
                continue;
            }
            self.alpha[s] = match lattice.halves() {
                Some(halves) if halves.panel[first] < first => {
                    self.alpha[lattice.topology().panel_surface[halves.panel[first]]]
                }
                _ => augment(lattice, s, 0, &mut self.matrix),
            };
        }
    }

    /// Solves for the circulations in place of the right-hand side, which stands in the first
    /// unknowns; `leak` is the uniform normal velocity [m/s] of each surface that the rings could
    /// not make.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(crate) fn solve(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        gamma: &mut [f64],
        leak: &mut Vec<f64>,
    ) -> Result<(), AirError> {
        self.wanted.clear();
        self.wanted.extend(&gamma[..unknowns(lattice)]);
        if !self.iterate(lattice, state) {
            self.eliminate(state.step)?;
        }
        match lattice.halves() {
            None => gamma.copy_from_slice(&self.found),
            Some(halves) => halves.spread(&self.found, gamma),
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
        Ok(())
    }

    /// Starts from the circulations of the state; false if that is not possible or does not get there.
    fn iterate(&mut self, lattice: &Lattice, state: &AirState) -> bool {
        let known: usize = lattice.own().iter().map(|own| own.unknowns.len()).sum();
        if known < unknowns(lattice) {
            return false;
        }
        let leads = (0..state.gamma.len()).filter(|&p| is_lead(lattice, p));
        self.found.clear();
        self.found.extend(leads.map(|p| state.gamma[p]));
        let matrix = &self.matrix;
        let multiply = |x: &[f64], out: &mut [f64]| matrix.multiply(x, out);
        let nearly_divide = |x: &[f64], out: &mut [f64]| {
            for own in lattice.own() {
                let these = own.unknowns.clone();
                own.inverse.multiply(&x[these.clone()], &mut out[these]);
            }
        };
        let (wanted, found) = (&self.wanted, &mut self.found);
        (self.iterations).solve(&multiply, &nearly_divide, wanted, found)
    }

    /// By factors of the whole matrix.
    fn eliminate(&mut self, step: u64) -> Result<(), AirError> {
        let n = self.matrix.order();
        self.matrix.to_rows(&mut self.rows);
        if self.lu.order() != n {
            self.lu = DenseLu::new(n);
        }
        let singular = |source| AirError::Singular { step, source };
        self.lu.factor(&self.rows).map_err(singular)?;
        self.found.clone_from(&self.wanted);
        self.lu.solve_in_place(&mut self.found);
        Ok(())
    }
}

impl Groups {
    fn load(&mut self, lattice: &Lattice, filaments: &Filaments) {
        let topology = lattice.topology();
        let surface = |e: &Edge| topology.panel_surface[e.plus];
        self.groups.clear();
        let mut first = 0;
        for group in topology.edges.chunk_by(|a, b| surface(a) == surface(b)) {
            let range = first..first + group.len();
            first = range.end;
            self.groups.push((range, surface(&group[0])));
        }
        let ranges = self.groups.iter().map(|(range, _)| range.clone());
        (self.edges).load(lattice.settings().bound_core, &filaments.bound, ranges);
    }
}

/// Number of circulations to be found.
pub(crate) fn unknowns(lattice: &Lattice) -> usize {
    lattice
        .halves()
        .map_or(lattice.panel_count(), |h| h.lead.len())
}

/// Which circulation is that of a panel.
pub(crate) fn unknown(lattice: &Lattice, panel: usize) -> usize {
    lattice.halves().map_or(panel, |h| h.unknown[panel])
}

/// Whether a panel is the one of its pair that is computed.
pub(crate) fn is_lead(lattice: &Lattice, panel: usize) -> bool {
    lattice.halves().is_none_or(|h| panel <= h.panel[panel])
}

/// The columns that the normal velocities of an edge go to, those of the panels it bounds, and what part of them.
pub(crate) fn columns(
    lattice: &Lattice,
    edge: &Edge,
    keeps: f64,
) -> impl Iterator<Item = (usize, f64)> {
    let plus = (unknown(lattice, edge.plus), keeps);
    let minus = edge.minus.map(|p| (unknown(lattice, p), -1.0));
    std::iter::once(plus).chain(minus)
}

/// Adds a part of the normal velocities of an edge or ring.
pub(crate) fn add_part(to: &mut [f64], part: f64, rates: &[f64]) {
    to.iter_mut().zip(rates).for_each(|(a, u)| *a += part * u);
}

#[cfg(test)]
impl Influence {
    pub(crate) fn matrix(&self) -> &RowBlocks {
        &self.matrix
    }

    pub(crate) fn at_rest(&self) -> &[bool] {
        &self.at_rest
    }

    pub(crate) fn has_factors(&self) -> bool {
        self.lu.order() > 0
    }
}
