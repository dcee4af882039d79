//! A response that is small enough to be linear.
//!
//! A mode that grows makes of a small disturbance a large motion. Squares and products of its amplitude then
//! answer as modes of their own would: twice the growth without vibrating, and with twice the frequency; three
//! times the growth with the frequency itself. A part `q` of the response that goes by squares differs by `q /
//! 2` from twice the response to half the disturbance. Where that is more than [`LINEAR`], the disturbance is
//! made smaller, as long as that makes it less: rounding weighs the more, the smaller the motion.

use std::ops::Range;

use crate::AnalysisError;
use crate::vibration::realisation::rms;

/// Nonlinearity of a response that is small enough \[1\]: squares have half of the share that is reported
/// ([`super::MIN_SHARE`]).
const LINEAR: f64 = 2.5e-4;

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
}

impl Response {
    /// The response to a part of the disturbance that is small enough, or the most linear one.
    ///
    /// # Errors
    /// What flights report.
    pub fn linear(
        respond: impl Fn(f64) -> Result<Vec<Vec<f64>>, AnalysisError>,
    ) -> Result<Self, AnalysisError> {
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
        }
    }

    /// Part of the response that may go by squares \[1\].
    pub fn not_linear(&self) -> f64 {
        2.0 * self.nonlinearity
    }
}

pub(super) fn difference(a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let row = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| a - b).collect();
    a.iter().zip(b).map(row).collect()
}

fn doubled(response: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let row = |y: &Vec<f64>| y.iter().map(|x| 2.0 * x).collect();
    response.iter().map(row).collect()
}
