//! Names of wings, segments and joints: columns of the history are called after them.

use std::collections::BTreeMap;

use wingbeat_dynamics::Joint;
use wingbeat_model::{Animal, mirror_name};

use crate::build::fault::Built;
use crate::error::Fault;
use crate::raw::{Case, WingCase};
use crate::text::nearest::nearest;

/// A name as it stands in names of columns: everything but letters and digits is an underscore.
pub fn column_name(name: &str) -> String {
    name.chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
        .collect()
}

/// Characters that names of parts cannot have, beside those that control a terminal or end a line: they have a meaning
/// of their own in the keys of cases (`wing.right.mesh`, `load[0]`, `KEY=VALUE`) and in tables (`,`, quotes).
const RESERVED: &str = ".,=[]'\"";

/// Refuses names of wings, segments, joints, springs and parts that keys, tables and lines to other programs cannot hold.
pub(crate) fn check_characters(case: &Case) -> Built<()> {
    fn named<'a, T>(
        table: &'a str,
        of: &'a BTreeMap<String, T>,
    ) -> impl Iterator<Item = (&'a str, &'a str)> {
        of.keys().map(move |name| (table, name.as_str()))
    }
    let names = named("wing", &case.wing)
        .chain(named("segment", &case.segment))
        .chain(named("joint", &case.joint))
        .chain(named("spring", &case.spring))
        .chain(named("body.part", &case.body.part));
    let is_bad =
        |c: char| c.is_control() || (c.is_whitespace() && c != ' ') || RESERVED.contains(c);
    for (table, name) in names {
        let problem = match name.chars().find(|c| is_bad(*c)) {
            Some(c) => format!("{c:?} cannot stand in the name {name:?}"),
            None if name.trim().is_empty() => "a name is empty".to_owned(),
            None => continue,
        };
        return Err(Fault::new(
            table,
            problem,
            format!("names without {RESERVED} and without line ends, tabs and the like"),
            "name it by letters, digits, - and _, e.g. fore-right",
        ));
    }
    Ok(())
}

/// Each wing and each segment needs columns of its own.
pub(super) fn check(animal: &Animal) -> Built<()> {
    let wings = animal.wings.iter().map(|w| ("wing", &w.name));
    let segments = animal.segments.iter().map(|s| ("segment", &s.name));
    let all: Vec<(&str, &String)> = wings.chain(segments).collect();
    let columns = |(kind, name): (&str, &String)| format!("{kind}_{}", column_name(name));
    // Prescribed angles stand in columns of their own, e.g. `wing_left_prescribed_phi_rad`.
    let alike = |a: &str, b: &str| a == b || format!("{a}_prescribed") == b;
    check_apart(
        &all,
        "not only in other signs or in `_prescribed`",
        |a, b| {
            let [a, b] = [a, b].map(columns);
            alike(&a, &b) || alike(&b, &a)
        },
    )
}

/// Each joint needs columns of its own.
pub(super) fn check_joints(joints: &[Joint]) -> Built<()> {
    let all: Vec<(&str, &String)> = joints.iter().map(|j| ("joint", &j.name)).collect();
    check_apart(&all, "not only in other signs", |a, b| {
        column_name(a.1) == column_name(b.1)
    })
}

/// Refuses names whose columns are `alike`, each of a kind; `how` they have to differ beside letters and digits.
fn check_apart(
    all: &[(&str, &String)],
    how: &str,
    alike: impl Fn((&str, &String), (&str, &String)) -> bool,
) -> Built<()> {
    for (k, second) in all.iter().enumerate() {
        if let Some(first) = all[..k].iter().find(|first| alike(**first, *second)) {
            return Err(Fault::new(
                format!("{}.{}", second.0, second.1),
                format!(
                    "its columns in the history could not be told from those of `{}.{}`",
                    first.0, first.1
                ),
                format!("names that differ in letters or digits, {how}"),
                "give one of the two another name",
            ));
        }
    }
    Ok(())
}

/// Names of all bodies in the order of the system: body, wings, segments.
pub(super) fn body_names(animal: &Animal) -> Vec<&str> {
    let wings = animal.wings.iter().map(|w| w.name.as_str());
    let segments = animal.segments.iter().map(|s| s.name.as_str());
    std::iter::once("body")
        .chain(wings)
        .chain(segments)
        .collect()
}

/// What `key` names is no body among `names`.
pub(super) fn no_body(key: &str, name: &str, names: &[&str]) -> Fault {
    let add = format!("use one of these names, or add [segment.{name}]");
    let held = |n: &&&str| **n != "body" && name.contains(**n);
    let longest = || names.iter().filter(held).max_by_key(|n| n.len()).copied();
    let remedy = match nearest(name, names).or_else(longest) {
        Some(near) => format!("did you mean `{near}`? Or {add}"),
        None => add,
    };
    Fault::new(
        key,
        format!("there is no body `{name}`"),
        names.join(", "),
        remedy,
    )
}

/// Refuses joints of bodies that are not there, before wings ask who carries them.
pub(super) fn check_bodies(case: &Case) -> Built<()> {
    let has_image = |(name, wing): (&String, &WingCase)| {
        let image = mirror_name(name).filter(|_| wing.mirror.unwrap_or(true));
        image.filter(|image| !case.wing.contains_key(image))
    };
    let images = case.wing.iter().filter_map(has_image);
    let mut wings: Vec<String> = case.wing.keys().cloned().chain(images).collect();
    wings.sort();
    let wings = wings.iter().map(String::as_str);
    let segments = case.segment.keys().map(String::as_str);
    let names: Vec<&str> = std::iter::once("body")
        .chain(wings)
        .chain(segments)
        .collect();
    for (joint, of) in &case.joint {
        let parent = of.parent.as_deref().unwrap_or("body");
        for (key, name) in [("parent", parent), ("child", &of.child[..])] {
            if name.is_empty() {
                return Err(Fault::new(
                    format!("joint.{joint}.{key}"),
                    "this key is missing",
                    names.join(", "),
                    "name the body that it carries; a joint of its own of a left wing takes nothing over from that of the right one",
                ));
            }
            if !names.contains(&name) {
                return Err(no_body(&format!("joint.{joint}.{key}"), name, &names));
            }
        }
    }
    Ok(())
}
