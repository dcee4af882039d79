//! Where a text goes for which a user named a file.

use std::path::{Path, PathBuf};

use clap::builder::{PathBufValueParser, TypedValueParser};
use wingbeat::case::IoError;
use wingbeat::results::file::{Existing, NewFile};

use crate::command::output::terminal;

/// The file that stands for the standard output.
const STANDARD_OUTPUT: &str = "-";

/// A place for one text; claimed before the work begins.
pub(crate) enum Target {
    /// The standard output, named `-`: nothing else is said there.
    Output,
    /// A file.
    File(NewFile),
}

impl Target {
    /// Whether this path is the standard output.
    pub(crate) fn is_output(path: &Path) -> bool {
        path == Path::new(STANDARD_OUTPUT)
    }

    /// Claims a path that a user gave.
    ///
    /// # Errors
    /// As [`NewFile::claim`].
    pub(crate) fn claim(path: &Path, existing: Existing) -> Result<Self, IoError> {
        match Self::is_output(path) {
            true => Ok(Self::Output),
            false => NewFile::claim(path, existing).map(Self::File),
        }
    }

    /// The file, if it is one.
    pub(crate) fn path(&self) -> Option<&Path> {
        match self {
            Self::Output => None,
            Self::File(file) => Some(file.path()),
        }
    }

    /// Writes the text; what is lost on the standard output is in the exit code.
    ///
    /// # Errors
    /// As [`NewFile::write`].
    pub(crate) fn write(&self, text: &str) -> Result<(), IoError> {
        match self {
            Self::Output => {
                terminal::output(format_args!("{text}"));
                Ok(())
            }
            Self::File(file) => file.write(text.as_bytes()),
        }
    }
}

/// A path by which two names of one file are the same.
pub(crate) fn place_of(path: &Path) -> PathBuf {
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new(".")).canonicalize();
    match (folder, path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_owned(), // cannot be written anyway
    }
}

/// The folder of a user for several files, which the standard output cannot hold.
pub(crate) fn folder() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| match Target::is_output(&path) {
        true => Err(
            "a folder of files cannot go to the standard output; name a folder, `./-` for one of this name",
        ),
        false => Ok(path),
    })
}
