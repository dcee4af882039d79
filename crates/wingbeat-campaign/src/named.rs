//! Files that values of varied keys name, as those of motion tables and meshes, and those that the commands of other programs
//! name: what is in them belongs to a point as its values do, so a file that has changed is another point.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use sha2::{Digest, Sha256};
use wingbeat_case::LoadedCase;

use crate::plan::{Plan, pair};
use crate::value::Value;

/// Endings of keys that name a file, and of those that choose a column of the file beside them.
const FILE: &str = ".file";
const COLUMNS: [&str; 2] = [".phase_column", ".angle_column"];

/// Beginnings of the keys of programs that are asked in a flight.
const PROGRAMS: [&str; 2] = ["control.external", "air.external"];

/// SHA-256 of the files by the `KEY=VALUE` that names them.
pub type Contents = BTreeMap<String, [u8; 32]>;

/// The files that values of the plan name; `folder` is what their paths are relative to. One that cannot be read is left
/// out: the case that names it is refused.
pub fn contents(plan: &Plan, base: &LoadedCase, folder: &Path) -> Contents {
    let mut known = HashMap::new();
    let mut content = |name: &str| {
        let digest = known.entry(name.to_owned());
        *digest.or_insert_with(|| digest_of(&folder.join(name)))
    };
    let mut found = Contents::new();
    for axis in &plan.axes {
        for (key, values) in axis.keys.iter().zip(&axis.values) {
            let column = COLUMNS.iter().find_map(|ending| key.strip_suffix(ending));
            let beside = column.and_then(|stem| base.text_at(&format!("{stem}{FILE}")));
            for value in values {
                let own = key.ends_with(FILE).then(|| text(value)).flatten();
                let digest = own.as_deref().or(beside).and_then(&mut content);
                let is_program = PROGRAMS.iter().any(|p| key.starts_with(p));
                let program = || is_program.then(|| of_words(&words(value))).flatten();
                if let Some(digest) = digest.or_else(program) {
                    found.insert(pair(key, value), digest);
                }
            }
        }
    }
    found
}

/// The text that a value is.
fn text(value: &Value) -> Option<String> {
    matches!(value, Value::Other(_)).then_some(())?;
    let document = pair("value", value).parse::<toml::Table>().ok()?;
    Some(document.get("value")?.as_str()?.to_owned())
}

/// SHA-256 of the files that the commands of the programs of a case name.
pub fn of_programs(case: &LoadedCase) -> Vec<[u8; 32]> {
    let control = case.raw.control.as_ref();
    let control = control.and_then(|c| c.external.as_ref());
    let programs = [control, case.raw.air.external.as_ref()];
    let commands = programs.into_iter().flatten().map(|p| &p.command);
    commands.filter_map(|words| of_words(words)).collect()
}

/// SHA-256 of those words of a command that are files, from the folder in which programs are started: the working one.
fn of_words(words: &[String]) -> Option<[u8; 32]> {
    let files: Vec<_> = words
        .iter()
        .filter_map(|w| digest_of(Path::new(w)))
        .collect();
    (!files.is_empty()).then(|| Sha256::digest(files.concat()).into())
}

/// All texts in a value.
fn words(value: &Value) -> Vec<String> {
    let document = pair("value", value).parse::<toml::Table>();
    let (mut left, mut found) = (vec![], vec![]);
    left.extend(document.ok().and_then(|mut d| d.remove("value")));
    while let Some(value) = left.pop() {
        match value {
            toml::Value::String(word) => found.push(word),
            toml::Value::Array(all) => left.extend(all.into_iter().rev()),
            toml::Value::Table(all) => left.extend(all.into_iter().map(|(_, value)| value)),
            _ => {}
        }
    }
    found
}

fn digest_of(path: &Path) -> Option<[u8; 32]> {
    path.is_file().then_some(())?; // a pipe may never end
    Some(Sha256::digest(std::fs::read(path).ok()?).into())
}
