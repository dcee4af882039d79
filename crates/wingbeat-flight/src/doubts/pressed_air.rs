//! Gusts that blow along the way of their front, past bodies.
//!
//! The velocity `a f(t - s.x)` has the divergence `-a.s f'`: where the amplitude a has a part along the way s of the front,
//! the air is pressed together and apart. Wings feel the velocity alone; a closed surface cannot keep out what flows
//! into it from all sides. The force on a spheroid of 2:1 in a one-minus-cosine gust along its axis is a tenth smaller
//! than with the front across.

use wingbeat_air::{Gust, GustShape};
use wingbeat_math::largest;

use crate::setup::FlightSetup;

/// Part of a gust by which its velocity along the front may differ between the ends of the body \[1\].
const FELT: f64 = 0.05;

impl FlightSetup {
    /// Says which gusts blow along the way of their front past bodies in the lattice that are not small beside them.
    pub fn gusts_that_press_air(&self) -> Vec<String> {
        let has_bodies = self.air.lattice().is_some_and(|air| air.body_surfaces)
            && !self.animal.solids().is_empty();
        let Some(wind) = self.air.wind().filter(|_| has_bodies) else {
            return vec![];
        };
        let length = self.animal.body_length();
        let say = |(k, g): (usize, &Gust)| {
            let along = g.amplitude.normalize_or_zero().dot(g.slowness).abs();
            let apart = length * along * steepness(&g.shape);
            (apart > FELT).then(|| {
                format!(
                    "air.gust[{k}] blows along the way of its front (front_m_s), and differs by up to {:.0} % of itself between \
                     the ends of the body: such air is pressed together and apart, and flows through its surface; let the \
                     front go across the gust, leave front_m_s out, or leave the body out of the lattice (air.body = false)",
                    100.0 * apart.min(1.0)
                )
            })
        };
        wind.gusts.iter().enumerate().filter_map(say).collect()
    }
}

/// Fastest change of the share of a gust in its own time [1/s]; of turbulence over its time scale.
fn steepness(shape: &GustShape) -> f64 {
    match shape {
        GustShape::OneMinusCosine { duration } => std::f64::consts::PI / duration,
        GustShape::Turbulence(t) => 1.0 / t.time_scale,
        GustShape::Table(rows) => {
            let slope = |w: &[(f64, f64)]| (w[1].1 - w[0].1).abs() / (w[1].0 - w[0].0);
            largest(rows.windows(2).map(slope))
        }
    }
}
