//! Suction at leading edges: what each strip has, and what has to leave so that none has more than it holds.
//!
//! A lattice sees normal velocities at the control points only, so vorticity nearer to the edge than a panel
//! acts on the suction parameter ([`LeadingSection`]) with what it makes at a few points. What it makes along
//! the leading panel, over theta, is larger. The net circulation counts with that difference besides: without
//! it a plate of six panels that pitches to 45 degrees sheds two thirds of what it should while it pitches.
//!
//! What leaves within the step lies half a row from the edge ([`NEW_VORTEX`](crate::wake)). Its strength in
//! each strip follows together with the circulations of the panels, in one flow: either the strip has less than
//! it holds and nothing leaves, or it has as much as it holds and what leaves has the sign of its suction.

use crate::geometry::Strip;
use crate::lattice::Lattice;
use crate::settings::LeadingEdge;
use crate::solve::influence::Instant;
use crate::solve::leading_section::LeadingSection;
use crate::solve::unknowns::unknown;
use crate::wake::NEW_VORTEX;
use std::f64::consts::PI;
use wingbeat_math::{DVec3, DenseLu};
use wingbeat_vortex::Points;

/// Places of a strip where velocities are wanted: as many in even parts of theta along the leading panel, and
/// last the two foremost control points.
pub(crate) const PLACES: usize = 5;

/// Part of the effect of a vortex straight ahead that what leaves has at least on the suction of its edge: that
/// of one 133 degrees from there. A plate that pitches to 45 degrees sheds as it does without this bound.
const LEAST: f64 = 0.4;

/// Rounds of changes to all strips at once; then one strip changes at a time.
const ALL_AT_ONCE: usize = 8;

/// A strip behind a leading edge at one instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeadingStrip {
    pub section: LeadingSection,
    /// Net circulation by a normal velocity at each of the places that the lattice does not see [m].
    pub weights: [f64; PLACES],
}

impl LeadingStrip {
    pub fn of(now: Instant, strip: &Strip) -> Self {
        let here = (now.lattice, now.panels, now.time);
        let section = LeadingSection::of(here, strip, &now.motion.position);
        let [first, second, c] = section.extent;
        let [a, b] = [first, second].map(|x| angle(x, c));
        let even = a / PI / (PLACES - 2) as f64;
        let mut weights = [even; PLACES];
        weights[PLACES - 2] = -section.weights[0];
        weights[PLACES - 1] = (b - a) / PI - section.weights[1];
        Self {
            section,
            weights: weights.map(|w| w * section.per_speed),
        }
    }

    /// Net circulation of the leading edge of the strip that counts, where the unknowns have the circulations
    /// `gamma` and the newest ring makes `ring` [m2/s].
    pub fn counted(&self, lattice: &Lattice, strip: &Strip, (gamma, ring): (&[f64], f64)) -> f64 {
        let of = |p: usize| gamma[unknown(lattice, p)];
        let first = of(strip.panels[0]);
        let second = strip.panels.get(1).map_or(0.0, |&p| of(p) - first);
        self.section.counted([first + ring, second], 1.0)
    }

    /// What a unit of circulation changes of the net one by leaving, at least in size \[1\], the newest free
    /// nodes being at `row` [m, N].
    ///
    /// A vortex at the distance s from the edge of a thin airfoil changes the net circulation of its leading
    /// panel by `-sqrt(h / (pi s)) cos(f / 2)`, f the angle between the way there and straight ahead, for the
    /// normal velocity that it makes has the integral `cos(f / 2) / (2 sqrt(s c))` over theta. Where a wing has
    /// turned into its newest row, f is 180 degrees in the lattice: what leaves would have no effect, and
    /// whatever is asked for would leave. The sheet itself leaves the edge straight ahead and bends: evenly
    /// bent, from there to f, it has at least 0.78 of what it has straight ahead. [`LEAST`] of it is what is
    /// counted at least. A vortex at the edge itself takes all that it is.
    pub fn least_effect(&self, row: DVec3, normal: DVec3) -> f64 {
        let way = row - self.section.middle;
        let distance = NEW_VORTEX * way.dot(self.section.aft).hypot(way.dot(normal));
        let ahead = (self.section.extent[0] / (PI * distance).max(f64::MIN_POSITIVE)).sqrt();
        -LEAST * ahead.min(1.0)
    }

    /// Appends the places along the leading panel; the two foremost control points are at `points`.
    pub fn places(&self, points: [DVec3; 2], out: &mut Points) {
        let [h, _, c] = self.section.extent;
        let even = PLACES - 2;
        for k in 0..even {
            let theta = angle(h, c) * (k as f64 + 0.5) / even as f64;
            let x = 0.5 * c * (1.0 - theta.cos());
            out.push(self.section.middle + x * self.section.aft);
        }
        points.into_iter().for_each(|p| out.push(p));
    }
}

/// Angle theta at a place of the chord.
fn angle(x: f64, chord: f64) -> f64 {
    (1.0 - 2.0 * x / chord).clamp(-1.0, 1.0).acos()
}

/// What leaves the strips whose edges may shed.
#[derive(Default)]
pub(crate) struct Release {
    /// Net circulation of each, counted with what the lattice does not see, if nothing leaves; and by what
    /// leaves, row by row.
    pub net: Vec<f64>,
    pub by_leaving: Vec<f64>,
    /// What each may have [m2/s].
    pub most: Vec<f64>,
    /// What leaves, and what each has then.
    pub leaving: Vec<f64>,
    pub held: Vec<f64>,
    /// Sign of the suction of strips from which something leaves, else zero.
    sign: Vec<f64>,
    rows: Vec<f64>,
    lu: DenseLu,
}

impl Release {
    /// Whether any strip has more than it may have if nothing leaves.
    pub fn is_due(&self) -> bool {
        let mut both = self.net.iter().zip(&self.most);
        both.any(|(net, most)| net.abs() > *most)
    }

    /// Makes what leaves strip `j` act on its own net circulation by so much that the others, as far as they
    /// act against it, leave at least `least`, a negative number; returns what that gives.
    ///
    /// So strips that shed alike, as those of plane flow, shed no more than what is too much over `-least`.
    /// Bounded by itself alone a strip is not: what leaves its neighbours may act against it by nearly as much
    /// as its own does, and the whole edge would have to shed a hundred times what is too much.
    pub fn bound(&mut self, j: usize, least: f64) -> f64 {
        let n = self.net.len();
        let row = &mut self.by_leaving[j * n..(j + 1) * n];
        let others = row.iter().enumerate().filter(|(k, _)| *k != j);
        let against: f64 = others.map(|(_, by)| by.max(0.0)).sum();
        let bounded = row[j].min(least - against);
        let given = bounded - row[j];
        row[j] = bounded;
        given
    }

    /// Nothing leaves.
    pub fn none(&mut self) {
        self.leaving.clear();
        self.leaving.resize(self.net.len(), 0.0);
        self.held.clone_from(&self.net);
    }

    /// Finds what leaves: strips that have too much begin to shed, strips that would take back cease. Where no
    /// choice of strips is right each sheds what it has too much. Returns how many strips do that.
    pub fn converge(&mut self) -> u64 {
        self.none();
        self.sign.clear();
        self.sign.resize(self.net.len(), 0.0);
        for round in 0..ALL_AT_ONCE + 4 * self.net.len() {
            if !self.change(round >= ALL_AT_ONCE) {
                return 0;
            }
            if self.solve().is_err() {
                break;
            }
        }
        self.shed_what_is_too_much()
    }

    /// What is more than the edge may have leaves each strip, whatever that does to the others. Returns the
    /// number of strips.
    fn shed_what_is_too_much(&mut self) -> u64 {
        let both = self.net.iter().zip(&self.most);
        self.leaving.clear();
        (self.leaving).extend(both.map(|(net, most)| net - net.clamp(-most, *most)));
        for j in 0..self.net.len() {
            self.held[j] = self.net[j] + self.answer(j);
        }
        self.leaving.iter().filter(|l| **l != 0.0).count() as u64
    }

    /// What all that leaves adds to the net circulation of strip `j`.
    fn answer(&self, j: usize) -> f64 {
        let n = self.net.len();
        let row = &self.by_leaving[j * n..(j + 1) * n];
        row.iter().zip(&self.leaving).map(|(m, x)| m * x).sum()
    }

    /// Changes which strips shed, only the first that is wrong if `one`; says whether any was wrong.
    fn change(&mut self, one: bool) -> bool {
        let mut any = false;
        for j in 0..self.net.len() {
            let sign = self.sign[j];
            let right = match sign == 0.0 {
                true if self.held[j].abs() > self.most[j] => self.held[j].signum(),
                false if self.leaving[j] * sign < 0.0 => 0.0,
                _ => sign,
            };
            if right != sign {
                (self.sign[j], any) = (right, true);
                if one {
                    break;
                }
            }
        }
        any
    }

    /// What leaves the strips that shed, so that each has what it may have.
    fn solve(&mut self) -> Result<(), wingbeat_math::LuError> {
        let n = self.net.len();
        self.lu.resize(n);
        self.rows.clone_from(&self.by_leaving);
        for j in 0..n {
            match self.sign[j] == 0.0 {
                true => {
                    self.rows[j * n..(j + 1) * n].fill(0.0);
                    self.rows[j * n + j] = 1.0;
                    self.leaving[j] = 0.0;
                }
                false => self.leaving[j] = self.sign[j] * self.most[j] - self.net[j],
            }
        }
        self.lu.factor(&self.rows)?;
        self.lu.solve_in_place(&mut self.leaving);
        for j in 0..n {
            self.held[j] = match self.sign[j] == 0.0 {
                true => self.net[j] + self.answer(j),
                false => self.sign[j] * self.most[j],
            };
        }
        Ok(())
    }
}

/// What leading edges may have of the suction parameter, if what leaves them is part of the solution.
pub(crate) fn threshold(lattice: &Lattice) -> Option<f64> {
    match lattice.settings().leading {
        LeadingEdge::SuctionImplicit { threshold, .. } => Some(threshold),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neighbours that act against each other by nearly as much as each acts on itself: what leaves has a bound.
    #[test]
    fn limit_what_leaves_has_a_bound_where_neighbours_act_against_each_other() {
        const LEAST: f64 = -0.3;
        let excess = 0.004;
        let mut release = Release {
            net: vec![1.0 + excess; 3],
            by_leaving: vec![-0.3, 0.15, 0.05, 0.15, -0.3, 0.149, 0.05, 0.15, -0.3],
            most: vec![1.0; 3],
            ..Release::default()
        };
        let given = [0, 1, 2].map(|j| release.bound(j, LEAST));
        assert_eq!(release.converge(), 0);
        for (j, given) in given.iter().enumerate() {
            assert!((release.held[j] - 1.0).abs() < 1e-12);
            assert!(*given < 0.0 && (release.leaving[j] + excess / LEAST).abs() < 1e-12);
        }
        // Straight ahead neighbours help, and nothing is given.
        let mut ahead = Release {
            net: vec![1.0 + excess; 2],
            by_leaving: vec![-0.6, -0.1, 0.05, -0.6],
            ..Release::default()
        };
        assert_eq!([0, 1].map(|j| ahead.bound(j, LEAST)), [0.0; 2]);
    }

    /// A strip whose suction grows with what leaves it has no solution: it sheds what it has too much, and is counted.
    #[test]
    fn behaves_strips_without_a_solution_shed_what_they_have_too_much_and_are_counted() {
        let mut release = Release {
            net: vec![2.0, 0.5],
            by_leaving: vec![0.5, 0.0, 0.0, -0.5],
            most: vec![1.0, 1.0],
            ..Release::default()
        };
        assert!(release.is_due());
        assert_eq!(release.converge(), 1);
        assert_eq!(release.leaving, [1.0, 0.0]);
        assert_eq!(release.held, [2.5, 0.5]);
    }
}
