//! How particles move.

use crate::error::AirError;
use crate::state::{Particles, WakeEvents};
use crate::wake::move_step::MoveStep;
use crate::wake::sheet_move::{Paths, SheetMove};
use wingbeat_math::DVec3;

/// Largest change of a strength in a step, relative to it, and in all, relative to its first size: the
/// core of a rolled-up sheet turns too fast for the steps of a flight, and would blow strengths up.
const MAX_CHANGE: f64 = 0.5;
const MAX_GROWTH: f64 = 2.0;

impl SheetMove {
    /// Moves and stretches the particles of sheet `k`.
    ///
    /// # Errors
    /// Velocities or strengths that are not finite.
    pub(crate) fn move_particles(
        &mut self,
        step: &MoveStep,
        (k, number): (usize, u64),
        set: &mut Particles,
    ) -> Result<WakeEvents, AirError> {
        let (flow, [_, first]) = (&step.flow.particles, step.flow.first[k]);
        let at = |i: usize| (flow.velocity.get(first + i), flow.rate.get(first + i));
        let Paths { from, to } = &mut self.particles;
        from.clear();
        from.extend(set.position.iter());
        to.clear();
        let mut events = WakeEvents::default();
        for (i, &x) in from.iter().enumerate() {
            let ((v, rate), stream) = (at(i), step.stream(x));
            let past = (i < set.velocity.len()).then(|| [set.velocity.get(i), set.rate.get(i)]);
            let [dv, ds] = past.map_or([DVec3::ZERO; 2], |[v0, s0]| {
                [v + stream - v0, rate - s0].map(|d| step.change * d)
            });
            let (end, is_limited) = step.end(x, stream, v + dv);
            let max = MAX_GROWTH * set.first_size[i];
            let (strength, is_held) = stretched(set.strength.get(i), step.dt * (rate + ds), max);
            if !(end.is_finite() && strength.is_finite()) {
                return Err(AirError::ParticleNotFinite {
                    step: number,
                    sheet: k,
                    particle: i,
                    velocity: v,
                });
            }
            events.limited += u64::from(is_limited) + u64::from(is_held);
            to.push(end);
            set.strength.set(i, strength);
        }
        if step.looks_back {
            set.velocity.clear();
            set.rate.clear();
            for (i, &x) in from.iter().enumerate() {
                let (v, rate) = at(i);
                set.velocity.push(v + step.stream(x));
                set.rate.push(rate);
            }
        }
        let impulse = |places: &[DVec3]| -> DVec3 {
            let each = places.iter().zip(set.strength.iter());
            each.map(|(x, alpha)| 0.5 * x.cross(alpha)).sum()
        };
        let unhindered = impulse(to);
        let [_, near] = step.keep_clear((from, to), |_| true);
        events.near_surface += near;
        self.taken = unhindered - impulse(to);
        set.position.clear();
        to.iter().for_each(|&x| set.position.push(x));
        Ok(events)
    }
}

/// The strength after a step, and whether its change was limited or its size held to `max`.
fn stretched(strength: DVec3, change: DVec3, max: f64) -> (DVec3, bool) {
    let step = MAX_CHANGE * strength.length();
    let end = strength + change;
    if change.length() <= step && end.length() <= max || !end.is_finite() {
        return (end, false);
    }
    let held = (strength + change.clamp_length_max(step)).clamp_length_max(max);
    (held, true)
}
