//! `[body]`: parts and mass.

use wingbeat_math::DVec3;
use wingbeat_model::build::{BodyMass, fit_body_length};
use wingbeat_model::mesh::revolution::{Profile, Revolution};
use wingbeat_model::{Animal, BodyPart, MassInput, QuadMesh};

use crate::build::fault::{Built, beyond_numbers, fault_at};
use crate::build::numbers::{given_mass, symmetric, vector};
use crate::error::Fault;
use crate::raw::{BodyCase, OriginCase, PartCase, ProfileCase};

/// The body without wings.
pub(crate) fn build(case: &BodyCase) -> Built<Animal> {
    let shapes = shapes(case)?;
    let mut parts = vec![];
    for (name, part) in &case.part {
        let shape = shapes.iter().find(|(n, _)| n == name).map(|(_, s)| s);
        parts.push(build_part(case, name, part, shape)?);
    }
    let mass = mass(case, &parts)?;
    let body = Animal::new("body", mass, parts, vec![]).map_err(|e| fault_at("body", case, &e))?;
    Ok(match case.origin {
        OriginCase::AsGiven => body,
        OriginCase::MassCentre => body.with_origin(body.body.centre()),
    })
}

/// Surfaces of revolution, fitted to the body length.
fn shapes(case: &BodyCase) -> Built<Vec<(String, Revolution)>> {
    let mut shapes = vec![];
    for (name, part) in case.part.iter().filter(|(_, p)| p.nodes_m.is_none()) {
        shapes.push((
            name.clone(),
            revolution(&format!("body.part.{name}"), part)?,
        ));
    }
    let Some(length) = case.length_m else {
        return Ok(shapes);
    };
    if case.part.is_empty() {
        return Err(Fault::new(
            "body.length_m",
            "this body has no parts whose lengths it could be",
            "body.length_m together with parts that have length_m and diameter_m",
            "remove it, or add [body.part.NAME]",
        ));
    }
    if shapes.len() < case.part.len() {
        return Err(Fault::new(
            "body.length_m",
            "only surfaces of revolution can be scaled to a body length",
            "body.length_m together with parts that have length_m and diameter_m",
            "scale mesh files with file_unit_m and leave body.length_m out",
        ));
    }
    for ((name, shape), part) in shapes.iter().zip(case.part.values()) {
        let at = |e| fault_at(&format!("body.part.{name}"), part, &e);
        shape.mesh(name).map_err(at)?;
    }
    let plain: Vec<Revolution> = shapes.iter().map(|(_, s)| s.clone()).collect();
    let fitted = fit_body_length(&plain, length).map_err(|e| fault_at("body", case, &e))?;
    Ok(shapes.into_iter().map(|(n, _)| n).zip(fitted).collect())
}

fn revolution(path: &str, part: &PartCase) -> Built<Revolution> {
    let needed = |key: &str, value: Option<f64>| {
        let missing = || {
            Fault::missing(
                format!("{path}.{key}"),
                "a surface of revolution has length_m and diameter_m; or give file = \"NAME.obj\"",
                format!("add `{key} = ...`"),
            )
        };
        value.ok_or_else(missing)
    };
    let [stations, meridians] = resolution(part);
    Ok(Revolution {
        centre: vector(part.centre_m.unwrap_or_default()),
        direction: vector(part.direction.unwrap_or([1.0, 0.0, 0.0])),
        length: needed("length_m", part.length_m)?,
        radius: 0.5 * needed("diameter_m", part.diameter_m)?,
        profile: profile(part.profile.as_ref()),
        stations,
        meridians,
    })
}

/// Panels along and around a surface of revolution.
pub(crate) fn resolution(part: &PartCase) -> [usize; 2] {
    [part.stations.unwrap_or(6), part.meridians.unwrap_or(8)]
}

fn profile(case: Option<&ProfileCase>) -> Profile {
    match case {
        None | Some(ProfileCase::Ellipsoid) => Profile::Ellipsoid,
        Some(&ProfileCase::Superellipse(exponent)) => Profile::Superellipse { exponent },
        Some(ProfileCase::Table(rows)) => {
            Profile::Table(rows.iter().map(|&[s, r]| (s, r)).collect())
        }
    }
}

fn build_part(
    body: &BodyCase,
    name: &str,
    part: &PartCase,
    shape: Option<&Revolution>,
) -> Built<BodyPart> {
    let path = format!("body.part.{name}");
    let mass = part_mass(body, &path, part)?;
    let found = match (&part.nodes_m, shape) {
        (Some(nodes), _) => BodyPart::new(name, given_mesh(&path, nodes, part)?, &mass),
        (None, Some(shape)) => BodyPart::revolution(name, shape, &mass),
        (None, None) => unreachable!("every part without nodes has a shape"),
    };
    found.map_err(|e| {
        let of_body = beyond_numbers("body", body, &e);
        of_body.unwrap_or_else(|| fault_at(&path, part, &e))
    })
}

fn given_mesh(path: &str, nodes: &[[f64; 3]], part: &PartCase) -> Built<QuadMesh> {
    let quads = part.quads.clone().unwrap_or_default();
    for (k, quad) in quads.iter().enumerate() {
        if let Some(node) = quad.iter().find(|&&n| n >= nodes.len()) {
            return Err(Fault::new(
                format!("{path}.quads[{k}]"),
                format!("there is no node {node}"),
                format!("node numbers 0 to {}", nodes.len().saturating_sub(1)),
                "count nodes from 0 in the order of nodes_m",
            ));
        }
    }
    let nodes: Vec<DVec3> = nodes.iter().map(|&x| DVec3::from_array(x)).collect();
    for (k, quad) in quads.iter().enumerate() {
        let side = |i: usize| [quad[i], quad[(i + 1) % 4]];
        let meets = |s: &[usize; 2]| s[0] != s[1] && nodes[s[0]] == nodes[s[1]];
        if let Some([a, b]) = (0..4).map(side).find(meets) {
            return Err(Fault::new(
                format!("{path}.quads[{k}]"),
                format!("its nodes {a} and {b} coincide, so it has an edge without length"),
                "panels whose corners have places of their own; a triangle names one node twice",
                "use one of the two nodes in all panels and remove the other",
            ));
        }
    }
    Ok(QuadMesh { nodes, quads })
}

fn part_mass(body: &BodyCase, path: &str, part: &PartCase) -> Built<MassInput> {
    match (part.mass_kg, part.density_kg_m3) {
        (Some(m), _) => Ok(MassInput::Total(m)),
        (None, Some(d)) => Ok(MassInput::Density(d)),
        (None, None) if body.inertia_about_centre_kg_m2.is_some() => Ok(MassInput::Density(0.0)),
        (None, None) if body.mass_kg.is_some() => Ok(MassInput::Density(1.0)), // scaled to the total
        (None, None) => Err(Fault::new(
            path,
            "this part has no mass",
            "mass_kg or density_kg_m3 in every part, or mass_kg in [body]",
            "insect tissue has about density_kg_m3 = 1000",
        )),
    }
}

fn mass(case: &BodyCase, parts: &[BodyPart]) -> Built<BodyMass> {
    match (case.mass_kg, case.inertia_about_centre_kg_m2) {
        (None, None) if parts.is_empty() => Err(Fault::new(
            "body.mass_kg",
            "the body has neither mass nor parts",
            "parts with mass, or mass_kg with inertia_about_centre_kg_m2",
            "add [body.part.thorax], or mass_kg and inertia_about_centre_kg_m2",
        )),
        (None, None) => Ok(BodyMass::FromParts),
        (Some(m), None) if parts.is_empty() => Err(Fault::new(
            "body.inertia_about_centre_kg_m2",
            format!("this key is missing: a body of {m} kg without parts needs its inertia"),
            "[xx, yy, zz, xy, xz, yz] in kg m2",
            "estimate it, or give parts",
        )),
        (Some(m), None) => Ok(BodyMass::Total(m)),
        (None, Some(_)) => Err(Fault::new(
            "body.mass_kg",
            "this key is missing: the inertia is given without the mass",
            "mass_kg together with inertia_about_centre_kg_m2",
            "add `mass_kg = ...`",
        )),
        (Some(m), Some(j)) => {
            let centre = vector(case.centre_m.unwrap_or_default());
            let given = given_mass("body", m, centre, symmetric(j))?;
            Ok(BodyMass::Given(given))
        }
    }
}
