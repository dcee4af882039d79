//! What reading of files has in common: sizes, devices, errors.

use std::path::Path;

use crate::error::Fault;

/// Bytes of a file at most: a mesh of some million panels.
pub(super) const MAX_BYTES: u64 = 200_000_000;

/// Devices and pipes, which may never end, are not read; nor is what would fill the memory.
pub(super) fn check_file(path: &Path) -> std::io::Result<()> {
    let data = std::fs::metadata(path)?;
    if !data.is_file() {
        return Err(std::io::Error::other("it is not a file"));
    }
    check_size(data.len())
}

pub(super) fn check_size(bytes: u64) -> std::io::Result<()> {
    if bytes > MAX_BYTES {
        let problem = format!("it is larger than {} MB", MAX_BYTES / 1_000_000);
        return Err(std::io::Error::other(problem));
    }
    Ok(())
}

/// A thing that is given by two keys.
pub(super) fn twice(key: String, what: &str, allowed: &str) -> Fault {
    let problem = format!("{what} is given twice");
    Fault::new(key, problem, allowed, "remove one of them")
}

fn unreadable(key: String, file: &Path, e: &std::io::Error) -> Fault {
    Fault::new(
        key,
        format!("cannot read `{}`: {e}", file.display()),
        "a file; paths are relative to the case file",
        "check the name and the folder",
    )
}

/// The bytes of a file.
pub(super) fn bytes_of(key: &str, file: &Path) -> Result<Vec<u8>, Fault> {
    let read = check_file(file).and_then(|()| std::fs::read(file));
    read.map_err(|e| unreadable(key.to_owned(), file, &e))
}
