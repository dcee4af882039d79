//! `wingbeat campaign slurm` and `snakemake`.

use clap::Args;
use wingbeat::campaign::Engine;

use wingbeat::case::operand;

use super::args::Place;
use crate::command::options::{self, MAX_THREADS};
use crate::command::output::failure::Failure;
use crate::command::output::terminal::output;

/// Parts at most.
const MAX_SHARDS: usize = 100_000;

/// Arguments of `wingbeat campaign slurm`.
#[derive(Args)]
pub(super) struct SlurmArgs {
    #[command(flatten)]
    place: Place,
    /// Jobs of the array.
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = options::count::<1, MAX_SHARDS>)]
    shards: usize,
    /// Processors of each job.
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = options::count::<1, MAX_THREADS>)]
    jobs: usize,
    /// Time limit of each job, as SLURM writes it.
    #[arg(long, default_value = "04:00:00", value_parser = time)]
    time: String,
}

/// Arguments of `wingbeat campaign snakemake`.
#[derive(Args)]
pub(super) struct SnakemakeArgs {
    #[command(flatten)]
    place: Place,
    /// Jobs.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = options::count::<1, MAX_SHARDS>)]
    shards: usize,
    /// Processors of each job.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = options::count::<1, MAX_THREADS>)]
    jobs: usize,
}

/// `wingbeat campaign slurm`.
pub(super) fn slurm(args: &SlurmArgs) -> Result<(), Failure> {
    let campaign = args.place.campaign()?;
    let [file, out] = words(&args.place, &args.place.folder(&campaign))?;
    let engine = Engine {
        file: &file,
        out: &out,
        shards: args.shards.min(campaign.plan().points()),
        jobs: args.jobs,
    };
    output(format_args!("{}", engine.slurm(&campaign, &args.time)));
    Ok(())
}

/// `wingbeat campaign snakemake`.
pub(super) fn snakemake(args: &SnakemakeArgs) -> Result<(), Failure> {
    let campaign = args.place.campaign()?;
    let [file, out] = words(&args.place, &args.place.folder(&campaign))?;
    let engine = Engine {
        file: &file,
        out: &out,
        shards: args.shards.min(campaign.plan().points()),
        jobs: args.jobs,
    };
    let inputs = campaign.inputs();
    let inputs: Vec<_> = inputs.iter().map(|p| p.display().to_string()).collect();
    output(format_args!("{}", engine.snakemake(&inputs)));
    Ok(())
}

/// File and directory, in which a script can stand between quotation marks.
fn words(place: &Place, folder: &std::path::Path) -> Result<[String; 2], Failure> {
    let plain = |c: char| c.is_alphanumeric() || "-_./ =+,:@%~".contains(c);
    let [file, out] = [&operand(&place.file), folder].map(|p| p.display().to_string());
    match [&file, &out].iter().find(|w| !w.chars().all(plain)) {
        None => Ok([file, out]),
        Some(word) => Err(Failure::Option(format!(
            "`{word}` cannot stand in a script; use a path of letters, digits and -_./ =+,:@%~"
        ))),
    }
}

fn time(text: &str) -> Result<String, String> {
    let plain = !text.is_empty() && text.chars().all(|c| c.is_ascii_digit() || ":-".contains(c));
    plain
        .then(|| text.to_owned())
        .ok_or_else(|| "give a time as SLURM writes it, e.g. 04:00:00 or 1-12".to_owned())
}
