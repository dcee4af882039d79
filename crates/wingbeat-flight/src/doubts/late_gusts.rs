//! Gusts that a flight never meets.

use wingbeat_air::{Gust, GustShape};

use crate::setup::FlightSetup;

impl FlightSetup {
    /// Says which gusts of the wind begin, where the flight begins and where it would be at the end with the
    /// velocity of the start, only after the end of the flight, or are over before it begins there.
    pub fn gusts_that_never_arrive(&self) -> Vec<String> {
        let (Some(wind), root) = (self.air.wind(), self.root_at_start()) else {
            return vec![];
        };
        let end = self.time.steps as f64 * self.time.step;
        // The gust's own time as the flight begins and as it ends [s].
        let own = |g: &Gust| [0.0, end].map(|t| t - g.start - g.slowness.dot(root.p + root.v * t));
        let say = |(k, g): (usize, &Gust)| {
            let times = own(g);
            let first = first(&g.shape);
            if times.iter().all(|tau| *tau <= first) {
                let later = first - times[1];
                return Some(format!(
                    "air.gust[{k}] begins {later:.3} s after the end of the flight, which lasts {end:.3} s, and has no effect: let it begin earlier (start_s), or fly longer"
                ));
            }
            let over = last(&g.shape)?;
            times.iter().all(|tau| *tau >= over).then(|| {
                format!(
                    "air.gust[{k}] is over before the flight begins, and has no effect: let it begin later (start_s)"
                )
            })
        };
        wind.gusts.iter().enumerate().filter_map(say).collect()
    }
}

/// The gust's own time from which it blows no more [s]; none of one that blows on.
fn last(shape: &GustShape) -> Option<f64> {
    match shape {
        GustShape::OneMinusCosine { duration } => Some(*duration),
        GustShape::Table(rows) => rows.last().filter(|row| row.1 == 0.0).map(|row| row.0),
        GustShape::Turbulence(_) => None,
    }
}

/// The gust's own time from which it blows [s].
fn first(shape: &GustShape) -> f64 {
    match shape {
        GustShape::Table(rows) => rows.first().map_or(0.0, |row| row.0),
        GustShape::OneMinusCosine { .. } | GustShape::Turbulence(_) => 0.0,
    }
}
