//! `wingbeat view`: the flight page, opened in the browser.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use clap::Args;
use wingbeat::draw::page;
use wingbeat::results::{RESULTS, ResultDir, latest_run};

use crate::command::options;
use crate::command::output::failure::Failure;
use crate::command::output::terminal::{say, tell};

/// Arguments of `wingbeat view`.
#[derive(Args)]
pub(crate) struct ViewArgs {
    /// Result directory of the run; default the latest in results/.
    dir: Option<PathBuf>,
    /// Only write the page.
    #[arg(long)]
    no_open: bool,
    /// Largest size of the page, MB; the flight is thinned to fit.
    #[arg(long, value_name = "MB", default_value_t = page::DEFAULT_BYTES as f64 / 1e6,
          value_parser = options::megabytes)]
    size: f64,
}

/// The run that was named, or the latest of the folder that runs go into, which is then named.
pub(crate) fn chosen(dir: Option<&Path>) -> Result<PathBuf, Failure> {
    if let Some(dir) = dir {
        return Ok(dir.to_owned());
    }
    let Some(latest) = latest_run(Path::new(RESULTS)) else {
        let problem =
            format!("give the result directory of a run: there is none in {RESULTS}/ here");
        return Err(Failure::Option(problem));
    };
    tell!("{}", latest.display());
    Ok(latest)
}

/// The whole command.
pub(crate) fn view(args: &ViewArgs) -> Result<(), Failure> {
    let dir = ResultDir::read(&chosen(args.dir.as_deref())?)?;
    let outcome = dir.manifest()?.outcome;
    let page = page::write(&dir, &outcome, (args.size * 1e6) as usize)?;
    say!("wrote {}", page.display());
    let bytes = std::fs::metadata(&page).map_or(0, |m| m.len()) as f64;
    if bytes > args.size * 1e6 {
        say!(
            "It has {:.3} MB, larger than the {} MB asked for: its program and plots are never left out.",
            bytes / 1e6,
            args.size
        );
    }
    if !args.no_open && !open(&page) {
        say!("No browser could be started: open this file in one.");
    }
    Ok(())
}

/// Hands a file to the browser the system prefers.
pub(crate) fn open(page: &Path) -> bool {
    let starter: &[&str] = match std::env::consts::OS {
        "macos" => &["open"],
        // No shell: in one, what follows `&` in a path would be run.
        "windows" => &["rundll32", "url.dll,FileProtocolHandler"],
        _ => &["xdg-open"],
    };
    let mut command = Command::new(starter[0]);
    command.args(&starter[1..]).arg(page);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|s| s.success())
}
