//! Names of wings and segments: columns of the history are called after them.

use wingbeat_model::Animal;

use super::fault::Built;
use crate::error::Fault;

/// A name as it stands in names of columns: everything but letters and digits is an underscore.
pub fn column_name(name: &str) -> String {
    name.chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
        .collect()
}

/// Each wing and each segment needs columns of its own.
pub(super) fn check(animal: &Animal) -> Built<()> {
    let wings = animal.wings.iter().map(|w| ("wing", &w.name));
    let segments = animal.segments.iter().map(|s| ("segment", &s.name));
    let all: Vec<(&str, &String)> = wings.chain(segments).collect();
    let columns = |(kind, name): (&str, &String)| format!("{kind}_{}", column_name(name));
    // Prescribed angles stand in columns of their own, e.g. `wing_left_prescribed_phi_rad`.
    let alike = |a: &str, b: &str| a == b || format!("{a}_prescribed") == b;
    for (k, second) in all.iter().enumerate() {
        for first in &all[..k] {
            let [a, b] = [*first, *second].map(columns);
            if alike(&a, &b) || alike(&b, &a) {
                return Err(Fault::new(
                    format!("{}.{}", second.0, second.1),
                    format!(
                        "its columns in the history could not be told from those of `{}.{}`",
                        first.0, first.1
                    ),
                    "names that differ in letters or digits, not only in other signs or in `_prescribed`",
                    "give one of the two another name",
                ));
            }
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
