//! Files written whole or not at all.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use wingbeat_case::IoError;

/// Writes beside the target and renames: readers see the old file or the whole new one.
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
    part.push(".part");
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
