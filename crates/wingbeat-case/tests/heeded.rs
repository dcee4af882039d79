//! No key that is accepted leaves the setup as it was.

use std::path::Path;

use toml::Value;
use wingbeat_case::LoadedCase;

use crate::idle::{BLADE, JOINT, SEGMENT, VACUUM, load};

/// Paths and values of all numbers and switches of a document.
fn leaves(path: &str, value: &Value, out: &mut Vec<(String, Value)>) {
    let join = |key: &str| match path {
        "" => key.to_owned(),
        path => format!("{path}.{key}"),
    };
    match value {
        Value::Table(t) => t.iter().for_each(|(k, v)| leaves(&join(k), v, out)),
        Value::Array(a) => {
            let item = |(k, v): (usize, &Value)| leaves(&format!("{path}[{k}]"), v, out);
            a.iter().enumerate().for_each(item);
        }
        Value::Integer(_) | Value::Float(_) | Value::Boolean(_) => {
            out.push((path.to_owned(), value.clone()));
        }
        _ => {}
    }
}

/// Another value.
fn other(value: &Value) -> String {
    match value {
        Value::Integer(n) => (n + 1).to_string(),
        Value::Float(x) if *x == 0.0 => "0.125".to_owned(),
        Value::Float(x) => format!("{:?}", 0.75 * x),
        Value::Boolean(b) => (!b).to_string(),
        other => unreachable!("{other}"),
    }
}

/// Every number and switch of a resolved case either changes the setup or is refused when it is
/// changed, but for those of the air models that are not flown.
#[test]
fn exact_no_number_of_a_case_is_passed_over() {
    let lattice = [
        "air.body",
        "air.mirror",
        "air.bound_core",
        "air.wake_core",
        "air.wake_overlap",
        "air.clearance_m",
        "air.summation_tolerance",
    ];
    let vacuum = ["air.density_kg_m3", "air.stream_m_s"];
    let loads = "load=[{ force_newton = [1e-6, 0, 0], point_m = [1e-3, 0, 0], couple_newton_m = [1e-9, 0, 0] }]";
    for (model, unused) in [
        ("air.model=vortex_lattice", vec![]),
        (BLADE, lattice.to_vec()),
        (VACUUM, [&lattice[..], &vacuum].concat()),
    ] {
        for mode in ["free", "tethered"] {
            let mode = format!("flight.mode={mode}");
            let spring = "joint.tail.element=[{ stiffness_newton_m_per_rad = 1e-9, rest_deg = 3 }]";
            let hinge = [
                "joint.tail.kind=revolute",
                "joint.tail.axis=[0.5, 1, 0.25]",
                spring,
            ];
            let set = [model, mode.as_str(), loads, SEGMENT, JOINT];
            let case = load(&[&set[..], &hinge].concat()).unwrap();
            let resolved = case.resolved();
            let mut all = vec![];
            let document = Value::Table(resolved.parse().unwrap());
            leaves("", &document, &mut all);
            assert!(all.len() > 60, "{}", all.len());
            let seen = |c: &LoadedCase| format!("{:?} {:?}", c.setup, c.output);
            let before = seen(&case);
            for (path, value) in all {
                let set = [format!("{path}={}", other(&value))];
                let changed = LoadedCase::from_text("idle", &resolved, Path::new(""), &set);
                let ignored = changed.is_ok_and(|c| seen(&c) == before);
                let is_unused = unused.iter().any(|u| path.starts_with(u));
                assert!(
                    !ignored || is_unused,
                    "{model}, {mode}: {} has no effect",
                    set[0]
                );
            }
        }
    }
}
