//! `wingbeat show` and `wingbeat compare`: what a result says, what two results say.

use std::path::{Path, PathBuf};

use clap::Args;
use wingbeat::case::IoError;
use wingbeat::case::differences;
use wingbeat::draw::page;
use wingbeat::results::fixed::fixed;
use wingbeat::results::{Manifest, ResultDir, Summary};

use crate::command::failure::Failure;
use crate::command::target::Target;
use crate::command::terminal::{self, say};

/// Arguments of `wingbeat show`.
#[derive(Args)]
pub(crate) struct ShowArgs {
    /// Result directory of the run.
    dir: PathBuf,
    /// As JSON: summary and manifest.
    #[arg(long)]
    json: bool,
}

/// Arguments of `wingbeat compare`.
#[derive(Args)]
pub(crate) struct CompareArgs {
    /// Result directory of a run.
    first: PathBuf,
    /// Result directory of another run.
    second: PathBuf,
    /// As JSON.
    #[arg(long)]
    json: bool,
    /// Write both flights, side by side and in step, as a page (HTML) into this file;
    /// - is the standard output.
    #[arg(long, value_name = "FILE", conflicts_with = "json")]
    page: Option<PathBuf>,
    /// Replace the page if it is there already.
    #[arg(long, requires = "page")]
    overwrite: bool,
}

fn read(dir: &Path) -> Result<(Summary, Manifest), IoError> {
    let dir = ResultDir::read(dir)?;
    let manifest = dir.manifest()?;
    let summary = Summary::read(&dir.case()?, &dir.join("history.csv"), &manifest.outcome)?;
    Ok((summary, manifest))
}

/// `wingbeat show`: the summary made again from the history, whatever state the run is in.
pub(crate) fn show(args: &ShowArgs) -> Result<(), Failure> {
    let (summary, manifest) = read(&args.dir)?;
    if args.json {
        say!(
            "{}",
            serde_json::json!({ "summary": summary, "manifest": manifest })
        );
        return Ok(());
    }
    say!("{}", terminal::judged(&summary).trim_end_matches('\n'));
    say!(
        "\nwingbeat {}, {} threads, {:.1} s of which {:.2} s writing, {} frames",
        manifest.version,
        manifest.threads,
        manifest.wall_time_s,
        manifest.writing_time_s,
        manifest.frames
    );
    Ok(())
}

/// `wingbeat compare`: keys in which the cases differ, and the same numbers side by side.
pub(crate) fn compare(args: &CompareArgs) -> Result<(), Failure> {
    if let Some(file) = &args.page {
        return write_pair(args, &Target::claim(file, args.overwrite)?);
    }
    let [first, second] = [read(&args.first)?, read(&args.second)?];
    let case = |dir: &Path| ResultDir::open(dir)?.case();
    let keys = differences(&case(&args.first)?, &case(&args.second)?);
    let rows = first.0.beside(&second.0);
    if args.json {
        let numbers: Vec<_> = rows
            .iter()
            .map(|(what, a, b)| serde_json::json!({ "what": what, "first": a, "second": b }))
            .collect();
        say!(
            "{}",
            serde_json::json!({ "keys": keys, "numbers": numbers })
        );
        return Ok(());
    }
    let (first, second) = (args.first.display(), args.second.display());
    match keys.is_empty() {
        true => say!("{first} and {second}: the same case\n"),
        false => say!("{first} and {second}: cases that differ in\n"),
    }
    for d in &keys {
        let or_none = |value: &Option<String>| value.clone().unwrap_or_else(|| "-".to_owned());
        say!(
            "  {:<36}{:>14}  {:>14}",
            d.key,
            or_none(&d.first),
            or_none(&d.second)
        );
    }
    say!(
        "{}{:<38}{:>14}{:>14}{:>14}{:>11}",
        if keys.is_empty() { "" } else { "\n" },
        "",
        "first",
        "second",
        "difference",
        "relative"
    );
    for (what, a, b) in rows {
        let scale = a.abs().max(b.abs());
        let relative = if scale > 0.0 { (b - a) / scale } else { 0.0 };
        say!(
            "{what:<38}{:>14.5e}{:>14.5e}{:>14.5e}{:>10}%",
            a + 0.0,
            b + 0.0,
            b - a + 0.0,
            fixed(100.0 * relative, 2)
        );
    }
    Ok(())
}

/// Both flights as one page.
fn write_pair(args: &CompareArgs, file: &Target) -> Result<(), Failure> {
    let [first, second] = [
        ResultDir::read(&args.first)?,
        ResultDir::read(&args.second)?,
    ];
    let page = page::pair([&first, &second], 2 * page::DEFAULT_BYTES)?;
    file.write(&page)?;
    if let Some(path) = file.path() {
        say!("wrote {}", path.display());
    }
    Ok(())
}
