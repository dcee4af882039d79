//! Where growth changes its sign between speeds.

use super::Condition;
use crate::realisation::Vibration;

/// A speed at which flutter begins or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Speed [m/s].
    pub speed: f64,
    /// Angular frequency there [rad/s].
    pub frequency: f64,
    /// Whether growth rises with speed: flutter begins.
    pub begins: bool,
    /// Speeds between which it was interpolated [m/s].
    pub between: [f64; 2],
}

/// Zero crossings of growth along `conditions` of rising speed, interpolated linearly; a mode goes on in that of the next speed whose
/// eigenvalue is nearest.
pub fn crossings(conditions: &[Condition]) -> Vec<Crossing> {
    let pairs = conditions.windows(2);
    pairs.flat_map(|w| between(&w[0], &w[1])).collect()
}

fn between(a: &Condition, b: &Condition) -> Vec<Crossing> {
    let of = |v: &Vibration| {
        let next = nearest(v, &b.modes)?;
        // Not the neighbour's: the nearest the other way, too.
        if nearest(next, &a.modes)? != v || (v.growth > 0.0) == (next.growth > 0.0) {
            return None;
        }
        let s = v.growth / (v.growth - next.growth);
        Some(Crossing {
            speed: a.speed + s * (b.speed - a.speed),
            frequency: v.frequency + s * (next.frequency - v.frequency),
            begins: next.growth > v.growth,
            between: [a.speed, b.speed],
        })
    };
    a.modes.iter().filter_map(of).collect()
}

fn nearest<'a>(v: &Vibration, among: &'a [Vibration]) -> Option<&'a Vibration> {
    let apart = |w: &Vibration| (w.growth - v.growth).hypot(w.frequency - v.frequency);
    among.iter().min_by(|p, q| apart(p).total_cmp(&apart(q)))
}
