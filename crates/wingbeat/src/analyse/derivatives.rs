//! `wingbeat derivatives`.

use std::process::ExitCode;

use wingbeat::analysis::derivatives::control_derivatives;
use wingbeat::analysis::{AnalysisError, Level};
use wingbeat::math::DVec3;

use super::{Trimming, Trouble, exit, trimmed, watched};

/// The whole command.
pub(crate) fn run(args: &Trimming) -> ExitCode {
    exit(find(args))
}

fn find(args: &Trimming) -> Result<(), Trouble> {
    let (_, trim) = trimmed(args)?;
    let r = trim.beat.root(&trim.state).r;
    let level = Level::new(r, trim.setup.gravity);
    let velocity = level.to_n.transpose() * DVec3::new(args.forward, 0.0, -args.climb);
    let list: Result<_, AnalysisError> = watched("derivatives", || {
        control_derivatives(&trim.setup, r, velocity, trim.beat.steps())
    });
    println!("\nControl derivatives of the mean loads, N and N m per unit (1, rad, wingbeat):");
    println!(
        "  {:<20}{:<8}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}",
        "control", "wing", "X", "Y", "Z", "L", "M", "N"
    );
    for d in list? {
        let (f, m) = (d.derivative.force, d.derivative.moment);
        let cells: String = [f.x, f.y, f.z, m.x, m.y, m.z]
            .iter()
            .map(|x| format!("{x:>12.3e}"))
            .collect();
        println!("  {:<20}{:<8}{cells}", d.control, d.wing);
    }
    println!("\nAxes: level frame, forward, right, down; moments about the mean mass centre.");
    Ok(())
}
