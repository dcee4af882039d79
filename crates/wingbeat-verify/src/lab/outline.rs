//! Flat wings with straight or curved edges.

use wingbeat_math::DVec3;

/// Edges of a flat wing at the span position y: leading edge x, chord [m].
pub type Outline = fn(f64) -> [f64; 2];

/// How panel lines are spread over the span from tip to tip.
#[derive(Clone, Copy, PartialEq)]
pub enum Spread {
    /// Equal.
    Uniform,
    /// Dense at the tips.
    Cosine,
}

/// Nodes of a flat wing between the span positions `ends` [m], x aft, y right.
pub fn nodes(
    outline: impl Fn(f64) -> [f64; 2],
    ends: [f64; 2],
    [rows, cols]: [usize; 2],
    spread: Spread,
) -> Vec<DVec3> {
    let station = |j: usize| {
        let s = j as f64 / cols as f64;
        let s = match spread {
            Spread::Uniform => s,
            Spread::Cosine => 0.5 - 0.5 * (std::f64::consts::PI * s).cos(),
        };
        ends[0] + (ends[1] - ends[0]) * s
    };
    let at = |i: usize, j: usize| {
        let y = station(j);
        let [lead, chord] = outline(y);
        DVec3::new(lead + chord * i as f64 / rows as f64, y, 0.0)
    };
    (0..=rows)
        .flat_map(|i| (0..=cols).map(move |j| (i, j)))
        .map(|(i, j)| at(i, j))
        .collect()
}

/// A circle of radius 1.
pub fn circle(y: f64) -> [f64; 2] {
    let half = (1.0 - y * y).max(0.0).sqrt();
    [-half, 2.0 * half]
}

/// Warren-12: leading edge swept by 53.54 deg, taper 1/3, aspect ratio 2 sqrt 2, mean chord 1, apex
/// at the origin.
pub fn warren_12(y: f64) -> [f64; 2] {
    let eta = y.abs() / std::f64::consts::SQRT_2;
    [y.abs() * 53.54_f64.to_radians().tan(), 1.5 - eta]
}
