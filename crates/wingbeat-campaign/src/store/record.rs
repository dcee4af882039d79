//! The result of a point, and the file that holds it: `wingbeat-point 2 CHECKSUM`, then the result as JSON.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use wingbeat_case::IoError;
use wingbeat_results::manifest::sha256;
use wingbeat_results::summary::{BeatMeans, Verdict};

pub(super) const MAGIC: &str = "wingbeat-point 2 ";
/// Of records of before, whose checksum is of the result alone and not of the point.
pub(super) const WITHOUT_POINT: &str = "wingbeat-point 1 ";

/// Why a point has no numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// The case was refused.
    Refused,
    /// The flight has fewer wingbeats than means are taken over.
    Short,
    /// The flight or the analysis could not go on.
    Diverged,
    /// The process that flew it died, too often.
    Died,
    /// Its files could not be written, too often.
    Unwritten,
    /// It took longer than it may.
    Slow,
}

impl Reason {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Refused => "refused",
            Self::Short => "short",
            Self::Diverged => "diverged",
            Self::Died => "died",
            Self::Unwritten => "unwritten",
            Self::Slow => "slow",
        }
    }
}

/// What is known of a point that is done.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointResult {
    /// Its numbers, in the order of `keep` \[unit of each\]; none where they are not finite, empty where it failed.
    pub values: Vec<Option<f64>>,
    /// How far its flight can be trusted; none where nothing was flown, and of results that do not say it yet.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
    /// Why it failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failed: Option<(Reason, String)>,
    /// Means over its wingbeats, of a member of an ensemble.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub beats: Vec<BeatMeans>,
}

impl PointResult {
    /// Of a point that was flown, with the verdict on its flight.
    pub fn of(values: &[f64], verdict: Option<Verdict>) -> Self {
        Self {
            values: values.iter().map(|x| x.is_finite().then_some(*x)).collect(),
            verdict,
            failed: None,
            beats: vec![],
        }
    }

    /// Of a point that failed.
    pub fn failure(reason: Reason, words: String) -> Self {
        Self {
            values: vec![],
            verdict: None,
            failed: Some((reason, words)),
            beats: vec![],
        }
    }

    /// Of a member of an ensemble that flew to its end.
    pub fn of_member(beats: &[BeatMeans]) -> Self {
        Self {
            beats: beats.to_vec(),
            ..Self::of(&[], None)
        }
    }
}

/// What the file of a result holds.
pub(super) enum Record {
    Whole(PointResult),
    /// Not what was written, or what was written of another point.
    Damaged,
    /// A record of another version of wingbeat: what is unknown in it.
    OtherFormat(String),
}

pub(super) fn other_format(path: PathBuf, what: &str) -> IoError {
    let problem = format!(
        "another version of wingbeat wrote this result ({what}); this one ({}) reads `{}` and `{}`: use the version that wrote it, or remove the file and fly the point again",
        env!("CARGO_PKG_VERSION"),
        MAGIC.trim(),
        WITHOUT_POINT.trim(),
    );
    IoError::Damaged { path, problem }
}

/// The file of a result, and the ending of its name.
pub(super) fn encoded(hash: &str, result: &PointResult) -> (String, &'static str) {
    let body = serde_json::to_string(result).expect("a result is JSON");
    let ending = match result.failed {
        Some(_) => "failed",
        None => "ok",
    };
    (
        format!("{MAGIC}{}\n{body}\n", checksum(hash, &body)),
        ending,
    )
}

/// What the file of a result holds, that of the point with this hash.
pub(super) fn decoded(hash: &str, bytes: &[u8]) -> Record {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return Record::Damaged;
    };
    let of = |magic| text.strip_prefix(magic)?.split_once('\n');
    let (sum, body, is_bound) = match (of(MAGIC), of(WITHOUT_POINT)) {
        (Some((sum, body)), _) => (sum, body, true),
        (None, Some((sum, body))) => (sum, body, false),
        (None, None) => return other_version(text).map_or(Record::Damaged, Record::OtherFormat),
    };
    let Some(body) = body.strip_suffix('\n') else {
        return Record::Damaged;
    };
    let expected = match is_bound {
        true => checksum(hash, body),
        false => sha256(body.as_bytes()),
    };
    if expected != sum {
        return Record::Damaged;
    }
    // What has its checksum is what was written.
    serde_json::from_str(body).map_or_else(|e| Record::OtherFormat(e.to_string()), Record::Whole)
}

/// The first words of a record of a version that is not known here: `wingbeat-point 3`.
fn other_version(text: &str) -> Option<String> {
    let mut words = text.lines().next()?.split(' ');
    let (name, version) = (words.next()?, words.next()?);
    let is_known = [MAGIC, WITHOUT_POINT]
        .map(str::trim)
        .contains(&&*format!("{name} {version}"));
    let is_other = name == "wingbeat-point" && version.parse::<u32>().is_ok() && !is_known;
    is_other.then(|| format!("`{name} {version}`"))
}

/// Checksum of the result of a point: of both, so that a record under the name of another point is found.
pub(super) fn checksum(hash: &str, body: &str) -> String {
    sha256(format!("{hash}\n{body}").as_bytes())
}
