//! Verification of coupled flight: balances, orders, symmetry, limits, restart.

use crate::common;

use common::{FREQUENCY, Fly, SPAN, distance, fly, pose, sine};
use wingbeat_flight::*;
use wingbeat_math::DVec3;

/// Largest absolute value over a flight.
fn largest(records: &[Record], f: impl Fn(&Record) -> f64) -> f64 {
    records.iter().map(|r| f(r).abs()).fold(0.0, f64::max)
}

/// Residuals of the balances of energy, momentum and angular momentum, relative to the largest
/// kinetic energy and to weight x period (x span).
fn residuals(records: &[Record], weight: f64) -> [f64; 3] {
    let impulse = weight / FREQUENCY;
    let kinetic = largest(records, |r| r.kinetic_energy);
    [
        largest(records, |r| r.energy_residual) / kinetic,
        largest(records, |r| r.momentum_residual.length()) / impulse,
        largest(records, |r| r.angular_momentum_residual.length()) / (impulse * SPAN),
    ]
}

const ASYMMETRIC: [f64; 2] = [1.1, 1.0];

#[test]
fn balances_of_energy_and_momenta_close() {
    let at = |steps| {
        let setup = Fly {
            amplitudes: ASYMMETRIC,
            ..Fly::default()
        }
        .setup(steps, 1.5);
        let weight = setup.animal.mass() * 9.81;
        residuals(&fly(setup), weight)
    };
    let [coarse, fine] = [at(40), at(80)];
    // Momentum is a state of the momentum form: its balance is round-off.
    assert!(
        coarse[1] < 1e-12 && fine[1] < 1e-12,
        "momentum {coarse:?} {fine:?}"
    );
    // Angular momentum about the origin: gravity acts at once, the added mass of the falling fly
    // one step later (dGamma/dt is left out at step 0); that jump, some 1e-6, is what is left.
    assert!(
        coarse[2] < 1e-5 && fine[2] < coarse[2] / 2.0,
        "spin {coarse:?} {fine:?}"
    );
    // The energy shows the same jump in the first step, and nothing else of that size.
    assert!(
        coarse[0] < 3e-5 && fine[0] < coarse[0],
        "energy {coarse:?} {fine:?}"
    );
}

#[test]
fn order_of_coupled_flight_in_the_step_is_one() {
    // Explicit Euler wake and backward circulation rate: first order, so differences between
    // h, h/2, h/4 halve (measured 2.1).
    let end = |steps| {
        fly(Fly::default().forward(steps, 1.0))
            .pop()
            .expect("records")
    };
    let [a, b, c] = [40, 80, 160].map(end);
    let ratio = distance(&a, &b) / distance(&b, &c);
    assert!((1.8..2.4).contains(&ratio), "ratio {ratio}");
}

#[test]
fn invariant_mirror_symmetric_flight_stays_symmetric() {
    let records = fly(Fly::default().setup(40, 2.0));
    // Round-off of the influence solve (condition 1e2) grows by some powers of ten in two beats.
    for r in &records {
        let (p, e) = pose(r);
        let sideways = [(p.y + 0.02) / SPAN, e.y, e.z];
        assert!(
            sideways.iter().all(|x| x.abs() < 1e-9),
            "step {}: {sideways:?}",
            r.step
        );
    }
    let (p, _) = pose(records.last().expect("records"));
    assert!((p.z - 0.03).abs() > 1e-3 * SPAN, "the fly did move");
}

#[test]
fn agrees_with_both_halves_when_only_one_is_computed() {
    let mut setup = Fly::default().setup(40, 1.0);
    let whole = fly(setup.clone()).pop().expect("records");
    let AirModel::VortexLattice(air) = &mut setup.air else {
        unreachable!("the little fly has a lattice")
    };
    air.mirror = true;
    let half = fly(setup.clone()).pop().expect("records");
    // Both are solved to a corrector tolerance of 1e-8.
    assert!(
        distance(&whole, &half) < 1e-7,
        "{}",
        distance(&whole, &half)
    );
    let (p, e) = pose(&half);
    let sideways = [(p.y + 0.02) / SPAN, e.y, e.z];
    assert!(sideways.iter().all(|x| x.abs() < 1e-13), "{sideways:?}");

    setup.animal.wings[0].motion.angles.phi = sine(0.1, 0.9, 0.0);
    let error = Simulation::new(setup)
        .err()
        .expect("an asymmetric flight is refused")
        .to_string();
    assert!(error.contains("not mirror-symmetric"), "{error}");
}

#[test]
fn limit_massless_wings_are_approached_at_first_order_in_the_wing_mass() {
    let end = |wing_mass| {
        let fly_of = Fly {
            wing_mass,
            amplitudes: ASYMMETRIC,
            ..Fly::default()
        };
        fly(fly_of.setup(40, 1.0)).pop().expect("records")
    };
    let rigid = end(0.0);
    let [a, b] = [6e-9, 3e-9].map(|m| distance(&end(m), &rigid));
    let ratio = a / b;
    assert!(a > 1e-4, "wing inertia matters: {a}");
    assert!(
        (1.8..2.2).contains(&ratio),
        "first order halves the difference: {ratio}"
    );
}

#[test]
fn agrees_massless_wings_with_the_aircraft_equations() {
    // m v' = F + m g and J w' + w x J w = M, the standard aircraft equations, checked on the
    // recorded flight by central differences (second order in the step).
    let misfit = |steps: usize| {
        let setup = Fly {
            wing_mass: 0.0,
            ..Fly::default()
        }
        .forward(steps, 1.0);
        let (body, h) = (setup.animal.body, setup.time.step);
        let weight = body.mass * 9.81;
        let records = fly(setup);
        let centre_velocity = |r: &Record| r.momentum / body.mass;
        // Second half: after the sudden start into the stream the lift changes without bound.
        records[steps / 2..]
            .windows(3)
            .map(|w| {
                let a = (centre_velocity(&w[2]) - centre_velocity(&w[0])) / (2.0 * h);
                let force: DVec3 = w[1].air.iter().map(|l| l.force).sum();
                let newton = (a - DVec3::Z * 9.81) * body.mass - force;
                let alpha = (w[2].root_angular_velocity - w[0].root_angular_velocity) / (2.0 * h);
                let spin = w[1].root_angular_velocity;
                let j = body.inertia_about_centre();
                let euler =
                    j * alpha + spin.cross(j * spin) - moment_about_centre(&w[1], body.centre());
                (newton.length() / weight).max(euler.length() / (weight * SPAN))
            })
            .fold(0.0, f64::max)
    };
    let [coarse, fine] = [misfit(40), misfit(80)];
    assert!(fine < 0.02, "{coarse} {fine}");
    assert!(coarse / fine > 3.0, "second order: {coarse} {fine}");
}

/// Moment of all air loads about the mass centre of the body, body components [N m].
fn moment_about_centre(r: &Record, centre: DVec3) -> DVec3 {
    let q = r.root_quaternion;
    let rotation =
        wingbeat_math::DMat3::from_quat(wingbeat_math::DQuat::from_xyzw(q[1], q[2], q[3], q[0]));
    let c = pose(r).0 + rotation * centre;
    let moment: DVec3 = r
        .air
        .iter()
        .enumerate()
        .map(|(i, l)| {
            let p = DVec3::from_slice(&r.coordinates[6 * i..]);
            l.moment + (p - c).cross(l.force)
        })
        .sum();
    rotation.transpose() * moment
}

#[test]
fn agrees_euler_form_with_momentum_form_in_coupled_flight() {
    // The Euler form with a step-tied Baumgarte is of second order, its gap to the momentum form
    // falls by four when the step is halved.
    let gap = |steps: usize| {
        let with = |formulation| {
            let setup = Fly {
                amplitudes: ASYMMETRIC,
                ..Fly::default()
            }
            .setup(steps, 1.0);
            fly(FlightSetup {
                formulation,
                ..setup
            })
            .pop()
            .expect("records")
        };
        let euler = with(FormulationChoice::Euler(BaumgarteChoice::StepTied(0.1)));
        distance(&euler, &with(FormulationChoice::Momentum))
    };
    let [coarse, fine] = [gap(40), gap(80)];
    assert!(fine < 1e-4, "{coarse} {fine}");
    assert!(coarse / fine > 3.0, "{coarse} {fine}");
}

/// A resumed flight shows what the flight it goes on from does, but for the pressure.
fn agrees_before_its_first_step(resumed: &Simulation, from: &Simulation) {
    assert_eq!(resumed.root(), from.root());
    let (a, b) = (resumed.snapshot(), from.snapshot());
    assert_eq!((a.step, a.time, &a.wakes), (b.step, b.time, &b.wakes));
    assert!(a.surfaces.len() == b.surfaces.len() && !a.surfaces.is_empty());
    for (a, b) in a.surfaces.iter().zip(&b.surfaces) {
        assert_eq!((&a.nodes, &a.quads), (&b.nodes, &b.quads));
        assert_eq!(a.circulation, b.circulation);
        assert_eq!(a.pressure_jump.len(), b.pressure_jump.len());
        assert!(a.pressure_jump.iter().all(|p| p.is_nan()));
    }
}

#[test]
fn invariant_resumed_flight_goes_on_bit_for_bit() {
    let setup = || {
        let mut s = Fly {
            amplitudes: ASYMMETRIC,
            ..Fly::default()
        }
        .setup(20, 1.0);
        if let MotionMode::Free(start) = &mut s.mode {
            start.held_steps = 6;
        }
        s
    };
    let whole = fly(setup());
    for stop in [2, 6, 8, 13] {
        let mut sim = Simulation::new(setup()).expect("a flight");
        for _ in 0..stop {
            sim.step().expect("a step");
        }
        let mut resumed =
            Simulation::resume(setup(), sim.state().clone()).expect("a resumed flight");
        agrees_before_its_first_step(&resumed, &sim);
        let mut branch = sim.branch().expect("a second flight");
        assert_eq!(branch.record(), sim.record());
        assert_eq!(branch.snapshot(), sim.snapshot());
        for expected in &whole[stop + 1..] {
            assert_eq!(resumed.step().expect("a step"), expected);
            assert_eq!(branch.step().expect("a step"), expected);
        }
    }
}

#[test]
fn refuses_states_that_do_not_fit() {
    let setup = || Fly::default().setup(20, 0.5);
    let mut sim = Simulation::new(setup()).expect("a flight");
    for _ in 0..4 {
        sim.step().expect("a step");
    }
    let damages: [fn(&mut FlightState); 9] = [
        |s| s.stage = 7,
        |s| s.step = usize::MAX,
        |s| s.started_at = s.step + 1,
        |s| s.past.y[2].clear(),
        |s| s.past.predicted_minus_corrected.clear(),
        |s| s.ledger.coordinates.clear(),
        |s| {
            s.ledger.events[1] = 1 + s
                .air
                .as_ref()
                .and_then(AirMemory::wakes)
                .map_or(0, |a| a.events.limited)
        },
        |s| s.air = None,
        |s| {
            let wakes = s.air.as_mut().and_then(AirMemory::wakes_mut);
            wakes.into_iter().for_each(|a| a.sheets[0].nodes.y.clear());
        },
    ];
    for (k, damage) in damages.iter().enumerate() {
        let mut state = sim.state().clone();
        damage(&mut state);
        let resumed = Simulation::resume(setup(), state);
        assert!(resumed.is_err(), "damage {k} was not noticed");
    }
    let mut vacuum = setup();
    vacuum.air = AirModel::None;
    let mut state = Simulation::new(vacuum.clone())
        .expect("a flight")
        .state()
        .clone();
    state.ledger.events = [1, 0];
    assert!(
        Simulation::resume(vacuum, state).is_err(),
        "events without air"
    );
}

#[test]
fn invariant_held_start_does_not_move_and_the_release_is_smooth() {
    let mut setup = Fly::default().setup(40, 1.5);
    if let MotionMode::Free(start) = &mut setup.mode {
        start.held_steps = 40;
    }
    let records = fly(setup);
    assert!(
        records[..=40]
            .iter()
            .all(|r| distance(r, &records[0]) < 1e-12)
    );
    assert!(records[20].tether.force.length() > 0.0 && records[41].tether.force.length() == 0.0);
    let fallen = |k: usize| distance(&records[k], &records[0]);
    assert!(fallen(41) < 1e-3 && fallen(60) > 10.0 * fallen(41));
    // Books stay open across the release.
    assert!(residuals(&records, 0.96e-6 * 9.81)[0] < 5e-3);
}

#[test]
fn balances_go_on_where_a_held_body_is_released_into_a_turn() {
    let residuals = |spin: f64| {
        let mut setup = Fly::default().setup(80, 1.0);
        setup.air = AirModel::None;
        if let MotionMode::Free(start) = &mut setup.mode {
            start.held_steps = 40;
            start.angular_velocity = spin * DVec3::new(30.0, 200.0, -50.0);
        }
        let records = fly(setup);
        let open = |r: &Record| {
            let scale = records[80].kinetic_energy;
            let turn = records[80].angular_momentum.length();
            [
                r.energy_residual.abs() / scale,
                r.momentum_residual.length() / records[80].momentum.length(),
                r.angular_momentum_residual.length() / turn,
            ]
        };
        // The jump itself, and the flight after it.
        let jumped = (records[40].kinetic_energy - records[39].kinetic_energy).abs();
        assert!(spin == 0.0 || jumped > 1e-2 * records[80].kinetic_energy);
        [open(&records[40]), open(&records[80])]
    };
    let [smooth, turning] = [0.0, 1.0].map(residuals);
    for (a, b) in smooth.iter().flatten().zip(turning.iter().flatten()) {
        // As much as is missing without the jump: the error of the quadratures.
        assert!(*b < 3.0 * a.max(1e-4), "{smooth:?} {turning:?}");
    }
}

#[test]
fn exact_ballistic_flight_without_air_and_wing_mass() {
    let mut setup = Fly {
        wing_mass: 0.0,
        ..Fly::default()
    }
    .setup(20, 2.0);
    setup.air = AirModel::None;
    let v0 = DVec3::new(0.3, -0.2, -0.5);
    if let MotionMode::Free(start) = &mut setup.mode {
        start.velocity = v0;
    }
    let start = pose(&fly(setup.clone())[0]).0;
    let last = fly(setup).pop().expect("records");
    let t = last.time;
    let parabola = start + v0 * t + DVec3::Z * (0.5 * 9.81 * t * t);
    // Polynomials of degree two are exact for the method: only round-off is left.
    assert!((pose(&last).0 - parabola).length() < 1e-13 * 0.05);
}

#[test]
fn exact_applied_force_equal_to_the_weight_holds_the_body() {
    let mut setup = Fly {
        wing_mass: 0.0,
        ..Fly::default()
    }
    .setup(20, 2.0);
    setup.air = AirModel::None;
    let (mass, centre) = (setup.animal.mass(), setup.animal.body.centre());
    let zero = || DriftingFourier::constant(0.0);
    setup.loads = vec![AppliedLoad {
        body: 0,
        frame: LoadFrame::Inertial,
        point: centre,
        force: [zero(), zero(), DriftingFourier::constant(-mass * 9.81)],
        couple: [zero(), zero(), zero()],
    }];
    let records = fly(setup);
    assert!(largest(&records, |r| distance(r, &records[0])) < 1e-13);
}

#[test]
fn exact_corrector_that_cannot_converge_says_so() {
    let mut setup = Fly::default().setup(20, 1.0);
    setup.corrector = CorrectorSettings {
        tolerance: 1e-30,
        max_passes: 2,
        relaxation: 1.0,
    };
    let error = Simulation::new(setup).err().expect("an error").to_string();
    for word in [
        "did not agree",
        "2 corrector passes",
        "allowed 1.00e-30",
        "smaller step",
    ] {
        assert!(error.contains(word), "{error}");
    }
}
