//! Results of other builds: the one place that decides whether this build reads a result, and what it says where not.
//!
//! A directory says its format in manifest.json, and a history has exactly the columns that this build writes of its
//! flight. Whatever else reads a result begins with one of the two.

use std::path::Path;

use serde_json::Value;
use wingbeat_case::IoError;

/// What the files of a result mean: columns, frames, summary. To be raised whenever one of them changes; results of
/// another format are refused.
pub const FORMAT: u64 = 1;

/// What is left to do where a result or a file of it cannot be read.
pub(crate) const AGAIN: &str = "fly the case.toml of this result again with `wingbeat run`";

/// What is wrong with a result of another build, by what was `found` in it.
pub(crate) fn refusal(found: &str) -> String {
    format!("{found}: another build of wingbeat wrote this result; {AGAIN}")
}

/// Whether this manifest of a run, as JSON, is that of a result which this build reads; one of another program is not
/// judged.
///
/// # Errors
/// [`refusal`] of a run of another format.
pub(crate) fn check_manifest(manifest: &Value) -> Result<(), String> {
    let format = &manifest["format"];
    let is_run = manifest["case_sha256"].is_string();
    if !is_run || format.as_u64() == Some(FORMAT) {
        return Ok(());
    }
    let found = match format {
        Value::Null => "the result has no format".to_owned(),
        other => format!("the result has format {other}"),
    };
    Err(refusal(&format!("{found}, and this build reads {FORMAT}")))
}

/// Whether the history at `path` with this header has the columns that this build writes of its flight, `own`.
///
/// # Errors
/// [`refusal`] with the first column that is missing, unknown or in another place.
pub(crate) fn check_columns(path: &Path, own: &[String], header: &[String]) -> Result<(), IoError> {
    let lacks = |list: &[String]| {
        header
            .iter()
            .chain(own)
            .find(|n| !list.contains(n))
            .cloned()
    };
    let missing = lacks(header).map(|name| format!("the column `{name}` is missing"));
    let unknown = || lacks(own).map(|name| format!("the column `{name}` is unknown"));
    let moved = || {
        let at = (0..header.len()).find(|k| own.get(*k) != Some(&header[*k]))?;
        Some(format!("the column `{}` has another place", header[at]))
    };
    match missing.or_else(unknown).or_else(moved) {
        None => Ok(()),
        Some(found) => Err(IoError::Damaged {
            path: path.to_owned(),
            problem: refusal(&found),
        }),
    }
}
