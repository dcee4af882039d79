//! `wingbeat verify`: run the verification suite and write its dossier.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::Instant;

use clap::Args;
use wingbeat::verify::{Case, Dossier, Entry};

use crate::watch::Watch;

/// What `wingbeat verify` is told.
#[derive(Args)]
pub(crate) struct VerifyArgs {
    /// Only the short set, some two minutes on two cores.
    #[arg(long)]
    quick: bool,
    /// Only cases whose name holds this.
    #[arg(long, value_name = "TEXT", default_value = "")]
    only: String,
    /// Folder for verification.md, .csv and .json, which are replaced.
    #[arg(long, value_name = "DIR", default_value = "verification")]
    out: PathBuf,
    /// Go on where an earlier run into the same folder ended: its cases are taken as they are,
    /// those named by `--only` run anew.
    #[arg(long)]
    resume: bool,
    /// Names and contents of the cases; nothing is run.
    #[arg(long)]
    list: bool,
}

/// The whole command: exit code 0 if nothing missed, 1 otherwise.
pub(crate) fn run(args: &VerifyArgs) -> ExitCode {
    let cases = wingbeat::verify::select(args.quick, &args.only);
    if cases.is_empty() {
        eprintln!(
            "error: no case holds `{}`; see `wingbeat verify --list`",
            args.only
        );
        return ExitCode::from(2);
    }
    if args.list {
        cases
            .iter()
            .for_each(|c| println!("{:<28}{}", c.name, c.about));
        return ExitCode::SUCCESS;
    }
    let start = Instant::now();
    let known = if args.resume { earlier(args) } else { vec![] };
    let is_left = |c: &Case| !args.only.is_empty() || known.iter().all(|e| e.case != c.name);
    let left: Vec<Case> = cases.into_iter().filter(is_left).collect();
    let so_far = Mutex::new(known);
    let watch = Watch::of("verifying", left.len() as u64);
    wingbeat::verify::run(&left, args.quick, |e| {
        watch.part(|| tell(e, start));
        keep(&so_far, e, args);
    });
    drop(watch);
    let dossier = Dossier {
        quick: args.quick,
        entries: so_far.into_inner().expect("no case panicked while writing"),
    };
    if let Err(e) = write(&dossier, &args.out) {
        eprintln!(
            "error: {}: {e}; name a folder that can be written",
            args.out.display()
        );
        return ExitCode::from(2);
    }
    let [pass, miss, report] = dossier.counts();
    println!(
        "{pass} rows pass, {miss} miss, {report} are reported; {:.0} s; see {}",
        start.elapsed().as_secs_f64(),
        args.out.join("verification.md").display()
    );
    ExitCode::from(u8::from(miss > 0))
}

/// What an earlier run of the same set left; failures are tried again.
fn earlier(args: &VerifyArgs) -> Vec<Entry> {
    let text = std::fs::read_to_string(args.out.join("verification.json")).unwrap_or_default();
    let same = Dossier::from_json(&text).ok();
    let same = same.filter(|d| d.quick == args.quick);
    let mut entries = same.map_or(vec![], |d| d.entries);
    entries.retain(|e| e.failure.is_none());
    entries
}

/// Writes what is done so far: a long run that is ended early is not lost.
fn keep(so_far: &Mutex<Vec<Entry>>, entry: &Entry, args: &VerifyArgs) {
    let all = wingbeat::verify::select(args.quick, "");
    let mut entries = so_far.lock().expect("no case panicked while writing");
    entries.retain(|e| e.case != entry.case);
    entries.push(entry.clone());
    entries.sort_by_key(|e| all.iter().position(|c| c.name == e.case));
    let dossier = Dossier {
        quick: args.quick,
        entries: entries.clone(),
    };
    // The whole dossier is written at the end, and trouble told then.
    let _ = write(&dossier, &args.out);
}

fn tell(entry: &Entry, start: Instant) {
    let [pass, miss, report] = entry.counts();
    let seconds = start.elapsed().as_secs_f64();
    eprintln!(
        "{seconds:>7.1} s  {:<28} {pass} pass, {miss} miss, {report} reported",
        entry.case
    );
}

fn write(dossier: &Dossier, folder: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    for (name, text) in [
        ("verification.md", dossier.page(env!("CARGO_PKG_VERSION"))),
        ("verification.csv", dossier.csv()),
        ("verification.json", dossier.json()),
    ] {
        std::fs::write(folder.join(name), text)?;
    }
    Ok(())
}
