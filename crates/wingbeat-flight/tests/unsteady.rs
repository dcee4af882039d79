//! Flights in blade elements whose strips leave wakes.

use crate::common;

use common::{FREQUENCY, Fly, distance, fly};
use wingbeat_air::{Gust, GustShape, Wind};
use wingbeat_blade::{BladeSettings, Unsteady};
use wingbeat_flight::*;
use wingbeat_math::DVec3;
use wingbeat_model::deformation::{Deformation, SpanLaw, Term};

const ALL: [IntegratorChoice; 5] = [
    IntegratorChoice::Hamming,
    IntegratorChoice::Bdf,
    IntegratorChoice::Adams,
    IntegratorChoice::RungeKutta,
    IntegratorChoice::OrderEight { tolerance: 1e-10 },
];

/// The little fly in a stream, its strips with wakes by `theory`.
fn setup(steps: usize, beats: f64, theory: Unsteady) -> FlightSetup {
    let mut setup = Fly::default().setup(steps, beats);
    setup.air = AirModel::BladeElement(BladeOptions {
        blade: BladeSettings {
            free_stream: DVec3::new(-0.8, 0.3, 0.4),
            unsteady: Some(theory),
            ..BladeSettings::insect(1.2)
        },
        body_drag: None,
        induced: DVec3::ZERO,
        wind: Wind::default(),
        viscosity: None,
    });
    setup
}

const PETERS: Unsteady = Unsteady::Peters { states: 6 };

#[test]
fn order_all_integrators_come_to_the_same_flight_at_second_order() {
    let end = |steps: usize, integrator| {
        let setup = setup(steps, 1.0, PETERS);
        let records = fly(FlightSetup {
            integrator,
            ..setup
        });
        records[steps].clone()
    };
    let fine = end(640, IntegratorChoice::OrderEight { tolerance: 1e-10 });
    let moved = distance(&fine, &end(40, IntegratorChoice::Hamming));
    for integrator in ALL {
        let errors = [40, 80].map(|n| distance(&end(n, integrator), &fine));
        // The downwash is taken as a straight line over a step.
        assert!(
            errors[0] < 0.1 * moved.max(1e-2),
            "{integrator:?} {errors:?}"
        );
        let order = (errors[0] / errors[1]).log2();
        assert!(order > 1.7, "{integrator:?}: {order} {errors:?}");
    }
}

#[test]
fn invariant_resumed_wakes_of_strips_go_on_bit_for_bit() {
    for (integrator, beats) in ALL.into_iter().zip([2, 40, 61, 70, 90]) {
        let setup = FlightSetup {
            integrator,
            ..setup(40, 4.0, PETERS)
        };
        let mut whole = Simulation::new(setup.clone()).expect("a flight");
        (0..beats).for_each(|_| _ = whole.step().expect("a step"));
        let state = whole.state().clone();
        let wakes = state
            .air
            .as_ref()
            .and_then(AirMemory::strips)
            .expect("wakes");
        assert!(wakes[0].numbers().any(|z| z != 0.0));
        let mut resumed = Simulation::resume(setup, state).expect("its own state");
        for _ in 0..20 {
            let expected = whole.step().expect("a step").clone();
            assert_eq!(*resumed.step().expect("a step"), expected);
        }
    }
}

#[test]
fn refuses_a_state_with_other_wakes() {
    let state = |theory| {
        let flight = Simulation::new(setup(40, 1.0, theory)).expect("a flight");
        flight.state().clone()
    };
    let told = |setup: FlightSetup, state| {
        let refused = Simulation::resume(setup, state).err().expect("a misfit");
        refused.to_string()
    };
    let fewer = told(setup(40, 1.0, PETERS), state(Unsteady::Jones));
    assert!(fewer.contains("other wakes"), "{fewer}");
    let mut steady = setup(40, 1.0, PETERS);
    if let AirModel::BladeElement(air) = &mut steady.air {
        air.blade.unsteady = None;
    }
    let none = told(steady, state(PETERS));
    assert!(none.contains("other wakes"), "{none}");
}

#[test]
fn balances_energy_with_wakes_deformed_wings_and_a_gust() {
    let plain = setup(160, 1.0, PETERS);
    let mut bent = plain.clone();
    let twist = Deformation {
        twist: vec![Term::steady(SpanLaw::Linear {
            root: 0.0,
            tip: 0.2,
        })],
        ..Deformation::default()
    };
    for wing in &mut bent.animal.wings {
        *wing = wing.clone().deformed_by(twist.clone()).expect("a twist");
    }
    let mut windy = plain.clone();
    windy.air.wind_mut().expect("a wind").gusts = vec![Gust {
        amplitude: DVec3::new(0.2, 0.0, -0.3),
        start: 1e-3,
        shape: GustShape::OneMinusCosine { duration: 2e-3 },
        slowness: DVec3::ZERO,
    }];
    for setup in [plain, bent, windy] {
        let records = fly(FlightSetup {
            integrator: IntegratorChoice::RungeKutta,
            ..setup
        });
        let last = records.last().expect("records");
        let turned = last.hinge_work.abs() + last.air_work.abs();
        // The work of the loads that act is what is counted, whatever their wakes: the error of the quadrature.
        let open = last.energy_residual.abs() / turned;
        assert!(open < 1e-6, "{open:e}");
        let momentum = last.momentum_residual.length() / last.momentum.length();
        assert!(momentum < 1e-9, "{momentum:e}");
    }
}

#[test]
fn limit_a_beat_that_is_slow_over_its_way_has_the_quasi_steady_loads() {
    // A tethered wing that flaps ever slower in the same stream: the wake is left behind.
    let gap = |factor: f64| {
        let flown = |theory: Option<Unsteady>| {
            let mut setup = setup(80, 2.0, Unsteady::Jones);
            for wing in &mut setup.animal.wings {
                wing.motion.frequency = FREQUENCY / factor;
                wing.motion.start = wingbeat_model::Start::Impulsive;
            }
            setup.time.step *= factor;
            setup.time.period = setup.time.period.map(|p| p * factor);
            if let AirModel::BladeElement(air) = &mut setup.air {
                air.blade.free_stream = DVec3::new(-8.0, 0.0, 0.0);
                air.blade.unsteady = theory;
            }
            setup.mode = MotionMode::Tethered(PrescribedMotion::at_rest(DVec3::ZERO, DVec3::ZERO));
            fly(setup)
        };
        let (lagging, steady) = (flown(Some(Unsteady::Jones)), flown(None));
        let both = lagging.iter().zip(&steady).skip(80);
        let (mut gap, mut size) = (0.0_f64, 0.0_f64);
        for (a, b) in both {
            gap = gap.max((a.air[1].force - b.air[1].force).length());
            size = size.max(b.air[1].force.length());
        }
        gap / size
    };
    let [fast, slow, slower] = [1.0, 10.0, 100.0].map(gap);
    assert!(
        fast > 5.0 * slow && slow > 5.0 * slower,
        "{fast} {slow} {slower}"
    );
    assert!(slower < 5e-3, "{slower}");
}
