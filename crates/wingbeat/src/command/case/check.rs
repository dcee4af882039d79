//! `wingbeat check`: what a case holds, what its flight will be like, and whether it can be flown.

use clap::Args;
use serde_json::{Value, json};
use wingbeat::analysis::estimate;
use wingbeat::case::{FittedTable, IoError, LoadedCase, MixedAngles, TableGaps};
use wingbeat::flight::{AirModel, FlightSetup, MotionMode, Simulation};
use wingbeat::model::ElasticReport;
use wingbeat::results::fixed::fixed;

use crate::command::case::expectation::{self, Cost};
use crate::command::options::CaseArgs;
use crate::command::output::failure::Failure;
use crate::command::output::report::{Report, ReportArgs, entry, line};
use crate::command::output::terminal::tell;
use crate::command::progress::watch::Watch;

/// Arguments of `wingbeat check`.
#[derive(Args)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    case: CaseArgs,
    /// Build and try lattices, too, that take long to build.
    #[arg(long)]
    trial: bool,
    #[command(flatten)]
    report: ReportArgs,
}

/// Describes the case, builds its flight and makes some steps on trial. Lattices that would take
/// long to build are built only if the user says so. Nothing of the case is executed: programs
/// that compute the air or command the wings are not started.
pub(crate) fn check(args: &CheckArgs) -> Result<(), Failure> {
    args.report
        .deliver([], |report, []| Ok(look(args, report)?))
}

fn look(args: &CheckArgs, report: &mut Report) -> Result<(), IoError> {
    let case = args.case.load()?;
    let mut estimate = estimate(&case.setup);
    let fits = case.fitted_tables();
    estimate.doubts.extend(case.doubtful_measurements());
    let ways = case.doubtful_ways(&estimate);
    estimate.doubts.extend(ways);
    estimate.doubts.extend(case.idle_keys());
    let warn = || estimate.doubts.iter().for_each(|d| tell!("warning: {d}"));
    let cost = trial_cost(&case, args.trial);
    let can = if cost.is_ok() { "can" } else { "cannot" };
    line!(report, "{}: this case {can} be flown.\n", case.origin());
    report.value("case", case.name.as_str());
    describe(report, &case.setup);
    feedback(report, &case.setup);
    expectation::tell_held(report, &case.setup);
    let panels = case.setup.panels();
    entry!(report, "lattice", "{panels} panels");
    report.value("panels", panels);
    programs(report, &case);
    tell_mixed(report, &case.mixed_angles());
    tell_adjusted(report, &case.adjusted_tables());
    expectation::tell(report, &estimate);
    expectation::tell_borne(report, &case.setup);
    // A flight that fails on trial fails of a wrong unit more often than of its steps.
    let cost = cost.inspect_err(|_| warn())?;
    entry!(report, "cost", "{cost}");
    report.value("cost", cost.value());
    tell_gaps(report, &case.table_gaps);
    tell_fits(report, &fits);
    warn();
    report.value("warnings", estimate.doubts);
    Ok(())
}

/// From where the angles of a wing come that do not all come from one place.
fn tell_mixed(report: &mut Report, wings: &[MixedAngles]) {
    for wing in wings {
        let [key, set] = &wing.set;
        entry!(
            report,
            "angles",
            "`{}`: {} from {key} = \"{set}\", {} given",
            wing.wing,
            wing.from_set.join(" and "),
            wing.given.join(" and "),
        );
    }
    let value = |w: &MixedAngles| {
        json!({
            "wing": w.wing,
            "given": w.given,
            "from_set": w.from_set,
            "key": w.set[0],
            "set": w.set[1],
        })
    };
    report.value("mixed_angles", wings.iter().map(value).collect::<Vec<_>>());
}

/// What changes the angles of tables before they are flown.
fn tell_adjusted(report: &mut Report, by: &[String]) {
    if !by.is_empty() {
        entry!(
            report,
            "angles",
            "tables of wings are changed by {}",
            by.join(", ")
        );
    }
    report.value("adjusted_tables", by);
}

/// Rows without an angle in tables of them.
fn tell_gaps(report: &mut Report, gaps: &[TableGaps]) {
    for table in gaps {
        entry!(
            report,
            "gaps",
            "{}: {} of {} rows have no angle and are left out",
            table.key,
            table.left_out,
            table.left_out + table.kept
        );
    }
    let value = |t: &TableGaps| json!({ "key": t.key, "left_out": t.left_out, "kept": t.kept });
    report.value("table_gaps", gaps.iter().map(value).collect::<Vec<_>>());
}

/// What is left between samples of angles and the series fitted to them, and whether wings beat at another
/// frequency than in these.
fn tell_fits(report: &mut Report, fits: &[FittedTable]) {
    for fit in fits {
        entry!(
            report,
            "fit",
            "{}: {} harmonics leave {:.3} deg (rms) of {} samples{}",
            fit.key,
            fit.harmonics,
            fit.residual_deg,
            fit.samples,
            fit.other_frequency()
                .map_or(String::new(), |text| format!("; {text}"))
        );
    }
    let value = |f: &FittedTable| {
        json!({
            "key": f.key,
            "harmonics": f.harmonics,
            "residual_deg": f.residual_deg,
            "samples": f.samples,
        })
    };
    report.value("fitted_tables", fits.iter().map(value).collect::<Vec<_>>());
}

/// How often feedback looks, and how late it acts.
fn feedback(report: &mut Report, setup: &FlightSetup) {
    let Some(feedback) = &setup.feedback else {
        return;
    };
    let (every, late) = (feedback.controller.every(), feedback.latency);
    let steps = every * feedback.interval;
    let acts = match (every, late) {
        (_, 0) => "acting at once".to_owned(),
        (1, 1) => "acting a look later".to_owned(),
        (1, _) => format!("acting {late} looks later"),
        _ => format!("acting {} steps later", late * feedback.interval),
    };
    entry!(report, "feedback", "a look every {steps} steps, {acts}");
    // Latency counts the looks that are left out, too.
    let value = json!({ "every_steps": steps, "latency_looks": late });
    report.value("feedback", value);
}

/// Programs that a flight of the case starts.
fn programs(report: &mut Report, case: &LoadedCase) {
    let started = "`wingbeat run` will start this one with your rights";
    if let Some(program) = case.program() {
        entry!(report, "program", "{started}: {program}");
        report.value("program", program);
    }
    if let Some(program) = case.control_program() {
        entry!(report, "control", "{started}: {program}");
        report.value("control_program", program);
    }
}

/// What the first steps cost, flown on trial where that is quick. A check starts no other program.
fn trial_cost(case: &LoadedCase, trial: bool) -> Result<Cost, IoError> {
    let setup = case.unasked();
    if matches!(setup.air, AirModel::External(_)) {
        Simulation::new(setup).map_err(|e| IoError::from(case.refused(&e)))?;
        return Ok(Cost::External);
    }
    let unknowns = expectation::unknowns(&case.setup);
    if !trial && unknowns > expectation::MAX_UNKNOWNS {
        return Ok(Cost::Unknowns(unknowns));
    }
    let _watch = Watch::new(&format!(
        "first steps on trial, {unknowns} unknown circulations"
    ));
    let flight = Simulation::new(setup);
    let cost = flight.and_then(|mut flight| expectation::cost(&mut flight));
    Ok(cost.map_err(|e| case.refused(&e))?)
}

/// What the case holds and how it is flown.
fn describe(report: &mut Report, setup: &FlightSetup) {
    body(report, setup);
    wings(report, setup);
    course(report, setup);
}

/// Mass and mass centre.
fn body(report: &mut Report, setup: &FlightSetup) {
    let (mass, body) = (setup.animal.mass(), &setup.animal.body);
    entry!(
        report,
        "mass",
        "{mass:.4e} kg, of it body {:.4e} kg",
        body.mass
    );
    report.value("mass_kg", mass);
    report.value("body_mass_kg", body.mass);
    let centre = body.centre().to_array();
    let shown = centre.map(|x| fixed(1e3 * x, 3)).join(", ");
    entry!(
        report,
        "body",
        "mass centre of the body at [{shown}] mm from the body origin"
    );
    report.value("body_mass_centre_m", json!(centre));
}

/// The wings, and what the elastic ones are made of.
fn wings(report: &mut Report, setup: &FlightSetup) {
    for w in setup.animal.wing_reports() {
        let (size, name) = unit(w.length);
        let length = |x: f64| format!("{} {name}", five_digits(x / size));
        entry!(
            report,
            "wing",
            "`{}`: length {}, area {}, mean chord {}, r2_hat {:.3}, mass {:.3e} kg",
            w.name,
            length(w.length),
            format_args!("{} {name}2", five_digits(w.area / (size * size))),
            length(w.mean_chord),
            w.r2_hat,
            w.mass
        );
    }
    let elastic = setup.animal.wings.iter().filter_map(|w| w.elastic_report());
    let elastic: Vec<ElasticReport> = elastic.collect();
    for w in &elastic {
        entry!(report, "elastic", "{}", said(w));
    }
    let values: Vec<Value> = elastic.iter().map(value).collect();
    report.value("elastic_wings", values);
}

/// Unit of lengths \[m\] that suits the length of a wing: its size and its name.
fn unit(length: f64) -> (f64, &'static str) {
    const UNITS: [(f64, &str); 3] = [(1.0, "m"), (1e-3, "mm"), (1e-6, "um")];
    let fits = |u: &&(f64, &str)| length >= u.0;
    UNITS.iter().find(fits).copied().unwrap_or((1e-9, "nm"))
}

/// A number with five digits, an exponent where it is far from one.
fn five_digits(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if (1e-4..1e8).contains(&size) => {
            let digits = (4 - size.log10().floor() as i32).max(0) as usize;
            format!("{x:.digits$}")
        }
        _ => format!("{x:.4e}"),
    }
}

fn said(w: &ElasticReport) -> String {
    let slack = match w.slack > 0.0 {
        true => format!(
            "; its tension at rest pulls at free edges, which give way by {:.2e} mm",
            1e3 * w.slack
        ),
        false => String::new(),
    };
    format!(
        "`{}`: a {} of {} nodes, {} of them held{slack}",
        w.name,
        kind(w),
        w.nodes,
        w.held
    )
}

fn value(w: &ElasticReport) -> Value {
    json!({
        "name": w.name,
        "kind": kind(w),
        "nodes": w.nodes,
        "held_nodes": w.held,
        "slack_m": w.slack,
    })
}

fn kind(w: &ElasticReport) -> &'static str {
    if w.is_sheet { "sheet" } else { "beam" }
}

/// Free or tethered, in which air, in which steps.
fn course(report: &mut Report, setup: &FlightSetup) {
    let mode = match setup.mode {
        MotionMode::Free(_) => "free flight",
        MotionMode::Tethered(_) => "tethered",
    };
    let air = setup.air.name();
    entry!(report, "flight", "{mode}, {air}");
    report.value("flight", mode);
    report.value("air", air);
    let time = &setup.time;
    entry!(
        report,
        "time",
        "{} steps of {:.4e} s",
        time.steps,
        time.step
    );
    report.value("steps", time.steps);
    report.value("step_s", time.step);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_sizes_have_five_digits_in_the_unit_of_the_wing() {
        for (length, area, wanted) in [
            (0.33, 0.033_65, "330.00 mm, 33650 mm2"),
            (2.5e-3, 1.7475e-6, "2.5000 mm, 1.7475 mm2"),
            (2.5e-9, 1.7475e-18, "2.5000 nm, 1.7475 nm2"),
            (12.0, 30.0, "12.000 m, 30.000 m2"),
        ] {
            let (size, name) = unit(length);
            let [x, a] = [length / size, area / (size * size)].map(five_digits);
            assert_eq!(format!("{x} {name}, {a} {name}2"), wanted);
        }
    }
}
