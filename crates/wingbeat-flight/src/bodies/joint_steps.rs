//! Free joints in steps: whether what a joint carries, on its springs and dampers, dies out in the steps of a
//! flight by its integrator, or alternates and grows.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | c, k, I | | damping, stiffness and inertia that is moved along a free direction | N m s, N m, kg m2 (N s/m, N/m, kg) |
//! | c h / I | `damping` | what of a rate the damper takes in a step | 1 |
//! | w h | `vibration` | angular frequency `sqrt(k / I)` times the step | 1 |
//! | | `growth` | largest root of the method there ([`EqualSteps::growth`]) | 1 |
//!
//! The inertia is what moves where the flight starts, rigid and in a vacuum, when the flyer and all of its
//! joints give way. What acts on several joints of a chain or of one light body moves them together, faster
//! than each by itself. The air's mass and damping, which help, are left out, and so are stops: they act for a
//! few steps.

use std::sync::Arc;

use wingbeat_dynamics::{Formulation, Joint, JointType, QuaternionForm, Stabilization, mobilities};
use wingbeat_math::DVec3;
use wingbeat_math::ode::EqualSteps;

use crate::bodies::joints::closes_loop;
use crate::bodies::system_of;
use crate::setup::{FlightSetup, IntegratorChoice, MotionMode};

/// Growth a step from which a joint is not carried by the steps \[1\]: a hundred steps make it e times as
/// large. Vibrations that grow less are those the air damps.
const GROWS: f64 = 1.01;

/// Growth a step that is none \[1\]: a few parts in a thousand over a hundred steps.
const STAYS: f64 = 1.0 + 1e-4;

/// w h from which a spring is far stiffer than steps resolve \[1\]: the hinges of insects and robots have 0.1
/// to 1, and from some 1e4 on roundings of the angle part halves of a flyer that are alike.
const STIFF: f64 = 1e3;

/// Most times as many steps that are looked at as a remedy.
const MAX_FINER: u32 = 1000;

/// A free direction of a joint in the steps of a flight.
#[derive(Clone, Debug, PartialEq)]
pub struct JointSteps {
    /// Name of the joint; of joints that give way together, of that on which most acts.
    pub joint: String,
    /// Whether what acts on other joints takes part.
    pub is_together: bool,
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
        if self.growth <= GROWS {
            return format!(
                "the spring of joint `{}` is far stiffer than steps resolve: w h = {:.1e} (angular frequency and step, rigid and in a vacuum), and roundings of its angle move what hangs on it",
                self.joint, self.vibration
            );
        }
        format!(
            "{} act faster than dynamics.integrator = \"{}\" carries: c h / I = {:.2}, w h = {:.2} (damping, angular frequency, and step; rigid and in a vacuum), where a disturbance becomes {:.2} times as large in every step",
            match self.is_together {
                true => format!(
                    "springs and dampers of joint `{}` and others together",
                    self.joint
                ),
                false => format!("spring and damper of joint `{}`", self.joint),
            },
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
    let acted = acted(setup);
    let found = mobilities_of(setup, &acted)?;
    let efforts = efforts(&acted);
    let steps = |joint: usize, both: [f64; 2], is_together: bool| {
        let growth = method.growth(both, h);
        let found = JointSteps {
            joint: acted[joint].0.name.clone(),
            is_together,
            damping: both[0] * h,
            vibration: both[1].sqrt() * h,
            growth,
            remedy: remedy(setup, method, both),
        };
        (growth > GROWS).then_some(found)
    };
    let one = |i: usize| steps(i, efforts[i].map(|x| x * found[i][i]), false);
    let all = [0, 1].map(|of| together(&found, &efforts, of));
    let all = all.into_iter().flatten();
    let all = all.filter_map(|(joint, both)| steps(joint, both, true));
    let faster = |a: &JointSteps, b: &JointSteps| a.growth.total_cmp(&b.growth);
    let alone = (0..acted.len()).filter_map(one).max_by(faster);
    let most = alone.as_ref().map_or(0.0, |a| a.growth) * (1.0 + SAME);
    all.max_by(faster).filter(|a| a.growth > most).or(alone)
}

/// The joint whose spring vibrates fastest in the steps of `setup`, where it does so beyond all that steps
/// resolve, whether they carry it or not; none where all springs are softer.
pub(crate) fn stiff_joint(setup: &FlightSetup) -> Option<JointSteps> {
    let acted = acted(setup);
    let found = mobilities_of(setup, &acted)?;
    let springs = efforts(&acted).into_iter().enumerate();
    let of = |(i, [_, stiffness]): (usize, [f64; 2])| {
        JointSteps {
        joint: acted[i].0.name.clone(),
        is_together: false,
        damping: 0.0,
        vibration: (stiffness * found[i][i]).sqrt() * setup.time.step,
        growth: 1.0,
        remedy: "less stiffness: look at its unit; a joint that is not to turn is kind = \"weld\", and a wing without a joint is driven as its motion has it".into(),
    }
    };
    let fastest = springs
        .map(of)
        .max_by(|a, b| a.vibration.total_cmp(&b.vibration));
    fastest.filter(|j| j.vibration > STIFF)
}

/// Free directions, with their joints, along which springs or dampers act; those of joints that close loops are
/// left out.
fn acted(setup: &FlightSetup) -> Vec<(&Joint, usize)> {
    let joints = setup.joints.iter().enumerate();
    let open = joints.filter(|(k, _)| !closes_loop(&setup.joints, *k));
    let directions = open.flat_map(|(_, j)| (0..j.model.kind.directions()).map(move |k| (j, k)));
    let acted = directions.filter(|(j, k)| j.model.damping_and_stiffness(*k) != [0.0; 2]);
    acted.collect()
}

/// Damping and stiffness along these directions [N m s and N m, N s/m and N/m].
fn efforts(acted: &[(&Joint, usize)]) -> Vec<[f64; 2]> {
    let of = |(j, k): &(&Joint, usize)| j.model.damping_and_stiffness(*k).map(|x| x.max(0.0));
    acted.iter().map(of).collect()
}

/// Growth that is the same, over itself \[1\].
const SAME: f64 = 1e-6;

/// Passes of the power method, whose error is then nothing beside what growth is judged by.
const PASSES: usize = 200;

/// What the dampers (`of` 0) or springs (1) of all joints do together in their fastest motion: c / I \[1/s\]
/// and k / I \[1/s2\] of it, with the number of the joint that takes most part, by the `mobilities` M of joints
/// that have these `efforts` c and k. The largest eigenvalue of `D M D`, D the roots of c or k, is no less than
/// any of what each joint does by itself: joints of a chain give way together. None of one joint.
fn together(mobilities: &[Vec<f64>], efforts: &[[f64; 2]], of: usize) -> Option<(usize, [f64; 2])> {
    let roots: Vec<f64> = efforts.iter().map(|e| e[of].sqrt()).collect();
    // Accelerations that efforts of these sizes in the directions make.
    let moved = |v: &[f64]| -> Vec<f64> {
        let row = |row: &Vec<f64>| {
            let terms = row.iter().zip(&roots).zip(v);
            terms.map(|((m, d), v)| m * d * v).sum()
        };
        mobilities.iter().map(row).collect()
    };
    // Parts that are unlike each other have a share in any motion.
    let mut v: Vec<f64> = (0..roots.len()).map(|i| 1.0 / (1.5 + i as f64)).collect();
    let mut fastest = 0.0;
    for _ in 0..PASSES {
        let next: Vec<f64> = moved(&v).iter().zip(&roots).map(|(a, d)| a * d).collect();
        fastest = next.iter().map(|x| x * x).sum::<f64>().sqrt();
        if fastest <= 0.0 || roots.len() < 2 {
            return None;
        }
        v = next.iter().map(|x| x / fastest).collect();
    }
    let way = moved(&v);
    let both = [0, 1].map(|of| {
        let terms = way.iter().zip(efforts).map(|(a, e)| e[of] * a * a);
        terms.sum::<f64>() / fastest
    });
    let part = |&i: &usize| v[i].abs();
    let joint = (0..v.len()).max_by(|i, j| part(i).total_cmp(&part(j)))?;
    Some((joint, both))
}

/// How readily joints give way along free directions ([`mobilities`]); none where there are none, or where the
/// flight cannot start.
fn mobilities_of(setup: &FlightSetup, directions: &[(&Joint, usize)]) -> Option<Vec<Vec<f64>>> {
    let system = system_of(setup).ok().filter(|_| !directions.is_empty())?;
    let hinge = |joint: &Joint| system.hinges().iter().position(|h| h.child == joint.child);
    let places = directions.iter().map(|&(j, k)| hinge(j).map(|h| (h, k)));
    let places: Vec<(usize, usize)> = places.collect::<Option<_>>()?;
    let form = QuaternionForm::new(system, Stabilization::None);
    let form = match &setup.mode {
        MotionMode::Tethered(motion) => {
            let motion = Arc::new(motion.clone());
            form.supported(motion.clone(), motion)
        }
        MotionMode::Free(_) => form,
    };
    let y = form.initial(0.0, &setup.root_at_start()).ok()?;
    mobilities(&form, (0.0, &y), &places).ok()
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
