//! Angle laws: analytic derivatives, periodicity, smooth start, mirror symmetry.

use crate::gap;
use std::f64::consts::{FRAC_PI_2, TAU};
use wingbeat_math::{DMat3, DVec3, RotationLaw, r1, r2, r3};
use wingbeat_model::kinematics::{self, Timing};
use wingbeat_model::motion::{
    Fourier, Oval, PeriodicSpline, SmoothSquare, SmoothTriangle, SplitCycle,
};
use wingbeat_model::{AngleLaw, AngleLaws, Side, Start, WingMotion};

fn laws() -> Vec<AngleLaw> {
    let samples = |n: usize| -> Vec<(f64, f64)> {
        let at = |k: usize| (k as f64 / n as f64 - 0.3, (TAU * k as f64 / n as f64).sin());
        (0..=n).map(at).collect()
    };
    vec![
        AngleLaw::Fourier(Fourier {
            mean: 0.2,
            cos: vec![1.0, -0.3],
            sin: vec![0.1, 0.2, 0.05],
        }),
        AngleLaw::SmoothTriangle(SmoothTriangle {
            amplitude: 1.2,
            shape: 0.8,
            shift: 0.4,
            mean: 0.1,
        }),
        AngleLaw::SmoothSquare(SmoothSquare {
            amplitude: 0.9,
            shape: 2.4,
            shift: -1.3,
            mean: -0.2,
        }),
        AngleLaw::Oval(Oval {
            amplitude: 0.1,
            count: 2,
            shift: 0.7,
            mean: 0.05,
        }),
        AngleLaw::SplitCycle(SplitCycle {
            amplitude: 0.6,
            first_share: 0.46,
            shift: 0.5,
            mean: -0.1,
        }),
        AngleLaw::Table(PeriodicSpline::new("table", &samples(40)).unwrap()),
    ]
}

#[test]
fn exact_fourier_series_is_the_sum_of_its_harmonics() {
    let term = |k: i32| f64::from((7 * k + 3) % 11 - 5) / f64::from(k);
    let series = Fourier {
        mean: 0.3,
        cos: (1..=30).map(term).collect(),
        sin: (1..=28).map(|k| term(k + 4)).collect(),
    };
    for x in [0.0, 0.013, 0.25, 0.511, 0.999] {
        let mut sum = [0.3, 0.0, 0.0];
        for k in 1..=30 {
            let w = TAU * f64::from(k);
            let (s, c) = (w * x).sin_cos();
            let (a, b) = (term(k), if k <= 28 { term(k + 4) } else { 0.0 });
            sum[0] += a * c + b * s;
            sum[1] += w * (b * c - a * s);
            sum[2] -= w * w * (a * c + b * s);
        }
        // Harmonic k by k additions of angles: k roundings of terms of size 5/k.
        let size = [1.0, TAU, TAU * TAU * 30.0];
        for ((a, b), size) in series.at(x).into_iter().zip(sum).zip(size) {
            assert!((a - b).abs() < 1e-13 * size * 30.0, "{x}: {a} and {b}");
        }
    }
}

#[test]
fn order_analytic_derivatives_are_the_limit_of_central_differences() {
    for law in laws() {
        for x in [0.013, 0.27, 0.511, 0.88] {
            let error = |h: f64| {
                let (p, m, c) = (law.at(x + h), law.at(x - h), law.at(x));
                let rate = (p[0] - m[0]) / (2.0 * h) - c[1];
                let accel = (p[1] - m[1]) / (2.0 * h) - c[2];
                [rate.abs() / TAU, accel.abs() / (TAU * TAU)]
            };
            let (coarse, fine) = (error(4e-4), error(1e-4));
            for k in 0..2 {
                // Second order: 16 times smaller. Rounding of differences is 1e-12 here, and
                // the spline's slope has kinks in its third derivative only.
                let ok = fine[k] < coarse[k] / 14.0 || fine[k] < 1e-11;
                assert!(ok, "{law:?} at {x}: {coarse:?} {fine:?}");
                assert!(fine[k] < 1e-4);
            }
        }
    }
}

#[test]
fn exact_laws_have_period_one_and_scale() {
    for law in laws() {
        for x in [0.0, 0.2, 0.9] {
            for k in 0..3 {
                let d = law.at(x)[k] - law.at(x + 3.0)[k];
                assert!(d.abs() < 1e-11 * TAU.powi(2)); // rounding of the phase, second derivative
                let s = law.scaled(-2.0).at(x)[k] + 2.0 * law.at(x)[k];
                assert!(s.abs() < 1e-13 * TAU.powi(2));
            }
        }
    }
}

#[test]
fn exact_split_cycle_is_the_two_cosines_of_the_paper() {
    // Doman et al.: cos((w - d) t), then cos((w + s) t + xi) with s = d w / (w - 2 d), xi = -2 pi d / (w - 2 d).
    let (w, d) = (TAU, 0.07 * TAU);
    let (s, xi) = (d * w / (w - 2.0 * d), -TAU * d / (w - 2.0 * d));
    let law = SplitCycle {
        amplitude: 1.0,
        first_share: 0.5 * w / (w - d),
        shift: 0.0,
        mean: 0.0,
    };
    let turned = law.first_share;
    for k in 0..200 {
        let x = k as f64 / 200.0;
        let (rate, phase) = if x < turned {
            (w - d, 0.0)
        } else {
            (w + s, xi)
        };
        let (sin, cos) = (rate * x + phase).sin_cos();
        let expected = [cos, -rate * sin, -rate * rate * cos];
        for (a, b) in law.at(x).into_iter().zip(expected) {
            assert!((a - b).abs() < 1e-12 * TAU * TAU, "{x}: {a} {b}"); // roundings of the phase
        }
    }
    // Once continuously differentiable: no jump of angle or rate at the reversals.
    for (before, after) in [(turned - 1e-9, turned + 1e-9), (1.0 - 1e-9, 1e-9)] {
        let (a, b) = (law.at(before), law.at(after));
        assert!((a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-6);
    }
    // Half strokes of equal length are a cosine; the mean does not depend on the split.
    let law = AngleLaw::SplitCycle(law);
    let even = law.split_by(0.5 - turned);
    assert!((even.at(0.3)[0] - (0.3 * TAU).cos()).abs() < 1e-14);
    let samples = 100_000;
    let sum: f64 = (0..samples)
        .map(|k| law.at((k as f64 + 0.5) / samples as f64)[0])
        .sum();
    // The midpoint rule where the second derivative jumps: error h^2.
    assert!((sum / samples as f64 - law.mean()).abs() < 1e-9);
}

#[test]
fn limit_berman_wang_shapes_go_to_sine_triangle_and_square() {
    let triangle = |shape| SmoothTriangle {
        amplitude: 1.0,
        shape,
        shift: 0.0,
        mean: 0.0,
    };
    let square = |shape| SmoothSquare {
        amplitude: 1.0,
        shape,
        shift: 0.0,
        mean: 0.0,
    };
    for x in [0.06, 0.125, 0.2] {
        let sine = (TAU * x).sin();
        for small in [0.0, 1e-5] {
            // Both depart from the sine with the square of the shape: 1e-10.
            assert!((triangle(small).at(x)[0] - sine).abs() < 1e-9);
            assert!((square(small).at(x)[0] - sine).abs() < 1e-9);
        }
        // asin(K s)/asin K differs from the triangle 4x by O(sqrt(1 - K)) at the corner.
        assert!((triangle(1.0 - 1e-9).at(x)[0] - 4.0 * x).abs() < 1e-4);
        assert!((square(200.0).at(x)[0] - 1.0).abs() < 1e-12);
    }
}

#[test]
fn order_periodic_spline_converges_at_fourth_order_to_a_smooth_law() {
    let law = |x: f64| (TAU * x).sin() + 0.3 * (2.0 * TAU * x).cos();
    let error = |n: usize| {
        // Uneven knots that belong to a smooth map of the period.
        let knot = |k: usize| {
            let s = k as f64 / n as f64;
            s + 0.05 * (TAU * s).sin()
        };
        let rows: Vec<_> = (0..=n).map(|k| (knot(k), law(knot(k)))).collect();
        let spline = PeriodicSpline::new("table", &rows).unwrap();
        let at = |i: i32| {
            let x = f64::from(i) / 997.0;
            (spline.at(x)[0] - law(x)).abs()
        };
        (0..997).map(at).fold(0.0, f64::max)
    };
    let order = (error(40) / error(80)).log2();
    assert!((order - 4.0).abs() < 0.3, "order {order}"); // knots of the two tables differ
}

#[test]
fn exact_spline_meets_its_samples_and_is_twice_continuous_across_the_seam() {
    let rows = [(0.0, 0.3), (0.2, 1.0), (0.55, -0.4), (0.8, 0.1), (1.0, 0.3)];
    let spline = PeriodicSpline::new("table", &rows).unwrap();
    for (x, q) in rows {
        assert!((spline.at(x)[0] - q).abs() < 1e-14);
    }
    for (x, _) in rows {
        let (before, after) = (spline.at(x - 1e-12), spline.at(x + 1e-12));
        for k in 0..3 {
            // Jumps would be of order one; the slope of q'' (about 1e3) times 2e-12 is allowed.
            assert!((before[k] - after[k]).abs() < 1e-8);
        }
    }
}

fn fry(side: Side) -> WingMotion {
    kinematics::fry_hover().wing(side, 200.0, 42.5f64.to_radians())
}

#[test]
fn exact_smooth_start_rests_in_the_pose_at_zero_and_lags_half_its_duration() {
    let smooth = fry(Side::Right);
    let impulsive = WingMotion {
        start: Start::Impulsive,
        ..smooth.clone()
    };
    let (a, b) = (smooth.angles(0.0), impulsive.angles(0.0));
    for k in 0..3 {
        assert_eq!(a[k], [b[k][0], 0.0, 0.0]);
    }
    assert_eq!(smooth.start, Start::Smooth { duration: 5e-3 });
    for t in [5e-3, 7.3e-3, 21e-3] {
        let (late, early) = (smooth.angles(t), impulsive.angles(t - 2.5e-3));
        assert_eq!(late, early);
    }
}

#[test]
fn order_start_warp_is_four_times_differentiable_at_both_ends() {
    let start = Start::Smooth { duration: 2.0 };
    for t in [0.0, 2.0] {
        // tau' departs from its constant value as (distance)^4: the third derivative of the
        // step is continuous.
        let away = |h: f64| (start.warp(t + h)[1] - start.warp(t - h)[1]).abs();
        let order = (away(0.02) / away(0.01)).log2();
        assert!((order - 4.0).abs() < 0.1, "order {order}");
    }
    for t in [0.3, 1.0, 1.9] {
        let h = 1e-5;
        let (p, m, c) = (start.warp(t + h), start.warp(t - h), start.warp(t));
        for k in 0..2 {
            // Central differences: h^2 = 1e-10 times third derivatives of order ten.
            assert!(((p[k] - m[k]) / (2.0 * h) - c[k + 1]).abs() < 1e-8);
        }
    }
}

#[test]
fn agrees_rotation_and_its_derivatives_with_central_differences_during_start_and_after() {
    let motion = WingMotion {
        phase: 0.2,
        ..fry(Side::Left)
    };
    let f = motion.frequency;
    for t in [0.9e-3, 2.6e-3, 8.1e-3] {
        let h = 1e-4 / f;
        let (p, m, c) = (motion.at(t + h), motion.at(t - h), motion.at(t));
        let d1 = (p.c - m.c) * (0.5 / h) - c.c_dot();
        let d2 = (p.c_dot() - m.c_dot()) * (0.5 / h) - c.c_ddot();
        // h = 1e-4 beats: (2 pi 8 h)^2 / 6 = 4e-6 of the rate for the 8th harmonic, less below.
        assert!(gap(d1 * (1.0 / f), DMat3::ZERO) < 1e-4);
        assert!(gap(d2 * (1.0 / (f * f)), DMat3::ZERO) < 1e-2);
        assert!(gap(c.c * c.c.transpose(), DMat3::IDENTITY) < 1e-14);
    }
}

#[test]
fn exact_rotation_is_the_1_3_2_sequence_after_the_stroke_plane() {
    let motion = WingMotion::fixed(0.3, [0.5, -0.2, 1.1]);
    let expected = r2(0.3) * r1(0.5) * r3(-0.2) * r2(1.1);
    assert!(gap(motion.at(1.7).c, expected) < 1e-15);
    assert_eq!(motion.at(1.7).c_dot(), DMat3::ZERO);
    // Body pitch + stroke-plane pitch = 90 deg: axis 1 of the stroke plane points up (-n3).
    let up = r2(FRAC_PI_2 - 0.3) * r2(0.3) * DVec3::X;
    assert!((up + DVec3::Z).length() < 1e-15);
}

#[test]
fn invariant_mirrored_motion_mirrors_the_rotation() {
    let flip = DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0));
    let right = fry(Side::Right);
    assert_eq!(right.mirrored(), fry(Side::Left));
    for t in [0.0, 1.1e-3, 9.7e-3] {
        let (r, l) = (right.at(t), right.mirrored().at(t));
        assert_eq!(flip * r.c * flip, l.c); // sign changes only: bit for bit
        assert_eq!(flip * r.c_ddot() * flip, l.c_ddot());
    }
}

#[test]
fn exact_phase_shifts_time_and_each_wing_has_its_own() {
    let base = WingMotion {
        start: Start::Impulsive,
        ..fry(Side::Right)
    };
    let late = WingMotion {
        phase: -0.25,
        ..base.clone()
    };
    let (a, b) = (base.angles(1e-3), late.angles(1e-3 + 0.25 / 200.0));
    for k in 0..3 {
        assert!((a[k][0] - b[k][0]).abs() < 1e-13); // rounding of the phase
    }
}

/// FluSI's passive rotations, axes x forward, y left, z up: `v_new = R v_old`.
fn passive(axis: usize, a: f64) -> DMat3 {
    wingbeat_math::rotation_about(axis, a).transpose()
}

#[test]
fn agrees_flusi_converter_with_its_own_matrices_for_both_wings() {
    let (phi, theta, alpha, eta) = (0.7, -0.3, 0.9, -0.6);
    let right = kinematics::convert::flusi(
        AngleLaw::Constant(phi),
        AngleLaw::Constant(theta),
        AngleLaw::Constant(alpha),
    );
    let motion = |angles: AngleLaws| WingMotion {
        angles,
        ..WingMotion::fixed(-eta, [0.0; 3])
    };
    let ours_right = motion(right.clone()).at(0.0).c;
    let ours_left = motion(right.mirrored()).at(0.0).c;
    let turn = DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0)); // Rx(pi): their axes <-> ours
    // Left: M maps body to wing in their axes; both frames are turned, C = turn M^T turn.
    let left = passive(1, alpha) * passive(2, theta) * passive(0, phi) * passive(1, eta);
    assert!(gap(ours_left, turn * left.transpose() * turn) < 1e-15);
    // Right: their Rx(pi) already turns the wing frame to x forward, y right, z down.
    let right =
        passive(1, -alpha) * passive(2, theta) * passive(0, -phi) * (turn * passive(1, eta));
    assert!(gap(ours_right, turn * right.transpose()) < 1e-15);
}

#[test]
fn agrees_fwuav_converter_with_its_own_matrices_for_both_wings() {
    let (phi, pitch, dev, beta) = (0.7, -0.3, 0.9, 0.6);
    let law = AngleLaw::Constant;
    let right = kinematics::convert::fwuav(law(phi), law(pitch), law(dev));
    let motion = |angles: AngleLaws| WingMotion {
        angles,
        ..WingMotion::fixed(beta, [0.0; 3])
    };
    let theirs_right = r2(beta) * r1(phi) * r3(-dev) * r2(pitch);
    let theirs_left = r2(beta) * r1(-phi) * r3(dev) * r2(pitch);
    assert!(gap(motion(right.clone()).at(0.0).c, theirs_right) < 1e-15);
    assert!(gap(motion(right.mirrored()).at(0.0).c, theirs_left) < 1e-15);
}

fn all_published() -> Vec<kinematics::PublishedMotion> {
    use kinematics::FwuavInsect::{Bumblebee, FruitFly, Hawkmoth, Monarch};
    let (stroke, attack) = (160f64.to_radians(), 40f64.to_radians());
    let timings = [Timing::Advanced, Timing::Symmetrical, Timing::Delayed];
    let mut all = vec![
        kinematics::fry_hover(),
        kinematics::berman_wang_fruit_fly(),
        kinematics::whitehead_fruit_fly(),
    ];
    all.extend([Monarch, Hawkmoth, Bumblebee, FruitFly].map(|i| kinematics::fwuav_hover(i).0));
    for t in timings {
        all.push(kinematics::robofly_dickinson1999(t, stroke, attack));
        all.push(kinematics::robofly_sane_dickinson2001(t, stroke, attack));
        all.push(kinematics::robofly_table(t).unwrap());
    }
    all
}

#[test]
fn invariant_in_every_published_motion_the_leading_edge_leads_both_half_strokes() {
    for published in all_published() {
        let motion = WingMotion {
            start: Start::Impulsive,
            ..published.wing(Side::Right, 1.0, 0.0)
        };
        motion.check("wing").unwrap();
        let phi = |i: i32| motion.angles(f64::from(i) / 1000.0)[0];
        let (lo, hi) = (0..1000).fold((9.0_f64, -9.0_f64), |(l, h), i| {
            (l.min(phi(i)[0]), h.max(phi(i)[0]))
        });
        // Middle of the half stroke that runs in the direction of the sign.
        let middle = |sign: f64| {
            let off = |i: &i32| (phi(*i)[0] - 0.5 * (lo + hi)).abs();
            let same_way = (0..1000).filter(|&i| sign * phi(i)[1] > 0.0);
            let i = same_way.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
            f64::from(i) / 1000.0
        };
        for t in [middle(1.0), middle(-1.0)] {
            let m = motion.at(t);
            let leading_edge = m.c * DVec3::X;
            let velocity = (m.c_dot() * DVec3::Y).normalize(); // of a point on the span axis
            let lead = leading_edge.dot(velocity);
            let up = leading_edge.x;
            assert!(lead > 0.2, "{}: at {t} leads by {lead}", published.name);
            assert!(up > 0.0, "{}: upside down at {t}", published.name);
        }
    }
}

/// Measured sets hold no noise that a spline would beat with.
#[test]
fn limit_tables_of_the_robofly_do_not_scatter() {
    for timing in [Timing::Advanced, Timing::Symmetrical, Timing::Delayed] {
        let set = kinematics::robofly_table(timing).unwrap();
        for law in [set.right.phi, set.right.psi] {
            let AngleLaw::Table(table) = law else {
                panic!("a table")
            };
            assert_eq!(table.scatter(), None);
        }
    }
}
