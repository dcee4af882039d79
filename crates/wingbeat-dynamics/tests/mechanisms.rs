//! Mechanisms in absolute coordinates against closed solutions and published references.

use crate::common;

use common::body;
use common::mechanism::*;
use wingbeat_dynamics::{
    AbsoluteForm, Body, BodyMotion, DynamicsError, ElementLaw, Joint, JointModel, JointType,
    Mechanism, NaturalUnits, Stabilization, Wrench,
};
use wingbeat_math::{DMat3, DVec3, DriftingFourier, EulerSequence, MassProperties, r3};

/// Numbers of a reference table, comment lines and header skipped.
fn table(text: &str) -> Vec<Vec<f64>> {
    (text.lines().filter(|l| !l.starts_with('#')).skip(1))
        .map(|l| l.split(',').map(|x| x.parse().unwrap()).collect())
        .collect()
}

#[test]
fn published_heavy_top() {
    // Bruels, Cardona & Arnold 2012, recomputed to more digits: body frame at the mass centre.
    let inertia = DMat3::from_diagonal(DVec3::new(0.234375, 0.46875, 0.234375));
    let mass = MassProperties::about_centre(15.0, DVec3::ZERO, inertia);
    let top = body("top", mass, EulerSequence::BODY_231);
    let pivot = Joint::new("pivot", None, 0, JointType::Spherical).at(DVec3::ZERO, -DVec3::Y);
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
fn four_bars(last: JointType) -> (Mechanism, Vec<BodyMotion>) {
    let names = ["crank 0", "crank 1", "crank 2", "coupler 0", "coupler 1"];
    let bodies: Vec<Body> = names.iter().map(|n| rod(n)).collect();
    let ground = |i: usize| {
        let at = DVec3::X * i as f64;
        Joint::new(&format!("pivot {i}"), None, i, REVOLUTE).at(at, DVec3::ZERO)
    };
    let knee = |i: usize| {
        Joint::new(&format!("knee {i}"), Some(i), 3 + i, REVOLUTE).at(DVec3::X, DVec3::ZERO)
    };
    let close = |i: usize| {
        Joint::new(&format!("close {i}"), Some(i + 1), 3 + i, last).at(DVec3::X, DVec3::X)
    };
    let joints = vec![
        ground(0),
        ground(1),
        ground(2),
        knee(0),
        knee(1),
        close(0),
        close(1),
    ];
    let m = Mechanism::new(bodies, joints, DVec3::new(0.0, -9.81, 0.0), SI).unwrap();
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
        Joint::new(name, parent, child, kind).at(at, from)
    };
    let (x, y, zero) = (DVec3::X, DVec3::Y, DVec3::ZERO);
    let end = -0.028 * x;
    let mut joints = vec![
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
    joints[0].model = JointModel::new(REVOLUTE).with(0, ElementLaw::Effort(drive));
    let units = NaturalUnits {
        length: 0.05,
        time: 1e-3,
    };
    Mechanism::new(bodies, joints, zero, units).unwrap()
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
fn exact_joints_that_cannot_hold_are_named() {
    let two = || vec![rod("a"), rod("b")];
    let build = |joints| Mechanism::new(two(), joints, DVec3::ZERO, SI);
    let start = [BodyMotion::REST; 2];
    let loose = build(vec![Joint::new("pin", None, 0, REVOLUTE)]).unwrap_err();
    assert!(
        matches!(&loose, DynamicsError::Disconnected { body, .. } if body == "b"),
        "{loose}"
    );
    // A loop that cannot close: two bars of 1 m between points 3 m apart.
    let open = vec![
        Joint::new("first", None, 0, REVOLUTE),
        Joint::new("knee", Some(0), 1, REVOLUTE).at(DVec3::X, DVec3::ZERO),
        Joint::new("last", None, 1, ON_LINE).at(DVec3::X * 3.0, DVec3::X),
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
        Joint::new("ground", None, 0, REVOLUTE),
        Joint::new("weld", Some(0), 1, JointType::Weld).at(DVec3::X, DVec3::ZERO),
        Joint::new("other weld", Some(0), 1, JointType::Weld).at(DVec3::Y, DVec3::ZERO),
    ];
    let form = AbsoluteForm::new(build(clash).unwrap(), Stabilization::None);
    let e = form.initial(0.0, &start, &[]).unwrap_err().to_string();
    println!("{e}");
    assert!(e.contains("`weld`") && e.contains("`other weld`"), "{e}");
    // An axis that is no unit vector, an element along a direction that is not free.
    let long = JointType::Revolute {
        axis: DVec3::X * 2.0,
    };
    let e = build(vec![Joint::new("pin", None, 0, long)]).unwrap_err();
    assert!(
        matches!(e, DynamicsError::BadJoint { value: 2.0, .. }),
        "{e}"
    );
    let mut pin = Joint::new("pin", None, 0, REVOLUTE);
    pin.model = JointModel::new(REVOLUTE).with(1, ElementLaw::Damper { coefficient: 1.0 });
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
