//! Which campaign, and which of its points.

use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Args;
use wingbeat::campaign::{Campaign, Store};
use wingbeat::case::{IoError, operand, shell_path};
use wingbeat::results::RESULTS;

use crate::command::output::failure::Failure;
use crate::command::output::target::folder;

/// A campaign and its directory.
#[derive(Args, Clone)]
pub(super) struct Place {
    /// File of the campaign.
    pub(super) file: PathBuf,
    /// Its directory; default results/NAME.
    #[arg(long, value_name = "DIR", value_parser = folder())]
    pub(super) out: Option<PathBuf>,
}

impl Place {
    /// Reads the campaign.
    pub(super) fn campaign(&self) -> Result<Campaign, IoError> {
        Campaign::read(&self.file)
    }

    /// Its directory.
    pub(super) fn folder(&self, campaign: &Campaign) -> PathBuf {
        let default = || Path::new(RESULTS).join(campaign.name());
        operand(&self.out.clone().unwrap_or_else(default))
    }

    /// What a shell takes for this place in a command.
    pub(super) fn words(&self) -> String {
        let file = shell_path(&self.file);
        match &self.out {
            Some(out) => format!("{file} --out {}", shell_path(out)),
            None => file,
        }
    }

    /// The campaign and its directory, which is there.
    pub(super) fn existing(&self) -> Result<(Campaign, Store), IoError> {
        let campaign = self.campaign()?;
        let store = Store::existing(&self.folder(&campaign))?;
        Ok((campaign, store))
    }
}

/// Some of the points.
#[derive(Args, Clone)]
pub(super) struct PointSelection {
    /// Only the k-th of N equal parts, e.g. 2/8.
    #[arg(long, value_name = "K/N", value_parser = shard, conflicts_with = "points",
          allow_hyphen_values = true)]
    pub(super) shard: Option<(usize, usize)>,
    /// Only points a to b, b left out; counted from 0.
    #[arg(long, value_name = "A..B", value_parser = points, allow_hyphen_values = true)]
    pub(super) points: Option<Range<usize>>,
}

impl PointSelection {
    /// The points, of so many there are.
    pub(super) fn range(&self, points: usize) -> Result<Range<usize>, Failure> {
        match (&self.shard, &self.points) {
            (Some((k, n)), _) => {
                let at = |k: usize| (points as u128 * k as u128 / *n as u128) as usize;
                Ok(at(k - 1)..at(*k))
            }
            (None, Some(range)) if range.end <= points => Ok(range.clone()),
            (None, Some(range)) => Err(Failure::Option(format!(
                "--points {}..{}: the campaign has {points} points, 0..{points}",
                range.start, range.end
            ))),
            (None, None) => Ok(0..points),
        }
    }
}

fn shard(text: &str) -> Result<(usize, usize), String> {
    let parts = text.split_once('/');
    let parts = parts.and_then(|(k, n)| Some((k.trim().parse().ok()?, n.trim().parse().ok()?)));
    let valid = parts.filter(|(k, n)| (1..=*n).contains(k));
    valid.ok_or_else(|| "give K/N with K from 1 to N, e.g. 2/8".to_owned())
}

fn points(text: &str) -> Result<Range<usize>, String> {
    let ends = text.split_once("..");
    let ends = ends.and_then(|(a, b)| Some(a.trim().parse().ok()?..b.trim().parse().ok()?));
    let valid = ends.filter(|r: &Range<usize>| r.start < r.end);
    valid.ok_or_else(|| "give A..B with A below B, e.g. 0..100".to_owned())
}

/// A time in words.
pub(super) fn duration(seconds: f64) -> String {
    let time = std::time::Duration::try_from_secs_f64(seconds).unwrap_or(std::time::Duration::MAX);
    indicatif::HumanDuration(time).to_string()
}
