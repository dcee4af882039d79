//! Files written whole or not at all, and removed if they are there.

use std::fs;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use wingbeat_case::IoError;

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
    let mut part = path.as_os_str().to_owned();
    part.push(format!(".{}.part", std::process::id()));
    let part = PathBuf::from(part);
    let written = fs::File::create(&part).and_then(|mut file| {
        file.write_all(content)?;
        if sync { file.sync_data() } else { Ok(()) }
    });
    let result = written.and_then(|()| fs::rename(&part, path));
    result.map_err(|e| {
        let _ = fs::remove_file(&part); // nothing more can be done about a leftover
        IoError::write(path)(e)
    })
}

/// The name of the file that a half-written one was to become, `wakes_000012.vtp` of `wakes_000012.vtp.4711.part`; that
/// of a whole one as it is.
pub(crate) fn target_name(name: &str) -> &str {
    let Some(part) = name.strip_suffix(".part") else {
        return name;
    };
    match part.rsplit_once('.') {
        Some((target, process)) if process.bytes().all(|b| b.is_ascii_digit()) => target,
        _ => part, // of versions without the number of the process
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
            ("wakes_000012.vtp.part", "wakes_000012.vtp"), // of older versions
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
}
