//! Ticks at round numbers, and their labels.

/// Positions of about `most` ticks between `lo` and `hi` and their labels: multiples of 1, 2 or 5
/// times a power of ten.
pub(crate) fn linear(lo: f64, hi: f64, most: usize) -> Vec<(f64, String)> {
    if hi <= lo || !(hi - lo).is_finite() {
        return vec![];
    }
    let raw = (hi - lo) / most.max(1) as f64;
    let power = 10f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * power);
    let step = step.into_iter().find(|s| *s >= raw * 0.999_999);
    let step = step.unwrap_or(10.0 * power);
    let first = (lo / step - 1e-6).ceil() as i64;
    let last = (hi / step + 1e-6).floor() as i64;
    let ticks = (first..=last.min(first + 50)).map(|k| k as f64 * step);
    ticks.map(|t| (t, label(t, step))).collect()
}

/// Whole decades between the exponents `lo` and `hi` (both powers of ten), about `most` of them.
pub(crate) fn decades(lo: f64, hi: f64, most: usize) -> Vec<(f64, String)> {
    let [first, last] = [(lo - 1e-9).ceil() as i64, (hi + 1e-9).floor() as i64];
    let count = (last - first + 1).max(1) as usize;
    let step = count.div_ceil(most.max(1)).max(1) as i64;
    let ticks = (first..=last).filter(|k| k.rem_euclid(step) == 0);
    ticks.map(|k| (k as f64, ten_to(k))).collect()
}

/// A tick as text, with the digits its spacing needs.
fn label(value: f64, step: f64) -> String {
    let largest = value.abs().max(step);
    if !(1e-4..1e6).contains(&largest) {
        return scientific(value);
    }
    let digits = (-(step.log10() + 1e-9).floor()).clamp(0.0, 12.0) as usize;
    minus(&format!("{value:.digits$}"))
}

/// A number as text, with a power of ten where it is very large or small.
pub(crate) fn short(value: f64) -> String {
    match (1e-4..1e5).contains(&value.abs()) {
        true => minus(&value.to_string()),
        false => scientific(value),
    }
}

/// Digits times a power of ten.
pub(crate) fn scientific(value: f64) -> String {
    let text = format!("{value:.1e}");
    let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    match power.parse() {
        Ok(0) | Err(_) => minus(digits),
        Ok(power) => format!("{}·{}", minus(digits), ten_to(power)),
    }
}

fn ten_to(power: i64) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    let power: String = power.to_string().chars().map(raised).collect();
    format!("10{power}")
}

/// With a minus sign that is as wide as a plus.
fn minus(text: &str) -> String {
    let zero = text
        .trim_start_matches('-')
        .chars()
        .all(|c| "0.".contains(c));
    if zero {
        text.trim_start_matches('-').to_owned()
    } else {
        text.replace('-', "−")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: Vec<(f64, String)>) -> Vec<String> {
        ticks.into_iter().map(|t| t.1).collect()
    }

    #[test]
    fn exact_ticks_are_round_numbers() {
        assert_eq!(labels(linear(0.0, 5.0, 6)), ["0", "1", "2", "3", "4", "5"]);
        assert_eq!(labels(linear(-0.7, 0.7, 4)), ["−0.5", "0.0", "0.5"]);
        assert_eq!(
            labels(linear(0.0, 3e-8, 3)),
            ["0", "1·10⁻⁸", "2·10⁻⁸", "3·10⁻⁸"]
        );
        assert_eq!(
            labels(decades(-12.5, 0.2, 5)),
            ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"]
        );
        assert!(linear(1.0, 1.0, 5).is_empty() && linear(f64::NAN, 1.0, 5).is_empty());
    }
}
