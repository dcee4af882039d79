//! Steady deflections that grow as they do about static divergence.
//!
//! Loads of a given incidence bend a linear wing by `d = a q / (1 - q / q_D)`, q the dynamic pressure and `q_D`
//! that of static divergence. A wing whose incidence is not zero does not part from a straight state there: it
//! bends more and more, stiffens, and no motion about its steady state grows. `d ln d / d ln q = 1 / (1 - q /
//! q_D)` tells how near it is, and `q / d`, which falls along a straight line to 0 at `q_D`, where it lies
//! [Southwell 1932].
//!
//! Under weight, too, it is bent by `(d_w + a q) / (1 - q / q_D)`, `d_w` the deflection by weight alone: what the air adds
//! to that is `(a + d_w / q_D) q / (1 - q / q_D)`, along such a line again, which the whole deflection is not. So `d` is
//! the part that the air adds ([`SteadyWing::by_air`](super::SteadyWing::by_air)).

use super::condition::Condition;

/// `d ln d / d ln q` between two speeds from which on a deflection is steep \[1\]: the dynamic pressure is two
/// thirds of that of divergence.
const STEEP: f64 = 3.0;

/// Rotation of the tip below which a deflection tells nothing \[rad\].
const FELT: f64 = 1e-3;

/// Rotation of the tip up to which deflections count as small \[rad\].
const SMALL: f64 = 0.2;

/// Neighbouring speeds between which the steady deflection of a wing grows much faster than the dynamic
/// pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steep {
    /// The two speeds [m/s].
    pub between: [f64; 2],
    /// Displacement of the tip at both, less that under weight alone \[m\].
    pub tip: [f64; 2],
    /// Speed of static divergence by Southwell's line through both [m/s]; none where deflections are not small.
    pub divergence: Option<f64>,
}

/// Such speeds among `conditions` of one wing, of rising speed.
pub fn steep(conditions: &[Condition]) -> Vec<Steep> {
    let pairs = conditions.windows(2).map(|w| [&w[0], &w[1]]);
    pairs.filter_map(Steep::between).collect()
}

impl Steep {
    fn between(pair: [&Condition; 2]) -> Option<Self> {
        let speeds = pair.map(|c| c.speed);
        let [first, last] = pair.map(|c| c.steady.by_air());
        let by_air = [first?, last?];
        let [tip, turn] = [0, 1].map(|k| by_air.map(|d| d[k].length()));
        let q = speeds.map(|v| v * v);
        let by_pressure = |d: [f64; 2]| (d[1] / d[0]).ln() / (q[1] / q[0]).ln();
        // Where loads of the air cancel each other in one measure, they do not in the other.
        let is_steep = by_pressure(tip).min(by_pressure(turn)) > STEEP;
        let is_one_way = (0..2).all(|k| by_air[0][k].dot(by_air[1][k]) > 0.0);
        let turned = pair.iter().flat_map(|c| {
            let by_weight = c.steady.by_weight.map(|d| d[1]);
            by_weight.into_iter().chain([c.steady.turn])
        });
        let are_small = turned.chain([by_air[1][1]]).all(|t| t.length() < SMALL);
        let line = [0, 1].map(|k| q[k] / turn[k]);
        let square = q[0] + (q[1] - q[0]) * line[0] / (line[0] - line[1]);
        (q[1] > q[0] && is_steep && is_one_way && turn[1] > FELT).then(|| Self {
            between: speeds,
            tip,
            divergence: are_small.then(|| square.sqrt()),
        })
    }
}
