//! Making result directories without ever overwriting one unasked, and whole-file writes.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use wingbeat_case::IoError;

use crate::Outcome;
pub use crate::common::whole::{remove_directory, remove_file, remove_left_behind, write_whole};
use crate::common::whole::{target_name, was_there};
use crate::series::history::is_abandoned;
use crate::snapshots::vtp::is_frame;

/// Files a run may have; `--overwrite` removes these, its exports, the frames and the figures, and
/// nothing else. The manifest comes first and goes last: where it is, there is a run.
const ENTRIES: [&str; 8] = [
    "history.csv",
    "flight.pvd",
    "summary.txt",
    "summary.json",
    "flight.html",
    "checkpoint.bin",
    "case.toml",
    "manifest.json",
];
/// Exports of it.
const EXPORTS: [&str; 6] = [
    "flight.h5",
    "flight.glb",
    "history.parquet",
    "surfaces.vtkhdf",
    "wakes.vtkhdf",
    "particles.vtkhdf",
];
/// The folder that runs and campaigns go into unless it is said where.
pub const RESULTS: &str = "results";
const FRAMES: &str = "frames";
const FIGURES: &str = "figures";
/// Figures for papers and for slides, within the folder of figures.
const STYLED: [&str; 2] = ["figures/paper", "figures/dark"];
/// Figures by their names, the endings left out.
pub const FIGURE_NAMES: [&str; 12] = [
    "angles",
    "forces",
    "lollipop",
    "beats",
    "trajectory",
    "commands",
    "path",
    "phase",
    "bending",
    "balances",
    "wake",
    "animation",
];
/// Folders this far around a file are searched for a run.
const DEPTH: usize = 4;

/// A directory that belongs to one run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResultDir {
    path: PathBuf,
}

impl ResultDir {
    /// A directory at exactly this path: a new one, or one that is there and empty.
    ///
    /// # Errors
    /// As [`Self::create`], but for empty directories.
    pub fn create_or_fill(path: &Path) -> Result<Self, IoError> {
        match is_empty(path) {
            true => Ok(Self {
                path: path.to_owned(),
            }),
            false => Self::create(path),
        }
    }

    /// A new directory at exactly this path, which of several programs at a time only one can make.
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
                remedy: match may_be_taken(path) {
                    true => {
                        "choose another directory with --out, or take this one with --overwrite"
                    }
                    false => "it holds no earlier run: choose another directory with --out",
                },
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
        if !path.exists() {
            return Self::create(path);
        }
        if !may_be_taken(path) {
            return Err(IoError::Exists {
                path: path.to_owned(),
                remedy: "it holds no earlier run (no manifest.json of ours), so --overwrite leaves it alone: choose another directory",
            });
        }
        if crate::series::history::is_locked(&path.join("history.csv")) {
            return Err(IoError::Exists {
                path: path.to_owned(),
                remedy: "another wingbeat is writing it right now: wait for it, or choose another directory",
            });
        }
        clear(&path.join(FRAMES), is_frame).map_err(make(path))?;
        remove_derived(path)?;
        remove_half_written(path);
        for entry in ENTRIES {
            was_there(fs::remove_file(path.join(entry))).map_err(make(path))?;
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
        crate::run::saver::read_manifest(path)?;
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
        crate::run::saver::check(path)?;
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
    pub fn history(&self) -> Result<crate::History, IoError> {
        crate::History::read(&self.join("history.csv"))
    }

    /// The manifest; a run that was killed counts as interrupted.
    ///
    /// # Errors
    /// A manifest.json that is missing or was damaged.
    pub fn manifest(&self) -> Result<crate::Manifest, IoError> {
        let mut manifest = crate::run::saver::read_manifest(&self.path)?;
        if manifest.outcome == Outcome::Running && is_abandoned(&self.join("history.csv")) {
            manifest.outcome = Outcome::Interrupted;
        }
        Ok(manifest)
    }

    /// Whether files drawn or exported from this result may be written to `folder`: not among the
    /// frames, and not among the files of another result.
    ///
    /// # Errors
    /// [`IoError::Reserved`] if not.
    pub fn check_folder(&self, folder: &Path) -> Result<(), IoError> {
        let reserved = match run_around(folder) {
            Some((run, inside)) if run == resolved(&self.path) => inside.starts_with(FRAMES),
            Some((_, inside)) => {
                let own = [FRAMES, FIGURES].iter().any(|f| inside.starts_with(f));
                own || inside.as_os_str().is_empty()
            }
            None => false,
        };
        match reserved {
            true => Err(IoError::Reserved {
                path: folder.to_owned(),
            }),
            false => Ok(()),
        }
    }

    /// Removes exports and figures: of a flight that goes on they would show the part that was flown before.
    ///
    /// # Errors
    /// A file that cannot be removed.
    pub fn remove_derived(&self) -> Result<(), IoError> {
        remove_derived(&self.path)
    }

    /// Removes what processes that died left of files that they were writing here.
    pub fn remove_half_written(&self) {
        remove_half_written(&self.path);
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

/// Removes the exports of a run and its figures.
fn remove_derived(run: &Path) -> Result<(), IoError> {
    for folder in STYLED.iter().chain([&FIGURES]) {
        clear(&run.join(folder), is_figure).map_err(make(run))?;
    }
    for export in EXPORTS {
        was_there(fs::remove_file(run.join(export))).map_err(make(run))?;
    }
    Ok(())
}

/// Removes what processes that died left of files of a run, its exports and its figures that they were writing.
pub(crate) fn remove_half_written(run: &Path) {
    remove_left_behind(run, is_of_run);
    remove_left_behind(&run.join(FRAMES), is_frame);
    for folder in [FIGURES].iter().chain(&STYLED) {
        remove_left_behind(&run.join(folder), is_figure);
    }
}

/// Files that a run and its exports may have.
fn entries() -> impl Iterator<Item = &'static str> {
    ENTRIES.into_iter().chain(EXPORTS)
}

/// Whether this is the name of a file that a run, an export or a figure has.
pub(crate) fn is_of_run(name: &str) -> bool {
    entries().any(|entry| entry == name) || is_figure(name)
}

/// Whether this is the place of a file that a run writes or has written.
pub(crate) fn belongs_to_run(path: &Path) -> bool {
    run_around(path).is_some_and(|(_, inside)| {
        let folder = [FRAMES, FIGURES].iter().any(|f| inside.starts_with(f));
        folder || entries().any(|entry| inside == Path::new(entry))
    })
}

/// Whether a directory is empty or holds an earlier run.
fn may_be_taken(path: &Path) -> bool {
    is_empty(path) || holds_run(path)
}

/// Whether this is a directory with nothing in it; links are followed.
fn is_empty(path: &Path) -> bool {
    fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_none())
}

/// Whether a run was written here: other programs have files called manifest.json, too.
fn holds_run(path: &Path) -> bool {
    let beside = || path.join("manifest.json").is_file() && path.join("history.csv").is_file();
    crate::run::saver::read_manifest(path).is_ok() || beside()
}

/// The run in a folder of results that was written last.
pub fn latest_run(folder: &Path) -> Option<PathBuf> {
    let runs = fs::read_dir(folder)
        .ok()?
        .flatten()
        .map(|entry| entry.path());
    let written = |run: PathBuf| {
        let when = fs::metadata(run.join("history.csv"))
            .ok()?
            .modified()
            .ok()?;
        holds_run(&run).then_some((when, run))
    };
    runs.filter_map(written).max().map(|(_, run)| run)
}

/// The run that a path lies in, and the path within it.
fn run_around(path: &Path) -> Option<(PathBuf, PathBuf)> {
    let path = resolved(path);
    let run = path.ancestors().take(DEPTH);
    let run = run.into_iter().find(|p| holds_run(p))?;
    let inside = path.strip_prefix(run).ok()?;
    Some((run.to_owned(), inside.to_owned()))
}

/// The path without links and dots, as far as it exists.
fn resolved(path: &Path) -> PathBuf {
    let whole = fs::canonicalize(path);
    whole.unwrap_or_else(|_| match (path.parent(), path.file_name()) {
        (Some(parent), Some(name)) if !parent.as_os_str().is_empty() => resolved(parent).join(name),
        _ => std::path::absolute(path).unwrap_or_else(|_| path.to_owned()),
    })
}

/// Name of a figure, whole or half-written: `forces.svg`.
fn is_figure(name: &str) -> bool {
    let known = |stem: &str| FIGURE_NAMES.contains(&stem);
    let name = target_name(name).rsplit_once('.');
    name.is_some_and(|(stem, end)| {
        known(stem) && ["svg", "png", "pdf", "gif", "mp4"].contains(&end)
    })
}

/// Removes the files of a folder whose names are `ours`, then the folder if it is empty.
fn clear(folder: &Path, ours: impl Fn(&str) -> bool) -> std::io::Result<()> {
    if folder.is_symlink() || !folder.is_dir() {
        return Ok(());
    }
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let own = entry.file_name().to_str().is_some_and(&ours);
        if own && !entry.file_type()?.is_dir() {
            was_there(fs::remove_file(entry.path()))?;
        }
    }
    match fs::remove_dir(folder) {
        Err(e) if e.kind() == ErrorKind::DirectoryNotEmpty => Ok(()),
        removed => was_there(removed).map(drop),
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
