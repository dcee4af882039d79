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
//! What f has along T cannot be annulled; e keeps nodes in order where vorticity cancels.

use crate::lattice::Lattice;
use crate::state::AirState;
use crate::wake::filaments::Filaments;
use crate::wake::summation::Sums;
use wingbeat_math::DVec3;
use wingbeat_vortex::{Network, Points};

/// e: where the vorticity of a node is a smaller part of that of its filaments, little is annulled.
const CANCELLED: f64 = 0.3;

/// A filament seen from one of its ends.
#[derive(Clone, Copy, Debug)]
struct End {
    /// Its node among those that are moved.
    node: usize,
    /// Where the velocity of its middle is.
    middle: usize,
    /// G l [m3/s].
    vorticity: DVec3,
    /// Weights of the velocities of the node and of the middle.
    at_node: f64,
    at_middle: f64,
}

/// Memory of the correction.
#[derive(Clone, Debug, Default)]
pub(crate) struct ForceFree {
    middles: Points,
    velocity: Points,
    ends: Vec<End>,
    /// Nodes that are moved, by their number in the network of the wakes, and in that of the newest rows with their
    /// weights.
    wake: Vec<Option<usize>>,
    near: Vec<[(Option<usize>, f64); 2]>,
    sums: Vec<[DVec3; 2]>,
    sizes: Vec<f64>,
}

impl ForceFree {
    /// Corrects the `velocity` of `nodes`, both without the undisturbed air, which are the movable ones; the sums hold
    /// all filaments.
    pub(crate) fn correct(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        filaments: &Filaments,
        sums: &mut Sums,
        velocity: &mut Points,
    ) {
        self.number(lattice, state, filaments);
        self.middles.clear();
        self.ends.clear();
        self.add_wake(&filaments.wake);
        self.add_near_wake(&filaments.near_wake);
        self.velocity.reset(self.middles.len());
        sums.add(&self.middles, lattice.mirrors(), &mut self.velocity);
        self.annul(velocity);
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
            next += if is_moved { free + width } else { 0 };
        }
    }

    fn add_wake(&mut self, wake: &Network) {
        for (e, &[a, b]) in wake.edges.iter().enumerate() {
            let nodes = [a, b].map(|n| self.wake[n as usize]);
            if nodes == [None, None] || wake.gamma[e] == 0.0 {
                continue;
            }
            let middle = self.middles.len();
            let vorticity = self.push_middle(wake, e);
            for node in nodes.into_iter().flatten() {
                self.ends.push(End {
                    node,
                    middle,
                    vorticity,
                    at_node: 1.0 / 6.0,
                    at_middle: 1.0 / 3.0,
                });
            }
        }
    }

    /// Short: the middle says it all.
    fn add_near_wake(&mut self, near: &Network) {
        for (e, &[a, b]) in near.edges.iter().enumerate() {
            let [a, b] = [a, b].map(|n| self.near[n as usize]);
            if a[0].0.is_none() || near.gamma[e] == 0.0 {
                continue;
            }
            let middle = self.middles.len();
            let vorticity = self.push_middle(near, e);
            for (node, part) in a.into_iter().chain(b) {
                let Some(node) = node.filter(|_| part > 0.0) else {
                    continue;
                };
                self.ends.push(End {
                    node,
                    middle,
                    vorticity,
                    at_node: 0.0,
                    at_middle: 0.5 * part,
                });
            }
        }
    }

    fn push_middle(&mut self, net: &Network, e: usize) -> DVec3 {
        let (a, b) = net.ends(e);
        let [i, j] = net.edges[e].map(|n| net.nodes.core[n as usize]);
        self.middles.push_with_core(0.5 * (a + b), 0.5 * (i + j));
        net.gamma[e] * (b - a)
    }

    fn annul(&mut self, velocity: &mut Points) {
        let count = velocity.len();
        self.sums.clear();
        self.sums.resize(count, [DVec3::ZERO; 2]);
        self.sizes.clear();
        self.sizes.resize(count, 0.0);
        for end in &self.ends {
            let u = end.at_node * velocity.get(end.node)
                + end.at_middle * self.velocity.get(end.middle);
            let weight = end.at_node + end.at_middle;
            let [force, vorticity] = &mut self.sums[end.node];
            *force += u.cross(end.vorticity);
            *vorticity += weight * end.vorticity;
            self.sizes[end.node] += weight * end.vorticity.length();
        }
        for (i, (&[force, vorticity], size)) in self.sums.iter().zip(&self.sizes).enumerate() {
            let u = velocity.get(i);
            let scale = vorticity.length_squared() + (CANCELLED * size).powi(2);
            if scale > 0.0 {
                let left = force - u.cross(vorticity);
                velocity.set(i, u + vorticity.cross(left) / scale);
            }
        }
    }
}
