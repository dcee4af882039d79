//! Numbers as people write them into files.

/// Five digits: what a reader edits. Powers of ten by threes, as prefixes go.
pub(super) fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.4e}").parse().expect("a number");
    if rounded != 0.0 && !(0.1..1e5).contains(&rounded.abs()) {
        let exponent = 3 * (rounded.abs().log10() / 3.0).floor() as i32;
        let mantissa: f64 = format!("{:.4e}", rounded / 10f64.powi(exponent))
            .parse()
            .expect("a number");
        return format!("{mantissa}e{exponent}");
    }
    format!("{rounded:?}")
}
