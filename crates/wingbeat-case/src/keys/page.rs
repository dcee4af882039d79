//! The page of all keys, docs/case-keys.md.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde_json::Value;

use super::bounds;
use super::needs;
use super::schema::Shape;
use super::unit::unit;

const HEAD: &str = "\
# Keys of a case

Every key with its unit, default, allowed values, and when to change it. This page is made from the
program: `cargo run -p wingbeat-case --example case_keys > docs/case-keys.md`.

A case is a TOML file; `wingbeat new PRESET` writes one to start from. Its first line names the schema
that editors complete and check keys by, a file beside the case that `wingbeat new PRESET --schema` or
`wingbeat schema > wingbeat.schema.json` writes; nothing is fetched. Every key can also be set on the command line: `--set time.beats=3`. A key that
is unknown, out of its range, given twice in two units, or without effect beside the others is
refused with its line in the file. Where `--set air.model=...` chooses another model of the air, the
settings of the case's own model are kept but not used.

Where several paths stand above a table, it may stand at each of them. NAME is a name of your choice. Where the
last column is empty, give what was measured.
";

/// When to change a key that is a measurement: the column is left empty.
const MEASURED: &str = "to what was measured.";

/// A type of the case language and where it stands.
struct Section {
    shape: Shape,
    paths: Vec<String>,
}

/// The page.
pub fn page() -> String {
    let mut sections = Sections::default();
    sections.visit(Shape::case(), String::new());
    let mut out = HEAD.to_owned();
    for name in &sections.order {
        out.push_str(&written(&sections.all[name]));
    }
    out
}

/// Types in the order in which they are met first.
#[derive(Default)]
struct Sections {
    order: Vec<String>,
    all: BTreeMap<String, Section>,
}

impl Sections {
    /// Visits what stands at `path`: a table, a list of tables, a choice of tables.
    fn visit(&mut self, shape: Shape, path: String) {
        if let Some(keys) = shape.properties() {
            let name = shape.name().map_or_else(|| path.clone(), str::to_owned);
            let section = self.all.entry(name.clone()).or_insert_with(|| {
                self.order.push(name);
                Section {
                    shape,
                    paths: vec![],
                }
            });
            section.paths.push(path.clone());
            for name in keys.keys() {
                let dot = if path.is_empty() { "" } else { "." };
                let here = format!("{path}{dot}{name}");
                self.visit(shape.at(name).expect("a key of the table"), here);
            }
        } else if let Some(entry) = shape.entry() {
            self.visit(entry, format!("{path}.NAME"));
        } else if let Some(element) = shape.element(0) {
            self.visit(element, format!("{path}[]"));
        } else {
            for variant in shape.variants() {
                for name in variant.properties().into_iter().flat_map(|p| p.keys()) {
                    let inner = variant.at(name).expect("a choice with content");
                    self.visit(inner, format!("{path}.{name}"));
                }
            }
        }
    }
}

fn written(section: &Section) -> String {
    let mut out = String::from("\n## ");
    let title = |path: &String| match path.strip_suffix("[]") {
        Some(list) => format!("`[[{list}]]`"),
        None => format!("`[{path}]`"),
    };
    let titles: Vec<String> = section.paths.iter().map(title).collect();
    let top = section.paths == [""];
    out.push_str(&if top {
        "Top of the file".to_owned()
    } else {
        titles.join(", ")
    });
    if let Some(text) = section
        .shape
        .kind
        .get("description")
        .and_then(Value::as_str)
    {
        let _ = write!(out, "\n\n{}", plain(text));
    }
    let keys = section.shape.properties().into_iter().flatten();
    let rows: Vec<String> = keys
        .filter_map(|(name, _)| row(section.shape, name))
        .collect();
    if !rows.is_empty() {
        out.push_str("\n\n| key | unit | default | allowed | what it is | when to change it |\n");
        out.push_str("|---|---|---|---|---|---|\n");
        out.push_str(&rows.join("\n"));
    }
    out.push_str(&choices(section.shape));
    out.push('\n');
    out
}

/// The row of a key; none for tables, which have sections of their own.
fn row(table: Shape, name: &str) -> Option<String> {
    let key = table.at(name)?;
    let (what, when) = meaning(key);
    let when = when?;
    let cells = [
        format!("`{name}`"),
        unit(name).unwrap_or("").to_owned(),
        default(table, key, name),
        allowed(key),
        format!("{what}{}", effect(key)),
        if when == MEASURED {
            String::new()
        } else {
            when
        },
    ];
    Some(format!(
        "| {} |",
        cells.map(|c| c.replace('|', "\\|")).join(" | ")
    ))
}

/// What a key is, and when to change it.
pub(super) fn meaning(key: Shape) -> (String, Option<String>) {
    let text = key
        .key
        .get("description")
        .and_then(Value::as_str)
        .unwrap_or("");
    match text.split_once("\n\nChange it ") {
        Some((what, when)) => (plain(what), Some(plain(when))),
        None => (plain(text), None),
    }
}

/// One line.
fn plain(text: &str) -> String {
    text.replace("\\[", "[")
        .replace("\\]", "]")
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}

fn default(table: Shape, key: Shape, name: &str) -> String {
    let required = table.kind.get("required").and_then(Value::as_array);
    if required.is_some_and(|r| r.iter().any(|k| k == name)) {
        return "required".to_owned();
    }
    match key.key.get("default") {
        None => String::new(),
        Some(Value::String(text)) if text.is_empty() => String::new(),
        Some(value) => format!("`{value}`"),
    }
}

fn allowed(key: Shape) -> String {
    let names: Vec<String> = key
        .variants()
        .filter_map(|v| Some(format!("`{}`", variant(v)?.0)))
        .collect();
    if !names.is_empty() {
        return names.join(", ");
    }
    let of_elements = || key.element(0).and_then(bounds::allowed);
    bounds::allowed(key)
        .or_else(of_elements)
        .unwrap_or_default()
}

/// When the key has an effect, and what it is an alternative to.
fn effect(key: Shape) -> String {
    let needs: Vec<String> = needs::of(key).into_iter().map(|n| n.in_words()).collect();
    let mut out = String::new();
    if !needs.is_empty() {
        let _ = write!(out, " Only {}.", needs.join(" and "));
    }
    let others: Vec<String> = key.texts("or").iter().map(|o| format!("`{o}`")).collect();
    if !others.is_empty() {
        let _ = write!(out, " Instead of {}.", others.join(" or "));
    }
    out
}

/// Name and meaning of a choice.
fn variant(shape: Shape) -> Option<(&'static str, String)> {
    let text = shape
        .key
        .get("description")
        .and_then(Value::as_str)
        .unwrap_or("");
    let name = match shape.key.get("const").and_then(Value::as_str) {
        Some(name) => name,
        None => shape.properties()?.keys().next()?,
    };
    Some((name, plain(text)))
}

/// What the choices of a table's keys mean.
fn choices(table: Shape) -> String {
    let mut out = String::new();
    for name in table.properties().into_iter().flat_map(|p| p.keys()) {
        let key = table.at(name).expect("a key of the table");
        let key = key.element(0).unwrap_or(key);
        let all: Vec<_> = key.variants().filter_map(variant).collect();
        if all.is_empty() {
            continue;
        }
        let _ = write!(out, "\n\n`{name}`:\n");
        for (choice, meaning) in all {
            let _ = write!(out, "\n- `{choice}`: {meaning}");
        }
    }
    out
}
