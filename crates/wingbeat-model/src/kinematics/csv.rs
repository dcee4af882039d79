//! The shipped tables: comment lines with `#`, one header line, numbers.

/// Rows of numbers; a cell that is not a number (a name) reads as NaN.
///
/// # Panics
/// If the table has no rows: the tables are part of the program.
pub(super) fn rows(text: &str) -> Vec<Vec<f64>> {
    let lines = text
        .lines()
        .filter(|l| !l.starts_with('#') && !l.is_empty());
    let row = |l: &str| {
        l.split(',')
            .map(|c| c.trim().parse().unwrap_or(f64::NAN))
            .collect()
    };
    let rows: Vec<Vec<f64>> = lines.skip(1).map(row).collect();
    assert!(!rows.is_empty(), "a shipped table has no rows");
    rows
}
