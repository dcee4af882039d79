//! `[joint.NAME]`: who hangs on whom, what is prescribed, what is free.

use std::sync::Arc;

use wingbeat_dynamics::{DynamicsError, Joint, JointModel, JointType};
use wingbeat_flight::joints::{AxisTurn, Path};
use wingbeat_flight::{DriftingFourier, FlightSetup};
use wingbeat_math::DVec3;
use wingbeat_model::{Animal, mirror_name};

use crate::build::animal::{segment, wing};
use crate::build::fault::Built;
use crate::build::flight::mechanics::bends;
use crate::build::joints::element;
use crate::build::joints::mirrored::{check_halves, mirrored};
use crate::build::names::{body_names, check_joints, no_body};
use crate::build::numbers::vector;
use crate::error::Fault;
use crate::raw::{Case, JointCase, JointKind, TravelCase, TurnCase, WingInertia};

/// All joints, those mirrored to left wings among them.
pub(crate) fn build_all(case: &Case, animal: &Animal) -> Built<Vec<Joint>> {
    check_scale(case)?;
    check_halves(case)?;
    let mut joints = vec![];
    for (name, joint) in &case.joint {
        let carries = carries(case, joint);
        joints.push(build(case, animal, name, joint, carries)?);
        if let Some((name, image)) = mirrored(case, animal, name, joint)? {
            joints.push(build(case, animal, &name, &image, carries)?);
        }
    }
    segment::check_carried(animal, &joints)?;
    check_joints(&joints)?;
    Ok(joints)
}

/// What has no law of size is not scaled.
fn check_scale(case: &Case) -> Built<()> {
    if case.animal.scale == 1.0 {
        return Ok(());
    }
    let (what, tables) = match (case.joint.is_empty(), case.spring.is_empty()) {
        (true, true) => return Ok(()),
        (false, _) => ("joints", "[joint.*]"),
        (true, false) => ("springs between points", "[spring.*]"),
    };
    Err(Fault::new(
        "animal.scale",
        format!("an animal with {what} is not scaled: springs have no common law of size"),
        format!("1 with {tables}"),
        "give masses, sizes and springs of the animal in its own size",
    ))
}

/// A joint that carries its child or closes a loop.
fn build(
    case: &Case,
    animal: &Animal,
    name: &str,
    joint: &JointCase,
    carries: bool,
) -> Built<Joint> {
    let path = format!("joint.{name}");
    let bodies = bodies(animal, &path, joint)?;
    check_hinge(case, animal, &path, joint, bodies)?;
    check_carrier(animal, &path, bodies)?;
    let (anchor_parent, anchor_child) = anchors(case, animal, &path, (joint, carries), bodies)?;
    check_turn(animal, &path, joint, bodies)?;
    let frequency = case.motion.frequency_hz.value();
    let law = match &joint.turn {
        Some(t) => Some(Arc::new(turn(&path, t, frequency)?) as _),
        None => None,
    };
    let [parent, child] = bodies;
    Ok(Joint {
        name: name.to_owned(),
        parent: Some(parent),
        child,
        anchor_parent,
        anchor_child,
        law,
        model: model(&path, joint, frequency)?,
    })
}

/// Parent and child.
fn bodies(animal: &Animal, path: &str, joint: &JointCase) -> Built<[usize; 2]> {
    let parent = joint.parent.as_deref().unwrap_or("body");
    let parent = find(animal, path, "parent", parent)?;
    let child = find(animal, path, "child", &joint.child)?;
    let problem = match child {
        0 => "the central body is carried by nothing",
        _ if parent == child => "a body cannot hang on itself",
        _ => return Ok([parent, child]),
    };
    Err(Fault::new(
        format!("{path}.child"),
        problem,
        "a wing or a segment, another body than the parent",
        "exchange parent and child",
    ))
}

/// What is free at the joint, what acts along it, and how it starts.
fn model(path: &str, joint: &JointCase, frequency: f64) -> Built<JointModel> {
    let mut model = JointModel::new(kind(path, joint)?);
    let travel = joint.travel.as_ref().map(|t| travel(t, frequency));
    model.travel = travel.map(|t| Arc::new(t) as _);
    model.elements = element::build_all(path, joint, frequency)?;
    [model.coordinates, model.rates] = start(path, joint)?;
    Ok(model)
}

fn find(animal: &Animal, path: &str, key: &str, name: &str) -> Built<usize> {
    let names = body_names(animal);
    let found = names.iter().position(|n| *n == name);
    found.ok_or_else(|| no_body(&format!("{path}.{key}"), name, &names))
}

/// A wing has one hinge: a joint that carries it from another body than a wing is there.
fn check_hinge(
    case: &Case,
    animal: &Animal,
    path: &str,
    joint: &JointCase,
    [parent, child]: [usize; 2],
) -> Built<()> {
    let on_wing = (1..=animal.wings.len()).contains(&parent);
    let wing = animal.wings.get(child - 1).filter(|_| !on_wing);
    let (Some(at), Some(wing)) = (joint.at_m.map(vector), wing) else {
        return Ok(());
    };
    let hinge = wing.hinge_b;
    if at.distance(hinge) <= 1e-9 * hinge.length() {
        return Ok(());
    }
    let key = format!("wing.{}.hinge_m", wing::source_of(case, &wing.name));
    Err(Fault::new(
        format!("{path}.at_m"),
        format!(
            "this is another place than the hinge of wing `{}`, about which it turns",
            wing.name
        ),
        format!("the place of {key}: {:?}", hinge.to_array()),
        format!("remove at_m, or correct {key}"),
    ))
}

/// An elastic wing carries nothing.
fn check_carrier(animal: &Animal, path: &str, [parent, _]: [usize; 2]) -> Built<()> {
    let carrier = parent.checked_sub(1).and_then(|k| animal.wings.get(k));
    match carrier.filter(|w| w.structure.is_some()) {
        Some(wing) => Err(bends(
            format!("{path}.parent"),
            &wing.name,
            "what a joint carries",
        )),
        None => Ok(()),
    }
}

/// Wings turn by their own motion.
fn check_turn(animal: &Animal, path: &str, joint: &JointCase, [_, child]: [usize; 2]) -> Built<()> {
    if child > animal.wings.len() || joint.turn.is_none() {
        return Ok(());
    }
    Err(Fault::new(
        format!("{path}.turn"),
        "the rotation of a wing is prescribed by its motion",
        format!(
            "no `turn` at the joint of a wing; [wing.{}.motion] instead",
            joint.child
        ),
        "remove it",
    ))
}

/// Joint point on parent and child. On a wing it is given in wing axes from its hinge.
fn anchors(
    case: &Case,
    animal: &Animal,
    path: &str,
    (joint, carries): (&JointCase, bool),
    [parent, child]: [usize; 2],
) -> Built<(DVec3, DVec3)> {
    let wings = animal.wings.len();
    let wing = |i: usize| (1..=wings).contains(&i).then(|| &animal.wings[i - 1]);
    let own = wing(child)
        .filter(|_| wing(parent).is_none())
        .map(|w| w.hinge_b);
    let at = joint.at_m.map(vector).or(own).ok_or_else(|| {
        Fault::missing(
            format!("{path}.at_m"),
            "the joint point in body axes in the reference configuration; on a wing in wing axes",
            "add `at_m = [..., ..., ...]`",
        )
    })?;
    let origin = |i: usize| match i {
        0 => DVec3::ZERO,
        i if i <= wings => DVec3::ZERO,
        i => animal.segments[i - wings - 1].origin_b,
    };
    let names = body_names(animal);
    let frames = [parent, child].map(|i| frame(case, animal, names[i]));
    let on_child = match joint.at_child_m.map(vector) {
        _ if wing(child).is_some() || carries && wing(parent).is_some() => DVec3::ZERO,
        Some(given) => given - origin(child),
        None if frames[0] == frames[1] => at - origin(child),
        None if frames[1].is_some() => DVec3::ZERO,
        None => {
            return Err(Fault::new(
                format!("{path}.at_child_m"),
                format!(
                    "this key is missing: `{}` moves with a wing, in whose axes at_m is, and `{}` does not",
                    names[parent], names[child]
                ),
                "the joint point on the child in body axes",
                "add `at_child_m = [..., ..., ...]`",
            ));
        }
    };
    Ok((at - origin(parent), on_child))
}

/// Whether this joint carries its child, and does not close a loop: the first joint of a child does.
pub(crate) fn carries(case: &Case, joint: &JointCase) -> bool {
    let first = case.joint.values().find(|j| j.child == joint.child);
    first.is_none_or(|first| first.parent == joint.parent)
}

/// The body on a wing, or the wing, whose axes and origin the points of the body `name` are given in; none of
/// body axes.
fn frame(case: &Case, animal: &Animal, name: &str) -> Option<String> {
    let is_wing = |name: &str| animal.wings.iter().any(|w| w.name == name);
    let carrier = |name: &str| case.joint.values().find(|j| j.child == name);
    let mut body = name.to_owned();
    // No chain is longer than there are joints.
    for _ in 0..=case.joint.len() {
        if is_wing(&body) {
            return Some(body);
        }
        // Mirror images are carried as what they are images of.
        let image = || mirror_name(&body).and_then(|other| carrier(&other));
        match carrier(&body).or_else(image)?.parent.as_deref()? {
            parent if is_wing(parent) => return Some(body),
            parent => body = parent.to_owned(),
        }
    }
    None
}

fn unit(key: &str, v: [f64; 3]) -> Built<DVec3> {
    vector(v).try_normalize().ok_or_else(|| {
        Fault::new(
            key,
            "an axis needs a direction",
            "three numbers, not all zero",
            "[0, 1, 0]",
        )
    })
}

fn kind(path: &str, joint: &JointCase) -> Built<JointType> {
    Ok(match joint.kind {
        JointKind::Weld => JointType::Weld,
        JointKind::Spherical => JointType::Spherical,
        JointKind::Revolute => JointType::Revolute {
            axis: axis(path, joint)?,
        },
        JointKind::Prismatic => JointType::Prismatic {
            axis: axis(path, joint)?,
        },
        JointKind::PointOnLine => JointType::PointOnLine {
            axis: axis(path, joint)?,
        },
        JointKind::Universal => JointType::Universal {
            axes: axes(path, joint)?,
        },
    })
}

fn axis(path: &str, joint: &JointCase) -> Built<DVec3> {
    let key = format!("{path}.axis");
    match joint.axis {
        Some(axis) => unit(&key, axis),
        None => Err(Fault::missing(
            key,
            "a direction [x, y, z]",
            "axis = [0, 1, 0]",
        )),
    }
}

fn axes(path: &str, joint: &JointCase) -> Built<[DVec3; 2]> {
    let key = format!("{path}.axes");
    let bad = |problem, remedy| Fault::new(&key, problem, "two perpendicular directions", remedy);
    let Some([a, b]) = joint.axes else {
        return Err(bad("this key is missing", "axes = [[0, 1, 0], [0, 0, 1]]"));
    };
    let axes = [unit(&key, a)?, unit(&key, b)?];
    match axes[0].dot(axes[1]).abs() > 1e-9 {
        true => Err(bad("the axes are not perpendicular", "turn one")),
        false => Ok(axes),
    }
}

fn turn(path: &str, case: &TurnCase, frequency: f64) -> Built<AxisTurn> {
    let radians = |list: &Vec<f64>| list.iter().map(|a| a.to_radians()).collect();
    Ok(AxisTurn {
        axis: unit(&format!("{path}.turn.axis"), case.axis)?,
        angle: DriftingFourier::periodic(
            case.mean_deg.to_radians(),
            case.frequency_hz.unwrap_or(frequency),
            [&case.cosine_deg, &case.sine_deg].map(radians),
        ),
    })
}

fn travel(case: &TravelCase, frequency: f64) -> Path {
    let frequency = case.frequency_hz.unwrap_or(frequency);
    Path(std::array::from_fn(|i| {
        let along = |list: &Vec<[f64; 3]>| list.iter().map(|v| v[i]).collect();
        DriftingFourier::periodic(0.0, frequency, [&case.cosine_m, &case.sine_m].map(along))
    }))
}

/// Coordinates and rates at the start.
fn start(path: &str, joint: &JointCase) -> Built<[Vec<f64>; 2]> {
    let radians = |list: &Option<Vec<f64>>| -> Vec<f64> {
        list.iter().flatten().map(|a| a.to_radians()).collect()
    };
    let one = |x: Option<f64>| x.into_iter().collect::<Vec<f64>>();
    if joint.kind == JointKind::Prismatic {
        return Ok([one(joint.start_m), one(joint.start_m_s)]);
    }
    let directions = match joint.kind {
        JointKind::Revolute => 1,
        JointKind::Universal => 2,
        JointKind::Spherical => 3,
        _ => 0,
    };
    let starts = [radians(&joint.start_deg), radians(&joint.start_deg_s)];
    for (key, list) in ["start_deg", "start_deg_s"].iter().zip(&starts) {
        if list.len() > directions {
            return Err(Fault::new(
                format!("{path}.{key}"),
                format!("this joint has {directions} free angles"),
                format!("at most {directions} numbers"),
                "remove the others",
            ));
        }
    }
    let turn = starts[0].iter().map(|a| a * a).sum::<f64>().sqrt();
    if joint.kind == JointKind::Spherical && turn > std::f64::consts::PI {
        return Err(Fault::new(
            format!("{path}.start_deg"),
            format!(
                "a turn by {:.6} degrees, which is the same as one by {:.6} the other way",
                turn.to_degrees(),
                360.0 - turn.to_degrees()
            ),
            "rotation vectors up to 180 degrees long",
            "give the shorter turn",
        ));
    }
    Ok(starts)
}

/// The key of what the dynamics finds wrong with the joints.
pub(crate) fn fault_of(case: &Case, setup: &FlightSetup, error: &DynamicsError) -> Fault {
    let (key, remedy) = match error {
        DynamicsError::BadJoint { joint, .. } => (key_of(case, joint), "correct this joint"),
        DynamicsError::NotTheStart { joint, is_rate, .. } => (
            key_of_start(case, joint, *is_rate),
            "give what the loops ask for, or leave it out; the first joints of a loop lead, and the others follow",
        ),
        DynamicsError::NotAssembled { joint, .. } => (
            key_of(case, joint),
            "check at_m and axes of the joints of the loop: they hold in the reference configuration",
        ),
        DynamicsError::Loop { joint, .. } => (
            key_of(case, joint),
            "remove dynamics.formulation, or set it to \"quaternion\"",
        ),
        DynamicsError::NotInEulerForm { .. } => (
            "dynamics.formulation".to_owned(),
            "remove dynamics.formulation, or set it to \"momentum\"",
        ),
        DynamicsError::Contradiction { joints, .. } => (
            key_among(case, joints),
            "remove one of these joints, or make them agree",
        ),
        DynamicsError::Redundant { joints, .. } => (
            key_among(case, joints),
            "close planar loops with kind = \"point_on_line\"",
        ),
        DynamicsError::NotATree { body, .. } | DynamicsError::Disconnected { body, .. } => (
            key_of_body(setup, body),
            "let every chain of joints begin at the body",
        ),
        DynamicsError::NotFinite { .. } if goes_far_in_a_step(setup) => (
            "flight.velocity_m_s".to_owned(),
            "fly slower, or take smaller steps: in one the flyer goes farther than ten of its wings are long; units are part of the keys",
        ),
        DynamicsError::SingularMechanism { .. } | DynamicsError::SingularInertia { .. }
            if case.dynamics.wings == WingInertia::Massless =>
        {
            (
                "dynamics.wings".to_owned(),
                "leave out dynamics.wings = \"massless\": a wing that a joint leaves free moves by its inertia",
            )
        }
        DynamicsError::SingularInertia { .. } => match case.body.inertia_about_centre_kg_m2 {
            Some(_) => (
                "body.inertia_about_centre_kg_m2".to_owned(),
                "give principal moments above 0",
            ),
            None => (
                "body".to_owned(),
                "give body and wings extent: parts with length and diameter, or moments of inertia above 0",
            ),
        },
        DynamicsError::NotFinite { .. } => (
            "time".to_owned(),
            "take smaller steps, and check speeds, masses and stiffnesses: units are part of the keys",
        ),
        _ => ("joint".to_owned(), "correct the joints of the animal"),
    };
    Fault::new(key, error.to_string(), "", remedy)
}

/// Whether the flyer starts so fast that its steps are no way to follow it.
fn goes_far_in_a_step(setup: &FlightSetup) -> bool {
    let way = setup.root_at_start().v.length() * setup.time.step;
    way > 10.0 * setup.animal.wing_reach() && way > 0.0
}

/// The table of a joint, or of that of which it is the mirror image; all joints where the case has none of this
/// name.
pub(crate) fn key_of(case: &Case, joint: &str) -> String {
    let names = [Some(joint.to_owned()), mirror_name(joint)];
    let mut names = names.into_iter().flatten();
    let known = names.find(|name| case.joint.contains_key(name));
    known.map_or("joint".to_owned(), |name| format!("joint.{name}"))
}

/// The key of a joint's start; its table where its mirror image has the joint.
fn key_of_start(case: &Case, name: &str, is_rate: bool) -> String {
    let keys = match case.joint.get(name) {
        None => return key_of(case, name),
        Some(joint) if joint.kind == JointKind::Prismatic => ["start_m", "start_m_s"],
        Some(_) => ["start_deg", "start_deg_s"],
    };
    format!("joint.{name}.{}", keys[usize::from(is_rate)])
}

/// The table of the last joint of the case among `names`, each between backticks.
fn key_among(case: &Case, names: &str) -> String {
    let all = names.split('`').skip(1).step_by(2);
    let known = all.filter(|n| case.joint.contains_key(*n)).last();
    known.map_or("joint".to_owned(), |name| key_of(case, name))
}

/// The table of a segment or wing.
fn key_of_body(setup: &FlightSetup, body: &str) -> String {
    let is_segment = setup.animal.segments.iter().any(|s| s.name == body);
    let table = if is_segment { "segment" } else { "wing" };
    format!("{table}.{body}")
}
