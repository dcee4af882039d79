//! A fly on a support: what the support carries.

use crate::common;

use common::*;
use wingbeat_dynamics::euler::BodyKinematics;
use wingbeat_dynamics::{
    BodyAcceleration, BodyMotion, Formulation, MomentumForm, RootMotion, Solution, Workspace,
    Wrench, tethered,
};
use wingbeat_math::DVec3;

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
