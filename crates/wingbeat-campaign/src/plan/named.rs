//! Files that the case and values of varied keys name, as those of motion tables and meshes, and those that the
//! commands of other programs name: what is in them belongs to a point as its values do, so a file that has changed
//! is another point.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use sha2::{Digest, Sha256};
use wingbeat_case::LoadedCase;

use crate::plan::cases::set_of;
use crate::plan::raw::RawCampaign;
use crate::plan::{Plan, pair};

/// SHA-256 of the files by the `KEY=VALUE` that names them.
pub(crate) type Contents = BTreeMap<String, [u8; 32]>;

/// SHA-256 of files by their paths; nothing of those that are none.
pub(crate) type Programs = BTreeMap<PathBuf, Option<[u8; 32]>>;

/// A file as it was when it was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Seen {
    /// Bytes and time of the last change: what differs nowhere here is taken for the same.
    stamp: Option<(u64, SystemTime)>,
    content: Option<[u8; 32]>,
}

impl Seen {
    fn now(path: &Path) -> Self {
        Self {
            stamp: stamp(path), // before it is read
            content: of_files(vec![path.to_owned()]),
        }
    }

    /// Whether the file has other contents now.
    pub(crate) fn differs(&self, path: &Path) -> bool {
        stamp(path) != self.stamp && Self::now(path).content != self.content
    }
}

fn stamp(path: &Path) -> Option<(u64, SystemTime)> {
    let about = path.metadata().ok()?;
    Some((about.len(), about.modified().ok()?))
}

/// The files that points read, by their paths: those that the case names, its overrides and the values of the plan;
/// `folder` is what their paths are relative to. Those of programs are none of them.
pub(crate) fn files(
    raw: &RawCampaign,
    plan: &Plan,
    base: &LoadedCase,
    folder: &Path,
) -> BTreeMap<PathBuf, Seen> {
    let over = set_of(raw).into_iter().chain(lines(plan));
    let over = over.filter(|line| !line.contains(COMMAND));
    let texts = std::iter::once(base.text().to_owned()).chain(over);
    let may_name = |text: &String| DATA.iter().any(|name| text.contains(name));
    let named = texts.filter(may_name);
    let named = named.flat_map(|text| named_by(&text, Some(base), folder));
    let commands = commands(base);
    let data = named.filter(|path| !commands.contains(path));
    data.map(|path| (path.clone(), Seen::now(&path))).collect()
}

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
    let may_name = DATA
        .iter()
        .chain(&[COMMAND])
        .any(|name| line.contains(name));
    may_name.then(|| of_files(named_by(line, base, folder)))?
}

fn named_by(line: &str, base: Option<&LoadedCase>, folder: &Path) -> Vec<PathBuf> {
    let mut files = vec![];
    let parsed = line.parse::<toml::Table>();
    if let Ok(document) = parsed.or_else(|_| without_places(line).parse()) {
        find(&document, "", base, folder, &mut files);
    }
    files
}

/// `KEY=VALUE` without the places of elements of lists in its key, which are no TOML: `a.b=1` of `a[0].b=1`.
fn without_places(line: &str) -> String {
    let (key, value) = line.split_once('=').unwrap_or((line, ""));
    let mut parts = key.split('[');
    let first = parts.next().unwrap_or("").to_owned();
    let rest = parts.filter_map(|part| Some(part.split_once(']')?.1));
    format!("{}={value}", rest.fold(first, |key, part| key + part))
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
    let varied = lines(plan).filter(|line| line.contains(COMMAND));
    let varied = varied.flat_map(|line| named_by(&line, Some(base), folder));
    let words = commands(base).into_iter().chain(varied);
    words
        .map(|word| (word.clone(), of_files(vec![word])))
        .collect()
}

/// Names of keys in whose values files are named that are read in: a file, a column of the file beside.
const DATA: [&str; 5] = [
    "file",
    "phase_column",
    "angle_column",
    "x_column",
    "y_column",
];
/// The name of the key of the command of a program. It is started in the working folder.
const COMMAND: &str = "command";

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
            (COMMAND, toml::Value::String(word)) => files.push(PathBuf::from(word)), // one of them
            (COMMAND, toml::Value::Array(words)) => {
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
