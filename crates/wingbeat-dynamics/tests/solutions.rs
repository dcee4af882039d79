//! Solutions of the seed's equations at one instant against the independent Newton-Euler sums of the momentum
//! form, and the saddle-point matrix itself.

use crate::common;

use common::saddle::Saddle;
use common::*;
use wingbeat_dynamics::euler::{BodyKinematics, Condensed, kinematics};
use wingbeat_dynamics::{
    Baumgarte, BodyAcceleration, BodyMotion, Configuration, EulerForm, Formulation, MomentumForm,
    Solution, System, Wrench,
};
use wingbeat_math::{DVec3, solve_small};

/// The asymmetric fly in flight at time t, with loads: state and both solutions.
fn both_solutions(t: f64, system: &System) -> (Vec<f64>, Solution, Solution) {
    let (m, e) = (
        MomentumForm::new(system.clone()),
        EulerForm::new(system.clone(), Baumgarte::OFF),
    );
    let (ym, ye) = (
        m.initial(t, &start()).unwrap(),
        e.initial(t, &start()).unwrap(),
    );
    let a = Flight::new(&m, applied).solve(t, &ym).unwrap().clone();
    let b = Flight::new(&e, applied).solve(t, &ye).unwrap().clone();
    (ye, a, b)
}

/// q'' from accelerations.
fn second_rates(bodies: &[BodyKinematics], acc: &[BodyAcceleration]) -> Vec<f64> {
    let mut out = vec![];
    for (k, a) in bodies.iter().zip(acc) {
        let eta = k.g.inverse() * (a.angular - k.g_dot * k.eta_dot);
        out.extend(a.linear.to_array());
        out.extend(eta.to_array());
    }
    out
}

#[test]
fn agrees_momentum_form_fulfils_the_seeds_thirty_equations() {
    // seed eq. 12, 21, 22, 28, 30: 18 equations of motion and 12 of constraint, with the momentum
    // form's accelerations and multipliers put in, in natural units.
    let system = fly(GRAVITY);
    let mut worst: f64 = 0.0;
    for t in [0.0, 0.31 * BEAT, 0.77 * BEAT] {
        let (y, m, _) = both_solutions(t, &system);
        let (q, qd) = y.split_at(18);
        let (bodies, hinges) = kinematics(&system, t, q, qd);
        let motions: Vec<BodyMotion> = bodies.iter().map(|k| k.motion).collect();
        let mut loads = vec![Wrench::default(); 3];
        applied(t, &motions, &mut loads);
        let mut saddle = Saddle::new(&system);
        saddle.assemble(&system, &bodies, &hinges, &loads, Baumgarte::OFF);
        let mut x = second_rates(&bodies, &m.bodies);
        x.extend(&m.multipliers);
        worst = worst.max(saddle_residual(&saddle, &x));
    }
    println!("largest residual of the seed's equations {worst:.1e}");
    assert!(worst < 1e-11); // rounding of 1e-16 times forces 1000 times the body's weight
}

#[test]
fn agrees_condensed_solution_with_the_saddle_point_matrix() {
    // Inconsistent rates and coordinates too: the stabilization terms must agree as well.
    for system in [fly(GRAVITY), chain(GRAVITY)] {
        let n = 6 * system.bodies().len();
        let form = EulerForm::new(system.clone(), Baumgarte::OFF);
        let mut y = form.initial(0.31 * BEAT, &start()).unwrap();
        for (i, y) in y.iter_mut().enumerate() {
            let length = if i % 6 < 3 { LENGTH } else { 1.0 };
            let time = if i < n { 1.0 } else { BEAT };
            *y += 1e-3 * length / time * (3.0 * i as f64).sin();
        }
        let (bodies, hinges) = kinematics(&system, 0.31 * BEAT, &y[..n], &y[n..]);
        let motions: Vec<BodyMotion> = bodies.iter().map(|k| k.motion).collect();
        let mut loads = vec![Wrench::default(); motions.len()];
        applied(0.31 * BEAT, &motions, &mut loads);
        let b = Baumgarte::for_step(BEAT / 80.0);
        let mut saddle = Saddle::new(&system);
        saddle.assemble(&system, &bodies, &hinges, &loads, b);
        saddle.solve().unwrap();
        let mut condensed = Condensed::new(&system);
        condensed
            .solve(&system, &bodies, &hinges, &loads, b)
            .unwrap();
        // Norms of positions, angles, forces and moments apart: each triple by its own size.
        let close = |a: &[f64], b: &[f64]| {
            let (a, b) = (DVec3::from_slice(a), DVec3::from_slice(b));
            (a - b).length() / b.length()
        };
        let x = condensed
            .accelerations()
            .chunks(3)
            .zip(saddle.accelerations().chunks(3));
        let l = condensed
            .multipliers()
            .chunks(3)
            .zip(saddle.multipliers().chunks(3));
        let worst = x.chain(l).map(|(a, b)| close(a, b)).fold(0.0, f64::max);
        println!("condensed against saddle: {worst:.1e}");
        assert!(worst < 1e-11); // rounding times condition numbers of order 100
    }
}

/// Largest residual of eq. 30: rows of motion by body mass, wing length and beat, rows of
/// constraint by wing length and beat.
fn saddle_residual(saddle: &Saddle, x: &[f64]) -> f64 {
    let (force, acceleration) = (BODY_MASS * LENGTH / (BEAT * BEAT), LENGTH / (BEAT * BEAT));
    let mut worst: f64 = 0.0;
    for i in 0..30 {
        let unit = match i {
            0..18 if i % 6 < 3 => force,
            0..18 => force * LENGTH,
            18..24 => acceleration,
            _ => 1.0 / (BEAT * BEAT),
        };
        let row = &saddle.matrix()[30 * i..30 * (i + 1)];
        let lhs: f64 = row.iter().zip(x).map(|(a, b)| a * b).sum();
        worst = worst.max((lhs - saddle.right_side()[i]).abs() / unit);
    }
    worst
}

#[test]
fn agrees_solutions_of_both_forms_pointwise() {
    // Accelerations, reactions, multipliers, powers and budgets; two independent derivations, for
    // the fly and for a chain whose bodies hang beside their origins.
    for system in [fly(GRAVITY), chain(GRAVITY)] {
        for t in [0.0, 0.31 * BEAT, 0.77 * BEAT] {
            let (_, m, e) = both_solutions(t, &system);
            same_accelerations(&m, &e);
            same_reactions(&m, &e);
            same_budgets(&m, &e);
            assert!(e.violation.position < 1e-12 * LENGTH && e.violation.orientation < 1e-12);
        }
    }
}

/// Rounding times the condition number of the scaled saddle, about ten, in natural units.
const POINTWISE: f64 = 1e-11;

/// Natural unit of force [N].
const FORCE: f64 = BODY_MASS * LENGTH / (BEAT * BEAT);

fn same_vector(a: DVec3, b: DVec3, unit: f64) {
    assert!((a - b).length() < POINTWISE * unit, "{a} {b} {unit}");
}

/// Wings accelerate by a hundred natural units and more.
fn same_accelerations(m: &Solution, e: &Solution) {
    for (a, b) in m.bodies.iter().zip(&e.bodies) {
        same_vector(a.linear, b.linear, 100.0 * LENGTH / (BEAT * BEAT));
        same_vector(a.angular, b.angular, 100.0 / (BEAT * BEAT));
    }
}

fn same_reactions(m: &Solution, e: &Solution) {
    for (a, b) in m.hinges.iter().zip(&e.hinges) {
        same_vector(a.force, b.force, FORCE);
        same_vector(a.moment, b.moment, FORCE * LENGTH);
        assert!((a.power - b.power).abs() < POINTWISE * 100.0 * FORCE * LENGTH / BEAT);
        assert!(a.moment.length() > 1e-4 * FORCE * LENGTH); // there is something to compare
    }
    for (i, (a, b)) in m.multipliers.iter().zip(&e.multipliers).enumerate() {
        let unit = if i < 3 * m.hinges.len() {
            FORCE
        } else {
            FORCE * LENGTH
        };
        assert!((a - b).abs() < POINTWISE * unit);
    }
}

fn same_budgets(m: &Solution, e: &Solution) {
    same_vector(
        m.budget.momentum,
        e.budget.momentum,
        BODY_MASS * LENGTH / BEAT,
    );
    same_vector(
        m.budget.angular_momentum,
        e.budget.angular_momentum,
        FORCE * LENGTH * BEAT,
    );
    assert!((m.budget.kinetic / e.budget.kinetic - 1.0).abs() < POINTWISE);
    assert!((m.load_power - e.load_power).abs() < POINTWISE * FORCE * LENGTH / BEAT);
}

#[test]
fn agrees_configuration_of_a_chain_with_time_differences() {
    // Velocities and accelerations of every body of the chain (transport, Coriolis and relative
    // parts) against differences of positions and velocities along a motion of the root.
    let system = chain(GRAVITY);
    let root = |t: f64| {
        let [q, qd, qdd] = motion(0.7, t);
        let k = BodyKinematics::new(&system.bodies()[0], &q, &qd);
        let angular = k.g * DVec3::from_slice(&qdd[3..]) + k.g_dot * k.eta_dot;
        let linear = DVec3::from_slice(&qdd);
        (k.motion, BodyAcceleration { linear, angular })
    };
    // The root moves on the scale one, the wings at 2 pi / BEAT.
    let at = |t: f64| {
        let mut configuration = Configuration::new(&system);
        configuration.update(&system, 0.2 * BEAT + t);
        let (motion, acceleration) = root(0.1 + t);
        let mut m = vec![BodyMotion::REST; 4];
        let mut a = vec![BodyAcceleration::default(); 4];
        configuration.motions(&motion, &mut m);
        configuration.accelerations(&motion, &acceleration, &mut a);
        (m, a)
    };
    let (m, a) = at(0.0);
    let h = 1e-3 * BEAT;
    for i in 0..4 {
        let (v, w) = (
            derivative(|t| at(t).0[i].p, h),
            derivative(|t| at(t).0[i].w, h),
        );
        let dv = derivative(|t| at(t).0[i].v, h);
        let turning = m[i].r.transpose() * derivative(|t| at(t).0[i].r, h);
        // Fourth-order differences at a thousandth of a beat, (2 pi / 1000)^4 = 2e-9, of the
        // natural velocities (0.5 m/s and 200 rad/s, squared over length for accelerations).
        assert!((m[i].v - v).length() < 1e-7 * LENGTH / BEAT);
        assert!((m[i].w - wingbeat_math::untilde(turning)).length() < 1e-7 / BEAT);
        assert!((a[i].linear - dv).length() < 1e-6 * LENGTH / (BEAT * BEAT));
        assert!((a[i].angular - w).length() < 1e-6 / (BEAT * BEAT));
    }
}

#[test]
fn exact_multipliers_are_reactions_in_the_seeds_order() {
    // Hinge force = -(l1, l2, l3); hinge moment in wing components = -(l8, l9, l7); right wing
    // 4-6 and 11, 12, 10: read here from the Euler form, whose reactions are computed from B_q.
    let (_, _, e) = both_solutions(0.2 * BEAT, &fly(GRAVITY));
    let l = |i: usize| e.multipliers[i - 1];
    let pairs = [
        (e.hinges[0].force, DVec3::new(l(1), l(2), l(3))),
        (e.hinges[1].force, DVec3::new(l(4), l(5), l(6))),
        (e.hinges[0].moment, DVec3::new(l(8), l(9), l(7))),
        (e.hinges[1].moment, DVec3::new(l(11), l(12), l(10))),
    ];
    for (reaction, multipliers) in pairs {
        // The relative rotation is the identity to 1e-15.
        assert!((reaction + multipliers).length() < 1e-13 * reaction.length());
    }
}

#[test]
fn exact_baumgarte_zero_leaves_no_constraint_acceleration() {
    // seed eq. 28 and 29: Phi'' + 2 alpha Phi' + beta^2 Phi = 0 in a state with drift.
    let system = fly(GRAVITY);
    let (alpha, beta) = (300.0, 500.0);
    for b in [Baumgarte::OFF, Baumgarte { alpha, beta }] {
        let form = EulerForm::new(system.clone(), b);
        let mut y = form.initial(0.1 * BEAT, &start()).unwrap();
        for (i, y) in y.iter_mut().enumerate() {
            *y *= 1.0 + 1e-3 * (i as f64).sin(); // drift of a thousandth
        }
        let e = Flight::new(&form, none)
            .solve(0.1 * BEAT, &y)
            .unwrap()
            .clone();
        let (bodies, hinges) = kinematics(&system, 0.1 * BEAT, &y[..18], &y[18..]);
        let q2 = second_rates(&bodies, &e.bodies);
        let v = |i: usize| DVec3::from_slice(&q2[i..]);
        for (k, h) in hinges.iter().enumerate() {
            let j = h.orientation_jacobian();
            let second = j.parent * v(3) + j.child * v(6 * k + 9) + h.orientation_bias();
            let rest =
                second + 2.0 * b.alpha * h.orientation_rate() + b.beta * b.beta * h.orientation();
            assert!(rest.length() < 1e-11 / (BEAT * BEAT)); // rounding in natural units
            assert!(h.orientation().length() > 1e-5); // there is drift
        }
    }
}

#[test]
fn exact_saddle_is_well_conditioned_and_regular_without_wing_mass() {
    for (wing, limit) in [(WING_MASS, 30.0), (1e-3 * WING_MASS, 100.0), (0.0, 100.0)] {
        let system = fly_with(CENTRE, wing, Flapping::left(), Flapping::right(), GRAVITY);
        let form = EulerForm::new(system.clone(), Baumgarte::OFF);
        let y = form.initial(0.1 * BEAT, &start()).unwrap();
        let (bodies, hinges) = kinematics(&system, 0.1 * BEAT, &y[..18], &y[18..]);
        let mut saddle = Saddle::new(&system);
        let loads = vec![Wrench::default(); 3];
        saddle.assemble(&system, &bodies, &hinges, &loads, Baumgarte::OFF);
        let raw = condition(saddle.matrix());
        saddle.equilibrate();
        let scaled = condition(saddle.matrix());
        println!("wing mass {wing:.1e} kg: condition {raw:.1e} raw, {scaled:.1e} scaled");
        assert!(scaled < limit); // the 1-norm condition is up to 30 times the 2-norm one
        assert!(raw > 1e8);
        let (a, b) = (
            both_solutions(0.1 * BEAT, &system).1,
            both_solutions(0.1 * BEAT, &system).2,
        );
        let unit = 100.0 * LENGTH / (BEAT * BEAT);
        assert!((a.bodies[2].linear - b.bodies[2].linear).length() < 1e-10 * unit); // condition x rounding
    }
}

/// Condition number in the 1-norm, by the explicit inverse.
fn condition(a: &[f64]) -> f64 {
    let n = a.len().isqrt();
    let norm = |column: &dyn Fn(usize, usize) -> f64| {
        (0..n).fold(0.0, |m: f64, j| {
            m.max((0..n).map(|i| column(i, j).abs()).sum())
        })
    };
    let inverse: Vec<Vec<f64>> = (0..n)
        .map(|j| {
            let mut unit = vec![0.0; n];
            unit[j] = 1.0;
            solve_small(&mut a.to_vec(), &mut unit).unwrap();
            unit
        })
        .collect();
    norm(&|i, j| a[i * n + j]) * norm(&|i, j| inverse[j][i])
}
