//! Sums and how they are compared.

use wingbeat_vortex::{CoreModel, Network, Points, add_velocity};

/// Error at all targets, relative to the root mean square velocity: root mean square and largest.
pub fn error(v: &Points, exact: &Points) -> (f64, f64) {
    let n = exact.len() as f64;
    let scale = exact.iter().map(|v| v.length_squared()).sum::<f64>() / n;
    let square = || {
        v.iter()
            .zip(exact.iter())
            .map(|(a, b)| a.distance_squared(b))
    };
    (
        (square().sum::<f64>() / n / scale).sqrt(),
        (square().fold(0.0, f64::max) / scale).sqrt(),
    )
}

/// Velocity by the direct sum.
pub fn direct(model: CoreModel, net: &Network, at: &Points) -> Points {
    let mut v = Points::zeros(at.len());
    add_velocity(model, net, at, &mut v);
    v
}

/// Bits of all components.
pub fn bits(p: &Points) -> Vec<u64> {
    [&p.x, &p.y, &p.z]
        .into_iter()
        .flatten()
        .map(|v| v.to_bits())
        .collect()
}
