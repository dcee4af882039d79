//! `wingbeat ensemble`: the same flight many times over, from starts that differ by next to nothing.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Args;
use serde_json::{Value, json};
use wingbeat::analysis::estimate;
use wingbeat::case::presets;
use wingbeat::flight::Simulation;
use wingbeat::results::RESULTS;
use wingbeat::results::summary::{Ensemble, EnsembleBeat, Estimate};
use wingbeat::{FailedMember, Flight, WatchedEnsemble, ensemble_watched, members_kept};

use crate::command::case::programs::name_program;
use crate::command::options::{self, CaseArgs};
use crate::command::output::failure::{FAILED, Failure, INTERRUPTED};
use crate::command::output::report::{Report, ReportArgs, line};
use crate::command::output::target::folder;
use crate::command::output::terminal::tell;
use crate::command::progress::watch::Watch;
use crate::command::signals::stop_flag_after;

/// Members at most, and unless told otherwise.
const MAX_MEMBERS: usize = 10_000;
const DEFAULT_MEMBERS: usize = 8;

/// Arguments of `wingbeat ensemble`.
#[derive(Args)]
#[command(mut_arg("case", |a| a.required(false).default_value(presets::DEFAULT)))]
pub(crate) struct EnsembleArgs {
    #[command(flatten)]
    case: CaseArgs,
    /// Number of flights; all but the first start in air that moves at a millionth of the wings' speed, each with sensor
    /// noise of its own.
    #[arg(long, value_name = "N", default_value_t = DEFAULT_MEMBERS,
          value_parser = options::count::<2, MAX_MEMBERS>)]
    members: usize,
    /// Flights at a time [default: as many as the machine has threads].
    #[arg(long, value_name = "N", value_parser = options::count::<1, { options::MAX_THREADS }>)]
    threads: Option<usize>,
    /// Where flights are kept until all are flown: the same command goes on with those that are missing; default
    /// results/NAME-ensemble.
    #[arg(long, value_name = "DIR", value_parser = folder())]
    keep: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArgs,
}

/// The whole command; Ctrl-C ends the flights after their step, with what is done.
pub(crate) fn run(args: &EnsembleArgs) -> Result<(), Failure> {
    args.report.deliver([], |report, []| {
        let case = args.case.load()?;
        name_program(&case);
        let doubts = estimate(&case.setup).doubts;
        doubts.iter().for_each(|d| tell!("warning: {d}"));
        report.value("warnings", doubts);
        let name = case.name.clone();
        let default = || Path::new(RESULTS).join(format!("{name}-ensemble"));
        let folder = args.keep.clone().unwrap_or_else(default);
        let flown = flown(args, &name, &Flight::from(case), &folder)?;
        report.value("case", &*name);
        report.value("complete", flown.is_complete());
        report.value("members_of_means", flown.members.clone());
        report.value("unfinished_members", flown.unfinished.clone());
        report.value(
            "failed_members",
            flown.failed.iter().map(failed).collect::<Vec<_>>(),
        );
        let found = flown.found();
        if let Ok(found) = &found {
            show(report, &name, found);
        }
        if flown.is_complete() {
            return found.map(|_| ()).map_err(Failure::from);
        }
        incomplete(report, &flown, args.members);
        if flown.unfinished.len() + flown.failed.len() < args.members {
            tell_kept(&flown, &folder);
        }
        Err(Failure::Told(match flown.unfinished.is_empty() {
            true => FAILED,
            false => INTERRUPTED,
        }))
    })
}

/// The flights that are missing, telling of each that flew to its end, until a signal stops them.
fn flown(
    args: &EnsembleArgs,
    name: &str,
    flight: &Flight,
    folder: &Path,
) -> Result<WatchedEnsemble, Failure> {
    let count = args.members;
    let before = members_kept(flight, count, folder)?;
    if before > 0 {
        let place = folder.display();
        tell!("{name}: goes on with {before} of {count} flights done, which are kept in {place}");
    }
    let stop = stop_flag_after("the flights end after this step");
    let watch = Watch::new(&format!("{count} flights"));
    let done = AtomicUsize::new(before);
    let each = |_, flight: &Simulation| {
        if flight.finished() {
            let done = 1 + done.fetch_add(1, Ordering::Relaxed);
            watch.told(&format!("{name}: {done} of {count} flights"));
        }
        match stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    };
    let threads = args.threads.unwrap_or(0);
    Ok(ensemble_watched(
        flight,
        count,
        threads,
        Some(folder),
        each,
    )?)
}

/// A member that failed, for programs.
fn failed(member: &FailedMember) -> Value {
    json!({ "member": member.member, "step": member.step, "why": member.error.to_string() })
}

/// What the means are of, where members failed or were interrupted, and which and why.
fn incomplete(report: &mut Report, flown: &WatchedEnsemble, asked: usize) {
    let [unfinished, failed] = [flown.unfinished.len(), flown.failed.len()];
    let of = match &flown.ensemble {
        None => "no two of the others have a whole wingbeat, and there are no means".to_owned(),
        Some(found) if flown.members.len() == asked - unfinished - failed => {
            format!("the means are of the {} others", found.members)
        }
        Some(found) => format!(
            "the means are of the first {} wingbeats of {} flights",
            found.beats.len(),
            found.members
        ),
    };
    let why = match (unfinished, failed) {
        (n, 0) => format!("as it was interrupted: {n} of {asked} flights"),
        (0, n) => format!("as they could not go on: {n} of {asked} flights"),
        (n, m) => {
            format!("{n} of {asked} flights as it was interrupted, {m} as they could not go on")
        }
    };
    line!(report, "NOT flown to their end, {why}; {of}");
    for FailedMember {
        member,
        step,
        error,
    } in &flown.failed
    {
        line!(
            report,
            "  flight {member} failed after step {step}: {error}"
        );
    }
    if unfinished > 0 {
        tell!("interrupted: {unfinished} of {asked} flights were not flown to their end");
    }
    if failed > 0 {
        tell!("error: {failed} of {asked} flights could not go on; the report says why");
    }
}

/// How what is missing is flown.
fn tell_kept(flown: &WatchedEnsemble, folder: &Path) {
    match &flown.not_kept {
        None => tell!(
            "flights that came to their end are kept in {}; the same command goes on with the others",
            folder.display()
        ),
        Some(e) => {
            tell!("warning: flights could not be kept, and the same command flies them again: {e}")
        }
    }
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
