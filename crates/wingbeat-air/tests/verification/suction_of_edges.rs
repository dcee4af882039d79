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

/// Pressure on camber is no suction: thin-airfoil theory has `2 pi alpha^2` of it at the leading edge of a parabola,
/// whatever its height.
#[test]
fn limit_suction_of_cambered_plates_in_plane_flow() {
    let (span, rows) = (1e6, 16);
    for (height, alpha) in [
        (0.0, 0.05),
        (0.005, 0.05),
        (0.02, 0.05),
        (0.02, -0.05),
        (0.08, -0.05),
    ] {
        let mut nodes = rectangle(rows, 1, DVec3::X, span * DVec3::Y);
        nodes
            .iter_mut()
            .for_each(|x| x.z = 4.0 * height * x.x * (1.0 - x.x));
        let wing = (&Surface::grid("wing", rows, 1), &nodes[..]);
        let [polhamus, pressure, joukowski] = [
            LoadMethod::Polhamus,
            LoadMethod::Pressure,
            LoadMethod::Joukowski,
        ]
        .map(|loads| force(wing, alpha, loads, (0.1 * span, 40)));
        let q = 0.5 * span;
        let [added, suction] = [polhamus, joukowski].map(|f| (f - pressure).length() / q);
        let exact = TAU * alpha * alpha;
        println!(
            "{height} {alpha}: {:.4} {:.4}",
            added / exact,
            suction / exact
        );
        // Of first order in the panels and in the camber.
        assert!((added / exact - 1.0).abs() < 0.02 + 2.5 * height);
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
