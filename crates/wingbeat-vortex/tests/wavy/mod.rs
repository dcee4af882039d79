//! A small wavy sheet, for timing and counting the kernel.

use wingbeat_vortex::DVec3;
use wingbeat_vortex::{CoreModel, Network};

/// `n` x `n` rings on a unit square with waves in it, every edge of circulation 1.
pub fn sheet(model: CoreModel, n: usize) -> Network {
    let core = model.core(1.0 / n as f64, 0.0);
    let mut net = Network::default();
    for i in 0..=n {
        for j in 0..=n {
            let (x, y) = (i as f64 / n as f64, j as f64 / n as f64);
            net.nodes.push(DVec3::new(x, y, 0.1 * (7.0 * x).sin()));
        }
    }
    for i in 0..=n {
        for j in 0..=n {
            let a = i * (n + 1) + j;
            if j < n {
                net.push_edge(a, a + 1, 1.0, core);
            }
            if i < n {
                net.push_edge(a, a + n + 1, 1.0, core);
            }
        }
    }
    net
}
