//! The terms of the seed's equations, each by itself, against differences and sums over points.

use crate::common;

use common::*;
use wingbeat_dynamics::euler::{self, BodyKinematics, HingeKinematics};
use wingbeat_dynamics::{Body, Joint, Wrench, weight_wrench};
use wingbeat_math::{DVec3, EulerSequence, MassProperties, RotationLaw, tilde};

const SEQUENCES: [EulerSequence; 2] = [EulerSequence::BODY_231, EulerSequence::WING_132];

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

/// Kinetic energy \[J\], `q'^T M q' / 2` (seed eq. 20).
fn kinetic_energy(body: &Body, k: &BodyKinematics) -> f64 {
    let [p, h] = euler::mass_matrix(body, k).times(k.motion.v, k.eta_dot);
    0.5 * (k.motion.v.dot(p) + k.eta_dot.dot(h))
}

/// Generalized force of a force \[N\], N components, at the point `r` \[m\] of the body (seed eq. 8, 9): `(F, H^T F)`
/// with the derivative of `R r` by the angles, `H = -R tilde(r) G`.
fn point_force(k: &BodyKinematics, r: DVec3, force: DVec3) -> [DVec3; 2] {
    let jacobian = -(k.motion.r * tilde(r) * k.g);
    [force, jacobian.transpose() * force]
}

#[test]
fn exact_kinetic_energy_is_the_sum_over_points() {
    // seed eq. 13 against eq. 17-20 and the form without coordinates (eq. 23).
    for s in SEQUENCES {
        let b = cloud_body(s);
        let k = along(&b, 2.0, 0.2);
        let points = |(m, r): &(f64, DVec3)| 0.5 * m * k.motion.point_velocity(*r).length_squared();
        let sum: f64 = cloud().iter().map(points).sum();
        assert!((kinetic_energy(&b, &k) - sum).abs() < 1e-14 * sum.max(1.0)); // roundings
        assert!(
            (wingbeat_dynamics::kinetic_energy(&b.mass, &k.motion) - sum).abs()
                < 1e-14 * sum.max(1.0)
        );
    }
}

#[test]
fn agrees_mass_matrix_rate_with_differences() {
    // seed eq. 25.
    for s in SEQUENCES {
        let b = cloud_body(s);
        let rate = euler::mass_matrix_rate(&b, &along(&b, 0.5, 0.1));
        let at = |t: f64| euler::mass_matrix(&b, &along(&b, 0.5, 0.1 + t));
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
            euler::mass_matrix(&b, &k).times(k.motion.v, k.eta_dot)
        };
        let gradient = |i: usize| {
            derivative(
                |e| {
                    let mut q = q;
                    q[i] += e;
                    kinetic_energy(&b, &BodyKinematics::new(&b, &q, &qd))
                },
                1e-3,
            )
        };
        let [qr, qe] = euler::quadratic_velocity(&b, &k);
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
            let part = point_force(&k, r, force(i));
            // Fourth-order differences of numbers of order one.
            assert!((part[0] - DVec3::new(work(0), work(1), work(2))).length() < 1e-10);
            assert!((part[1] - DVec3::new(work(3), work(4), work(5))).length() < 1e-10);
            wrench += Wrench::at(force(i), k.motion.r * r);
            sum = [sum[0] + part[0], sum[1] + part[1]];
        }
        let whole = euler::generalized_wrench(&k, &wrench);
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
fn test_hinge() -> Joint {
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
    Joint {
        anchor_child: DVec3::new(0.1, 0.4, -0.2),
        ..hinge("h", 1, DVec3::new(0.3, -0.5, 0.7), Slow(Flapping::left()))
    }
}

/// The hinge between two bodies that move on their own, constraints not fulfilled.
fn hinge_at(h: &Joint, q: [&[f64]; 2], qd: [&[f64]; 2], t: f64) -> HingeKinematics {
    let parent = BodyKinematics::new(&cloud_body(SEQUENCES[0]), q[0], qd[0]);
    let child = BodyKinematics::new(&cloud_body(SEQUENCES[1]), q[1], qd[1]);
    HingeKinematics::new(h, &h.rotation(t), &parent, &child)
}

fn hinge_along(h: &Joint, t: f64) -> HingeKinematics {
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
