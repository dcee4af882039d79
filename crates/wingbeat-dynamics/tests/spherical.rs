//! Elements of spherical joints: springs of unequal stiffness keep energy, dampers take it away.

use crate::common;

use common::*;
use wingbeat_dynamics::{
    BodyMotion, ElementLaw, Formulation, Joint, JointModel, JointType, Mechanism, MomentumForm,
    QuaternionForm, Stabilization, System,
};
use wingbeat_math::ode::{Dop853, Tolerance};
use wingbeat_math::{DMat3, DQuat, DVec3, EulerSequence, MassProperties};

const TOLERANCE: Tolerance = Tolerance {
    relative: 1e-13,
    absolute: 1e-13,
    max_steps: 100_000,
};

/// Two bodies in vacuum without gravity, of unequal moments of inertia, on a spherical joint.
fn pair(model: JointModel) -> System {
    let inertia = DMat3::from_diagonal(DVec3::new(1.0, 2.0, 2.5)) * (BODY_MASS * 1e-7);
    let mass = |share: f64, x: f64| {
        let centre = DVec3::new(x, 1e-4, 0.0);
        MassProperties::about_centre(share * BODY_MASS, centre, inertia * share)
    };
    let bodies = [("thorax", mass(0.6, 0.0)), ("abdomen", mass(0.4, -3e-4))]
        .map(|(name, m)| body(name, m, EulerSequence::BODY_231));
    let mut joint = Joint::new("waist", Some(0), 1, model.kind).at(-3e-4 * DVec3::X, DVec3::ZERO);
    joint.model = model;
    System::new(bodies.to_vec(), vec![joint], DVec3::ZERO, UNITS).unwrap()
}

fn ball(laws: [ElementLaw; 3]) -> JointModel {
    let free = JointModel::new(JointType::Spherical);
    (laws.into_iter().enumerate())
        .fold(free, |joint, (k, law)| joint.with(k, law))
        .starting(&[0.5, 0.9, -0.4], &[20.0, -10.0, 5.0])
}

fn springs() -> [ElementLaw; 3] {
    [(1e-8, 0.3), (3e-8, -0.2), (9e-8, 0.1)]
        .map(|(stiffness, rest)| ElementLaw::Spring { stiffness, rest })
}

/// Kinetic energy with that of springs and stops at ten times within `duration`.
fn energies(form: &dyn Formulation, duration: f64) -> Vec<f64> {
    let mut flight = Flight::new(form, none);
    let mut y = form.initial(0.0, &BodyMotion::REST).unwrap();
    let mut method = Dop853::new(TOLERANCE, form.scales());
    let mut out = vec![energy(&mut flight, 0.0, &y)];
    for k in 0..10 {
        let [from, to] = [k, k + 1].map(|k| duration * f64::from(k) / 10.0);
        let rates = |t: f64, y: &[f64], dy: &mut [f64]| flight.rates(t, y, dy);
        (method.integrate((from, to), &mut y, rates)).unwrap();
        out.push(energy(&mut flight, to, &y));
    }
    out
}

fn energy(flight: &mut Flight<'_>, t: f64, y: &[f64]) -> f64 {
    let kinetic = flight.solve(t, y).unwrap().budget.kinetic;
    let mechanism = Mechanism::of(flight.form.system());
    let mut motion = vec![];
    mechanism.coordinates(t, &flight.motions, &mut motion);
    let elements = &mechanism.joints()[0].model.elements;
    let stored = elements
        .iter()
        .map(|e| e.law.stored(motion[e.direction][0]));
    kinetic + stored.sum::<f64>()
}

/// The same system in both forms that know free joints.
fn in_both(model: JointModel, duration: f64) -> [Vec<f64>; 2] {
    let system = pair(model);
    let momentum = MomentumForm::new(system.clone());
    let quaternion = QuaternionForm::new(system, Stabilization::None);
    [
        energies(&momentum, duration),
        energies(&quaternion, duration),
    ]
}

#[test]
fn conserves_energy_of_unequal_springs_and_stops_of_a_spherical_joint() {
    let stop = ElementLaw::Stop {
        lower: -0.3,
        upper: 0.6,
        stiffness: 2e-8,
        damping: 0.0,
    };
    // Integration at 1e-13; the stop has kinks.
    for (model, limit) in [
        (ball(springs()), 1e-11),
        (ball(springs()).with(1, stop), 1e-8),
    ] {
        for e in in_both(model, 0.2) {
            let worst = e.iter().map(|x| (x / e[0] - 1.0).abs()).fold(0.0, f64::max);
            println!("energy of unequal springs: {worst:.1e}");
            assert!(worst < limit);
        }
    }
}

#[test]
fn balances_power_of_a_joint_with_the_energy_of_its_elements() {
    let model = ball(springs());
    let h = 1e-6;
    let (theta, w) = (DVec3::new(0.5, 1.9, -0.4), DVec3::new(20.0, -10.0, 5.0));
    let at = |t: f64| DQuat::from_scaled_axis(theta) * DQuat::from_scaled_axis(w * t);
    let stored = |t: f64| {
        let q = at(t).to_scaled_axis();
        let of = |e: &wingbeat_dynamics::Element| e.law.stored(q[e.direction]);
        model.elements.iter().map(of).sum::<f64>()
    };
    let motion = [0, 1, 2].map(|k| [theta[k], w[k]]);
    let efforts = DVec3::from_array(model.efforts(0.0, &motion, |_| true));
    let loss = (stored(-h) - stored(h)) / (2.0 * h);
    assert!((efforts.dot(w) / loss - 1.0).abs() < 1e-8); // central difference
}

#[test]
fn behaves_dampers_of_a_spherical_joint_dissipate() {
    let dampers = [1e-11, 4e-10, 2e-9].map(|coefficient| ElementLaw::Damper { coefficient });
    let model = (dampers.into_iter().enumerate())
        .fold(ball(springs()), |joint, (k, law)| joint.with(k, law));
    for e in in_both(model, 0.05) {
        assert!(e.windows(2).all(|e| e[1] < e[0]), "{e:?}");
    }
}

#[test]
fn exact_equal_springs_and_dampers_act_along_the_rotation_vector_and_against_the_turning() {
    let (k, c) = (2e-8, 3e-11);
    let spring = ElementLaw::Spring {
        stiffness: k,
        rest: 0.0,
    };
    let damper = ElementLaw::Damper { coefficient: c };
    let model = (0..3).fold(ball([0, 1, 2].map(|_| spring.clone())), |j, i| {
        j.with(i, damper.clone())
    });
    let (theta, w) = (DVec3::new(0.5, 1.9, -0.4), DVec3::new(20.0, -10.0, 5.0));
    let motion = [0, 1, 2].map(|k| [theta[k], w[k]]);
    let efforts = DVec3::from_array(model.efforts(0.0, &motion, |_| true));
    assert!((efforts + k * theta + c * w).length() < 1e-15 * k); // rounding
}
