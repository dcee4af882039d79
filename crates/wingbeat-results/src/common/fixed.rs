//! Numbers with a fixed number of digits after the point, for people.

/// `value` with `digits` digits after the point; what rounds to zero has no sign.
pub fn fixed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(rest) if is_zero(rest) => rest.to_owned(),
        _ => text,
    }
}

/// The same with a sign always: `+0.000` for what rounds to zero.
pub fn signed(value: f64, digits: usize) -> String {
    let text = format!("{value:+.digits$}");
    match text.strip_prefix('-') {
        Some(rest) if is_zero(rest) => format!("+{rest}"),
        _ => text,
    }
}

/// As [`signed`]; from `10^7` on with a power of ten: such digits say nothing of a flight that broke down.
pub fn signed_or_power(value: f64, digits: usize) -> String {
    match value.abs() < 1e7 || !value.is_finite() {
        true => signed(value, digits),
        false => format!("{value:+.3e}"),
    }
}

fn is_zero(digits: &str) -> bool {
    digits.chars().all(|c| "0.".contains(c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_large_numbers_are_powers_of_ten() {
        assert_eq!(signed_or_power(-1234.5678, 3), "-1234.568");
        assert_eq!(signed_or_power(-9.862_85e41, 3), "-9.863e41");
    }

    #[test]
    fn exact_zero_has_no_minus() {
        for zero in [0.0, -0.0, -4e-4, 4e-4] {
            assert_eq!(fixed(zero, 3), "0.000");
            assert_eq!(signed(zero, 3), "+0.000");
            assert_eq!(fixed(zero, 0), "0");
        }
        assert_eq!(
            (fixed(-6e-4, 3), signed(-6e-4, 3)),
            ("-0.001".into(), "-0.001".into())
        );
        assert_eq!(
            (fixed(2.5, 1), signed(2.5, 1)),
            ("2.5".into(), "+2.5".into())
        );
    }
}
