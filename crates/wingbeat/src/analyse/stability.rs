//! `wingbeat stability`.

use std::process::ExitCode;

use wingbeat::analysis::stability::{LOADS, LinearModel};
use wingbeat::analysis::{ModeSet, floquet, linear_model};

use super::{Trimming, Trouble, exit, trimmed};

/// The whole command.
pub(crate) fn run(args: &Trimming) -> ExitCode {
    exit(find(args))
}

fn find(args: &Trimming) -> Result<(), Trouble> {
    let (_, trim) = trimmed(args)?;
    let averaged = linear_model(&trim.beat, &trim.state)?;
    derivatives(&averaged);
    println!("\nModes of the rigid body under mean loads (averaged over the beat):");
    modes(&averaged.modes);
    println!("\nModes of the full periodic orbit (Floquet):");
    modes(&floquet(&trim.beat, &trim.state)?);
    println!(
        "\nAxes: level frame of the trimmed attitude, forward, right, down, about the mass centre. The air has no\nmemory; times in wingbeats of {:.3} ms.",
        1e3 * trim.beat.period()
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
