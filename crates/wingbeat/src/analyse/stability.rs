//! `wingbeat stability`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use wingbeat::analysis::stability::{LOADS, LinearModel};
use wingbeat::analysis::wake::{WakeMemory, wake_floquet};
use wingbeat::analysis::{ModeSet, floquet, linear_model, table_model};
use wingbeat::case::{LoadedCase, derivative_case, write_new};
use wingbeat::flight::AirModel;

use super::{Trimming, Trouble, exit, trimmed, trimmed_with_wake, watched};

/// What `wingbeat stability` is told.
#[derive(Args)]
pub(crate) struct StabilityArgs {
    #[command(flatten)]
    trimming: Trimming,
    /// Write the averaged model as a case file with stability derivatives; never over an
    /// existing file.
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
    /// In a vortex lattice: what is held fixed when the body is disturbed.
    #[arg(long, value_enum, default_value_t = Wake::Carried)]
    wake: Wake,
}

/// What is held fixed.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Wake {
    /// The wake of the trimmed flight; the body jumps at its release.
    Given,
    /// The disturbance during the hold: the wake goes with it.
    Carried,
}

/// The whole command.
pub(crate) fn run(args: &StabilityArgs) -> ExitCode {
    exit(find(args))
}

fn find(args: &StabilityArgs) -> Result<(), Trouble> {
    let case = args.trimming.load()?;
    if matches!(case.setup.air, AirModel::Derivatives(_)) {
        return table(&case);
    }
    if case.setup.air.has_memory() {
        return with_wake(args);
    }
    let (case, trim) = trimmed(&args.trimming)?;
    let averaged = watched("averaged model", || linear_model(&trim.beat, &trim.state))?;
    let orbit = watched("Floquet's modes", || floquet(&trim.beat, &trim.state))?;
    derivatives(&averaged);
    println!("\nModes of the rigid body under mean loads (averaged over the beat):");
    modes(&averaged.modes);
    println!("\nModes of the full periodic orbit (Floquet):");
    modes(&orbit);
    println!(
        "\nAxes: level frame of the trimmed attitude, forward, right, down, about the mass centre. The air has no\nmemory; times in wingbeats of {:.3} ms.",
        1e3 * trim.beat.period()
    );
    if let Some(path) = &args.write {
        write_new(path, &derivative_case(&case, &trim, &averaged)?)?;
        println!("\nwrote {}", path.display());
    }
    Ok(())
}

/// Floquet's modes of the free wingbeat after a hold.
fn with_wake(args: &StabilityArgs) -> Result<(), Trouble> {
    let (_, trim) = trimmed_with_wake(&args.trimming)?;
    let (memory, held) = match args.wake {
        Wake::Given => (WakeMemory::Given, "the wake of the trimmed flight"),
        Wake::Carried => (WakeMemory::Carried, "the disturbance during the hold"),
    };
    let found = watched("Floquet's modes", || wake_floquet(&trim, memory))?;
    println!("\nModes of the free wingbeat after the hold (Floquet); held fixed: {held}:");
    modes(&found);
    Ok(())
}

/// The modes of a case that is linear already.
fn table(case: &LoadedCase) -> Result<(), Trouble> {
    let model = table_model(&case.setup)?;
    println!("{}: rigid body under its table of derivatives", case.name);
    derivatives(&model);
    println!("\nModes:");
    modes(&model.modes);
    let beat = case.setup.time.period.unwrap_or(1.0);
    println!(
        "\nAxes: those of the table, about the mass centre; times in beats of {:.3} ms.",
        1e3 * beat
    );
    Ok(())
}

fn derivatives(model: &LinearModel) {
    println!("\nDerivatives of the mean loads, SI (N and N m per m/s and rad/s):");
    println!(
        "  {:<4}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}",
        "", "u", "v", "w", "p", "q", "r"
    );
    for (name, row) in LOADS.iter().zip(&model.derivatives) {
        let cells: String = row.iter().map(|x| format!("{x:>12.3e}")).collect();
        println!("  {name:<4}{cells}");
    }
}

/// The modes as a table.
fn modes(set: &ModeSet) {
    println!(
        "  {:<13}{:<22}{:>11}{:>11}{:>11}{:>12}{:>10}{:>22}  moves",
        "plane", "mode", "growth 1/s", "rad/s", "period s", "x2 or /2 s", "beats", "multiplier"
    );
    for m in &set.modes {
        let or_dash = |x: Option<f64>, digits: usize| {
            x.map_or_else(|| "-".to_owned(), |x| format!("{x:.digits$}"))
        };
        let beats = m.doubling().map(|t| t / m.wingbeat);
        let multiplier = format!("{:.5}{:+.5}i", m.multiplier[0], m.multiplier[1]);
        let largest = m.vector.iter().filter(|c| c.1 > 0.3);
        let moves: Vec<String> = largest.map(|c| format!("{} {:.2}", c.0, c.1)).collect();
        println!(
            "  {:<13}{:<22}{:>11.4}{:>11.4}{:>11}{:>12}{:>10}{:>22}  {}",
            format!("{:?}", m.plane).to_lowercase(),
            m.name,
            m.growth,
            m.frequency,
            or_dash(m.period(), 4),
            or_dash(m.doubling(), 4),
            or_dash(beats, 2),
            multiplier,
            moves.join(", ")
        );
    }
}
