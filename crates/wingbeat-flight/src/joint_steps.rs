//! Free joints in steps: whether what a joint carries, on its springs and dampers, dies out in the steps of a
//! flight by its integrator, or alternates and grows.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | c, k, I | | damping, stiffness and inertia along a free direction | N m s, N m, kg m2 (N s/m, N/m, kg) |
//! | c h / I | `damping` | what of a rate the damper takes in a step | 1 |
//! | w h | `vibration` | angular frequency `sqrt(k / I)` times the step | 1 |
//! | | `growth` | largest root of the method there ([`EqualSteps::growth`]) | 1 |
//!
//! What a joint carries is rigid, in a vacuum, and what it hangs on stands still: the air's mass and damping,
//! which help, and a light parent, which does not, are left out. Stops are left out: they act for a few steps.

use wingbeat_dynamics::{ElementLaw, Joint, JointType};
use wingbeat_math::DVec3;
use wingbeat_math::ode::EqualSteps;

use crate::bodies::system_of;
use crate::joints::closes_loop;
use crate::setup::{FlightSetup, IntegratorChoice};

/// Growth a step from which a joint is not carried by the steps \[1\]: a hundred steps make it e times as
/// large. Vibrations that grow less are those the air damps.
const GROWS: f64 = 1.01;

/// Growth a step that is none \[1\]: a few parts in a thousand over a hundred steps.
const STAYS: f64 = 1.0 + 1e-4;

/// Most times as many steps that are looked at as a remedy.
const MAX_FINER: u32 = 1000;

/// A free direction of a joint in the steps of a flight.
#[derive(Clone, Debug, PartialEq)]
pub struct JointSteps {
    /// Name of the joint.
    pub joint: String,
    /// c h / I \[1\].
    pub damping: f64,
    /// w h \[1\].
    pub vibration: f64,
    /// Growth a step of the motion along it, by springs and dampers alone \[1\].
    pub growth: f64,
    /// What to try.
    pub remedy: String,
}

impl JointSteps {
    /// What is said of it under the integrator of `setup`.
    pub fn said(&self, setup: &FlightSetup) -> String {
        format!(
            "spring and damper of joint `{}` act faster than dynamics.integrator = \"{}\" carries: c h / I = {:.2}, w h = {:.2} (damping, angular frequency, and step; rigid, in a vacuum, on a parent that is held), where a disturbance becomes {:.2} times as large in every step",
            self.joint,
            setup.integrator.name(),
            self.damping,
            self.vibration,
            self.growth
        )
    }
}

/// The free direction of a joint whose motion grows most by the steps of `setup`; none where none grows.
pub fn growing_joint(setup: &FlightSetup) -> Option<JointSteps> {
    let method = equal_steps(setup)?;
    let h = setup.time.step;
    let joints = setup.joints.iter().enumerate();
    let open = joints.filter(|(k, _)| !closes_loop(&setup.joints, *k));
    let directions = open.flat_map(|(_, j)| (0..j.model.kind.directions()).map(move |k| (j, k)));
    let of = |(joint, k): (&Joint, usize)| {
        let [damping, stiffness] = acting(joint, k);
        let inertia = carried_inertia(setup, joint, k)?;
        let both = [damping / inertia, stiffness.max(0.0) / inertia];
        let growth = method.growth(both, h);
        let found = JointSteps {
            joint: joint.name.clone(),
            damping: both[0] * h,
            vibration: both[1].sqrt() * h,
            growth,
            remedy: remedy(setup, method, both),
        };
        (growth > GROWS).then_some(found)
    };
    let all = directions.filter_map(of);
    all.max_by(|a, b| a.growth.total_cmp(&b.growth))
}

/// What a joint that carries `both` c / I \[1/s\] and k / I \[1/s^2\] wants instead of `method`.
fn remedy(setup: &FlightSetup, method: EqualSteps, both: [f64; 2]) -> String {
    let h = setup.time.step;
    let is_carried = |m: EqualSteps, h: f64| m.growth(both, h) <= STAYS;
    let mut ways = vec![];
    if method != EqualSteps::Bdf && is_carried(EqualSteps::Bdf, h) {
        ways.push("dynamics.integrator = \"bdf\"".to_owned());
    }
    if !setup.air.keeps_wake() && !setup.animal.is_elastic() {
        ways.push(
            "dynamics.integrator = \"order_eight\", which chooses its steps itself".to_owned(),
        );
    }
    let finer = (2..=MAX_FINER).find(|n| is_carried(method, h / f64::from(*n)));
    match finer {
        Some(n) => ways.push(format!(
            "{n} times as many steps (time.steps_per_beat, or a smaller time.step_s)"
        )),
        None => ways.push("less stiffness or damping: look at their units".to_owned()),
    }
    ways.join(", or ")
}

/// The method of equal steps that integrates the joints of `setup`; none where steps are chosen by their error,
/// or the formula is that of order two, which takes all vibrations back.
fn equal_steps(setup: &FlightSetup) -> Option<EqualSteps> {
    match setup.integrator {
        IntegratorChoice::Hamming => Some(EqualSteps::Hamming),
        IntegratorChoice::Bdf if setup.animal.is_elastic() => None,
        IntegratorChoice::Bdf => Some(EqualSteps::Bdf),
        IntegratorChoice::Adams => Some(EqualSteps::Adams),
        IntegratorChoice::RungeKutta => Some(EqualSteps::RungeKutta),
        IntegratorChoice::OrderEight { .. } => None,
    }
}

/// Damping \[N m s or N s/m\] and stiffness \[N m/rad or N/m\] along free direction `k` of a joint.
fn acting(joint: &Joint, k: usize) -> [f64; 2] {
    let elements = joint.model.elements.iter().filter(|e| e.direction == k);
    let of = |law: &ElementLaw| match law {
        ElementLaw::Spring { stiffness, .. } => [0.0, *stiffness],
        ElementLaw::Damper { coefficient } => [*coefficient, 0.0],
        ElementLaw::Follow {
            stiffness, damping, ..
        } => [*damping, *stiffness],
        ElementLaw::Stop { .. } | ElementLaw::Effort(_) => [0.0; 2],
    };
    elements.fold([0.0; 2], |sum, e| {
        let [c, k] = of(&e.law);
        [sum[0] + c, sum[1] + k]
    })
}

/// Inertia along free direction `k` of a joint \[kg m2 or kg\], of its child and of what hangs on that; the
/// latter is counted about the joint that carries each.
fn carried_inertia(setup: &FlightSetup, joint: &Joint, k: usize) -> Option<f64> {
    let own = inertia_about(setup, joint, joint, k)?;
    let hangs = |mut body: usize| {
        // As many joints as there are lead from any body to the central one.
        for _ in 0..setup.joints.len() {
            let Some(next) = setup.joints.iter().find(|j| j.child == body) else {
                return false;
            };
            match next.parent {
                Some(parent) if parent == joint.child => return true,
                Some(parent) => body = parent,
                None => return false,
            }
        }
        false
    };
    let outer = setup.joints.iter().enumerate();
    let outer = outer.filter(|(n, j)| !closes_loop(&setup.joints, *n) && hangs(j.child));
    let outer = outer.filter_map(|(_, j)| inertia_about(setup, j, joint, k));
    Some(own + outer.sum::<f64>())
}

/// Moment of inertia \[kg m2\] about the axis of free direction `k` of `joint`, one that turns, of the child of
/// `carried`, which stands as the child of `joint` does; its mass \[kg\] where `joint` slides.
pub fn inertia_about(setup: &FlightSetup, carried: &Joint, joint: &Joint, k: usize) -> Option<f64> {
    let system = system_of(setup).ok()?;
    let mass = system.bodies().get(carried.child)?.mass;
    let axis = match joint.model.kind {
        JointType::Prismatic { .. } => return Some(mass.mass).filter(|m| *m > 0.0),
        JointType::Revolute { axis } => axis,
        JointType::Universal { axes } => *axes.get(k)?,
        JointType::Spherical | JointType::PointOnLine { .. } => *DVec3::AXES.get(k)?,
        JointType::Weld => return None,
    };
    // Steiner, from the origin of the child to the joint.
    let [a, s] = [carried.anchor_child, mass.first_moment].map(|x| x - x.dot(axis) * axis);
    let about = axis.dot(mass.inertia * axis) - 2.0 * a.dot(s) + mass.mass * a.length_squared();
    Some(about).filter(|j| *j > 0.0)
}
