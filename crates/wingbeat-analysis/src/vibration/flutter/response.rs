//! A response that is small enough to be linear.
//!
//! A mode that grows makes of a small disturbance a large motion. Squares and products of its amplitude then
//! answer as modes of their own would: twice the growth without vibrating, and with twice the frequency; three
//! times the growth with the frequency itself. A part `q` of the response that goes by squares differs by `q /
//! 2` from twice the response to half the disturbance. Where that is more than [`LINEAR`], the disturbance is
//! made smaller, as long as that makes it less: rounding weighs the more, the smaller the motion.
//!
//! The undisturbed flight is left by the mode that grows as well, by what the steady state it began in is not quite one.
//! The response about a flight that has moved by `b` is not that about the steady state: it has products of `b` and
//! itself, which are in proportion to the disturbance, so that no smaller one makes them less. Where squares of a
//! response `r` are the part `q` of it, they are about `2 q b / r` ([`Response::of_the_base`]).

use std::ops::Range;

use crate::AnalysisError;
use crate::vibration::realisation::rms;

/// Nonlinearity of a response that is small enough \[1\]: squares have half of the share that is reported
/// ([`super::MIN_SHARE`]).
pub(super) const LINEAR: f64 = 2.5e-4;

/// Most times that the disturbance is made smaller, and bounds of the part that is left each time \[1\].
const TRIALS: usize = 4;
const PARTS: [f64; 2] = [1e-3, 0.5];

/// A difference of two flights.
pub(super) struct Response {
    /// Part of the disturbance that was asked for \[1\].
    pub part: f64,
    /// Outputs, one row a sample.
    pub whole: Vec<Vec<f64>>,
    /// Twice the response to half of it.
    pub doubled: Vec<Vec<f64>>,
    /// Difference of the two, over the response \[1\].
    pub nonlinearity: f64,
    /// The undisturbed flight less its start, over the response \[1\].
    pub moved: f64,
}

impl Response {
    /// The response to a part of the disturbance that is small enough, or the most linear one, of flights whose outputs
    /// with a part of the disturbance are `flown`; those at their start are `start`.
    ///
    /// # Errors
    /// What flights report.
    pub fn linear(
        start: &[f64],
        flown: impl Fn(f64) -> Result<Vec<Vec<f64>>, AnalysisError>,
    ) -> Result<Self, AnalysisError> {
        let still = flown(0.0)?;
        let base = difference(&still, &vec![start.to_vec(); still.len()]);
        let respond = |part: f64| Ok(difference(&flown(part)?, &still));
        let mut best = Self::to(1.0, &respond)?;
        for _ in 0..TRIALS {
            if best.nonlinearity <= LINEAR {
                break;
            }
            let part = (0.5 * LINEAR / best.nonlinearity).clamp(PARTS[0], PARTS[1]);
            let next = Self::to(part * best.part, &respond)?;
            // Not a number, or more: not what is not linear.
            let is_better = next.nonlinearity < best.nonlinearity;
            if !is_better {
                break;
            }
            best = next;
        }
        best.moved = rms(&base) / rms(&best.whole);
        Ok(best)
    }

    /// The response to `part` of the disturbance.
    fn to(
        part: f64,
        respond: &impl Fn(f64) -> Result<Vec<Vec<f64>>, AnalysisError>,
    ) -> Result<Self, AnalysisError> {
        let whole = respond(part)?;
        let doubled = doubled(&respond(0.5 * part)?);
        Ok(Self {
            part,
            nonlinearity: rms(&difference(&whole, &doubled)) / rms(&whole),
            whole,
            doubled,
            moved: 0.0,
        })
    }

    /// Of these outputs.
    pub fn outputs(&self, range: Range<usize>) -> Self {
        let of = |samples: &[Vec<f64>]| -> Vec<Vec<f64>> {
            samples.iter().map(|y| y[range.clone()].to_vec()).collect()
        };
        let (whole, doubled) = (of(&self.whole), of(&self.doubled));
        Self {
            part: self.part,
            nonlinearity: rms(&difference(&whole, &doubled)) / rms(&whole),
            whole,
            doubled,
            moved: self.moved,
        }
    }

    /// Part of the response that may go by products with the way that the undisturbed flight has gone \[1\].
    pub fn of_the_base(&self) -> f64 {
        2.0 * (2.0 * self.nonlinearity) * self.moved
    }

    /// Part of the response that may not be linear \[1\].
    pub fn not_linear(&self) -> f64 {
        (2.0 * self.nonlinearity).max(self.of_the_base())
    }
}

fn difference(a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let row = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| a - b).collect();
    a.iter().zip(b).map(row).collect()
}

fn doubled(response: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let row = |y: &Vec<f64>| y.iter().map(|x| 2.0 * x).collect();
    response.iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `x' = x + x^2` from `x`, at times up to `ln 1000`: `x e^t / (1 - x (e^t - 1))`.
    fn grown(x: f64) -> Vec<Vec<f64>> {
        let at = |k: u32| {
            let e = 1000_f64.powf(f64::from(k) / 200.0);
            vec![x * e / (1.0 - x * (e - 1.0))]
        };
        (1..=200).map(at).collect()
    }

    /// The response about a flight that leaves its steady state differs from that about the state itself by as much as is
    /// estimated of it.
    #[test]
    fn agrees_products_with_the_base_with_the_response_about_the_steady_state() {
        const DISTURBANCE: f64 = 1e-6;
        for base in [1e-6, -1e-5] {
            let found = Response::linear(&[base], |part| Ok(grown(base + part * DISTURBANCE)));
            let found = found.unwrap();
            let none = Response::linear(&[0.0], |part| Ok(grown(part * DISTURBANCE))).unwrap();
            let shares = found.part / none.part;
            let about_rest: Vec<Vec<f64>> =
                none.whole.iter().map(|y| vec![shares * y[0]]).collect();
            let apart = rms(&difference(&found.whole, &about_rest)) / rms(&found.whole);
            // Higher powers of a base that grows to 0.01: 0.8 % of it.
            assert!(
                (found.of_the_base() / apart - 1.0).abs() < 0.03,
                "{} {apart}",
                found.of_the_base()
            );
            assert!(none.of_the_base() == 0.0 && none.not_linear() <= 2.0 * LINEAR);
        }
    }
}
