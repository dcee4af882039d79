//! `wingbeat campaign`: thousands of flights from one file.

mod args;
mod check;
mod master;
mod plan;
mod run;
mod scripts;
mod status;
mod view;
mod work;

use clap::{Args, Subcommand};
use wingbeat::campaign::schema;

use crate::command::output::failure::Failure;
use crate::command::output::terminal::say;

/// Arguments of `wingbeat campaign`.
#[derive(Args)]
pub(crate) struct CampaignArgs {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Say what a campaign holds, and fly three of its points for its cost; nothing is written.
    Check(check::CheckArgs),
    /// Write the table of its points: number, hash, values of the keys.
    Plan(plan::PlanArgs),
    /// Fly its points, in as many processes as the machine has processors; points that are done are not flown again.
    Run(run::RunArgs),
    /// Say how far it is.
    Status(status::StatusArgs),
    /// Forget the points that failed, so that the next run flies them again.
    Retry(args::Place),
    /// Write all points as one table: points.csv, points.parquet, points.nc; and those that failed: failed.csv.
    Merge(plan::MergeArgs),
    /// Write one page that shows all points, and open it in the browser.
    View(view::ViewArgs),
    /// List the numbers that may be kept.
    Numbers(plan::NumbersArgs),
    /// Print a script for `sbatch` that flies it as an array of jobs.
    Slurm(scripts::SlurmArgs),
    /// Print a Snakefile that flies and merges it.
    Snakemake(scripts::SnakemakeArgs),
    /// Print the JSON schema of the files of campaigns, for editors.
    Schema,
    #[command(hide = true)]
    Work(work::WorkArgs),
}

/// The whole command.
pub(crate) fn run(args: &CampaignArgs) -> Result<(), Failure> {
    match &args.command {
        Command::Check(args) => check::check(args),
        Command::Plan(args) => plan::plan(args),
        Command::Run(args) => run::run(args),
        Command::Status(args) => status::status(args),
        Command::Retry(place) => status::retry(place),
        Command::Merge(args) => plan::merge(args),
        Command::View(args) => view::view(args),
        Command::Numbers(args) => plan::numbers(args),
        Command::Slurm(args) => scripts::slurm(args),
        Command::Snakemake(args) => scripts::snakemake(args),
        Command::Schema => {
            say!("{}", schema());
            Ok(())
        }
        Command::Work(args) => work::work(args),
    }
}
