//! Everything the page knows of a flight, as JSON.

use serde_json::{Value, json};

use super::scene::Scene;
use crate::figures::{self, Chart, TimeWindow};
use wingbeat_case::IoError;
use wingbeat_math::to_digits;
use wingbeat_results::rows::Rows;
use wingbeat_results::summary::ordinal;
use wingbeat_results::{Outcome, ResultDir, Summary};

/// More points than this do not make a plot on a page better: of longer flights, extremes are shown.
const MAX_POINTS: usize = 3000;

/// Room for what describes the scene beside its frames \[bytes\].
const DESCRIPTION: usize = 5000;

/// Data of the page of a result under this name, in at most about `budget` bytes.
pub(super) fn gather(
    (dir, name): (&ResultDir, &str),
    outcome: &Outcome,
    budget: usize,
) -> Result<String, IoError> {
    let case = dir.case()?;
    let path = dir.join("history.csv");
    let every = case.output.history_every;
    let times = Rows::times(&path)?;
    let rows = 0..times.len();
    let part = TimeWindow::of(&case.setup, every, &times, &rows);
    let (charts, group) = figures::charts(&case.setup, &path, rows, (part, MAX_POINTS))?;
    let summary = Summary::read(&case, &path, outcome)?;
    let mut head = json!({
        "name": name,
        "description": case.raw.description,
        "version": dir.manifest()?.version,
        "outcome": words(outcome),
        "failed": reason(outcome),
        "is_whole": *outcome == Outcome::Finished,
        "verdict": summary.verdict.word(),
        "verdict_reason": summary.verdict_reason,
        "summary": summary.to_text(),
        "case": case.text(),
        "period": case.setup.time.period,
        "step_s": case.setup.time.step,
        "charts": charts.iter().map(|(name, c)| chart(name, c)).collect::<Vec<Value>>(),
    });
    let left = budget.saturating_sub(inert(&head.to_string()).len() + DESCRIPTION);
    let names = Rows::open(&path)?.names().to_vec();
    let scene = Scene::new(dir, &case, &names, left)?;
    let scene = scene.read(&case)?;
    scene.describe(&mut head, &case);
    head["thinned"] = json!(format!(
        "{}; {}; {}",
        scene.thinned(),
        plots(group, every),
        scene.precision()
    ));
    Ok(inert(&head.to_string()))
}

fn plots(group: usize, every: usize) -> String {
    match (group, every) {
        (1, 0 | 1) => "plots with every step".to_owned(),
        (1, n) => format!("plots with every {} step, as history.csv", ordinal(n)),
        (k, 0 | 1) => format!("plots with the extremes of every {k} steps"),
        (k, n) => format!(
            "plots with the extremes of every {k} rows of history.csv, which holds every {} step",
            ordinal(n)
        ),
    }
}

/// JSON that no element of the page can end or open: `<` stands only in its strings.
pub(crate) fn inert(json: &str) -> String {
    json.replace('<', "\\u003c")
}

fn words(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Finished => "flown to its end",
        Outcome::Running => "still running",
        Outcome::Interrupted => "interrupted",
        Outcome::Unwritten(_) => "stopped because it could not be written",
        Outcome::Failed(_) => "ended early by an error",
    }
}

/// What ended the flight early.
fn reason(outcome: &Outcome) -> &str {
    match outcome {
        Outcome::Failed(why) | Outcome::Unwritten(why) => why,
        _ => "",
    }
}

/// Five digits are more than a screen shows.
fn short(value: f64) -> Value {
    json!(to_digits(value, 5)) // not finite: null
}

fn chart(name: &str, chart: &Chart) -> Value {
    let list = |v: &[f64]| v.iter().map(|x| short(*x)).collect::<Vec<Value>>();
    let panels = chart.panels.iter().map(|p| {
        let series = p
            .series
            .iter()
            .map(|s| json!({ "label": s.label, "values": list(&s.values) }));
        json!({
            "label": p.label,
            "logarithmic": p.logarithmic,
            "shaded": p.shaded,
            "least": p.least,
            "series": series.collect::<Vec<Value>>(),
        })
    });
    json!({
        "name": name,
        "title": chart.title,
        "x_label": chart.x_label,
        "x": list(&chart.x),
        "shaded": chart.shaded,
        "panels": panels.collect::<Vec<Value>>(),
    })
}
