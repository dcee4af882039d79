//! How many modes of the wings Floquet's modes need: what changes where one fewer is taken along.
//!
//! The map of a wingbeat without the last mode of every wing is that map without its rows and columns: the mode is neither disturbed nor
//! looked at. So the check costs an eigenproblem and no flight.

use super::wings::{BODY, ElasticMonodromy};
use crate::AnalysisError;
use crate::eigen::eigen;

impl ElasticMonodromy {
    /// The map of departures without the last mode of every wing: what it would be had one mode fewer been taken along. None where no
    /// wing has any.
    pub fn with_fewer_modes(&self) -> Option<Self> {
        let mut kept: Vec<usize> = (0..BODY).collect();
        let mut from = BODY;
        for &count in &self.wings {
            let last = count.checked_sub(1)?;
            let own = (0..2 * count).filter(|k| k % count != last);
            kept.extend(own.map(|k| from + k));
            from += 2 * count;
        }
        kept.extend(from..self.order);
        let of = |i: usize| kept.iter().map(move |k| (i, *k));
        let entries = kept.iter().flat_map(|i| of(*i));
        let fewer = Self {
            matrix: entries
                .map(|(i, k)| self.matrix[self.order * i + k])
                .collect(),
            order: kept.len(),
            wakes: self.wakes,
            wings: self.wings.iter().map(|n| n - 1).collect(),
            scales: self.scales,
        };
        (fewer.order < self.order).then_some(fewer)
    }
}

/// Multipliers over which motions count as those of flight: what decays faster is over within two wingbeats \[1\].
const LASTING: f64 = 0.5;

/// How far Floquet's multipliers of the motions that last move where one mode fewer of each wing is taken along: the largest distance of
/// one of these to the nearest of those \[1\]. None where there is no mode to leave out.
///
/// # Errors
/// Numbers that are not finite.
pub fn change_by_last_mode(map: &ElasticMonodromy) -> Result<Option<f64>, AnalysisError> {
    let Some(fewer) = map.with_fewer_modes() else {
        return Ok(None);
    };
    let values = |map: &ElasticMonodromy| -> Result<Vec<[f64; 2]>, AnalysisError> {
        Ok(eigen(&map.matrix, map.order)?
            .iter()
            .map(|p| p.value)
            .collect())
    };
    let (all, others) = (values(map)?, values(&fewer)?);
    let lasting = all.iter().filter(|v| v[0].hypot(v[1]) > LASTING);
    let nearest = |v: &[f64; 2]| {
        let apart = others.iter().map(|w| (v[0] - w[0]).hypot(v[1] - w[1]));
        apart.fold(f64::INFINITY, f64::min)
    };
    Ok(Some(lasting.map(nearest).fold(0.0, f64::max)))
}
