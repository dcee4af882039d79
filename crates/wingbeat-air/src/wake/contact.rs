//! Wakes that meet surfaces: free nodes do not pass through wings nor into bodies.
//!
//! An inviscid sheet would slide along a surface it meets. A discrete one, moved by finite steps,
//! can jump through: then a filament lies inside a body or on the wrong side of a wing, and the
//! loads blow up. So a node whose path crosses a wing, or ends nearer to a surface than the
//! clearance, ends at the clearance from it, on the side it came from; only the part of its
//! displacement normal to the surface is changed. Every such event is counted.
//!
//! The push is a continuous function of the path. Nodes that have just been shed lie on the edge of
//! a wing, and between two panels, to the last bit: where the push jumped there, rounding would
//! decide, on the left wing otherwise than on the right one. So
//! - within a clearance of the edges of a wing the push falls smoothly to zero;
//! - between panels it is shared by both, also between a panel and its mirror image where an edge lies on a plane of
//!   images;
//! - it is blocked by the wing where it crosses it, `x(s)` with `s = |h0| / (|h0| + |h1|)` for heights h0 at
//!   the start and h1 at the end (both raised by half of what is no height); what is not blocked there, near an
//!   edge, is kept off on the side where it ends;
//! - pushes of several surfaces add up, each one computed from the same path;
//! - what closed parts do fades out from one to two clearances beyond the sphere around them: coarse panels
//!   are so tilted that their planes ask for a clearance still where the part is farther away.
//!
//! Everything is decided on the path as the surface sees it, so that it does not depend on the inertial frame.
//!
//! The surfaces at the end of the step are not known yet (the wake is moved before the bodies):
//! they are extrapolated with the velocities of the accepted step, an error of half the
//! acceleration times the step squared, which the clearance must exceed.

use crate::images::Plane;
use crate::lattice::Lattice;
use crate::state::AirState;
use rayon::prelude::*;
use wingbeat_math::{DVec3, smoothstep};

/// Height over a surface, in clearances, below which the side of a node is uncertain.
const THIN: f64 = 1e-3;
/// Part of the clearance by which a node must be moved to be counted.
const COUNTED: f64 = 1e-2;
/// Distance from the sphere around a surface, in clearances, from which on nothing is pushed. Thin surfaces
/// push from there on in no case: the path is at most twice as high where they look for it as where it ends.
const REACH: f64 = 2.0;

/// A panel at the start and at the end of the step.
struct Panel {
    corners: [[DVec3; 4]; 2],
    centre: [DVec3; 2],
    normal: [DVec3; 2],
    /// Which of its sides, from a corner to the next one, no other panel shares that is in the way.
    is_border: [bool; 4],
    /// Largest distance of a corner from the centre.
    radius: f64,
}

/// One surface, or several joined ones, with the sphere that holds it.
#[derive(Default)]
struct Obstacle {
    closed: bool,
    panels: Vec<Panel>,
    /// The sides no other panel shares: both ends, at the start and at the end of the step.
    border: Vec<[[DVec3; 2]; 2]>,
    /// Centre of the sphere at the start and at the end of the step; its radius holds for both.
    sphere: [DVec3; 2],
    radius: f64,
}

/// All surfaces in the way of the wakes during one step.
#[derive(Default)]
pub(crate) struct Obstacles {
    surfaces: Vec<Obstacle>,
    clearance: f64,
    /// Groups of surfaces and the planes of their images, while those are added.
    added: Vec<(usize, Plane)>,
}

impl Obstacles {
    /// Takes the surfaces of `state`, moving on for `dt` [s]; none if the clearance is zero.
    pub(crate) fn take(&mut self, lattice: &Lattice, state: &AirState, dt: f64) {
        self.clearance = lattice.settings().clearance;
        let count = if self.clearance > 0.0 {
            lattice.surfaces().len()
        } else {
            0
        };
        let ends = |n: usize| {
            let x = state.position[n];
            [x, x + dt * state.velocity[n]]
        };
        self.surfaces.resize_with(count, Obstacle::default);
        self.surfaces.iter_mut().for_each(Obstacle::clear);
        for s in (0..count).filter(|&s| !lattice.surfaces()[s].carry_through) {
            self.surfaces[lattice.joined_groups()[s]].add(lattice, s, ends);
        }
        if count > 0 {
            self.add_images(lattice, &state.position);
        }
        self.surfaces.iter_mut().for_each(Obstacle::enclose);
    }

    /// Adds the mirror images of surfaces that are joined to them on a plane, which are one surface with them.
    fn add_images(&mut self, lattice: &Lattice, position: &[DVec3]) {
        let topology = lattice.topology();
        let mut added = std::mem::take(&mut self.added);
        added.clear();
        for line in &topology.plane_lines {
            let node = line[line.len() / 2];
            let group = lattice.joined_groups()[topology.surface_of(node)];
            let Some(&plane) = lattice.nearest_plane(position[node]) else {
                continue;
            };
            if !added.contains(&(group, plane)) {
                added.push((group, plane));
                self.surfaces[group].add_image(&plane);
            }
        }
        self.added = added;
    }

    /// Mends the ends of the paths `from` -> `to` of all nodes; returns how many were changed, all and those that
    /// have `strength`. Nodes are independent: the result does not depend on the number of threads.
    pub(crate) fn keep_off(
        &self,
        from: &[DVec3],
        to: &mut [DVec3],
        strength: impl Fn(usize) -> bool + Sync,
    ) -> [u64; 2] {
        if self.surfaces.is_empty() {
            return [0; 2];
        }
        to.par_iter_mut()
            .zip(from)
            .enumerate()
            .map(|(i, (to, &from))| {
                let push = self.push(from, *to);
                *to += push;
                self.counted(push, || strength(i))
            })
            .reduce(|| [0; 2], |[a, b], [c, d]| [a + c, b + d])
    }

    /// Whether a push changes a path, and one of a node that has strength.
    fn counted(&self, push: DVec3, has_strength: impl FnOnce() -> bool) -> [u64; 2] {
        let changed = push.length() > COUNTED * self.clearance;
        [changed, changed && has_strength()].map(u64::from)
    }

    /// The same for plane wakes, whose rows of two nodes move as their middles do: the ends of rows lie on the
    /// ends of the surface, which are no edges that the flow goes around.
    pub(crate) fn keep_rows_off(
        &self,
        from: &[DVec3],
        to: &mut [DVec3],
        strength: impl Fn(usize) -> bool,
    ) -> [u64; 2] {
        let middle = |row: &[DVec3]| row[0].midpoint(row[1]);
        let mut changed = [0; 2];
        if self.surfaces.is_empty() {
            return changed;
        }
        let rows = to.chunks_exact_mut(2).zip(from.chunks_exact(2));
        for (r, (to, from)) in rows.enumerate() {
            let free = middle(to);
            let push = self.push(middle(from), free);
            let row = self.counted(push, || strength(2 * r));
            changed = [0, 1].map(|k| changed[k] + 2 * row[k]);
            let moved = (free + push) - free; // by what the middle moves in numbers
            to.iter_mut().for_each(|x| *x += moved);
        }
        changed
    }

    /// What is to be added to the end of a path [m].
    fn push(&self, from: DVec3, to: DVec3) -> DVec3 {
        let near = |s: &&Obstacle| s.is_near(from, to, self.clearance);
        let of = |s: &Obstacle| match s.closed {
            true => s.push_out(to, self.clearance),
            false => s.hold_back(from, to, self.clearance),
        };
        self.surfaces.iter().filter(near).map(of).sum()
    }
}

impl Obstacle {
    fn clear(&mut self) {
        self.panels.clear();
        self.border.clear();
    }

    /// Adds the panels of surface `s`, whose nodes are at `ends` when the step starts and ends.
    fn add(&mut self, lattice: &Lattice, s: usize, ends: impl Fn(usize) -> [DVec3; 2]) {
        let topology = lattice.topology();
        self.closed = lattice.surfaces()[s].closed;
        for p in lattice.panels_of(s) {
            let is_border = lattice.borders()[p];
            let panel = Panel::new(topology.panels[p].map(&ends), is_border);
            let sides = (0..4).filter(|&k| is_border[k]);
            self.border
                .extend(sides.map(|k| [0, 1].map(|end| panel.side(end, k))));
            self.panels.push(panel);
        }
    }

    /// Adds the mirror images of all its panels and borders in a plane.
    fn add_image(&mut self, plane: &Plane) {
        let reflected = |x: DVec3| 2.0 * plane.foot(x) - x;
        for k in 0..self.panels.len() {
            let p = &self.panels[k];
            let corner = |k: usize| [0, 1].map(|end| reflected(p.corners[end][k]));
            let image = Panel::new(std::array::from_fn(corner), p.is_border);
            self.panels.push(image);
        }
        for k in 0..self.border.len() {
            let image = self.border[k].map(|end| end.map(reflected));
            self.border.push(image);
        }
    }

    /// Finds the sphere.
    fn enclose(&mut self) {
        let corners = |end: usize| self.panels.iter().flat_map(move |p| p.corners[end]);
        let count = corners(0).count().max(1) as f64;
        self.sphere = [0, 1].map(|end| corners(end).sum::<DVec3>() / count);
        let far = |end: usize| {
            let distances = corners(end).map(|x| x.distance(self.sphere[end]));
            distances.fold(0.0, f64::max)
        };
        self.radius = far(0).max(far(1));
    }

    /// Whether a path comes so near that the surface may push its end: as seen from the surface, the whole path
    /// to a thin one, the end to a closed one.
    fn is_near(&self, from: DVec3, to: DVec3, clearance: f64) -> bool {
        let [from, to] = [from - self.sphere[0], to - self.sphere[1]];
        let from = if self.closed { to } else { from };
        distance_to_segment(DVec3::ZERO, from, to) < self.radius + REACH * clearance
    }

    /// A convex body: out to the clearance from the plane of the nearest panel, of several where
    /// their distances differ by less than a clearance.
    fn push_out(&self, to: DVec3, clearance: f64) -> DVec3 {
        let distance = |p: &Panel| p.centre[1].distance(to);
        let nearest = self
            .panels
            .iter()
            .map(distance)
            .fold(f64::INFINITY, f64::min);
        let (mut push, mut shares) = (DVec3::ZERO, 0.0);
        for panel in &self.panels {
            let share = smoothstep(1.0 - (distance(panel) - nearest) / clearance);
            let lack = clearance - (to - panel.centre[1]).dot(panel.normal[1]);
            push += share * lack.max(0.0) * panel.normal[1];
            shares += share;
        }
        let beyond = (to.distance(self.sphere[1]) - self.radius) / clearance;
        smoothstep(REACH - beyond) * push / shares.max(1.0)
    }

    /// A thin surface: a node that crosses it or ends too near goes back to its own side.
    fn hold_back(&self, from: DVec3, to: DVec3, clearance: f64) -> DVec3 {
        let thin = THIN * clearance;
        let crossing = self.mean(from, to, clearance, |start, end| {
            let (a, b) = (start.abs(), end.abs());
            ((a + 0.5 * thin) / (a + b + thin), start) // the middle of a path within the surface
        });
        let ending = self.mean(from, to, clearance, |_, end| (1.0, end));
        crossing.push + (1.0 - crossing.weight) * ending.push
    }

    /// What the panels do together to a path. `at` tells from the heights over a panel at its start
    /// and end where on the path the panel is looked for, and the height whose side counts.
    fn mean(
        &self,
        from: DVec3,
        to: DVec3,
        clearance: f64,
        at: impl Fn(f64, f64) -> (f64, f64),
    ) -> Answer {
        let (mut sum, mut shares) = (Answer::default(), 0.0);
        for panel in &self.panels {
            let start = (from - panel.centre[0]).dot(panel.normal[0]);
            let end = (to - panel.centre[1]).dot(panel.normal[1]);
            let (s, height) = at(start, end);
            let share = panel.share(from.lerp(to, s), s, clearance);
            if share == 0.0 {
                continue;
            }
            let depth = self.depth(panel, from.lerp(to, s), s);
            let weight = share * smoothstep(depth / clearance);
            let side = (height / (THIN * clearance)).clamp(-1.0, 1.0);
            let lack = (clearance - side * end).max(0.0);
            sum.push += weight * side * lack * panel.normal[1];
            sum.weight += weight;
            shares += share;
        }
        if shares == 0.0 {
            return sum;
        }
        Answer {
            push: sum.push / shares,
            weight: sum.weight / shares,
        }
    }

    /// Distance of `x` from the edges of the surface, seen along the normal of `panel`; zero
    /// outside.
    fn depth(&self, panel: &Panel, x: DVec3, s: f64) -> f64 {
        let outside = |k: usize| panel.is_border[k] && panel.inside(x, s, k) <= 0.0;
        if (0..4).any(outside) {
            return 0.0;
        }
        let normal = panel.normal(s);
        let flat = |y: DVec3| y - (y - x).dot(normal) * normal;
        let distance = |side: &[[DVec3; 2]; 2]| {
            let [a, b] = [0, 1].map(|i| flat(side[0][i].lerp(side[1][i], s)));
            distance_to_segment(x, a, b)
        };
        self.border
            .iter()
            .map(distance)
            .fold(f64::INFINITY, f64::min)
    }
}

/// What a thin surface does to a path: its push [m], and the part of the path it blocks.
#[derive(Clone, Copy, Default)]
struct Answer {
    push: DVec3,
    weight: f64,
}

impl Panel {
    fn new(ends: [[DVec3; 2]; 4], is_border: [bool; 4]) -> Self {
        let corners = [0, 1].map(|e| ends.map(|c| c[e]));
        let centre = corners.map(|c| 0.25 * ((c[0] + c[1]) + (c[2] + c[3])));
        let far = |e: usize| corners[e].map(|c| c.distance(centre[e]));
        let distances = [far(0), far(1)];
        Self {
            centre,
            normal: corners.map(|c| (c[2] - c[0]).cross(c[3] - c[1]).normalize_or_zero()),
            radius: distances.iter().flatten().fold(0.0, |r, d| d.max(r)),
            corners,
            is_border,
        }
    }

    fn side(&self, end: usize, k: usize) -> [DVec3; 2] {
        [self.corners[end][k], self.corners[end][(k + 1) % 4]]
    }

    /// Unit normal at the part `s` of the step.
    fn normal(&self, s: f64) -> DVec3 {
        self.normal[0].lerp(self.normal[1], s).normalize_or_zero()
    }

    /// How far `x` is inside of side `k` at the part `s` of the step [m]; infinite for a side
    /// without length.
    fn inside(&self, x: DVec3, s: f64, k: usize) -> f64 {
        let [[a0, b0], [a1, b1]] = [0, 1].map(|end| self.side(end, k));
        let (a, b) = (a0.lerp(a1, s), b0.lerp(b1, s));
        let length = a.distance(b);
        if length > 0.0 {
            (b - a).cross(x - a).dot(self.normal(s)) / length
        } else {
            f64::INFINITY
        }
    }

    /// The part that the panel has in what is done at `x`: 1 inside, 1/2 on its sides, 0 from half
    /// a clearance outside.
    fn share(&self, x: DVec3, s: f64, clearance: f64) -> f64 {
        let centre = self.centre[0].lerp(self.centre[1], s);
        if x.distance(centre) > self.radius + 2.0 * clearance {
            return 0.0;
        }
        let inside = (0..4).map(|k| self.inside(x, s, k));
        smoothstep(0.5 + inside.fold(f64::INFINITY, f64::min) / clearance)
    }
}

pub(crate) fn distance_to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let ab = b - a;
    let length2 = ab.length_squared();
    let s = if length2 > 0.0 {
        ((p - a).dot(ab) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    p.distance(a + s * ab)
}

#[cfg(test)]
mod tests;
