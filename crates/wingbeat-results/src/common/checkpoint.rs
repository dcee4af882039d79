//! Checkpoints: the state of a flight in one file, enough to go on bit for bit.
//!
//! ```text
//! wingbeat-checkpoint FORMAT SHA256 of every byte after this line
//! {"version": ..., "step": ...}     the header, one line of JSON
//! ...                               the state, postcard (binary, floats bit for bit)
//! ```
//!
//! A checkpoint says how long history.csv was when it was made, and the hash of those bytes: what
//! was appended later is cut off before the flight goes on.

use std::path::Path;

use serde::{Deserialize, Serialize};
use wingbeat_flight::FlightState;

use crate::common::manifest::sha256;
use wingbeat_case::IoError;

/// Name of the file in a result directory.
pub const FILE: &str = "checkpoint.bin";
const MAGIC: &str = "wingbeat-checkpoint ";
/// What the bytes of a state mean, and with which forces a flight goes on from them: another one is refused.
pub const FORMAT: &str = "28";

/// What a checkpoint says about itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// Version of wingbeat that wrote it.
    pub version: String,
    /// SHA-256 of case.toml.
    pub case_sha256: String,
    /// Steps made.
    pub step: usize,
    /// Length of history.csv up to the row of this step \[bytes\].
    pub history_bytes: u64,
    /// SHA-256 of that part of history.csv.
    pub history_sha256: String,
    /// Of a thinned history: the next row as far as it is known, the bits of its numbers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pending: Vec<u64>,
    /// Of a thinned history: what the summary knows of all steps so far, in bytes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub each_step: Vec<u8>,
}

/// The file.
pub fn encode(header: &Header, state: &FlightState) -> Vec<u8> {
    let head = serde_json::to_string(header).expect("a header is JSON");
    let state = postcard::to_allocvec(state).expect("a state is plain data");
    let body = [head.as_bytes(), b"\n", &state].concat();
    let first = format!("{MAGIC}{FORMAT} {}\n", sha256(&body));
    [first.as_bytes(), &body].concat()
}

/// Reads a checkpoint of the case with this hash.
///
/// # Errors
/// [`IoError::Damaged`] with the reason: no checkpoint, another format, another version, another
/// case, bytes that were changed or lost.
pub fn decode(
    path: &Path,
    bytes: &[u8],
    case_sha256: &str,
) -> Result<(Header, FlightState), IoError> {
    let refuse = |problem: String| IoError::Damaged {
        path: path.to_owned(),
        problem,
    };
    let (header, state) = parts(bytes).map_err(|p| refuse(p.to_owned()))?;
    let header: Header = serde_json::from_slice(header)
        .map_err(|e| refuse(format!("the header cannot be read: {e}")))?;
    let own = env!("CARGO_PKG_VERSION");
    if header.version != own {
        return Err(refuse(format!(
            "this checkpoint was written by wingbeat {}, this is {own}; go on with that version, or fly the case again",
            header.version
        )));
    }
    if header.case_sha256 != case_sha256 {
        return Err(refuse(
            "this checkpoint belongs to another case than the case.toml beside it; put the original case.toml back, or fly the case again".to_owned(),
        ));
    }
    let (state, rest) = postcard::take_from_bytes::<FlightState>(state)
        .map_err(|e| refuse(format!("the state cannot be read: {e}")))?;
    if !rest.is_empty() || state.step != header.step {
        return Err(refuse(
            "the state does not fit the header; another build of this version wrote it".to_owned(),
        ));
    }
    Ok((header, state))
}

/// Header and state, once format and checksum are found right.
fn parts(bytes: &[u8]) -> Result<(&[u8], &[u8]), &'static str> {
    let line = |bytes: &[u8]| bytes.iter().position(|b| *b == b'\n');
    let none = "this is not a checkpoint of wingbeat";
    let end = line(&bytes[..bytes.len().min(200)]).ok_or(none)?;
    let first = std::str::from_utf8(&bytes[..end]).map_err(|_| none)?;
    let words = first.strip_prefix(MAGIC).ok_or(none)?;
    let (format, sum) = words.split_once(' ').ok_or(none)?;
    if format != FORMAT {
        return Err(
            "this checkpoint has another format; go on with the wingbeat that wrote it, or fly the case again",
        );
    }
    let body = &bytes[end + 1..];
    if sha256(body) != sum {
        return Err(
            "the checksum is wrong: the checkpoint is cut or damaged; fly the case.toml of this result again with `wingbeat run`",
        );
    }
    let cut = line(body).ok_or(none)?;
    Ok((&body[..cut], &body[cut + 1..]))
}
