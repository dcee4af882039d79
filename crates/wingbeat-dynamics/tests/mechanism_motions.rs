//! Mechanisms in absolute coordinates whose motion is known in closed form or by equations of their own.

use crate::common;

use common::body;
use common::mechanism::*;
use wingbeat_dynamics::{
    AbsoluteForm, BodyMotion, DynamicsError, ElementLaw, Joint, JointModel, JointType, Mechanism,
    Stabilization, Wrench,
};
use wingbeat_math::ode::{Dop853, Rk4, Tolerance};
use wingbeat_math::{DVec3, EulerSequence, MassProperties, r3};

#[test]
fn exact_double_pendulum_against_its_own_equations() {
    // Point masses 1 and 0.7 kg on bars of 1 and 0.8 m, angles from the vertical; the textbook's
    // two equations, integrated by themselves.
    let (m1, m2, l1, l2, g) = (1.0, 0.7, 1.0, 0.8, 9.81);
    let textbook = |_: f64, y: &[f64], dy: &mut [f64]| {
        let (d, w1, w2) = (y[0] - y[1], y[2], y[3]);
        let (s, c) = d.sin_cos();
        let (a, b, e) = ((m1 + m2) * l1, m2 * l2 * c, l1 * c);
        let f = -m2 * l2 * w2 * w2 * s - (m1 + m2) * g * y[0].sin();
        let h = l1 * w1 * w1 * s - g * y[1].sin();
        let det = a * l2 - b * e;
        (dy[0], dy[1]) = (w1, w2);
        (dy[2], dy[3]) = ((f * l2 - b * h) / det, (a * h - e * f) / det);
        Ok::<(), DynamicsError>(())
    };
    let tolerance = Tolerance {
        relative: 1e-12,
        absolute: 1e-12,
        max_steps: 10_000,
    };
    let mut angles = [1.9, -0.6, 0.4, 1.0];
    let mut method = Dop853::new(tolerance, vec![1.0; 4]);
    (method.integrate((0.0, 3.0), &mut angles, textbook)).unwrap();
    // Hanging along axis 1, gravity along axis 1, turning about axis 3.
    let bodies = vec![
        planar("upper", m1, DVec3::X * l1, 0.0),
        planar("lower", m2, DVec3::X * l2, 0.0),
    ];
    let joints = vec![
        Joint::new("shoulder", None, 0, REVOLUTE),
        Joint::new("elbow", Some(0), 1, REVOLUTE).at(DVec3::X * l1, DVec3::ZERO),
    ];
    let mechanism = Mechanism::new(bodies, joints, DVec3::X * g, SI).unwrap();
    let bar = |p: DVec3, a: f64, v: DVec3, w: f64| BodyMotion {
        p,
        r: r3(a),
        v,
        w: DVec3::Z * w,
    };
    let upper = bar(DVec3::ZERO, 1.9, DVec3::ZERO, 0.4);
    let knee = upper.point(DVec3::X);
    let start = [upper, bar(knee, -0.6, upper.point_velocity(DVec3::X), 1.0)];
    let form = AbsoluteForm::new(mechanism, Stabilization::None);
    let y0 = form.initial(0.0, &start, &[]).unwrap();
    let y = fly(&form, y0, &[0.0, 3.0], 1e-12, free).pop().unwrap();
    let m = motions(&form, 3.0, &y);
    let gap = [0, 1].map(|i| common::size(m[i].r - r3(angles[i])));
    println!("double pendulum after 3 s: {gap:?}");
    assert!(gap[0].max(gap[1]) < 1e-8); // chaos multiplies 1e-12 by some thousands
}

#[test]
fn conserves_energy_and_spin_of_the_spherical_pendulum_and_its_apsides() {
    // A point mass on a string: height and its rate obey z'^2 = 2 (E + g z)(1 - z^2) - h^2, so the
    // lowest and highest points are roots of a cubic; here the start is the highest one.
    let g = 9.81;
    let m = MassProperties::point(1.0, DVec3::Z);
    let bob = body("bob", m, EulerSequence::BODY_231);
    let joint = JointType::Universal {
        axes: [DVec3::X, DVec3::Y],
    };
    let joints = vec![Joint::new("string", None, 0, joint)];
    let mechanism = Mechanism::new(vec![bob], joints, DVec3::Z * g, SI).unwrap();
    let form = AbsoluteForm::new(mechanism, Stabilization::Projection);
    let r = wingbeat_math::r1(-0.9);
    let tip = r * DVec3::Z;
    let across = DVec3::X * 1.5;
    let start = BodyMotion {
        r,
        w: r.transpose() * tip.cross(across),
        ..BodyMotion::REST
    };
    let mut y = form.initial(0.0, &[start], &[]).unwrap();
    let (e, h) = (1.5 * 1.5 / 2.0 - g * tip.z, (tip.cross(across)).z);
    let cubic = |z: f64| 2.0 * (e + g * z) * (1.0 - z * z) - h * h;
    // The cubic is positive between the apsides: the other one lies between z0 and 1.
    let (mut low, mut high) = (tip.z + 1e-3, 1.0);
    for _ in 0..60 {
        let z = 0.5 * (low + high);
        if cubic(z) > 0.0 { low = z } else { high = z }
    }
    let (mut s, mut rk4, n) = (form.scratch(), Rk4::new(y.len()), 4000);
    let (dt, mut lowest, mut drift) = (5.0 / f64::from(n), 0.0_f64, [0.0_f64; 3]);
    for k in 0..n {
        let t = f64::from(k) * dt;
        let none = [Wrench::default()];
        (rk4.advance(t, dt, &mut y, |t, y, dy| {
            form.rates(t, y, &none, &mut s, dy)
        }))
        .unwrap();
        form.project(t + dt, &mut y, &mut s).unwrap();
        let m = motions(&form, t + dt, &y)[0];
        let (x, v) = (m.point(DVec3::Z), m.point_velocity(DVec3::Z));
        lowest = lowest.max(x.z);
        let energy = v.length_squared() / 2.0 - g * x.z;
        drift[0] = drift[0].max((energy - e).abs());
        drift[1] = drift[1].max((x.cross(v).z - h).abs());
        drift[2] = drift[2].max(m.p.length());
    }
    println!("spherical pendulum: lowest point {lowest} against {low}, drifts {drift:?}");
    // Runge-Kutta of order four at 4000 steps; the lowest sample lies within dt^2 of the apsis.
    assert!((lowest - low).abs() < 1e-4 && drift[0] < 1e-8 && drift[1] < 1e-8);
    assert!(drift[2] < 1e-10); // projection
}

fn slider(law: ElementLaw, x: f64, v: f64) -> (AbsoluteForm, Vec<f64>) {
    let axis = DVec3::X;
    let mut joint = Joint::new("rail", None, 0, JointType::Prismatic { axis });
    joint.model = JointModel::new(JointType::Prismatic { axis }).with(0, law);
    let m = planar("cart", 2.0, DVec3::ZERO, 0.1);
    let mechanism = Mechanism::new(vec![m], vec![joint], DVec3::Z, SI).unwrap();
    let form = AbsoluteForm::new(mechanism, Stabilization::None);
    let start = BodyMotion {
        p: DVec3::X * x,
        v: DVec3::X * v,
        ..BodyMotion::REST
    };
    let y = form.initial(0.0, &[start], &[]).unwrap();
    (form, y)
}

#[test]
fn exact_spring_and_mass() {
    let spring = ElementLaw::Spring {
        stiffness: 8.0,
        rest: 0.5,
    };
    let (form, y) = slider(spring, 1.5, 0.0);
    let y = fly(&form, y, &[0.0, 7.0], 1e-12, free).pop().unwrap();
    let x = motions(&form, 7.0, &y)[0].p.x;
    assert!((x - (0.5 + (2.0_f64 * 7.0).cos())).abs() < 1e-10); // omega = sqrt(8 / 2)
}

#[test]
fn exact_stop_gives_back_what_it_took() {
    // Free flight 0.5 s at 2 m/s, half a period of contact pi sqrt(m/k), back at the same speed.
    let stop = |damping: f64| ElementLaw::Stop {
        lower: -10.0,
        upper: 1.0,
        stiffness: 800.0,
        damping,
    };
    let (form, y) = slider(stop(0.0), 0.0, 2.0);
    let contact = std::f64::consts::PI * (2.0_f64 / 800.0).sqrt();
    let end = 1.0 + contact;
    // The force has a kink at touch and at leave: short steps, 1e-9 at best.
    let times: Vec<f64> = (0..=400).map(|k| end * f64::from(k) / 400.0).collect();
    let y = fly(&form, y, &times, 1e-12, free).pop().unwrap();
    let m = motions(&form, end, &y)[0];
    println!("stop: x {:.1e}, v + 2 = {:.1e}", m.p.x, m.v.x + 2.0);
    assert!(m.p.x.abs() < 1e-6 && (m.v.x + 2.0).abs() < 1e-6);
    let (form, y) = slider(stop(0.2), 0.0, 2.0);
    let y = fly(&form, y, &times, 1e-12, free).pop().unwrap();
    let back = motions(&form, end, &y)[0].v.x;
    assert!(back > -1.8 && back < -0.5, "{back}"); // damped: slower, but sent back
}
