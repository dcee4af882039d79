//! Global heap collections (III.E): objects of any length, numbered from 1 in each, that arrays and attributes
//! refer to.

use std::collections::HashMap;
use std::io;

use super::message::short;

/// Objects and bytes of a collection of texts, at most about these: numbers of objects have 16 bits, and readers load a
/// collection whole.
const OBJECTS: usize = 60_000;
const BYTES: usize = 1 << 20;

/// A collection of these objects.
///
/// # Errors
/// More than 65 535 of them.
pub(super) fn collection<'a>(list: impl Iterator<Item = &'a [u8]>) -> io::Result<Vec<u8>> {
    let mut objects = vec![];
    for (k, content) in list.enumerate() {
        objects.extend(short(k + 1, "arrays and texts of a file")?);
        objects.extend([1, 0, 0, 0, 0, 0]); // referred to
        objects.extend((content.len() as u64).to_le_bytes());
        objects.extend(content);
        objects.resize(objects.len().next_multiple_of(8), 0);
    }
    let size = (16 + objects.len() + 16).max(4096);
    let free = size - 16 - objects.len();
    let mut out = b"GCOL\x01\0\0\0".to_vec();
    out.extend((size as u64).to_le_bytes());
    out.extend(objects);
    out.extend([0; 8]); // object 0: what is left
    out.extend((free as u64).to_le_bytes());
    out.resize(size, 0);
    Ok(out)
}

/// Collections from `place` on that hold the texts of all lists, each once; and for each list what its array
/// holds: length, place of the collection and number of the object of each text (IV.B).
///
/// # Errors
/// Those of [`collection`], which holds fewer objects here than can be numbered.
pub(super) fn texts(lists: &[&[String]], place: u64) -> io::Result<(Vec<u8>, Vec<Vec<u8>>)> {
    let mut found: HashMap<&str, (u64, u32)> = HashMap::new();
    let (mut out, mut open, mut bytes): (Vec<u8>, Vec<&[u8]>, usize) = (vec![], vec![], 0);
    for text in lists.iter().copied().flatten().filter(|t| !t.is_empty()) {
        if found.contains_key(text.as_str()) {
            continue;
        }
        if open.len() == OBJECTS || bytes > BYTES {
            out.extend(collection(open.drain(..))?);
            bytes = 0;
        }
        open.push(text.as_bytes());
        bytes += text.len();
        found.insert(text, (place + out.len() as u64, open.len() as u32));
    }
    if !open.is_empty() {
        out.extend(collection(open.into_iter())?);
    }
    let reference = |text: &String| {
        let (place, number) = found.get(text.as_str()).copied().unwrap_or_default();
        let length = (text.len() as u32).to_le_bytes();
        [&length[..], &place.to_le_bytes(), &number.to_le_bytes()].concat()
    };
    let references = lists.iter().map(|l| l.iter().flat_map(reference).collect());
    Ok((out, references.collect()))
}
