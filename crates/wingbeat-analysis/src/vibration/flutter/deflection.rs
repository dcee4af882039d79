//! Steady deflections that grow as they do about static divergence.
//!
//! Loads of a given incidence bend a linear wing by `d = a q / (1 - q / q_D)`, q the dynamic pressure and `q_D`
//! that of static divergence. A wing whose incidence is not zero does not part from a straight state there: it
//! bends more and more, stiffens, and no motion about its steady state grows. `d ln d / d ln q = 1 / (1 - q /
//! q_D)` tells how near it is, and `q / d`, which falls along a straight line to 0 at `q_D`, where it lies
//! [Southwell 1932].

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
    /// Displacement of the tip at both \[m\].
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
        let [tip, turn] = [
            pair.map(|c| c.steady.tip.length()),
            pair.map(|c| c.steady.turn.length()),
        ];
        let q = speeds.map(|v| v * v);
        let by_pressure = |d: [f64; 2]| (d[1] / d[0]).ln() / (q[1] / q[0]).ln();
        // Loads that are not those of the air, weight say, may cancel them in either measure.
        let is_steep = by_pressure(tip).min(by_pressure(turn)) > STEEP;
        let is_one_way = pair[0].steady.tip.dot(pair[1].steady.tip) > 0.0;
        let line = [0, 1].map(|k| q[k] / turn[k]);
        let square = q[0] + (q[1] - q[0]) * line[0] / (line[0] - line[1]);
        (q[1] > q[0] && is_steep && is_one_way && turn[1] > FELT).then(|| Self {
            between: speeds,
            tip,
            divergence: (turn[1] < SMALL).then(|| square.sqrt()),
        })
    }
}
