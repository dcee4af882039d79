//! Files written whole or not at all, and removed if they are there.

use std::ffi::OsString;
use std::fs;
use std::io::{Error, ErrorKind, Write as _};
use std::path::Path;

use tempfile::NamedTempFile;
use wingbeat_case::IoError;

/// Permissions of new files before the user's mask.
#[cfg(unix)]
const PERMISSIONS: u32 = 0o666;

/// Bytes of the name of a target that half-written files have: room is left for the number of the process.
const NAME: usize = 200;

/// Writes beside the target and renames: readers see the old file or the whole new one. Processes that write the same
/// file do not disturb each other, and what is left of one that died does not stand in the way of others.
///
/// # Errors
/// A file that cannot be written; the target is then as it was.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), IoError> {
    whole(path, content, false)
}

/// The same, and the system is asked to put it onto the disk before the old file goes.
///
/// # Errors
/// A file that cannot be written; the target is then as it was.
pub(crate) fn write_safely(path: &Path, content: &[u8]) -> Result<(), IoError> {
    whole(path, content, true)
}

fn whole(path: &Path, content: &[u8], sync: bool) -> Result<(), IoError> {
    let written = half_written(path).and_then(|mut part| {
        part.as_file_mut().write_all(content)?;
        if sync {
            part.as_file().sync_data()?;
        }
        Ok(part.persist(path)?)
    });
    written.map(drop).map_err(IoError::write(path))
}

/// An empty file beside `path`, gone if it is not moved there: `flight.h5.4711.part` of process 4711. It is locked as
/// long as it is written, so that others see whether that process lives ([`remove_left_behind`]).
pub(crate) fn half_written(path: &Path) -> std::io::Result<NamedTempFile> {
    let target = path.file_name().ok_or(ErrorKind::InvalidFilename)?;
    let target = target.to_string_lossy();
    let mut number = std::process::id().to_string();
    for again in 1.. {
        let name = OsString::from(format!("{}.{number}.part", short(&target)));
        // Another thread writes the same, or a process of this number died.
        number = format!("{}-{again}", std::process::id());
        let mut builder = tempfile::Builder::new();
        builder.prefix(&name).rand_bytes(0);
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(PERMISSIONS));
        match builder.tempfile_in(folder_of(path)) {
            Ok(part) if is_kept(&part) => return Ok(part),
            // Whoever took it for one left behind removes it; another thread may have made a file of its name.
            Ok(part) => drop(part.keep()),
            Err(e) if e.kind() != ErrorKind::AlreadyExists => return Err(unnamed(e)),
            Err(_) => {}
        }
    }
    unreachable!("some number is free")
}

/// An error without the name of the temporary file that it is about.
fn unnamed(error: Error) -> Error {
    let text = error.to_string();
    let reason = text.split(" at path ").next().unwrap_or_default();
    Error::new(error.kind(), reason)
}

/// Locks a file that was just made; false where somebody has taken it for one left behind and removes it.
#[cfg(unix)]
fn is_kept(part: &NamedTempFile) -> bool {
    !matches!(part.as_file().try_lock(), Err(fs::TryLockError::WouldBlock)) && part.path().exists()
}

/// Locks keep others from writing by the name here: files have none.
#[cfg(not(unix))]
fn is_kept(_: &NamedTempFile) -> bool {
    true
}

/// Removes half-written files of processes that died from a folder, whose targets are `known` by name. A file that
/// cannot be removed stays.
pub fn remove_left_behind(folder: &Path, known: impl Fn(&str) -> bool) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_str().unwrap_or_default();
        let target = target_name(name);
        if name != target && known(target) && entry.file_type().is_ok_and(|t| t.is_file()) {
            remove_if_left(&entry.path());
        }
    }
}

#[cfg(unix)]
fn remove_if_left(path: &Path) {
    if let Ok(file) = fs::File::open(path) {
        remove_unlocked(path, &file);
    }
}

/// Removes the `file` that was opened at `path` where nobody writes it. Its lock is held until it is gone: nobody
/// begins to write it meanwhile. Another file may have its name by now, that of a writer who moved his to its place
/// and began the next: it stays.
#[cfg(unix)]
fn remove_unlocked(path: &Path, file: &fs::File) {
    use std::os::unix::fs::MetadataExt as _;
    let identity = |m: fs::Metadata| (m.dev(), m.ino());
    if file.try_lock().is_ok()
        && let (Ok(opened), Ok(named)) = (file.metadata(), fs::symlink_metadata(path))
        && identity(opened) == identity(named)
    {
        let _ = fs::remove_file(path); // it stands in nobody's way
    }
}

/// Without locks there is no telling whether its process lives.
#[cfg(not(unix))]
fn remove_if_left(_: &Path) {}

/// The beginning of a name, as far as half-written files have it.
pub(crate) fn short(name: &str) -> &str {
    &name[..name.floor_char_boundary(NAME)]
}

/// The folder a file is in.
pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The name of the file that a half-written one was to become, `wakes_000012.vtp` of `wakes_000012.vtp.4711.part`; that
/// of a whole one as it is.
pub(crate) fn target_name(name: &str) -> &str {
    let Some(part) = name.strip_suffix(".part") else {
        return name;
    };
    let is_process = |text: &str| text.bytes().all(|b| b.is_ascii_digit() || b == b'-');
    match part.rsplit_once('.') {
        Some((target, process)) if is_process(process) => target,
        _ => name,
    }
}

/// Removes a file; whether it was there.
///
/// # Errors
/// A file that cannot be removed.
pub fn remove_file(path: &Path) -> Result<bool, IoError> {
    was_there(fs::remove_file(path)).map_err(IoError::write(path))
}

/// Removes a directory with all that is in it; whether it was there.
///
/// # Errors
/// A directory that cannot be removed.
pub fn remove_directory(path: &Path) -> Result<bool, IoError> {
    was_there(fs::remove_dir_all(path)).map_err(IoError::write(path))
}

/// Whether there was something to remove.
pub(crate) fn was_there(removed: std::io::Result<()>) -> std::io::Result<bool> {
    match removed {
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(false),
        other => other.map(|()| true),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_names_of_half_written_files_are_those_of_their_targets() {
        for (name, target) in [
            ("wakes_000012.vtp.4711.part", "wakes_000012.vtp"),
            ("flight.h5.4711-2.part", "flight.h5"),
            ("wakes_000012.vtp.part", "wakes_000012.vtp.part"),
            ("wakes_000012.vtp", "wakes_000012.vtp"),
            ("manifest.json.1.part", "manifest.json"),
        ] {
            assert_eq!(target_name(name), target);
        }
    }

    #[test]
    fn behaves_a_file_is_written_whole_and_nothing_is_left_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("case.toml");
        write_whole(&path, b"old").unwrap();
        write_safely(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        assert_eq!(
            [remove_file(&path), remove_file(&path)].map(Result::unwrap),
            [true, false]
        );
        assert!(write_whole(&folder.path().join("none/case.toml"), b"lost").is_err());
        assert!(
            remove_directory(folder.path()).unwrap() && !remove_directory(folder.path()).unwrap()
        );
    }

    /// Threads that write the same file do not disturb each other; what a process left is removed once it is dead, and
    /// what is being written stays.
    #[cfg(unix)]
    #[test]
    fn behaves_files_left_behind_are_removed_and_those_being_written_are_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("flight.h5");
        let parts = [(); 3].map(|()| half_written(&path).unwrap());
        let names: Vec<_> = parts
            .iter()
            .map(|p| p.path().file_name().unwrap().to_str().unwrap().to_owned())
            .collect();
        let pid = std::process::id();
        let wanted = ["", "-1", "-2"].map(|n| format!("flight.h5.{pid}{n}.part"));
        assert_eq!(names, wanted);
        let left = ["flight.h5.4711.part", "flight.h5.4712-1.part"];
        let others = ["notes.txt.4711.part", "flight.h5"];
        for name in left.iter().chain(&others) {
            fs::write(folder.path().join(name), "half").unwrap();
        }
        remove_left_behind(folder.path(), |target| target == "flight.h5");
        let is_there = |name: &str| folder.path().join(name).exists();
        assert!(!left.into_iter().any(is_there));
        assert!(others.into_iter().all(is_there));
        assert!(wanted.iter().all(|name| is_there(name)));
        drop(parts);
        assert!(!wanted.iter().any(|name| is_there(name)));
    }

    /// Between the look at a file and its removal its writer moved it to its place and began another of its name.
    #[cfg(unix)]
    #[test]
    fn behaves_a_file_that_took_the_name_of_one_left_behind_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("flight.h5");
        let first = half_written(&path).unwrap();
        let name = first.path().to_owned();
        let seen = fs::File::open(&name).unwrap();
        drop(first.persist(&path).unwrap());
        let second = half_written(&path).unwrap();
        assert_eq!(second.path(), name);
        remove_unlocked(&name, &seen);
        assert!(name.exists(), "the file of a writer who lives");
        drop(second);
        fs::write(&name, "half").unwrap();
        remove_if_left(&name);
        assert!(!name.exists());
    }

    #[test]
    fn behaves_names_as_long_as_the_system_takes_are_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("\u{e9}".repeat(127));
        write_whole(&path, b"long").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"long");
    }
}
