//! The arrays of numbers in a frame, read back.

use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use wingbeat_case::IoError;

use crate::snapshots::vtp::check_sum;

/// What a file of a frame holds, by `parse`.
///
/// # Errors
/// A file that cannot be read or is damaged.
pub(super) fn read<T>(
    path: &Path,
    parse: impl FnOnce(&str) -> Result<T, String>,
) -> Result<T, IoError> {
    let text = std::fs::read_to_string(path).map_err(IoError::read(path))?;
    parse(&text).map_err(|problem| IoError::Damaged {
        path: path.to_owned(),
        problem: format!("{problem}; fly the case.toml of this result again with `wingbeat run`"),
    })
}

/// The arrays of a frame whose checksum is right, by their names.
pub(super) fn arrays(text: &str) -> Result<Vec<(&str, Words)>, String> {
    check_sum(text, "frame")?;
    let mut list = vec![];
    for block in text.split("<DataArray ").skip(1) {
        let name = block
            .split("Name=\"")
            .nth(1)
            .and_then(|n| n.split('"').next());
        let name = name.ok_or("a DataArray has no name")?;
        let data = block.lines().nth(1).ok_or("a DataArray is empty")?;
        let words = words(data).map_err(|e| format!("the array `{name}` {e}"))?;
        list.push((name, words));
    }
    Ok(list)
}

/// Words of eight bytes.
pub(super) struct Words(Vec<[u8; 8]>);

impl Words {
    pub fn map_to<T>(&self, f: impl Fn([u8; 8]) -> T) -> Vec<T> {
        self.0.iter().map(|w| f(*w)).collect()
    }
}

/// The content of a DataArray: base64 of the length in bytes followed by the data.
fn words(data: &str) -> Result<Words, String> {
    let bytes = STANDARD
        .decode(data)
        .map_err(|e| format!("is damaged ({e})"))?;
    let (words, rest) = bytes.as_chunks::<8>();
    let length = words.first().map(|w| u64::from_le_bytes(*w));
    if !rest.is_empty() || length != Some(8 * (words.len().max(1) as u64 - 1)) {
        return Err("is cut or damaged (its length is not what it says)".to_owned());
    }
    Ok(Words(words[1..].to_vec()))
}

pub(super) fn groups<T: Copy, const N: usize>(
    values: &[T],
    name: &str,
) -> Result<Vec<[T; N]>, String> {
    let (groups, rest) = values.as_chunks::<N>();
    if rest.is_empty() {
        Ok(groups.to_vec())
    } else {
        Err(format!("the array `{name}` is cut"))
    }
}
