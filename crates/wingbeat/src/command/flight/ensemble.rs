//! `wingbeat ensemble`: the same flight many times over, from starts that differ by next to nothing.

use clap::Args;
use serde_json::json;
use wingbeat::analysis::estimate;
use wingbeat::case::presets;
use wingbeat::results::summary::{Ensemble, EnsembleBeat, Estimate};
use wingbeat::{Flight, ensemble};

use crate::command::case::programs::name_program;
use crate::command::options::{self, CaseArgs};
use crate::command::output::failure::Failure;
use crate::command::output::report::{Report, ReportArgs, line};
use crate::command::output::terminal::tell;
use crate::command::progress::watch::watched;

/// Members at most, and unless told otherwise.
const MAX_MEMBERS: usize = 10_000;
const DEFAULT_MEMBERS: usize = 8;

/// Arguments of `wingbeat ensemble`.
#[derive(Args)]
#[command(mut_arg("case", |a| a.required(false).default_value(presets::DEFAULT)))]
pub(crate) struct EnsembleArgs {
    #[command(flatten)]
    case: CaseArgs,
    /// Flights; in all but the first the air moves by a millionth of the wings' speed, and noise of the senses
    /// is another.
    #[arg(long, value_name = "N", default_value_t = DEFAULT_MEMBERS,
          value_parser = options::count::<2, MAX_MEMBERS>)]
    members: usize,
    /// Flights at a time [default: as many as the machine has threads].
    #[arg(long, value_name = "N", value_parser = options::count::<1, { options::MAX_THREADS }>)]
    threads: Option<usize>,
    #[command(flatten)]
    report: ReportArgs,
}

/// The whole command.
pub(crate) fn run(args: &EnsembleArgs) -> Result<(), Failure> {
    args.report.deliver([], |report, []| {
        let case = args.case.load()?;
        name_program(&case);
        let doubts = estimate(&case.setup).doubts;
        doubts.iter().for_each(|d| tell!("warning: {d}"));
        report.value("warnings", doubts);
        let name = case.name.clone();
        let flight = Flight::from(case);
        let what = format!("{} flights", args.members);
        let found = watched(&what, || {
            ensemble(&flight, args.members, args.threads.unwrap_or(0))
        })?;
        show(report, &name, &found);
        Ok(())
    })
}

fn show(report: &mut Report, name: &str, found: &Ensemble) {
    line!(
        report,
        "{name}: {} flights, in all but the first the air moves by a millionth of the wings' speed",
        found.members
    );
    line!(
        report,
        "\n  {:<9}{:>24}{:>26}{:>26}{:>12}",
        "beat",
        "lift over weight",
        "forward",
        "power",
        "spread, %"
    );
    for b in &found.beats {
        row(report, &b.beat.to_string(), b);
    }
    if let Some(means) = &found.means {
        row(
            report,
            &format!("{} to {}", means.beat, found.beats.len()),
            means,
        );
    }
    line!(
        report,
        "  means over the flights +- their standard errors, where the flights are independent; spread: standard deviation of the lift over the flights"
    );
    line!(report, "  {}", found.remark());
    report.value("remark", found.remark());
    report.value("case", name);
    report.value("ensemble", json!(found));
}

fn row(report: &mut Report, name: &str, b: &EnsembleBeat) {
    let ratio = |e: &Estimate| match e.standard_error {
        Some(error) => format!("{:.5} +- {error:.5}", e.mean),
        None => format!("{:.5}", e.mean),
    };
    let lift = b.estimate.lift_over_weight.as_ref();
    line!(
        report,
        "  {name:<9}{:>24}{:>26}{:>26}{:>12.4}",
        lift.map_or_else(|| "-".to_owned(), ratio),
        b.estimate.thrust_newton.in_words("N"),
        b.estimate.power_watt.in_words("W"),
        100.0 * b.spread
    );
}
