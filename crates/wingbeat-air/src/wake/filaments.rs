//! The vortex filaments of one instant: every edge of lattice and wakes once, with its net
//! circulation.

use crate::lattice::Lattice;
use crate::settings::AirSettings;
use crate::state::{AirState, WakeSheet};
use crate::wake::cores::{add_cores, join_cores};
use crate::wake::gathered::Gathered;
use crate::wake::near_wake::{
    NearWakeRow, NearWakeShare, RowShape, RowStrips, add_near_wake, at_edge, strips,
};
use wingbeat_math::DVec3;
use wingbeat_vortex::{Blob, Network, Points, WINDOW};

/// Columns of a wake sheet that are taken side by side: so many that the kernel still sees the nodes of one row when it
/// comes to the next.
const STRIP: usize = WINDOW * 3 / 4;

/// Filaments of lattice and wakes.
///
/// A shedding edge belongs to the bound network, with the circulation of its panel less that of
/// the newest wake ring, so that both are regularised alike.
#[derive(Clone, Debug, Default)]
pub struct Filaments {
    /// Edges of the lattice, in the order of [`crate::Topology::edges`].
    pub bound: Network,
    /// Edges of the newest rings from the shedding edges to the first free nodes: they follow the
    /// surfaces. Nodes: sheet after sheet, first the free row, last the shedding edge.
    pub near_wake: Network,
    /// How their circulations follow from those of the panels.
    pub(crate) shares: Vec<NearWakeShare>,
    /// Rows of nodes of the newest row of a sheet.
    levels: usize,
    /// Nodes of the rings behind leading edges from which wakes leave, which end the newest row of each sheet.
    inner: Vec<usize>,
    /// Where wakes leave the surfaces: nodes of the rings, at leading edges that hold suction nodes of the
    /// surfaces [m].
    roots: Vec<DVec3>,
    /// The newest row, sheet by sheet.
    pub(crate) newest: Vec<RowShape>,
    /// Of the sheet that is taken.
    row_strips: RowStrips,
    /// All other edges of the wakes, which do not move within a step. Nodes: sheet after sheet,
    /// oldest row first.
    pub wake: Network,
    /// What they and the blobs were made of.
    gathered: Gathered,
    /// What stretched edges of the wakes have given up, see [`AirSettings::wake_blob_length`].
    pub blobs: Vec<Blob>,
    /// Particles of all sheets.
    pub particles: Vec<Blob>,
}

impl Filaments {
    /// Takes the nodes from `position` and `state`, the wake circulations from `state` at time
    /// `t`; bound circulations are left zero.
    pub(crate) fn gather(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        t: f64,
        position: &[DVec3],
    ) {
        self.gather_bound(lattice, position);
        self.inner.clear();
        self.levels = strips(lattice.settings()) + 1;
        let is_known = (self.gathered).is(lattice, state, t, &self.wake.nodes);
        if !is_known {
            self.wake.clear();
            self.blobs.clear();
            self.gathered.take(lattice, state, t);
        }
        self.wake.nodes.core.clear(); // they follow from where the edges are, too
        self.near_wake.clear();
        self.shares.clear();
        self.newest
            .resize_with(state.sheets.len(), RowShape::default);
        for (s, (sheet, root)) in state.sheets.iter().zip(lattice.sheets()).enumerate() {
            let edge = root.nodes.iter().map(|&n| self.roots[n]);
            if lattice.settings().is_symmetric() {
                let cores = &mut self.wake.nodes.core;
                add_cores(cores, sheet, lattice.settings(), t, edge.clone());
            }
            if !is_known {
                self.add_sheet(sheet, lattice.settings(), t);
            }
            let edge = root.nodes.iter().map(|&n| self.roots[n]);
            self.newest[s].take((lattice, state), s, &self.bound.nodes, t);
            let row = NearWakeRow {
                lattice,
                state,
                s,
                shape: &self.newest[s],
            };
            let nodes = &self.bound.nodes;
            let inner = root.nodes.iter().enumerate();
            let inner = inner.map(|(c, &n)| (c, nodes.get(n), self.roots[n]));
            let inner = inner.filter(|(_, ring, root)| ring != root && sheet.rows() > 0);
            self.inner.push(inner.clone().count());
            let inner = inner.map(|(c, ring, _)| (c, ring));
            let filaments = (&mut self.near_wake, &mut self.shares, &mut self.row_strips);
            add_near_wake(filaments, &row, t, edge, inner);
        }
        if lattice.settings().is_symmetric() {
            let joined = &lattice.topology().joined_columns;
            join_cores(&mut self.wake.nodes.core, joined, &state.sheets);
        }
        self.particles.clear();
        if let Some(settings) = &lattice.settings().particles {
            for set in state.sheets.iter().map(|s| &s.particles) {
                let all = (0..set.len()).map(|i| set.at(i, settings, t));
                self.particles.extend(all);
            }
        }
    }

    /// All wake nodes that are to be moved (mirror images are reflected later), those on the shedding edges
    /// too: sheet after sheet, oldest row first, the shedding edge last.
    pub(crate) fn movable(&self, lattice: &Lattice, state: &AirState, out: &mut Points) {
        out.clear();
        for (k, (sheet, root)) in state.sheets.iter().zip(lattice.sheets()).enumerate() {
            if lattice.reflected_sheet(k).is_some() {
                continue;
            }
            sheet.nodes.iter().for_each(|x| out.push(x));
            let edge = root.nodes.iter().map(|&n| self.roots[n]);
            edge.for_each(|x| out.push(x));
        }
        if lattice.settings().is_symmetric() {
            self.add_cores(lattice, state, &mut out.core);
        }
    }

    /// Gives lattice and newest rows the cores with which they act on other filaments and are acted on, where
    /// action is to be reaction: those of the lattice as wide as the newest free nodes have them in the mean,
    /// those of a newest row in between. One width for a whole lattice, for where it varies along a filament,
    /// action is not quite reaction. Control points, which carry no vorticity, go on to see the cores of the
    /// settings.
    pub(crate) fn soften(&mut self, lattice: &Lattice, state: &AirState) {
        if !lattice.settings().is_symmetric() {
            return;
        }
        let attached = self.attached_core(lattice, state);
        let free = &self.wake.nodes.core;
        let sheets = state.sheets.iter().zip(&self.inner);
        let ends = sheets.scan(0, |end, (sheet, inner)| {
            *end += sheet.nodes.len();
            Some((sheet, *inner, *end))
        });
        let newest = ends.filter(|(sheet, ..)| sheet.rows() > 0);
        let newest = newest.map(|(sheet, inner, end)| (inner, &free[end - sheet.columns - 1..end]));
        self.bound.nodes.core.clear();
        self.bound
            .nodes
            .core
            .resize(self.bound.nodes.len(), attached);
        self.near_wake.nodes.core.clear();
        for (inner, cores) in newest {
            for level in (0..self.levels).rev() {
                let part = level as f64 / (self.levels - 1) as f64; // 1 at the free row
                let between = cores.iter().map(|free| attached + part * (free - attached));
                self.near_wake.nodes.core.extend(between);
            }
            let ends = std::iter::repeat_n(attached, inner);
            self.near_wake.nodes.core.extend(ends);
        }
    }

    /// Mean squared core radius [m2] of the newest free nodes, those of joined columns counted once, as are those on a
    /// plane with their images; that of new ones where there are none yet, that of the lattice where no edge sheds any.
    fn attached_core(&self, lattice: &Lattice, state: &AirState) -> f64 {
        let joined = &lattice.topology().joined_columns;
        let is_counted = |k: usize, c: usize| !joined.iter().any(|j| j.0[1] == (k, c));
        let planes = &lattice.topology().plane_columns;
        let weight = |k: usize, c: usize| match planes.contains(&(k, c)) {
            true => 0.5,
            false => 1.0,
        };
        let (mut sum, mut count, mut end) = (0.0, 0.0, 0);
        for (k, sheet) in state.sheets.iter().enumerate() {
            end += sheet.nodes.len();
            let first = end - (sheet.columns + 1).min(sheet.nodes.len());
            let newest = self.wake.nodes.core[first..end].iter().enumerate();
            let once = newest.filter(|(c, _)| is_counted(k, *c));
            let once = once.map(|(c, core)| (weight(k, c), core));
            count += once.clone().map(|(weight, _)| weight).sum::<f64>();
            sum += once.map(|(weight, core)| weight * core).sum::<f64>();
        }
        if count > 0.0 {
            return sum / count;
        }
        match state.sheets.is_empty() {
            true => lattice.settings().bound_core.core(0.0, 0.0),
            false => lattice.settings().wake_core.core(0.0, 0.0),
        }
    }

    /// Squared core radii of the movable nodes.
    fn add_cores(&self, lattice: &Lattice, state: &AirState, out: &mut Vec<f64>) {
        let mut first = 0;
        for (k, (sheet, root)) in state.sheets.iter().zip(lattice.sheets()).enumerate() {
            let nodes = first..first + sheet.nodes.len();
            first = nodes.end;
            if lattice.reflected_sheet(k).is_none() {
                out.extend_from_slice(&self.wake.nodes.core[nodes]);
                out.extend(root.nodes.iter().map(|&n| self.bound.nodes.core[n]));
            }
        }
    }

    /// Rows of nodes that the newest row of this sheet has in [`Self::near_wake`].
    pub(crate) fn near_levels(&self, sheet: &WakeSheet) -> usize {
        if sheet.rows() > 0 { self.levels } else { 0 }
    }

    /// Nodes of the rings that end the newest row of sheet `s` in [`Self::near_wake`].
    pub(crate) fn inner_nodes(&self, s: usize) -> usize {
        self.inner[s]
    }

    fn gather_bound(&mut self, lattice: &Lattice, position: &[DVec3]) {
        let model = lattice.settings().bound_core;
        self.bound.clear();
        position.iter().for_each(|&x| self.bound.nodes.push(x));
        let nodes = &mut self.bound.nodes;
        for (n, d) in lattice.rings().offsets(position, position) {
            nodes.add(n, d);
        }
        let suction = lattice.suction();
        let root = |(n, ring): (usize, DVec3)| match suction.is_front(n) {
            true => position[n],
            false => ring,
        };
        self.roots.clear();
        self.roots
            .extend(self.bound.nodes.iter().enumerate().map(root));
        for edge in &lattice.topology().edges {
            let length = (self.bound.nodes.get(edge.to) - self.bound.nodes.get(edge.from)).length();
            let core = model.core(length, 0.0);
            self.bound.push_edge(edge.from, edge.to, 0.0, core);
        }
    }

    /// Net circulation of every lattice edge, its panels' difference, less the newest wake ring's at a shedding
    /// edge; and of the newest rows: from the circulations of the panels and what leaves the leading edges.
    pub(crate) fn set_bound(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        [gamma, leaving]: [&[f64]; 2],
    ) {
        for (edge, net) in lattice.topology().edges.iter().zip(&mut self.bound.gamma) {
            let minus = edge.minus.map_or(0.0, |p| gamma[p]);
            let wake = edge.wake.map_or(0.0, |w| {
                let (s, shape) = (w.sheet, &self.newest[w.sheet]);
                let row = NearWakeRow {
                    lattice,
                    state,
                    s,
                    shape,
                };
                let [fixed, part] = at_edge(&row, w.column);
                let wake = fixed + part * gamma[edge.plus];
                match lattice.suction().of_column(s, w.column) {
                    Some(strip) => wake + leaving[strip],
                    None => wake,
                }
            });
            *net = match edge.is_end {
                true => 0.0,
                false => gamma[edge.plus] - minus - wake,
            };
        }
        for (share, net) in self.shares.iter().zip(&mut self.near_wake.gamma) {
            *net = share.net([gamma, leaving]);
        }
    }

    /// Free nodes of one wake sheet and the edges among them that lie at rings.
    fn add_sheet(&mut self, sheet: &WakeSheet, settings: &AirSettings, t: f64) {
        let (wake, blobs) = (&mut self.wake, &mut self.blobs);
        let base = wake.nodes.len();
        sheet.nodes.iter().for_each(|x| wake.nodes.push(x));
        let (rows, columns) = (sheet.rows(), sheet.columns);
        let age = |r: usize| t - sheet.shed_time[r];
        let mut push = |[r0, c0]: [usize; 2], [r1, c1]: [usize; 2], net: f64| {
            let from = base + r0 * (columns + 1) + c0;
            let to = base + r1 * (columns + 1) + c1;
            let (a, b) = (wake.nodes.get(from), wake.nodes.get(to));
            let length = (b - a).length();
            let core = settings.free_core(length, 0.5 * (age(r0) + age(r1)));
            let part = settings.blob_part(length);
            if part > 0.0 {
                blobs.push(Blob {
                    position: 0.5 * (a + b),
                    strength: part * net * (b - a),
                    core: settings.blob_variance(core),
                });
            }
            if part < 1.0 {
                wake.push_edge(from, to, (1.0 - part) * net, core);
            }
        };
        let there = |r: usize, c: usize, along: bool| sheet.borders_ring([r, c], along);
        for first in (0..=columns).step_by(STRIP) {
            let strip = |count: usize| first..count.min(first + STRIP);
            for r in 0..rows {
                for c in strip(columns).filter(|&c| there(r, c, true)) {
                    push([r, c], [r, c + 1], sheet.between_rows(r, c));
                }
                // The ends of plane flow move no air.
                let has_sides = r + 1 < rows && !settings.plane_wakes;
                let inner = |&c: &usize| has_sides && there(r, c, false);
                for c in strip(columns + 1).filter(inner) {
                    push([r, c], [r + 1, c], sheet.between_columns(r, c));
                }
            }
        }
    }

    /// Corners of the box around the nodes of the free wakes [m], N components: it stays within a step.
    pub(crate) fn bounds(&self) -> [DVec3; 2] {
        let ends = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        (self.wake.nodes.iter()).fold(ends, |[low, high], x| [low.min(x), high.max(x)])
    }

    /// Half the sum of circulation x moment of every filament about `origin`, or what stands for it
    /// ([`Lattice::impulse_point`]), which is the vector impulse per density [m4/s], N: `1/2 sum Gamma a x b` for
    /// filaments from a to b, and `1/2 x cross alpha` for blobs and particles; in plane flow as
    /// [`Lattice::impulse_part`] says.
    pub(crate) fn impulse(&self, lattice: &Lattice, origin: DVec3) -> DVec3 {
        let origin = lattice.impulse_point(origin);
        let open = lattice.impulse_part();
        let of = |net: &Network, part: &dyn Fn(usize) -> f64| {
            let mut sum = DVec3::ZERO;
            for (e, (&[a, b], &gamma)) in net.edges.iter().zip(&net.gamma).enumerate() {
                let a = net.nodes.get(a as usize) - origin;
                let b = net.nodes.get(b as usize) - origin;
                sum += part(e) * gamma * a.cross(b);
            }
            sum
        };
        let topology = lattice.topology();
        let bound = |e: usize| {
            let surface = topology.panel_surface[topology.edges[e].plus];
            match lattice.surfaces()[surface].closed {
                true => 0.5,
                false => open,
            }
        };
        let wakes = |_| open;
        let of_blob = |b: &Blob| 0.5 * (b.position - origin).cross(b.strength);
        let particles: DVec3 = self.particles.iter().map(of_blob).sum();
        let blobs: DVec3 = self.blobs.iter().map(of_blob).sum();
        let attached = of(&self.bound, &bound) + of(&self.near_wake, &wakes);
        attached + of(&self.wake, &wakes) + blobs + particles
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The kernel takes the root of a node again once it has looked at some hundred others.
    #[test]
    fn exact_edges_of_wide_sheets_are_there_once_and_find_their_nodes_in_sight() {
        const SIGHT: usize = WINDOW - 18; // two patches of nodes that come and go
        let rows = 20;
        for columns in [1, 40, STRIP - 1, STRIP, STRIP + 1, 250] {
            let mut sheet = WakeSheet {
                columns,
                gamma: (0..rows * columns).map(|k| k as f64).collect(),
                shed_time: vec![0.0; rows],
                converted: vec![0; columns],
                ..WakeSheet::default()
            };
            for k in 0..rows * (columns + 1) {
                let [r, c] = [k / (columns + 1), k % (columns + 1)].map(|i| i as f64);
                sheet.nodes.push(DVec3::new(r, c, 0.0));
            }
            let mut filaments = Filaments::default();
            filaments.add_sheet(&sheet, &AirSettings::benchmark(1.0, DVec3::X), 1.0);
            let mut edges = filaments.wake.edges.clone();
            edges.sort_unstable();
            edges.dedup();
            assert_eq!(edges.len(), rows * columns + (rows - 1) * (columns + 1));
            assert_eq!(edges.len(), filaments.wake.len());
            let mut last = vec![None; sheet.nodes.len()];
            let mut looks = 0;
            for &node in filaments.wake.edges.iter().flatten() {
                let seen = &mut last[node as usize];
                if seen.is_none_or(|at: usize| looks - at > SIGHT) {
                    *seen = Some(looks);
                    looks += 1;
                }
            }
            // Nodes between two strips twice.
            let twice = columns / STRIP * rows;
            assert!(looks <= sheet.nodes.len() + twice, "{columns}: {looks}");
        }
    }
}
