//! A worker: takes blocks of points, flies them, keeps their results; any number of workers share a directory,
//! without a coordinator.

pub(crate) mod cost;
pub(crate) mod evaluate;
pub(crate) mod flight;
pub(crate) mod lease;
pub(crate) mod point;
pub(crate) mod process;
pub(crate) mod trial;

use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use wingbeat_case::IoError;
use wingbeat_results::manifest::hexadecimal;

use crate::campaign::Campaign;
use crate::store::{PointResult, Reason, Store, entries};
use crate::worker::flight::saved_step;
use crate::worker::lease::{Lease, Leases, Taken};
use crate::worker::point::Done;

/// Time between two looks for a block that somebody has to let go.
const WAIT: Duration = Duration::from_millis(50);
/// Pause after the first failure to write files of a point; twice as long after each further one, up to the longest.
const PAUSE: Duration = Duration::from_secs(1);
const LONGEST_PAUSE: Duration = Duration::from_secs(60);
/// Time between two looks at the size of the directory.
const WEIGH: Duration = Duration::from_secs(10);

/// How a worker ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ended {
    /// All points of its range are done.
    Complete,
    /// It was asked to stop.
    Stopped,
    /// The directory has the size that it may have.
    Full(u64),
}

/// What came of a point that a worker flew.
enum Tried {
    /// It has a result.
    Kept,
    /// Another process is flying it: its block is looked at again.
    Busy,
    /// The worker was asked to stop.
    Stopped,
}

/// A worker.
pub struct Worker<'a> {
    campaign: &'a Campaign,
    store: &'a Store,
    leases: Leases,
    range: Range<usize>,
    /// Blocks whose points of this range are done, from the first of the range.
    complete: Vec<bool>,
    weighed: Option<Instant>,
}

/// Where the leases of a campaign are.
///
/// # Errors
/// A folder that cannot be made.
pub fn leases(campaign: &Campaign, store: &Store) -> Result<Leases, IoError> {
    Leases::new(store.path("leases").join(plan_name(campaign)))
}

/// The plan of a campaign in 16 letters, as its leases and the workers of a master know it.
pub fn plan_name(campaign: &Campaign) -> String {
    hexadecimal(&campaign.plan_hash()[..8])
}

impl<'a> Worker<'a> {
    /// For the points of `range`.
    ///
    /// # Errors
    /// A directory that cannot be written.
    pub fn new(
        campaign: &'a Campaign,
        store: &'a Store,
        range: Range<usize>,
    ) -> Result<Self, IoError> {
        let leases = leases(campaign, store)?;
        leases.beat();
        let blocks = blocks(&range, campaign.block);
        let mut complete = vec![false; blocks.len()];
        for block in leases.done()? {
            if blocks.contains(&block) {
                complete[block - blocks.start] = true;
            }
        }
        Ok(Self {
            campaign,
            store,
            leases,
            range,
            complete,
            weighed: None,
        })
    }

    /// Works until all points of the range are done; `tell` hears of every point that it did.
    ///
    /// # Errors
    /// A directory that cannot be read or written, e.g. on a full disk: everything done is kept.
    pub fn work(&mut self, stop: &AtomicBool, tell: &mut dyn FnMut()) -> Result<Ended, IoError> {
        let blocks = blocks(&self.range, self.campaign.block);
        loop {
            let (mut waits, mut flew) = (false, false);
            for block in blocks.clone() {
                if self.complete[block - blocks.start] {
                    continue;
                }
                if stop.load(Ordering::Relaxed) {
                    return Ok(Ended::Stopped);
                }
                if let Some(full) = self.above_limit()? {
                    return Ok(Ended::Full(full));
                }
                match self.leases.take(block)? {
                    Taken::Done => self.complete[block - blocks.start] = true,
                    Taken::Held => waits |= !self.is_complete(block, blocks.start),
                    Taken::Own(lease, died) => match self.block(lease, block, died, stop, tell)? {
                        true => flew = true,
                        false => waits = true,
                    },
                }
            }
            if self.complete.iter().all(|c| *c) {
                return Ok(Ended::Complete);
            }
            if waits && !flew {
                std::thread::sleep(WAIT);
            }
        }
    }

    /// Of a block that somebody else has, whether the points of this range are done.
    fn is_complete(&mut self, block: usize, first: usize) -> bool {
        let mut points = self.points(block, &self.range);
        let complete = points.all(|i| self.store.has(&hexadecimal(&self.campaign.hash(i))));
        self.complete[block - first] = complete;
        complete
    }

    /// Points of a block that are in a range.
    fn points(&self, block: usize, range: &Range<usize>) -> Range<usize> {
        let n = self.campaign.block;
        (block * n).max(range.start)..((block + 1) * n).min(range.end)
    }

    /// Flies a block that this worker holds; whether its points of this range are done.
    fn block(
        &mut self,
        mut lease: Lease,
        block: usize,
        died: Option<usize>,
        stop: &AtomicBool,
        tell: &mut dyn FnMut(),
    ) -> Result<bool, IoError> {
        if let Some(i) = died.filter(|i| *i < self.campaign.plan().points()) {
            self.count_death(i)?;
        }
        let mut busy = false;
        for i in self.points(block, &self.range) {
            let hash = hexadecimal(&self.campaign.hash(i));
            if self.store.has(&hash) {
                continue;
            }
            if !lease.fly(i)? {
                lease.withdraw(); // somebody took us for dead
                return Ok(false);
            }
            match self.point(i, &hash, stop) {
                Ok(Tried::Kept) => tell(),
                Ok(Tried::Busy) => busy = true,
                Ok(Tried::Stopped) => {
                    lease.rest()?;
                    lease.let_go();
                    return Ok(false);
                }
                Err(e) => {
                    let _ = lease.rest(); // what went wrong before counts
                    lease.let_go();
                    return Err(e);
                }
            }
        }
        lease.rest()?;
        if busy {
            lease.let_go();
            return Ok(false);
        }
        let first = blocks(&self.range, self.campaign.block).start;
        self.complete[block - first] = true;
        let all = 0..self.campaign.plan().points();
        let mut whole = self.points(block, &all);
        match whole.all(|i| {
            self.range.contains(&i) || self.store.has(&hexadecimal(&self.campaign.hash(i)))
        }) {
            true => lease.done()?,
            false => lease.let_go(),
        }
        Ok(true)
    }

    /// Flies a point and keeps its result.
    fn point(&self, i: usize, hash: &str, stop: &AtomicBool) -> Result<Tried, IoError> {
        loop {
            match point::fly(self.campaign, i, hash, Some(self.store), stop) {
                Done::Stopped => return Ok(Tried::Stopped),
                Done::Busy => return Ok(Tried::Busy),
                Done::Result(result) => {
                    self.campaign.refuse_changed_files()?;
                    self.store.put(hash, &result)?;
                    return Ok(Tried::Kept);
                }
                Done::Unwritten(e) if has_no_space(&e) => return Err(e),
                Done::Unwritten(e) => {
                    let deaths = self.store.count_death(hash, 0)?;
                    if deaths >= self.campaign.raw().budget.attempts {
                        let words = format!("{e} ({deaths} attempts)");
                        self.store
                            .put(hash, &PointResult::failure(Reason::Unwritten, words))?;
                        return Ok(Tried::Kept);
                    }
                    rest(pause_after(deaths), stop);
                }
            }
        }
    }

    /// A process died while it flew this point: quarantined if that has happened too often.
    fn count_death(&self, i: usize) -> Result<(), IoError> {
        let hash = hexadecimal(&self.campaign.hash(i));
        if self.store.has(&hash) {
            return Ok(()); // it died right after
        }
        let step = saved_step(&self.store.path("work").join(&hash));
        let deaths = self.store.count_death(&hash, step)?;
        if deaths < self.campaign.raw().budget.attempts {
            return Ok(());
        }
        let words = format!("the process that flew it was killed or died {deaths} times");
        self.store
            .put(&hash, &PointResult::failure(Reason::Died, words))
    }

    /// The size of the directory, where that is more than it may be.
    fn above_limit(&mut self) -> Result<Option<u64>, IoError> {
        let Some(limit) = self.campaign.raw().budget.disk_mb else {
            return Ok(None);
        };
        if self.weighed.is_some_and(|w| w.elapsed() < WEIGH) {
            return Ok(None);
        }
        self.weighed = Some(Instant::now());
        let bytes = size(self.store.root())?;
        Ok((bytes as f64 > limit * 1e6).then_some(bytes))
    }
}

/// How long is waited after so many failures to write.
fn pause_after(failures: usize) -> Duration {
    let doublings = failures.saturating_sub(1).min(10) as u32;
    (PAUSE * 2_u32.pow(doublings)).min(LONGEST_PAUSE)
}

/// Waits, unless it is asked to stop.
fn rest(length: Duration, stop: &AtomicBool) {
    let begun = Instant::now();
    while begun.elapsed() < length && !stop.load(Ordering::Relaxed) {
        std::thread::sleep(WAIT);
    }
}

/// Bytes of all files in a folder; what others remove meanwhile has none.
///
/// # Errors
/// A folder or a file that cannot be read.
fn size(folder: &Path) -> Result<u64, IoError> {
    let of = |path: &PathBuf| match path.symlink_metadata() {
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(0),
        Err(e) => Err(IoError::read(path)(e)),
        Ok(about) if about.is_dir() => size(path),
        Ok(about) => Ok(about.len()),
    };
    entries(folder)?.iter().map(of).sum()
}

/// Whether there is no space, or a file may not grow.
pub fn has_no_space(e: &IoError) -> bool {
    let kinds = [
        ErrorKind::StorageFull,
        ErrorKind::QuotaExceeded,
        ErrorKind::FileTooLarge,
    ];
    matches!(e, IoError::File { source, .. } if kinds.contains(&source.kind()))
}

/// Blocks that have points of a range.
pub fn blocks(range: &Range<usize>, block: usize) -> Range<usize> {
    match range.is_empty() {
        true => 0..0,
        false => range.start / block..(range.end - 1) / block + 1,
    }
}

/// Before work begins: damaged results are removed, and so are those of flights that lack the files that are
/// kept of them, and blocks that lack results are no longer done. How many points of the range are done.
///
/// # Errors
/// A directory that cannot be read or written.
pub fn inspect(campaign: &Campaign, store: &Store, range: &Range<usize>) -> Result<usize, IoError> {
    let leases = leases(campaign, store)?;
    let finished: std::collections::HashSet<usize> = leases.done()?.into_iter().collect();
    let known = store.done()?;
    let mut done = 0;
    for i in range.clone() {
        let hash = hexadecimal(&campaign.hash(i));
        let there = match known.get(&hash) {
            None => false,
            Some(_) if store.get_or_remove(&hash)?.is_none() => false,
            Some(failed) if *failed || point::has_files(campaign, i, &hash, store) => true,
            Some(_) => {
                store.forget(&hash)?;
                false
            }
        };
        done += usize::from(there);
        let block = i / campaign.block;
        if !there && finished.contains(&block) {
            leases.undo(block)?;
        }
    }
    Ok(done)
}

/// Points of the range that have no result, by the names of the results alone.
///
/// # Errors
/// A directory that cannot be read.
pub fn left(campaign: &Campaign, store: &Store, range: &Range<usize>) -> Result<usize, IoError> {
    let known = store.done()?;
    let lacks = |i: &usize| !known.contains_key(&hexadecimal(&campaign.hash(*i)));
    Ok(range.clone().filter(lacks).count())
}
