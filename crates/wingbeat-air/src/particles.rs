//! Vortex particles in place of old or leading-edge rows of wake: what they are, and how rings
//! become particles.
//!
//! A sheet that rolls up tears its rings apart and folds them through each other; particles have no
//! neighbours to be torn from. A row that has grown old (or has left a leading edge) is turned into
//! particles segment by segment: a segment from a to b of net circulation Gamma becomes particles of
//! strength Gamma (b - a) / n in the middles of its n equal pieces, which has exactly its vorticity
//! `Gamma (b - a)` and its linear impulse `1/2 Gamma a x b`. A segment between a ring that stays and
//! one that goes stays a filament with the circulation of both, so that nothing is doubled or lost.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | alpha | `strength` | vorticity times volume | m3/s |
//! | sigma | `radius` | radius of the ball over which it is spread | m |

use crate::error::AirError;
use crate::filaments::{across, between};
use crate::images::Mirror;
use crate::lattice::Lattice;
use crate::settings::AirSettings;
use crate::state::{AirState, WakeEvents, WakeSheet, is_whole};
use crate::surface::EdgeKind;
use wingbeat_math::DVec3;
use wingbeat_vortex::{Particle, Points, Stretching};

/// Pieces of a segment at most.
const MOST_PIECES: f64 = 8.0;

/// Which rows of wake become particles, and how these behave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticleSettings {
    /// Newest rows that stay rings, 1 or more; none: all rows stay.
    pub after: Option<usize>,
    /// Whether columns that leave leading edges keep their newest row of rings only.
    pub leading_at_once: bool,
    /// Radius sigma of new particles [m]; segments longer than it become several particles.
    pub radius: f64,
    /// Effective kinematic viscosity nu [m2/s]: sigma^2 grows as `4 nu age`, core spreading
    /// [Leonard 1980, J. Comput. Phys. 37:289].
    pub viscosity: f64,
    /// How strengths change; filaments and wind stretch particles unless this is omitted.
    pub stretching: Stretching,
}

impl ParticleSettings {
    /// # Errors
    /// [`AirError::Setting`] names the first number that makes no sense.
    pub(crate) fn validate(&self, all: &AirSettings) -> Result<(), AirError> {
        let check = |ok: bool, key, value: String, allowed| match ok {
            true => Ok(()),
            false => Err(AirError::Setting {
                key,
                value,
                allowed,
            }),
        };
        check(
            self.after != Some(0),
            "particles: after",
            "0".to_owned(),
            "at least 1 row of rings: the one on the edge; or none to keep all",
        )?;
        check(
            self.after.is_some() || self.leading_at_once,
            "particles",
            format!("{self:?}"),
            "rows to be kept or leading_at_once: otherwise nothing becomes a particle",
        )?;
        check(
            self.radius.is_finite() && self.radius > 0.0,
            "particles: radius",
            self.radius.to_string(),
            "a finite length in m above 0",
        )?;
        check(
            self.viscosity.is_finite() && self.viscosity >= 0.0,
            "particles: viscosity",
            self.viscosity.to_string(),
            "a finite number of m2/s, 0 for cores that stay",
        )?;
        check(
            all.max_rows.is_none(),
            "max_rows",
            format!("{:?}", all.max_rows),
            "none beside particles, which have no rows: truncate by age or distance",
        )
    }

    /// sigma^2 [m2] of a particle of this age [s].
    pub fn core(&self, age: f64) -> f64 {
        self.radius * self.radius + 4.0 * self.viscosity * age.max(0.0)
    }
}

/// The particles of one wake sheet, oldest first.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Particles {
    /// Places [m], N.
    pub position: Points,
    /// Strengths alpha [m3/s], N.
    pub strength: Points,
    /// Sizes of the strengths when the particles were made [m3/s].
    pub first_size: Vec<f64>,
    /// Time at which the row they were left the edge [s].
    pub shed_time: Vec<f64>,
    /// Velocity with which the first ones came here [m/s], N; newer ones have no past.
    pub velocity: Points,
    /// Rate with which their strengths changed [m3/s2], N; as many.
    pub rate: Points,
}

impl Particles {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.shed_time.len()
    }

    /// True when there is none.
    pub fn is_empty(&self) -> bool {
        self.shed_time.is_empty()
    }

    /// Impulse per density [m4/s], N: half the sum of `x cross alpha`.
    pub fn impulse(&self) -> DVec3 {
        let pairs = self.position.iter().zip(self.strength.iter());
        pairs.map(|(x, a)| 0.5 * x.cross(a)).sum()
    }

    /// Whether all arrays fit each other.
    pub(crate) fn is_sound(&self) -> bool {
        let past = self.velocity.len();
        let vectors = [&self.position, &self.strength, &self.velocity, &self.rate];
        vectors.into_iter().all(is_whole)
            && self.position.len() == self.len()
            && self.strength.len() == self.len()
            && self.first_size.len() == self.len()
            && past == self.rate.len()
            && past <= self.len()
    }

    /// Particle `i` at time `t` [s].
    pub(crate) fn at(&self, i: usize, settings: &ParticleSettings, t: f64) -> Particle {
        Particle {
            position: self.position.get(i),
            strength: self.strength.get(i),
            core: settings.core(t - self.shed_time[i]),
        }
    }

    /// Appends a particle of this place [m], strength [m3/s], both N, and time of shedding [s].
    pub fn push(&mut self, position: DVec3, strength: DVec3, shed: f64) {
        self.position.push(position);
        self.strength.push(strength);
        self.first_size.push(strength.length());
        self.shed_time.push(shed);
    }

    /// Appends the segment from `a` to `b` of circulation `gamma`; none without circulation.
    fn push_segment(&mut self, [a, b]: [DVec3; 2], gamma: f64, radius: f64, shed: f64) -> u64 {
        if gamma == 0.0 {
            return 0;
        }
        let pieces = (a.distance(b) / radius).ceil().clamp(1.0, MOST_PIECES);
        for k in 0..pieces as usize {
            let middle = (k as f64 + 0.5) / pieces;
            self.push(a + middle * (b - a), gamma / pieces * (b - a), shed);
        }
        pieces as u64
    }

    /// Makes these the mirror images of `lead`: vorticity is an axial vector.
    pub(crate) fn follow(&mut self, lead: &Self, mirror: Mirror) {
        let reflect = |from: &Points, to: &mut Points, f: &dyn Fn(DVec3) -> DVec3| {
            to.clear();
            from.iter().for_each(|x| to.push(f(x)));
        };
        reflect(&lead.position, &mut self.position, &|x| mirror.place(x));
        reflect(&lead.velocity, &mut self.velocity, &|v| mirror.vector(v));
        reflect(&lead.strength, &mut self.strength, &|a| -mirror.vector(a));
        reflect(&lead.rate, &mut self.rate, &|a| -mirror.vector(a));
        self.first_size.clone_from(&lead.first_size);
        self.shed_time.clone_from(&lead.shed_time);
    }

    /// Drops particles for which `keep` is false; returns how many.
    fn retain(&mut self, keep: impl Fn(DVec3, f64) -> bool) -> u64 {
        let before = self.len();
        let kept = |i: &usize| keep(self.position.get(*i), self.shed_time[*i]);
        let stay: Vec<usize> = (0..before).filter(kept).collect();
        if stay.len() == before {
            return 0;
        }
        let past = stay.partition_point(|&i| i < self.velocity.len());
        let pick = |p: &mut Points, from: &[usize]| *p = from.iter().map(|&i| p.get(i)).collect();
        pick(&mut self.position, &stay);
        pick(&mut self.strength, &stay);
        pick(&mut self.velocity, &stay[..past]);
        pick(&mut self.rate, &stay[..past]);
        self.first_size = stay.iter().map(|&i| self.first_size[i]).collect();
        self.shed_time = stay.iter().map(|&i| self.shed_time[i]).collect();
        (before - stay.len()) as u64
    }
}

impl WakeSheet {
    /// Whether ring (`row`, `column`) is still there, not particles.
    pub fn is_ring(&self, row: usize, column: usize) -> bool {
        row >= self.spent[column]
    }

    /// Rings that are still there.
    pub fn ring_count(&self) -> usize {
        self.gamma.len() - self.spent.iter().sum::<usize>()
    }

    /// Makes particles of the oldest `rows(column)` rows of every column; the newest row stays.
    /// Returns the number of particles.
    fn convert(&mut self, radius: f64, rows: impl Fn(usize) -> usize) -> u64 {
        let newest = self.rows().saturating_sub(1);
        let due = |c: usize| rows(c).min(newest).max(self.spent[c]);
        let after: Vec<usize> = (0..self.columns).map(due).collect();
        let (mut particles, mut count) = (std::mem::take(&mut self.particles), 0);
        for r in 0..after.iter().copied().max().unwrap_or(0) {
            for c in 0..=self.columns {
                let goes = |along: bool| {
                    borders_ring(&self.spent, [r, c], along) && !borders_ring(&after, [r, c], along)
                };
                let mut push = |to: [usize; 2], gamma: f64| {
                    let ends = [self.node(r, c), self.node(to[0], to[1])];
                    count += particles.push_segment(ends, gamma, radius, self.shed_time[r]);
                };
                if goes(true) {
                    push([r, c + 1], across(self, r, c));
                }
                if goes(false) {
                    push([r + 1, c], between(self, r, c));
                }
            }
        }
        (self.spent, self.particles) = (after, particles);
        count
    }

    /// Forgets rows that hold no ring and border none; returns how many.
    fn drop_spent(&mut self) -> usize {
        let spent = self.spent.iter().copied().min().unwrap_or(0);
        let rows = spent.saturating_sub(1);
        self.keep(self.rows() - rows);
        rows
    }
}

/// Whether the segment from node `[row, column]`, along the row or toward the next newer one, lies at
/// a ring, the oldest `spent` ones of each column being particles.
pub(crate) fn borders_ring(spent: &[usize], [row, column]: [usize; 2], along: bool) -> bool {
    let ring = |c: usize| spent.get(c).is_some_and(|&s| row >= s);
    ring(column) || (!along && column > 0 && ring(column - 1))
}

impl Lattice {
    /// Makes particles of the rows of sheet `k` that are due, and of its oldest `dropped` rows in any
    /// case; drops particles that are too old or too far. Returns also the impulse per density
    /// [m4/s], N, of those dropped.
    pub(crate) fn make_particles(
        &self,
        k: usize,
        sheet: &mut WakeSheet,
        dropped: usize,
        state: &AirState,
    ) -> (WakeEvents, DVec3) {
        let Some(settings) = &self.settings().particles else {
            return Default::default();
        };
        let (rows, kinds) = (sheet.rows(), &self.sheets()[k].kinds);
        let due = |c: usize| {
            let at_once = settings.leading_at_once && kinds[c] == EdgeKind::Leading;
            let keep = if at_once { Some(1) } else { settings.after };
            rows.saturating_sub(keep.unwrap_or(rows)).max(dropped)
        };
        let new_particles = sheet.convert(settings.radius, due);
        sheet.drop_spent();
        let (age, far) = (self.settings().max_age, self.settings().max_distance);
        let edge = self.edge_middle(k, state);
        let before = sheet.particles.impulse();
        let dropped_particles = sheet.particles.retain(|x, shed| {
            age.is_none_or(|age| state.time - shed <= age)
                && far.is_none_or(|far| x.distance(edge) <= far)
        });
        let events = WakeEvents {
            new_particles,
            dropped_particles,
            ..WakeEvents::default()
        };
        (events, before - sheet.particles.impulse())
    }
}
