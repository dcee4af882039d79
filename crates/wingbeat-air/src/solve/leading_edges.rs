//! The leading edges in the solution: their suction in the flow of this instant, and what leaves them.

use crate::error::AirError;
use crate::solve::influence::{Influence, Instant};
use crate::solve::leaving::{InducedBy, Leaving};
use crate::solve::suction::{LeadingStrip, PLACES, Release, threshold};
use crate::solve::unknowns::{is_computed, panel, unknown};
use crate::wake::{Filaments, Sums, WakeVelocityCache};
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

/// The free wakes, which the sums hold.
pub(crate) struct FreeWakes<'a> {
    pub sums: &'a mut Sums,
    /// How far a place may go before they are summed for it again [m].
    pub near: f64,
}

/// Memory of what happens at leading edges.
#[derive(Default)]
pub(crate) struct LeadingEdges {
    strips: Vec<LeadingStrip>,
    leaving: Leaving,
    release: Release,
    /// Places along the leading panels, each with the normal, and the velocity of the free wakes there.
    places: Points,
    at_places: Vec<[DVec3; 2]>,
    free_wake: WakeVelocityCache,
    velocity: Points,
    /// Control points of the unknowns, with the normals.
    at_points: Vec<[DVec3; 2]>,
    /// What the circulations are by what leaves each strip, column by column.
    answer: Vec<f64>,
    /// Suction parameter of each strip \[1\].
    pub suction: Vec<f64>,
    /// What the bound on the effect of what leaves has given to it, strip by strip \[1\].
    given: Vec<f64>,
    /// Strips that shed with a bounded effect, or what they had too much for want of a solution.
    pub unfound: u64,
}

impl LeadingEdges {
    /// What leaves each strip, counted as circulation of panels [m2/s], where that is part of the solution;
    /// `gamma` has the circulations of the unknowns if nothing leaves, and gets those of what does. The
    /// filaments have the circulations of wakes alone.
    ///
    /// # Errors
    /// Equations without a unique solution.
    pub(crate) fn converge(
        &mut self,
        now: Instant,
        (filaments, wakes): (&Filaments, FreeWakes),
        influence: &mut Influence,
        (gamma, leaving): (&mut [f64], &mut [f64]),
    ) -> Result<(), AirError> {
        self.suction.clear();
        self.suction.resize(now.lattice.strips().len(), 0.0);
        self.unfound = 0;
        let Some(threshold) = threshold(now.lattice) else {
            return Ok(());
        };
        self.strips.clear();
        let strips = now.lattice.strips().iter();
        self.strips
            .extend(strips.map(|strip| LeadingStrip::of(now, strip)));
        self.leaving.load(now.lattice, filaments);
        self.place(now, wakes);
        self.take_limits(now, filaments, (threshold, gamma));
        self.count_unseen(now, filaments);
        self.release.none();
        if self.release.is_due() {
            self.take_answers(now, filaments, influence)?;
            self.bound_effects(now);
            self.unfound = self.release.converge();
            self.take_back();
            self.answer(gamma);
        }
        self.report(now, filaments, (gamma, leaving));
        Ok(())
    }

    /// Net circulation of the leading edge of strip `k` that counts, if nothing leaves.
    fn net(&self, now: Instant, filaments: &Filaments, gamma: &[f64], k: usize) -> f64 {
        let strip = &now.lattice.strips()[k];
        let ring = filaments.bound.gamma[strip.edge];
        self.strips[k].counted(now.lattice, strip, (gamma, ring))
    }

    /// Places along the leading panels, and the velocity of the free wakes there.
    fn place(&mut self, now: Instant, wakes: FreeWakes) {
        let lattice = now.lattice;
        self.places.clear();
        self.at_places.clear();
        for &s in &lattice.suction().computed {
            let panels = &lattice.strips()[s].panels;
            let foremost = [panels[0], panels[1.min(panels.len() - 1)]];
            let points = foremost.map(|p| now.panels.point[p]);
            self.strips[s].places(points, &mut self.places);
            let new = self.at_places.len()..self.places.len();
            let last = self.places.len() - 1;
            let panel = |i: usize| foremost[usize::from(i == last)];
            let with_normal = |i: usize| [self.places.get(i), now.panels.normal[panel(i)]];
            self.at_places.extend(new.map(with_normal));
        }
        let (sums, mirrors) = (wakes.sums, lattice.mirrors());
        let (places, velocity) = (&self.places, &mut self.velocity);
        (self.free_wake).velocity(sums, places, wakes.near, mirrors, velocity);
    }

    /// Net circulations of the edges as the lattice has them, and what the edges may have.
    fn take_limits(&mut self, now: Instant, filaments: &Filaments, (most, gamma): (f64, &[f64])) {
        let lattice = now.lattice;
        self.release.net.clear();
        self.release.most.clear();
        for &s in &lattice.suction().computed {
            let wake = lattice.topology().edges[lattice.strips()[s].edge].wake;
            let has_row = wake.is_some_and(|w| now.state.sheets[w.sheet].rows() > 0);
            self.release.most.push(match has_row {
                true => most * self.strips[s].section.unit(),
                false => f64::INFINITY, // no vortex has a place to go yet
            });
            let net = self.net(now, filaments, gamma, s);
            self.release.net.push(net);
        }
    }

    /// Counts what wakes make along the leading panels and the lattice does not see: those that are there, and
    /// what leaves.
    fn count_unseen(&mut self, now: Instant, filaments: &Filaments) {
        let computed = &now.lattice.suction().computed;
        let (n, strips) = (computed.len(), &self.strips);
        let weight = |i: usize| strips[computed[i / PLACES]].weights[i % PLACES];
        let Release {
            net, by_leaving, ..
        } = &mut self.release;
        for (i, [_, normal]) in self.at_places.iter().enumerate() {
            net[i / PLACES] += weight(i) * self.velocity.get(i).dot(*normal);
        }
        by_leaving.clear();
        by_leaving.resize(n * n, 0.0);
        let see = |i: usize, part: InducedBy, rate: f64| match part {
            InducedBy::Fixed => net[i / PLACES] += weight(i) * rate,
            InducedBy::Leaving(k) => by_leaving[i / PLACES * n + k] += weight(i) * rate,
        };
        (self.leaving).near_wake(now.lattice, &filaments.shares, &self.at_places, see);
    }

    /// How the circulations, and so the net ones at the edges, answer to what leaves.
    fn take_answers(
        &mut self,
        now: Instant,
        filaments: &Filaments,
        influence: &mut Influence,
    ) -> Result<(), AirError> {
        let lattice = now.lattice;
        let computed = &lattice.suction().computed;
        let (n, strips) = (influence.order(), computed.len());
        self.at_points.clear();
        let points = (0..n).map(|i| panel(lattice, i));
        let with_normal = |p: usize| [now.panels.point[p], now.panels.normal[p]];
        self.at_points.extend(points.map(with_normal));
        let answer = &mut self.answer;
        answer.clear();
        answer.resize(n * strips, 0.0);
        let see = |i: usize, part: InducedBy, rate: f64| {
            if let InducedBy::Leaving(k) = part {
                answer[k * n + i] -= rate;
            }
        };
        (self.leaving).near_wake(lattice, &filaments.shares, &self.at_points, see);
        let see = |i: usize, k: usize, rate: f64| answer[k * n + i] -= rate;
        (self.leaving).leading_edges(lattice, &self.at_points, see);
        for (k, column) in answer.chunks_mut(n).enumerate() {
            let carried = lattice.carried().iter().map(|c| c.panel);
            (carried.filter(|&p| is_computed(lattice, p)))
                .for_each(|p| column[unknown(lattice, p)] = 0.0);
            influence.solve_another(now.state, column)?;
            for (u, &s) in computed.iter().enumerate() {
                let own = if u == k { -1.0 } else { 0.0 };
                let change = self.strips[s].counted(lattice, &lattice.strips()[s], (column, own));
                self.release.by_leaving[u * strips + k] += change;
            }
        }
        Ok(())
    }

    /// Gives what leaves a strip so much effect on its own suction that what leaves all of them together has at
    /// least that which it has where the wing has turned into its newest row.
    fn bound_effects(&mut self, now: Instant) {
        let computed = &now.lattice.suction().computed;
        self.given.clear();
        self.given.resize(computed.len(), 0.0);
        for (u, &s) in computed.iter().enumerate() {
            let strip = &now.lattice.strips()[s];
            let normal = now.panels.normal[strip.panels[0]];
            if let Some(row) = now.newest_row(strip.edge) {
                let least = self.strips[s].least_effect(row, normal);
                self.given[u] = self.release.bound(u, least);
            }
        }
    }

    /// Takes from the suction that is reported what the bound on its effect has given to what leaves, and
    /// counts the strips that shed so, unless all that shed are counted for want of a solution.
    fn take_back(&mut self) {
        let is_counted = self.unfound > 0;
        let release = &mut self.release;
        let strips = release.held.iter_mut().zip(&release.leaving);
        for ((held, leaving), given) in strips.zip(&self.given) {
            *held -= given * leaving;
            self.unfound += u64::from(!is_counted && given * leaving != 0.0);
        }
    }

    /// Adds to the circulations what they are by what leaves.
    fn answer(&self, gamma: &mut [f64]) {
        let columns = self.answer.chunks(gamma.len());
        for (column, left) in columns.zip(&self.release.leaving) {
            for (gamma, answer) in gamma.iter_mut().zip(column) {
                *gamma += left * answer;
            }
        }
    }

    /// Suction and what leaves, strip by strip; edges that do not shed have what the lattice gives them.
    fn report(
        &mut self,
        now: Instant,
        filaments: &Filaments,
        (gamma, leaving): (&[f64], &mut [f64]),
    ) {
        for (k, unknown) in now.lattice.suction().unknown.iter().enumerate() {
            let net = match unknown {
                Some(u) => {
                    leaving[k] = self.release.leaving[*u];
                    self.release.held[*u]
                }
                None => self.net(now, filaments, gamma, k),
            };
            self.suction[k] = self.strips[k].section.parameter(net.abs());
        }
    }
}
