//! `wingbeat campaign check`: points, cost, disk.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;
use wingbeat::campaign::{Campaign, Cost};

use super::args::duration;
use super::master::processors;
use crate::command::options;
use crate::command::output::failure::Failure;
use crate::command::output::report::{Report, ReportArgs, entry, line};
use crate::command::output::terminal::tell;
use crate::command::progress::watch::watched;

/// Arguments of `wingbeat campaign check`.
#[derive(Args)]
pub(super) struct CheckArgs {
    /// File of the campaign.
    file: PathBuf,
    /// Processes, for which its time is estimated [default: as many as the machine has processors].
    #[arg(long, value_name = "N", value_parser = options::count::<1, { options::MAX_THREADS }>)]
    jobs: Option<usize>,
    #[command(flatten)]
    report: ReportArgs,
}

/// The whole command.
pub(super) fn check(args: &CheckArgs) -> Result<(), Failure> {
    args.report.deliver([], |report, []| {
        let campaign = Campaign::read(&args.file)?;
        describe(report, &campaign);
        let doubts = campaign.doubts();
        doubts.iter().for_each(|d| tell!("warning: {d}"));
        report.value("warnings", json!(doubts));
        if campaign.base().program().is_some() || campaign.base().control_program().is_some() {
            entry!(
                report,
                "cost",
                "not tried: a check does not start other programs"
            );
            return Ok(());
        }
        let cost = watched("three points", || Cost::of(&campaign));
        show(
            report,
            &campaign,
            &cost,
            args.jobs.unwrap_or_else(processors),
        );
        Ok(())
    })
}

fn describe(report: &mut Report, campaign: &Campaign) {
    let plan = campaign.plan();
    line!(
        report,
        "{}: this campaign can be run.\n",
        campaign.path.display()
    );
    entry!(report, "case", "{}", campaign.base().origin());
    report.value("campaign", campaign.name());
    let mut axes: Vec<String> = plan
        .axes
        .iter()
        .map(|a| format!("{} ({})", a.keys.join(", "), a.len()))
        .collect();
    if !plan.samplers.is_empty() {
        let keys: Vec<&str> = plan.samplers.iter().map(|s| s.key()).collect();
        axes.push(format!("{} samples of {}", plan.samples, keys.join(", ")));
    }
    entry!(
        report,
        "points",
        "{}: {}",
        plan.points(),
        if axes.is_empty() {
            "the case itself".to_owned()
        } else {
            axes.join(" x ")
        }
    );
    report.value("points", plan.points());
    report.value("shape", json!(plan.shape()));
    let tasks: Vec<&str> = campaign.raw().tasks.iter().map(|t| t.name()).collect();
    entry!(report, "do", "{}", tasks.join(", "));
    let numbers: Vec<&str> = campaign.numbers.iter().map(|n| n.name.as_str()).collect();
    entry!(report, "keep", "{}", numbers.join(", "));
    report.value("keep", json!(numbers));
}

fn show(report: &mut Report, campaign: &Campaign, cost: &Cost, jobs: usize) {
    for (i, time, failed) in &cost.samples {
        let failed = failed
            .as_ref()
            .map_or_else(String::new, |e| format!(", failed: {e}"));
        entry!(
            report,
            "sample",
            "point {i}: {:.3} s{failed}",
            time.as_secs_f64()
        );
    }
    let each = cost.per_point().as_secs_f64();
    let all = each * campaign.plan().points() as f64 / jobs as f64;
    entry!(
        report,
        "cost",
        "{:.3} s a point; {} in {jobs} processes",
        each,
        duration(all)
    );
    entry!(
        report,
        "disk",
        "{:.1} MB of results{}",
        cost.results_bytes as f64 / 1e6,
        if campaign.raw().files.is_empty() {
            ""
        } else {
            ", and the files that are kept"
        }
    );
    report.value("seconds_per_point", each);
    report.value("seconds", all);
    report.value("processes", jobs);
    report.value("results_bytes", cost.results_bytes);
    let failed = cost.samples.iter().filter(|s| s.2.is_some()).count();
    report.value("failed_samples", failed);
}
