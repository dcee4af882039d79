//! `wingbeat campaign run`: local processes fly the points.

use clap::Args;
use wingbeat::campaign::{Campaign, Status, Store, inspect, left, plan_name};

use super::args::{Place, PointSelection};
use super::master::{Master, processors};
use crate::command::case::programs::name_program;
use crate::command::options;
use crate::command::output::failure::{Failure, INTERRUPTED};
use crate::command::output::terminal::{say, tell};
use crate::command::signals::stop_flag;

/// Arguments of `wingbeat campaign run`.
#[derive(Args)]
pub(super) struct RunArgs {
    #[command(flatten)]
    place: Place,
    #[command(flatten)]
    part: PointSelection,
    /// Processes [default: as many as the machine has processors].
    #[arg(long, value_name = "N", value_parser = options::count::<1, { options::MAX_THREADS }>)]
    jobs: Option<usize>,
    /// No progress and no summary on the terminal.
    #[arg(long)]
    quiet: bool,
    /// Look through the results of all points, whichever are flown: others will fly the rest.
    #[arg(long, hide = true)]
    inspect: bool,
}

/// The whole command.
pub(super) fn run(args: &RunArgs) -> Result<(), Failure> {
    let campaign = args.place.campaign()?;
    let range = args.part.range(campaign.plan().points())?;
    let folder = args.place.folder(&campaign);
    let store = Store::open(&folder, campaign.text())?;
    store.remove_half_written();
    if args.inspect {
        inspect(&campaign, &store, &(0..campaign.plan().points()))?;
    }
    let done = inspect(&campaign, &store, &range)?;
    if !args.quiet {
        let name = campaign.name();
        tell!(
            "{name}: {} points, {done} of them done; results go to {}",
            range.len(),
            folder.display()
        );
    }
    if done < range.len() {
        name_program(campaign.base());
        let jobs = args.jobs.unwrap_or_else(processors);
        let stop = stop_flag();
        let (file, plan) = (&args.place.file, plan_name(&campaign));
        let mut master = Master::new(file, &folder, &plan, range.clone(), args.quiet);
        let worked = master.work(jobs, done, &stop);
        warn_of_programs(&campaign);
        worked?;
    }
    let left = left(&campaign, &store, &range)?;
    if left > 0 {
        tell!("interrupted: {left} points are left; the same command goes on");
        return Err(Failure::Told(INTERRUPTED));
    }
    match args.quiet {
        true => Ok(()),
        false => finish(&campaign, &store, &args.place),
    }
}

/// Says which files of programs have changed meanwhile: what is in them belongs to the points.
fn warn_of_programs(campaign: &Campaign) {
    for path in campaign.changed_programs() {
        tell!(
            "warning: `{}` was changed while the points were flown; the command of a program names it, so it belongs to every point and the next run flies them again: if the program writes it, leave its name out of the command",
            path.display()
        );
    }
}

fn finish(campaign: &Campaign, store: &Store, place: &Place) -> Result<(), Failure> {
    let status = Status::of(campaign, store)?;
    let place = place.words();
    say!(
        "{} of {} points are done, {} failed.",
        status.done,
        status.points,
        status.failed
    );
    if status.done == status.points {
        say!(
            "`wingbeat campaign merge {place}` writes them as one table, `wingbeat campaign view {place}` shows them."
        );
    }
    if status.failed > 0 {
        say!(
            "failed.csv of the merge has those that failed; `wingbeat campaign retry {place}` has them flown again."
        );
    }
    Ok(())
}
