//! Numbers as people write them into files.

use wingbeat_math::to_digits;

/// Five digits: what a reader edits. Powers of ten by threes, as prefixes go.
pub(super) fn number(x: f64) -> String {
    let rounded = to_digits(x, 5);
    if rounded != 0.0 && !(0.1..1e5).contains(&rounded.abs()) {
        let exponent = 3 * (rounded.abs().log10() / 3.0).floor() as i32;
        let mantissa = to_digits(rounded / 10f64.powi(exponent), 5);
        return format!("{mantissa}e{exponent}");
    }
    format!("{rounded:?}")
}
