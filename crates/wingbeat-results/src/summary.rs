//! What happened, in words and numbers, and how far it can be trusted.

mod alternation;
pub mod beats;
mod bent;
mod comparison;
mod driven;
mod each_step;
mod ensemble;
mod estimate;
mod extent;
mod held;
mod impulse;
mod in_play;
mod last_part;
mod listed;
mod means;
mod momentum_balance;
mod numbers;
mod per_beat;
mod statistics;
mod still_air;
mod trust;
mod verdict;
mod words;

use std::path::Path;

use wingbeat_flight::{AirModel, FlightSetup, Record};
use wingbeat_math::{larger, smaller};

use crate::Outcome;
pub use beats::{BeatMeans, Beats, down, over_weight};
pub use bent::BentWing;
pub use comparison::MeanDifference;
pub(crate) use each_step::EachStep;
pub use ensemble::{Ensemble, EnsembleBeat, Members};
pub use estimate::Estimate;
pub use held::{Departure, Departures};
pub use impulse::ImpulseBudget;
pub use last_part::LastPart;
pub use means::{ManyBeats, left_out, starting_beats, what_starts};
use momentum_balance::ratio;
pub use numbers::Summary;
pub use per_beat::{PerBeat, SummaryQuantity};
use statistics::Statistics;
pub use verdict::Verdict;
use verdict::Warnings;
use wingbeat_case::IoError;
use wingbeat_case::LoadedCase;
pub use words::{broken, prefix};

impl Summary {
    /// From the history of a run, read row by row. A thinned history does not hold every step: there it is the
    /// summary beside it, if one of these steps was written, or it says that its verdict goes no farther than
    /// the rows.
    ///
    /// # Errors
    /// A history that cannot be read.
    pub fn read(case: &LoadedCase, history: &Path, outcome: &Outcome) -> Result<Self, IoError> {
        let found = Self::of_run(case, history, outcome, None)?;
        if case.output.history_every == 1 {
            return Ok(found);
        }
        let text = std::fs::read_to_string(history.with_file_name("summary.json"));
        let written = text
            .ok()
            .and_then(|t| serde_json::from_str::<Self>(&t).ok());
        let fits = |s: &Self| s.steps == found.steps && s.outcome == found.outcome;
        Ok(written.filter(fits).unwrap_or(found))
    }

    /// The same, with what was gathered of each step as it was flown.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub(crate) fn of_run(
        case: &LoadedCase,
        history: &Path,
        outcome: &Outcome,
        each: Option<EachStep>,
    ) -> Result<Self, IoError> {
        let knows_all = each.is_some();
        let statistics = Statistics::read(history, &case.setup, each)?;
        let more = |list: &mut Warnings| thinning(case, knows_all, list);
        Ok(Self::from_statistics(
            &case.setup,
            statistics,
            outcome,
            more,
        ))
    }

    /// From the records of a flight in memory, one per step, the start first.
    pub fn of(setup: &FlightSetup, records: &[Record], outcome: &Outcome) -> Self {
        Self::from_statistics(setup, Statistics::of(records, setup), outcome, |_| {})
    }

    fn from_statistics(
        setup: &FlightSetup,
        s: Statistics,
        outcome: &Outcome,
        say_more: impl FnOnce(&mut Warnings),
    ) -> Self {
        let each = &s.each;
        let is_lattice = matches!(setup.air, AirModel::VortexLattice(_));
        let momentum = [
            each.momentum.held_residual(setup),
            each.momentum.free_residual(setup),
        ];
        let mut summary = Self {
            case: setup.name.clone(),
            outcome: outcome.clone(),
            verdict: Verdict::default(),
            verdict_reason: String::new(),
            steps: s.last.step,
            time_s: s.last.time,
            mass_kg: setup.animal.mass(),
            gravity_direction: down(setup).to_array(),
            final_lift_newton: s.last.lift(down(setup)),
            final_thrust_newton: s.last.air_force().x,
            displacement_m: [0, 1, 2].map(|k| s.change(k)),
            turn_deg: [3, 4, 5].map(|k| s.change(k).to_degrees()),
            energy_residual_relative: each.in_play.energy_residual(setup),
            joint_residual_relative: joint_residual(each),
            momentum_residual_relative: larger(momentum[0], momentum[1]),
            violation_position_m: each.violation_position.most,
            violation_orientation: each.violation_orientation.most,
            euler_regularity: smaller(each.euler_regularity.least, 1.0),
            corrector_passes_most: each.corrector_passes.most as usize,
            corrector_passes_mean: each.passes_sum as f64 / each.steps.max(1) as f64,
            regularised: s.regularised,
            limited: s.limited,
            limited_part: s.limited_part(setup),
            leading_rings: is_lattice.then_some(s.leading_rings),
            alternating_steps: each.alternation.longest,
            wake_rings: s.last.wake_rings,
            wake_particles: s.last.wake_particles,
            net_flux_residual_m_s: each.net_flux_residual.most,
            impulse_budget: ImpulseBudget::between(setup, [&s.first, &s.last], &each.parting),
            elastic_wings: bent::wings(setup, &each.bent),
            departures: each.departures.clone(),
            warnings: vec![],
            means: ManyBeats::of(&s.beats, left_out(setup)),
            last_part: each.bounds.ended_by(&s.last, setup),
            beats: s.beats,
        };
        let doubts = trust::doubts_of(setup, each.gaps.as_ref());
        let mut warnings = trust::warnings(setup, &doubts, &summary, momentum);
        bent::warnings(setup, &s.each.bent, &mut warnings);
        turned_over(setup, &s.each, &mut warnings);
        stops(&s.each, &mut warnings);
        trust::starting_steps(setup, s.corrector_residual, &mut warnings);
        still_air::warn(setup, [&s.first, &s.last], &mut warnings);
        trust::flown_crossings(
            setup,
            &s.each.crossings.map_or(vec![], |c| c.found()),
            &mut warnings,
        );
        say_more(&mut warnings);
        (summary.verdict, summary.verdict_reason) = warnings.verdict(outcome);
        summary.warnings = warnings.into_texts();
        summary
    }
}

/// What the motion along free joints loses or gains beside what acts on it; 0 where there are none.
fn joint_residual(s: &EachStep) -> f64 {
    match s.has_free_joints {
        true => ratio(s.driven.most, s.in_play.energy_scale()),
        false => 0.0,
    }
}

/// Wings that turned over on passive hinges.
fn turned_over(setup: &FlightSetup, each: &EachStep, list: &mut Warnings) {
    for said in each.turned.found(setup) {
        list.limit(format!("Wings that turn over: {said}."));
    }
}

/// Stops of joints that were reached.
fn stops(each: &EachStep, list: &mut Warnings) {
    for said in each.stops.found() {
        list.note(format!("Stops: {said}."));
    }
}

/// What a thinned history leaves out: nothing of what the summary says, where every step was seen as it was flown.
fn thinning(case: &LoadedCase, knows_all: bool, list: &mut Warnings) {
    let every = case.output.history_every;
    if every <= 1 {
        return;
    }
    let holds = format!(
        "the history holds every {} step and the ends of wingbeats",
        ordinal(every)
    );
    match knows_all {
        true => list.note(format!("What is said here is of all steps; {holds}: its means of wingbeats, sums and extremes are those of all steps, its residuals of balances those of its rows.")),
        false => list.limit(format!("The verdict goes as far as a thinned history shows. All steps were not seen as they were flown, and {holds}: residuals of balances, passes of the corrector, forces that turn back from step to step and wings that pass through each other are those of its rows.")),
    }
}

/// A number as one counts: 1st, 2nd, 11th.
pub fn ordinal(number: usize) -> String {
    let ending = match (number % 10, number % 100) {
        (_, 11..=13) => "th",
        (1, _) => "st",
        (2, _) => "nd",
        (3, _) => "rd",
        _ => "th",
    };
    format!("{number}{ending}")
}

/// Total air force along a direction, row by row \[N\].
pub fn air_force(history: &crate::History, direction: wingbeat_math::DVec3) -> Vec<f64> {
    let mut total = vec![0.0; history.rows()];
    for k in 0..3 {
        let suffix = format!("_force_n{}_newton", k + 1);
        let part = history.sum(|n| n.starts_with("air_") && n.ends_with(&suffix));
        for (t, x) in total.iter_mut().zip(part) {
            *t += direction[k] * x;
        }
    }
    total
}

/// Column of the power of springs, dampers and stops.
const PASSIVE_POWER: &str = "passive_power_watt";

/// Total power of the actuators of all joints and of prescribed deformation, row by row \[W\].
pub fn driving_power(history: &crate::History) -> Vec<f64> {
    let mut power = history.sum(gives_power);
    let passive = history.sum(|n| n == PASSIVE_POWER);
    (power.iter_mut().zip(passive)).for_each(|(all, passive)| *all -= passive);
    power
}

/// Whether a column is the power at a joint or of prescribed deformation.
fn gives_power(name: &str) -> bool {
    let gives = ["hinge_", "loop_", "deformation_"];
    gives.iter().any(|s| name.starts_with(s)) && name.ends_with("_power_watt")
}

/// What [`driving_power`] is the power of, in words; none where nothing is driven.
pub fn driving_power_name(setup: &FlightSetup, history: &crate::History) -> Option<&'static str> {
    let names = || history.names().iter().filter(|n| gives_power(n));
    // Joined roots have columns of their deformation even where nothing moves them.
    let is_driven = setup.feedback.is_some() || !setup.joints.is_empty();
    let moves = is_driven || setup.animal.wings.iter().any(|w| !w.is_still());
    let deforms = moves && names().any(|n| n.starts_with("deformation_"));
    let has_springs = history.names().iter().any(|n| n == PASSIVE_POWER);
    names().next()?;
    Some(match (deforms, has_springs) {
        (false, false) => "power of the hinges",
        (true, false) => "power of hinges and deformation",
        (false, true) => "power of the actuators",
        (true, true) => "power of actuators and deformation",
    })
}
