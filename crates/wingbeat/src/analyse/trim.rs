//! `wingbeat trim`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use wingbeat::analysis::{Trim, TrimProblem, Unknown};
use wingbeat::io::LoadedCase;
use wingbeat::io::case::{trimmed_case, write_new};

use super::{Trimming, Trouble, exit, trimmed};

/// What `wingbeat trim` is told.
#[derive(Args)]
pub(crate) struct TrimArgs {
    #[command(flatten)]
    trimming: Trimming,
    /// Write the trimmed flight as a case file; never over an existing file.
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
}

/// The whole command.
pub(crate) fn run(args: &TrimArgs) -> ExitCode {
    exit(find(args))
}

fn find(args: &TrimArgs) -> Result<(), Trouble> {
    let (case, trim) = trimmed(&args.trimming)?;
    if let Some(path) = &args.write {
        write_new(path, &trimmed_case(&case, &trim))?;
        println!(
            "\nwrote {0}; fly it with `wingbeat run {0}`",
            path.display()
        );
    }
    Ok(())
}

/// The trim on the terminal.
pub(crate) fn report(case: &LoadedCase, problem: &TrimProblem, t: &Trim) {
    let v = problem.velocity;
    println!(
        "{}: trim to {:.3} m/s forward, {:.3} m/s up",
        case.name, v.x, -v.z
    );
    let verdict = if t.converged {
        "trimmed"
    } else {
        "NOT trimmed; the best point found"
    };
    println!(
        "{verdict} after {} Newton steps, largest residual {:.1e}",
        t.iterations,
        t.error()
    );
    for u in problem.unknowns {
        println!("  {:<18}{}", u.name(), value(u, t));
    }
    let names = [
        "force forward / weight",
        "force down / weight",
        "pitch moment / (weight R)",
        "pitch per beat [rad]",
        "drift forward / R per beat",
        "drift down / R per beat",
    ];
    for (name, r) in names.iter().zip(t.residual) {
        println!("  residual of {name:<28}{r:>10.1e}");
    }
}

fn value(u: Unknown, t: &Trim) -> String {
    let a = &t.adjustment;
    let degrees = |x: f64| format!("{:+.4} deg", x.to_degrees());
    let percent = |x: f64| format!("{:+.3} %", 100.0 * x);
    match u {
        Unknown::StrokeAmplitude => percent(a.stroke_amplitude),
        Unknown::StrokeOffset => degrees(a.stroke_offset),
        Unknown::Frequency => percent(a.frequency),
        Unknown::StrokePlane => degrees(a.stroke_plane),
        Unknown::FeatheringOffset => degrees(a.feathering_offset),
        Unknown::FeatheringLead => format!("{:+.5} wingbeats", a.feathering_lead),
        Unknown::DeviationOffset => degrees(a.deviation_offset),
        Unknown::BodyPitch => degrees(t.body_pitch),
        Unknown::MassCentre => format!("{:+.4} mm forward", 1e3 * t.mass_centre),
    }
}
