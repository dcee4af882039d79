//! The JSON schema of case files.

use std::sync::LazyLock;

use serde_json::{Map, Value};

use crate::raw::Case;

static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    let mut schema = schemars::schema_for!(Case).to_value();
    without_null(&mut schema);
    schema
});

/// Name of the file with the schema, beside the cases that [`with_schema`] names it in.
pub const SCHEMA_FILE: &str = "wingbeat.schema.json";

/// A case whose first line names its schema, as taplo and the editors that use it read it: the file
/// [`SCHEMA_FILE`] beside the case, so that no network is needed.
pub fn with_schema(case: &str) -> String {
    format!("#:schema ./{SCHEMA_FILE}\n{case}")
}

/// The JSON schema of case files, for editors.
pub fn schema() -> String {
    serde_json::to_string_pretty(&*SCHEMA).expect("a schema is JSON")
}

/// TOML has no null: a key that may be left out is left out.
fn without_null(schema: &mut Value) {
    match schema {
        Value::Object(map) => {
            if let Some(Value::Array(kinds)) = map.get_mut("type") {
                kinds.retain(|k| k != "null");
                if let [one] = kinds.as_slice() {
                    let one = one.clone();
                    map.insert("type".to_owned(), one);
                }
            }
            if let Some(Value::Array(shapes)) = map.get_mut("anyOf") {
                shapes.retain(|s| s["type"] != "null");
                if let [Value::Object(one)] = shapes.as_slice() {
                    let one = one.clone();
                    map.remove("anyOf");
                    map.extend(one);
                }
            }
            map.retain(|name, value| name != "default" || !value.is_null());
            map.values_mut().for_each(without_null);
        }
        Value::Array(items) => items.iter_mut().for_each(without_null),
        _ => {}
    }
}

/// Whether a value of the schema and one of a case are the same.
fn is_same(a: &Value, b: &toml::Value) -> bool {
    match b {
        toml::Value::Integer(n) => a.as_f64() == Some(*n as f64),
        toml::Value::Float(x) => a.as_f64() == Some(*x),
        toml::Value::Array(items) => a.as_array().is_some_and(|list| {
            list.len() == items.len() && list.iter().zip(items).all(|(a, b)| is_same(a, b))
        }),
        toml::Value::String(text) => a.as_str() == Some(text),
        toml::Value::Boolean(is) => a.as_bool() == Some(*is),
        toml::Value::Table(_) | toml::Value::Datetime(_) => false,
    }
}

/// What a key or an element may be: its own words beside those of its type.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// As it stands at the key.
    pub key: &'static Value,
    /// The type, where it has a name.
    pub kind: &'static Value,
}

impl Shape {
    /// The whole case.
    pub fn case() -> Self {
        Self::of(&SCHEMA)
    }

    fn of(key: &'static Value) -> Self {
        let mut kind = key;
        while let Some(name) = name_in(kind) {
            kind = &SCHEMA["$defs"][name];
        }
        Self { key, kind }
    }

    /// Name of the type, if it has one.
    pub fn name(self) -> Option<&'static str> {
        let mut all = SCHEMA["$defs"].as_object()?.iter();
        all.find(|(_, kind)| std::ptr::eq(*kind, self.kind))
            .map(|(name, _)| name.as_str())
    }

    /// A word about the key.
    pub fn word(self, name: &str) -> Option<&'static Value> {
        self.key.get(name).or_else(|| self.kind.get(name))
    }

    /// A word about the key that is a text or a list of texts.
    pub fn texts(self, name: &str) -> Vec<&'static str> {
        match self.key.get(name) {
            Some(Value::String(one)) => vec![one],
            Some(Value::Array(all)) => all.iter().filter_map(Value::as_str).collect(),
            _ => vec![],
        }
    }

    /// A bound, where there is one.
    pub fn number(self, name: &str) -> Option<f64> {
        self.word(name).and_then(Value::as_f64)
    }

    /// Whether a value of a case is what the key has where it is left out.
    pub fn is_default(self, value: &toml::Value) -> bool {
        self.key.get("default").is_some_and(|d| is_same(d, value))
    }

    /// Keys of a table, by name.
    pub fn properties(self) -> Option<&'static Map<String, Value>> {
        self.kind.get("properties").and_then(Value::as_object)
    }

    /// What stands at `name` in a table of this shape: a key, an entry of a table of names, or the
    /// content of a choice.
    pub fn at(self, name: &str) -> Option<Self> {
        if let Some(key) = self.properties().and_then(|p| p.get(name)) {
            return Some(Self::of(key));
        }
        if let Some(entry) = self.entry() {
            return Some(entry);
        }
        self.variants()
            .find_map(|v| v.properties()?.get(name).map(Self::of))
    }

    /// What all entries of a table of names are.
    pub fn entry(self) -> Option<Self> {
        let entry = self.kind.get("additionalProperties")?;
        entry.is_object().then(|| Self::of(entry))
    }

    /// What element `k` of a list is.
    pub fn element(self, k: usize) -> Option<Self> {
        let tuple = self.kind.get("prefixItems").and_then(|p| p.get(k));
        tuple
            .or_else(|| self.kind.get("items"))
            .filter(|i| i.is_object())
            .map(Self::of)
    }

    /// What a choice may be.
    pub fn variants(self) -> impl Iterator<Item = Self> {
        let one_of = self.kind.get("oneOf").and_then(Value::as_array);
        one_of.into_iter().flatten().map(Self::of)
    }
}

/// Name of the type that a schema refers to.
fn name_in(schema: &'static Value) -> Option<&'static str> {
    schema.get("$ref")?.as_str()?.strip_prefix("#/$defs/")
}
