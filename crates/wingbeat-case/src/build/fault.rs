//! Faults that name the key they are about.

use serde::Serialize;
use wingbeat_model::ModelError;

use crate::error::Fault;

pub(super) type Built<T> = Result<T, Fault>;

/// A fault of the model traced to the key of the raw table `raw` at `path` it is about.
pub(super) fn fault_at(path: &str, raw: &impl Serialize, error: &ModelError) -> Fault {
    let (named, allowed) = match error {
        ModelError::Value { key, allowed, .. } | ModelError::Count { key, allowed, .. } => {
            (key.as_str(), *allowed)
        }
        _ => ("", ""),
    };
    let stem = named.rsplit('.').next().unwrap_or("");
    let stem = stem.split('[').next().unwrap_or("");
    let matching = |key: &&String| {
        let rest = key.strip_prefix(stem);
        !stem.is_empty() && rest.is_some_and(|r| r.is_empty() || r.starts_with('_'))
    };
    let table = toml::Table::try_from(raw).unwrap_or_default();
    let same = table.keys().find(|key| *key == stem);
    let found = same.or_else(|| table.keys().find(matching));
    let (key, problem) = match found {
        // The case says it in units of its own.
        Some(key) => (format!("{path}.{key}"), format!("must be {allowed}")),
        None => (path.to_owned(), error.to_string()),
    };
    Fault::new(key, problem, allowed, "change this value")
}

/// A key without effect, and why.
pub(super) fn idle(key: impl Into<String>, why: &str) -> Fault {
    Fault::new(
        key,
        format!("this has no effect {why}"),
        "no such key here",
        "remove it",
    )
}
