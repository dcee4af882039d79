//! `[body]` and `[wing.NAME]`.

use wingbeat_flight::{AirModel, FlightSetup};
use wingbeat_math::MassProperties;
use wingbeat_model::{Animal, BodyPart, Wing, mirror_name};

use super::motion;
use super::refusal::{Written, no_keys, same};
use crate::raw::{
    AnimalCase, BodyCase, Case, PartCase, PlanformCase, StructureCase, WingCase, WingInertia,
};

/// The animal by its meshes and masses. Segments and the body they are parts of stay what they are in the case.
pub(super) fn write(case: &mut Case, animal: &Animal, old: Option<&FlightSetup>) -> Written<()> {
    let Animal {
        name: _, // that of the case
        body,
        parts,
        wings,
        segments,
    } = animal;
    check_order(wings)?;
    check_scale(case)?;
    if segments.is_empty() {
        case.segment.clear();
        case.body = body_case(body, parts);
    } else {
        let kept = old.is_some_and(|old| {
            let before = &old.animal;
            same(&before.segments, segments) && same(&before.parts, parts) && before.body == *body
        });
        if !kept {
            let problem = "they or the body were made or changed in Rust, and only those of a case are written";
            return Err(no_keys("segments", problem, "give them in the case"));
        }
    }
    case.animal = AnimalCase { scale: 1.0 };
    case.dynamics.wings = WingInertia::Massive; // masses are written as they are
    case.motion = motion::shared(animal)?;
    case.wing = wings
        .iter()
        .map(|w| (w.name.clone(), wing_case(w, wings)))
        .collect();
    Ok(())
}

/// What stands beside the animal is scaled with it.
fn check_scale(case: &Case) -> Written<()> {
    let beside = case.segment.len() + case.joint.len() + case.spring.len() + case.load.len();
    if case.animal.scale == 1.0 || beside == 0 {
        return Ok(());
    }
    let problem = "segments, joints, springs and loads of the case are scaled by animal.scale";
    Err(no_keys("animal", problem, "begin with a case of scale 1"))
}

/// Wings are counted in the order of their names.
fn check_order(wings: &[Wing]) -> Written<()> {
    let Some(pair) = wings.windows(2).find(|w| w[0].name >= w[1].name) else {
        return Ok(());
    };
    let problem = format!(
        "wing `{}` stands after wing `{}`, and a case counts wings in the order of their names",
        pair[1].name, pair[0].name
    );
    let remedy = "sort the wings of the animal by their names, no two alike";
    Err(no_keys("order of the wings", problem, remedy))
}

/// Mass, mass centre and the inertia about it.
fn mass(of: &MassProperties) -> (f64, Option<[f64; 3]>, Option<[f64; 6]>) {
    if of.mass == 0.0 {
        return (0.0, None, None);
    }
    let j = of.inertia_about_centre();
    let j = |i: usize, k: usize| j.col(k)[i];
    let inertia = [j(0, 0), j(1, 1), j(2, 2), j(0, 1), j(0, 2), j(1, 2)];
    (of.mass, Some(of.centre().to_array()), Some(inertia))
}

fn body_case(body: &MassProperties, parts: &[BodyPart]) -> BodyCase {
    let (mass_kg, centre_m, inertia_about_centre_kg_m2) = mass(body);
    let part = |part: &BodyPart| {
        let surface = PartCase {
            nodes_m: Some(part.mesh.nodes.iter().map(|x| x.to_array()).collect()),
            quads: Some(part.mesh.quads.clone()),
            ..PartCase::default()
        };
        (part.name.clone(), surface)
    };
    BodyCase {
        mass_kg: Some(mass_kg),
        centre_m,
        inertia_about_centre_kg_m2,
        part: parts.iter().map(part).collect(),
        ..BodyCase::default()
    }
}

fn wing_case(wing: &Wing, all: &[Wing]) -> WingCase {
    let Wing {
        name,
        side,
        hinge_b,
        mesh,
        mass: properties,
        motion,
        deformation,
        structure,
    } = wing;
    let (mass_kg, centre_m, inertia_about_centre_kg_m2) = mass(properties);
    let (mass_kg, centre_m, inertia_about_centre_kg_m2) = match structure {
        None => (Some(mass_kg), centre_m, inertia_about_centre_kg_m2),
        Some(own) if super::structure::has_mass(own) => (None, None, None),
        Some(_) => (Some(mass_kg), None, None),
    };
    let nodes = mesh.nodes.chunks(mesh.cols + 1);
    let row = |row: &[wingbeat_math::DVec3]| row.iter().map(|x| x.to_array()).collect();
    let counterpart = mirror_name(name);
    let other = (counterpart.as_ref()).and_then(|other| all.iter().find(|w| w.name == *other));
    let alone = counterpart.is_some() && other.is_none();
    let structure = match structure {
        Some(structure) => Some(super::structure::case(structure)),
        // It would be taken from the other one.
        None => other
            .filter(|w| w.structure.is_some())
            .map(|_| StructureCase {
                rigid: true,
                ..StructureCase::default()
            }),
    };
    WingCase {
        side: Some(*side),
        mirror: alone.then_some(false),
        hinge_m: Some(hinge_b.to_array()),
        planform: Some(PlanformCase::NodesM(nodes.map(row).collect())),
        mesh: None,
        mass_kg,
        areal_density_kg_m2: None,
        areal_density_table_m_kg_m2: None,
        centre_m,
        inertia_about_centre_kg_m2,
        motion: Some(motion::own(motion)),
        deformation: deformation.as_ref().map(motion::deformation),
        structure,
        joined: None,
    }
}

/// Which wings share the edge at their roots with another one.
pub(super) fn join(case: &mut Case, animal: &Animal, air: &AirModel) {
    let (roots, tips) = match air {
        AirModel::VortexLattice(options) => (&options.joined[..], &options.joined_tips[..]),
        _ => (&[][..], &[][..]),
    };
    for (name, wing) in &mut case.wing {
        let number = animal.wings.iter().position(|w| w.name == *name);
        let is_joined = number.is_some_and(|k| {
            roots.iter().any(|pair| pair.contains(&k)) || tips.iter().any(|pair| pair[1] == k)
        });
        wing.joined = is_joined.then_some(true);
    }
}
