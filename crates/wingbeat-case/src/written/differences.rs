//! In which keys two cases differ.

use std::collections::BTreeMap;

use serde::Serialize;
use toml::{Table, Value};

use crate::LoadedCase;
use crate::keys::effective;
use crate::text::source::{in_one_line, table_of};

/// A key that two cases do not have alike.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Path of the key, e.g. `wing.right.mass_kg`.
    pub key: String,
    /// Its value in the first case, shortened; none if it is not there.
    pub first: Option<String>,
    /// Its value in the second case.
    pub second: Option<String>,
}

/// All keys in which two cases differ, in alphabetical order: those of the resolved cases, defaults filled in.
/// A case has no key that another one of its own leaves without effect, as a published set beside coefficients
/// of one's own.
pub fn differences(first: &LoadedCase, second: &LoadedCase) -> Vec<Difference> {
    let [a, b] = [first, second].map(keys);
    let all: BTreeMap<&String, ()> = a.keys().chain(b.keys()).map(|k| (k, ())).collect();
    let differ = all.into_keys().filter(|key| a.get(*key) != b.get(*key));
    let shown = |value: Option<&Value>| value.and_then(in_one_line);
    differ
        .map(|key| Difference {
            key: key.clone(),
            first: shown(a.get(key)),
            second: shown(b.get(key)),
        })
        .collect()
}

fn keys(case: &LoadedCase) -> BTreeMap<String, Value> {
    let mut keys = BTreeMap::new();
    let table = table_of(&case.raw);
    gather("", effective(&table, &table), &mut keys);
    keys
}

fn gather(path: &str, table: Table, keys: &mut BTreeMap<String, Value>) {
    for (key, value) in table {
        let here = match path {
            "" => key,
            _ => format!("{path}.{key}"),
        };
        match value {
            Value::Table(inner) => gather(&here, inner, keys),
            value => {
                keys.insert(here, value);
            }
        }
    }
}
