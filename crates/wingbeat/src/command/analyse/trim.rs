//! `wingbeat trim`.

use std::path::PathBuf;

use clap::Args;
use wingbeat::case::{lacks_feedback, trimmed_case, wake_trimmed_case};

use super::sweeping;
use super::trimming::{Trimming, trimmed, trimmed_with_wake};
use crate::command::options;
use crate::command::output::failure::Failure;
use crate::command::output::report::line;

/// Speeds of a sweep at most, and unless told otherwise.
const MAX_POINTS: usize = 1000;
const DEFAULT_POINTS: usize = 11;

/// Arguments of `wingbeat trim`.
#[derive(Args)]
pub(crate) struct TrimArgs {
    #[command(flatten)]
    trimming: Trimming,
    /// Write the trimmed flight as a case file; - is the standard output.
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
    /// Instead: trims at speeds forward from FROM to TO, m/s, with the power of each.
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], allow_negative_numbers = true,
          value_parser = options::speed, conflicts_with_all = ["forward", "write"])]
    sweep: Option<Vec<f64>>,
    /// Speeds of a sweep [default: 11].
    #[arg(long, value_name = "N", requires = "sweep", value_parser = options::count::<2, MAX_POINTS>)]
    points: Option<usize>,
    /// Draw the sweep as SVG; - is the standard output.
    #[arg(long, value_name = "FILE", requires = "sweep")]
    figure: Option<PathBuf>,
}

/// The whole command.
pub(crate) fn run(args: &TrimArgs) -> Result<(), Failure> {
    let trimming = &args.trimming;
    let others = [&args.write, &args.figure];
    trimming.report.deliver(others, |report, [file, figure]| {
        if let Some(&[from, to]) = args.sweep.as_deref() {
            if from == to {
                let problem = "--sweep: FROM and TO are the same speed; use --forward for one";
                return Err(Failure::Option(problem.to_owned()));
            }
            let points = args.points.unwrap_or(DEFAULT_POINTS);
            return sweeping::run(trimming, [from, to], points, report, figure);
        }
        let (text, is_without) = if trimming.load()?.setup.has_memory() {
            let (case, trim) = trimmed_with_wake(trimming, report)?;
            let lacks = lacks_feedback(&case, &trim.solution);
            (wake_trimmed_case(&case, &trim), lacks)
        } else {
            let (case, trim) = trimmed(trimming, report)?;
            let lacks = lacks_feedback(&case, &trim.solution);
            (trimmed_case(&case, &trim)?, lacks)
        };
        if let Some(file) = file {
            file.write(&text)?;
            report.wrote(&file);
            if is_without {
                line!(report, "without its feedback (control), which is designed for flights that are alike on the right and on the left");
            }
        }
        Ok(())
    })
}
