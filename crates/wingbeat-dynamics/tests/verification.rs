//! Pointwise verification: every term of the seed's equations against differences, sums over
//! points, and the independent Newton-Euler sums of the momentum form.

mod common;

use common::*;
use wingbeat_dynamics::budget;
use wingbeat_dynamics::euler::assembly::kinematics;
use wingbeat_dynamics::euler::condensed::Condensed;
use wingbeat_dynamics::euler::constraint::HingeKinematics;
use wingbeat_dynamics::euler::coordinates::BodyKinematics;
use wingbeat_dynamics::euler::saddle::Saddle;
use wingbeat_dynamics::euler::{forces, inertia};
use wingbeat_dynamics::inverse::weight_wrench;
use wingbeat_dynamics::posture::Posture;
use wingbeat_dynamics::{
    Baumgarte, Body, BodyAcceleration, BodyMotion, EulerForm, Formulation, Link, MomentumForm,
    RootMotion, Solution, System, Workspace, Wrench, tethered,
};
use wingbeat_math::{DVec3, EulerSequence, MassProperties, RotationLaw, solve_small};

const SEQUENCES: [EulerSequence; 2] = [EulerSequence::BODY_231, EulerSequence::WING_132];

/// Coordinates of order one that move as polynomials: q, q', q'' at time t, different for
/// different `seed`s.
fn motion(seed: f64, t: f64) -> [[f64; 6]; 3] {
    let c = |i: usize, k: f64| 0.4 * (seed + 1.7 * i as f64 + 2.3 * k).sin();
    let q = std::array::from_fn(|i| c(i, 0.0) + c(i, 1.0) * t + c(i, 2.0) * t * t);
    let qd = std::array::from_fn(|i| c(i, 1.0) + 2.0 * c(i, 2.0) * t);
    let qdd = std::array::from_fn(|i| 2.0 * c(i, 2.0));
    [q, qd, qdd]
}

/// A body made of a few points, in units of order one.
fn cloud() -> Vec<(f64, DVec3)> {
    (0..5)
        .map(|i| {
            let x = i as f64;
            let r = DVec3::new((1.3 * x).sin(), (2.1 * x + 1.0).cos(), (0.7 * x * x).sin());
            (0.5 + 0.2 * x, r)
        })
        .collect()
}

fn cloud_body(sequence: EulerSequence) -> Body {
    let mass = cloud()
        .iter()
        .map(|&(m, r)| MassProperties::point(m, r))
        .fold(MassProperties::ZERO, |a, b| a + b);
    body("cloud", mass, sequence)
}

/// Body kinematics along [`motion`].
fn along(body: &Body, seed: f64, t: f64) -> BodyKinematics {
    let [q, qd, _] = motion(seed, t);
    BodyKinematics::new(body, &q, &qd)
}

#[test]
fn exact_axes_of_every_frame_are_right_handed() {
    // seed eq. 1: [b1, b2, b3] = +1.
    for s in SEQUENCES {
        let r = along(&cloud_body(s), 0.3, 0.0).motion.r;
        assert!((r.x_axis.dot(r.y_axis.cross(r.z_axis)) - 1.0).abs() < 1e-15); // roundings
    }
}

#[test]
fn agrees_point_velocity_with_differences_of_point_position() {
    // seed eq. 3, 14, 15, 16.
    let r = DVec3::new(0.3, -0.7, 0.5);
    for s in SEQUENCES {
        let b = cloud_body(s);
        let v = derivative(|t| along(&b, 1.0, t).motion.point(r), 1e-3);
        // Fourth-order differences: h^4 = 1e-12, rounding 1e-16 / h = 1e-13.
        assert!((along(&b, 1.0, 0.0).motion.point_velocity(r) - v).length() < 1e-11);
    }
}

#[test]
fn exact_kinetic_energy_is_the_sum_over_points() {
    // seed eq. 13 against eq. 17-20 and the form without coordinates (eq. 23).
    for s in SEQUENCES {
        let b = cloud_body(s);
        let k = along(&b, 2.0, 0.2);
        let points = |(m, r): &(f64, DVec3)| 0.5 * m * k.motion.point_velocity(*r).length_squared();
        let sum: f64 = cloud().iter().map(points).sum();
        assert!((inertia::kinetic_energy(&b, &k) - sum).abs() < 1e-14 * sum.max(1.0)); // roundings
        assert!((budget::kinetic_energy(&b, &k.motion) - sum).abs() < 1e-14 * sum.max(1.0));
    }
}

#[test]
fn agrees_mass_matrix_rate_with_differences() {
    // seed eq. 25.
    for s in SEQUENCES {
        let b = cloud_body(s);
        let rate = inertia::mass_matrix_rate(&b, &along(&b, 0.5, 0.1));
        let at = |t: f64| inertia::mass_matrix(&b, &along(&b, 0.5, 0.1 + t));
        // Fourth-order differences of numbers of order ten.
        assert!(size(derivative(|t| at(t).r_eta, 1e-3) - rate.r_eta) < 1e-10);
        assert!(size(derivative(|t| at(t).eta_eta, 1e-3) - rate.eta_eta) < 1e-10);
    }
}

#[test]
fn agrees_quadratic_velocity_with_lagrange_differences() {
    // seed eq. 21, 24, 26: Q^v = -M' q' + dT/dq, both from differences of eq. 19 and eq. 20.
    for s in SEQUENCES {
        let b = cloud_body(s);
        let [q, qd, _] = motion(0.9, 0.0);
        let k = BodyKinematics::new(&b, &q, &qd);
        let momentum = |t: f64| {
            let at = |i: usize| q[i] + t * qd[i];
            let moved: [f64; 6] = std::array::from_fn(at);
            let k = BodyKinematics::new(&b, &moved, &qd);
            inertia::mass_matrix(&b, &k).times(k.motion.v, k.eta_dot)
        };
        let gradient = |i: usize| {
            derivative(
                |e| {
                    let mut q = q;
                    q[i] += e;
                    inertia::kinetic_energy(&b, &BodyKinematics::new(&b, &q, &qd))
                },
                1e-3,
            )
        };
        let [qr, qe] = inertia::quadratic_velocity(&b, &k);
        let dr = -derivative(|t| momentum(t)[0], 1e-3);
        let de = -derivative(|t| momentum(t)[1], 1e-3)
            + DVec3::new(gradient(3), gradient(4), gradient(5));
        // Fourth-order differences of numbers of order ten.
        assert!((qr - dr).length() < 1e-10 && (qe - de).length() < 1e-10);
        assert!(qe.length() > 0.1); // the term is there
    }
}

#[test]
fn agrees_generalized_forces_with_virtual_work() {
    // seed eq. 6-9: F . dr/dq by differences; and the wrench is the sum over points.
    let force = |i: usize| DVec3::new(1.0 + i as f64, -0.5, 0.3 * i as f64);
    for s in SEQUENCES {
        let b = cloud_body(s);
        let [q, qd, _] = motion(1.4, 0.0);
        let k = BodyKinematics::new(&b, &q, &qd);
        let (mut wrench, mut sum) = (Wrench::default(), [DVec3::ZERO; 2]);
        for (i, (_, r)) in cloud().into_iter().enumerate() {
            let work = |c: usize| {
                derivative(
                    |e| {
                        let mut q = q;
                        q[c] += e;
                        force(i).dot(BodyKinematics::new(&b, &q, &qd).motion.point(r))
                    },
                    1e-3,
                )
            };
            let part = forces::point_force(&k, r, force(i));
            // Fourth-order differences of numbers of order one.
            assert!((part[0] - DVec3::new(work(0), work(1), work(2))).length() < 1e-10);
            assert!((part[1] - DVec3::new(work(3), work(4), work(5))).length() < 1e-10);
            wrench += Wrench::at(force(i), k.motion.r * r);
            sum = [sum[0] + part[0], sum[1] + part[1]];
        }
        let whole = forces::generalized_wrench(&k, &wrench);
        assert!((whole[0] - sum[0]).length() + (whole[1] - sum[1]).length() < 1e-13); // roundings
    }
}

#[test]
fn exact_weight_is_the_sum_over_points() {
    // seed eq. 10 with the moment for every body.
    let b = cloud_body(SEQUENCES[0]);
    let m = along(&b, 0.2, 0.0).motion;
    let mut sum = Wrench::default();
    for (mass, r) in cloud() {
        sum += Wrench::at(mass * GRAVITY, m.r * r);
    }
    let w = weight_wrench(&b, &m, GRAVITY);
    // Roundings of numbers of order 50.
    assert!((w.force - sum.force).length() + (w.moment - sum.moment).length() < 1e-13);
}

/// A hinge with both anchors off the origins, whose law moves on the time scale one.
fn test_hinge() -> Link {
    #[derive(Debug)]
    struct Slow(Flapping);
    impl RotationLaw for Slow {
        fn at(&self, t: f64) -> wingbeat_math::MovingRotation {
            let m = self.0.at(t * BEAT);
            wingbeat_math::MovingRotation {
                c: m.c,
                w: m.w * BEAT,
                w_dot: m.w_dot * (BEAT * BEAT),
            }
        }
    }
    Link {
        anchor_child: DVec3::new(0.1, 0.4, -0.2),
        ..hinge("h", 1, DVec3::new(0.3, -0.5, 0.7), Slow(Flapping::left()))
    }
}

/// The hinge between two bodies that move on their own, constraints not fulfilled.
fn hinge_at(h: &Link, q: [&[f64]; 2], qd: [&[f64]; 2], t: f64) -> HingeKinematics {
    let parent = BodyKinematics::new(&cloud_body(SEQUENCES[0]), q[0], qd[0]);
    let child = BodyKinematics::new(&cloud_body(SEQUENCES[1]), q[1], qd[1]);
    HingeKinematics::new(h, &h.rotation(t), &parent, &child)
}

fn hinge_along(h: &Link, t: f64) -> HingeKinematics {
    let ([qa, da, _], [qb, db, _]) = (motion(0.4, t), motion(2.6, t));
    hinge_at(h, [&qa, &qb], [&da, &db], t)
}

#[test]
fn agrees_constraint_rates_with_time_differences() {
    // seed eq. 4, 27: first and second total time derivatives of Phi along a motion; B_q q'' is
    // added to the bias from the Jacobian.
    let h = test_hinge();
    let k = hinge_along(&h, 0.0);
    // Fourth-order differences; the law turns at 2 pi per unit time: (2 pi h)^4 h ~ 1e-10 of
    // derivatives of order (2 pi)^2.
    let close = |a: DVec3, b: DVec3| assert!((a - b).length() < 1e-7, "{a} {b}");
    close(
        derivative(|t| hinge_along(&h, t).connection(), 1e-3),
        k.connection_rate(),
    );
    close(
        derivative(|t| hinge_along(&h, t).orientation(), 1e-3),
        k.orientation_rate(),
    );
    let ([.., a], [.., b]) = (motion(0.4, 0.0), motion(2.6, 0.0));
    let v = |x: &[f64; 6], i: usize| DVec3::from_slice(&x[i..]);
    let j = k.connection_jacobian();
    let second = v(&b, 0) - v(&a, 0) + j.parent * v(&a, 3) + j.child * v(&b, 3);
    let rate = |t: f64| hinge_along(&h, t).connection_rate();
    close(derivative(rate, 1e-3), second + k.connection_bias());
    let j = k.orientation_jacobian();
    let second = j.parent * v(&a, 3) + j.child * v(&b, 3);
    let rate = |t: f64| hinge_along(&h, t).orientation_rate();
    close(derivative(rate, 1e-3), second + k.orientation_bias());
}

#[test]
fn agrees_constraint_jacobian_with_differences() {
    // seed eq. 5, 11: every column of B_q that belongs to an angle, at unfulfilled constraints.
    let h = test_hinge();
    let ([qa, da, _], [qb, db, _]) = (motion(0.4, 0.0), motion(2.6, 0.0));
    let k = hinge_at(&h, [&qa, &qb], [&da, &db], 0.0);
    let (c, o) = (k.connection_jacobian(), k.orientation_jacobian());
    for i in 0..3 {
        let moved = |e: f64, child: bool| {
            let (mut qa, mut qb) = (qa, qb);
            (if child { &mut qb } else { &mut qa })[3 + i] += e;
            hinge_at(&h, [&qa, &qb], [&da, &db], 0.0)
        };
        // Fourth-order differences of numbers of order one.
        let close = |a: DVec3, b: DVec3| assert!((a - b).length() < 1e-11);
        close(
            derivative(|e| moved(e, false).connection(), 1e-3),
            c.parent.col(i),
        );
        close(
            derivative(|e| moved(e, true).connection(), 1e-3),
            c.child.col(i),
        );
        close(
            derivative(|e| moved(e, false).orientation(), 1e-3),
            o.parent.col(i),
        );
        close(
            derivative(|e| moved(e, true).orientation(), 1e-3),
            o.child.col(i),
        );
    }
}

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
fn agrees_posture_of_a_chain_with_time_differences() {
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
        let mut posture = Posture::new(&system);
        posture.update(&system, 0.2 * BEAT + t);
        let (motion, acceleration) = root(0.1 + t);
        let mut m = vec![BodyMotion::REST; 4];
        let mut a = vec![BodyAcceleration::default(); 4];
        posture.motions(&motion, &mut m);
        posture.accelerations(&motion, &acceleration, &mut a);
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

#[test]
fn balances_tethered_support_carries_weight_and_momentum_change() {
    // A root on a prescribed path: the support's force and moment are the rates of the momenta
    // (by differences of the budget) less weight and loads.
    let system = fly(GRAVITY);
    let mut ws = Workspace::new(&system);
    let root = |t: f64| {
        let [q, qd, qdd] = motion(0.7, 200.0 * t);
        let b = &system.bodies()[0];
        let scaled = |x: [f64; 6], f: f64| {
            let mut x = x.map(|x| x * f);
            x[..3].iter_mut().for_each(|x| *x *= LENGTH);
            x
        };
        let k = BodyKinematics::new(b, &scaled(q, 1.0), &scaled(qd, 200.0));
        let q2 = scaled(qdd, 4e4);
        let angular = k.g * DVec3::from_slice(&q2[3..]) + k.g_dot * k.eta_dot;
        let acceleration = BodyAcceleration {
            linear: DVec3::from_slice(&q2),
            angular,
        };
        RootMotion {
            motion: k.motion,
            acceleration,
        }
    };
    let mut at = |t: f64, loads: &[Wrench]| {
        let mut out = Solution::new(&system);
        tethered(&system, t, &root(t), loads, &mut ws, &mut out);
        out
    };
    let quiet = [Wrench::default(); 3];
    let t0 = 0.23 * BEAT;
    let mut momenta = |t: f64| {
        let b = at(t0 + t, &quiet).budget;
        (b.momentum, b.angular_momentum)
    };
    let h = 1e-4 * BEAT;
    let diff = |f: &mut dyn FnMut(f64) -> DVec3| {
        (f(h) - f(-h)) * (8.0 / (12.0 * h)) - (f(2.0 * h) - f(-2.0 * h)) * (1.0 / (12.0 * h))
    };
    let p_rate = diff(&mut |t| momenta(t).0);
    let h_rate = diff(&mut |t| momenta(t).1);
    let mut loads = [Wrench::default(); 3];
    loads[2] = Wrench {
        force: DVec3::new(1e-6, 2e-6, -1e-6),
        moment: DVec3::new(0.0, 1e-9, 2e-9),
    };
    let out = at(t0, &loads);
    let mut motions = vec![BodyMotion::REST; 3];
    wingbeat_dynamics::tethered_motions(
        &system,
        t0,
        &root(t0).motion,
        &mut Workspace::new(&system),
        &mut motions,
    );
    let weight = system.total_mass() * GRAVITY;
    let centre = out.budget.centre;
    let force = p_rate - weight - loads[2].force;
    let moment = h_rate
        - loads[2].moment
        - (motions[2].p - centre).cross(loads[2].force)
        - (motions[0].p - centre).cross(force);
    // Differences with h = 1e-4 beats: rounding 1e-16 / 1e-4 times momenta, wing inertia forces
    // up to a few times the weight.
    assert!((out.tether.force - force).length() < 1e-9 * weight.length().max(p_rate.length()));
    assert!((out.tether.moment - moment).length() < 1e-9 * weight.length() * LENGTH * 10.0);
}

#[test]
fn exact_support_of_a_still_fly_carries_its_weight() {
    let still = wingbeat_math::DMat3::IDENTITY;
    let system = fly_with(CENTRE, WING_MASS, still, still, GRAVITY);
    let root = RootMotion {
        motion: BodyMotion::REST,
        acceleration: BodyAcceleration::default(),
    };
    let mut out = Solution::new(&system);
    let quiet = [Wrench::default(); 3];
    tethered(
        &system,
        0.0,
        &root,
        &quiet,
        &mut Workspace::new(&system),
        &mut out,
    );
    let weight = (BODY_MASS + 2.0 * WING_MASS) * 9.81;
    // By hand: support force -W n3; each hinge carries its wing's weight at half span (moment
    // about axis 1 = -y W, hence +- on the sides) and 0.06 spans behind the hinge.
    assert!((out.tether.force - DVec3::new(0.0, 0.0, -weight)).length() < 1e-14 * weight);
    let wing = WING_MASS * 9.81;
    for (h, side) in out.hinges.iter().zip([-1.0, 1.0]) {
        assert!((h.force - DVec3::new(0.0, 0.0, -wing)).length() < 1e-14 * wing);
        let moment = DVec3::new(-side * 0.5 * LENGTH, -0.06 * LENGTH, 0.0) * wing;
        assert!(
            (h.moment - moment).length() < 1e-14 * wing * LENGTH,
            "{}",
            h.moment
        );
        assert_eq!(h.power, 0.0);
    }
}

#[test]
fn agrees_free_flight_with_a_tether_that_follows_it() {
    // A support that gives the root the accelerations of free flight has nothing to carry.
    let system = fly(GRAVITY);
    let form = MomentumForm::new(system.clone());
    let y = form.initial(0.4 * BEAT, &start()).unwrap();
    let mut flight = Flight::new(&form, applied);
    let free = flight.solve(0.4 * BEAT, &y).unwrap().clone();
    let root = RootMotion {
        motion: flight.motions[0],
        acceleration: free.bodies[0],
    };
    let mut out = Solution::new(&system);
    let loads = flight.wrenches.clone();
    tethered(
        &system,
        0.4 * BEAT,
        &root,
        &loads,
        &mut Workspace::new(&system),
        &mut out,
    );
    let force = BODY_MASS * LENGTH / (BEAT * BEAT);
    assert!(out.tether.force.length() < 1e-12 * force); // rounding
    assert!(out.tether.moment.length() < 1e-12 * force * LENGTH);
    assert!((out.hinges[1].force - free.hinges[1].force).length() < 1e-13 * force);
}
