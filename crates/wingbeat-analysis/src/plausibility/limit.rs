//! Numbers outside wide limits, in words.

/// A number outside these limits is doubted.
pub(super) struct Limit {
    pub low: f64,
    pub high: f64,
    /// What may have gone wrong where it is lower, and where it is higher.
    pub hints: [&'static str; 2],
}

impl Limit {
    /// Without a lower limit, of a quantity that is not negative; `hint` says what may be wrong above it.
    pub const fn at_most(high: f64, hint: &'static str) -> Self {
        Self {
            low: 0.0,
            high,
            hints: ["", hint],
        }
    }

    fn doubt(&self, what: &str, x: f64, unit: &str) -> Option<String> {
        let [low, high] = self.hints;
        let (side, hint) = match x {
            x if x < self.low => ("below", low),
            x if x > self.high => ("above", high),
            _ => return None,
        };
        let limit = if side == "below" { self.low } else { self.high };
        Some(format!(
            "{what} {}{unit} is {side} {limit}{unit}: {hint}",
            rounded(x)
        ))
    }
}

/// Three digits, as people write them.
pub(super) fn rounded(x: f64) -> String {
    if x != 0.0 && !(1e-2..1e5).contains(&x.abs()) {
        return format!("{x:.2e}");
    }
    let digits = (2 - x.abs().max(1e-9).log10().floor() as i32).clamp(0, 4);
    format!("{x:.*}", digits as usize)
}

/// Doubts about the numbers of a flight.
#[derive(Default)]
pub(super) struct Doubts(pub Vec<String>);

impl Doubts {
    /// Looks at the number `x` of the quantity `what`, if there is one.
    pub fn see(&mut self, limit: &Limit, what: &str, x: impl Into<Option<f64>>, unit: &str) {
        let doubt = x.into().and_then(|x| limit.doubt(what, x, unit));
        self.0.extend(doubt);
    }
}
