//! Files that users name: whole or not at all, never over another one unasked, and never in the
//! place of what a run writes.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use wingbeat_case::IoError;

use crate::common::whole::{folder_of, half_written, remove_left_behind, short};
use crate::run::directory::{belongs_to_run, is_of_run};

/// What becomes of a file that is there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// It stays as it is, and nothing is written.
    Kept,
    /// It is replaced.
    Replaced,
}

impl Existing {
    /// As an option that allows to `overwrite` says.
    pub fn kept_unless(overwrite: bool) -> Self {
        match overwrite {
            true => Self::Replaced,
            false => Self::Kept,
        }
    }
}

/// A file that is going to be written; claimed before the work begins, so that nobody waits for
/// results that have no place.
#[derive(Clone, Debug)]
pub struct NewFile {
    path: PathBuf,
    existing: Existing,
}

impl NewFile {
    /// Claims a path that a user gave.
    ///
    /// # Errors
    /// A file that exists already, and is to be kept; a directory or device; a missing folder; the
    /// place of a file of a run.
    pub fn claim(path: &Path, existing: Existing) -> Result<Self, IoError> {
        match belongs_to_run(path) {
            true => Err(IoError::Reserved {
                path: path.to_owned(),
            }),
            false => Self::claim_own(path, existing),
        }
    }

    /// Claims a path whose name we chose, in a folder that [`crate::ResultDir::check_folder`]
    /// lets us write to.
    ///
    /// # Errors
    /// As [`Self::claim`], but for the places of files of a run.
    pub fn claim_own(path: &Path, existing: Existing) -> Result<Self, IoError> {
        let exists = |remedy| {
            Err(IoError::Exists {
                path: path.to_owned(),
                remedy,
            })
        };
        let cannot = |kind: ErrorKind| Err(IoError::write(path)(kind.into()));
        match fs::symlink_metadata(path) {
            Err(e) if e.kind() != ErrorKind::NotFound => return Err(IoError::write(path)(e)),
            Err(_) if path.file_name().is_none() => return cannot(ErrorKind::InvalidFilename),
            Err(_) if !folder_of(path).is_dir() => return cannot(ErrorKind::NotFound),
            Ok(data) if data.is_dir() => return exists("it is a directory: name a file"),
            Ok(_) if existing == Existing::Kept => {
                return exists("name another file, or replace this one with --overwrite");
            }
            Ok(data) if !data.is_file() && !data.is_symlink() => {
                return exists("it is no ordinary file, which --overwrite does not replace");
            }
            _ => {}
        }
        remove_left_beside(path);
        let claimed = Self {
            path: path.to_owned(),
            existing,
        };
        claimed.part()?; // a folder that cannot be written to is found now
        Ok(claimed)
    }

    /// Where it is going to be.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes it.
    ///
    /// # Errors
    /// A file that cannot be written, e.g. on a full disk: nothing is left behind; a file that has
    /// come into being since it was claimed.
    pub fn write(&self, content: &[u8]) -> Result<(), IoError> {
        self.make(|part| fs::write(part, content).map_err(IoError::write(part)))
    }

    /// Writes it over what this claim wrote before.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn replace(&self, content: &[u8]) -> Result<(), IoError> {
        let again = Self {
            path: self.path.clone(),
            existing: Existing::Replaced,
        };
        again.write(content)
    }

    /// Has `write` write it to the path it is given, then moves it to its place.
    ///
    /// # Errors
    /// What `write` says: nothing is left behind; as [`Self::write`].
    pub fn make(&self, write: impl FnOnce(&Path) -> Result<(), IoError>) -> Result<(), IoError> {
        let part = self.part()?;
        write(part.path()).map_err(|e| match e {
            IoError::File {
                action,
                path,
                source,
                remedy,
            } if path == part.path() => IoError::File {
                action,
                path: self.path.clone(),
                source,
                remedy,
            },
            IoError::Figure { path, problem } if path == part.path() => IoError::Figure {
                path: self.path.clone(),
                problem,
            },
            other => other,
        })?;
        self.place(part)
    }

    /// An empty file beside it, gone if it is not placed.
    fn part(&self) -> Result<NamedTempFile, IoError> {
        let part = half_written(&self.path);
        part.map_err(IoError::write(&self.path))
    }

    fn place(&self, part: NamedTempFile) -> Result<(), IoError> {
        let placed = match self.existing {
            Existing::Replaced => part.persist(&self.path),
            Existing::Kept => part.persist_noclobber(&self.path),
        };
        placed.map(drop).map_err(|e| match e.error.kind() {
            ErrorKind::AlreadyExists => IoError::Exists {
                path: self.path.clone(),
                remedy: "another program has just written it: name another file",
            },
            _ => IoError::write(&self.path)(e.error),
        })
    }
}

/// Writes a file whose name we chose in one go; one that holds the same already is left as it is.
///
/// # Errors
/// As [`NewFile::claim_own`] and [`NewFile::write`].
pub fn write_file(path: &Path, content: &[u8], existing: Existing) -> Result<(), IoError> {
    let same = fs::symlink_metadata(path).is_ok_and(|data| {
        data.is_file() && data.len() == content.len() as u64 && holds(path, content)
    });
    match same {
        true => {
            remove_left_beside(path);
            Ok(())
        }
        false => NewFile::claim_own(path, existing)?.write(content),
    }
}

/// Removes what processes that died left of the file at `path`, and of files of runs in its folder.
fn remove_left_beside(path: &Path) {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let is_known = |target: &str| target == short(&name) || is_of_run(target);
    remove_left_behind(folder_of(path), is_known);
}

fn holds(path: &Path, content: &[u8]) -> bool {
    fs::read(path).is_ok_and(|old| old == content)
}

/// Makes a folder for files of a user, and those around it.
///
/// # Errors
/// A folder that cannot be made.
pub fn make_folder(path: &Path) -> Result<(), IoError> {
    fs::create_dir_all(path).map_err(IoError::write(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What cannot be written is named, not the temporary file beside it.
    #[test]
    fn exact_errors_name_the_target() {
        let folder = tempfile::tempdir().unwrap();
        let file = NewFile::claim(&folder.path().join("case.toml"), Existing::Kept).unwrap();
        folder.close().unwrap();
        let said = file.write(b"mine").unwrap_err().to_string();
        assert!(said.contains("case.toml`: No such file"), "{said}");
        assert!(!said.contains(".part"), "{said}");
    }
}
