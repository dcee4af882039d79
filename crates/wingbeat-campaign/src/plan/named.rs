//! Files that values of varied keys name, as those of motion tables and meshes, and those that the commands of
//! other programs name: what is in them belongs to a point as its values do, so a file that has changed is
//! another point.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use wingbeat_case::LoadedCase;

use crate::plan::{Plan, pair};

/// SHA-256 of the files by the `KEY=VALUE` that names them.
pub(crate) type Contents = BTreeMap<String, [u8; 32]>;

/// SHA-256 of files by their paths; nothing of those that are none.
pub(crate) type Programs = BTreeMap<PathBuf, Option<[u8; 32]>>;

/// The files that values of the plan name; `folder` is what their paths are relative to. One that cannot be
/// read is left out: the case that names it is refused.
pub(crate) fn contents(plan: &Plan, base: &LoadedCase, folder: &Path) -> Contents {
    let mut found = Contents::new();
    for line in lines(plan) {
        if found.contains_key(&line) {
            continue; // large files are read once
        }
        if let Some(digest) = content(&line, Some(base), folder) {
            found.insert(line, digest);
        }
    }
    found
}

/// The values of the plan as `KEY=VALUE`.
fn lines(plan: &Plan) -> impl Iterator<Item = String> {
    let axes = plan.axes.iter();
    let values = axes.flat_map(|axis| axis.keys.iter().zip(&axis.values));
    values.flat_map(|(key, values)| values.iter().map(|value| pair(key, value)))
}

/// SHA-256 of the files that `KEY=VALUE` names, of the one of `base` that it chooses a column of, and of those
/// that are words of the command of a program; `folder` is what paths of files are relative to. Nothing where
/// no file can be read.
pub fn content(line: &str, base: Option<&LoadedCase>, folder: &Path) -> Option<[u8; 32]> {
    let may_name = NAMES.iter().any(|name| line.contains(name));
    may_name.then(|| of_files(named_by(line, base, folder)))?
}

fn named_by(line: &str, base: Option<&LoadedCase>, folder: &Path) -> Vec<PathBuf> {
    let mut files = vec![];
    if let Ok(document) = line.parse::<toml::Table>() {
        find(&document, "", base, folder, &mut files);
    }
    files
}

/// SHA-256 of the files that the commands of the programs of a case name.
pub fn of_programs(case: &LoadedCase) -> Option<[u8; 32]> {
    of_files(commands(case))
}

/// The words of the commands of the programs of a case.
fn commands(case: &LoadedCase) -> Vec<PathBuf> {
    let control = case.raw.control.as_ref();
    let control = control.and_then(|c| c.external.as_ref());
    let programs = [control, case.raw.air.external.as_ref()];
    let words = programs.into_iter().flatten().flat_map(|p| &p.command);
    words.map(PathBuf::from).collect()
}

/// What the commands of programs name, of the case and of values of the plan, with the SHA-256 of what is a file.
pub(crate) fn programs(plan: &Plan, base: &LoadedCase, folder: &Path) -> Programs {
    let varied = lines(plan).filter(|line| line.contains("command"));
    let varied = varied.flat_map(|line| named_by(&line, Some(base), folder));
    let words = commands(base).into_iter().chain(varied);
    words
        .map(|word| (word.clone(), of_files(vec![word])))
        .collect()
}

/// Names of keys in whose values files are named: a file, a column of the file beside, the command of a
/// program. It is started in the working folder.
const NAMES: [&str; 6] = [
    "file",
    "phase_column",
    "angle_column",
    "x_column",
    "y_column",
    "command",
];

/// The files that a part of a case names; `path` is where it stands.
fn find(
    part: &toml::Table,
    path: &str,
    base: Option<&LoadedCase>,
    folder: &Path,
    files: &mut Vec<PathBuf>,
) {
    for (name, value) in part {
        match (name.as_str(), value) {
            (_, toml::Value::Table(inner)) => {
                find(inner, &format!("{path}{name}."), base, folder, files)
            }
            ("file", toml::Value::String(file)) => files.push(folder.join(file)),
            ("phase_column" | "angle_column" | "x_column" | "y_column", _) => {
                let beside = base.and_then(|base| base.text_at(&format!("{path}file")));
                files.extend(beside.map(|file| folder.join(file)));
            }
            ("command", toml::Value::Array(words)) => {
                files.extend(
                    words
                        .iter()
                        .filter_map(|word| word.as_str().map(PathBuf::from)),
                );
            }
            _ => {}
        }
    }
}

fn of_files(files: Vec<PathBuf>) -> Option<[u8; 32]> {
    let files = files.into_iter().filter(|path| path.is_file()); // a pipe may never end
    let digests: Vec<_> = files
        .filter_map(|path| Some(<[u8; 32]>::from(Sha256::digest(std::fs::read(path).ok()?))))
        .collect();
    (!digests.is_empty()).then(|| Sha256::digest(digests.concat()).into())
}
