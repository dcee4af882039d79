//! The machinery against cases with known answers.

use crate::common;

use common::*;
use wingbeat_analysis::*;
use wingbeat_flight::air::BladeAir;
use wingbeat_flight::*;
use wingbeat_math::ode::Rk4;
use wingbeat_math::{DVec3, r2};

/// Multipliers of Mathieu's equation y'' + (a - 2 q cos 2t) y = 0 over its period pi.
fn mathieu(a: f64, q: f64) -> Vec<[f64; 2]> {
    let map = |x: &[f64]| -> Result<Vec<f64>, AnalysisError> {
        let (mut y, mut rk, n) = (x.to_vec(), Rk4::new(2), 2000);
        let h = std::f64::consts::PI / f64::from(n);
        for k in 0..n {
            rk.advance(f64::from(k) * h, h, &mut y, |t, y, dy| {
                dy[0] = y[1];
                dy[1] = -(a - 2.0 * q * (2.0 * t).cos()) * y[0];
                Ok::<(), AnalysisError>(())
            })?;
        }
        Ok(y)
    };
    let m = jacobian(map, &[0.0, 0.0], &[1e-3, 1e-3]).unwrap();
    assert!((determinant(&m, 2) - 1.0).abs() < 1e-10); // no damping: Liouville
    eigen(&m, 2).unwrap().iter().map(|p| p.value).collect()
}

#[test]
fn published_mathieu_characteristic_values_have_multipliers_of_one() {
    // Characteristic values at q = 1 [Abramowitz & Stegun, table 20.1; NIST DLMF 28]: even ones of
    // period pi (+1), those of period 2 pi (-1). The multiplier is double there: an error e of the
    // matrix moves it by sqrt(e), 1e-5 for RK4 with 2000 steps and a(1) given to 10 digits.
    for (a, sign) in [
        (-0.4551386041, 1.0),
        (1.8591080725, -1.0),
        (-0.1102488170, -1.0),
        (4.3713009827, 1.0),
    ] {
        for [re, im] in mathieu(a, 1.0) {
            assert!((re - sign).hypot(im) < 3e-5, "a = {a}: {re} {im}");
        }
    }
    // Between the curves the motion is bounded or grows.
    let stable = mathieu(1.0, 0.0)[0];
    assert!((stable[0].hypot(stable[1]) - 1.0).abs() < 1e-10);
    assert!(mathieu(1.0, 1.0).iter().any(|m| m[0].abs() > 1.5));
}

#[test]
fn exact_eigenvalues_of_a_badly_scaled_matrix() {
    // D^-1 C D with the companion matrix of (x - 1)(x - 2)(x - 3) and D = diag(1, 1e8, 1e-8).
    let c = [6.0, -11.0, 6.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let d = [1.0, 1e8, 1e-8];
    let a: Vec<f64> = (0..9).map(|k| c[k] * d[k % 3] / d[k / 3]).collect();
    let found = eigen(&a, 3).unwrap();
    for (pair, exact) in found.iter().zip([3.0, 2.0, 1.0]) {
        // Condition of these roots is about 50.
        assert!((pair.value[0] - exact).abs() < 1e-12, "{pair:?}");
        assert_eq!(pair.value[1], 0.0);
        for i in 0..3 {
            let av: f64 = (0..3).map(|j| a[3 * i + j] * pair.vector[j][0]).sum();
            let scale: f64 = (0..3)
                .map(|j| (a[3 * i + j] * pair.vector[j][0]).abs())
                .sum();
            assert!((av - exact * pair.vector[i][0]).abs() < 1e-12 * scale.max(1e-16));
        }
    }
}

#[test]
fn agrees_beat_map_with_the_coupled_simulation() {
    // Two integrators, two assemblies of the equations, added mass solved directly and by
    // iteration: one flight. Both are fourth order; at 200 steps they differ by truncation.
    let setup = FlightSetup {
        time: TimeGrid {
            step: 0.005 / 200.0,
            steps: 400,
            period: Some(0.005),
        },
        ..flying_start()
    };
    let mut flight = Simulation::new(setup.clone()).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
    let gap = |steps: usize| {
        let beat = Beat::new(&setup, steps).unwrap();
        let MotionMode::Free(start) = setup.mode else {
            unreachable!("a free flight")
        };
        let (r, w) = (start.rotation(), start.angular_velocity);
        let trial = beat.state(DVec3::ZERO, r, DVec3::ZERO, w);
        // Velocity of the mass centre from that of the origin.
        let root = beat.root(&trial);
        let y = beat.state(r * beat.mass_centre(), r, start.velocity - root.v, w);
        let y = beat.advance(&beat.advance(&y).unwrap()).unwrap();
        let end = beat.root(&y);
        let record = flight.record();
        let p = DVec3::from_slice(&record.coordinates);
        (
            (end.p - p).length() / 2.5e-3,
            (end.w - record.root_angular_velocity).length() * 0.005,
        )
    };
    let (position, rate) = gap(200);
    assert!(position < 1e-5 && rate < 1e-4, "{position} {rate}");
}

/// The fly started impulsively with some velocity and rotation.
fn flying_start() -> FlightSetup {
    let mut setup = fly();
    for wing in &mut setup.animal.wings {
        wing.motion.start = wingbeat_model::Start::Impulsive;
    }
    if let MotionMode::Free(start) = &mut setup.mode {
        start.velocity = DVec3::new(0.2, 0.05, -0.1);
        start.angular_velocity = DVec3::new(3.0, -5.0, 2.0);
    }
    setup
}

#[test]
fn order_beat_map_is_fourth_order() {
    // Faster than the wing tips, so that no strip comes to rest in the air: there the coefficients
    // have a kink, and any method loses its order.
    let at = |steps: usize| {
        let beat = Beat::new(&smooth(fly()), steps).unwrap();
        let velocity = DVec3::new(6.0, 0.0, 0.0);
        beat.advance(&beat.state(DVec3::ZERO, r2(0.8), velocity, DVec3::ZERO))
            .unwrap()
    };
    let (a, b, c) = (at(200), at(400), at(800));
    let gap = |p: &State, q: &State| {
        let component = |i: usize| ((p[i] - q[i]) / scale(i)).abs();
        (0..13).map(component).fold(0.0, f64::max)
    };
    let order = (gap(&a, &b) / gap(&b, &c)).log2();
    assert!((order - 4.0).abs() < 0.4, "order {order}"); // ten harmonics: not quite asymptotic
}

/// Natural size of a component of the state: R, 1, m R/T, m R^2/T.
fn scale(i: usize) -> f64 {
    let p = 0.94e-6 * 2.5e-3 / 0.005;
    [2.5e-3, 1.0, p, p * 2.5e-3][[0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 3, 3, 3][i]]
}

#[test]
fn agrees_monodromy_with_long_flights_and_its_determinant_with_the_trace() {
    let trimmed = trim(&smooth(fly()), &hover(100)).unwrap();
    let (beat, y) = (&trimmed.beat, trimmed.state.clone());
    // In all thirteen numbers of the state.
    let map = |x: &[f64]| -> Result<Vec<f64>, AnalysisError> { beat.advance(x) };
    let steps: Vec<f64> = (0..13).map(|i| 1e-4 * scale(i)).collect();
    let m = jacobian(map, &y, &steps).unwrap();
    // Ten beats of a slightly disturbed flight against the tenth power on the disturbance.
    let (mut z, mut far) = (vec![0.0; 13], y.clone());
    for (i, d) in [(2, 0.3), (7, 1.0), (10, -0.5), (12, 0.4)] {
        z[i] = 1e-6 * d * scale(i);
        far[i] += z[i];
    }
    let mut near = y.clone();
    for _ in 0..10 {
        near = beat.advance(&near).unwrap();
        far = beat.advance(&far).unwrap();
        z = (0..13)
            .map(|i| (0..13).map(|j| m[13 * i + j] * z[j]).sum())
            .collect();
    }
    for i in 0..13 {
        // Departures grow to a few 1e-6; squares of them and the differences' errors remain.
        let d = (far[i] - near[i] - z[i]) / scale(i);
        assert!(d.abs() < 2e-9, "{i}: {d}");
    }
    // Liouville: det M = exp of the integrated trace of the rates' derivative. The quaternion is
    // scaled to length 1 after a beat: that direction has multiplier 0, so the map without
    // the scaling is used.
    let raw = |x: &[f64]| -> Result<Vec<f64>, AnalysisError> {
        let (mut s, mut integration) = (x.to_vec(), Integration::new(beat));
        (0..beat.steps()).try_for_each(|k| integration.step(beat, k, &mut s))?;
        Ok(s)
    };
    let scaled = |m: &[f64]| -> Vec<f64> {
        (0..169)
            .map(|k| m[k] * scale(k % 13) / scale(k / 13))
            .collect()
    };
    let det = determinant(&scaled(&jacobian(raw, &y, &steps).unwrap()), 13);
    let (mut s, mut sum) = (y, 0.0);
    let mut integration = Integration::new(beat);
    let n = beat.steps();
    for k in 0..n {
        let f = |x: &[f64]| -> Result<Vec<f64>, AnalysisError> { beat.rates(2 * k, x) };
        let a = jacobian(f, &s, &steps).unwrap();
        sum += (0..13).map(|i| a[14 * i]).sum::<f64>() * beat.period() / n as f64;
        integration.step(beat, k, &mut s).unwrap();
    }
    // The trapezoid rule of a periodic trace is spectrally accurate; RK4 errs by 1e-6 or so.
    assert!(
        (det.ln() - sum).abs() < 1e-5 * sum.abs(),
        "{} {sum}",
        det.ln()
    );
}

#[test]
fn limit_modes_tend_to_the_rigid_body_at_first_order_in_wing_mass() {
    // Wings of relative mass e; body and air unchanged. Floquet's exponents are smooth in e.
    let exponents = |e: f64| {
        let mut setup = fly();
        for wing in &mut setup.animal.wings {
            wing.mass = wing.mass.scaled(e);
        }
        let t = trim(&setup, &hover(60)).unwrap();
        assert!(t.solution.converged);
        let modes = floquet(&t.beat, &t.state).unwrap();
        let longitudinal = modes.plane(Plane::Longitudinal);
        longitudinal
            .map(|m| [m.growth, m.frequency])
            .collect::<Vec<_>>()
    };
    let limit = exponents(0.0);
    assert_eq!(limit.len(), 3);
    let gap = |e: f64| {
        let list = exponents(e);
        let gaps = list.iter().zip(&limit);
        gaps.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]))
            .fold(0.0, f64::max)
    };
    let (a, b) = (gap(0.2), gap(0.1));
    let order = (a / b).log2();
    assert!((order - 1.0).abs() < 0.1, "order {order}: {a} {b}");
}

#[test]
fn agrees_massless_wings_with_a_rigid_body_of_its_own() {
    // Independent of the momentum form: Newton's and Euler's laws of the body alone, in body
    // axes, under the same strips; added mass left out so that loads need no accelerations.
    let mut setup = fly();
    if let AirModel::BladeElement(options) = &mut setup.air {
        options.blade.added_mass = wingbeat_blade::AddedMassModel::None;
    }
    for wing in &mut setup.animal.wings {
        wing.mass = wing.mass.scaled(0.0);
        wing.motion.start = wingbeat_model::Start::Impulsive;
    }
    let beat = Beat::new(&setup, 200).unwrap();
    let velocity = DVec3::new(0.3, 0.1, -0.2);
    let rate = DVec3::new(10.0, -20.0, 5.0);
    let y = beat.state(DVec3::ZERO, r2(0.8), velocity, rate);
    let end = beat.root(&beat.advance(&y).unwrap());
    let body = rigid_body_beat(&setup, r2(0.8), velocity, rate);
    // Both RK4 with 200 steps of different variables: errors of 1e-7 of U = 0.5 m/s and 1/T.
    assert!((end.v - body.0).length() < 1e-6, "{} {}", end.v, body.0);
    assert!((end.w - body.1).length() < 2e-4, "{} {}", end.w, body.1);
}

/// Velocity (N) and angular velocity (body) after a beat of a rigid body with massless wings.
fn rigid_body_beat(
    setup: &FlightSetup,
    r0: wingbeat_math::DMat3,
    v0: DVec3,
    w0: DVec3,
) -> (DVec3, DVec3) {
    use wingbeat_dynamics::BodyMotion;
    use wingbeat_math::{DQuat, RotationLaw};
    let AirModel::BladeElement(options) = &setup.air else {
        unreachable!("blade elements")
    };
    let side = BladeAir::new(&setup.animal, options).unwrap();
    let (m, j) = (
        setup.animal.body.mass,
        setup.animal.body.inertia_about_centre(),
    );
    let f = |t: f64, y: &[f64], dy: &mut [f64]| -> Result<(), AnalysisError> {
        let q = DQuat::from_slice(&y[..4]).normalize();
        let (v, w) = (DVec3::from_slice(&y[4..]), DVec3::from_slice(&y[7..])); // body axes
        let (mut force, mut moment) = (q.inverse() * (m * setup.gravity), DVec3::ZERO);
        for (wing, strips) in setup.animal.wings.iter().zip(side.wings()) {
            let law = wing.motion.at(t);
            let load = strips.velocity_load(&BodyMotion {
                r: law.c,
                v: v + w.cross(wing.hinge_b),
                w: law.c.transpose() * w + law.w,
                ..BodyMotion::REST
            });
            let push = law.c * load.force;
            force += push;
            moment += law.c * load.moment + wing.hinge_b.cross(push);
        }
        (q * DQuat::from_xyzw(w.x, w.y, w.z, 0.0) * 0.5).write_to_slice(&mut dy[..4]);
        (force / m - w.cross(v)).write_to_slice(&mut dy[4..7]);
        (j.inverse() * (moment - w.cross(j * w))).write_to_slice(&mut dy[7..]);
        Ok(())
    };
    let q = DQuat::from_mat3(&r0);
    let mut y = vec![0.0; 10];
    q.write_to_slice(&mut y[..4]);
    (q.inverse() * v0).write_to_slice(&mut y[4..7]);
    w0.write_to_slice(&mut y[7..]);
    let mut rk = Rk4::new(10);
    let h = 0.005 / 200.0;
    for k in 0..200 {
        rk.advance(f64::from(k) * h, h, &mut y, f).unwrap();
    }
    let q = DQuat::from_slice(&y[..4]).normalize();
    (q * DVec3::from_slice(&y[4..]), DVec3::from_slice(&y[7..]))
}

#[test]
fn invariant_heading_is_neutral_and_planes_are_apart() {
    let t = trim(&fly(), &hover(60)).unwrap();
    let m = orbit_monodromy(&t.beat, &t.state).unwrap();
    // Components u, w, q, theta (0, 2, 4, 7) do not mix with the others in symmetric flight.
    let longitudinal = |k: usize| [0, 2, 4, 7].contains(&k);
    for i in 0..9 {
        for j in 0..9 {
            if longitudinal(i) != longitudinal(j) {
                // Off by roundings of the differences: 1e-16 over 1e-4, in mixed units up to 1/T.
                assert!(
                    m[9 * i + j].abs() < 1e-8 * 200.0,
                    "{i} {j}: {}",
                    m[9 * i + j]
                );
            }
        }
    }
    // Turning the whole flight changes nothing but the heading itself.
    for i in 0..9 {
        let exact = f64::from(u8::from(i == 8));
        assert!((m[9 * i + 8] - exact).abs() < 1e-7, "{i}");
    }
}
