//! `[segment.NAME]`: bodies beside the central one and the wings.

use wingbeat_dynamics::Joint;
use wingbeat_math::{DMat3, DVec3, MassProperties};
use wingbeat_model::{Animal, BodyPart, Segment};

use crate::build::fault::Built;
use crate::build::numbers::{given_mass, symmetric, vector};
use crate::error::Fault;
use crate::raw::{Case, SegmentCase};

/// Takes the segments out of the central body.
pub(crate) fn split(case: &Case, animal: &mut Animal) -> Built<()> {
    let lumped = case.body.inertia_about_centre_kg_m2.is_none();
    for (name, segment) in &case.segment {
        let path = format!("segment.{name}");
        check_name(&path, name, animal)?;
        let parts = take_parts(&path, segment, animal)?;
        let mass = mass(&path, segment, &parts, lumped)?;
        let origin = origin(case, animal, name).unwrap_or(DVec3::ZERO);
        let shifted = |m: &MassProperties| m.moved(DMat3::IDENTITY, -origin);
        animal.segments.push(Segment {
            name: name.clone(),
            origin_b: origin,
            mass: shifted(&mass),
            parts: parts.iter().map(|p| p.about(origin)).collect(),
        });
    }
    if lumped && !case.segment.is_empty() {
        let masses = animal.parts.iter().map(|p| p.mass);
        animal.body = masses.fold(MassProperties::ZERO, |a, b| a + b);
    }
    if animal.body.mass <= 0.0 {
        return Err(Fault::new(
            "segment",
            "the segments take all mass from the central body",
            "parts of its own, with mass, for the central body",
            "leave one part out of all segments",
        ));
    }
    Ok(())
}

/// Point of the joint that carries the segment; none of one on a wing, be it given or the mirror image of one.
fn origin(case: &Case, animal: &Animal, name: &str) -> Option<DVec3> {
    let joint = case.joint.values().find(|j| j.child == name)?;
    let on_wing = joint
        .parent
        .as_ref()
        .is_some_and(|p| animal.wings.iter().any(|w| w.name == *p));
    if on_wing {
        None
    } else {
        joint.at_m.map(vector)
    }
}

fn check_name(path: &str, name: &str, animal: &Animal) -> Built<()> {
    if name != "body" && animal.wings.iter().all(|w| w.name != name) {
        return Ok(());
    }
    let problem = "a wing or the central body has this name";
    Err(Fault::new(
        path,
        problem,
        "a name of its own",
        "rename the segment",
    ))
}

fn take_parts(path: &str, segment: &SegmentCase, animal: &mut Animal) -> Built<Vec<BodyPart>> {
    let mut taken = vec![];
    for (k, part) in segment.parts.iter().enumerate() {
        let Some(i) = animal.parts.iter().position(|p| p.name == *part) else {
            let names: Vec<&str> = animal.parts.iter().map(|p| p.name.as_str()).collect();
            return Err(Fault::new(
                format!("{path}.parts[{k}]"),
                "there is no such part left in the central body",
                names.join(", "),
                "use the NAME of a [body.part.NAME], each in one segment at most",
            ));
        };
        taken.push(animal.parts.remove(i));
    }
    Ok(taken)
}

fn mass(path: &str, case: &SegmentCase, parts: &[BodyPart], lumped: bool) -> Built<MassProperties> {
    match (case.mass_kg, case.inertia_about_centre_kg_m2) {
        (None, None) if lumped && !parts.is_empty() => {
            Ok(parts.iter().fold(MassProperties::ZERO, |a, p| a + p.mass))
        }
        (Some(m), Some(j)) => {
            let centre = vector(case.centre_m.unwrap_or_default());
            given_mass(path, m, centre, symmetric(j))
        }
        (None, _) => Err(Fault::new(
            format!("{path}.mass_kg"),
            "this segment has no mass",
            "parts with mass of their own, or mass_kg with inertia_about_centre_kg_m2",
            "add `parts = [...]`, or mass_kg, centre_m and inertia_about_centre_kg_m2",
        )),
        (Some(_), None) => Err(Fault::new(
            format!("{path}.inertia_about_centre_kg_m2"),
            "this key is missing: the mass is given without the inertia",
            "[xx, yy, zz, xy, xz, yz] in kg m2",
            "estimate it, or give parts with mass",
        )),
    }
}

/// Every segment hangs on a joint, and over joints on the central body.
pub(crate) fn check_carried(animal: &Animal, joints: &[Joint]) -> Built<()> {
    let first = animal.wings.len() + 1;
    for (i, segment) in animal.segments.iter().enumerate() {
        let mut at = first + i;
        let mut steps = 0;
        while at >= first {
            let Some(joint) = joints.iter().find(|j| j.child == at) else {
                return Err(loose(&segment.name, "no joint carries this segment"));
            };
            at = joint.parent.unwrap_or(0);
            steps += 1;
            if steps > animal.segments.len() {
                let ring = "the joints of this segment lead round in a ring and not to the body";
                return Err(loose(&segment.name, ring));
            }
        }
    }
    Ok(())
}

fn loose(name: &str, problem: &str) -> Fault {
    Fault::new(
        format!("segment.{name}"),
        format!("the body is disconnected: {problem}"),
        "a chain of joints from every segment to `body`",
        format!("add [joint.NAME] with child = \"{name}\" and at_m"),
    )
}
