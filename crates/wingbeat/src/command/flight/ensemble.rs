//! `wingbeat ensemble`: the same flight many times over, from starts that differ by next to nothing.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Args;
use serde_json::json;
use wingbeat::analysis::estimate;
use wingbeat::case::presets;
use wingbeat::flight::Simulation;
use wingbeat::results::summary::{Ensemble, EnsembleBeat, Estimate};
use wingbeat::{Flight, WatchedEnsemble, ensemble_watched};

use crate::command::case::programs::name_program;
use crate::command::options::{self, CaseArgs};
use crate::command::output::failure::{Failure, INTERRUPTED};
use crate::command::output::report::{Report, ReportArgs, line};
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

/// The whole command; Ctrl-C ends the flights after their step, with what is done.
pub(crate) fn run(args: &EnsembleArgs) -> Result<(), Failure> {
    args.report.deliver([], |report, []| {
        let case = args.case.load()?;
        name_program(&case);
        let doubts = estimate(&case.setup).doubts;
        doubts.iter().for_each(|d| tell!("warning: {d}"));
        report.value("warnings", doubts);
        let name = case.name.clone();
        let flown = flown(args, &name, &Flight::from(case))?;
        report.value("case", &*name);
        report.value("complete", flown.unfinished.is_empty());
        report.value("members_of_means", flown.members.clone());
        report.value("unfinished_members", flown.unfinished.clone());
        let found = flown.found();
        if let Ok(found) = &found {
            show(report, &name, found);
        }
        if flown.unfinished.is_empty() {
            return found.map(|_| ()).map_err(Failure::from);
        }
        interrupted(report, &flown, args.members);
        Err(Failure::Told(INTERRUPTED))
    })
}

/// The flights, telling of each that flew to its end, until a signal stops them.
fn flown(args: &EnsembleArgs, name: &str, flight: &Flight) -> Result<WatchedEnsemble, Failure> {
    let stop = stop_flag_after("the flights end after this step");
    let count = args.members;
    let watch = Watch::new(&format!("{count} flights"));
    let done = AtomicUsize::new(0);
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
    Ok(ensemble_watched(flight, count, threads, each)?)
}

/// What an interruption left out.
fn interrupted(report: &mut Report, flown: &WatchedEnsemble, asked: usize) {
    let unfinished = flown.unfinished.len();
    let of = match &flown.ensemble {
        None => "no two of them have a whole wingbeat, and there are no means".to_owned(),
        Some(found) if flown.members.len() == asked - unfinished => {
            format!("the means are of the {} others", found.members)
        }
        Some(found) => format!(
            "the means are of the first {} wingbeats of {} flights",
            found.beats.len(),
            found.members
        ),
    };
    let text = format!(
        "NOT flown to their end, as it was interrupted: {unfinished} of {asked} flights; {of}"
    );
    line!(report, "{text}");
    tell!("interrupted: {unfinished} of {asked} flights were not flown to their end");
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
