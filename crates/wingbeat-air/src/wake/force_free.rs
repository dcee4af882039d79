//! Free vorticity carries no force: how nodes move so that wakes keep their impulse.
//!
//! A filament l of circulation G whose ends move at V in air of velocity u would feel
//! `rho G integral (u - V) x dl`. Velocities of nodes alone leave that non-zero wherever filaments are
//! long or bent: the wake gains or loses impulse, and forces from pressures and from impulse part. So the
//! velocity is taken along every filament (its ends and its middle, Simpson's rule), each filament hands
//! the force it would feel to its two nodes by linear weights, and a node moves with the velocity u there and
//! what annuls its share:
//!
//! `V = u + T x (f - u x T) / (T^2 + (e S)^2)`, `f = sum G integral w u ds x l`,
//! `T = sum G integral w ds l`, `S = sum abs(G) integral w ds abs(l)`.
//!
//! Where squared cores sigma^2 change along a filament, action is reaction only if it also feels `-rho G / 4
//! integral W d(sigma^2)`, W the sum of `G dl / (4 pi)` over the cube of softened distances; f holds that too.
//!
//! e keeps nodes in order where vorticity cancels; filaments that run side by side along joined columns are
//! one, with their common circulation. What is left, for the most part along T, is handed on to the nodes at
//! the other ends of the filaments, in proportion to their vorticity, who annul of it what they can, and so on:
//! the wake keeps its impulse to a hundredth of the lift, with most of a correction within a few filaments of
//! its cause.

use crate::geometry::JoinedColumns;
use crate::images::Mirror;
use crate::lattice::Lattice;
use crate::state::AirState;
use crate::wake::filaments::Filaments;
use crate::wake::summation::Sums;
use std::ops::Range;
use wingbeat_math::{DVec3, smoothstep};
use wingbeat_vortex::{Network, Points};

/// e: where the vorticity of a node is a smaller part of that of its filaments, little is annulled. With 0.3
/// flights of four wings that differ by a rounding part within a beat; with 1 the impulse of long wakes is 3
/// parts in a hundred off.
const CANCELLED: f64 = 0.6;

/// How often what is left is handed on. Impulse against forces of a tethered fly: apart by a sixth with none in
/// its fourth beat; by 3 and by 7 parts in a hundred with 8 in its 12th and 20th, whose wakes are long and
/// their filaments, too; by 1 with 32.
const HANDED_ON: usize = 32;

/// What a node has less of than this part of the most is a rounding, whose direction says nothing. Beside what the
/// lattice has it yields the less the smaller it is: it left wings that were next to at rest.
const ROUNDING: f64 = 1e-12;

/// Size of a node that left the root of a wing on a body, over those of the nodes around it, below which it
/// yields little: there the sheet goes on through the body, and by as much as left and right are alike the node
/// has no vorticity that could say where to.
const FAINT: f64 = 0.03;

/// A filament seen from one of its ends.
#[derive(Clone, Copy, Debug)]
struct End {
    /// Its node among those that are moved.
    node: usize,
    /// Where the velocity of its middle is.
    middle: usize,
    /// G l [m3/s].
    vorticity: DVec3,
    /// -G (sigma_b^2 - sigma_a^2) / 4 [m4/s].
    widening: f64,
    /// Weights of velocity and vorticity at the node and in the middle.
    at_node: f64,
    at_middle: f64,
}

/// Which filaments between nodes of joined columns are one: those with the same nodes, that begin at the same
/// part of the way between them.
type Beside = ([usize; 2], u64);

/// Memory of the correction.
#[derive(Clone, Debug, Default)]
pub(crate) struct ForceFree {
    /// Vorticity at the nodes.
    at_nodes: Points,
    /// Middles of filaments, velocity and vorticity there.
    middles: Points,
    velocity: Points,
    vorticity: Points,
    ends: Vec<End>,
    /// Filaments between nodes of joined columns, and their ends.
    beside: Vec<(Beside, Range<usize>)>,
    /// Nodes that are moved, by their number in the network of the wakes, and in that of the newest rows with their
    /// weights.
    wake: Vec<Option<usize>>,
    /// The node that each one is: another one where columns are joined.
    same: Vec<usize>,
    /// The joined columns in which others are one with it, by their number.
    joined: Vec<Option<usize>>,
    /// Whether it left the root of a wing whose circulation goes on through a body.
    at_body: Vec<bool>,
    /// The plane, if it lies where the sheet meets its own mirror image.
    on_plane: Vec<Option<Mirror>>,
    near: Vec<[(Option<usize>, f64); 2]>,
    /// Nodes at two ends of a filament, and the part of it that is here.
    joints: Vec<([usize; 2], f64)>,
    sums: Vec<[DVec3; 2]>,
    /// S, then the root of T^2 + (e S)^2 [m3/s].
    sizes: Vec<f64>,
    /// Size from which on nodes yield wholly [m3/s].
    whole: f64,
    /// Sum of the sizes at the other ends of the filaments of a node.
    around: Vec<f64>,
    left: Vec<DVec3>,
    handed: Vec<DVec3>,
}

impl ForceFree {
    /// Adds to `velocity` that of the movable nodes, which is zero before, without the undisturbed air; the
    /// flow is taken at `places`, node by node, and the sums hold all filaments.
    pub(crate) fn add_velocity(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        filaments: &Filaments,
        sums: &mut Sums,
        places: &Points,
        velocity: &mut Points,
    ) {
        let mirrors = lattice.mirrors();
        self.at_nodes.reset(places.len());
        sums.add_with_vorticity(places, mirrors, [velocity, &mut self.at_nodes]);
        self.number(lattice, state, filaments);
        self.middles.clear();
        self.ends.clear();
        self.beside.clear();
        self.joints.clear();
        self.add_wake(&filaments.wake);
        self.add_near_wake(filaments);
        self.merge_joined();
        self.velocity.reset(self.middles.len());
        self.vorticity.reset(self.middles.len());
        let both = [&mut self.velocity, &mut self.vorticity];
        sums.add_with_vorticity(&self.middles, mirrors, both);
        let bound = &filaments.bound;
        let lattice_size = |e: usize| {
            let (a, b) = bound.ends(e);
            bound.gamma[e].abs() * a.distance(b)
        };
        self.whole = ROUNDING * (0..bound.len()).map(lattice_size).fold(0.0, f64::max);
        self.annul(velocity);
        for (i, &one) in self.same.iter().enumerate().filter(|(i, one)| i != *one) {
            velocity.set(i, velocity.get(one));
        }
    }

    /// Which nodes are moved.
    fn number(&mut self, lattice: &Lattice, state: &AirState, filaments: &Filaments) {
        self.wake.clear();
        self.near.clear();
        let mut next = 0;
        for (s, sheet) in state.sheets.iter().enumerate() {
            let width = sheet.columns + 1;
            let is_moved = lattice.reflected_sheet(s).is_none();
            let place = |k: usize| is_moved.then_some(next + k);
            let free = sheet.nodes.len();
            self.wake.extend((0..free).map(place));
            let levels = filaments.near_levels(sheet);
            for level in (0..levels).rev() {
                let part = level as f64 / (levels - 1) as f64; // 1 at the free row
                for c in 0..width {
                    let row = place(free - width + c);
                    self.near.push([(row, part), (place(free + c), 1.0 - part)]);
                }
            }
            let rings = filaments.inner_nodes(s);
            (self.near).extend(std::iter::repeat_n([(None, 0.0); 2], rings));
            next += if is_moved { free + width } else { 0 };
        }
        self.same.clear();
        self.same.extend(0..next);
        self.joined.clear();
        self.joined.resize(next, None);
        self.at_body.clear();
        self.at_body.resize(next, false);
        self.on_plane.clear();
        self.on_plane.resize(next, None);
        self.join(lattice, state);
    }

    /// Nodes of joined columns are one node: what their filaments have in common cancels there. Where a column
    /// is joined to its own mirror image, the filaments of the other side are images of those of this one.
    fn join(&mut self, lattice: &Lattice, state: &AirState) {
        let nodes = |s: usize| match lattice.reflected_sheet(s) {
            Some(_) => 0,
            None => state.sheets[s].nodes.len() + state.sheets[s].columns + 1,
        };
        let plane = lattice.symmetry().map(|s| s.mirror);
        let pairs = lattice.topology().joined_columns.iter().enumerate();
        for (k, JoinedColumns([(s, c), (t, d)])) in pairs {
            let first = |k: usize| (0..k).map(nodes).sum::<usize>();
            let place = |k: usize, column: usize, back: usize| {
                let width = state.sheets[k].columns + 1;
                (nodes(k) >= (back + 1) * width)
                    .then(|| first(k) + nodes(k) - (back + 1) * width + column)
            };
            let [one, other] = [*s, *t].map(|k| lattice.middle_column(k).is_some());
            let at_body = one != other;
            for back in 0.. {
                match (place(*s, *c, back), place(*t, *d, back)) {
                    (Some(one), Some(other)) => {
                        self.same[other] = self.same[one];
                        self.joined[self.same[one]] = Some(k);
                        self.at_body[self.same[one]] = at_body;
                    }
                    (Some(one), None) if nodes(*t) == 0 => self.on_plane[one] = plane,
                    (None, Some(other)) if nodes(*s) == 0 => self.on_plane[other] = plane,
                    _ => break,
                }
            }
        }
        for i in (0..self.same.len()).filter(|&i| self.same[i] != i) {
            let plane = self.on_plane[self.same[i]].or(self.on_plane[i]);
            self.on_plane[self.same[i]] = plane;
        }
        for &(s, c) in &lattice.topology().plane_columns {
            let edge = state.position[lattice.sheets()[s].nodes[c]];
            let plane = lattice.nearest_plane(edge).and_then(Mirror::of);
            let (first, width) = (
                (0..s).map(nodes).sum::<usize>(),
                state.sheets[s].columns + 1,
            );
            for n in (c..nodes(s)).step_by(width) {
                self.on_plane[self.same[first + n]] = plane;
            }
        }
        let same = |node: &mut Option<usize>| *node = node.map(|n| self.same[n]);
        self.wake.iter_mut().for_each(same);
        let ends = self.near.iter_mut().flatten().map(|(node, _)| node);
        ends.for_each(same);
    }

    fn add_wake(&mut self, wake: &Network) {
        for (e, &[a, b]) in wake.edges.iter().enumerate() {
            let nodes = [a, b].map(|n| self.wake[n as usize]);
            if nodes == [None, None] {
                continue;
            }
            let ends = nodes.into_iter().flatten();
            let ends = ends.map(|node| (node, [1.0 / 6.0, 1.0 / 3.0]));
            self.push(wake, e, (ends, 1.0), (nodes, 0.0));
        }
    }

    /// Short: the middle says it all. Strips of a row that have one circulation whatever leaves the edge within
    /// the step are one.
    fn add_near_wake(&mut self, filaments: &Filaments) {
        let near = &filaments.near_wake;
        for ((e, &[a, b]), share) in near.edges.iter().enumerate().zip(&filaments.shares) {
            let [a, b] = [a, b].map(|n| self.near[n as usize]);
            if a[0].0.is_none() {
                continue;
            }
            let ends = a.into_iter().chain(b).filter(|(_, part)| *part > 0.0);
            let ends = ends.filter_map(|(node, part)| Some((node?, [0.0, 0.5 * part])));
            let [column, other] = [a, b].map(|ends| ends.map(|(node, _)| node));
            let is_across = column == other || other == [None, None];
            let joint = match is_across {
                true => 1.0,
                false => share.joint(near.gamma[e]),
            };
            if joint == 0.0 {
                continue;
            }
            let between = column.map(|node| node.filter(|_| is_across));
            self.push(near, e, (ends, joint), (between, a[0].1));
        }
    }

    /// Adds an edge that has these ends, each with its node and the weights at the node and in the middle; it
    /// lies between these two nodes, or within what joins them, and begins at this part of the way. One without
    /// circulation is a joint, too, as far as `joint` says: whether it has a rounding of it does not matter.
    fn push(
        &mut self,
        net: &Network,
        e: usize,
        (ends, joint): (impl Iterator<Item = (usize, [f64; 2])> + Clone, f64),
        (between, part): ([Option<usize>; 2], f64),
    ) {
        let in_plane = between
            .iter()
            .all(|n| n.is_some_and(|n| self.on_plane[n].is_some()));
        let [a, b] = between.map(|n| n.and_then(|n| self.joined[n]));
        let is_joined = a.is_some() && a == b;
        // The other half of the joint is on the other side.
        let joint = if in_plane || is_joined {
            0.5 * joint
        } else {
            joint
        };
        for (k, (a, _)) in ends.clone().enumerate() {
            let others = ends.clone().skip(k + 1).filter(|(b, _)| *b != a);
            self.joints.extend(others.map(|(b, _)| ([a, b], joint)));
        }
        // In the plane it is its own image, and together they have no circulation.
        if in_plane || net.gamma[e] == 0.0 {
            return;
        }
        let (middle, first) = (self.middles.len(), self.ends.len());
        let (vorticity, widening) = self.push_middle(net, e);
        let ends = ends.map(|(node, [at_node, at_middle])| End {
            node,
            middle,
            vorticity,
            widening,
            at_node,
            at_middle,
        });
        self.ends.extend(ends);
        if let ([Some(a), Some(b)], true) = (between, is_joined) {
            let key = ([a, b], part.to_bits());
            self.beside.push((key, first..self.ends.len()));
        }
    }

    /// Makes one filament, with their common circulation, of those that run side by side along joined columns.
    fn merge_joined(&mut self) {
        let order = |(key, ends): &(Beside, Range<usize>)| (*key, ends.start);
        self.beside.sort_unstable_by_key(order);
        for same in self.beside.chunk_by(|(a, _), (b, _)| a == b) {
            let (_, first) = &same[0];
            let others = same[1..].iter();
            for (into, from) in others.flat_map(|(_, other)| first.clone().zip(other.clone())) {
                let merged = self.ends[from];
                self.ends[into].vorticity += merged.vorticity;
                self.ends[into].widening += merged.widening;
                (self.ends[from].at_node, self.ends[from].at_middle) = (0.0, 0.0);
            }
        }
        if !self.beside.is_empty() {
            self.ends.retain(|end| end.at_node + end.at_middle > 0.0);
        }
    }

    /// The middle of an edge; returns G l and -G (sigma_b^2 - sigma_a^2) / 4.
    fn push_middle(&mut self, net: &Network, e: usize) -> (DVec3, f64) {
        let (a, b) = net.ends(e);
        let [i, j] = net.edges[e].map(|n| net.nodes.core[n as usize]);
        self.middles.push_with_core(0.5 * (a + b), 0.5 * (i + j));
        (net.gamma[e] * (b - a), 0.25 * net.gamma[e] * (i - j))
    }

    /// Sums the forces of the filaments at their nodes, and moves the nodes so that they vanish.
    fn annul(&mut self, velocity: &mut Points) {
        let count = velocity.len();
        self.sums.clear();
        self.sums.resize(count, [DVec3::ZERO; 2]);
        self.sizes.clear();
        self.sizes.resize(count, 0.0);
        for end in &self.ends {
            let along = |node: &Points, middle: &Points| {
                end.at_node * node.get(end.node) + end.at_middle * middle.get(end.middle)
            };
            let u = along(velocity, &self.velocity);
            let weight = end.at_node + end.at_middle;
            let [force, vorticity] = &mut self.sums[end.node];
            let widening = end.widening * along(&self.at_nodes, &self.vorticity);
            *force += u.cross(end.vorticity) + widening;
            *vorticity += weight * end.vorticity;
            self.sizes[end.node] += weight * end.vorticity.length();
        }
        let planes = self.on_plane.iter().enumerate();
        for (i, mirror) in planes.filter_map(|(i, plane)| Some((i, plane.as_ref()?))) {
            let [force, vorticity] = &mut self.sums[i];
            *force += mirror.vector(*force);
            *vorticity -= mirror.vector(*vorticity); // an axial vector
            self.sizes[i] *= 2.0;
        }
        self.left.clear();
        for (i, ([force, vorticity], size)) in self.sums.iter().zip(&mut self.sizes).enumerate() {
            *size = vorticity.length().hypot(CANCELLED * *size);
            self.left.push(*force - velocity.get(i).cross(*vorticity));
        }
        let most = self.sizes.iter().fold(0.0, |most, size| size.max(most));
        self.whole = self.whole.max(ROUNDING * most);
        let roundings = self
            .sizes
            .iter_mut()
            .filter(|size| **size < ROUNDING * most);
        roundings.for_each(|size| *size = 0.0);
        self.look_around();
        self.yield_to_left(velocity);
        for _ in 0..HANDED_ON {
            self.hand_on();
            self.yield_to_left(velocity);
        }
    }

    /// Sums the sizes of the nodes at the other ends of each node's filaments.
    fn look_around(&mut self) {
        self.around.clear();
        self.around.resize(self.sizes.len(), 0.0);
        for &([a, b], part) in &self.joints {
            self.around[a] += part * self.sizes[b];
            self.around[b] += part * self.sizes[a];
        }
        let on_plane = self.around.iter_mut().zip(&self.on_plane);
        for (around, _) in on_plane.filter(|(_, on_plane)| on_plane.is_some()) {
            *around *= 2.0;
        }
    }

    /// Each node moves with what annuls what is left there, as far as that goes.
    fn yield_to_left(&mut self, velocity: &mut Points) {
        let nodes = self.sums.iter().zip(&self.sizes).zip(&mut self.left);
        for (i, (([_, vorticity], size), left)) in nodes.enumerate() {
            if *size > 0.0 {
                let mut more = vorticity.cross(*left) / (size * size);
                if self.at_body[i] {
                    let ratio = size / (FAINT * self.around[i]).max(f64::MIN_POSITIVE);
                    more *= ratio * ratio / (1.0 + ratio * ratio);
                }
                if *size < self.whole {
                    more *= smoothstep(*size / self.whole);
                }
                velocity.add(i, more);
                *left -= more.cross(*vorticity);
            }
        }
    }

    /// Each node hands what is left to the nodes around it; one that has none keeps it. Nodes in the plane of a
    /// mirror get as much from the other side.
    fn hand_on(&mut self) {
        let Self {
            sizes,
            around,
            left,
            handed,
            on_plane,
            ..
        } = self;
        handed.clear();
        let kept = left.iter().zip(around.iter());
        handed.extend(kept.map(|(left, &around)| if around > 0.0 { DVec3::ZERO } else { *left }));
        for &([a, b], part) in &self.joints {
            for (from, to) in [(a, b), (b, a)] {
                if around[from] > 0.0 {
                    handed[to] += part * sizes[to] / around[from] * left[from];
                }
            }
        }
        let given = handed.iter_mut().zip(around).zip(on_plane);
        for ((given, around), plane) in given {
            if let (Some(mirror), true) = (plane, *around > 0.0) {
                *given += mirror.vector(*given);
            }
        }
        std::mem::swap(left, handed);
    }
}
