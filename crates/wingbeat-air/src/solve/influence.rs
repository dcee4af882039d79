//! The influence equations: no air goes through the surfaces.

use crate::error::AirError;
use crate::geometry::{Edge, NodeMotion, Panels, Wash};
use crate::images::Mirror;
use crate::lattice::Lattice;
use crate::solve::circulation::Circulation;
use crate::solve::row_blocks::RowBlocks;
use crate::solve::self_influence::{KnownShapes, SelfInfluence, augment};
use crate::solve::unknowns::{add_part, columns, is_computed, panel, unknown, unknowns};
use crate::state::AirState;
use crate::wake::{Filaments, NearWakeRow, NearWakeShare, at_edge};
use rayon::prelude::*;
use std::ops::Range;
use wingbeat_math::DVec3;
use wingbeat_vortex::{BLOCK, UnitEdges};

/// Influence equations `A gamma = b`: A the normal velocity at control point i of the ring of
/// panel j with unit circulation, b the normal velocity that the rings have to make.
///
/// The rings of a closed surface have one combination that induces nothing: all alike. It is
/// removed exactly by adding `alpha` to all entries of the surface's own block: the sum of its
/// circulations then times `alpha` is a uniform normal velocity that A cannot make (the *net-flux
/// residual*, zero for a flow that conserves volume through the discrete surface), and the mean of the
/// circulations is set to zero afterwards, which changes no velocity.
#[derive(Default)]
pub(crate) struct Influence {
    known: KnownShapes,
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
    pub panels: &'a Panels,
    /// The surfaces where the rings meet them.
    pub wash: &'a Wash,
    pub motion: &'a NodeMotion,
    /// Time [s].
    pub time: f64,
}

impl Instant<'_> {
    /// Middle of the newest free nodes of the wake that leaves an edge [m], N.
    pub(crate) fn newest_row(&self, edge: usize) -> Option<DVec3> {
        let wake = self.lattice.topology().edges[edge].wake?;
        let sheet = &self.state.sheets[wake.sheet];
        let row = sheet.rows().checked_sub(1)?;
        let [a, b] = [0, 1].map(|k| sheet.node(row, wake.column + k));
        Some(a.midpoint(b))
    }
}

impl Influence {
    /// Computes the matrix.
    pub(crate) fn assemble(&mut self, now: Instant, filaments: &Filaments) {
        self.known.update(now.lattice);
        let known = self.known.surfaces();
        self.sources.load(now, filaments, known);
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
            sources.fill((now, known), &filaments.shares, rows, block, rates);
        });
        self.augment(now.lattice);
    }

    /// Puts in place of the equations of panels within bodies that their circulations are the mean of those
    /// beside the two roots; `right` is the right-hand side.
    pub(crate) fn carry(&mut self, lattice: &Lattice, right: &mut [f64]) {
        let computed = lattice.carried().iter();
        for carried in computed.filter(|c| is_computed(lattice, c.panel)) {
            let own = unknown(lattice, carried.panel);
            let unit = self.matrix.at(own, own); // equations of one size
            for column in 0..self.matrix.order() {
                *self.matrix.entry(own, column) = 0.0;
            }
            *self.matrix.entry(own, own) = unit;
            right[own] = 0.0;
            for panel in carried.beside {
                *self.matrix.entry(own, unknown(lattice, panel)) -= 0.5 * unit;
            }
        }
    }

    /// Number of unknowns.
    pub(crate) fn order(&self) -> usize {
        self.matrix.order()
    }

    /// Normal velocities at the control points of these panels by their own circulations, row by row into `out`. Where
    /// one half of the flow is computed, those of the other half are its mirror image.
    pub(crate) fn block(&self, lattice: &Lattice, panels: Range<usize>, out: &mut Vec<f64>) {
        let of = |p: usize| unknown(lattice, p);
        let rows = panels
            .clone()
            .flat_map(|i| panels.clone().map(move |j| (of(i), of(j))));
        out.clear();
        out.extend(rows.map(|(i, j)| self.matrix.at(i, j)));
    }

    fn augment(&mut self, lattice: &Lattice) {
        self.alpha.clear();
        self.alpha.resize(lattice.surfaces().len(), 0.0);
        for (s, surface) in lattice.surfaces().iter().enumerate() {
            let first = lattice.panels_of(s).start;
            if !surface.closed {
                continue;
            }
            self.alpha[s] = match lattice.symmetry() {
                Some(symmetry) if symmetry.panel[first] < first => {
                    self.alpha[lattice.topology().panel_surface[symmetry.panel[first]]]
                }
                _ => augment(lattice, s, 0, &mut self.matrix),
            };
        }
    }

    /// Solves for the circulations in place of the right-hand side, one for each unknown.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(crate) fn solve(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        gamma: &mut [f64],
    ) -> Result<(), AirError> {
        let known = self.known.surfaces();
        (self.circulation).solve((lattice, known), state, &self.matrix, gamma)
    }

    /// The same for another right-hand side.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(crate) fn solve_another(
        &mut self,
        state: &AirState,
        gamma: &mut [f64],
    ) -> Result<(), AirError> {
        let known = self.known.surfaces();
        (self.circulation).solve_another(known, state, &self.matrix, gamma)
    }

    /// Spreads the circulations of the unknowns, which stand first, over all panels; `net_flux_residual` is the
    /// uniform normal velocity [m/s] of each surface that the rings could not make.
    pub(crate) fn spread(
        &self,
        lattice: &Lattice,
        gamma: &mut [f64],
        net_flux_residual: &mut Vec<f64>,
    ) {
        if let Some(symmetry) = lattice.symmetry() {
            symmetry.spread_in_place(gamma);
        }
        net_flux_residual.clear();
        net_flux_residual.resize(lattice.surfaces().len(), 0.0);
        for (s, surface) in lattice.surfaces().iter().enumerate() {
            if surface.closed {
                let gamma = &mut gamma[lattice.panels_of(s)];
                let sum: f64 = gamma.iter().sum();
                net_flux_residual[s] = self.alpha[s] * sum;
                let mean = sum / gamma.len() as f64;
                gamma.iter_mut().for_each(|g| *g -= mean);
            }
        }
    }
}

/// The edges that move air with the circulation of panels.
#[derive(Default)]
struct Sources {
    /// Edges of the surfaces, in groups that belong to one surface: their numbers and the surface.
    bound: UnitEdges,
    groups: Vec<(Range<usize>, usize)>,
    /// Edges of the newest rows that have a part of the panels' present circulation, and their numbers.
    near_wake: UnitEdges,
    near_edges: Vec<usize>,
    /// Part of the circulation of its panel that each edge keeps, the newest row taking the rest.
    keeps: Vec<f64>,
    /// Which of the surfaces of known shape have it now.
    at_rest: Vec<bool>,
}

impl Sources {
    fn len(&self) -> usize {
        self.bound.len().max(self.near_wake.len())
    }

    fn load(&mut self, now: Instant, filaments: &Filaments, known: &[SelfInfluence]) {
        let lattice = now.lattice;
        let settings = lattice.settings();
        self.load_bound(lattice, filaments);
        let has_part = |&e: &usize| filaments.shares[e].part != [0.0; 2];
        self.near_edges.clear();
        (self.near_edges).extend((0..filaments.shares.len()).filter(has_part));
        let near = std::iter::once(self.near_edges.iter().copied());
        (self.near_wake).load(settings.wake_core, &filaments.near_wake, near);
        let keeps = |edge: &Edge| {
            let part = edge.wake.map_or(0.0, |w| {
                let (s, shape) = (w.sheet, &filaments.newest[w.sheet]);
                let row = NearWakeRow {
                    lattice,
                    state: now.state,
                    s,
                    shape,
                };
                at_edge(&row, w.column)[1]
            });
            1.0 - part
        };
        self.keeps.clear();
        (self.keeps).extend(lattice.topology().edges.iter().map(keeps));
        let is_at_rest = |s: &SelfInfluence| s.is_at_rest(lattice, &now.motion.position);
        self.at_rest.clear();
        self.at_rest.extend(known.iter().map(is_at_rest));
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
    fn fill(
        &self,
        (now, known): (Instant, &[SelfInfluence]),
        shares: &[NearWakeShare],
        rows: Range<usize>,
        block: &mut [f64],
        rates: &mut [f64],
    ) {
        let Instant {
            lattice, panels, ..
        } = now;
        block.fill(0.0);
        let point = |i: usize| [&panels.point, &panels.normal].map(|x| x[panel(lattice, i)]);
        for (known, rows) in self.parts(known, rows.clone()) {
            let except = known.map(|k| k.surface);
            let lane = rows.start % BLOCK;
            let points = rows.clone().map(point);
            self.add_bound(lattice, except, points, (rates, lane), block);
            if let Some(known) = known {
                known.add(lattice, &self.keeps, rows, block);
            }
        }
        let images = |mirror: &Mirror| {
            let mirror = *mirror;
            let image = move |[x, n]: [DVec3; 2]| [mirror.point(x), mirror.vector(n)];
            rows.clone().map(point).map(image)
        };
        for mirror in lattice.mirrors() {
            self.add_bound(lattice, None, images(mirror), (rates, 0), block);
        }
        if self.near_wake.is_empty() {
            return;
        }
        self.add_near_wake(lattice, shares, rows.clone().map(point), rates, block);
        for mirror in lattice.mirrors() {
            self.add_near_wake(lattice, shares, images(mirror), rates, block);
        }
    }

    /// Cuts rows into runs of one surface whose influence on itself is known, and runs of others.
    fn parts<'a>(
        &'a self,
        known: &'a [SelfInfluence],
        rows: Range<usize>,
    ) -> impl Iterator<Item = (Option<&'a SelfInfluence>, Range<usize>)> {
        let known_at = |i: usize| {
            let mut known = known.iter().zip(&self.at_rest);
            let here = known.find(|(k, at_rest)| **at_rest && k.unknowns.contains(&i));
            here.map(|(k, _)| k)
        };
        let mut from = rows.start;
        std::iter::from_fn(move || {
            let known = (from < rows.end).then(|| known_at(from))?;
            let is_other = |&i: &usize| known_at(i).map(|k| k.surface) != known.map(|k| k.surface);
            let to = (from..rows.end).find(is_other).unwrap_or(rows.end);
            let run = from..to;
            from = to;
            Some((known, run))
        })
    }

    /// Adds the influence of all surfaces except one at these points, which stand in the block from `lane` on.
    fn add_bound(
        &self,
        lattice: &Lattice,
        except: Option<usize>,
        points: impl ExactSizeIterator<Item = [DVec3; 2]> + Clone,
        (rates, lane): (&mut [f64], usize),
        block: &mut [f64],
    ) {
        let (edges, count) = (&lattice.topology().edges, points.len());
        for (group, (range, surface)) in self.groups.iter().enumerate() {
            if Some(*surface) == except {
                continue;
            }
            (self.bound).normal_velocities(group, points.clone(), rates);
            for e in range.clone() {
                for (unknown, part) in columns(lattice, &edges[e], self.keeps[e]) {
                    let to = &mut block[unknown * BLOCK + lane..][..count];
                    add_part(to, part, &rates[e * BLOCK..]);
                }
            }
        }
    }

    /// Adds the influence of the newest rows.
    fn add_near_wake(
        &self,
        lattice: &Lattice,
        shares: &[NearWakeShare],
        points: impl ExactSizeIterator<Item = [DVec3; 2]>,
        rates: &mut [f64],
        block: &mut [f64],
    ) {
        let count = points.len();
        self.near_wake.normal_velocities(0, points, rates);
        for (&edge, rates) in self.near_edges.iter().zip(rates.chunks(BLOCK)) {
            let share = &shares[edge];
            for (&panel, &part) in share.panel.iter().zip(&share.part) {
                let to = &mut block[unknown(lattice, panel) * BLOCK..][..count];
                add_part(to, part, rates);
            }
        }
    }
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

#[cfg(test)]
mod tests {
    use crate::{AirLoads, AirSettings, Lattice, NodeMotion, Surface};
    use wingbeat_math::DVec3;

    /// In a row of up to a panel all that is shed within the step sits on the edge; in longer ones strips have a part.
    #[test]
    fn exact_edges_of_newest_rows_are_in_the_matrix_where_they_have_a_part() {
        let edges = |step: f64| {
            let nodes = (0..25).map(|k| DVec3::new((k / 5) as f64, (k % 5) as f64, 0.0));
            let motion = NodeMotion {
                position: nodes.collect(),
                velocity: vec![DVec3::ZERO; 25],
            };
            let settings = AirSettings::accurate(1.0, DVec3::new(1.0, 0.0, 0.2));
            let lattice = Lattice::new(vec![Surface::grid("wing", 4, 4)], settings).unwrap();
            let (mut state, mut ws) = (lattice.initial_state(&motion), lattice.workspace());
            let mut loads = AirLoads::default();
            for k in 0..2 {
                let time = step * k as f64;
                (lattice.loads(&state, time, step, &motion, &mut ws, &mut loads)).unwrap();
                lattice.accept(&mut state, &motion, &loads).unwrap();
                lattice.convect(&mut state, step, &mut ws).unwrap();
            }
            (lattice.loads(&state, 2.0 * step, step, &motion, &mut ws, &mut loads)).unwrap();
            let seen = &ws.boundary.influence.sources.near_edges;
            (seen.len(), ws.filaments.near_wake.len())
        };
        let (short, long) = (edges(0.8), edges(2.5));
        println!("{short:?} {long:?}");
        assert_eq!(short.0, 0);
        assert!(0 < long.0 && long.0 < long.1, "{long:?}");
    }
}
