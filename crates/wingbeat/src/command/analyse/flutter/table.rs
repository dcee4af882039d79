//! The table of `wingbeat flutter` on the terminal.

use std::f64::consts::TAU;

use wingbeat::analysis::flutter::{Condition, Vibration};

use crate::command::output::report::{Report, line};

pub(super) fn head(report: &mut Report, name: &str, are_several: bool) {
    report.value("case", name);
    line!(report, "{name}: vibrations about the deformed steady state");
    line!(
        report,
        "  {:>10}{:>12}{:>12}{:>12}{:>10}{:>12}{:>10}{}",
        "speed m/s",
        "tip m",
        "Hz",
        "growth 1/s",
        "+-",
        "damping",
        "share",
        if are_several { "  wing" } else { "" }
    );
}

/// The modes at a speed; of which `wing`, where there are several.
pub(super) fn tell(report: &mut Report, c: &Condition, wing: Option<&str>) {
    let wing = wing.map_or(String::new(), |name| format!("  {name}"));
    let (shown, folded) = shown(c);
    for (place, &k) in shown.iter().enumerate() {
        let m = &c.modes[k];
        let (speed, tip) = match place {
            0 => (
                format!("{:.3}", c.speed),
                format!("{:.5}", c.steady.tip.length()),
            ),
            _ => (String::new(), String::new()),
        };
        line!(
            report,
            "  {speed:>10}{tip:>12}{:>12.4}{:>12.4}{:>10.1e}{:>12.5}{:>10.4}{wing}",
            m.frequency / TAU,
            m.growth,
            c.uncertainty[k],
            m.damping(),
            m.share
        );
    }
    if folded.len() > 1 {
        let share = folded.iter().map(|&k| c.modes[k].share).fold(0.0, f64::max);
        line!(
            report,
            "  {:>10}{:>12}  and {} more with shares of {share:.4} at most whose growth is not known: see --json",
            "",
            "",
            folded.len()
        );
    }
    if let Some((motion, uncertainty)) = c.divergence {
        line!(
            report,
            "  {:>10}{:>12}{:>12}{:>12.4}{:>10.1e}{:>12}{:>10.4}{wing}",
            "",
            "",
            "none",
            motion.growth,
            uncertainty,
            "",
            motion.share
        );
    }
    for note in notes(c) {
        line!(report, "  {:>10}{note}", "");
    }
}

/// Share below which a mode whose growth is not known is not worth a line \[1\].
const SMALL_SHARE: f64 = 0.05;

/// The modes that are told one by one, and those that are told together: of small shares, their growth smaller than what
/// is not known of it. That of the largest share is always told.
fn shown(c: &Condition) -> (Vec<usize>, Vec<usize>) {
    let share = |k: usize| c.modes[k].share;
    let all = 0..c.modes.len();
    let largest = all.clone().max_by(|a, b| share(*a).total_cmp(&share(*b)));
    let counts =
        |k: &usize| Some(*k) == largest || c.grows(*k).is_some() || share(*k) >= SMALL_SHARE;
    let (shown, folded): (Vec<usize>, Vec<usize>) = all.partition(counts);
    match folded.len() {
        1 => ((0..c.modes.len()).collect(), vec![]),
        _ => (shown, folded),
    }
}

/// Part of a response that is not linear, and part that no mode explains, from which on they are told \[1\].
/// Growth of the leading mode is known to about this part of one over the length of the response: a few per
/// cent are as much as damping of a mode near flutter.
const NOT_LINEAR: f64 = 0.05;
const UNEXPLAINED: f64 = 0.02;

/// What makes the modes at a speed doubtful.
pub(super) fn notes(c: &Condition) -> Vec<String> {
    let mut notes = vec![];
    if c.nonlinearity > NOT_LINEAR {
        notes.push(format!(
            "  nonlinearity {:.2}: the response is not proportional to the disturbance; try a smaller --disturbance",
            c.nonlinearity
        ));
    }
    if c.response.residual > UNEXPLAINED {
        notes.push(format!(
            "  residual {:.2}: no modes explain this part of the response; try other --modes, longer --periods or a smaller --disturbance",
            c.response.residual
        ));
    }
    if !c.untold.is_empty() {
        let appear = |v: &Vibration| format!("{:.2} Hz (share {:.4})", v.frequency / TAU, v.share);
        let all: Vec<String> = c.untold.iter().map(appear).collect();
        notes.push(format!(
            "  the frequency of what appears at {} is not known and left out: two motions look alike, or it has about two steps a period; try a smaller time.step_s, or other --modes or --periods",
            all.join(", ")
        ));
    }
    if let Some((joint, period)) = &c.slow_joint {
        notes.push(format!(
            "  the response of {:.3} s is shorter than a period on joint `{joint}` ({period:.3} s, what it carries rigid and in a vacuum): what moves on it is not found; make --periods {:.0} times as large, with --modes 1 or 2",
            c.length,
            (1.5 * period / c.length).ceil()
        ));
    }
    notes
}
