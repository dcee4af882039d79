//! Where growth changes its sign between speeds.

use super::condition::Condition;
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

/// Zero crossings of growth along `conditions` of rising speed, interpolated linearly. Modes of two speeds go together by the
/// distance of their eigenvalues, the nearest first: where two come close, speeds are to be closer than they.
pub fn crossings(conditions: &[Condition]) -> Vec<Crossing> {
    let pairs = conditions.windows(2);
    let between = |w: &[Condition]| {
        let speeds = [w[0].speed, w[1].speed];
        let pairs = together(&w[0].modes, &w[1].modes).into_iter();
        let crossing = pairs.filter_map(|(v, next)| crossing(speeds, v, next));
        crossing.collect::<Vec<_>>()
    };
    pairs.flat_map(between).collect()
}

fn crossing(between: [f64; 2], v: &Vibration, next: &Vibration) -> Option<Crossing> {
    if (v.growth > 0.0) == (next.growth > 0.0) {
        return None;
    }
    let s = v.growth / (v.growth - next.growth);
    Some(Crossing {
        speed: between[0] + s * (between[1] - between[0]),
        frequency: v.frequency + s * (next.frequency - v.frequency),
        begins: next.growth > v.growth,
        between,
    })
}

/// Pairs of nearest eigenvalues, each in one pair at most.
fn together<'a>(a: &'a [Vibration], b: &'a [Vibration]) -> Vec<(&'a Vibration, &'a Vibration)> {
    let apart =
        |v: &Vibration, w: &Vibration| (w.growth - v.growth).hypot(w.frequency - v.frequency);
    let all = (0..a.len()).flat_map(|i| (0..b.len()).map(move |j| (i, j)));
    let mut all: Vec<_> = all.collect();
    all.sort_by(|p, q| apart(&a[p.0], &b[p.1]).total_cmp(&apart(&a[q.0], &b[q.1])));
    let (mut left, mut right) = (vec![true; a.len()], vec![true; b.len()]);
    all.retain(|&(i, j)| {
        let free = left[i] && right[j];
        if free {
            (left[i], right[j]) = (false, false);
        }
        free
    });
    all.into_iter().map(|(i, j)| (&a[i], &b[j])).collect()
}
