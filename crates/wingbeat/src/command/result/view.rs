//! `wingbeat view`: the flight page, opened in the browser.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use clap::Args;
use wingbeat::case::IoError;
use wingbeat::draw::page;
use wingbeat::results::file::{Existing, NewFile};
use wingbeat::results::{Outcome, RESULTS, ResultDir, latest_run};

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
    let bytes = (args.size * 1e6) as usize;
    let page = match page::write(&dir, &outcome, bytes) {
        Ok(page) => {
            say!("wrote {}", page.display());
            page
        }
        Err(IoError::File { path, source, .. }) if path == dir.join(page::FILE) => {
            tell!("{} stays as it is: {source}", dir.path().display());
            elsewhere(&dir, &outcome, bytes)?
        }
        Err(e) => return Err(e.into()),
    };
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

/// The page of a run whose folder cannot be written to: the one that lies there if it shows the whole flight, else a
/// new one in the folder for temporary files.
fn elsewhere(dir: &ResultDir, outcome: &Outcome, bytes: usize) -> Result<PathBuf, IoError> {
    if let Some(page) = page::finished(dir) {
        say!("the page of the run is {}", page.display());
        return Ok(page);
    }
    let name = format!("wingbeat-{}-{}.html", dir.case()?.name, std::process::id());
    let file = NewFile::claim(&std::env::temp_dir().join(name), Existing::Kept)?;
    file.write(page::text(dir, outcome, bytes)?.as_bytes())?;
    say!("wrote {}", file.path().display());
    Ok(file.path().to_owned())
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
