//! `wingbeat trim`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use wingbeat::analysis::{TrimProblem, Unknown};
use wingbeat::case::{LoadedCase, trimmed_case, wake_trimmed_case, write_new};

use super::{Found, Trimming, Trouble, exit, trimmed, trimmed_with_wake};

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
    let with_memory = args.trimming.load()?.setup.air.has_memory();
    let text = if with_memory {
        let (case, trim) = trimmed_with_wake(&args.trimming)?;
        wake_trimmed_case(&case, &trim)
    } else {
        let (case, trim) = trimmed(&args.trimming)?;
        trimmed_case(&case, &trim)
    };
    if let Some(path) = &args.write {
        write_new(path, &text)?;
        println!(
            "\nwrote {0}; fly it with `wingbeat run {0}`",
            path.display()
        );
    }
    Ok(())
}

/// The trim on the terminal.
pub(crate) fn report(case: &LoadedCase, problem: &TrimProblem, t: &Found) {
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
        t.residual.iter().fold(0.0_f64, |m, r| m.max(r.abs()))
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
    for (name, r) in names.iter().zip(&t.residual) {
        println!("  residual of {name:<28}{r:>10.1e}");
    }
    if let Some(joints) = t.residual.get(names.len()..).filter(|j| !j.is_empty()) {
        let largest = joints.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
        println!(
            "  residual of {:<28}{largest:>10.1e}",
            "free joints, largest"
        );
    }
}

fn value(u: Unknown, t: &Found) -> String {
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
