//! Mechanisms in absolute coordinates against closed solutions and published references.

mod common;

use common::body;
use wingbeat_dynamics::{
    AbsoluteForm, Body, BodyMotion, DynamicsError, ElementLaw, Freedom, Joint, Link, Mechanism,
    NaturalUnits, Stabilization, Wrench,
};
use wingbeat_math::ode::{Dop853, Rk4, Tolerance};
use wingbeat_math::{DMat3, DVec3, DriftingFourier, EulerSequence, MassProperties, r3};

const SI: NaturalUnits = NaturalUnits {
    length: 1.0,
    time: 1.0,
};
const REVOLUTE: Freedom = Freedom::Revolute { axis: DVec3::Z };
const ON_LINE: Freedom = Freedom::PointOnLine { axis: DVec3::Z };

/// A planar body: centre, mass, moment about the mass centre along axis 3.
fn planar(name: &str, mass: f64, centre: DVec3, spin: f64) -> Body {
    let inertia = DMat3::from_diagonal(DVec3::splat(spin));
    let m = MassProperties::about_centre(mass, centre, inertia);
    body(name, m, EulerSequence::BODY_231)
}

/// Flies from `times[0]` through all times at tolerance `tol`; returns the states there.
fn fly(
    form: &AbsoluteForm,
    y0: Vec<f64>,
    times: &[f64],
    tol: f64,
    loads: impl Fn(&[BodyMotion], &mut [Wrench]),
) -> Vec<Vec<f64>> {
    let mut s = form.scratch();
    let mut motions = vec![BodyMotion::REST; form.mechanism().bodies().len()];
    let mut wrenches = vec![Wrench::default(); motions.len()];
    let tolerance = Tolerance {
        relative: tol,
        absolute: tol,
        max_steps: 100_000,
    };
    let mut method = Dop853::new(tolerance, form.scales());
    let (mut y, mut out) = (y0.clone(), vec![y0]);
    for w in times.windows(2) {
        let rates = |t: f64, y: &[f64], dy: &mut [f64]| {
            form.motions(t, y, &mut motions)?;
            wrenches.fill(Wrench::default());
            loads(&motions, &mut wrenches);
            form.rates(t, y, &wrenches, &mut s, dy)
        };
        (method.integrate((w[0], w[1]), &mut y, rates, |_| {})).expect("a smooth motion");
        out.push(y.clone());
    }
    out
}

fn free(_: &[BodyMotion], _: &mut [Wrench]) {}

/// Numbers of a reference table, comment lines and header skipped.
fn table(text: &str) -> Vec<Vec<f64>> {
    (text.lines().filter(|l| !l.starts_with('#')).skip(1))
        .map(|l| l.split(',').map(|x| x.parse().unwrap()).collect())
        .collect()
}

fn motions(form: &AbsoluteForm, t: f64, y: &[f64]) -> Vec<BodyMotion> {
    let mut m = vec![BodyMotion::REST; form.mechanism().bodies().len()];
    form.motions(t, y, &mut m).unwrap();
    m
}

#[test]
fn published_heavy_top() {
    // Bruels, Cardona & Arnold 2012, recomputed to more digits: body frame at the mass centre.
    let inertia = DMat3::from_diagonal(DVec3::new(0.234375, 0.46875, 0.234375));
    let mass = MassProperties::about_centre(15.0, DVec3::ZERO, inertia);
    let top = body("top", mass, EulerSequence::BODY_231);
    let pivot = Link::new("pivot", None, 0, Freedom::Spherical).at(DVec3::ZERO, -DVec3::Y);
    let m = Mechanism::new(vec![top], vec![pivot], DVec3::new(0.0, 0.0, -9.81), SI).unwrap();
    let form = AbsoluteForm::new(m, Stabilization::None);
    let rows = table(include_str!("data/heavy_top.csv"));
    let v = |row: &[f64], i: usize| DVec3::from_slice(&row[i..]);
    let start = BodyMotion {
        p: v(&rows[0], 1),
        r: DMat3::IDENTITY,
        v: v(&rows[0], 4),
        w: v(&rows[0], 7),
    };
    let y0 = form.initial(0.0, &[start], &[]).unwrap();
    let rows = &rows[..21]; // two seconds: 48 turns
    let times: Vec<f64> = rows.iter().map(|r| r[0]).collect();
    let states = fly(&form, y0, &times, 1e-13, free);
    let (mut place, mut turn, mut force) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut s = form.scratch();
    for (row, y) in rows.iter().zip(&states) {
        let m = &motions(&form, row[0], y)[0];
        let r = DMat3::from_cols(v(row, 10), v(row, 13), v(row, 16)).transpose();
        place = place.max((m.p - v(row, 1)).length());
        turn = turn.max(common::size(m.r - r));
        form.solve(row[0], y, &[Wrench::default()], &mut s).unwrap();
        force = force.max((s.reactions[0].force - v(row, 19)).length() / v(row, 19).length());
    }
    println!(
        "heavy top, 2 s: position {place:.1e} m, rotation {turn:.1e}, pivot force {force:.1e}"
    );
    // 1500 steps at 1e-13, phases grown over 48 turns.
    assert!(place < 1e-9 && turn < 1e-9 && force < 1e-9);
}

/// A thin uniform rod of 1 kg and 1 m along axis 1, frame at its start.
fn rod(name: &str) -> Body {
    let inertia = DMat3::from_diagonal(DVec3::new(0.0, 1.0 / 12.0, 1.0 / 12.0));
    let m = MassProperties::about_centre(1.0, DVec3::X * 0.5, inertia);
    body(name, m, EulerSequence::BODY_231)
}

/// The chain of two four-bars: cranks 0, 1, 2 on the ground, couplers 3, 4.
fn four_bars(last: Freedom) -> (Mechanism, Vec<BodyMotion>) {
    let names = ["crank 0", "crank 1", "crank 2", "coupler 0", "coupler 1"];
    let bodies: Vec<Body> = names.iter().map(|n| rod(n)).collect();
    let ground = |i: usize| {
        let at = DVec3::X * i as f64;
        Link::new(&format!("pivot {i}"), None, i, REVOLUTE).at(at, DVec3::ZERO)
    };
    let knee = |i: usize| {
        Link::new(&format!("knee {i}"), Some(i), 3 + i, REVOLUTE).at(DVec3::X, DVec3::ZERO)
    };
    let close = |i: usize| {
        Link::new(&format!("close {i}"), Some(i + 1), 3 + i, last).at(DVec3::X, DVec3::X)
    };
    let links = vec![
        ground(0),
        ground(1),
        ground(2),
        knee(0),
        knee(1),
        close(0),
        close(1),
    ];
    let m = Mechanism::new(bodies, links, DVec3::new(0.0, -9.81, 0.0), SI).unwrap();
    let crank = |i: usize| BodyMotion {
        p: DVec3::X * i as f64,
        r: r3(std::f64::consts::FRAC_PI_2),
        v: DVec3::ZERO,
        w: -DVec3::Z,
    };
    let coupler = |i: usize| BodyMotion {
        p: DVec3::new(i as f64, 1.0, 0.0),
        r: DMat3::IDENTITY,
        v: DVec3::X,
        w: DVec3::ZERO,
    };
    (
        m,
        vec![crank(0), crank(1), crank(2), coupler(0), coupler(1)],
    )
}

#[test]
fn exact_chain_of_four_bars() {
    // IFToMM A02, Jacobi elliptic functions; up to the singular position in which all bars lie in
    // line, at 0.715 s.
    let (m, start) = four_bars(ON_LINE);
    let form = AbsoluteForm::new(m, Stabilization::None);
    let y0 = form.initial(0.0, &start, &[]).unwrap();
    let rows = table(include_str!("data/n_four_bar_N2.csv"));
    let rows = &rows[..14];
    let times: Vec<f64> = rows.iter().map(|r| r[0]).collect();
    let mut worst = 0.0_f64;
    for (row, y) in rows.iter().zip(&fly(&form, y0, &times, 1e-13, free)) {
        let m = motions(&form, row[0], y);
        let tip = m[0].point(DVec3::X) - DVec3::new(row[1], row[2], 0.0);
        let speed = m[0].point_velocity(DVec3::X) - DVec3::new(row[3], row[4], 0.0);
        worst = worst.max(tip.length()).max(speed.length());
    }
    println!("two four-bars to 0.65 s: {worst:.1e} m, m/s");
    assert!(worst < 1e-9); // tolerance 1e-13 a step, grown near the singular position
}

#[test]
fn exact_loops_closed_by_too_many_joints_are_named() {
    let (m, start) = four_bars(REVOLUTE);
    let e = AbsoluteForm::new(m, Stabilization::None).initial(0.0, &start, &[]);
    match e {
        Err(DynamicsError::Redundant { joints, .. }) => {
            println!("redundant: {joints}");
            assert!(joints.contains("`close 0`") || joints.contains("`close 1`"));
        }
        other => panic!("{other:?}"),
    }
}

/// Geometry and masses of Andrews' mechanism (Bari test set): mass and moment of the bodies.
const SQUEEZER: [(&str, f64, f64, [f64; 2]); 7] = [
    ("K1", 0.04325, 2.194e-6, [0.00092, 0.0]),
    ("K2", 0.00365, 4.410e-7, [-0.0115, 0.0]),
    ("K3", 0.02373, 5.255e-6, [0.01874, 0.01043]),
    ("K4", 0.00706, 5.667e-7, [0.0, 0.01421 - 0.02]),
    ("K5", 0.07050, 1.169e-5, [0.02308, 0.00916]),
    ("K6", 0.00706, 5.667e-7, [0.02 - 0.01421, 0.0]),
    ("K7", 0.05498, 1.912e-5, [0.01228, 0.00449]),
];

fn squeezer() -> Mechanism {
    let bodies = (SQUEEZER.iter())
        .map(|&(name, m, spin, [x, y])| planar(name, m, DVec3::new(x, y, 0.0), spin))
        .collect();
    let (a, b) = (
        DVec3::new(-0.06934, -0.00227, 0.0),
        DVec3::new(-0.03635, 0.03273, 0.0),
    );
    let joint = |name: &str, parent, child, at, from| {
        let kind = if from == DVec3::ZERO {
            REVOLUTE
        } else {
            ON_LINE
        };
        Link::new(name, parent, child, kind).at(at, from)
    };
    let (x, y, zero) = (DVec3::X, DVec3::Y, DVec3::ZERO);
    let end = -0.028 * x;
    let mut links = vec![
        joint("O", None, 0, zero, zero),
        joint("K1-K2", Some(0), 1, 0.007 * x, zero),
        joint("B", None, 2, b, zero),
        joint("A5", None, 4, a, zero),
        joint("K5-K4", Some(4), 3, 0.04 * x, zero),
        joint("A7", None, 6, a, zero),
        joint("K7-K6", Some(6), 5, -0.04 * y, zero),
        joint("K2-K3", Some(2), 1, -0.035 * y, end),
        joint("K2-K4", Some(3), 1, -0.02 * y, end),
        joint("K2-K6", Some(5), 1, 0.02 * x, end),
    ];
    let drive = DriftingFourier {
        constant: 0.033,
        ..DriftingFourier::default()
    };
    links[0].joint = Joint::new(REVOLUTE).with(0, ElementLaw::Effort(drive));
    let units = NaturalUnits {
        length: 0.05,
        time: 1e-3,
    };
    Mechanism::new(bodies, links, zero, units).unwrap()
}

/// Bodies of the squeezer for beta, Theta, gamma, Phi, delta, Omega, epsilon.
fn squeezed(q: &[f64]) -> Vec<BodyMotion> {
    let at = |p: DVec3, a: f64| BodyMotion {
        p,
        r: r3(a),
        ..BodyMotion::REST
    };
    let (a, b) = (
        DVec3::new(-0.06934, -0.00227, 0.0),
        DVec3::new(-0.03635, 0.03273, 0.0),
    );
    let (k1, k3) = (at(DVec3::ZERO, q[0]), at(b, q[2]));
    let (k5, k7) = (at(a, q[4]), at(a, q[6]));
    let k2 = at(k1.point(0.007 * DVec3::X), q[0] + q[1]);
    let k4 = at(k5.point(0.04 * DVec3::X), q[3] + q[4]);
    let k6 = at(k7.point(-0.04 * DVec3::Y), q[5] + q[6]);
    vec![k1, k2, k3, k4, k5, k6, k7]
}

/// The spring between K3 and the point C.
fn squeezer_spring(m: &[BodyMotion], out: &mut [Wrench]) {
    let arm = m[2].r * DVec3::new(0.02, -0.018, 0.0);
    let way = m[2].p + arm - DVec3::new(0.014, 0.072, 0.0);
    let force = way * (-4530.0 * (way.length() - 0.07785) / way.length());
    out[2] = Wrench::at(force, arm);
}

#[test]
fn published_andrews_squeezing_mechanism_to_nine_digits() {
    let rows = table(include_str!("data/andrews_squeezer.csv"));
    let form = AbsoluteForm::new(squeezer(), Stabilization::None);
    let y0 = form.initial(0.0, &squeezed(&rows[0][1..8]), &[0]).unwrap();
    let y = fly(&form, y0, &[0.0, 0.03], 1e-13, squeezer_spring)
        .pop()
        .unwrap();
    let end = rows.last().unwrap();
    assert!((end[0] - 0.03).abs() < 1e-12);
    let (found, known) = (motions(&form, 0.03, &y), squeezed(&end[1..8]));
    let mut worst = 0.0_f64;
    for (f, k) in found.iter().zip(&known) {
        let angle = wingbeat_math::untilde(f.r.transpose() * k.r).length();
        worst = worst.max(angle).max((f.p - k.p).length() / 0.05);
    }
    println!("Andrews' mechanism at 0.03 s: {worst:.1e} rad (crank angle 15.8 rad)");
    assert!(worst < 15.8e-9); // nine digits of the crank's angle
}

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
    (method.integrate((0.0, 3.0), &mut angles, textbook, |_| {})).unwrap();
    // Hanging along axis 1, gravity along axis 1, turning about axis 3.
    let bodies = vec![
        planar("upper", m1, DVec3::X * l1, 0.0),
        planar("lower", m2, DVec3::X * l2, 0.0),
    ];
    let links = vec![
        Link::new("shoulder", None, 0, REVOLUTE),
        Link::new("elbow", Some(0), 1, REVOLUTE).at(DVec3::X * l1, DVec3::ZERO),
    ];
    let mechanism = Mechanism::new(bodies, links, DVec3::X * g, SI).unwrap();
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
    let joint = Freedom::Universal {
        axes: [DVec3::X, DVec3::Y],
    };
    let links = vec![Link::new("string", None, 0, joint)];
    let mechanism = Mechanism::new(vec![bob], links, DVec3::Z * g, SI).unwrap();
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
    let mut link = Link::new("rail", None, 0, Freedom::Prismatic { axis });
    link.joint = Joint::new(Freedom::Prismatic { axis }).with(0, law);
    let m = planar("cart", 2.0, DVec3::ZERO, 0.1);
    let mechanism = Mechanism::new(vec![m], vec![link], DVec3::Z, SI).unwrap();
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

#[test]
fn exact_joints_that_cannot_hold_are_named() {
    let two = || vec![rod("a"), rod("b")];
    let build = |links| Mechanism::new(two(), links, DVec3::ZERO, SI);
    let start = [BodyMotion::REST; 2];
    let loose = build(vec![Link::new("pin", None, 0, REVOLUTE)]).unwrap_err();
    assert!(
        matches!(&loose, DynamicsError::Disconnected { body, .. } if body == "b"),
        "{loose}"
    );
    // A loop that cannot close: two bars of 1 m between points 3 m apart.
    let open = vec![
        Link::new("first", None, 0, REVOLUTE),
        Link::new("knee", Some(0), 1, REVOLUTE).at(DVec3::X, DVec3::ZERO),
        Link::new("last", None, 1, ON_LINE).at(DVec3::X * 3.0, DVec3::X),
    ];
    let mut bent = start;
    bent[1] = BodyMotion {
        p: DVec3::X,
        r: r3(0.5),
        ..BodyMotion::REST
    };
    let form = AbsoluteForm::new(build(open).unwrap(), Stabilization::None);
    let e = form.initial(0.0, &bent, &[]).unwrap_err();
    println!("{e}");
    assert!(matches!(
        e,
        DynamicsError::NotAssembled { .. } | DynamicsError::Contradiction { .. }
    ));
    // Two welds of the same pair at different places.
    let clash = vec![
        Link::new("ground", None, 0, REVOLUTE),
        Link::new("weld", Some(0), 1, Freedom::Weld).at(DVec3::X, DVec3::ZERO),
        Link::new("other weld", Some(0), 1, Freedom::Weld).at(DVec3::Y, DVec3::ZERO),
    ];
    let form = AbsoluteForm::new(build(clash).unwrap(), Stabilization::None);
    let e = form.initial(0.0, &start, &[]).unwrap_err().to_string();
    println!("{e}");
    assert!(e.contains("`weld`") && e.contains("`other weld`"), "{e}");
    // An axis that is no unit vector, an element along a direction that is not free.
    let long = Freedom::Revolute {
        axis: DVec3::X * 2.0,
    };
    let e = build(vec![Link::new("pin", None, 0, long)]).unwrap_err();
    assert!(
        matches!(e, DynamicsError::BadJoint { value: 2.0, .. }),
        "{e}"
    );
    let mut pin = Link::new("pin", None, 0, REVOLUTE);
    pin.joint = Joint::new(REVOLUTE).with(1, ElementLaw::Damper { coefficient: 1.0 });
    assert!(matches!(
        build(vec![pin]),
        Err(DynamicsError::BadJoint { .. })
    ));
}

#[test]
fn exact_consistent_start_closes_a_disturbed_loop() {
    let (m, start) = four_bars(ON_LINE);
    let form = AbsoluteForm::new(m, Stabilization::None);
    let mut guess = start.clone();
    for (i, g) in guess.iter_mut().enumerate().skip(1) {
        g.p += DVec3::new(0.02, -0.03, 0.01) * (i as f64).sin();
        g.r *= r3(0.1 * (2.0 * i as f64).cos()) * wingbeat_math::r1(0.05);
        g.w = DVec3::ZERO;
        g.v = DVec3::ZERO;
    }
    let y = form.initial(0.0, &guess, &[0]).unwrap();
    let found = motions(&form, 0.0, &y);
    assert_eq!(found[0].w, start[0].w); // held
    for (f, s) in found.iter().zip(&start) {
        // Thin rods may turn about their own axes; everything else is determined by crank 0.
        assert!((f.point(DVec3::X) - s.point(DVec3::X)).length() < 1e-12);
        assert!((f.point_velocity(DVec3::X) - s.point_velocity(DVec3::X)).length() < 1e-12);
    }
}
