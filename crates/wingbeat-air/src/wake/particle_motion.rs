//! How particles move.

use crate::state::Particles;
use crate::wake::mover::Mover;
use wingbeat_math::DVec3;

/// Largest change of a strength in a step, relative to it, and in all, relative to its first size: the
/// core of a rolled-up sheet turns too fast for the steps of a flight, and would blow strengths up.
const MAX_CHANGE: f64 = 0.5;
const MAX_GROWTH: f64 = 2.0;

impl Mover<'_> {
    /// Moves and stretches the particles of one sheet. The error is (particle, velocity).
    pub(crate) fn move_particles(&mut self, set: &mut Particles) -> Result<(), (usize, DVec3)> {
        let flow = self.flow;
        let first = self.next_particle;
        self.next_particle += set.len();
        let (mut from, mut to) = (std::mem::take(&mut self.from), std::mem::take(&mut self.to));
        from.clear();
        from.extend(set.position.iter());
        to.clear();
        for (i, &x) in from.iter().enumerate() {
            let (v, rate) = (flow.velocity.get(first + i), flow.rate.get(first + i));
            let stream = self.lattice.stream(x, self.time);
            let past = (i < set.velocity.len()).then(|| [set.velocity.get(i), set.rate.get(i)]);
            let [dv, ds] = past.map_or([DVec3::ZERO; 2], |[v0, s0]| {
                [v + stream - v0, rate - s0].map(|d| self.change * d)
            });
            to.push(x + (self.dt * stream + self.displacement(v + dv)));
            let max = MAX_GROWTH * set.first_size[i];
            let strength = self.stretched(set.strength.get(i), self.dt * (rate + ds), max);
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
        let impulse = |places: &[DVec3]| -> DVec3 {
            let each = places.iter().zip(set.strength.iter());
            each.map(|(x, alpha)| 0.5 * x.cross(alpha)).sum()
        };
        let unhindered = impulse(&to);
        self.keep_clear(&from, &mut to, |_| true);
        self.taken_from_particles = unhindered - impulse(&to);
        set.position.clear();
        to.iter().for_each(|&x| set.position.push(x));
        (self.from, self.to) = (from, to);
        Ok(())
    }

    /// The strength after a step, its change limited, and its size to `max`.
    fn stretched(&mut self, strength: DVec3, change: DVec3, max: f64) -> DVec3 {
        let step = MAX_CHANGE * strength.length();
        let end = strength + change;
        if change.length() <= step && end.length() <= max {
            return end;
        }
        if !end.is_finite() {
            return end;
        }
        self.events.limited += 1;
        (strength + change.clamp_length_max(step)).clamp_length_max(max)
    }
}
