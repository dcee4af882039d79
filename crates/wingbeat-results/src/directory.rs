//! Making result directories without ever overwriting one unasked, and whole-file writes.

use std::fs;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use wingbeat_case::IoError;

/// Everything a run may write; `--overwrite` removes these and nothing else. The manifest comes
/// first and goes last: where it is, there is a run.
const ENTRIES: [&str; 13] = [
    "history.csv",
    "flight.pvd",
    "summary.txt",
    "summary.json",
    "flight.html",
    "checkpoint.bin",
    "flight.h5",
    "flight.glb",
    "history.parquet",
    "surfaces.vtkhdf",
    "wakes.vtkhdf",
    "case.toml",
    "manifest.json",
];
const FOLDERS: [&str; 2] = ["frames", "figures"];

/// A directory that belongs to one run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResultDir {
    path: PathBuf,
}

impl ResultDir {
    /// A new directory at exactly this path.
    ///
    /// # Errors
    /// [`IoError::Exists`] if anything is there already, [`IoError::File`] if it cannot be made.
    pub fn create(path: &Path) -> Result<Self, IoError> {
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(make(path))?;
        }
        fs::create_dir(path).map_err(|e| match e.kind() {
            ErrorKind::AlreadyExists => IoError::Exists {
                path: path.to_owned(),
                remedy: "choose another directory with --out, or replace this run with --overwrite",
            },
            _ => make(path)(e),
        })?;
        Ok(Self {
            path: path.to_owned(),
        })
    }

    /// The next free directory `base/name`, `base/name-2`, `base/name-3`, ...
    ///
    /// # Errors
    /// A directory that cannot be made.
    pub fn next_free(base: &Path, name: &str) -> Result<Self, IoError> {
        let mut path = base.join(name);
        for n in 2.. {
            match Self::create(&path) {
                Err(IoError::Exists { .. }) => path = base.join(format!("{name}-{n}")),
                found => return found,
            }
        }
        unreachable!("some number is free")
    }

    /// Takes over the directory of an earlier run, whose files are removed; makes a new one if
    /// there is none.
    ///
    /// # Errors
    /// A directory that holds no run is left untouched: [`IoError::Exists`].
    pub fn overwrite(path: &Path) -> Result<Self, IoError> {
        let empty = fs::read_dir(path)
            .map(|mut d| d.next().is_none())
            .unwrap_or(false);
        if !path.exists() {
            return Self::create(path);
        }
        if !empty && !path.join("manifest.json").is_file() {
            return Err(IoError::Exists {
                path: path.to_owned(),
                remedy: "it holds no earlier run (no manifest.json), so --overwrite leaves it alone: choose another directory",
            });
        }
        if super::history::is_locked(&path.join("history.csv")) {
            return Err(IoError::Exists {
                path: path.to_owned(),
                remedy: "another wingbeat is writing it right now: wait for it, or choose another directory",
            });
        }
        for folder in FOLDERS {
            absent(fs::remove_dir_all(path.join(folder))).map_err(make(path))?;
        }
        for entry in ENTRIES {
            absent(fs::remove_file(path.join(entry))).map_err(make(path))?;
        }
        Ok(Self {
            path: path.to_owned(),
        })
    }

    /// An existing result directory.
    ///
    /// # Errors
    /// [`IoError::Damaged`] for a directory that holds no run.
    pub fn open(path: &Path) -> Result<Self, IoError> {
        super::saver::read_manifest(path)?;
        Ok(Self {
            path: path.to_owned(),
        })
    }

    /// An existing result directory whose case and history are the ones that were written, by
    /// their hashes.
    ///
    /// # Errors
    /// [`IoError::Damaged`] for a directory that holds no run, a case or history that is missing
    /// or was changed.
    pub fn read(path: &Path) -> Result<Self, IoError> {
        super::saver::check(path)?;
        Ok(Self {
            path: path.to_owned(),
        })
    }

    /// The case that was flown.
    ///
    /// # Errors
    /// A case.toml that is missing or was damaged.
    pub fn case(&self) -> Result<wingbeat_case::LoadedCase, IoError> {
        wingbeat_case::LoadedCase::from_file(&self.join("case.toml"), &[])
    }

    /// The history as far as it was written.
    ///
    /// # Errors
    /// A history.csv that is missing or was damaged.
    pub fn history(&self) -> Result<super::History, IoError> {
        super::History::read(&self.join("history.csv"))
    }

    /// The manifest.
    ///
    /// # Errors
    /// A manifest.json that is missing or was damaged.
    pub fn manifest(&self) -> Result<super::Manifest, IoError> {
        super::saver::read_manifest(&self.path)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A path inside.
    pub fn join(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Makes a folder inside.
    ///
    /// # Errors
    /// A folder that cannot be made.
    pub fn folder(&self, name: &str) -> Result<PathBuf, IoError> {
        let path = self.join(name);
        fs::create_dir_all(&path).map_err(make(&path))?;
        Ok(path)
    }

    /// Writes a file inside, whole or not at all.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), IoError> {
        write_whole(&self.join(name), content)
    }
}

fn absent(result: std::io::Result<()>) -> std::io::Result<()> {
    match result {
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(()),
        other => other,
    }
}

fn make(path: &Path) -> impl FnOnce(std::io::Error) -> IoError + '_ {
    move |source| IoError::File {
        action: "make the result directory",
        path: path.to_owned(),
        source,
        remedy: "choose a place you may write to with --out DIR",
    }
}

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
