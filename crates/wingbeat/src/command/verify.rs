//! `wingbeat verify`: run the verification suite and write its report.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;

use clap::Args;
use serde_json::json;
use wingbeat::case::IoError;
use wingbeat::draw::figures::{Chart, Panel, Series};
use wingbeat::results::file::{Existing, NewFile, write_file};
use wingbeat::verify::{Case, Comparison, Entry, Report};

use crate::command::output::failure::{FAILED, Failure};
use crate::command::output::target::folder;
use crate::command::output::terminal::{say, tell};
use crate::command::progress::watch::Watch;

/// Arguments of `wingbeat verify`.
#[derive(Args)]
pub(crate) struct VerifyArgs {
    /// Only the short set, some two minutes on two cores.
    #[arg(long)]
    quick: bool,
    /// Only cases whose name holds this.
    #[arg(long, value_name = "TEXT", default_value = "")]
    only: String,
    /// Folder for verification.md, .csv and .json, and in `verification/` the figures that the page shows.
    #[arg(long, value_name = "DIR", default_value = "verification", value_parser = folder())]
    out: PathBuf,
    /// Go on where an earlier run into the same folder ended: its cases are taken as they are,
    /// those named by `--only` run again.
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    /// Replace a report that is there already.
    #[arg(long)]
    overwrite: bool,
    /// Names and contents of the cases; nothing is run.
    #[arg(long, conflicts_with_all = ["out", "resume", "overwrite"])]
    list: bool,
    /// The result, or the list, as one JSON object.
    #[arg(long)]
    json: bool,
}

/// The whole command: a failure if a row fails.
pub(crate) fn run(args: &VerifyArgs) -> Result<(), Failure> {
    let cases = wingbeat::verify::select(args.quick, &args.only);
    if cases.is_empty() {
        return Err(Failure::Option(format!(
            "no case holds `{}`; see `wingbeat verify --list`",
            args.only
        )));
    }
    if args.list {
        let named = |c: &Case| json!({ "name": c.name, "about": c.about });
        match args.json {
            true => say!(
                "{}",
                json!({ "cases": cases.iter().map(named).collect::<Vec<_>>() })
            ),
            false => cases.iter().for_each(|c| say!("{:<28}{}", c.name, c.about)),
        }
        return Ok(());
    }
    let files = claim(args)?;
    let start = Instant::now();
    let known = if args.resume { earlier(args)? } else { vec![] };
    let is_left = |c: &Case| !args.only.is_empty() || known.iter().all(|e| e.case != c.name);
    let left: Vec<Case> = cases.into_iter().filter(is_left).collect();
    let so_far = Mutex::new(known);
    let watch = Watch::of("verifying", left.len() as u64);
    wingbeat::verify::run(&left, args.quick, |e| {
        watch.part(|| note(e, start));
        keep(&so_far, e, args, &files);
    });
    drop(watch);
    let report = Report {
        quick: args.quick,
        entries: so_far.into_inner().expect("no case panicked while writing"),
    };
    write(&report, &files)?;
    draw(&report, args)?;
    tell_result(args, &report, start, files[0].path());
    match report.counts() {
        [_, 0, _] => Ok(()),
        _ => Err(Failure::Told(FAILED)),
    }
}

/// How many rows pass, and where to read about them.
fn tell_result(args: &VerifyArgs, report: &Report, start: Instant, page: &Path) {
    let [pass, fail, unjudged] = report.counts();
    let seconds = start.elapsed().as_secs_f64();
    if args.json {
        let rows = json!({ "pass": pass, "fail": fail, "reported": unjudged });
        say!(
            "{}",
            json!({ "rows": rows, "seconds": seconds, "report": page })
        );
        return;
    }
    say!(
        "{pass} rows pass, {fail} fail, {unjudged} are reported; {seconds:.0} s; see {}",
        page.display()
    );
}

/// The files of the report, page, table and data.
fn claim(args: &VerifyArgs) -> Result<[NewFile; 3], IoError> {
    wingbeat::results::file::make_folder(&args.out)?;
    let existing = Existing::kept_unless(args.overwrite || args.resume);
    let figures = args.out.join(Report::FIGURES);
    if existing == Existing::Kept && figures.exists() {
        return Err(IoError::Exists {
            path: figures,
            remedy: "pass --overwrite to replace the report and its figures",
        });
    }
    let file = |name: &str| NewFile::claim(&args.out.join(name), existing);
    Ok([
        file("verification.md")?,
        file("verification.csv")?,
        file("verification.json")?,
    ])
}

/// The figures of cases that have courses to show.
fn draw(report: &Report, args: &VerifyArgs) -> Result<(), IoError> {
    let folder = args.out.join(Report::FIGURES);
    for entry in &report.entries {
        for (k, figure) in entry.figures().iter().enumerate() {
            wingbeat::results::file::make_folder(&folder)?;
            let svg = chart(&entry.case, figure).to_svg();
            write_file(
                &folder.join(entry.figure_name(k)),
                svg.as_bytes(),
                Existing::Replaced,
            )?;
        }
    }
    Ok(())
}

/// One pair of axes for each quantity: what is compared with in black, what was computed in colours.
fn chart(case: &str, figure: &[&Comparison]) -> Chart {
    let mut panels: Vec<Panel> = vec![];
    for c in figure {
        let series = |label: &str, k: usize, measured| Series {
            label: label.to_owned(),
            values: c.points.iter().map(|p| p[k]).collect(),
            measured,
        };
        let place = panels.iter().position(|p| p.label == c.quantity);
        let place = place.unwrap_or_else(|| {
            let given = series(&c.against, 1, true);
            panels.push(Panel {
                label: c.quantity.to_string(),
                series: vec![given],
                ..Panel::default()
            });
            panels.len() - 1
        });
        panels[place].series.push(series(&c.name, 2, false));
    }
    Chart {
        title: case.to_owned(),
        x_label: figure[0].along.to_string(),
        x: figure[0].points.iter().map(|p| p[0]).collect(),
        shaded: vec![],
        panels,
    }
}

/// What an earlier run of the same set left; failures are tried again.
fn earlier(args: &VerifyArgs) -> Result<Vec<Entry>, Failure> {
    let path = args.out.join("verification.json");
    let foreign = |problem: &str| {
        Failure::Option(format!(
            "--resume: `{}` {problem}; leave --resume out, or name another folder",
            path.display()
        ))
    };
    let text = match std::fs::read_to_string(&path) {
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(vec![]),
        text => text.map_err(|e| foreign(&format!("cannot be read: {e}")))?,
    };
    let report = Report::from_json(&text).map_err(|_| foreign("is no verification report"))?;
    if report.quick != args.quick {
        return Err(foreign("is of the other set (--quick)"));
    }
    let mut entries = report.entries;
    entries.retain(|e| e.failure.is_none());
    Ok(entries)
}

/// Writes what is done so far: a long run that is ended early is not lost.
fn keep(so_far: &Mutex<Vec<Entry>>, entry: &Entry, args: &VerifyArgs, files: &[NewFile; 3]) {
    let all = wingbeat::verify::select(args.quick, "");
    let mut entries = so_far.lock().expect("no case panicked while writing");
    entries.retain(|e| e.case != entry.case);
    entries.push(entry.clone());
    entries.sort_by_key(|e| all.iter().position(|c| c.name == e.case));
    let report = Report {
        quick: args.quick,
        entries: entries.clone(),
    };
    // The whole report is written at the end, and what goes wrong is reported then.
    let _ = write(&report, files);
}

fn note(entry: &Entry, start: Instant) {
    let [pass, fail, unjudged] = entry.counts();
    let seconds = start.elapsed().as_secs_f64();
    tell!(
        "{seconds:>7.1} s  {:<28} {pass} pass, {fail} fail, {unjudged} reported",
        entry.case
    );
}

fn write(report: &Report, files: &[NewFile; 3]) -> Result<(), IoError> {
    let page = report.page(env!("CARGO_PKG_VERSION"));
    let texts = [page, report.csv(), report.json()];
    let mut written = files.iter().zip(&texts);
    written.try_for_each(|(file, text)| file.replace(text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat::verify::{Part, Row};

    /// Two models beside one reference share a pair of axes; courses of other places have a figure of their
    /// own, and a case without courses has none.
    #[test]
    fn exact_courses_of_one_quantity_share_their_axes() {
        let course = |quantity: &'static str, name: &'static str| {
            let course = Comparison::over_a_beat(quantity, name, &[1.0, 2.0], &[3.0, 4.0]);
            Row::new("x", "1", course.rms_error()).drawn(course)
        };
        let mut entry = Entry {
            case: "case".into(),
            about: "".into(),
            part: Part::Experiments,
            rows: vec![
                course("lift", "a"),
                course("drag", "a"),
                course("lift", "b"),
            ],
            failure: None,
        };
        assert!(entry.rows.iter().all(|r| r.computed == 2.0));
        let drawn = chart("case", &entry.figures()[0]);
        let [lift, drag] = &drawn.panels[..] else {
            panic!("two quantities");
        };
        let labels: Vec<&str> = lift.series.iter().map(|s| s.label.as_str()).collect();
        assert_eq!(labels, ["reference", "a", "b"]);
        assert_eq!(lift.series[0].values, [3.0, 4.0]);
        assert_eq!((drag.series.len(), drawn.x), (2, vec![0.0, 0.5]));
        // Half as many points over the beat: other places.
        let other = Comparison::over_a_beat("power", "a", &[1.0], &[3.0]);
        entry.rows.push(Row::new("x", "1", 0.0).drawn(other));
        let panels = |k: usize| chart("case", &entry.figures()[k]).panels.len();
        assert_eq!([panels(0), panels(1)], [2, 1]);
        assert_eq!(
            [0, 1].map(|k| entry.figure_name(k)),
            ["case.svg", "case-2.svg"]
        );
        entry.rows.truncate(0);
        assert!(entry.figures().is_empty());
    }
}
