//! The analysing commands: each trims first, for there is no stability of no steady flight.

pub(crate) mod derivatives;
pub(crate) mod power;
pub(crate) mod stabilise;
pub(crate) mod stability;
pub(crate) mod trim;

use std::process::ExitCode;

use clap::Args;
use wingbeat::analysis::trim::{UNKNOWNS, trim as find_trim};
use wingbeat::analysis::wake::{WakeSettings, WakeTrim, trim_with_wake};
use wingbeat::analysis::{AnalysisError, Trim, TrimProblem, TrimSettings, Unknown};
use wingbeat::case::{IoError, LoadedCase};
use wingbeat::flight::MotionMode;
use wingbeat::math::DVec3;
use wingbeat::model::motion::Adjustment;

use crate::watch::Watch;

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
    /// Steps per wingbeat; default 100, in a vortex lattice those of the case.
    #[arg(long)]
    steps: Option<usize>,
    /// In a vortex lattice: wingbeats during which the body is held while its wake grows.
    #[arg(long, default_value_t = 2)]
    hold: usize,
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

impl Trimming {
    /// The case.
    pub(crate) fn load(&self) -> Result<LoadedCase, IoError> {
        LoadedCase::find(&self.case, &self.set)
    }
}

/// Does something while its progress is shown.
pub(crate) fn watched<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let _watch = Watch::new(what);
    work()
}

/// Loads the case and trims it; reports the trim.
pub(crate) fn trimmed(args: &Trimming) -> Result<(LoadedCase, Trim), Trouble> {
    let case = args.load()?;
    let problem = args.problem(&case);
    let found = watched("trimming", || find_trim(&case.setup, &problem))?;
    trim::report(&case, &problem, &Found::from(&found));
    if found.converged {
        Ok((case, found))
    } else {
        Err(Trouble::NotTrimmed)
    }
}

/// The same in air with memory.
pub(crate) fn trimmed_with_wake(args: &Trimming) -> Result<(LoadedCase, WakeTrim), Trouble> {
    let mut case = args.load()?;
    if let (Some(steps), Some(period)) = (args.steps, case.setup.time.period) {
        case.setup.time.step = period / steps.max(4) as f64;
        case.raw.time.steps_per_beat = Some(steps.max(4));
    }
    let problem = args.problem(&case);
    let settings = WakeSettings {
        held_beats: args.hold.max(1),
        ..WakeSettings::default()
    };
    eprintln!(
        "{}: trimming in air with memory, some 20 to 60 flights of {} wingbeats; this takes minutes",
        case.name,
        settings.held_beats + 1
    );
    let found = watched("trimming", || {
        trim_with_wake(&case.setup, &problem, &settings)
    })?;
    trim::report(&case, &problem, &Found::from(&found));
    println!(
        "  {} flights of {} wingbeats",
        found.flights,
        settings.held_beats + 1
    );
    if found.converged {
        Ok((case, found))
    } else {
        Err(Trouble::NotTrimmed)
    }
}

/// What is reported of a trim of either kind.
pub(crate) struct Found {
    pub(crate) converged: bool,
    pub(crate) residual: Vec<f64>,
    pub(crate) iterations: usize,
    pub(crate) adjustment: Adjustment,
    pub(crate) mass_centre: f64,
    pub(crate) body_pitch: f64,
}

impl From<&Trim> for Found {
    fn from(t: &Trim) -> Self {
        Self {
            converged: t.converged,
            residual: t.residual.clone(),
            iterations: t.iterations,
            adjustment: t.adjustment,
            mass_centre: t.mass_centre,
            body_pitch: t.body_pitch,
        }
    }
}

impl From<&WakeTrim> for Found {
    fn from(t: &WakeTrim) -> Self {
        Self {
            converged: t.converged,
            residual: t.residual.to_vec(),
            iterations: t.iterations,
            adjustment: t.adjustment,
            mass_centre: t.mass_centre,
            body_pitch: t.body_pitch,
        }
    }
}

impl Trimming {
    /// What is asked of the trim.
    fn problem(&self, case: &LoadedCase) -> TrimProblem {
        let args = self;
        let body_pitch = match &case.setup.mode {
            MotionMode::Free(start) => start.angles.x,
            MotionMode::Tethered(motion) => motion.angles[0].constant,
        };
        TrimProblem {
            unknowns: [args.unknowns[0], args.unknowns[1], args.unknowns[2]],
            velocity: DVec3::new(args.forward, 0.0, -args.climb),
            body_pitch,
            settings: TrimSettings {
                steps: args.steps.unwrap_or(100).max(1),
                ..TrimSettings::default()
            },
        }
    }
}

fn unknown(name: &str) -> Result<Unknown, String> {
    let found = UNKNOWNS.iter().find(|u| u.1 == name);
    found.map(|u| u.0).ok_or_else(|| {
        let names: Vec<_> = UNKNOWNS.iter().map(|u| u.1).collect();
        format!("choose from {}", names.join(", "))
    })
}
