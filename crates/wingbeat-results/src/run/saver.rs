//! When checkpoints are due, and going back to one.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;
use std::time::{Duration, Instant};

use sha2::Digest;
use wingbeat_flight::FlightState;

use crate::common::checkpoint::{self, FILE, Header};
use crate::common::manifest::{Manifest, Outcome, hexadecimal, sha256};
use crate::common::other_build::{AGAIN, check_manifest};
use crate::common::whole::{remove_file, write_safely};
use crate::series::history::hash_start;
use crate::snapshots::vtp::{check_sum, frame_name, is_frame};
use wingbeat_case::{IoError, SaveSettings};

/// The first checkpoint by time comes sooner; a run that was killed before it is flown from its start.
const FIRST: Duration = Duration::from_secs(1);

/// Remembers when it last saved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Schedule {
    settings: SaveSettings,
    last: Instant,
    wait: Duration,
}

impl Schedule {
    pub fn new(settings: SaveSettings) -> Self {
        Self {
            settings,
            last: Instant::now(),
            wait: settings.interval.min(FIRST),
        }
    }

    /// Whether a checkpoint is due after this step.
    pub fn due(&self, step: usize) -> bool {
        let SaveSettings {
            every, interval, ..
        } = self.settings;
        let by_time = !interval.is_zero() && self.last.elapsed() >= self.wait;
        by_time || (every > 0 && step.is_multiple_of(every))
    }

    pub fn done(&mut self) {
        self.last = Instant::now();
        self.wait = self.settings.interval;
    }
}

/// What a run goes on from.
#[derive(Debug)]
pub struct Saved {
    /// The manifest of the run.
    pub manifest: Manifest,
    /// The checkpoint; none if the run was killed before it wrote its first.
    pub checkpoint: Option<(Header, FlightState)>,
}

/// Reads what is needed to go on with the run in `dir`, and changes nothing.
///
/// # Errors
/// A directory that holds no run; a checkpoint that is damaged or of another version or case; a
/// history that is not the one the checkpoint was made beside.
pub fn read(dir: &Path) -> Result<Saved, IoError> {
    let manifest = read_manifest(dir)?;
    let case = dir.join("case.toml");
    if !case.is_file() {
        return Err(IoError::Damaged {
            path: dir.to_owned(),
            problem: "case.toml is missing: the run was killed before it began, or the file was removed; put it back, or fly the case again with `wingbeat run CASE --out DIR --overwrite`".to_owned(),
        });
    }
    let case_sha256 = sha256(&fs::read(&case).map_err(IoError::read(&case))?);
    if manifest.outcome == Outcome::Finished {
        check_history(dir, &manifest)?; // nothing will be cut off and written again
    }
    let path = dir.join(FILE);
    if !path.exists() {
        if case_sha256 != manifest.case_sha256 {
            return Err(IoError::Damaged {
                path: case,
                problem: "the case was changed after the run began; fly it with `wingbeat run`"
                    .to_owned(),
            });
        }
        return Ok(Saved {
            manifest,
            checkpoint: None,
        });
    }
    let bytes = fs::read(&path).map_err(IoError::read(&path))?;
    let (header, state) = checkpoint::decode(&path, &bytes, &case_sha256)?;
    check_start(&dir.join("history.csv"), &header)?;
    Ok(Saved {
        manifest,
        checkpoint: Some((header, state)),
    })
}

/// The manifest of a result directory as it was written.
///
/// # Errors
/// A directory that holds no run; a manifest that cannot be read, or of a result that another build wrote.
pub fn read_manifest(dir: &Path) -> Result<Manifest, IoError> {
    let path = dir.join("manifest.json");
    if !path.is_file() {
        return Err(IoError::Damaged {
            path: dir.to_owned(),
            problem: match dir.join("case.toml").is_file() && dir.join("history.csv").is_file() {
                true => format!("its manifest.json is missing; put it back, or {AGAIN}"),
                false => "this is not a result directory of wingbeat (no manifest.json)".to_owned(),
            },
        });
    }
    let bytes = fs::read(&path).map_err(IoError::read(&path))?;
    let unreadable = |e: serde_json::Error| match dir.join("case.toml").is_file() {
        true => format!("the manifest cannot be read: {e}; put it back, or {AGAIN}"),
        false => format!(
            "the manifest cannot be read: {e}; put it back (there is no case.toml beside it that could be flown again)"
        ),
    };
    let json = serde_json::from_slice(&bytes).map_err(unreadable);
    let read = json.and_then(|json| {
        check_manifest(&json)?;
        serde_json::from_value(json).map_err(unreadable)
    });
    read.map_err(|problem| IoError::Damaged { path, problem })
}

fn check_start(path: &Path, header: &Header) -> Result<(), IoError> {
    let wanted = (header.history_bytes, &header.history_sha256[..]);
    if starts_with(path, wanted)? {
        return Ok(());
    }
    Err(IoError::Damaged {
        path: path.to_owned(),
        problem: format!(
            "this is not the history that the checkpoint of step {} was made beside: it was cut or changed; fly the case.toml of this result again with `wingbeat run`",
            header.step
        ),
    })
}

/// Whether a file begins with so many bytes of this hash.
fn starts_with(path: &Path, (bytes, hash): (u64, &str)) -> Result<bool, IoError> {
    let file = fs::File::open(path).map_err(|e| match e.kind() {
        ErrorKind::NotFound => IoError::Damaged {
            path: path.to_owned(),
            problem: format!("the history is missing; put it back, or {AGAIN}"),
        },
        _ => IoError::read(path)(e),
    })?;
    let sum = hash_start(&file, bytes).map(|hash| hexadecimal(&hash.finalize()));
    Ok(sum.is_ok_and(|sum| sum == hash))
}

/// Whether case and history of a result are the ones that were written.
///
/// # Errors
/// A directory that holds no run; a case or history that is missing or was changed.
pub(crate) fn check(dir: &Path) -> Result<(), IoError> {
    let manifest = read_manifest(dir)?;
    let path = dir.join("case.toml");
    let case = fs::read(&path).map_err(|e| match e.kind() {
        ErrorKind::NotFound => IoError::Damaged {
            path: path.clone(),
            problem: format!(
                "the case is missing; put it back, or fly again what it was made of (`{}`)",
                manifest.origin
            ),
        },
        _ => IoError::read(&path)(e),
    })?;
    if sha256(&case) != manifest.case_sha256 {
        return Err(IoError::Damaged {
            path,
            problem: "this is not the case that was flown here: it was changed or damaged; put the original back (`wingbeat run` flies a changed case into a directory of its own)".to_owned(),
        });
    }
    check_history(dir, &manifest)
}

/// Whether the history is the one that was written: all of it where the run has ended, else as far
/// as the manifest knows it.
///
/// # Errors
/// A history that is missing, was changed, or holds more than the run wrote.
pub(crate) fn check_history(dir: &Path, manifest: &Manifest) -> Result<(), IoError> {
    let path = dir.join("history.csv");
    let damaged = |path, problem: &str| {
        let problem = problem.to_owned();
        Err(IoError::Damaged { path, problem })
    };
    let wanted = (manifest.history_bytes, &manifest.history_sha256[..]);
    if !starts_with(&path, wanted)? {
        return damaged(
            path,
            "this is not the history that was written here: it was cut or changed; fly the case.toml of this result again with `wingbeat run`",
        );
    }
    let length = fs::metadata(&path).map_err(IoError::read(&path))?.len();
    if manifest.outcome.is_sealed() && length > manifest.history_bytes {
        return damaged(
            path,
            &format!(
                "this history holds {} bytes more than the run wrote: something was appended to it; cut it back to {} bytes, or fly the case.toml of this result again with `wingbeat run`",
                length - manifest.history_bytes,
                manifest.history_bytes
            ),
        );
    }
    Ok(())
}

/// Says which frames of these steps are missing, cut or damaged, by their checksums: going on needs none of them.
///
/// # Errors
/// A file that cannot be read.
pub(crate) fn lost_frames(
    dir: &Path,
    steps: impl Iterator<Item = usize>,
    parts: &[&str],
) -> Result<Vec<IoError>, IoError> {
    let folder = dir.join("frames");
    let mut lost = vec![];
    for (step, part) in steps.flat_map(|step| parts.iter().map(move |part| (step, part))) {
        let path = folder.join(frame_name(part, step));
        let problem = match fs::read(&path) {
            Ok(bytes) => check_sum_of(&bytes).err(),
            Err(e) if e.kind() == ErrorKind::NotFound => {
                Some("this frame was written and is missing".to_owned())
            }
            Err(e) => return Err(IoError::read(&path)(e)),
        };
        lost.extend(problem.map(|problem| IoError::Damaged {
            path,
            problem: format!(
                "{problem}; the flight goes on without it, and what draws or exports this frame will name it: put the file back, or {AGAIN}"
            ),
        }));
    }
    Ok(lost)
}

fn check_sum_of(frame: &[u8]) -> Result<(), String> {
    match std::str::from_utf8(frame) {
        Ok(text) => check_sum(text, "frame"),
        Err(_) => Err("this frame is damaged (it is no text)".to_owned()),
    }
}

/// Takes the frames back to step `last`: removes later and half-written ones, and nothing that is
/// no frame. Returns the steps of those that are left.
///
/// # Errors
/// A file that cannot be changed.
pub(crate) fn go_back(dir: &Path, last: usize) -> Result<Vec<usize>, IoError> {
    let folder = dir.join("frames");
    let Ok(entries) = fs::read_dir(&folder) else {
        return Ok(vec![]);
    };
    let mut steps = vec![];
    for entry in entries.flatten() {
        let path = entry.path();
        if !entry.file_name().to_str().is_some_and(is_frame) {
            continue; // not ours
        }
        let stem = path.file_stem().and_then(|s| s.to_str()).unwrap_or("");
        let step = stem.rsplit('_').next().and_then(|s| s.parse().ok());
        let whole = path.extension().is_some_and(|e| e == "vtp");
        match step {
            Some(step) if whole && step <= last => steps.push(step),
            _ => fs::remove_file(&path).map_err(IoError::write(&path))?,
        }
    }
    steps.sort_unstable();
    steps.dedup();
    Ok(steps)
}

/// Writes a checkpoint, whole or not at all, and sees it onto the disk.
pub(crate) fn write(dir: &Path, header: &Header, state: &FlightState) -> Result<(), IoError> {
    write_safely(&dir.join(FILE), &checkpoint::encode(header, state))
}

/// Removes the checkpoint of a flight that is done.
///
/// # Errors
/// A file that cannot be removed.
pub fn forget(dir: &Path) -> Result<(), IoError> {
    remove_file(&dir.join(FILE)).map(drop)
}
