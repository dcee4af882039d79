//! Numbers in units that suit them.

use wingbeat_flight::{FlightSetup, natural_units};

/// Differences of places over the length of a wing that are rounding \[1\].
const LENGTH_FLOOR: f64 = 1e-9;

pub(super) fn scaled(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|v| v * factor).collect()
}

/// A decimal prefix that suits the largest magnitude, and its factor.
pub(super) fn prefix(values: &[f64]) -> (f64, &'static str) {
    let finite = values.iter().filter(|v| v.is_finite());
    let top = finite.fold(0.0_f64, |a, v| a.max(v.abs()));
    let all = [(1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")];
    let fits = |(scale, _): &(f64, &str)| top >= 0.99 * scale;
    let smallest = if top > 0.0 { all[4] } else { all[1] };
    all.into_iter().find(fits).unwrap_or(smallest)
}

/// What forces are given in: unit as a label, and the factor from newtons.
pub(super) fn force_unit(setup: &FlightSetup, values: &[f64]) -> (String, f64) {
    let weight = setup.animal.mass() * setup.gravity.length();
    if weight > 0.0 {
        return ("weight".to_owned(), 1.0 / weight);
    }
    let (scale, prefix) = prefix(values);
    (format!("{prefix}N"), 1.0 / scale)
}

/// Differences of places below this are rounding \[m\].
pub(super) fn length_floor(setup: &FlightSetup) -> f64 {
    LENGTH_FLOOR * natural_units(setup).length
}
