//! The members of an ensemble that were flown, kept until all are: an ensemble that was interrupted or killed, or
//! of which members failed, goes on with those that are missing.
//!
//! ```text
//! ensemble.toml        the case as it was flown last, with everything filled in
//! points/ab/HASH.ok    the wingbeats of a member; written whole or not at all, with its checksum
//! ```
//!
//! What a member is filed under follows from version, law, case, number of members and its own number, so that
//! nothing is taken for what it is not.

use std::path::Path;

use sha2::{Digest, Sha256};
use wingbeat_case::{IoError, LoadedCase};
use wingbeat_results::manifest::hexadecimal;
use wingbeat_results::summary::BeatMeans;

use crate::digest::{law_of, of_case};
use crate::plan::named;
use crate::store::{PointResult, Store};

/// The copy of the case.
const FILE: &str = "ensemble.toml";

/// The members of an ensemble that were flown.
#[derive(Clone, Debug)]
pub struct KeptMembers {
    store: Store,
    text: String,
    digest: Sha256,
    count: usize,
}

impl KeptMembers {
    /// Of an ensemble of `count` flights of a case; the folder is made with the first of them.
    ///
    /// # Errors
    /// A folder that holds something else.
    pub fn open(folder: &Path, case: &LoadedCase, count: usize) -> Result<Self, IoError> {
        let remedy =
            "it holds no ensemble (no ensemble.toml): choose another directory with --keep";
        let store = Store::at(folder, FILE, remedy)?;
        store.remove_half_written();
        let mut digest = of_case(case);
        digest.update(law_of(&case.setup));
        if let Some(programs) = named::of_programs(case) {
            digest.update(programs);
        }
        digest.update(format!("ensemble of {count}\n"));
        Ok(Self {
            store,
            text: case.resolved(),
            digest,
            count,
        })
    }

    /// What member `k`, from 0, is filed under.
    fn hash(&self, k: usize) -> String {
        let mut hash = self.digest.clone();
        hash.update(format!("member {k}\n"));
        hexadecimal(&hash.finalize())
    }

    /// How many there are.
    pub fn known(&self) -> usize {
        let all = 0..self.count;
        all.filter(|k| self.store.has(&self.hash(*k))).count()
    }

    /// Means over the wingbeats of member `k`, from 0; none where it was not flown to its end, or its file is damaged.
    ///
    /// # Errors
    /// A file that cannot be read or, a damaged one, removed, or that another version of wingbeat wrote.
    pub fn get(&self, k: usize) -> Result<Option<Vec<BeatMeans>>, IoError> {
        let kept = self.store.get_or_remove(&self.hash(k))?;
        Ok(kept.map(|member| member.beats))
    }

    /// Keeps member `k`, from 0.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn put(&self, k: usize, beats: &[BeatMeans]) -> Result<(), IoError> {
        self.store.keep(&self.text)?;
        self.store
            .put(&self.hash(k), &PointResult::of_member(beats))
    }

    /// Forgets all of them: nothing is missing any more. Those of other ensembles in the folder stay.
    ///
    /// # Errors
    /// A file that cannot be removed.
    pub fn forget(&self) -> Result<(), IoError> {
        (0..self.count).try_for_each(|k| self.store.forget(&self.hash(k)))?;
        self.store.remove_if_empty();
        Ok(())
    }
}
