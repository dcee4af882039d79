//! The analysing commands: each trims first, for there is no stability of no steady flight.

pub(crate) mod derivatives;
pub(crate) mod power;
pub(crate) mod stabilise;
pub(crate) mod stability;
pub(crate) mod trim;

use std::process::ExitCode;

use clap::Args;
use wingbeat::analysis::trim::{UNKNOWNS, trim as find_trim};
use wingbeat::analysis::{AnalysisError, Trim, TrimProblem, TrimSettings, Unknown};
use wingbeat::flight::MotionMode;
use wingbeat::io::{IoError, LoadedCase};
use wingbeat::math::DVec3;

/// What is trimmed and how.
#[derive(Args)]
pub(crate) struct Trimming {
    /// Case file or preset with blade-element air.
    #[arg(default_value = "fruit-fly-blade")]
    case: String,
    /// Set a key of the case, e.g. time.beats=3 (may be repeated).
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// The three things trim may choose.
    #[arg(long, num_args = 3, value_names = ["A", "B", "C"], value_parser = unknown,
          default_values = ["body_pitch", "stroke_amplitude", "stroke_offset"])]
    unknowns: Vec<Unknown>,
    /// Mean velocity forward (n1), m/s.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    forward: f64,
    /// Mean velocity upward (-n3), m/s.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    climb: f64,
    /// Steps per wingbeat.
    #[arg(long, default_value_t = 100)]
    steps: usize,
}

/// What kept an analysis from being made.
pub(crate) enum Trouble {
    /// The case.
    Case(IoError),
    /// The analysis.
    Analysis(AnalysisError),
    /// No trim: the best point found was reported.
    NotTrimmed,
}

impl From<IoError> for Trouble {
    fn from(e: IoError) -> Self {
        Self::Case(e)
    }
}

impl From<AnalysisError> for Trouble {
    fn from(e: AnalysisError) -> Self {
        Self::Analysis(e)
    }
}

/// Says what happened and turns it into the exit code.
pub(crate) fn exit(outcome: Result<(), Trouble>) -> ExitCode {
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(Trouble::Case(e)) => crate::refuse(&e),
        Err(Trouble::Analysis(e)) => {
            eprintln!("error: {e}");
            ExitCode::from(2)
        }
        Err(Trouble::NotTrimmed) => ExitCode::from(1),
    }
}

/// Loads the case and trims it; reports the trim.
pub(crate) fn trimmed(args: &Trimming) -> Result<(LoadedCase, Trim), Trouble> {
    let case = LoadedCase::find(&args.case, &args.set)?;
    let body_pitch = match &case.setup.mode {
        MotionMode::Free(start) => start.angles.x,
        MotionMode::Tethered(motion) => motion.angles[0].constant,
    };
    let problem = TrimProblem {
        unknowns: [args.unknowns[0], args.unknowns[1], args.unknowns[2]],
        velocity: DVec3::new(args.forward, 0.0, -args.climb),
        body_pitch,
        settings: TrimSettings {
            steps: args.steps.max(1),
            ..TrimSettings::default()
        },
    };
    let found = find_trim(&case.setup, &problem)?;
    trim::report(&case, &problem, &found);
    if found.converged {
        Ok((case, found))
    } else {
        Err(Trouble::NotTrimmed)
    }
}

fn unknown(name: &str) -> Result<Unknown, String> {
    let found = UNKNOWNS.iter().find(|u| u.1 == name);
    found.map(|u| u.0).ok_or_else(|| {
        let names: Vec<_> = UNKNOWNS.iter().map(|u| u.1).collect();
        format!("choose from {}", names.join(", "))
    })
}
