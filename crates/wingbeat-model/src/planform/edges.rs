//! Leading and trailing edge over the span.

use crate::planform::beta::BetaChord;
use wingbeat_math::interpolate_pairs;

/// Leading and trailing edge of a planform as functions of r.
#[derive(Clone, Debug, PartialEq)]
pub struct Edges {
    /// Distance from the hinge to the root \[m\].
    pub root: f64,
    /// Distance from the hinge to the tip: the wing length R \[m\].
    pub tip: f64,
    pub(crate) curve: Curve,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Curve {
    Straight(f64, f64),
    Beta(BetaChord, f64),
    Points(Vec<(f64, f64)>, Vec<(f64, f64)>, f64),
}

impl Edges {
    /// Leading and trailing edge x at the distance `r` from the hinge \[m\].
    pub fn at(&self, r: f64) -> [f64; 2] {
        match &self.curve {
            &Curve::Straight(lead, trail) => [lead, trail],
            Curve::Beta(chord, ahead) => {
                let c = chord.at((r - self.root) / (self.tip - self.root));
                [ahead * c, (ahead - 1.0) * c]
            }
            Curve::Points(leading, trailing, least) => {
                let [a, b] = [
                    interpolate_pairs(leading, r),
                    interpolate_pairs(trailing, r),
                ];
                widened([a, b], *least)
            }
        }
    }
}

/// Edges moved apart to this chord at least.
pub(super) fn widened([leading, trailing]: [f64; 2], least: f64) -> [f64; 2] {
    let widen = 0.5 * (least - (leading - trailing)).max(0.0);
    [leading + widen, trailing - widen]
}
