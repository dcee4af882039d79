//! The wingbeat command line.

mod analyse;
mod check;
mod expectation;
mod export;
mod pace;
mod plot;
mod progress;
mod remaining;
mod run;
mod show;
mod velocity;
mod verify;
mod view;
mod watch;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};
use wingbeat::case::{self, IoError, presets};

/// Simulator of flapping-wing flight.
///
/// Exit codes: 0 done; 1 the flight or the writing failed midway (what was flown is kept);
/// 2 nothing was run: command line, case or output directory cannot be used; 130 interrupted by
/// Ctrl-C or SIGTERM (what was flown is kept).
#[derive(Parser)]
#[command(version, max_term_width = 100)]
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
    /// Write a preset as a commented case file to start from; never over an existing file.
    New {
        /// Name of the preset.
        preset: String,
        /// File to write; default PRESET.toml.
        file: Option<PathBuf>,
    },
    /// Print the JSON schema of case files, for editors.
    Schema,
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

/// How a flight is computed and shown.
#[derive(Args)]
struct Manner {
    /// Threads to use; default all. Results do not depend on it.
    #[arg(long, value_name = "N")]
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
    end_quietly_when_nobody_reads();
    let cli = Cli::parse();
    let outcome = match cli.command {
        Command::Run(args) => return run::run(&args),
        Command::Resume(args) => return run::resume(&args),
        Command::View(args) => view::view(&args),
        Command::Plot(args) => plot::plot(&args),
        Command::Export(args) => export::export(&args),
        Command::Show(args) => show::show(&args),
        Command::Compare(args) => show::compare(&args),
        Command::Check { case, set, trial } => check::check(&case, &set, trial),
        Command::Trim(args) => return analyse::trim::run(&args),
        Command::Stability(args) => return analyse::stability::run(&args),
        Command::Derivatives(args) => return analyse::derivatives::run(&args),
        Command::Power(args) => return analyse::power::run(&args),
        Command::Stabilise(args) => return analyse::stabilise::run(&args),
        Command::Velocity(args) => return velocity::run(&args),
        Command::Verify(args) => return verify::run(&args),
        Command::Presets => {
            list();
            Ok(())
        }
        Command::New { preset, file } => presets::write(&preset, file.as_deref()).map(|path| {
            println!("wrote {0}; fly it with `wingbeat run {0}`", path.display());
        }),
        Command::Schema => {
            println!("{}", case::schema());
            Ok(())
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(e) => refuse(&e),
    }
}

/// `wingbeat ... | head` is no failure: a reader who has seen enough ends the program.
fn end_quietly_when_nobody_reads() {
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        let text = info.payload().downcast_ref::<String>();
        if text.is_some_and(|t| t.starts_with("failed printing to stdout")) {
            std::process::exit(0);
        }
        report(info);
    }));
}

/// Reports an error that kept anything from being run.
fn refuse(e: &IoError) -> ExitCode {
    match e {
        IoError::Case(report) => eprintln!("{report}"), // begins with `error:` itself
        other => eprintln!("error: {other}"),
    }
    ExitCode::from(2)
}

fn list() {
    println!("Presets (wingbeat run NAME, wingbeat new NAME):");
    for preset in presets::PRESETS {
        println!("  {:<27}{}", preset.name, preset.line());
    }
    println!("\nSets of wing angles (motion.data):");
    for (name, line) in case::data_sets() {
        println!("  {name:<28}{line}");
    }
}
