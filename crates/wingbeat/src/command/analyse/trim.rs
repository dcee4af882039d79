//! `wingbeat trim`.

use std::path::PathBuf;

use clap::Args;
use wingbeat::case::{trimmed_case, wake_trimmed_case};

use super::trimming::{Trimming, trimmed, trimmed_with_wake};
use crate::command::failure::Failure;

/// Arguments of `wingbeat trim`.
#[derive(Args)]
pub(crate) struct TrimArgs {
    #[command(flatten)]
    trimming: Trimming,
    /// Write the trimmed flight as a case file; - is the standard output.
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
}

/// The whole command.
pub(crate) fn run(args: &TrimArgs) -> Result<(), Failure> {
    let trimming = &args.trimming;
    trimming.report.deliver([&args.write], |report, [file]| {
        let text = if trimming.load()?.setup.air.has_memory() {
            let (case, trim) = trimmed_with_wake(trimming, report)?;
            wake_trimmed_case(&case, &trim)
        } else {
            let (case, trim) = trimmed(trimming, report)?;
            trimmed_case(&case, &trim)
        };
        if let Some(file) = file {
            file.write(&text)?;
            report.wrote(&file);
        }
        Ok(())
    })
}
