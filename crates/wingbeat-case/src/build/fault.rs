//! Faults that name the key they are about.

use serde::Serialize;
use wingbeat_math::MassError;
use wingbeat_model::ModelError;

use crate::error::Fault;
use crate::text::source::table_of;

pub(super) type Built<T> = Result<T, Fault>;

/// A fault of the model traced to the key of the raw table `raw` at `path` it is about.
pub(super) fn fault_at(path: &str, raw: &impl Serialize, error: &ModelError) -> Fault {
    if let Some(fault) = beyond_numbers(path, raw, error) {
        return fault;
    }
    let (named, allowed) = match error {
        ModelError::Value { key, allowed, .. } => (key.as_str(), allowed.as_ref()),
        ModelError::Count { key, allowed, .. } => (key.as_str(), *allowed),
        _ => ("", ""),
    };
    let stem = named.rsplit('.').next().unwrap_or("");
    let stem = stem.split('[').next().unwrap_or("");
    let matching = |key: &&String| {
        let rest = key.strip_prefix(stem);
        !stem.is_empty() && rest.is_some_and(|r| r.is_empty() || r.starts_with('_'))
    };
    let table = table_of(raw);
    let same = table.keys().find(|key| *key == stem);
    let found = same.or_else(|| table.keys().find(matching));
    let (key, problem) = match found {
        // The case says it in units of its own.
        Some(key) => (format!("{path}.{key}"), format!("must be {allowed}")),
        None => (path.to_owned(), error.to_string()),
    };
    Fault::new(key, problem, allowed, "change this value")
}

/// Powers of ten beyond which a number may make masses and moments that are none: nothing that flies has such sizes.
const EXTREME: f64 = 30.0;

/// A fault of masses that are no numbers at the key of `raw` at `path` whose own number is the most extreme; none of
/// other errors, and where no number is.
pub(super) fn beyond_numbers(
    path: &str,
    raw: &impl Serialize,
    error: &ModelError,
) -> Option<Fault> {
    let ModelError::Mass { of, source } = error else {
        return None;
    };
    match source {
        MassError::NotFinite => {}
        MassError::Mass(mass) if !mass.is_finite() => {}
        _ => return None,
    }
    let (powers, key) = most_extreme(path.to_owned(), &toml::Value::Table(table_of(raw)))?;
    (powers > EXTREME).then(|| {
        Fault::new(
            key,
            format!("with it mass or inertia of `{of}` is beyond all numbers"),
            "sizes in metres and kilograms that some body has",
            "check its unit and its power of ten",
        )
    })
}

/// The key of the number of a case that is farthest from 1, where nothing that flies has such a one.
pub(super) fn extreme_key(case: &impl Serialize) -> Option<String> {
    let table = toml::Table::try_from(case).ok()?;
    let (powers, key) = most_extreme(String::new(), &toml::Value::Table(table))?;
    (powers > EXTREME).then(|| key.trim_start_matches('.').to_owned())
}

/// The number that is farthest from 1 in powers of ten, with its key.
fn most_extreme(key: String, value: &toml::Value) -> Option<(f64, String)> {
    let farther = |a: (f64, String), b: (f64, String)| if b.0 > a.0 { b } else { a };
    match value {
        toml::Value::Float(x) if *x != 0.0 => Some((x.abs().log10().abs(), key)),
        toml::Value::Array(all) => {
            let all = all.iter().filter_map(|v| most_extreme(key.clone(), v));
            all.reduce(farther)
        }
        toml::Value::Table(all) => {
            let all = all.iter();
            let all = all.filter_map(|(k, v)| most_extreme(format!("{key}.{k}"), v));
            all.reduce(farther)
        }
        _ => None,
    }
}

/// A key without effect, why, and beside what it has one.
pub(super) fn idle(key: impl Into<String>, why: &str, acts: &str) -> Fault {
    Fault::new(
        key,
        format!("this has no effect {why}"),
        acts,
        "remove it, or give what it acts on",
    )
}
