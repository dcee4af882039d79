//! Means of two flights beside each other, and whether they differ by more than their errors.

use serde::Serialize;

use super::estimate::Estimate;
use super::numbers::Summary;

/// A difference is beyond the errors from so many of its standard errors on.
const BEYOND: f64 = 2.0;

/// A mean over wingbeats of two flights.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeanDifference {
    /// What it is, with its unit.
    pub what: &'static str,
    /// Of the first flight.
    pub first: Estimate,
    /// Of the second.
    pub second: Estimate,
    /// The second less the first; its error is that of independent flights.
    pub difference: Estimate,
    /// Whether the difference is beyond twice its error; none without an error.
    pub is_beyond_errors: Option<bool>,
}

impl MeanDifference {
    fn between(what: &'static str, first: Estimate, second: Estimate) -> Self {
        let errors = first.standard_error.zip(second.standard_error);
        let difference = Estimate {
            mean: second.mean - first.mean,
            standard_error: errors.map(|(a, b)| a.hypot(b)),
        };
        let is_beyond = |error: f64| difference.mean.abs() > BEYOND * error;
        Self {
            what,
            first,
            second,
            is_beyond_errors: difference.standard_error.map(is_beyond),
            difference,
        }
    }
}

impl Summary {
    /// The means over wingbeats of two flights beside each other; empty where one of them has none.
    pub fn means_beside(&self, other: &Self) -> Vec<MeanDifference> {
        let (Some(a), Some(b)) = (&self.means, &other.means) else {
            return vec![];
        };
        let rows = a.estimate.beside(&b.estimate).into_iter();
        rows.map(|(what, x, y)| MeanDifference::between(what, x, y))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_difference_beyond_twice_its_error_is_named() {
        let of = |mean, error| Estimate {
            mean,
            standard_error: error,
        };
        let row = |second| MeanDifference::between("lift [N]", of(1.0, Some(0.3)), second);
        let near = row(of(1.9, Some(0.4)));
        assert!((near.difference.mean - 0.9).abs() < 1e-15);
        assert!(
            near.difference
                .standard_error
                .is_some_and(|e| (e - 0.5).abs() < 1e-15)
        );
        assert_eq!(near.is_beyond_errors, Some(false));
        assert_eq!(row(of(2.1, Some(0.4))).is_beyond_errors, Some(true));
        assert_eq!(row(of(2.1, None)).is_beyond_errors, None);
    }
}
