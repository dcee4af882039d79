//! Which cells of targets and sources act on each other how: a walk through pairs of cells.

use crate::interpolation::boxes::{Boxes, Cell};
use crate::interpolation::translate::is_in_range;

/// Sources of every target, both by number.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lists {
    pairs: Vec<[u32; 2]>,
    ends: Vec<u32>,
    sources: Vec<u32>,
}

impl Lists {
    fn clear(&mut self) {
        self.pairs.clear();
    }

    fn push(&mut self, target: usize, source: usize) {
        self.pairs.push([target as u32, source as u32]);
    }

    /// Puts the sources of each of so many targets beside each other, in the order found.
    fn sort(&mut self, targets: usize) {
        self.ends.clear();
        self.ends.resize(targets + 1, 0);
        for [target, _] in &self.pairs {
            self.ends[*target as usize + 1] += 1;
        }
        for t in 0..targets {
            self.ends[t + 1] += self.ends[t];
        }
        self.sources.clear();
        self.sources.resize(self.pairs.len(), 0);
        for &[target, source] in self.pairs.iter().rev() {
            let end = &mut self.ends[target as usize + 1];
            *end -= 1;
            self.sources[*end as usize] = source;
        }
        // What were ends are beginnings now, each in the place after its own.
        self.ends.push(self.pairs.len() as u32);
    }

    /// Sources of a target.
    pub fn of(&self, target: usize) -> &[u32] {
        &self.sources[self.ends[target + 1] as usize..self.ends[target + 2] as usize]
    }

    /// Pairs in all.
    pub fn len(&self) -> usize {
        self.pairs.len()
    }
}

/// Pairs of filament and target that cost as much as a grid on a grid, measured: so many are always near, and leaf on
/// leaf are no more.
pub(crate) const FEW: usize = 12_300;

/// What acts on what.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pairs {
    /// Cells on cells, by the points of their grids.
    pub far: Lists,
    /// Leaves on leaves, one by one.
    pub near: Lists,
    /// Pairs of filament and target of these.
    pub near_pairs: u64,
}

impl Pairs {
    /// Finds all of them; cells are far from each other where half their diagonals together are less than
    /// `ratio` times their softened distance.
    pub fn find(&mut self, targets: &Boxes, sources: &Boxes, ratio: f64) {
        self.far.clear();
        self.near.clear();
        self.near_pairs = 0;
        let mut walk = Walk {
            pairs: self,
            targets,
            sources,
            ratio,
        };
        walk.visit(0, 0);
        self.far.sort(targets.cells.len());
        self.near.sort(targets.leaves().count());
    }
}

struct Walk<'a> {
    pairs: &'a mut Pairs,
    targets: &'a Boxes,
    sources: &'a Boxes,
    ratio: f64,
}

impl Walk<'_> {
    fn visit(&mut self, t: usize, s: usize) {
        let (target, source) = (&self.targets.cells[t], &self.sources.cells[s]);
        if target.items.len() * source.items.len() <= FEW {
            return self.note_near(target, source);
        }
        if self.are_far(target, source) {
            return self.pairs.far.push(t, s);
        }
        let (of_target, of_source) = (self.targets.children(t), self.sources.children(s));
        let larger = source.size >= target.size;
        match (of_target, of_source) {
            (_, Some(children)) if larger || of_target.is_none() => {
                children.into_iter().for_each(|s| self.visit(t, s));
            }
            (Some(children), _) => {
                children.into_iter().for_each(|t| self.visit(t, s));
            }
            _ => unreachable!("leaf on leaf are few"),
        }
    }

    /// Whether both are small beside their softened distance.
    fn are_far(&self, target: &Cell, source: &Cell) -> bool {
        let (one, two) = (&target.frame.middle, &source.frame.middle);
        let place2: f64 = (0..3).map(|d| (one[d] - two[d]).powi(2)).sum();
        let distance2 = place2 + one[3] + two[3];
        let size = target.size + source.size;
        size * size < self.ratio * self.ratio * distance2
            && is_in_range([&target.frame, &source.frame])
    }

    fn note_near(&mut self, target: &Cell, source: &Cell) {
        self.pairs.near_pairs += (target.items.len() * source.items.len()) as u64;
        for t in target.leaves.clone() {
            for s in source.leaves.clone() {
                self.pairs.near.push(t as usize, s as usize);
            }
        }
    }
}
