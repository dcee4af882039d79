//! Why a flight was not found, and how far the way to it led.

use crate::trim::unknown::Unknown;

/// Why a velocity was not reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lost {
    /// No point there has residuals within the tolerance; the largest of the best, if one was finite.
    NotTrimmed(Option<f64>),
    /// This unknown would lie outside the bounds of the problem.
    Bound(Unknown),
    /// A wing would stroke over more than half a circle \[rad\]: right and left wings pass through each other.
    Stroke(f64),
    /// It was not tried: the flights end at a lower speed.
    Beyond,
}

/// How far slower flights led towards one that was not found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Speed through the air of the fastest flight on the way with strokes of at most half a circle [m/s].
    pub airspeed: f64,
    /// Why the flight beyond is none.
    pub ended: Lost,
}
