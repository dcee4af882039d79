//! How particles move and are stretched.
//!
//! Particles stretch each other by the exact gradient of their smoothed velocity. Filaments and wind
//! stretch a particle as they would a stick of its direction that reaches half a radius to either
//! side, `alpha' = abs(alpha) (u(x + s/2) - u(x - s/2)) / sigma`: outside their cores their flow has no
//! rotation, so both schemes agree there, and near a surface a blob of vorticity feels the mean
//! gradient over its size rather than that at a point.

use crate::images::Mirror;
use crate::lattice::Lattice;
use crate::particles::{ParticleSettings, Particles};
use crate::state::AirState;
use crate::summation::Sums;
use crate::wake::Mover;
use wingbeat_math::DVec3;
use wingbeat_vortex::{Particle, Points, Stretching};

/// Largest change of a strength in a step, relative to it, and in all, relative to its first size: the
/// core of a rolled-up sheet turns too fast for the steps of a flight, and would blow strengths up.
const MOST_CHANGE: f64 = 0.5;
const MOST_GROWTH: f64 = 2.0;

/// Velocity and stretching at all particles that are moved (twins follow theirs), sheet after sheet.
#[derive(Clone, Debug, Default)]
pub(crate) struct ParticleFlow {
    own: Vec<Particle>,
    image: Vec<Particle>,
    /// Places of the particles, then the fore ends of their sticks, then the rear ends.
    places: Points,
    /// Velocity of filaments there [m/s].
    ends: Points,
    /// Without the undisturbed air [m/s].
    velocity: Points,
    /// Rate of the strengths, that by the undisturbed air included [m3/s2].
    rate: Points,
    /// What one set of images adds.
    added: [Points; 2],
}

impl ParticleFlow {
    /// Takes velocities and rates of the accepted step; `sums` hold all filaments and particles.
    pub(crate) fn take(&mut self, lattice: &Lattice, state: &AirState, sums: &mut Sums) {
        self.own.clear();
        let Some(settings) = &lattice.settings().particles else {
            return;
        };
        for (k, sheet) in state.sheets.iter().enumerate() {
            if lattice.followed(k).is_none() {
                let set = &sheet.particles;
                let all = (0..set.len()).map(|i| set.at(i, settings, state.time));
                self.own.extend(all);
            }
        }
        self.velocity.reset(self.own.len());
        self.rate.reset(self.own.len());
        if self.own.is_empty() {
            return;
        }
        self.add_filaments(lattice, state.time, sums, settings.stretching);
        self.add_particles(lattice.mirrors(), sums, settings);
    }

    fn add_filaments(&mut self, lattice: &Lattice, t: f64, sums: &mut Sums, scheme: Stretching) {
        let n = self.own.len();
        let stick = |p: &Particle| 0.5 * p.core.sqrt() * p.strength.normalize_or_zero();
        self.places.clear();
        self.own.iter().for_each(|p| self.places.push(p.position));
        if scheme != Stretching::Omitted {
            for sign in [1.0, -1.0] {
                let end = |p: &Particle| p.position + sign * stick(p);
                self.own.iter().for_each(|p| self.places.push(end(p)));
            }
        }
        self.ends.reset(self.places.len());
        sums.add_filaments(&self.places, lattice.mirrors(), &mut self.ends);
        for (i, p) in self.own.iter().enumerate() {
            self.velocity.set(i, self.ends.get(i));
            if scheme != Stretching::Omitted {
                let at = |k: usize| self.ends.get(k) + lattice.stream(self.places.get(k), t);
                let apart = at(i + n) - at(i + 2 * n);
                self.rate
                    .set(i, p.strength.length() / p.core.sqrt() * apart);
            }
        }
    }

    fn add_particles(&mut self, mirrors: &[Mirror], sums: &Sums, settings: &ParticleSettings) {
        let (scheme, sum) = (settings.stretching, &sums.particles);
        sum.add_to_particles(&self.own, scheme, &mut self.velocity, &mut self.rate);
        for mirror in mirrors {
            let reflected = |p: &Particle| Particle {
                position: mirror.place(p.position),
                strength: mirror.vector(p.strength),
                core: p.core,
            };
            self.image.clear();
            self.image.extend(self.own.iter().map(reflected));
            let [v, s] = &mut self.added;
            v.reset(self.own.len());
            s.reset(self.own.len());
            sum.add_to_particles(&self.image, scheme, v, s);
            for i in 0..self.own.len() {
                let (dv, ds) = (mirror.vector(v.get(i)), mirror.vector(s.get(i)));
                self.velocity.set(i, self.velocity.get(i) + dv);
                self.rate.set(i, self.rate.get(i) + ds);
            }
        }
    }
}

impl Mover<'_> {
    /// Moves and stretches the particles of one sheet. The error is (particle, velocity).
    pub(crate) fn move_particles(&mut self, set: &mut Particles) -> Result<(), (usize, DVec3)> {
        let flow = self.flow;
        let first = self.next_particle;
        self.next_particle += set.len();
        let from: Vec<DVec3> = set.position.iter().collect();
        let mut to = Vec::with_capacity(from.len());
        for (i, &x) in from.iter().enumerate() {
            let (v, rate) = (flow.velocity.get(first + i), flow.rate.get(first + i));
            let stream = self.lattice.stream(x, self.time);
            let past = (i < set.velocity.len()).then(|| [set.velocity.get(i), set.rate.get(i)]);
            let [dv, ds] = past.map_or([DVec3::ZERO; 2], |[v0, s0]| {
                [v + stream - v0, rate - s0].map(|d| self.change * d)
            });
            to.push(x + (self.dt * stream + self.displacement(v + dv)));
            let most = MOST_GROWTH * set.first_size[i];
            let strength = self.stretched(set.strength.get(i), self.dt * (rate + ds), most);
            if !(to[i].is_finite() && strength.is_finite()) {
                return Err((i, v));
            }
            set.strength.set(i, strength);
        }
        if self.looks_back {
            set.velocity.clear();
            set.rate.clear();
            for (i, &x) in from.iter().enumerate() {
                let stream = self.lattice.stream(x, self.time);
                set.velocity.push(flow.velocity.get(first + i) + stream);
                set.rate.push(flow.rate.get(first + i));
            }
        }
        self.keep_clear(&from, &mut to);
        set.position = to.into_iter().collect();
        Ok(())
    }

    /// The strength after a step, its change and its size, `most`, held to their limits.
    fn stretched(&mut self, strength: DVec3, change: DVec3, most: f64) -> DVec3 {
        let step = MOST_CHANGE * strength.length();
        let end = strength + change;
        if change.length() <= step && end.length() <= most {
            return end;
        }
        if !end.is_finite() {
            return end;
        }
        self.events.limited += 1;
        (strength + change.clamp_length_max(step)).clamp_length_max(most)
    }
}
