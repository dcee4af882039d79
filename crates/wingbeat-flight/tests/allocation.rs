//! Steps allocate nothing once a flight is under way: in blade elements, with and without feedback.

mod common;

use std::sync::Arc;

use allocation_counter::measure;
use common::Fly;
use wingbeat_blade::{BladeSettings, Unsteady};
use wingbeat_flight::*;

fn blade() -> FlightSetup {
    let mut setup = Fly::default().setup(40, 4.0);
    setup.air = AirModel::BladeElement(BladeOptions {
        blade: BladeSettings::insect(1.2),
        ..BladeOptions::insect(1.2)
    });
    setup
}

#[test]
fn exact_no_allocation_in_steps_in_blade_elements() {
    let wakes = Some(Unsteady::Peters { states: 8 });
    for (integrator, unsteady) in [
        IntegratorChoice::Hamming,
        IntegratorChoice::Bdf,
        IntegratorChoice::Adams,
        IntegratorChoice::RungeKutta,
        IntegratorChoice::OrderEight { tolerance: 1e-9 },
    ]
    .into_iter()
    .flat_map(|i| [(i, None), (i, wakes)])
    {
        let mut setup = FlightSetup {
            integrator,
            ..blade()
        };
        if let AirModel::BladeElement(air) = &mut setup.air {
            air.blade.unsteady = unsteady;
        }
        let mut flight = Simulation::new(setup).expect("the little fly");
        let mut copy = Record::default();
        let mut step = || {
            let record = flight.step().expect("a step");
            copy.clone_from(record);
        };
        (0..5).for_each(|_| step());
        let beat = measure(|| (0..40).for_each(|_| step()));
        assert_eq!(beat.count_total, 0, "{integrator:?} {unsteady:?}");
    }
}

/// A controller answers with a new list at every look, and its wings get new motions; between looks nothing is
/// allocated.
#[test]
fn exact_no_allocation_between_looks() {
    #[derive(Clone, Debug)]
    struct Still;
    impl Controller for Still {
        fn command(
            &mut self,
            _: &Sensed,
        ) -> Result<Vec<wingbeat_model::motion::Adjustment>, String> {
            Ok(vec![Default::default(); 2])
        }
    }
    let setup = FlightSetup {
        feedback: Some(Feedback {
            controller: Arc::new(Still),
            interval: 40,
            latency: 1,
            lag: 0.0,
        }),
        ..blade()
    };
    let mut flight = Simulation::new(setup).expect("the little fly");
    let mut step = || _ = flight.step().expect("a step");
    (0..45).for_each(|_| step());
    let between = measure(|| (0..30).for_each(|_| step()));
    assert_eq!(between.count_total, 0);
}
