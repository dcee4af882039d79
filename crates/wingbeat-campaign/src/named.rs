//! Files that values of varied keys name, as those of motion tables and meshes: what is in them belongs to a point as its
//! values do, so a file that has changed is another point.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use sha2::{Digest, Sha256};
use wingbeat_case::LoadedCase;

use crate::plan::{Plan, pair};
use crate::value::Value;

/// Endings of keys that name a file, and of those that choose a column of the file beside them.
const FILE: &str = ".file";
const COLUMNS: [&str; 2] = [".phase_column", ".angle_column"];

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
                if let Some(digest) = digest {
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

fn digest_of(path: &Path) -> Option<[u8; 32]> {
    path.is_file().then_some(())?; // a pipe may never end
    Some(Sha256::digest(std::fs::read(path).ok()?).into())
}
