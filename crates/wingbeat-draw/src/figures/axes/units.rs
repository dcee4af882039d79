//! Numbers in units that suit them.

use wingbeat_flight::{FlightSetup, natural_units};
use wingbeat_math::DVec3;
use wingbeat_results::History;
use wingbeat_results::columns::column_stems;

/// Differences of places over the length of a wing that are rounding \[1\].
const LENGTH_FLOOR: f64 = 1e-9;

/// A force over the largest beside it that is rounding \[1\].
pub(crate) const FORCE_FLOOR: f64 = 1e-9;

/// Power over force times speed of the flight that is rounding \[1\].
pub(crate) const POWER_FLOOR: f64 = 1e-12;

pub(crate) fn scaled(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|v| v * factor).collect()
}

/// A decimal prefix that suits the largest magnitude, and its factor.
pub(crate) fn prefix<'a>(values: impl IntoIterator<Item = &'a f64>) -> (f64, &'static str) {
    let finite = values.into_iter().filter(|v| v.is_finite());
    let top = finite.fold(0.0_f64, |a, v| a.max(v.abs()));
    let all = [(1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")];
    let fits = |(scale, _): &(f64, &str)| top >= 0.99 * scale;
    let smallest = if top > 0.0 { all[4] } else { all[1] };
    all.into_iter().find(fits).unwrap_or(smallest)
}

/// What forces are given in: unit as a label, and the factor from newtons.
pub(crate) fn force_unit<'a>(
    setup: &FlightSetup,
    values: impl IntoIterator<Item = &'a f64>,
) -> (String, f64) {
    let weight = setup.animal.mass() * setup.gravity.length();
    if weight > 0.0 {
        return ("weight".to_owned(), 1.0 / weight);
    }
    let (scale, prefix) = prefix(values);
    (format!("{prefix}N"), 1.0 / scale)
}

/// Differences of places below this are rounding \[m\].
pub(crate) fn length_floor(setup: &FlightSetup) -> f64 {
    LENGTH_FLOOR * natural_units(setup).length
}

/// What power is measured against, row by row \[W\]: weight and forces of the air on all bodies, times the speed of
/// the body and a wing length in a wingbeat (without wingbeats, in ten steps).
pub(crate) fn force_times_speed(setup: &FlightSetup, history: &History) -> Vec<f64> {
    let units = natural_units(setup);
    let weight = setup.animal.mass() * setup.gravity.length();
    let size = |columns: [String; 3]| {
        let columns: Vec<&[f64]> = columns.iter().map(|n| history.column(n)).collect();
        let part = |c: usize, row: usize| columns[c].get(row).copied().unwrap_or(0.0);
        let at = |row: usize| DVec3::from_array([0, 1, 2].map(|c| part(c, row))).length();
        (0..history.rows()).map(at).collect::<Vec<f64>>()
    };
    let mut force = vec![weight; history.rows()];
    for body in column_stems(&setup.animal) {
        let own = size([1, 2, 3].map(|k| format!("air_{body}_force_n{k}_newton")));
        force.iter_mut().zip(own).for_each(|(all, own)| *all += own);
    }
    let speed = size(["x", "y", "z"].map(|c| format!("body_{c}_rate_m_per_s")));
    let product = |(f, v): (f64, f64)| f * (v + units.length / units.time);
    force.into_iter().zip(speed).map(product).collect()
}
