//! What the vorticity that leaves leading edges within a step does to the flow, each strip's with unit circulation.

use crate::images::Mirror;
use crate::lattice::Lattice;
use crate::wake::{Filaments, NearWakeShare};
use wingbeat_math::DVec3;
use wingbeat_vortex::{BLOCK, Network, UnitEdges};

/// The filaments whose circulation has a part of what leaves: those of the newest rows and the leading edges
/// themselves.
#[derive(Default)]
pub(crate) struct Leaving {
    near_wake: UnitEdges,
    leading: UnitEdges,
    /// The leading edges, and the unknown of each.
    edges: Network,
    unknown: Vec<usize>,
    rates: Vec<f64>,
    reflected: Vec<[DVec3; 2]>,
}

/// A normal velocity at a place: of what is there anyway in the newest rows, or of what leaves the strip of an unknown.
pub(crate) enum InducedBy {
    Fixed,
    Leaving(usize),
}

impl Leaving {
    /// Takes the filaments.
    pub fn load(&mut self, lattice: &Lattice, filaments: &Filaments) {
        let settings = lattice.settings();
        let all = |count: usize| std::iter::once(0..count);
        let near = &filaments.near_wake;
        (self.near_wake).load(settings.wake_core, near, all(near.len()));
        self.edges.clear();
        self.unknown.clear();
        for (strip, unknown) in lattice.strips().iter().zip(&lattice.suction().unknown) {
            let Some(unknown) = unknown else { continue };
            let (a, b) = filaments.bound.ends(strip.edge);
            let first = self.edges.nodes.len();
            self.edges.nodes.push(a);
            self.edges.nodes.push(b);
            let core = filaments.bound.core[strip.edge];
            self.edges.push_edge(first, first + 1, 0.0, core);
            self.unknown.push(*unknown);
        }
        let count = self.edges.len();
        (self.leading).load(settings.bound_core, &self.edges, all(count));
        let room = BLOCK * self.near_wake.len().max(count);
        self.rates.resize(room.max(self.rates.len()), 0.0);
    }

    /// Shows the normal velocities at `points`, with their normals, that newest rows and mirror images make:
    /// point and part.
    pub fn near_wake(
        &mut self,
        lattice: &Lattice,
        shares: &[NearWakeShare],
        points: &[[DVec3; 2]],
        mut see: impl FnMut(usize, InducedBy, f64),
    ) {
        if self.near_wake.is_empty() {
            return;
        }
        let unknown = &lattice.suction().unknown;
        let Self {
            near_wake,
            rates,
            reflected,
            ..
        } = self;
        on_all_sides(lattice.mirrors(), points, reflected, |first, chunk| {
            near_wake.normal_velocities(0, chunk.iter().copied(), rates);
            for (share, rates) in shares.iter().zip(rates.chunks(BLOCK)) {
                for (i, rate) in rates[..chunk.len()].iter().enumerate() {
                    see(first + i, InducedBy::Fixed, share.fixed * rate);
                    for k in (0..2).filter(|&k| share.leaving[k] != 0.0) {
                        let strip = unknown[share.strip[k]].expect("its edge sheds");
                        see(
                            first + i,
                            InducedBy::Leaving(strip),
                            share.leaving[k] * rate,
                        );
                    }
                }
            }
        });
    }

    /// The same of the leading edges, which lack what leaves.
    pub fn leading_edges(
        &mut self,
        lattice: &Lattice,
        points: &[[DVec3; 2]],
        mut see: impl FnMut(usize, usize, f64),
    ) {
        let Self {
            leading,
            unknown,
            rates,
            reflected,
            ..
        } = self;
        on_all_sides(lattice.mirrors(), points, reflected, |first, chunk| {
            leading.normal_velocities(0, chunk.iter().copied(), rates);
            for (strip, rates) in unknown.iter().zip(rates.chunks(BLOCK)) {
                for (i, rate) in rates[..chunk.len()].iter().enumerate() {
                    see(first + i, *strip, -rate);
                }
            }
        });
    }
}

/// Shows the points and their mirror images, with the normals, some at a time: the first one's number and these.
fn on_all_sides(
    mirrors: &[Mirror],
    points: &[[DVec3; 2]],
    reflected: &mut Vec<[DVec3; 2]>,
    mut see: impl FnMut(usize, &[[DVec3; 2]]),
) {
    let mut see_all = |points: &[[DVec3; 2]]| {
        for (b, chunk) in points.chunks(BLOCK).enumerate() {
            see(b * BLOCK, chunk);
        }
    };
    see_all(points);
    for mirror in mirrors {
        reflected.clear();
        let images = points.iter();
        reflected.extend(images.map(|[x, n]| [mirror.point(*x), mirror.vector(*n)]));
        see_all(reflected);
    }
}
