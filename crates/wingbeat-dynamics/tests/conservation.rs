//! Whole flights: momenta, energy and work, drift of constraints, symmetries, closed solutions.

use crate::common;

use common::*;
use wingbeat_dynamics::euler::{consistent_coordinates, consistent_rates};
use wingbeat_dynamics::{
    Baumgarte, Body, BodyMotion, DynamicsError, EulerForm, Formulation, MomentumForm, Solution,
    System, Wrench,
};
use wingbeat_math::ode::Rk4;
use wingbeat_math::{DMat3, DVec3, EulerSequence, MassProperties, r1, r2, r3, solve_small};

/// Nodes of the quadrature below.
const NODES: usize = 14;

/// Integrals from node 0 to every node of equidistant samples, by the polynomial through the
/// [`NODES`] nearest nodes: of so high an order that its error is below the flight's.
fn cumulative_integral(f: &[f64], h: f64) -> Vec<f64> {
    let mut sum = vec![0.0];
    for n in 0..f.len() - 1 {
        let first = n.saturating_sub(NODES / 2 - 1).min(f.len() - NODES);
        let weights = interval_weights((n - first) as f64);
        let part: f64 = weights.iter().zip(&f[first..]).map(|(w, f)| w * f).sum();
        sum.push(sum[n] + h * part);
    }
    sum
}

/// Weights of the nodes for the integral from node `a` to the next, exact for polynomials of
/// degree below [`NODES`]; moments about the middle in units of half the width.
fn interval_weights(a: f64) -> [f64; NODES] {
    let half = 0.5 * (NODES - 1) as f64;
    let at = |x: f64| (x - half) / half;
    let mut matrix = [0.0; NODES * NODES];
    let mut moments = [0.0; NODES];
    for p in 0..NODES {
        for j in 0..NODES {
            matrix[NODES * p + j] = at(j as f64).powi(p as i32);
        }
        let primitive = |x: f64| half * at(x).powi(p as i32 + 1) / (p + 1) as f64;
        moments[p] = primitive(a + 1.0) - primitive(a);
    }
    solve_small(&mut matrix, &mut moments).unwrap();
    moments
}

/// Largest residual of `E - E(0) = work of hinges and loads` over a flight, relative to the
/// largest kinetic energy. Runge-Kutta flies; the work is integrated from the powers at the
/// nodes at high order, so that what is left is the flight's own error.
fn energy_residual(
    form: &dyn Formulation,
    start: &BodyMotion,
    loads: Loads,
    per_beat: usize,
    beats: usize,
) -> f64 {
    let mut flight = Flight::new(form, loads);
    let mut y = form.initial(0.0, start).unwrap();
    let (mut energy, mut power, mut peak) = (vec![], vec![], 0.0_f64);
    let mut note = |s: &Solution| {
        energy.push(s.energy());
        power.push(s.hinge_power() + s.load_power);
        peak = peak.max(s.budget.kinetic);
    };
    note(flight.solve(0.0, &y).unwrap());
    let h = BEAT / per_beat as f64;
    flight
        .fly(h, per_beat * beats, &mut y, |f, _, t, y| {
            note(f.solve(t, y).unwrap())
        })
        .unwrap();
    let work = cumulative_integral(&power, h);
    let gap = |(e, w): (&f64, &f64)| (e - energy[0] - w).abs();
    energy.iter().zip(&work).map(gap).fold(0.0, f64::max) / peak
}

#[test]
fn conserves_momenta_in_vacuum_over_ten_beats() {
    // Momenta recomputed from the motions of the three bodies, not read from the state.
    let form = MomentumForm::new(fly(DVec3::ZERO));
    let mut flight = Flight::new(&form, none);
    let mut y = form.initial(0.0, &start()).unwrap();
    let first = flight.solve(0.0, &y).unwrap().budget;
    let (mut p, mut h): (f64, f64) = (0.0, 0.0);
    flight
        .fly(BEAT / 80.0, 800, &mut y, |f, _, t, y| {
            let b = f.solve(t, y).unwrap().budget;
            p = p.max((b.momentum - first.momentum).length() / first.momentum.length());
            let change = b.angular_momentum - first.angular_momentum;
            h = h.max(change.length() / first.angular_momentum.length());
        })
        .unwrap();
    println!("ten beats in vacuum: linear momentum {p:.1e}, angular momentum {h:.1e} (relative)");
    assert!(p < 1e-12 && h < 1e-12); // rounding in the sums over the bodies
    assert!(p.max(h) > 0.0 || flight.solution.budget != first); // something moved
}

#[test]
fn balances_energy_and_hinge_work_in_vacuum() {
    let form = MomentumForm::new(fly(DVec3::ZERO));
    for start in [start(), BodyMotion::REST] {
        let r = energy_residual(&form, &start, none, 80, 10);
        println!("energy less hinge work, 80 steps per beat, 10 beats: {r:.1e}");
        assert!(r < 1e-10); // acceptance limit; what is left is the quadrature's error
    }
}

#[test]
fn conserves_momenta_and_balances_energy_of_a_chain_in_vacuum() {
    let form = MomentumForm::new(chain(DVec3::ZERO));
    let r = energy_residual(&form, &start(), none, 80, 4);
    println!("chain of four bodies: energy less hinge work {r:.1e}");
    assert!(r < 1e-10); // as for the fly
    let mut flight = Flight::new(&form, none);
    let mut y = form.initial(0.0, &start()).unwrap();
    let first = flight.solve(0.0, &y).unwrap().budget;
    flight
        .fly(BEAT / 80.0, 160, &mut y, |_, _, _, _| {})
        .unwrap();
    let last = flight.solve(2.0 * BEAT, &y).unwrap().budget;
    let change = (last.angular_momentum - first.angular_momentum).length();
    assert!(change < 1e-12 * first.angular_momentum.length()); // rounding
    assert!((last.momentum - first.momentum).length() < 1e-12 * first.momentum.length());
}

#[test]
fn balances_energy_and_all_work_under_gravity_and_loads() {
    let form = MomentumForm::new(fly(GRAVITY));
    let errors = [40, 80, 160].map(|n| energy_residual(&form, &start(), applied, n, 4));
    println!("energy residual with loads at 40, 80, 160 steps per beat: {errors:?}");
    assert!(errors[2] < 1e-8 && orders(&errors)[1] > 3.7); // Runge-Kutta of order four
}

/// Largest violations over a flight of the Euler form in vacuum, of a nearly symmetric fly: the
/// asymmetric one tumbles into the singularity of its wings' Euler angles within twenty beats.
fn violations(b: Baumgarte, per_beat: usize, beats: usize) -> (f64, f64) {
    let (right, gravity) = (Flapping::gentle(), DVec3::ZERO);
    let mut left = right.mirrored();
    left.angles[2].phase += 0.05;
    let form = EulerForm::new(fly_with(CENTRE, WING_MASS, left, right, gravity), b);
    let mut flight = Flight::new(&form, none);
    let mut y = form.initial(0.0, &BodyMotion::REST).unwrap();
    let (mut x, mut angle): (f64, f64) = (0.0, 0.0);
    let each = |f: &mut Flight, _: usize, t: f64, y: &[f64]| {
        let v = f.solve(t, y).unwrap().violation;
        x = x.max(v.position / LENGTH);
        angle = angle.max(v.orientation);
    };
    flight
        .fly(BEAT / per_beat as f64, per_beat * beats, &mut y, each)
        .unwrap();
    (x, angle)
}

#[test]
fn balances_constraints_of_the_seeds_form_over_two_hundred_beats() {
    let (x, angle) = violations(Baumgarte::for_step(BEAT / 80.0), 80, 200);
    println!("200 beats, default Baumgarte: violation {x:.1e} wing lengths, {angle:.1e} rad");
    assert!(x < 1e-5 && angle < 1e-5); // the acceptance limit
    let (free, _) = violations(Baumgarte::OFF, 80, 20);
    println!("20 beats without stabilization: {free:.1e} wing lengths");
}

#[test]
fn balances_states_made_consistent_have_no_violation() {
    let system = fly(GRAVITY);
    let form = EulerForm::new(system.clone(), Baumgarte::OFF);
    let mut flight = Flight::new(&form, applied);
    let mut y = form.initial(0.0, &start()).unwrap();
    let (mut rk4, h) = (Rk4::new(y.len()), BEAT / 80.0);
    for n in 0..160 {
        rk4.advance(n as f64 * h, h, &mut y, |t, y, dy| flight.rates(t, y, dy))
            .unwrap();
        let t = (n + 1) as f64 * h;
        let (q, qd) = y.split_at_mut(form.coordinates());
        consistent_coordinates(&system, t, q).unwrap();
        consistent_rates(&system, t, q, qd).unwrap();
        let v = flight.solve(t, &y).unwrap().violation;
        // Newton's tolerance is 1e-12; one more quadratic step usually brings it to rounding.
        assert!(
            v.position < 2e-12 * LENGTH && v.orientation < 2e-12,
            "{v:?}"
        );
    }
}

fn single(mass: MassProperties, gravity: DVec3) -> System {
    let b: Body = body("top", mass, EulerSequence::BODY_231);
    System::new(vec![b], vec![], gravity, UNITS).unwrap()
}

/// Rotation about a vector by its length [rad].
fn about(v: DVec3) -> DMat3 {
    DMat3::from_axis_angle(v.normalize(), v.length())
}

#[test]
fn exact_symmetric_top_in_both_forms() {
    // w = H / A + (1 - C/A) w3 e3: the attitude is exp(H t / A) R0 exp((1 - C/A) w3 t e3).
    let (a, c) = (3e-13, 1e-13);
    let mass = MassProperties::about_centre(
        BODY_MASS,
        DVec3::ZERO,
        DMat3::from_diagonal(DVec3::new(a, a, c)),
    );
    let start = BodyMotion {
        r: r2(0.2) * r3(0.1) * r1(-0.2),
        w: DVec3::new(60.0, -20.0, 200.0),
        ..BodyMotion::REST
    };
    let h = start.r * (DVec3::new(a, a, c) * start.w);
    let end = 0.01;
    let exact =
        about(h * (end / a)) * start.r * about(DVec3::Z * ((1.0 - c / a) * start.w.z * end));
    let forms: [Box<dyn Formulation>; 2] = [
        Box::new(MomentumForm::new(single(mass, DVec3::ZERO))),
        Box::new(EulerForm::new(single(mass, DVec3::ZERO), Baumgarte::OFF)),
    ];
    for form in forms {
        let errors = [100, 200, 400].map(|n| {
            let m = end_of_flight(form.as_ref(), none, &start, end / n as f64, n);
            size(m.r - exact)
        });
        println!(
            "symmetric top: errors {errors:?}, orders {:.2?}",
            orders(&errors)
        );
        assert!(errors[2] < 1e-8 && orders(&errors)[1] > 3.8); // Runge-Kutta of order four
    }
}

#[test]
fn conserves_energy_and_momentum_of_a_tumbling_body() {
    // Torque-free motion about the unstable middle axis; order four in energy, exact in momentum.
    let inertia = DMat3::from_diagonal(DVec3::new(1e-13, 2e-13, 3e-13));
    let form = MomentumForm::new(single(
        MassProperties::about_centre(BODY_MASS, CENTRE, inertia),
        DVec3::ZERO,
    ));
    let start = BodyMotion {
        w: DVec3::new(5.0, 400.0, 10.0),
        ..start()
    };
    let mut flight = Flight::new(&form, none);
    let mut y = form.initial(0.0, &start).unwrap();
    let first = flight.solve(0.0, &y).unwrap().budget;
    flight.fly(1e-5, 5000, &mut y, |_, _, _, _| {}).unwrap();
    let last = flight.solve(0.05, &y).unwrap().budget;
    assert!((last.kinetic / first.kinetic - 1.0).abs() < 1e-10); // 20 turns at 1600 steps per turn
    let change = (last.angular_momentum - first.angular_momentum).length();
    assert!(change < 1e-13 * first.angular_momentum.length()); // rounding
}

#[test]
fn exact_mass_centre_of_a_flapping_fly_falls_on_a_parabola() {
    let (end, steps) = (4.0 * BEAT, 320);
    let forms: [Box<dyn Formulation>; 2] = [
        Box::new(MomentumForm::new(fly(GRAVITY))),
        Box::new(EulerForm::new(fly(GRAVITY), Baumgarte::OFF)),
    ];
    // The momentum form integrates the parabola exactly; the Euler form to its own order.
    for (form, tolerance) in forms.iter().zip([1e-12, 1e-4]) {
        let mut flight = Flight::new(form.as_ref(), none);
        let mut y = form.initial(0.0, &start()).unwrap();
        let first = flight.solve(0.0, &y).unwrap().budget;
        flight
            .fly(end / steps as f64, steps, &mut y, |_, _, _, _| {})
            .unwrap();
        let last = flight.solve(end, &y).unwrap().budget;
        let velocity = first.momentum / form.system().total_mass();
        let parabola = first.centre + velocity * end + GRAVITY * (0.5 * end * end);
        let error = (last.centre - parabola).length() / LENGTH;
        println!("distance from the parabola {error:.1e} wing lengths");
        assert!(error < tolerance);
    }
}

/// Mirror image in the 1-3 plane: polar vectors.
const MIRROR: DVec3 = DVec3::new(1.0, -1.0, 1.0);

#[test]
fn invariant_mirror_symmetric_flapping_stays_symmetric() {
    let centre = DVec3::new(CENTRE.x, 0.0, CENTRE.z);
    let right = Flapping::right();
    let system = fly_with(centre, WING_MASS, right.mirrored(), right, GRAVITY);
    let start = BodyMotion {
        r: EulerSequence::BODY_231.rotation(DVec3::new(0.3, 0.0, 0.0)),
        v: DVec3::new(0.2, 0.0, -0.1),
        w: DVec3::new(0.0, 5.0, 0.0),
        ..BodyMotion::REST
    };
    let forms: [Box<dyn Formulation>; 2] = [
        Box::new(MomentumForm::new(system.clone())),
        Box::new(EulerForm::new(system, Baumgarte::for_step(BEAT / 80.0))),
    ];
    for form in forms {
        let mut flight = Flight::new(form.as_ref(), none);
        let mut y = form.initial(0.0, &start).unwrap();
        flight
            .fly(BEAT / 80.0, 800, &mut y, |_, _, _, _| {})
            .unwrap();
        let m = flight.motions(10.0 * BEAT, &y).to_vec();
        let s = flight.solve(10.0 * BEAT, &y).unwrap();
        let axial = -MIRROR;
        println!(
            "symmetry: y {:.1e} m, roll and yaw {:.1e} rad/s",
            m[0].p.y,
            m[0].w.x.hypot(m[0].w.z)
        );
        // Rounding over 800 steps of a motion that is not unstable in roll and yaw.
        assert!(m[0].p.y.abs() < 1e-12 * LENGTH && m[0].w.x.hypot(m[0].w.z) < 1e-9);
        assert!((m[1].p - m[2].p * MIRROR).length() < 1e-11 * LENGTH);
        let (left, right) = (s.hinges[0], s.hinges[1]);
        assert!((left.force - right.force * MIRROR).length() < 1e-9 * right.force.length());
        assert!((left.moment - right.moment * axial).length() < 1e-9 * right.moment.length());
        assert!(size(m[0].r - start.r) > 0.1); // it does pitch
    }
}

#[test]
fn invariant_rotated_world_gives_the_rotated_flight() {
    // Gravity and start turned together: any axis of N is as good as n3.
    let turn = r1(0.7) * r2(-0.4) * r3(1.1);
    let s = start();
    let turned = BodyMotion {
        p: turn * s.p,
        r: turn * s.r,
        v: turn * s.v,
        w: s.w,
    };
    let fly_in = |gravity: DVec3, start: &BodyMotion| {
        let form = MomentumForm::new(fly(gravity));
        end_of_flight(&form, applied, start, BEAT / 80.0, 240)
    };
    let (a, b) = (fly_in(GRAVITY, &s), fly_in(turn * GRAVITY, &turned));
    assert!((turn * a.p - b.p).length() < 1e-12 * LENGTH.max(a.p.length())); // rounding over 240 steps
    assert!(size(turn * a.r - b.r) < 1e-12);
    assert!((turn * a.v - b.v).length() < 1e-12);
}

#[test]
fn invariant_moving_observer_sees_the_same_flight() {
    // Galilei: a constant velocity more changes nothing else.
    let (s, extra) = (start(), DVec3::new(1.0, -2.0, 0.5));
    let moving = BodyMotion {
        v: s.v + extra,
        ..s
    };
    let form = MomentumForm::new(fly(GRAVITY));
    let (h, n) = (BEAT / 80.0, 240);
    let (a, b) = (
        end_of_flight(&form, none, &s, h, n),
        end_of_flight(&form, none, &moving, h, n),
    );
    let shift = extra * (h * n as f64);
    assert!((a.p + shift - b.p).length() < 1e-13); // rounding of positions of centimetres
    assert!(size(a.r - b.r) < 1e-13);
}

#[test]
fn exact_singular_attitude_stops_the_euler_form_and_not_the_momentum_form() {
    // A stroke amplitude of 89 deg takes the wing's absolute middle angle to the singularity.
    let wide = Flapping::new([0.0, 89.5, 0.0], [0.0, 0.0, 0.0], [-90.0, 40.0, 1.4]);
    let system = fly_with(CENTRE, WING_MASS, Flapping::left(), wide, GRAVITY);
    let begin = BodyMotion { ..BodyMotion::REST };
    let euler = EulerForm::new(system.clone(), Baumgarte::for_step(BEAT / 80.0));
    let at_start = euler.initial(0.0, &begin);
    assert!(matches!(at_start, Err(DynamicsError::Singular { .. })));
    let t0 = 0.25 * BEAT; // mid-stroke: regular
    let mut y = euler.initial(t0, &begin).unwrap();
    let mut flight = Flight::new(&euler, none);
    let mut rk4 = Rk4::new(y.len());
    let failure = (0..80)
        .find_map(|n| {
            let t = t0 + f64::from(n) * BEAT / 80.0;
            rk4.advance(t, BEAT / 80.0, &mut y, |t, y, dy| flight.rates(t, y, dy))
                .err()
        })
        .unwrap();
    let text = failure.to_string();
    for part in [
        "`right wing`",
        "middle Euler angle",
        "|cos|",
        "momentum form",
        "t = ",
    ] {
        assert!(text.contains(part), "{text}");
    }
    let momentum = MomentumForm::new(system);
    let end = end_of_flight(&momentum, none, &begin, BEAT / 80.0, 160);
    assert!(end.p.is_finite() && end.r.is_finite());
    let upright = BodyMotion {
        r: r3(std::f64::consts::FRAC_PI_2), // the body's own singularity
        ..begin
    };
    let e = EulerForm::new(fly(GRAVITY), Baumgarte::OFF).initial(0.0, &upright);
    assert!(matches!(e, Err(DynamicsError::Singular { body, .. }) if body == "body"));
}

#[test]
fn exact_loads_on_a_free_body_accelerate_its_mass_centre() {
    let form = MomentumForm::new(fly(GRAVITY));
    let y = form.initial(0.0, &start()).unwrap();
    let mut loads = vec![Wrench::default(); 3];
    loads[1].force = DVec3::new(1e-5, -2e-5, 3e-5);
    let mut dy = vec![0.0; 13];
    form.rates(0.0, &y, &loads, &mut form.workspace(), &mut dy)
        .unwrap();
    let expected = loads[1].force + form.system().total_mass() * GRAVITY;
    assert!((DVec3::from_slice(&dy[7..]) - expected).length() < 1e-20); // rounding of 3e-5
}
