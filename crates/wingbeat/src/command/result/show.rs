//! `wingbeat show` and `wingbeat compare`: what a result says, what two results say.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;
use wingbeat::case::IoError;
use wingbeat::case::{Difference, differences};
use wingbeat::draw::page;
use wingbeat::results::fixed::fixed;
use wingbeat::results::summary::{Estimate, ManyBeats};
use wingbeat::results::{Manifest, ResultDir, Summary};

use crate::command::output::failure::Failure;
use crate::command::output::report::{Report, ReportArgs, line};
use crate::command::result::view::chosen;

/// Arguments of `wingbeat show`.
#[derive(Args)]
pub(crate) struct ShowArgs {
    /// Result directory of the run; default the latest in results/.
    dir: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArgs,
}

/// Arguments of `wingbeat compare`.
#[derive(Args)]
pub(crate) struct CompareArgs {
    /// Result directory of a run.
    first: PathBuf,
    /// Result directory of another run.
    second: PathBuf,
    /// Write both flights, side by side and in step, as a page (HTML) into this file, too;
    /// - is the standard output.
    #[arg(long, value_name = "FILE")]
    page: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArgs,
}

fn read(dir: &Path) -> Result<(Summary, Manifest), IoError> {
    let dir = ResultDir::read(dir)?;
    let manifest = dir.manifest()?;
    let summary = Summary::read(&dir.case()?, &dir.join("history.csv"), &manifest.outcome)?;
    Ok((summary, manifest))
}

/// `wingbeat show`: the summary made again from the history, whatever state the run is in.
pub(crate) fn show(args: &ShowArgs) -> Result<(), Failure> {
    args.report.deliver([], |report, []| {
        let (summary, manifest) = read(&chosen(args.dir.as_deref())?)?;
        report.summary(&summary);
        line!(
            report,
            "\nwingbeat {}, {} threads, {:.1} s of which {:.2} s writing, {} frames",
            manifest.version,
            manifest.threads,
            manifest.wall_time_s,
            manifest.writing_time_s,
            manifest.frames
        );
        if manifest.discarded_sums > 0 {
            line!(
                report,
                "of {} sums over wakes {} were made in vain: above air.summation_tolerance, so that slower ones took over",
                manifest.checked_sums + manifest.discarded_sums,
                manifest.discarded_sums
            );
        }
        report.value("summary", json!(summary));
        report.value("manifest", json!(manifest));
        Ok(())
    })
}

/// `wingbeat compare`: keys in which the cases differ, and the same numbers side by side.
pub(crate) fn compare(args: &CompareArgs) -> Result<(), Failure> {
    args.report.deliver([&args.page], |report, [page]| {
        let dirs = [&args.first, &args.second];
        let [first, second] = [read(dirs[0])?, read(dirs[1])?];
        let case = |dir: &Path| ResultDir::open(dir)?.case();
        let keys = differences(&case(dirs[0])?, &case(dirs[1])?);
        tell_keys(report, dirs, &keys);
        tell_numbers(report, &first.0.beside(&second.0));
        tell_means(report, [&first.0, &second.0]);
        if let Some(file) = page {
            let [first, second] = [ResultDir::read(dirs[0])?, ResultDir::read(dirs[1])?];
            let text = page::pair([&first, &second], 2 * page::DEFAULT_BYTES)?;
            file.write(&text)?;
            if let Some(path) = file.path() {
                line!(report, "\nwrote {}", path.display());
            }
        }
        Ok(())
    })
}

fn tell_keys(report: &mut Report, dirs: [&PathBuf; 2], keys: &[Difference]) {
    let [first, second] = dirs.map(|d| d.display());
    match keys.is_empty() {
        true => line!(report, "{first} and {second}: the same case\n"),
        false => line!(report, "{first} and {second}: cases that differ in\n"),
    }
    for d in keys {
        let or_none = |value: &Option<String>| value.clone().unwrap_or_else(|| "-".to_owned());
        line!(
            report,
            "  {:<36}  {:>14}  {:>14}",
            d.key,
            or_none(&d.first),
            or_none(&d.second)
        );
    }
    if !keys.is_empty() {
        line!(report, "");
    }
    report.value("keys", json!(keys));
}

fn tell_numbers(report: &mut Report, rows: &[(String, f64, f64)]) {
    line!(
        report,
        "{:<38}{:>14}{:>14}{:>14}{:>14}",
        "",
        "first",
        "second",
        "difference",
        "of the first"
    );
    for (what, a, b) in rows {
        let difference = difference(*a, *b);
        let part = difference / a.abs();
        let part = match part.is_finite() {
            true if part.abs() < 1e4 => format!("{}%", fixed(100.0 * part, 2)),
            true => format!("{:.2e}%", 100.0 * part),
            false => "-".to_owned(),
        };
        line!(
            report,
            "{what:<38}{:>14.5e}{:>14.5e}{:>14.5e}{part:>14}",
            a + 0.0,
            b + 0.0,
            difference + 0.0
        );
    }
    let numbers = rows.iter();
    let numbers = numbers.map(|(what, a, b)| json!({ "what": what, "first": a, "second": b }));
    report.value("numbers", numbers.collect::<Vec<_>>());
}

/// Of the second number to the first; none within rounding.
fn difference(first: f64, second: f64) -> f64 {
    const ROUNDING: f64 = 1e-14;
    let difference = second - first;
    match difference.abs() <= ROUNDING * first.abs() {
        true => 0.0,
        false => difference,
    }
}

/// Verdicts, and means over wingbeats with their errors.
fn tell_means(report: &mut Report, [first, second]: [&Summary; 2]) {
    line!(report, "");
    for (which, summary) in [("first", first), ("second", second)] {
        let (word, reason) = (summary.verdict.word(), &summary.verdict_reason);
        line!(report, "{which:<8}{word}: {reason}");
    }
    let verdict = |s: &Summary| json!({ "verdict": s.verdict, "reason": s.verdict_reason });
    report.value("verdicts", json!([verdict(first), verdict(second)]));
    let rows = first.means_beside(second);
    report.value("means", json!(rows));
    let (Some(a), Some(b)) = (&first.means, &second.means) else {
        line!(
            report,
            "no means of wingbeats with errors to compare: both flights need five whole wingbeats or more, three of them after smooth starts and holds"
        );
        return;
    };
    let named = |m: &ManyBeats| format!("beats {} to {}", m.beats[0], m.beats[1]);
    line!(
        report,
        "\n{:<20}{:>26}{:>26}{:>26}",
        "mean +- error",
        named(a),
        named(b),
        "difference"
    );
    for row in &rows {
        let [x, y, d] = [&row.first, &row.second, &row.difference].map(estimate);
        let beyond = match row.is_beyond_errors {
            Some(true) => "  beyond twice its error",
            Some(false) => "  within twice its error",
            None => "",
        };
        line!(report, "{:<20}{x:>26}{y:>26}{d:>26}{beyond}", row.what);
    }
    for (which, means) in [("first", a), ("second", b)] {
        let are = match (means.is_steady, means.is_known) {
            (true, _) => continue,
            (false, true) if means.changes_within_error() => "still drift, within that error",
            (false, true) => "are not steady",
            (false, false) => "are not known to be steady",
        };
        line!(
            report,
            "the beats of the {which} flight {are}: its mean is of these beats alone"
        );
    }
}

fn estimate(e: &Estimate) -> String {
    match e.standard_error {
        Some(error) => format!("{:.4e} +- {error:.1e}", e.mean),
        None => format!("{:.4e}", e.mean),
    }
}
