//! `wingbeat campaign status` and `retry`.

use std::time::Duration;

use clap::Args;
use wingbeat::campaign::{Status, plan_name, retry as forget};

use super::args::{Place, duration};
use crate::command::output::failure::Failure;
use crate::command::output::terminal::{output_is_given_up, say};

/// Time between two lines of `--watch`.
const WATCH: Duration = Duration::from_secs(2);

/// Arguments of `wingbeat campaign status`.
#[derive(Args)]
pub(super) struct StatusArgs {
    #[command(flatten)]
    place: Place,
    /// Go on saying it until all points are done.
    #[arg(long)]
    watch: bool,
    /// As one JSON object, with --watch one on each line.
    #[arg(long)]
    json: bool,
}

/// `wingbeat campaign status`.
pub(super) fn status(args: &StatusArgs) -> Result<(), Failure> {
    let (campaign, store) = args.place.existing()?;
    loop {
        let status = Status::of(&campaign, &store)?;
        match args.json {
            true => say!("{}", json(&status, &plan_name(&campaign))),
            false => say!("{}: {}", campaign.name(), words(&status)),
        }
        if !args.watch || status.done == status.points || output_is_given_up() {
            return Ok(());
        }
        std::thread::sleep(WATCH);
    }
}

fn json(status: &Status, plan: &str) -> String {
    serde_json::json!({
        "points": status.points,
        "done": status.done,
        "failed": status.failed,
        "red": status.doubtful.map(|d| d[0]),
        "amber": status.doubtful.map(|d| d[1]),
        "blocks_in_flight": status.flying,
        "points_per_s": status.rate,
        "plan": plan,
        "seconds_left": status.left().map(|t| t.as_secs_f64()),
    })
    .to_string()
}

fn words(status: &Status) -> String {
    let Status {
        points,
        done,
        failed,
        flying,
        ..
    } = status;
    let mut text = format!("{done} of {points} points done, {failed} failed");
    if let Some([red, amber]) = status.doubtful.filter(|d| *d != [0, 0]) {
        text += &format!(", {red} red and {amber} amber (`verdict` in the tables)");
    }
    if done < points {
        text += &format!(", {flying} blocks in flight");
    }
    if let (Some(rate), Some(left)) = (status.rate, status.left()) {
        text += &format!(
            ", {rate:.1} points a second, {} left",
            duration(left.as_secs_f64())
        );
    }
    text
}

/// `wingbeat campaign retry`.
pub(super) fn retry(place: &Place) -> Result<(), Failure> {
    let (campaign, store) = place.existing()?;
    let count = forget(&campaign, &store)?;
    say!(
        "{count} points that failed are forgotten; `wingbeat campaign run {}` flies them again.",
        place.words()
    );
    Ok(())
}
