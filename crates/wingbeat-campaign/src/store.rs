//! The directory of a campaign, and the result of a point in it.
//!
//! ```text
//! campaign.toml        the file, as it was last run
//! points/ab/HASH.ok    the numbers of a point, or
//! points/ab/HASH.failed  why there are none; each written whole or not at all, with its checksum
//! files/HASH/          files that are kept of a point
//! work/HASH/           the result directory of a point that is being flown
//! leases/PLAN/         who flies which block of points now, and which blocks are done
//! attempts/HASH        how often the process died that flew a point
//! points.csv, .parquet, .nc, failed.csv, campaign.html   what `merge` and `view` write
//! ```
//!
//! Results are not put onto the disk one by one (`fsync`): a power failure may lose or damage those of the last
//! seconds. Their checksums, each of a record and its point, tell, and they are flown again.

mod record;

use std::collections::HashMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use wingbeat_case::IoError;
use wingbeat_results::directory::{remove_directory, remove_file, remove_left_behind, write_whole};

pub use self::record::{PointResult, Reason};
use self::record::{Record, decoded, encoded, other_format};

/// The copy of the campaign's file; where it is, there is a campaign.
pub const FILE: &str = "campaign.toml";

/// How often the process died that flew a point, and how far its checkpoint was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Attempts {
    /// Deaths, or failures to write, since the checkpoint advanced.
    pub deaths: usize,
    /// Step of the checkpoint at the last of them.
    pub step: usize,
}

/// The directory of a campaign.
#[derive(Clone, Debug)]
pub struct Store {
    root: PathBuf,
    /// Its copy of the file that was run last.
    file: &'static str,
}

impl Store {
    /// Makes or opens the directory, and keeps the text of the campaign in it.
    ///
    /// # Errors
    /// A directory that holds something else; one that cannot be written.
    pub fn open(root: &Path, text: &str) -> Result<Self, IoError> {
        let remedy = "it holds no campaign (no campaign.toml): choose another directory with --out";
        let store = Self::at(root, FILE, remedy)?;
        store.make(root)?;
        store.keep(text)?;
        Ok(store)
    }

    /// A directory that is empty, not there yet, or has `file` in it.
    ///
    /// # Errors
    /// A directory that holds something else, and what to do then.
    pub(crate) fn at(
        root: &Path,
        file: &'static str,
        remedy: &'static str,
    ) -> Result<Self, IoError> {
        let root = root.to_owned();
        // Others that begin here at the same time are about to put it there.
        let is_half = |name: &str| name.starts_with(file) && name.ends_with(".part");
        let is_own_half = |e: &fs::DirEntry| e.file_name().to_str().is_some_and(is_half);
        let is_empty =
            fs::read_dir(&root).map_or(true, |d| d.flatten().all(|entry| is_own_half(&entry)));
        match is_empty || root.join(file).is_file() {
            true => Ok(Self { root, file }),
            false => Err(IoError::Exists { path: root, remedy }),
        }
    }

    /// Keeps the text of what is run.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub(crate) fn keep(&self, text: &str) -> Result<(), IoError> {
        match self.is_of(text) {
            true => Ok(()),
            false => self.write(&self.path(self.file), text.as_bytes()),
        }
    }

    /// An existing directory.
    ///
    /// # Errors
    /// A directory that holds no campaign.
    pub fn existing(root: &Path) -> Result<Self, IoError> {
        let store = Self {
            root: root.to_owned(),
            file: FILE,
        };
        match store.path(FILE).is_file() {
            true => Ok(store),
            false => Err(IoError::Damaged {
                path: root.to_owned(),
                problem: "there is no campaign in this directory (no campaign.toml); `wingbeat campaign run FILE` makes one, --out DIR names another".to_owned(),
            }),
        }
    }

    /// Whether what was run here last has this text.
    pub fn is_of(&self, text: &str) -> bool {
        fs::read_to_string(self.path(self.file)).is_ok_and(|own| own == text)
    }

    /// Removes half-written files of processes that died: of results, attempts and the copy of the file.
    pub fn remove_half_written(&self) {
        let is_hash = |name: &str| name.len() == 64 && name.bytes().all(|b| b.is_ascii_hexdigit());
        let is_result = |name: &str| {
            let parts = name.split_once('.');
            parts.is_some_and(|(hash, ending)| is_hash(hash) && ["ok", "failed"].contains(&ending))
        };
        for folder in fs::read_dir(self.path("points"))
            .into_iter()
            .flatten()
            .flatten()
        {
            remove_left_behind(&folder.path(), is_result);
        }
        remove_left_behind(&self.path("attempts"), is_hash);
        remove_left_behind(&self.root, |name| name == self.file);
    }

    /// A path inside.
    pub fn path(&self, name: &str) -> PathBuf {
        self.root.join(name)
    }

    /// The directory.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Makes a folder.
    ///
    /// # Errors
    /// A folder that cannot be made.
    pub fn make(&self, folder: &Path) -> Result<(), IoError> {
        fs::create_dir_all(folder).map_err(IoError::write(folder))
    }

    /// Writes a file whole or not at all; what is left of processes that died does not stand in the way of others.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, path: &Path, content: &[u8]) -> Result<(), IoError> {
        match write_whole(path, content) {
            Err(IoError::File { source, .. }) if source.kind() == ErrorKind::NotFound => {
                self.make(path.parent().unwrap_or(&self.root))?;
                write_whole(path, content)
            }
            written => written,
        }
    }

    /// Where the result of a point is: `ending` is "ok", or "failed".
    pub(crate) fn place(&self, hash: &str, ending: &str) -> PathBuf {
        let folder = self.root.join("points").join(&hash[..2]);
        folder.join(format!("{hash}.{ending}"))
    }

    /// Whether a point is done.
    pub fn has(&self, hash: &str) -> bool {
        self.place(hash, "ok").exists() || self.place(hash, "failed").exists()
    }

    /// Keeps the result of a point; a failure is none where there are numbers, which take its place otherwise.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn put(&self, hash: &str, result: &PointResult) -> Result<(), IoError> {
        let (text, ending) = encoded(hash, result);
        let has_failed = result.failed.is_some();
        if has_failed && self.place(hash, "ok").exists() {
            return Ok(()); // who flew it was taken for dead
        }
        self.write(&self.place(hash, ending), text.as_bytes())?;
        if !has_failed {
            let _ = fs::remove_file(self.place(hash, "failed")); // there may be none; numbers count
        }
        let attempts = self.path("attempts").join(hash);
        if attempts.exists() && result.failed.is_none() {
            let _ = fs::remove_file(attempts); // says nothing any more
        }
        Ok(())
    }

    /// The result of a point that is done; none where there is none, or only a damaged one or that of another point,
    /// which stay where they are.
    ///
    /// # Errors
    /// A file that cannot be read, or that another version of wingbeat wrote.
    pub fn get(&self, hash: &str) -> Result<Option<PointResult>, IoError> {
        self.find(hash, |_| Ok(()))
    }

    /// The same, and damaged results and those of other points are removed, so that the point is flown again.
    ///
    /// # Errors
    /// A file that cannot be read or removed, or that another version of wingbeat wrote.
    pub fn get_or_remove(&self, hash: &str) -> Result<Option<PointResult>, IoError> {
        self.find(hash, |path| {
            fs::remove_file(path).map_err(IoError::write(path))
        })
    }

    fn find(
        &self,
        hash: &str,
        on_damage: impl Fn(&Path) -> Result<(), IoError>,
    ) -> Result<Option<PointResult>, IoError> {
        for ending in ["ok", "failed"] {
            let path = self.place(hash, ending);
            let bytes = match fs::read(&path) {
                Err(e) if e.kind() == ErrorKind::NotFound => continue,
                read => read.map_err(IoError::read(&path))?,
            };
            match decoded(hash, &bytes) {
                Record::Whole(result) => return Ok(Some(result)),
                Record::Damaged => on_damage(&path)?,
                Record::OtherFormat(what) => return Err(other_format(path, &what)),
            }
        }
        Ok(None)
    }

    /// Removes the folders of points and the whole directory, where nothing is in them but the copy of the file.
    pub(crate) fn remove_if_empty(&self) {
        let points = self.path("points");
        for folder in entries(&points).unwrap_or_default() {
            let _ = fs::remove_dir(folder); // not an empty one: it stays
        }
        let _ = fs::remove_dir(&points);
        let rest = entries(&self.root).unwrap_or_default();
        if rest.iter().all(|path| *path == self.path(self.file)) {
            let _ = remove_directory(&self.root); // at worst it stays
        }
    }

    /// Forgets the numbers of a point.
    ///
    /// # Errors
    /// A file that cannot be removed.
    pub fn forget(&self, hash: &str) -> Result<(), IoError> {
        remove_file(&self.place(hash, "ok")).map(drop)
    }

    /// Forgets the result of a point that failed; whether there was one.
    ///
    /// # Errors
    /// A file that cannot be removed.
    pub fn forget_failure(&self, hash: &str) -> Result<bool, IoError> {
        let failed = remove_file(&self.place(hash, "failed"))?;
        if failed {
            let _ = fs::remove_file(self.path("attempts").join(hash)); // there may be none
        }
        Ok(failed)
    }

    /// All points that are done by their hashes, and whether they failed; damage is not looked for.
    ///
    /// # Errors
    /// A folder that cannot be read.
    pub fn done(&self) -> Result<HashMap<String, bool>, IoError> {
        let mut done = HashMap::new();
        let is_of_points = |folder: &PathBuf| {
            let name = folder.file_name().unwrap_or_default();
            name.len() == 2 && name.as_encoded_bytes().iter().all(u8::is_ascii_hexdigit)
        };
        let folders = entries(&self.path("points"))?;
        for folder in folders.iter().filter(|f| is_of_points(f)) {
            for file in entries(folder)? {
                let name = file.file_name().and_then(|n| n.to_str());
                let Some((hash, ending)) = name.and_then(|n| n.split_once('.')) else {
                    continue;
                };
                if hash.len() == 64 && (ending == "ok" || ending == "failed") {
                    let failed = done.entry(hash.to_owned()).or_insert(true);
                    *failed &= ending == "failed"; // numbers count
                }
            }
        }
        Ok(done)
    }

    /// The attempts at a point.
    pub fn attempts(&self, hash: &str) -> Attempts {
        let text = fs::read(self.path("attempts").join(hash)).unwrap_or_default();
        serde_json::from_slice(&text).unwrap_or_default()
    }

    /// Counts a death at a point whose checkpoint is at `step`; how many there are since it advanced.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn count_death(&self, hash: &str, step: usize) -> Result<usize, IoError> {
        let before = self.attempts(hash);
        let deaths = if step > before.step {
            1
        } else {
            before.deaths + 1
        };
        let text = serde_json::to_string(&Attempts { deaths, step }).expect("numbers are JSON");
        self.write(&self.path("attempts").join(hash), text.as_bytes())?;
        Ok(deaths)
    }
}

/// Paths in a folder, in no order; none where there is no such folder.
///
/// # Errors
/// A folder that cannot be read.
pub(crate) fn entries(folder: &Path) -> Result<Vec<PathBuf>, IoError> {
    let listed = match fs::read_dir(folder) {
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(vec![]),
        listed => listed.map_err(IoError::read(folder))?,
    };
    let paths = listed.map(|entry| entry.map(|e| e.path()));
    paths
        .collect::<Result<_, _>>()
        .map_err(IoError::read(folder))
}

#[cfg(test)]
mod tests {
    use wingbeat_results::manifest::{hexadecimal, sha256};
    use wingbeat_results::summary::Verdict;

    use super::record::{MAGIC, WITHOUT_POINT, checksum};
    use super::*;

    #[test]
    fn exact_results_come_back_and_damage_is_found() {
        let root = std::env::temp_dir().join(format!("wingbeat-store-{}", std::process::id()));
        let store = Store::open(&root, "text").unwrap();
        let hash = hexadecimal(&[0xa7; 32]);
        let result = PointResult::of(&[0.1 + 0.2, f64::NAN, -1e-300], Some(Verdict::Red));
        store.put(&hash, &result).unwrap();
        assert!(store.has(&hash));
        assert_eq!(store.get(&hash).unwrap(), Some(result));
        let before = r#"{"values":[0.5,null]}"#; // of a version without verdicts
        let found: PointResult = serde_json::from_str(before).unwrap();
        assert_eq!((found.values[0], found.verdict), (Some(0.5), None));
        let path = store.place(&hash, "ok");
        let whole = fs::read(&path).unwrap();
        for k in 0..whole.len() {
            let mut changed = whole.clone();
            changed[k] ^= 4;
            fs::write(&path, &changed).unwrap();
            if k == MAGIC.len() - 2 {
                continue; // the version: a test of its own
            }
            assert_eq!(store.get(&hash).unwrap(), None, "byte {k}");
            assert!(path.exists(), "who only reads removes nothing");
            assert_eq!(store.get_or_remove(&hash).unwrap(), None, "byte {k}");
            assert!(!path.exists(), "it is flown again");
            fs::write(&path, &whole[..k]).unwrap();
            assert_eq!(store.get_or_remove(&hash).unwrap(), None, "cut to {k}");
        }
        let other = hexadecimal(&[0x3c; 32]);
        store
            .make(store.place(&other, "ok").parent().unwrap())
            .unwrap();
        fs::write(store.place(&other, "ok"), &whole).unwrap();
        assert_eq!(store.get(&other).unwrap(), None, "of another point");
        let old = format!("{WITHOUT_POINT}{}\n{before}\n", sha256(before.as_bytes()));
        fs::write(&path, old).unwrap();
        let found = store.get(&hash).unwrap();
        assert_eq!(found.map(|r| r.values[0]), Some(Some(0.5)), "of before");
        assert_eq!(store.count_death(&hash, 0).unwrap(), 1);
        assert_eq!(store.count_death(&hash, 0).unwrap(), 2);
        assert_eq!(store.count_death(&hash, 40).unwrap(), 1, "it advanced");
        // Numbers take the place of a failure, and not the other way round.
        let failure = PointResult::failure(Reason::Died, "taken for dead".to_owned());
        let numbers = PointResult::of(&[0.25], None);
        let third = hexadecimal(&[0x55; 32]);
        for result in [&failure, &numbers, &failure] {
            store.put(&third, result).unwrap();
        }
        assert_eq!(store.get(&third).unwrap(), Some(numbers));
        assert!(!store.place(&third, "failed").exists() && !store.done().unwrap()[&third]);
        fs::remove_dir_all(root).unwrap();
    }

    /// A later version is not damage: neither who reads nor who flies removes what it wrote.
    #[test]
    fn refuses_results_of_other_versions_and_keeps_them() {
        let root = std::env::temp_dir().join(format!("wingbeat-later-{}", std::process::id()));
        let store = Store::open(&root, "text").unwrap();
        let hash = hexadecimal(&[0xa7; 32]);
        store.put(&hash, &PointResult::of(&[0.5], None)).unwrap();
        let path = store.place(&hash, "ok");
        let later = fs::read_to_string(&path)
            .unwrap()
            .replace("point 2 ", "point 3 ");
        let body = r#"{"values":[0.5],"verdict":"violet"}"#;
        let words = format!("{MAGIC}{}\n{body}\n", checksum(&hash, body));
        for (text, unknown) in [(later, "wingbeat-point 3"), (words, "violet")] {
            fs::write(&path, &text).unwrap();
            for found in [store.get(&hash), store.get_or_remove(&hash)] {
                let refused = found.map(drop).unwrap_err().to_string();
                assert!(
                    refused.contains(unknown) && refused.contains("fly the point again"),
                    "{refused}"
                );
            }
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        fs::remove_dir_all(&root).unwrap();
    }

    /// A folder that cannot be read is no folder without results.
    #[test]
    fn refuses_folders_that_cannot_be_read() {
        let root = std::env::temp_dir().join(format!("wingbeat-unread-{}", std::process::id()));
        let store = Store::open(&root, "text").unwrap();
        assert_eq!(store.done().unwrap().len(), 0, "nothing was flown yet");
        store.make(&store.path("points")).unwrap();
        fs::write(store.path("points/notes.txt"), "not of a point").unwrap();
        assert_eq!(store.done().unwrap().len(), 0);
        fs::write(store.path("points/a7"), "no folder").unwrap();
        let refused = store.done().map(drop).unwrap_err().to_string();
        assert!(
            refused.contains("cannot read") && refused.contains("a7"),
            "{refused}"
        );
        fs::remove_dir_all(&root).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn behaves_half_written_results_of_dead_processes_are_removed() {
        let root = std::env::temp_dir().join(format!("wingbeat-parts-{}", std::process::id()));
        let store = Store::open(&root, "text").unwrap();
        let hash = "6b".repeat(32);
        let mut left = vec![store.path("attempts").join(&hash), store.path(FILE)];
        left.extend(["ok", "failed"].map(|ending| store.place(&hash, ending)));
        let place =
            |target: &PathBuf, name: &str| target.with_file_name(format!("{name}.4711.part"));
        let name_of = |target: &PathBuf| target.file_name().unwrap().to_str().unwrap().to_owned();
        let parts: Vec<PathBuf> = left.iter().map(|t| place(t, &name_of(t))).collect();
        let others: Vec<PathBuf> = left.iter().map(|t| place(t, "notes.txt")).collect();
        for part in parts.iter().chain(&others) {
            store.make(part.parent().unwrap()).unwrap();
            fs::write(part, "half").unwrap();
        }
        store.remove_half_written();
        assert!(!parts.iter().any(|p| p.exists()));
        assert!(others.iter().all(|p| p.exists()) && store.path(FILE).exists());
        fs::remove_dir_all(&root).unwrap();
    }
}
