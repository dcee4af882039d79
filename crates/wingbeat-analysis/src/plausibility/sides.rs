//! Left and right wings that move unlike each other, as seen in a mirror: signs of one side taken for those of
//! the other.

use wingbeat_model::{AngleLaw, AngleLaws, Wing, are_pair};

use super::numbers::SAMPLES;

/// An angle whose root mean square swing is smaller tells nothing of its sign \[rad\].
const SWING: f64 = 0.5 * std::f64::consts::PI / 180.0;

/// An angle of the two, and what is said where it goes opposite ways.
struct Angle {
    of: fn(&AngleLaws) -> &AngleLaw,
    says: &'static str,
}

const ANGLES: [Angle; 3] = [
    Angle {
        of: |laws| &laws.phi,
        says: "stroke against each other, one forward while the other goes back: look at sign and phase of motion.phi, whose sign on a left wing is opposite to that on a right one",
    },
    Angle {
        of: |laws| &laws.theta,
        says: "deviate against each other, one above the plane of the strokes while the other is below: look at sign and phase of motion.theta, whose sign on a left wing is opposite to that on a right one",
    },
    Angle {
        of: |laws| &laws.psi,
        says: "feather against each other, the leading edge of one turning back while that of the other turns forward: look at sign and phase of motion.psi, which is the same on either side",
    },
];

/// Right and left wings of one pair that go opposite ways.
pub(super) fn against_each_other(wings: &[Wing]) -> Vec<String> {
    pairs(wings).flat_map(|(a, b)| opposite(a, b)).collect()
}

/// Whether those of a pair stroke opposite ways.
pub(super) fn strokes_against_each_other(wings: &[Wing]) -> bool {
    pairs(wings).any(|(a, b)| goes_opposite(&ANGLES[0], a, b))
}

/// Wings on either side that are a pair.
fn pairs(wings: &[Wing]) -> impl Iterator<Item = (&Wing, &Wing)> {
    let found = wingbeat_model::pairs(0..wings.len()).filter(|&pair| are_pair(wings, pair));
    found.map(|[a, b]| (&wings[a], &wings[b]))
}

/// The angles in which a wing and one on the other side go opposite ways. Where the strokes do, the others mean
/// nothing.
fn opposite(a: &Wing, b: &Wing) -> Vec<String> {
    let is_opposite = |angle: &&Angle| goes_opposite(angle, a, b);
    let say = |angle: &Angle| format!("wings `{}` and `{}` {}", a.name, b.name, angle.says);
    let strokes = ANGLES[..1].iter().filter(is_opposite);
    let strokes: Vec<String> = strokes.map(say).collect();
    match strokes.is_empty() {
        false => strokes,
        true => ANGLES[1..].iter().filter(is_opposite).map(say).collect(),
    }
}

/// Whether two wings on either side go opposite ways in this angle.
fn goes_opposite(angle: &Angle, a: &Wing, b: &Wing) -> bool {
    let laws = [a.motion.angles.clone(), b.motion.angles.mirrored()];
    let phases = [a.motion.phase, b.motion.phase];
    let swings = [0, 1].map(|w| swing((angle.of)(&laws[w]), phases[w]));
    likeness(&swings) < -0.5
}

/// Correlation of two angles \[1\]; 0 where one does not swing.
fn likeness([a, b]: &[Vec<f64>; 2]) -> f64 {
    let product = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    let [sizes @ .., shared] = [product(a, a), product(b, b), product(a, b)];
    let least = SAMPLES as f64 * SWING * SWING;
    match sizes.iter().all(|s| *s > least) {
        true => shared / (sizes[0] * sizes[1]).sqrt(),
        false => 0.0,
    }
}

/// An angle over a beat from this phase on, less its mean \[rad\].
fn swing(law: &AngleLaw, phase: f64) -> Vec<f64> {
    let at = |k: usize| law.at(k as f64 / SAMPLES as f64 + phase)[0];
    let all: Vec<f64> = (0..SAMPLES).map(at).collect();
    let mean = all.iter().sum::<f64>() / SAMPLES as f64;
    all.iter().map(|x| x - mean).collect()
}
