//! The downstrokes of the wings, to be shaded.

use wingbeat_flight::FlightSetup;

use crate::figures::over_time::strokes::{downstrokes, reference_wing};

/// More downstrokes than this are not shaded: they could not be told apart.
const MAX_SHADED: usize = 80;

/// Intervals of the downstrokes, wing by wing; the wing of reference is the last one that has any.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Shades {
    wings: Vec<Vec<[f64; 2]>>,
    /// How far ends may be apart that are the same: a step of the history.
    step: f64,
}

impl Shades {
    /// Of the stroke angles of all wings at the abscissas `x`.
    pub fn new(strokes: &[Vec<f64>], x: &[f64]) -> Self {
        let span = x.last().unwrap_or(&0.0) - x.first().unwrap_or(&0.0);
        Self {
            wings: strokes.iter().map(|s| downstrokes(s, x)).collect(),
            step: 1.5 * span / x.len().saturating_sub(1).max(1) as f64,
        }
    }

    /// What is shaded where nothing says of which wing.
    pub fn of_chart(&self) -> Vec<[f64; 2]> {
        few(self.reference())
    }

    /// What is shaded for wing number `k`, if that is not what is shaded for the wing of reference.
    pub fn own(&self, k: usize) -> Option<Vec<[f64; 2]>> {
        let wing = self.wings.get(k)?;
        (!self.is_as_reference(wing)).then(|| few(wing))
    }

    /// Whether wings that beat do so otherwise than the wing of reference.
    pub fn differ(&self) -> bool {
        let beating = self.wings.iter().filter(|w| !w.is_empty());
        beating.into_iter().any(|w| !self.is_as_reference(w))
    }

    /// What a title says of the shading: of which wing it is, where others beat otherwise and not `each` panel
    /// has its own.
    pub fn words(&self, setup: &FlightSetup, each: bool) -> String {
        match reference_wing(setup) {
            Some((wing, _)) if self.differ() && !each => {
                format!(" (downstroke of {} shaded)", wing.replace('_', " "))
            }
            _ => " (downstroke shaded)".to_owned(),
        }
    }

    fn reference(&self) -> &[[f64; 2]] {
        let beating = self.wings.iter().rev().find(|w| !w.is_empty());
        beating.map_or(&[], |w| w)
    }

    fn is_as_reference(&self, wing: &[[f64; 2]]) -> bool {
        let reference = self.reference();
        let near = |a: &[f64; 2], b: &[f64; 2]| (0..2).all(|c| (a[c] - b[c]).abs() <= self.step);
        wing.len() == reference.len() && wing.iter().zip(reference).all(|(a, b)| near(a, b))
    }
}

fn few(list: &[[f64; 2]]) -> Vec<[f64; 2]> {
    match list.len() > MAX_SHADED {
        true => vec![],
        false => list.to_vec(),
    }
}
