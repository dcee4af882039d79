//! `wingbeat check`: what a case holds, what its flight will be like, and whether it can be flown.

use clap::Args;
use serde_json::{Value, json};
use wingbeat::analysis::estimate;
use wingbeat::case::{IoError, LoadedCase};
use wingbeat::flight::{AirModel, FlightSetup, MotionMode, Simulation};
use wingbeat::model::ElasticReport;
use wingbeat::results::fixed::fixed;

use crate::command::expectation;
use crate::command::failure::Failure;
use crate::command::report::{Report, ReportArgs, line};
use crate::command::terminal::tell;
use crate::command::watch::Watch;

/// Arguments of `wingbeat check`.
#[derive(Args)]
pub(crate) struct CheckArgs {
    /// Case file or preset; - is the standard input.
    case: String,
    /// Set a key of the case, e.g. time.beats=3 (may be repeated).
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
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
    let case = LoadedCase::find(&args.case, &args.set)?;
    let estimate = estimate(&case.setup);
    let cost = trial_cost(&case, args.trial)?;
    line!(report, "{}: this case can be flown.\n", case.origin());
    report.value("case", case.name.as_str());
    describe(report, &case.setup);
    if let Some(feedback) = &case.setup.feedback {
        let [every, late] = [feedback.interval, feedback.latency];
        line!(
            report,
            "{:<10}a look every {every} steps, acting {late} looks later",
            "feedback"
        );
        report.value(
            "feedback",
            json!({ "every_steps": every, "latency_looks": late }),
        );
    }
    let panels = expectation::panels(&case.setup);
    line!(report, "{:<10}{panels} panels", "lattice");
    report.value("panels", panels);
    if let Some(program) = case.program() {
        line!(
            report,
            "{:<10}`wingbeat run` will start this one with your rights: {program}",
            "program"
        );
        report.value("program", program);
    }
    if let Some(program) = case.control_program() {
        line!(
            report,
            "{:<10}`wingbeat run` will start this one with your rights: {program}",
            "control"
        );
        report.value("control_program", program);
    }
    expectation::tell(report, &estimate);
    line!(report, "{:<10}{cost}", "cost");
    report.value("cost", cost);
    for doubt in &estimate.doubts {
        tell!("warning: {doubt}");
    }
    report.value("warnings", estimate.doubts);
    Ok(())
}

/// What the first steps cost, flown on trial where that is quick. A check starts no other program.
fn trial_cost(case: &LoadedCase, trial: bool) -> Result<String, IoError> {
    let setup = case.unasked();
    if matches!(setup.air, AirModel::External(_)) {
        Simulation::new(setup).map_err(|e| IoError::from(case.refused(&e)))?;
        return Ok("not tried: a check does not start the external program".into());
    }
    let unknowns = expectation::unknowns(&case.setup);
    if !trial && unknowns > expectation::MAX_UNKNOWNS {
        return Ok(format!(
            "not tried: {unknowns} unknown circulations take long and {:.1} GB to solve for; `wingbeat check --trial` does",
            8e-9 * (unknowns as f64).powi(2)
        ));
    }
    let _watch = Watch::new(&format!(
        "first steps on trial, {unknowns} unknown circulations"
    ));
    let flight = Simulation::new(setup);
    let cost = flight.and_then(|mut flight| expectation::cost(&mut flight));
    Ok(cost.map_err(|e| case.refused(&e))?)
}

fn said(w: &ElasticReport) -> String {
    let kind = if w.is_sheet { "sheet" } else { "beam" };
    let slack = match w.slack > 0.0 {
        true => format!(
            "; its tension at rest pulls at free edges, which give way by {:.2e} mm",
            1e3 * w.slack
        ),
        false => String::new(),
    };
    format!(
        "`{}`: a {kind} of {} nodes, {} of them held{slack}",
        w.name, w.nodes, w.held
    )
}

fn value(w: &ElasticReport) -> Value {
    json!({
        "name": w.name,
        "kind": if w.is_sheet { "sheet" } else { "beam" },
        "nodes": w.nodes,
        "held_nodes": w.held,
        "slack_m": w.slack,
    })
}

fn describe(report: &mut Report, setup: &FlightSetup) {
    let animal = &setup.animal;
    line!(
        report,
        "{:<10}{:.4e} kg, of it body {:.4e} kg",
        "mass",
        animal.mass(),
        animal.body.mass
    );
    report.value("mass_kg", animal.mass());
    report.value("body_mass_kg", animal.body.mass);
    let centre = animal.body.centre().to_array();
    line!(
        report,
        "{:<10}mass centre of the body at [{}] mm",
        "body",
        centre.map(|x| fixed(1e3 * x, 3)).join(", ")
    );
    report.value("body_mass_centre_m", json!(centre));
    for w in animal.wing_reports() {
        line!(
            report,
            "{:<10}`{}`: length {:.3} mm, area {:.3} mm2, mean chord {:.3} mm, r2_hat {:.3}, mass {:.3e} kg",
            "wing",
            w.name,
            w.length * 1e3,
            w.area * 1e6,
            w.mean_chord * 1e3,
            w.r2_hat,
            w.mass
        );
    }
    let elastic = animal.wings.iter().filter_map(|w| w.elastic_report());
    let elastic: Vec<ElasticReport> = elastic.collect();
    for w in &elastic {
        line!(report, "{:<10}{}", "elastic", said(w));
    }
    let values: Vec<Value> = elastic.iter().map(value).collect();
    report.value("elastic_wings", values);
    let mode = match setup.mode {
        MotionMode::Free(_) => "free flight",
        MotionMode::Tethered(_) => "tethered",
    };
    let air = setup.air.name();
    line!(report, "{:<10}{mode}, {air}", "flight");
    report.value("flight", mode);
    report.value("air", air);
    let time = &setup.time;
    line!(
        report,
        "{:<10}{} steps of {:.4e} s",
        "time",
        time.steps,
        time.step
    );
    report.value("steps", time.steps);
    report.value("step_s", time.step);
}
