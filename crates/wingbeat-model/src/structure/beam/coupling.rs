//! Sections whose stretch, twist and bending are coupled: composite layups, axes off the tension centre.

use crate::deformation::SpanLaw;
use crate::error::ModelError;
use wingbeat_math::interpolate;

/// Off-diagonal stiffness of the sections along a beam: rows of r/R and six terms, straight lines between. Axes
/// of a section of a right wing: 1 outward along the beam, 2 in the plane towards the leading edge, 3 the upper
/// side; curvatures are the right-handed rates of turn about 2 (flap) and 3 (lag). A left wing is the mirror
/// image.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Coupling(pub Vec<(f64, [f64; 6])>);

/// Which two strains (stretch 0, twist 3, flap 4, lag 5) each term couples: stretch and twist, stretch and
/// flap, stretch and lag [N m]; twist and flap, twist and lag, flap and lag [N m2].
const PLACES: [[usize; 2]; 6] = [[0, 3], [0, 4], [0, 5], [3, 4], [3, 5], [4, 5]];

/// What stretch, shears, twist, flap and lag of a right wing are multiplied by to be those of its image on a
/// left wing, axis 3 of whose sections points to the lower side \[1\].
const MIRRORED: [f64; 6] = [1.0, 1.0, -1.0, -1.0, -1.0, 1.0];

impl Coupling {
    /// Terms at r/R.
    pub fn at(&self, r: f64) -> [f64; 6] {
        let rows = &self.0;
        let term = |k| interpolate(rows.len(), |j| (rows[j].0, rows[j].1[k]), r);
        match self.0.is_empty() {
            true => [0.0; 6],
            false => std::array::from_fn(term),
        }
    }

    /// Adds the terms at r/R to the stiffness of a section; `left` of a left wing.
    pub(super) fn add(&self, r: f64, left: bool, stiffness: &mut [[f64; 6]; 6]) {
        for ([i, j], term) in PLACES.into_iter().zip(self.at(r)) {
            let sign = if left { MIRRORED[i] * MIRRORED[j] } else { 1.0 };
            stiffness[i][j] += sign * term;
            stiffness[j][i] += sign * term;
        }
    }

    /// Of a beam `s` times as large of the same materials.
    pub(super) fn scaled(&self, s: f64) -> Self {
        let power = |k: usize| if k < 3 { 3 } else { 4 };
        let row = |row: &[f64; 6]| std::array::from_fn(|k| s.powi(power(k)) * row[k]);
        Self(self.0.iter().map(|(r, terms)| (*r, row(terms))).collect())
    }

    /// Checks the table `key` of a surface that begins at `root` = r/R.
    pub(super) fn check(&self, key: &str, root: f64) -> Result<(), ModelError> {
        if self.0.is_empty() {
            return Ok(());
        }
        for k in 0..6 {
            let rows = self.0.iter().map(|(r, row)| (*r, row[k])).collect();
            SpanLaw::Table(rows).check(key, root)?;
        }
        Ok(())
    }
}
