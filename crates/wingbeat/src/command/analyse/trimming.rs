//! What is trimmed and how, for all analysing commands.

use clap::Args;
use wingbeat::analysis::wake::{WakeSettings, WakeTrim, check_trim_with_wake, trim_with_wake};
use wingbeat::analysis::{
    Beat, Bound, TRIM_STEPS, Trim, TrimProblem, TrimRequest, TrimSettings, TrimSolution, UNKNOWNS,
    Unknown, glides, period_of_glide, trim_within, turned_over, turned_over_with_wake,
};
use wingbeat::case::{IoError, LoadedCase};
use wingbeat::flight::FlightSetup;
use wingbeat::math::DVec3;

use super::found;
use crate::command::case::programs::name_program;
use crate::command::options::{self, CaseArgs};
use crate::command::output::failure::{FAILED, Failure};
use crate::command::output::report::{Report, ReportArgs};
use crate::command::output::terminal::tell;
use crate::command::progress::watch::watched;

/// Wingbeats of the hold at most.
const MAX_HELD: usize = 100;

/// What feedback on averaged models takes.
pub(crate) const BLADE_CASE: &str =
    "Case file or preset in blade elements; - is the standard input";

/// What control derivatives take.
pub(crate) const BLADE_OR_TOWED_CASE: &str = "Case file or preset in blade elements, gliders in the vortex lattice too; - is the standard input";

/// What the analyses of any model take.
const ANY_CASE: &str =
    "Case file or preset, in blade elements or in the vortex lattice; - is the standard input";

/// Heading of these options in the help.
const HEADING: &str = "Trim";

/// What is trimmed and how.
#[derive(Args)]
#[command(mut_arg("case", |a| a.required(false).default_value("fruit-fly-blade").help(ANY_CASE)))]
pub(crate) struct Trimming {
    #[command(flatten)]
    case: CaseArgs,
    /// What trim may choose.
    #[arg(long, num_args = 3..=UNKNOWNS.len(), value_name = "NAME", value_parser = unknown, help_heading = HEADING,
          help = help_of_unknowns())]
    unknowns: Option<Vec<Unknown>>,
    /// Between what an unknown must lie, e.g. stroke_amplitude=-0.2..0.2 or body_pitch=20..60 (may be repeated):
    /// angles in degrees, relative changes as parts of 1, feathering_lead in wingbeats, mass_centre in wing lengths
    /// forward, speeds in m/s.
    #[arg(long, value_name = "NAME=FROM..TO", value_parser = found::bound, help_heading = HEADING)]
    bound: Vec<Bound>,
    /// Mean velocity forward (n1), m/s [default: 0].
    #[arg(long, value_name = "SPEED", allow_negative_numbers = true,
          value_parser = options::speed, help_heading = HEADING)]
    pub(super) forward: Option<f64>,
    /// Mean velocity upward (-n3), m/s [default: 0].
    #[arg(long, value_name = "SPEED", allow_negative_numbers = true,
          value_parser = options::speed, help_heading = HEADING)]
    pub(super) climb: Option<f64>,
    /// Mean velocity to the right of the heading, m/s [default: 0].
    #[arg(long, value_name = "SPEED", allow_negative_numbers = true,
          value_parser = options::speed, help_heading = HEADING)]
    pub(super) sideslip: Option<f64>,
    /// Steady turn to the right, degrees a second [default: 0].
    #[arg(long, value_name = "DEG_S", allow_negative_numbers = true,
          value_parser = options::finite, help_heading = HEADING)]
    pub(super) turn_rate: Option<f64>,
    /// Steps per wingbeat; default 100, in a vortex lattice, with elastic wings and where strips leave wakes those of the case.
    #[arg(long, value_name = "N", help_heading = HEADING,
          value_parser = options::count::<{ TRIM_STEPS[0] }, { TRIM_STEPS[1] }>)]
    steps: Option<usize>,
    /// In a vortex lattice: wingbeats during which the body is held while its wake grows; of a glider the first tow, in
    /// times of sqrt(R / g) / 4, R the wing length, which is doubled until the start of the wake is hardly felt
    /// [default: 2].
    #[arg(long, value_name = "BEATS", help_heading = HEADING,
          value_parser = options::count::<1, MAX_HELD>)]
    hold: Option<usize>,
    /// In a vortex lattice or with elastic wings: largest residual (forces over weight) that counts as trimmed
    /// [default: 2e-3; of gliders in the lattice 1e-5; of elastic wings in blade elements 1e-6].
    #[arg(long, value_name = "RESIDUAL", help_heading = HEADING, value_parser = options::tolerance)]
    tolerance: Option<f64>,
    #[command(flatten)]
    pub(super) report: ReportArgs,
}

/// What to try where the incidences of a glider have no glide that is found.
const GLIDE_BY_SPEED: &str = "where these incidences have no glide, or none near the speed and pitch of the case, a speed that is given has one more often (--forward): tail_incidence or mass_centre then follow from it";

/// The names of all unknowns and the usual choices.
fn help_of_unknowns() -> String {
    let names = UNKNOWNS.map(|(_, name)| name).join(", ");
    format!(
        "What trim may choose, three of {names} [default: body_pitch stroke_amplitude stroke_offset; where joints drive all wings body_pitch drive_amplitude mass_centre; where nothing beats body_pitch forward climb]. Turns, sideslip and animals that differ right and left need six, three of them lateral [default: those, body_roll, stroke_amplitude_difference, stroke_plane_difference]; more are for least power"
    )
}

/// Trimming failed; the best point found was reported.
fn not_trimmed() -> Failure {
    Failure::Told(FAILED)
}

/// An option that does nothing here.
pub(super) fn unused(option: &str, why: &str) -> Failure {
    Failure::Option(format!(
        "--{option} has no effect here: {why}; leave it out"
    ))
}

/// Whether the flyer is a glider of rigid wings in air that keeps wakes, whose steady flight is found by tows.
pub(super) fn is_towed(setup: &FlightSetup) -> bool {
    glides(setup) && setup.air.keeps_wake() && !setup.animal.is_elastic()
}

impl Trimming {
    /// The case, its feedback left out: the open loop is analysed.
    pub(crate) fn load(&self) -> Result<LoadedCase, IoError> {
        let mut case = self.case.load()?;
        case.setup.feedback = None;
        Ok(case)
    }

    /// Refuses the options that only a trim has.
    pub(super) fn without_trim(&self) -> Result<(), Failure> {
        let given = [
            ("unknowns", self.unknowns.is_some()),
            ("forward", self.forward.is_some()),
            ("bound", !self.bound.is_empty()),
            ("climb", self.climb.is_some()),
            ("sideslip", self.sideslip.is_some()),
            ("turn-rate", self.turn_rate.is_some()),
            ("steps", self.steps.is_some()),
            ("hold", self.hold.is_some()),
            ("tolerance", self.tolerance.is_some()),
        ];
        match given.iter().find(|g| g.1) {
            Some((option, _)) => Err(unused(
                option,
                "a table of derivatives is linear about its own reference flight, nothing is trimmed",
            )),
            None => Ok(()),
        }
    }

    /// Refuses a case whose loads cannot be averaged over a wingbeat.
    pub(super) fn check_averaged(&self) -> Result<(), Failure> {
        let steps = self.steps.unwrap_or(TrimSettings::default().steps);
        Ok(Beat::new(&self.load()?.setup, steps)?.check_averaged()?)
    }

    /// Refuses air with a memory where a case is trimmed many times over.
    pub(super) fn without_memory(&self, case: &LoadedCase) -> Result<(), Failure> {
        match case.setup.has_memory() {
            true => Err(unused(
                "sweep",
                "in air with memory (wakes of the lattice or of strips) or with elastic wings a trim seeks a periodic orbit and is not swept; sweep rigid wings in blade elements without air.blade.unsteady (--set air.model=blade_element), or trim speed by speed with --forward",
            )),
            false => self.without_hold(),
        }
    }

    /// Refuses what a trim in air with memory has alone.
    fn without_hold(&self) -> Result<(), Failure> {
        match (self.hold, self.tolerance) {
            (Some(_), _) => Err(unused(
                "hold",
                "this air has no memory, so no wake has to grow",
            )),
            (_, Some(_)) => Err(unused(
                "tolerance",
                "this air has no memory, and trims close to 1e-9 in it",
            )),
            _ => Ok(()),
        }
    }

    /// What is asked of the trim.
    pub(super) fn problem(&self, case: &LoadedCase) -> Result<TrimProblem, Failure> {
        self.problem_at(case, self.forward.unwrap_or(0.0))
    }

    /// The same at a mean velocity forward [m/s].
    pub(super) fn problem_at(
        &self,
        case: &LoadedCase,
        forward: f64,
    ) -> Result<TrimProblem, Failure> {
        let request = TrimRequest {
            velocity: DVec3::new(
                forward,
                self.sideslip.unwrap_or(0.0),
                -self.climb.unwrap_or(0.0),
            ),
            turn_rate: self.turn_rate.unwrap_or(0.0).to_radians(),
            unknowns: self.unknowns.clone(),
            bounds: self.bound.clone(),
            steps: self.steps,
        };
        let problem = request.problem(&case.setup)?;
        self.check_bounds(&problem)?;
        Ok(problem)
    }

    /// Refuses bounds of what is not chosen, and two of one.
    fn check_bounds(&self, problem: &TrimProblem) -> Result<(), Failure> {
        for (k, bound) in self.bound.iter().enumerate() {
            let name = bound.unknown.name();
            if !problem.unknowns.contains(&bound.unknown) {
                let problem =
                    format!("--bound: {name} is not among the unknowns; name it in --unknowns too");
                return Err(Failure::Option(problem));
            }
            if self.bound[..k].iter().any(|b| b.unknown == bound.unknown) {
                return Err(Failure::Option(format!(
                    "--bound: {name} has two; give one"
                )));
            }
        }
        Ok(())
    }

    /// Refuses a turn and spare unknowns, which `what` does not have.
    pub(super) fn without_turn(&self, what: &str) -> Result<(), Failure> {
        match self.turn_rate {
            Some(rate) if rate != 0.0 => Err(unused(
                "turn-rate",
                &format!("{what} needs a flight that is straight in the mean"),
            )),
            _ => Ok(()),
        }
    }
}

/// Loads the case and trims it; reports the trim.
pub(crate) fn trimmed(args: &Trimming, report: &mut Report) -> Result<(LoadedCase, Trim), Failure> {
    let case = args.load()?;
    args.without_hold()?;
    let problem = args.problem(&case)?;
    let found = watched("trimming", || trim_within(&case.setup, &problem))?;
    let flown = TrimProblem {
        velocity: found.velocity,
        ..problem
    };
    found::tell(report, &case, &flown, (&found.solution, &found.setup));
    match found.solution.is_as_asked() {
        true => {
            if let Some(glide) = found.glide()? {
                found::tell_glide(report, &glide);
            }
            found::warn_of_turned(report, turned_over(&found)?);
            Ok((case, found))
        }
        false => {
            if glides(&case.setup) {
                advise_speed(&found.solution);
            }
            Err(not_trimmed())
        }
    }
}

/// What to try where a glide is not found whose speed was unknown.
fn advise_speed(solution: &TrimSolution) {
    if solution.unknowns.contains(&Unknown::Forward) {
        tell!("{GLIDE_BY_SPEED}");
    }
}

/// The same in air with memory.
pub(crate) fn trimmed_with_wake(
    args: &Trimming,
    report: &mut Report,
) -> Result<(LoadedCase, WakeTrim), Failure> {
    let mut case = args.load()?;
    match (args.steps, case.setup.time.period) {
        (Some(steps), Some(period)) => {
            case.setup.time.step = period / steps as f64;
            case.raw.time.steps_per_beat = Some(steps);
        }
        (Some(steps), None) => {
            if let Some(period) = period_of_glide(&case.setup) {
                let time = &mut case.setup.time;
                let flown = time.steps as f64 * time.step;
                time.step = period / steps as f64;
                time.steps = (flown / time.step).round() as usize;
            }
        }
        (None, _) => {}
    }
    let problem = args.problem(&case)?;
    let is_orbit = !case.setup.air.keeps_wake();
    if is_orbit && args.hold.is_some() {
        return Err(unused(
            "hold",
            "nothing is held: body, wings and wakes of strips fly their periodic beat",
        ));
    }
    let default = WakeSettings::of(&case.setup);
    let settings = WakeSettings {
        held_beats: args.hold.unwrap_or(default.held_beats),
        tolerance: args.tolerance.unwrap_or(default.tolerance),
        ..default
    };
    let what = match is_orbit {
        false if glides(&case.setup) => "by tows, until their wakes are long".to_owned(),
        true if case.setup.air.has_strip_wakes() => "body, wings and wakes of strips".to_owned(),
        true => "body and elastic wings".to_owned(),
        false => format!(
            "in air with memory, some 10 to 30 flights of {} wingbeats",
            settings.held_beats + 1
        ),
    };
    check_trim_with_wake(&case.setup, &problem)?;
    name_program(&case);
    let pace = match case.setup.air.keeps_wake() || case.setup.animal.is_elastic() {
        true => "; this takes minutes",
        false => "",
    };
    tell!("{}: trimming {what}{pace}", case.name);
    let found = watched("trimming", || {
        trim_with_wake(&case.setup, &problem, &settings)
    })?;
    let flown = TrimProblem {
        velocity: found.velocity,
        ..problem
    };
    found::tell(report, &case, &flown, (&found.solution, &found.setup));
    found::tell_flown(report, &found);
    match found.solution.is_as_asked() {
        true => {
            if let Some(glide) = found.glide() {
                found::tell_glide(report, &glide);
            }
            found::warn_of_turned(report, turned_over_with_wake(&found)?);
            Ok((case, found))
        }
        false => {
            found::tell_rough(report, &found);
            match glides(&case.setup) {
                true => advise_speed(&found.solution),
                false => found::advise_slower(&flown),
            }
            Err(not_trimmed())
        }
    }
}

fn unknown(name: &str) -> Result<Unknown, String> {
    options::choose(name, &UNKNOWNS.map(|(unknown, name)| (name, unknown)))
}
