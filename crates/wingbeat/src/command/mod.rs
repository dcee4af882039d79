//! The command line of `wingbeat`, for the program and for whoever carries it along.

#![deny(clippy::print_stdout, clippy::print_stderr)] // they panic where nobody reads; see `terminal`

mod analyse;
mod campaign;
mod case;
mod cli;
mod flight;
mod help;
mod options;
mod output;
mod progress;
mod result;
mod signals;
mod verify;

use std::ffi::OsString;

use clap::FromArgMatches;

use case::{check, new};
use cli::{Cli, Command};
use flight::{ensemble, run as fly};
use output::failure::Failure;
use output::terminal::{self, say};
use result::{export, plot, show, velocity, view};

/// Does what the command line `args` says, the name of the program first; the exit code. It is made
/// to be called once, at the start of a process: threads and signals are set up for all of it.
///
/// ```
/// assert_eq!(wingbeat::command::main(["wingbeat", "check", "fruit-fly-blade"].map(Into::into)), 0);
/// ```
pub fn main(args: impl IntoIterator<Item = OsString>) -> u8 {
    signals::bear_limits_of_files();
    let matches = help::command().try_get_matches_from(args);
    let code = match matches.and_then(|found| Cli::from_arg_matches(&found)) {
        Ok(cli) => run(cli.command).map_or_else(|failure| failure.tell(), |()| 0),
        Err(message) => terminal::usage(&help::advised(message)),
    };
    terminal::close(code)
}

fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::Run(args) => fly::run(&args),
        Command::Resume(args) => fly::resume(&args),
        Command::View(args) => view::view(&args),
        Command::Plot(args) => plot::plot(&args),
        Command::Export(args) => export::export(&args),
        Command::Show(args) => show::show(&args),
        Command::Compare(args) => show::compare(&args),
        Command::Check(args) => check::check(&args),
        Command::Trim(args) => analyse::trim::run(&args),
        Command::Stability(args) => analyse::stability::run(&args),
        Command::Derivatives(args) => analyse::derivatives::run(&args),
        Command::Power(args) => analyse::power::run(&args),
        Command::Modes(args) => analyse::modes::run(&args),
        Command::Flutter(args) => analyse::flutter::run(&args),
        Command::Stabilise(args) => analyse::stabilise::run(&args),
        Command::Ensemble(args) => ensemble::run(&args),
        Command::Campaign(args) => campaign::run(&args),
        Command::Velocity(args) => velocity::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Presets(args) => new::list(&args),
        Command::New(args) => new::new(&args),
        Command::Schema => {
            say!("{}", wingbeat::case::schema());
            Ok(())
        }
        Command::Completions { shell } => {
            help::completions(shell);
            Ok(())
        }
        Command::Man(args) => help::man(&args),
    }
}
