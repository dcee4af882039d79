//! How far a campaign is.

use std::time::{Duration, SystemTime};

use wingbeat_case::IoError;
use wingbeat_results::manifest::hexadecimal;
use wingbeat_results::summary::Verdict;

use crate::campaign::Campaign;
use crate::store::Store;
use crate::worker::leases;

/// Time over which the rate is taken.
const WINDOW: Duration = Duration::from_secs(30);
/// Points that are looked at, at most: of more, each so many-th for their time, none for their verdict.
const LOOKS: usize = 20_000;

/// How far a campaign is.
#[derive(Clone, Debug, PartialEq)]
pub struct Status {
    /// Points there are.
    pub points: usize,
    /// Points with a result, those that failed among them.
    pub done: usize,
    /// Points that failed.
    pub failed: usize,
    /// Points whose flights are red, and amber; none of more points than are looked at.
    pub doubtful: Option<[usize; 2]>,
    /// Blocks that are being flown.
    pub flying: usize,
    /// Points over the last half minute [1/s]; none where nothing was done in it, or everything is.
    pub rate: Option<f64>,
}

impl Status {
    /// Looks.
    ///
    /// # Errors
    /// A directory that cannot be read.
    pub fn of(campaign: &Campaign, store: &Store) -> Result<Self, IoError> {
        let known = store.done()?;
        let points = campaign.plan().points();
        let (mut done, mut failed, mut names) = (0, 0, vec![]);
        for i in 0..points {
            let hash = hexadecimal(&campaign.hash(i));
            if let Some(bad) = known.get(&hash) {
                done += 1;
                failed += usize::from(*bad);
                names.push((hash, *bad));
            }
        }
        let finished = done == points;
        let flying = if finished {
            0
        } else {
            leases(campaign, store)?.held()?
        };
        Ok(Self {
            points,
            done,
            failed,
            doubtful: doubtful(store, &names)?,
            flying,
            rate: if finished { None } else { rate(store, &names) },
        })
    }

    /// Time that is left at this rate.
    pub fn left(&self) -> Option<Duration> {
        let seconds = (self.points - self.done) as f64 / self.rate?;
        Duration::try_from_secs_f64(seconds).ok()
    }
}

/// Numbers of red and amber flights among these points, if they are not too many to be read.
fn doubtful(store: &Store, names: &[(String, bool)]) -> Result<Option<[usize; 2]>, IoError> {
    if names.len() > LOOKS {
        return Ok(None);
    }
    let mut counts = [0; 2];
    for (hash, _) in names.iter().filter(|(_, failed)| !failed) {
        match store.get(hash)?.and_then(|found| found.verdict) {
            Some(Verdict::Red) => counts[0] += 1,
            Some(Verdict::Amber) => counts[1] += 1,
            Some(Verdict::Green) | None => {}
        }
    }
    Ok(Some(counts))
}

fn rate(store: &Store, names: &[(String, bool)]) -> Option<f64> {
    let stride = names.len() / LOOKS + 1;
    let now = SystemTime::now();
    let ages = names.iter().step_by(stride).filter_map(|(hash, failed)| {
        let ending = if *failed { "failed" } else { "ok" };
        let changed = store.place(hash, ending).metadata().ok()?.modified().ok()?;
        Some(now.duration_since(changed).unwrap_or_default())
    });
    let recent: Vec<Duration> = ages.filter(|age| *age < WINDOW).collect();
    let oldest = recent.iter().max()?.as_secs_f64();
    (recent.len() > 1 && oldest > 0.0).then(|| (stride * recent.len()) as f64 / oldest)
}

/// Forgets failures, so that the next run flies them again; how many there were.
///
/// # Errors
/// A directory that cannot be changed.
pub fn retry(campaign: &Campaign, store: &Store) -> Result<usize, IoError> {
    let leases = leases(campaign, store)?;
    let known = store.done()?;
    let mut forgotten = 0;
    for i in 0..campaign.plan().points() {
        let hash = hexadecimal(&campaign.hash(i));
        if known.get(&hash) == Some(&true) && store.forget_failure(&hash)? {
            leases.undo(i / campaign.block)?;
            forgotten += 1;
        }
    }
    Ok(forgotten)
}
