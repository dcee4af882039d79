//! The command line: every command with its arguments.

use std::path::PathBuf;

use clap::builder::styling::{AnsiColor, Styles};
use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;

use super::case::{check, new};
use super::flight::{ensemble, run};
use super::output::report::ReportArgs;
use super::output::target::folder;
use super::result::{export, plot, show, velocity, view};
use super::{analyse, campaign, verify};

/// Columns of the help at most.
pub(crate) const MAX_WIDTH: usize = 100;

/// Colours of help and errors, as cargo has them.
pub(crate) const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().bold())
    .usage(AnsiColor::Green.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

/// Simulator of flapping-wing flight.
///
/// Exit codes: 0 done; 1 the flight, one of an ensemble, the writing or a print failed midway (what was flown is kept);
/// 2 nothing was run: command line, case or output directory cannot be used; 130 a flight was
/// interrupted by Ctrl-C or SIGTERM (what was flown is kept). `ensemble`, `flutter` and
/// `trim --sweep` report what is done when these signals end them; all other analyses end at once.
#[derive(Parser)]
#[command(version, max_term_width = MAX_WIDTH, styles = STYLES)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Fly a case file or a preset; without one, the fruit fly in free hovering flight.
    Run(run::RunArgs),
    /// Fly a case many times over, from starts that differ by next to nothing: means with their errors.
    Ensemble(ensemble::EnsembleArgs),
    /// Fly thousands of points from one file: grids and samples of any keys, on any number of processes.
    Campaign(campaign::CampaignArgs),
    /// Go on with a run that was interrupted, killed or ran out of disk, bit for bit.
    Resume(run::ResumeArgs),
    /// Write the flight page of a run, one HTML file, and open it in the browser.
    View(view::ViewArgs),
    /// Draw figures of a run: SVG, PNG or PDF for papers and screens, or an animation.
    Plot(plot::PlotArgs),
    /// Write a run in a format of other programs: hdf5, vtkhdf, parquet or gltf.
    Export(export::ExportArgs),
    /// Say what happened in a run, finished or not.
    Show(show::ShowArgs),
    /// Set the numbers of two runs side by side.
    Compare(show::CompareArgs),
    /// Check a case file or preset without flying it, and say what it holds.
    Check(check::CheckArgs),
    /// Find the wing motion and attitude that hold a steady flight: a periodic orbit of the full
    /// model.
    Trim(analyse::trim::TrimArgs),
    /// Trim, then give derivatives, modes averaged over the beat, and Floquet's modes.
    Stability(analyse::stability::StabilityArgs),
    /// Trim, then give the control derivatives of every wing.
    #[command(mut_arg("case", |case| case.help(analyse::trimming::BLADE_OR_TOWED_CASE)))]
    Derivatives(analyse::trimming::Trimming),
    /// Trim, then give the mechanical power of flapping.
    Power(analyse::power::PowerArgs),
    /// Frequencies and shapes of the vibrations of elastic wings, in vacuum and with the added mass of the air.
    Modes(analyse::modes::ModesArgs),
    /// Find the speeds of a stream at which the vibrations of elastic wings grow: frequency and damping about
    /// the deformed steady state.
    Flutter(analyse::flutter::FlutterArgs),
    /// Trim, disturb, and fly under feedback.
    #[command(mut_arg("case", |case| case.help(analyse::trimming::BLADE_CASE)))]
    #[command(mut_arg("hold", |hold| hold.hide(true)), mut_arg("tolerance", |tolerance| tolerance.hide(true)))]
    Stabilise(analyse::stabilise::StabiliseArgs),
    /// The velocity of the air at points, on a line or on a plane, from a run.
    ///
    /// A point has no core, and with algebraic cores the squared core of a pair is the mean of both: the speed
    /// about a filament whose core is radius_m is Gamma / (2 pi) h / (h^2 + radius_m^2 / 2), largest at 0.71
    /// radius_m from it.
    Velocity(velocity::VelocityArgs),
    /// Run the verification suite and write its report: what is claimed of the air, against what,
    /// how far off.
    Verify(verify::VerifyArgs),
    /// List the presets, the species and the shipped sets of wing angles.
    Presets(ReportArgs),
    /// Write a commented case file to start from: a preset, a species, or an insect by its size.
    New(new::NewArgs),
    /// Print the JSON schema of case files, for editors: the file that the first line of a case names.
    Schema,
    /// Print the completions of a shell.
    Completions {
        /// Which shell.
        shell: Shell,
    },
    /// Write manual pages: one of the program, one of each command.
    Man(ManArgs),
}

/// Arguments of `wingbeat man`.
#[derive(Args)]
pub(crate) struct ManArgs {
    /// Folder for the pages.
    #[arg(value_parser = folder())]
    pub(crate) dir: PathBuf,
    /// Replace files that exist already.
    #[arg(long)]
    pub(crate) overwrite: bool,
}
