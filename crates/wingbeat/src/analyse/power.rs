//! `wingbeat power`.

use std::process::ExitCode;

use clap::Args;
use wingbeat::analysis::power::power;

use super::{Trimming, Trouble, exit, trimmed, watched};

/// What `wingbeat power` is told.
#[derive(Args)]
pub(crate) struct PowerArgs {
    #[command(flatten)]
    trimming: Trimming,
    /// Flight muscle as a part of the body mass.
    #[arg(long, default_value_t = 0.3)]
    muscle: f64,
}

/// The whole command.
pub(crate) fn run(args: &PowerArgs) -> ExitCode {
    exit(find(args))
}

fn find(args: &PowerArgs) -> Result<(), Trouble> {
    let (_, trim) = trimmed(&args.trimming)?;
    let p = watched("power", || power(&trim.tethered()))?;
    println!("\nMean mechanical power over a wingbeat, body tethered in the trimmed attitude:");
    println!(
        "  {:<44}{:>10}{:>12}{:>14}",
        "", "uW", "W/kg body", "W/kg muscle"
    );
    let rows = [
        ("against the air", p.aerodynamic),
        ("inertial, positive part", p.inertial_positive),
        ("muscles, perfect elastic storage", p.perfect_storage),
        ("muscles, no elastic storage", p.no_storage),
        ("peak of all wings", p.peak),
    ];
    for (name, x) in rows {
        println!(
            "  {name:<44}{:>10.3}{:>12.2}{:>14.2}",
            1e6 * x,
            p.body_specific(x),
            p.muscle_specific(x, args.muscle)
        );
    }
    println!("  muscle counted as {} of the body mass", args.muscle);
    Ok(())
}
