//! How many modes of the wings Floquet's modes need: what changes where one fewer is taken along.
//!
//! With one mode of every wing fewer, the last is neither disturbed nor looked at: its columns and rows of the
//! flown departures are left out before the map is made of them. So the check costs an eigenproblem and no
//! flight.

use super::differences::map_between;
use super::wings::{BODY, ElasticMonodromy};
use crate::AnalysisError;
use crate::stability::eigen::eigen;

impl ElasticMonodromy {
    /// The map of departures that one mode fewer of every wing gives. None where some wing has none.
    ///
    /// # Errors
    /// Departures that depend on each other.
    pub fn with_fewer_modes(&self) -> Result<Option<Self>, AnalysisError> {
        if self.wings.is_empty() || self.wings.contains(&0) {
            return Ok(None);
        }
        let mut kept: Vec<usize> = (0..BODY).collect();
        let mut from = BODY;
        for &count in &self.wings {
            let own = (0..2 * count).filter(|k| k % count != count - 1);
            kept.extend(own.map(|k| from + k));
            from += 2 * count;
        }
        kept.extend(from..self.order);
        let of = |i: usize| kept.iter().map(move |k| (i, *k));
        let part = |all: &Vec<f64>| -> Vec<f64> {
            let entries = kept.iter().flat_map(|i| of(*i));
            entries.map(|(i, k)| all[self.order * i + k]).collect()
        };
        let departures = self.departures.each_ref().map(part);
        Ok(Some(Self {
            matrix: map_between(&departures, kept.len())?,
            departures,
            order: kept.len(),
            wakes: self.wakes,
            wings: self.wings.iter().map(|n| n - 1).collect(),
            period: self.period,
        }))
    }
}

/// Multipliers over which motions count as those of flight: what decays faster has lost three quarters after
/// two wingbeats \[1\].
const LASTING: f64 = 0.5;

/// How far Floquet's multipliers of the motions that last move where one mode fewer of each wing is taken
/// along: the largest distance of one of these to the nearest of those \[1\]. None where some wing has no mode
/// to leave out.
///
/// # Errors
/// Numbers that are not finite; departures that depend on each other.
pub fn change_by_last_mode(map: &ElasticMonodromy) -> Result<Option<f64>, AnalysisError> {
    let Some(fewer) = map.with_fewer_modes()? else {
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
