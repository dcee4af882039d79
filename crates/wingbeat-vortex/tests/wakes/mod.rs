//! Synthetic wakes: sheets as flapping wings leave them, of any size.

use std::f64::consts::{PI, TAU};
use wingbeat_vortex::DVec3;
use wingbeat_vortex::{CoreModel, Network};

/// Two wings beating in hover for several strokes: their trailing sheets sink, contract, and curl
/// around the tip vortex with age; about `edges` edges, two to three dozen strips along each wing.
/// Wing length and stroke time are 1.
pub fn hover(model: CoreModel, edges: usize) -> Network {
    let strips = 20 + (edges as f64).powf(0.2) as usize;
    let rows = edges / (4 * strips);
    let beats = 2.0 + rows as f64 / 400.0;
    let mut net = Network::default();
    for side in [-1.0, 1.0] {
        let first = net.nodes.len();
        for i in 0..=rows {
            let age = beats * i as f64 / rows as f64;
            (0..=strips).for_each(|j| {
                net.nodes
                    .push(sheet_node(side, age, j as f64 / strips as f64))
            });
        }
        add_rings(model, &mut net, first, [rows, strips], |i, j| {
            let (age, span) = (beats * i / rows as f64, (j + 0.5) / strips as f64);
            side * (TAU * age).sin()
                * (PI * span).sin().sqrt()
                * (1.0 + 0.1 * (37.0 * age + 11.0 * j).sin())
        });
    }
    net
}

/// Where the node that left the wing at `span` is when it is `age` beats old.
fn sheet_node(side: f64, age: f64, span: f64) -> DVec3 {
    let stroke = 1.2 * (TAU * age).cos();
    let near_tip = (-(1.0 - span) * 6.0).exp();
    let curl = 5.0 * near_tip * age.min(3.0);
    let arm = 0.15 * near_tip;
    let radius = (0.1 + 0.9 * span) * (1.0 - 0.25 * (1.0 - (-age).exp()));
    let (r, down) = (
        radius + arm * curl.sin(),
        0.35 * age + arm * (1.0 - curl.cos()),
    );
    DVec3::new(r * stroke.sin(), side * r * stroke.cos(), down)
}

/// Rings of a sheet of rows x cols panels whose nodes begin at `first`: each edge once, with the
/// difference of its two rings.
fn add_rings(
    model: CoreModel,
    net: &mut Network,
    first: usize,
    [rows, cols]: [usize; 2],
    ring: impl Fn(f64, f64) -> f64,
) {
    let gamma = |i: isize, j: isize| {
        let inside = (0..rows as isize).contains(&i) && (0..cols as isize).contains(&j);
        if inside {
            ring(i as f64, j as f64)
        } else {
            0.0
        }
    };
    for i in 0..=rows {
        for j in 0..=cols {
            let (a, r, c) = (first + i * (cols + 1) + j, i as isize, j as isize);
            let mut add = |b: usize, strength: f64| {
                let length = net.nodes.get(a).distance(net.nodes.get(b));
                net.push_edge(a, b, strength, model.core(length, 0.0));
            };
            if j < cols {
                add(a + 1, gamma(r, c) - gamma(r - 1, c));
            }
            if i < rows {
                add(a + cols + 1, gamma(r, c - 1) - gamma(r, c));
            }
        }
    }
}
