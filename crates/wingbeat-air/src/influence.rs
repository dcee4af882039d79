//! The no-penetration condition: influence matrix, closed surfaces.

use crate::circulation::Circulation;
use crate::error::AirError;
use crate::filaments::Filaments;
use crate::front::{self, Row};
use crate::images::Mirror;
use crate::lattice::Lattice;
use crate::own::{Own, augment};
use crate::panels::Panels;
use crate::row_blocks::RowBlocks;
use crate::settings::NewestRow;
use crate::state::{AirState, NodeMotion};
use crate::topology::Edge;
use rayon::prelude::*;
use std::ops::Range;
use wingbeat_math::DVec3;
use wingbeat_vortex::{BLOCK, UnitEdges};

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
    sources: Sources,
    matrix: RowBlocks,
    /// Normal velocity of every edge at a block of control points, for each block.
    rates: Vec<f64>,
    /// `alpha` of each surface, zero for open ones [1/m].
    alpha: Vec<f64>,
    circulation: Circulation,
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
        self.sources.load(now);
        let n = unknowns(now.lattice);
        self.matrix.resize(n);
        let size = self.sources.len() * BLOCK;
        let room = n.div_ceil(BLOCK) * size;
        self.rates.resize(room.max(self.rates.len()), 0.0);
        let (sources, rates) = (&self.sources, self.rates.par_chunks_mut(size));
        // Blocks are independent of each other, so the bits do not depend on how threads share them.
        let blocks = self.matrix.par_blocks().zip(rates).enumerate();
        blocks.for_each(|(b, (block, rates))| {
            let rows = b * BLOCK..n.min((b + 1) * BLOCK);
            sources.fill(now, rows, block, rates);
        });
        self.augment(now.lattice);
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
        self.circulation
            .solve(lattice, state, &self.matrix, gamma)?;
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
}

/// The edges that move air with the circulation of panels.
#[derive(Default)]
struct Sources {
    /// Edges of the surfaces, in groups that belong to one surface: their numbers and the surface.
    bound: UnitEdges,
    groups: Vec<(Range<usize>, usize)>,
    /// Edges of the newest rows, if they have a part of the panels' present circulation.
    front: UnitEdges,
    /// Part of the circulation of its panel that each edge keeps, the newest row taking the rest.
    keeps: Vec<f64>,
    /// Which of the surfaces of known shape have it now.
    at_rest: Vec<bool>,
}

impl Sources {
    fn len(&self) -> usize {
        self.bound.len().max(self.front.len())
    }

    fn load(&mut self, now: Instant) {
        let Instant {
            lattice, filaments, ..
        } = now;
        let settings = lattice.settings();
        self.load_bound(lattice, filaments);
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
        let is_at_rest = |own: &Own| own.is_at_rest(lattice, &now.motion.position);
        self.at_rest.clear();
        self.at_rest.extend(lattice.own().iter().map(is_at_rest));
    }

    fn load_bound(&mut self, lattice: &Lattice, filaments: &Filaments) {
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
        (self.bound).load(lattice.settings().bound_core, &filaments.bound, ranges);
    }

    /// A block of rows of the matrix; `rates` is room to work in.
    fn fill(&self, now: Instant, rows: Range<usize>, block: &mut [f64], rates: &mut [f64]) {
        let Instant {
            lattice, panels, ..
        } = now;
        block.fill(0.0);
        let lead = |i: usize| lattice.halves().map_or(i, |h| h.lead[i]);
        let place = |i: usize| [panels.point[lead(i)], panels.normal[lead(i)]];
        for (own, rows) in self.parts(lattice, rows.clone()) {
            let but = own.map(|own| own.surface);
            let lane = rows.start % BLOCK;
            let places = rows.clone().map(place);
            self.add_bound(lattice, but, places, rates, lane, block);
            if let Some(own) = own {
                own.add(lattice, &self.keeps, rows, block);
            }
        }
        let images = |mirror: &Mirror| {
            let mirror = *mirror;
            let image = move |[x, n]: [DVec3; 2]| [mirror.place(x), mirror.vector(n)];
            rows.clone().map(place).map(image)
        };
        for mirror in lattice.mirrors() {
            self.add_bound(lattice, None, images(mirror), rates, 0, block);
        }
        if self.front.is_empty() {
            return;
        }
        self.add_front(now, rows.clone().map(place), rates, block);
        for mirror in lattice.mirrors() {
            self.add_front(now, images(mirror), rates, block);
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
        rates: &mut [f64],
        lane: usize,
        block: &mut [f64],
    ) {
        let (model, edges) = (lattice.settings().bound_core, &lattice.topology().edges);
        let count = places.len();
        for (group, (range, surface)) in self.groups.iter().enumerate() {
            if Some(*surface) == but {
                continue;
            }
            (self.bound).normal_velocities(model, group, places.clone(), rates);
            for e in range.clone() {
                for (unknown, part) in columns(lattice, &edges[e], self.keeps[e]) {
                    let to = &mut block[unknown * BLOCK + lane..][..count];
                    add_part(to, part, &rates[e * BLOCK..]);
                }
            }
        }
    }

    /// Adds the influence of the newest rows.
    fn add_front(
        &self,
        now: Instant,
        places: impl ExactSizeIterator<Item = [DVec3; 2]>,
        rates: &mut [f64],
        block: &mut [f64],
    ) {
        let (model, count) = (now.lattice.settings().wake_core, places.len());
        self.front.normal_velocities(model, 0, places, rates);
        front::add_shares(now.lattice, &now.filaments.shares, rates, count, block);
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
        &self.sources.at_rest
    }

    pub(crate) fn circulation(&self) -> &Circulation {
        &self.circulation
    }
}
