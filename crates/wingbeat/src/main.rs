//! The wingbeat command line.

#![deny(clippy::print_stdout, clippy::print_stderr)] // they panic where nobody reads; see `terminal`

mod analyse;
mod check;
mod expectation;
mod export;
mod failure;
mod help;
mod options;
mod pace;
mod plot;
mod progress;
mod remaining;
mod report;
mod run;
mod show;
mod signals;
mod terminal;
mod velocity;
mod verify;
mod view;
mod watch;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, FromArgMatches, Parser, Subcommand};
use clap_complete::Shell;
use wingbeat::case::{self, presets};
use wingbeat::results::file::NewFile;

use failure::Failure;
use terminal::say;

/// Threads at most.
const MOST_THREADS: usize = 1024;

/// Simulator of flapping-wing flight.
///
/// Exit codes: 0 done; 1 the flight, the writing or a print failed midway (what was flown is kept);
/// 2 nothing was run: command line, case or output directory cannot be used; 130 interrupted by
/// Ctrl-C or SIGTERM (what was flown is kept).
#[derive(Parser)]
#[command(version, max_term_width = 100, styles = help::STYLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Fly a case file or a preset; without one, the fruit fly in free hovering flight.
    Run(RunArgs),
    /// Go on with a run that was interrupted, killed or ran out of disk, bit for bit.
    Resume(ResumeArgs),
    /// Write the flight page of a run, one HTML file, and open it in the browser.
    View(view::ViewArgs),
    /// Draw figures of a run: SVG or PNG for papers and screens, or an animation.
    Plot(plot::PlotArgs),
    /// Write a run in a format of other programs: hdf5, vtkhdf, parquet or gltf.
    Export(export::ExportArgs),
    /// Say what happened in a run, finished or not.
    Show(show::ShowArgs),
    /// Set the numbers of two runs side by side.
    Compare(show::CompareArgs),
    /// Check a case file or preset without flying it, and say what it holds.
    Check {
        /// Case file or preset.
        case: String,
        /// Set a key of the case, e.g. time.beats=3 (may be repeated).
        #[arg(long = "set", value_name = "KEY=VALUE")]
        set: Vec<String>,
        /// Build and try lattices, too, that take long to build.
        #[arg(long)]
        trial: bool,
    },
    /// Find the wing motion and attitude that hold a steady flight: a periodic orbit of the full
    /// model.
    Trim(analyse::trim::TrimArgs),
    /// Trim, then give derivatives, modes averaged over the beat, and Floquet's modes.
    Stability(analyse::stability::StabilityArgs),
    /// Trim, then give the control derivatives of every wing.
    Derivatives(analyse::Trimming),
    /// Trim, then give the mechanical power of flapping.
    Power(analyse::power::PowerArgs),
    /// Trim, disturb, and fly under feedback.
    Stabilise(analyse::stabilise::StabiliseArgs),
    /// The velocity of the air at points, on a line or on a plane, from a run.
    Velocity(velocity::VelocityArgs),
    /// Run the verification suite and write its dossier: what is claimed of the air, against what,
    /// how far off.
    Verify(verify::VerifyArgs),
    /// List the presets and the shipped sets of wing angles.
    Presets,
    /// Write a preset as a commented case file to start from.
    New(NewArgs),
    /// Print the JSON schema of case files, for editors.
    Schema,
    /// Print the completions of a shell.
    Completions {
        /// Which shell.
        shell: Shell,
    },
    /// Write manual pages: one of the program, one of each command.
    Man(help::ManArgs),
}

/// What `wingbeat run` is told.
#[derive(Args)]
struct RunArgs {
    /// Case file or preset.
    #[arg(default_value = presets::DEFAULT)]
    case: String,
    /// Result directory; default results/NAME, with a number appended if that exists.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace an earlier run in the result directory.
    #[arg(long, requires = "out")]
    overwrite: bool,
    /// Set a key of the case, e.g. time.beats=3 (may be repeated).
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    manner: Manner,
}

/// What `wingbeat resume` is told.
#[derive(Args)]
struct ResumeArgs {
    /// Result directory of the run.
    dir: PathBuf,
    #[command(flatten)]
    manner: Manner,
}

/// What `wingbeat new` is told.
#[derive(Args)]
struct NewArgs {
    /// Name of the preset.
    preset: String,
    /// File to write; default PRESET.toml.
    file: Option<PathBuf>,
    /// Replace the file if there is one.
    #[arg(long)]
    overwrite: bool,
}

/// How a flight is computed and shown.
#[derive(Args)]
struct Manner {
    /// Threads to use; default all. Results do not depend on it.
    #[arg(long, value_name = "N", value_parser = options::count::<1, MOST_THREADS>)]
    threads: Option<usize>,
    /// No progress and no summary on the terminal.
    #[arg(long)]
    quiet: bool,
    /// Progress and summary as JSON, one object per line.
    #[arg(long, conflicts_with = "quiet")]
    json: bool,
}

impl Manner {
    /// Whether nothing is said in words.
    fn silent(&self) -> bool {
        self.quiet || self.json
    }
}

fn main() -> ExitCode {
    let matches = help::command().try_get_matches();
    let code = match matches.and_then(|found| Cli::from_arg_matches(&found)) {
        Ok(cli) => run(cli.command).map_or_else(|failure| failure.tell(), |()| 0),
        Err(message) => terminal::usage(&help::advised(message)),
    };
    ExitCode::from(terminal::close(code))
}

fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::Run(args) => run::run(&args),
        Command::Resume(args) => run::resume(&args),
        Command::View(args) => view::view(&args),
        Command::Plot(args) => plot::plot(&args),
        Command::Export(args) => export::export(&args),
        Command::Show(args) => show::show(&args),
        Command::Compare(args) => show::compare(&args),
        Command::Check { case, set, trial } => check::check(&case, &set, trial),
        Command::Trim(args) => analyse::trim::run(&args),
        Command::Stability(args) => analyse::stability::run(&args),
        Command::Derivatives(args) => analyse::derivatives::run(&args),
        Command::Power(args) => analyse::power::run(&args),
        Command::Stabilise(args) => analyse::stabilise::run(&args),
        Command::Velocity(args) => velocity::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Presets => {
            list();
            Ok(())
        }
        Command::New(args) => new(&args),
        Command::Schema => {
            say!("{}", case::schema());
            Ok(())
        }
        Command::Completions { shell } => {
            help::completions(shell);
            Ok(())
        }
        Command::Man(args) => help::man(&args),
    }
}

fn new(args: &NewArgs) -> Result<(), Failure> {
    let preset = presets::find(&args.preset)?;
    let named = || PathBuf::from(format!("{}.toml", preset.name));
    let file = NewFile::claim(&args.file.clone().unwrap_or_else(named), args.overwrite)?;
    file.write(preset.text.as_bytes())?;
    say!(
        "wrote {0}; fly it with `wingbeat run {0}`",
        file.path().display()
    );
    Ok(())
}

fn list() {
    say!("Presets (wingbeat run NAME, wingbeat new NAME):");
    for preset in presets::PRESETS {
        say!("  {:<27}{}", preset.name, preset.line());
    }
    say!("\nSets of wing angles (motion.data):");
    for (name, line) in case::data_sets() {
        say!("  {name:<28}{line}");
    }
}
