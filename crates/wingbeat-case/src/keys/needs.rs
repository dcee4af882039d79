//! Which keys have an effect beside which others.

use toml::{Table, Value};

use super::schema::Shape;
use crate::text::path::find;

/// What a key needs to have an effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Need {
    /// Another key has one of these values, or a list with one of them: `KEY = A | B`.
    Value {
        key: &'static str,
        values: &'static str,
    },
    /// One of other keys is given, and no empty list: `KEY | KEY`.
    Given(&'static str),
    /// Another key is not given: `no KEY`.
    NotGiven(&'static str),
}

/// What the key needs.
pub(super) fn of(shape: Shape) -> Vec<Need> {
    shape.texts("with").into_iter().map(Need::parse).collect()
}

impl Need {
    fn parse(text: &'static str) -> Self {
        match (text.split_once(" = "), text.strip_prefix("no ")) {
            (Some((key, values)), _) => Self::Value { key, values },
            (None, Some(key)) => Self::NotGiven(key),
            (None, None) => Self::Given(text),
        }
    }

    /// Whether it is fulfilled for a key in the table `around`: `root` is the whole case with its
    /// defaults, `given` tells the keys of the table that were given.
    pub fn is_met(self, root: &Table, around: &Table, given: &Table) -> bool {
        match self {
            Self::Value { key, .. } => value_of(key, root, around).is_none_or(|v| self.allows(v)),
            Self::Given(keys) => {
                let is_empty = |v: &Value| v.as_array().is_some_and(Vec::is_empty);
                let given = |key| given.get(key).is_some_and(|v| !is_empty(v));
                keys.split(" | ").any(given)
            }
            Self::NotGiven(key) => !given.contains_key(key),
        }
    }

    fn allows(self, value: &Value) -> bool {
        let Self::Value { values, .. } = self else {
            return false;
        };
        let named = |v: &Value| values.split(" | ").any(|name| v.as_str() == Some(name));
        named(value) || value.as_array().is_some_and(|list| list.iter().any(named))
    }

    /// Whether it is a value of this key.
    pub fn is_value_of(self, path: &str) -> bool {
        matches!(self, Self::Value { key, .. } if key == path)
    }

    /// The path of the key that decides whether one at `path` has an effect; none where several do.
    pub fn chosen_by(self, path: &str) -> Option<String> {
        match self {
            Self::Value { key, .. } if key.contains('.') => Some(key.to_owned()),
            Self::Value { key, .. } => {
                let (around, _) = path.rsplit_once('.')?;
                Some(format!("{around}.{key}"))
            }
            Self::Given(_) | Self::NotGiven(_) => None,
        }
    }

    /// What is wrong with a key that needs this, what is allowed, what to try.
    pub fn explained(self, root: &Table, around: &Table) -> [String; 3] {
        match self {
            Self::Value { key, values } => {
                let value = value_of(key, root, around).map_or(String::new(), Value::to_string);
                [
                    format!("this has no effect with {key} = {value}"),
                    format!("with {key} = {values}"),
                    format!("remove it, or change {key}"),
                ]
            }
            Self::Given(keys) => {
                let keys = keys.replace(" | ", " or ");
                [
                    format!("this has no effect without {keys}"),
                    format!("together with {keys}"),
                    format!("remove it, or give {keys}"),
                ]
            }
            Self::NotGiven(key) => [
                format!("this has no effect beside {key}"),
                format!("without {key}"),
                format!("remove it, or {key}"),
            ],
        }
    }

    /// In words, for the page of keys.
    pub fn in_words(self) -> String {
        match self {
            Self::Value { key, values } => {
                let values: Vec<String> = values.split(" | ").map(|v| format!("`{v}`")).collect();
                format!("with `{key}` = {}", values.join(" or "))
            }
            Self::Given(keys) => {
                let keys: Vec<String> = keys.split(" | ").map(|k| format!("`{k}`")).collect();
                format!("with {}", keys.join(" or "))
            }
            Self::NotGiven(key) => format!("without `{key}`"),
        }
    }
}

/// The value of a key: by its path in the whole case, or by its name in the table around.
fn value_of<'a>(key: &str, root: &'a Table, around: &'a Table) -> Option<&'a Value> {
    match key.contains('.') {
        true => find(root, key),
        false => around.get(key),
    }
}
