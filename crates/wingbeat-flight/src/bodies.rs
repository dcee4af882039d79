//! From the animal to the multibody system: the root body, one driven hinge per wing, and the
//! joints of further segments.

pub(crate) mod joint_steps;
pub mod joints;

use std::sync::Arc;

use wingbeat_dynamics::{
    Baumgarte, Body, BodyMotion, DynamicsError, EulerForm, Formulation, Joint, JointType,
    Mechanism, MomentumForm, NaturalUnits, QuaternionForm, Stabilization, System,
};
use wingbeat_math::{DVec3, EulerSequence, RotationLaw};
use wingbeat_model::{Animal, Wing};

use crate::bodies::joints::closes_loop;
use crate::setup::{FlightSetup, FormulationChoice, MotionMode};

/// The multibody system of an animal of body and wings: body 0 is the central body (2-3-1
/// angles), then its wings (1-3-2 angles), each on a hinge whose rotation is prescribed (seed
/// sec. 3).
///
/// # Errors
/// What the dynamics refuses: see [`System::new`].
pub fn system(
    animal: &Animal,
    gravity: DVec3,
    units: NaturalUnits,
) -> Result<System, DynamicsError> {
    articulated(animal, &[], gravity, units, &own_motion)
}

/// The rotation of a wing's hinge.
pub type WingLaw<'a> = dyn Fn(usize, &Wing) -> Arc<dyn RotationLaw> + 'a;

/// A wing that moves as its animal says.
pub(crate) fn own_motion(_index: usize, wing: &Wing) -> Arc<dyn RotationLaw> {
    Arc::new(wing.motion.clone())
}

/// The multibody system of a setup: central body, wings, segments, in this order; the first joint
/// of every body makes the tree, further ones close loops.
///
/// # Errors
/// What the dynamics refuses: see [`System::new`] and [`System::with_joint`].
pub fn system_of(setup: &FlightSetup) -> Result<System, DynamicsError> {
    system_with(setup, &own_motion)
}

/// What looks like a slip of units in a setup ([`System::warnings`]); nothing where masses change no flight, as
/// of bodies that are held, without joints and weight.
pub fn doubtful_masses(setup: &FlightSetup) -> Vec<String> {
    let is_held = matches!(setup.mode, MotionMode::Tethered(_)) && setup.joints.is_empty();
    if setup.animal.wings.is_empty() || is_held && setup.gravity == DVec3::ZERO {
        return vec![];
    }
    system_of(setup).map_or(vec![], |s| s.warnings())
}

/// As [`system_of`], wings without a law of their joint's own moving by `law`.
///
/// # Errors
/// As [`system_of`].
pub fn system_with(setup: &FlightSetup, law: &WingLaw<'_>) -> Result<System, DynamicsError> {
    let units = natural_units(setup);
    articulated(&setup.animal, &setup.joints, setup.gravity, units, law)
}

/// Builds the system of a setup and, where joints close loops, closes them at time zero.
///
/// # Errors
/// The first thing that is wrong with the joints, by name.
pub fn check_assembly(setup: &FlightSetup) -> Result<(), DynamicsError> {
    let system = system_of(setup)?;
    let root = setup.root_at_start();
    if !system.loops().is_empty() {
        check_closed(&system, &root)?;
    }
    if matches!(setup.mode, MotionMode::Tethered(_)) {
        return Ok(());
    }
    match setup.formulation {
        FormulationChoice::Quaternion(_) => quaternion(system, &root),
        FormulationChoice::Momentum => MomentumForm::new(system).initial(0.0, &root),
        FormulationChoice::Euler(_) => EulerForm::new(system, Baumgarte::OFF).initial(0.0, &root),
    }
    .map(|_| ())
}

/// Closes the loops at time zero; joints that are told how to start do so.
fn check_closed(system: &System, root: &BodyMotion) -> Result<(), DynamicsError> {
    let motions = starting(system, root)?;
    Mechanism::of(system).check_starts(&motions)
}

/// Motions of all bodies at time zero.
fn starting(system: &System, root: &BodyMotion) -> Result<Vec<BodyMotion>, DynamicsError> {
    let form = QuaternionForm::new(system.clone(), Stabilization::None);
    let y = form.initial(0.0, root)?;
    let mut motions = vec![BodyMotion::REST; system.bodies().len()];
    form.motions(0.0, &y, &mut form.workspace(), &mut motions)?;
    Ok(motions)
}

/// The same of a setup, counted as in its system.
///
/// # Errors
/// What the dynamics refuses.
pub(crate) fn motions_at_start(setup: &FlightSetup) -> Result<Vec<BodyMotion>, DynamicsError> {
    starting(&system_of(setup)?, &setup.root_at_start())
}

fn quaternion(system: System, root: &BodyMotion) -> Result<Vec<f64>, DynamicsError> {
    QuaternionForm::new(system, Stabilization::None).initial(0.0, root)
}

fn articulated(
    animal: &Animal,
    joints: &[Joint],
    gravity: DVec3,
    units: NaturalUnits,
    law: &WingLaw<'_>,
) -> Result<System, DynamicsError> {
    let bodies = bodies(animal);
    let mut hinges: Vec<Joint> = vec![];
    let mut loops = vec![];
    let first = |child: usize| joints.iter().position(|j| j.child == child);
    for child in 1..bodies.len() {
        let wing = animal.wings.get(child - 1);
        match (first(child), wing) {
            (Some(k), _) => hinges.push(carrying(&joints[k], animal, law)),
            (None, Some(w)) => hinges.push(wing_hinge(w, child, law)),
            (None, None) => {}
        }
    }
    for (k, joint) in joints.iter().enumerate() {
        if closes_loop(joints, k) {
            loops.push(joint.clone());
        }
    }
    System::new(bodies, hinges, gravity, units)?.with_loops(loops)
}

fn bodies(animal: &Animal) -> Vec<Body> {
    let body = |name: &str, mass, sequence| Body {
        name: name.to_owned(),
        mass,
        sequence,
    };
    let mut bodies = vec![body("body", animal.body, EulerSequence::BODY_231)];
    for w in &animal.wings {
        bodies.push(body(&w.name, w.mass, EulerSequence::WING_132));
    }
    for s in &animal.segments {
        bodies.push(body(&s.name, s.mass, EulerSequence::BODY_231));
    }
    bodies
}

fn wing_hinge(wing: &Wing, child: usize, law: &WingLaw<'_>) -> Joint {
    Joint {
        law: Some(law(child - 1, wing)),
        ..Joint::new(&wing.name, Some(0), child, JointType::Weld).at(wing.hinge_b, DVec3::ZERO)
    }
}

/// The joint that carries a body; a wing without a law of its own keeps its motion.
fn carrying(joint: &Joint, animal: &Animal, law: &WingLaw<'_>) -> Joint {
    let index = joint.child.wrapping_sub(1);
    let motion = || animal.wings.get(index).map(|w| law(index, w));
    Joint {
        law: joint.law.clone().or_else(motion),
        ..joint.clone()
    }
}

/// A coordinate along a free direction of a joint, as [`crate::Record::joints`] lists them.
#[derive(Clone, Debug, PartialEq)]
pub struct JointCoordinate {
    /// Name of the joint.
    pub joint: String,
    /// What the joint leaves free.
    pub kind: JointType,
    /// Number of the direction, from 0.
    pub direction: usize,
    /// Directions of the joint.
    pub of: usize,
}

/// The coordinates along the free directions of all joints of a setup, in the order of
/// [`crate::Record::joints`].
///
/// # Errors
/// Bodies or joints that the dynamics refuse.
pub fn joint_coordinates(setup: &FlightSetup) -> Result<Vec<JointCoordinate>, DynamicsError> {
    let mechanism = Mechanism::of(&system_of(setup)?);
    let of = |joint: &Joint| {
        let (name, kind) = (joint.name.clone(), joint.model.kind);
        let of = kind.directions();
        (0..of).map(move |direction| JointCoordinate {
            joint: name.clone(),
            kind,
            direction,
            of,
        })
    };
    Ok(mechanism.joints().iter().flat_map(of).collect())
}

/// Names of the joints that close loops, in the order of [`crate::Record::loops`].
///
/// # Errors
/// Bodies or joints that the dynamics refuse.
pub fn loop_names(setup: &FlightSetup) -> Result<Vec<String>, DynamicsError> {
    let system = system_of(setup)?;
    Ok(system.loops().iter().map(|l| l.name.clone()).collect())
}

/// Natural units: the farthest wing node from its hinge (else the body, else a metre) and the
/// period of a wingbeat (else ten steps).
pub fn natural_units(setup: &FlightSetup) -> NaturalUnits {
    let farthest = |nodes: &[DVec3]| nodes.iter().fold(0.0_f64, |m, r| m.max(r.length()));
    let body = setup.animal.parts.iter().map(|p| farthest(&p.mesh.nodes));
    let wings = setup.animal.wing_reach();
    let length = [wings, body.fold(0.0, f64::max), 1.0];
    NaturalUnits {
        length: length
            .into_iter()
            .find(|l| *l > 0.0)
            .expect("1 is positive"),
        time: setup.time.period.unwrap_or(10.0 * setup.time.step),
    }
}

/// Moves all bodies rigidly with the root so that it moves like `root`; what they do relative to it
/// stays.
pub(crate) fn carry(motions: &mut [BodyMotion], root: &BodyMotion) {
    let old = motions[0];
    motions[0] = *root;
    for m in &mut motions[1..] {
        let back = old.r.transpose();
        let (p, c) = (back * (m.p - old.p), back * m.r);
        let v = back * (m.v - old.v) - old.w.cross(p);
        let w = m.w - c.transpose() * old.w;
        *m = BodyMotion {
            p: root.p + root.r * p,
            r: root.r * c,
            v: root.v + root.r * (root.w.cross(p) + v),
            w: c.transpose() * root.w + w,
        };
    }
}
