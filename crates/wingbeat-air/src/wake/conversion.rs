//! Vortex particles in place of old or leading-edge rows of wake: what they are, and how rings
//! become particles.
//!
//! A sheet that rolls up tears its rings apart and folds them through each other; particles have no
//! neighbours to be torn from. A row that has grown old (or has left a leading edge) is turned into
//! particles segment by segment: a segment from a to b of net circulation Gamma becomes particles of
//! strength Gamma (b - a) / n in the middles of its n equal pieces, which has exactly its vorticity
//! `Gamma (b - a)` and its linear impulse `1/2 Gamma a x b`. A segment between a ring that stays and
//! one that goes stays a filament with the circulation of both, so that nothing is doubled or lost. So
//! does the line where a sheet that leaves its surface all around meets itself, as long as a ring on either side stays.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | alpha | `strength` | vorticity times volume | m3/s |
//! | sigma | `radius` | radius of the ball over which it is spread | m |

use crate::state::{Particles, WakeSheet};
use wingbeat_math::DVec3;

/// Pieces of a segment at most.
const MAX_PIECES: f64 = 8.0;

impl WakeSheet {
    /// Makes particles of the oldest `rows(column)` rows of every column; the newest row stays.
    /// Returns the number of particles.
    pub(crate) fn convert(&mut self, radius: f64, rows: impl Fn(usize) -> usize) -> u64 {
        let newest = self.rows().saturating_sub(1);
        let due = |c: usize| rows(c).min(newest).max(self.converted[c]);
        let (mut particles, mut count) = (std::mem::take(&mut self.particles), 0);
        for r in 0..(0..self.columns).map(due).max().unwrap_or(0) {
            for c in 0..=self.columns {
                let goes = |along: bool| {
                    self.borders_ring([r, c], along)
                        && !borders_ring((self.columns, due), self.is_closed, [r, c], along)
                };
                let mut push = |to: [usize; 2], gamma: f64| {
                    let ends = [self.node(r, c), self.node(to[0], to[1])];
                    count += push_segment(&mut particles, ends, gamma, radius, self.shed_time[r]);
                };
                if goes(true) {
                    push([r, c + 1], self.between_rows(r, c));
                }
                if goes(false) {
                    push([r + 1, c], self.between_columns(r, c));
                }
            }
        }
        for c in 0..self.columns {
            self.converted[c] = rows(c).min(newest).max(self.converted[c]);
        }
        self.particles = particles;
        count
    }

    /// Whether the segment from node `[row, column]`, along the row or toward the next newer one, lies at a
    /// ring that is still there.
    pub(crate) fn borders_ring(&self, node: [usize; 2], along: bool) -> bool {
        let converted = |c: usize| self.converted[c];
        borders_ring((self.columns, converted), self.is_closed, node, along)
    }

    /// Forgets rows that hold no ring and border none.
    pub(crate) fn drop_converted(&mut self) {
        let converted = self.converted.iter().copied().min().unwrap_or(0);
        self.keep(self.rows() - converted.saturating_sub(1));
    }
}

/// The same at a ring of so many columns, the oldest `converted` ones of each being particles. First and last line of
/// a `closed` sheet are one.
fn borders_ring(
    (columns, converted): (usize, impl Fn(usize) -> usize),
    closed: bool,
    [row, column]: [usize; 2],
    along: bool,
) -> bool {
    let ring = |c: usize| c < columns && row >= converted(c);
    if along {
        return ring(column);
    }
    let before = match column {
        0 if closed => Some(columns - 1),
        _ => column.checked_sub(1),
    };
    ring(column) || before.is_some_and(ring) || closed && column == columns && ring(0)
}

/// Appends the segment from `a` to `b` of circulation `gamma`; none without circulation.
fn push_segment(
    particles: &mut Particles,
    [a, b]: [DVec3; 2],
    gamma: f64,
    radius: f64,
    shed: f64,
) -> u64 {
    if gamma == 0.0 {
        return 0;
    }
    let pieces = (a.distance(b) / radius).ceil().clamp(1.0, MAX_PIECES);
    for k in 0..pieces as usize {
        let middle = (k as f64 + 0.5) / pieces;
        particles.push(a + middle * (b - a), gamma / pieces * (b - a), shed);
    }
    pieces as u64
}
