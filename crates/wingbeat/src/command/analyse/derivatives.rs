//! `wingbeat derivatives`.

use serde_json::{Value, json};
use wingbeat::analysis::wake::{steady_controls, steady_inputs, steady_model};
use wingbeat::analysis::{ControlDerivative, input_matrix, linear_model, trimmed_controls};

use super::linear;
use super::trimming::{Trimming, is_towed, trimmed, trimmed_with_wake};
use crate::command::output::failure::Failure;
use crate::command::output::report::{Report, line};
use crate::command::progress::watch::watched;

/// The whole command.
pub(crate) fn run(args: &Trimming) -> Result<(), Failure> {
    args.report.deliver([], |report, []| find(args, report))
}

fn find(args: &Trimming, report: &mut Report) -> Result<(), Failure> {
    let case = args.load()?;
    args.without_turn("a steadily moving body, about which loads are averaged,")?;
    if is_towed(&case.setup) {
        let (_, trim) = trimmed_with_wake(args, report)?;
        let list = watched("control derivatives", || steady_controls(&trim))?;
        let model = watched("derivatives", || steady_model(&trim))?;
        let b = steady_inputs(&trim, &list)?;
        tell(report, &list);
        report.value("linear_model", linear::value(&model, Some((&list, &b))));
        return Ok(());
    }
    args.check_averaged()?;
    let (_, trim) = trimmed(args, report)?;
    let list = watched("derivatives", || trimmed_controls(&trim))?;
    let model = linear_model(&trim.beat, &trim.state)?;
    let b = input_matrix(&trim.beat, &trim.state, &list)?;
    tell(report, &list);
    report.value("linear_model", linear::value(&model, Some((&list, &b))));
    Ok(())
}

/// The derivatives as a table.
fn tell(report: &mut Report, list: &[ControlDerivative]) {
    line!(
        report,
        "\nControl derivatives of the mean loads, N and N m per unit (1, rad, wingbeat):"
    );
    line!(
        report,
        "  {:<20}{:<8}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}",
        "control",
        "wing",
        "X",
        "Y",
        "Z",
        "L",
        "M",
        "N"
    );
    let mut values: Vec<Value> = vec![];
    for d in list {
        let (f, m) = (d.derivative.force, d.derivative.moment);
        let cells = [f.x, f.y, f.z, m.x, m.y, m.z].map(|x| format!("{x:>12.3e}"));
        line!(report, "  {:<20}{:<8}{}", d.control, d.wing, cells.concat());
        values.push(json!({
            "control": d.control,
            "wing": d.wing,
            "force_newton_per_unit": f.to_array(),
            "moment_newton_m_per_unit": m.to_array(),
        }));
    }
    line!(
        report,
        "\nAxes: level frame, forward, right, down; moments about the mean mass centre, where the control puts it."
    );
    line!(
        report,
        "stroke_amplitude and frequency are in parts of those trimmed: 0.1 is a tenth more, whatever motion.adjust has."
    );
    report.value("control_derivatives", values);
}
