//! Polhamus's analogy: what counts as the suction of a leading edge.

use crate::common::{fly, rectangle, total_force, translating};
use std::f64::consts::TAU;
use wingbeat_air::{AirSettings, CoreModel, Lattice, LoadMethod, Surface};
use wingbeat_math::DVec3;

/// Force of a wing at rest in a unit stream at `alpha` [rad], by this method.
fn force(
    (surface, nodes): (&Surface, &[DVec3]),
    alpha: f64,
    loads: LoadMethod,
    (dt, steps): (f64, usize),
) -> DVec3 {
    let core = CoreModel::Scully { radius: 1e-7 };
    let stream = DVec3::new(alpha.cos(), 0.0, alpha.sin());
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        loads,
        ..AirSettings::accurate(1.0, stream)
    };
    let lattice = Lattice::new(vec![surface.clone()], settings).unwrap();
    let motion = |_| translating(nodes.to_vec(), DVec3::ZERO);
    total_force(&(fly(&lattice, motion, dt, steps, |_, _, _, _| {}).unwrap()).loads)
}

/// Pressure on camber is no suction: a thin arc of height h has `2 pi sin^2 alpha cos^2 beta` of it at its leading edge,
/// tan beta = 2 h, and so has the lattice, with an error of the order 3/2 in the panels.
#[test]
fn order_suction_of_cambered_plates_in_plane_flow_is_three_halves() {
    let span = 1e6;
    let suction = |rows: usize, height: f64, alpha: f64| {
        let mut nodes = rectangle(rows, 1, DVec3::X, span * DVec3::Y);
        // A circle through both edges.
        let radius = 0.5 * (0.25 / height + height);
        nodes.iter_mut().for_each(|x| {
            x.z = (radius.powi(2) - (x.x - 0.5).powi(2)).sqrt() - (radius - height);
        });
        let wing = (&Surface::grid("wing", rows, 1), &nodes[..]);
        let [polhamus, pressure] = [LoadMethod::Polhamus, LoadMethod::Pressure]
            .map(|loads| force(wing, alpha, loads, (0.1 * span, 40)));
        (polhamus - pressure).length() / (0.5 * span)
    };
    for (height, alpha) in [(0.02, 0.05_f64), (0.02, -0.05), (0.08, 0.08), (0.08, -0.08)] {
        let exact = TAU * alpha.sin().powi(2) / (1.0 + 4.0 * height * height);
        let error = [16, 32, 64].map(|rows| suction(rows, height, alpha) / exact - 1.0);
        println!("{height} {alpha}: {error:.4?}");
        // Measured 0.3 to 1.4 % on 64 panels, orders of 1.37 to 1.64.
        assert!(error[2].abs() < 0.02);
        for pair in error.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((1.3..1.7).contains(&order), "{order}");
        }
    }
}

/// What Polhamus's analogy adds to a swept wing is the suction of its leading edge, thrust over the cosine of the
/// sweep, without that of the tips' side edges, which is a quarter of it at 45 deg.
#[test]
fn agrees_suction_of_swept_edges_with_thrust_over_the_cosine() {
    let alpha = 1e-3;
    for (sweep, is_delta) in [
        (-45.0_f64, false),
        (0.0, false),
        (45.0, false),
        (60.0, false),
        (63.435, true),
    ] {
        let slope = sweep.to_radians().tan();
        let (rows, columns, half) = (4, 16, 2.0);
        let at = |i: usize, j: usize| {
            let y = half * (2.0 * j as f64 / columns as f64 - 1.0);
            let chord = if is_delta {
                slope * (half - y.abs())
            } else {
                1.0
            };
            DVec3::new(y.abs() * slope + chord * i as f64 / rows as f64, y, 0.0)
        };
        let nodes: Vec<DVec3> = (0..=rows)
            .flat_map(|i| (0..=columns).map(move |j| at(i, j)))
            .collect();
        let wing = (&Surface::grid("wing", rows, columns), &nodes[..]);
        let [polhamus, pressure, joukowski] = [
            LoadMethod::Polhamus,
            LoadMethod::Pressure,
            LoadMethod::Joukowski,
        ]
        .map(|loads| force(wing, alpha, loads, (2.0, 10)));
        let added = (polhamus - pressure).z;
        let ratio = added * sweep.to_radians().cos() / -joukowski.x;
        println!("sweep {sweep}, delta {is_delta}: {ratio:.4}");
        assert!((ratio - 1.0).abs() < 0.03);
    }
}
