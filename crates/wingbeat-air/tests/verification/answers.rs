//! How forces answer to accelerations: the matrices for the left-hand side of coupled steps.

use crate::common::{rectangle, translating};
use wingbeat_air::{AirLoads, AirSettings, CoreModel, Lattice, LoadMethod, SheddingKinds, Surface};
use wingbeat_math::DVec3;

/// In still air without a wake, forces on a plate that is set in motion as a rigid body are, to first order in
/// its velocity, those of the rate of the circulations alone: what the matrix says of the difference over the
/// step.
#[test]
fn exact_normal_inertia_is_what_a_plate_at_rest_feels_when_it_moves() {
    const DT: f64 = 0.01;
    let nodes = rectangle(4, 6, DVec3::X, 3.0 * DVec3::Y);
    for loads in [LoadMethod::Pressure, LoadMethod::Joukowski] {
        let settings = AirSettings {
            bound_core: CoreModel::Scully { radius: 0.02 },
            shedding: SheddingKinds {
                tip: true,
                ..SheddingKinds::TRAILING
            },
            loads,
            ..AirSettings::accurate(1.2, DVec3::ZERO)
        };
        let lattice = Lattice::new(vec![Surface::grid("plate", 4, 6)], settings).expect("a plate");
        let rest = translating(nodes.clone(), DVec3::ZERO);
        let (mut ws, mut out) = (lattice.workspace(), AirLoads::default());
        let mut state = lattice.initial_state(&rest);
        (lattice.loads(&state, 0.0, DT, &rest, &mut ws, &mut out)).expect("loads at rest");
        lattice
            .accept(&mut state, &rest, &out)
            .expect("a first step");
        lattice.convect(&mut state, DT, &mut ws).expect("a wake");
        let mut moved = rest.clone();
        for (v, x) in moved.velocity.iter_mut().zip(&nodes) {
            *v = 1e-8 * (DVec3::new(0.1, 0.2, 1.0) + DVec3::new(0.3, -2.0, 0.5).cross(*x));
        }
        (lattice.loads(&state, DT, DT, &moved, &mut ws, &mut out)).expect("loads in motion");
        let mut matrix = vec![];
        (lattice.normal_inertia(0, &state, (&mut ws, &out), &mut matrix)).expect("a matrix");
        let [now, ..] = lattice.circulation_rate_weights(&state, DT).expect("rates");
        let normal = |of: &[DVec3]| -> Vec<f64> {
            let both = of.iter().zip(&out.panels.normal);
            both.map(|(x, n)| x.dot(*n)).collect()
        };
        let (wash, force) = (normal(&out.panels.velocity), normal(&out.force));
        let largest = force.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
        for (row, f) in matrix.chunks_exact(wash.len()).zip(&force) {
            let said: f64 = row.iter().zip(&wash).map(|(a, w)| a * now * w).sum();
            // What is of second order in the velocity is 1e-10 of it.
            assert!((said - f).abs() < 1e-8 * largest, "{loads:?}: {said} {f}");
        }
        let sum: f64 = force.iter().sum();
        assert!(
            sum * wash.iter().sum::<f64>() < 0.0,
            "air that is carried along resists"
        );
    }
}
