//! `wingbeat stability`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::{Value, json};
use wingbeat::analysis::wake::{
    WakeMemory, WakeTrim, change_by_last_mode, elastic_modes, elastic_monodromy, steady_flight,
    steady_model, wake_floquet,
};
use wingbeat::analysis::{
    AnalysisError, LOADS, LinearModel, ModeSet, Plane, SteadyFlight, floquet_of_trim, glides,
    linear_model, table_model,
};
use wingbeat::case::LoadedCase;
use wingbeat::case::derivative_case;
use wingbeat::flight::AirModel;
use wingbeat::results::fixed::{fixed, signed};

use super::linear;
use super::trimming::{Trimming, is_towed, trimmed, trimmed_with_wake, unused};
use crate::command::options;
use crate::command::output::failure::Failure;
use crate::command::output::report::{Report, line};
use crate::command::output::target::Target;
use crate::command::progress::watch::watched;

/// Arguments of `wingbeat stability`.
#[derive(Args)]
pub(crate) struct StabilityArgs {
    #[command(flatten)]
    trimming: Trimming,
    /// Write the averaged model as a case file with stability derivatives; - is the standard output.
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
    /// In a vortex lattice: what is held fixed when the body is disturbed [default: one after the other; of
    /// gliders carried].
    #[arg(long, value_enum)]
    wake: Option<Wake>,
    /// With elastic wings in blade elements: modes of each wing that are disturbed, too [default: 3].
    #[arg(long, value_name = "N", value_parser = options::count::<1, MAX_MODES>)]
    modes: Option<usize>,
}

/// Modes of each wing at most, and unless told otherwise.
const MAX_MODES: usize = 20;
const DEFAULT_MODES: usize = 3;

/// What is held fixed.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Wake {
    /// The wake of the trimmed flight; the body jumps at its release.
    Given,
    /// The disturbance during the hold: the wake goes with it.
    Carried,
}

/// The whole command.
pub(crate) fn run(args: &StabilityArgs) -> Result<(), Failure> {
    let deliver = |report: &mut Report, [file]: [Option<Target>; 1]| {
        let case = args.trimming.load()?;
        let table = matches!(case.setup.air, AirModel::Derivatives(_));
        let (wakes, memory) = (case.setup.air.keeps_wake(), case.setup.has_memory());
        let is_averaged = !memory || is_towed(&case.setup);
        if args.write.is_some() && (table || !is_averaged) {
            let why = "only a trim of rigid wings in air without memory, or of a glider with rigid wings in the lattice, gives an averaged model to write";
            return Err(unused("write", why));
        }
        if args.wake.is_some() && !wakes {
            let why = match case.setup.air.has_strip_wakes() {
                true => {
                    "the wakes of strips (air.blade.unsteady) are part of the periodic orbit, and its modes always carry them along"
                }
                false => "this air has no wake",
            };
            return Err(unused("wake", why));
        }
        if args.modes.is_some() && (wakes || !case.setup.animal.is_elastic()) {
            let why =
                "only wings that bend, in air without wakes in space, take modes of theirs along";
            return Err(unused("modes", why));
        }
        match (table, memory) {
            (true, _) => of_table(&args.trimming, &case, report),
            (_, true) if wakes => with_wake(args, report, file),
            (_, true) => with_wings(args, report),
            _ => of_trim(&args.trimming, report, file),
        }
    };
    args.trimming.report.deliver([&args.write], deliver)
}

/// Why there is no averaged model; what follows has the modes of the wingbeat.
fn why_not_averaged(error: AnalysisError) -> String {
    match error {
        AnalysisError::NotCovered { what, .. } => {
            format!("{what}; Floquet's modes carry free joints along")
        }
        other => other.to_string(),
    }
}

/// Averaged model and orbit of a flight in air without memory.
fn of_trim(args: &Trimming, report: &mut Report, file: Option<Target>) -> Result<(), Failure> {
    if file.is_some() {
        // Before the trim, which takes its time.
        args.check_averaged()?;
        args.without_turn("an averaged model to write")?;
    }
    let (case, trim) = trimmed(args, report)?;
    let straight = match trim.turn_rate {
        0.0 => trim.beat.check_averaged().map_err(why_not_averaged),
        _ => Err("loads are averaged about a flight that is straight in the mean".to_owned()),
    };
    let averaged = match straight {
        Err(e) => {
            line!(report, "\nNo averaged model: {e}");
            report.value("no_averaged_model", e);
            None
        }
        Ok(()) => {
            let found = watched("averaged model", || linear_model(&trim.beat, &trim.state));
            Some(found?)
        }
    };
    let orbit = watched("Floquet's modes", || floquet_of_trim(&trim))?;
    if let Some(averaged) = &averaged {
        derivatives(report, averaged);
        if glides(&trim.setup) {
            neutral_point(report, averaged);
        }
        line!(
            report,
            "\nModes of the rigid body under mean loads (averaged over the beat):"
        );
        modes(report, "averaged_modes", &averaged.modes);
        imbalance(report, averaged);
    }
    line!(report, "\nModes of the full periodic orbit (Floquet):");
    modes(report, "floquet_modes", &orbit);
    let period = trim.beat.period();
    let unit = match glides(&trim.setup) {
        false => format!("times in wingbeats of {:.3} ms", 1e3 * period),
        true => beats_of_glide(period),
    };
    line!(
        report,
        "\nAxes: level frame of the trimmed attitude, forward, right, down, about the mass centre. The air has no\nmemory; {unit}."
    );
    report.value("wingbeat_s", trim.beat.period());
    if let (Some(file), Some(averaged)) = (file, averaged) {
        file.write(&derivative_case(
            &case,
            &SteadyFlight::of(&trim)?,
            &averaged,
        ))?;
        report.wrote(&file);
    }
    Ok(())
}

/// Imbalance of an averaged model above which it is called rough.
const ROUGH: f64 = 0.1;

/// How far the steady body of the averaged model is from balance.
fn imbalance(report: &mut Report, model: &LinearModel) {
    let [force, moment] = model.imbalance;
    line!(
        report,
        "  The free wingbeat is in balance; this steady body lacks {:.1} % of the weight and {:.1} % of weight times wing length.",
        100.0 * force,
        100.0 * moment
    );
    if force.max(moment) > ROUGH {
        line!(
            report,
            "  So much moves within a beat that averages say little: trust Floquet's modes."
        );
    }
    report.value("averaged_imbalance_over_weight", force);
    report.value("averaged_imbalance_over_weight_and_length", moment);
}

/// Floquet's modes of the free wingbeat after a hold.
fn with_wake(
    args: &StabilityArgs,
    report: &mut Report,
    file: Option<Target>,
) -> Result<(), Failure> {
    let (case, trim) = trimmed_with_wake(&args.trimming, report)?;
    if is_towed(&trim.setup) {
        let steady = watched("derivatives", || steady_model(&trim))?;
        derivatives(report, &steady);
        neutral_point(report, &steady);
        line!(
            report,
            "\nModes of the rigid body under the loads of steady tows (no lag of the downwash, no mass of air):"
        );
        modes(report, "averaged_modes", &steady.modes);
        if let Some(file) = file {
            file.write(&derivative_case(&case, &steady_flight(&trim)?, &steady))?;
            report.wrote(&file);
        }
    }
    let of = |report: &mut Report, wake: Wake, key: &str| -> Result<ModeSet, Failure> {
        let (memory, held) = match wake {
            Wake::Given => (WakeMemory::Given, "the wake of the trimmed flight"),
            Wake::Carried => (WakeMemory::Carried, "the disturbance during the hold"),
        };
        let found = watched("Floquet's modes", || wake_floquet(&trim, memory))?;
        line!(
            report,
            "\nModes of the free wingbeat after the hold (Floquet); held fixed: {held}:"
        );
        modes(report, key, &found);
        Ok(found)
    };
    // The wake of a glide is straight: disturbed steadily, the glide has another one.
    let usual = trim.tow.map(|_| Wake::Carried);
    if let Some(wake) = args.wake.or(usual) {
        of(report, wake, "floquet_modes")?;
        tell_unit(report, &trim);
        return Ok(());
    }
    let given = of(report, Wake::Given, "floquet_modes_given")?;
    let carried = of(report, Wake::Carried, "floquet_modes_carried")?;
    line!(
        report,
        "\nThe two bracket what the wake remembers: the modes are known no better than they agree."
    );
    for (plane, name) in [
        (Plane::Longitudinal, "longitudinal"),
        (Plane::Lateral, "lateral"),
    ] {
        let agree = given.kinds(plane) == carried.kinds(plane);
        if !agree {
            line!(
                report,
                "The {name} modes differ in kind between them: this flight does not tell which there are."
            );
        }
        report.value(&format!("{name}_modes_agree_in_kind"), agree);
    }
    tell_unit(report, &trim);
    Ok(())
}

/// What a beat is where nothing beats.
fn tell_unit(report: &mut Report, trim: &WakeTrim) {
    if let (Some(_), Some(period)) = (trim.glide(), trim.setup.time.period) {
        line!(report, "\n{}.", beats_of_glide(period));
    }
}

/// The same in words, of a `period` \[s\].
fn beats_of_glide(period: f64) -> String {
    format!(
        "nothing beats, and beats and multipliers are of {:.3} ms",
        1e3 * period
    )
}

/// Floquet's modes of body, elastic wings and wakes of strips.
fn with_wings(args: &StabilityArgs, report: &mut Report) -> Result<(), Failure> {
    let (_, trim) = trimmed_with_wake(&args.trimming, report)?;
    let is_rigid = trim.past.wings.is_empty();
    let count = match is_rigid {
        true => 0,
        false => args.modes.unwrap_or(DEFAULT_MODES),
    };
    let map = watched("Floquet's modes", || elastic_monodromy(&trim, count))?;
    let found = elastic_modes(&map)?;
    let of = match is_rigid {
        true => "body and wakes of strips (Floquet)".to_owned(),
        false => format!("body and wings (Floquet), {count} modes of each wing"),
    };
    line!(report, "\nModes of the full periodic orbit of {of}:");
    if trim.past.air.is_some() {
        line!(
            report,
            "  (all states of the wakes are coordinates; decaying motions in which they have more part than body and wings are left out)"
        );
    }
    modes(report, "floquet_modes", &found);
    report.value("modes_of_each_wing", count);
    if let Some(change) = change_by_last_mode(&map)? {
        line!(
            report,
            "\nWith one mode of each wing fewer the multipliers of motions that last change by at most {change:.1e}: where that matters, more modes (--modes)."
        );
        report.value("change_by_last_mode", change);
    }
    tell_unit(report, &trim);
    Ok(())
}

/// The modes of a case that is linear already.
fn of_table(args: &Trimming, case: &LoadedCase, report: &mut Report) -> Result<(), Failure> {
    args.without_trim()?;
    let model = table_model(&case.setup)?;
    line!(
        report,
        "{}: rigid body under its table of derivatives",
        case.name
    );
    report.value("case", case.name.as_str());
    derivatives(report, &model);
    line!(report, "\nModes:");
    modes(report, "modes", &model.modes);
    let beat = case.setup.time.period.unwrap_or(1.0);
    line!(
        report,
        "\nAxes: those of the table, about the mass centre; times in beats of {:.3} ms.",
        1e3 * beat
    );
    report.value("wingbeat_s", beat);
    Ok(())
}

fn derivatives(report: &mut Report, model: &LinearModel) {
    line!(
        report,
        "\nDerivatives of the mean loads, SI (N and N m per m/s and rad/s):"
    );
    line!(
        report,
        "  {:<4}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}",
        "",
        "u",
        "v",
        "w",
        "p",
        "q",
        "r"
    );
    for (name, row) in LOADS.iter().zip(&model.derivatives) {
        let cells = row.map(|x| format!("{x:>12.3e}"));
        line!(report, "  {name:<4}{}", cells.concat());
    }
    report.value("derivatives_si_by_u_v_w_p_q_r", json!(model.derivatives));
    let key = "added_mass_si_by_rates_of_u_v_w_p_q_r";
    report.value(key, json!(model.added_mass));
    report.value("linear_model", linear::value(model, None));
}

/// The neutral point of a glider.
fn neutral_point(report: &mut Report, model: &LinearModel) {
    let behind = model.neutral_point();
    line!(
        report,
        "The neutral point lies {:.3} mm behind the mass centre (M_w / Z_w).",
        1e3 * behind
    );
    report.value("neutral_point_behind_mass_centre_m", behind);
}

/// The modes as a table.
fn modes(report: &mut Report, key: &str, set: &ModeSet) {
    line!(
        report,
        "  {:<13}{:<22}{:>11}{:>11}{:>11}{:>12}{:>10}{:>22}  moves",
        "plane",
        "mode",
        "growth 1/s",
        "rad/s",
        "period s",
        "x2 or /2 s",
        "beats",
        "multiplier"
    );
    let mut values: Vec<Value> = vec![];
    for m in &set.modes {
        let or_dash = |x: Option<f64>, digits: usize| {
            x.map_or_else(|| "-".to_owned(), |x| format!("{x:.digits$}"))
        };
        let beats = m.doubling().map(|t| t / m.wingbeat);
        let multiplier = format!(
            "{}{}i",
            fixed(m.multiplier[0], 5),
            signed(m.multiplier[1], 5)
        );
        let largest = m.vector.iter().filter(|c| c.1 > 0.3);
        let moves: Vec<String> = largest.map(|c| format!("{} {:.2}", c.0, c.1)).collect();
        let plane = format!("{:?}", m.plane).to_lowercase();
        line!(
            report,
            "  {plane:<13}{:<22}{:>11}{:>11}{:>11}{:>12}{:>10}{multiplier:>22}  {}",
            m.name,
            fixed(m.growth, 4),
            fixed(m.frequency, 4),
            or_dash(m.period(), 4),
            or_dash(m.doubling(), 4),
            or_dash(beats, 2),
            moves.join(", ")
        );
        let vector = m.vector.iter();
        let vector: Vec<Value> = vector
            .map(|(name, size, phase)| json!({ "component": name, "size": size, "phase_rad": phase }))
            .collect();
        values.push(json!({
            "plane": plane,
            "name": m.name,
            "growth_per_s": m.growth,
            "frequency_rad_per_s": m.frequency,
            "multiplier": m.multiplier,
            "vector": vector,
        }));
    }
    report.value(key, values);
}
