//! How the wings stroke: angles that rise in the downstroke, and when that is.

use wingbeat_flight::FlightSetup;
use wingbeat_model::Wing;

use crate::figures::axes::units::scaled;
use wingbeat_results::History;
use wingbeat_results::columns::column_stems;

/// Number of the wing that stands for all: the last one that beats, so no fixed tail; the last one where none does.
pub(crate) fn reference_number(setup: &FlightSetup) -> Option<usize> {
    let wings = &setup.animal.wings;
    let beats = |w: &Wing| {
        let phi = |k: usize| w.motion.angles.phi.at(k as f64 / 8.0)[0];
        w.motion.frequency > 0.0 && (1..8).any(|k| (phi(k) - phi(0)).abs() > 0.0)
    };
    let beating = wings.iter().rposition(beats);
    beating.or(wings.len().checked_sub(1))
}

/// Name in column names of the wing that stands for all ([`reference_number`]), and the sign that makes its
/// stroke angle rise in the downstroke; none for a motion without a period.
pub(crate) fn reference_wing(setup: &FlightSetup) -> Option<(String, f64)> {
    let number = reference_number(setup)?;
    stroking(setup).into_iter().nth(number)
}

/// Where the stroke angles of the wings stand in a row, and the signs by which they rise in the
/// downstroke; nothing for a motion without a period.
pub(crate) fn stroke_columns(setup: &FlightSetup, names: &[String]) -> Vec<Option<(usize, f64)>> {
    let column = |(wing, sign): (String, f64)| {
        let name = format!("{wing}_prescribed_phi_rad");
        Some((names.iter().position(|n| *n == name)?, sign))
    };
    stroking(setup).into_iter().map(column).collect()
}

/// Names in column names of all wings, with the signs by which their stroke angles rise in the
/// downstroke; nothing for a motion without a period.
fn stroking(setup: &FlightSetup) -> Vec<(String, f64)> {
    let wings = setup.animal.wings.iter().map(|w| w.side.sign());
    let names = column_stems(&setup.animal).into_iter().skip(1);
    let list = names.zip(wings).collect();
    setup.time.period.map_or(vec![], |_| list)
}

/// Stroke angle of the reference wing, row by row, with the sign by which it rises in the downstroke;
/// nothing without one \[rad\].
pub(crate) fn stroke(setup: &FlightSetup, history: &History) -> Vec<f64> {
    let number = reference_number(setup).unwrap_or(0);
    strokes(setup, history)
        .into_iter()
        .nth(number)
        .unwrap_or_default()
}

/// The same of every wing.
pub(crate) fn strokes(setup: &FlightSetup, history: &History) -> Vec<Vec<f64>> {
    let angle = |(wing, sign): (String, f64)| {
        scaled(history.column(&format!("{wing}_prescribed_phi_rad")), sign)
    };
    stroking(setup).into_iter().map(angle).collect()
}

/// Whether the reference wing goes down (or forward: its stroke angle rises) from each row to the
/// next.
pub(crate) fn goes_down(stroke: &[f64]) -> Vec<bool> {
    stroke.windows(2).map(|p| p[1] > p[0]).collect()
}

/// Intervals of the downstroke.
pub(crate) fn downstrokes(stroke: &[f64], x: &[f64]) -> Vec<[f64; 2]> {
    let mut list: Vec<[f64; 2]> = vec![];
    for (ends, down) in x.windows(2).zip(goes_down(stroke)) {
        match list.last_mut() {
            _ if !down => {}
            Some(last) if last[1] == ends[0] => last[1] = ends[1],
            _ => list.push([ends[0], ends[1]]),
        }
    }
    list
}
