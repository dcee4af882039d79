//! Gusts that blow along their front, past bodies.
//!
//! The velocity `a f(t - s.x)` has the divergence `-a.s f'`: where the amplitude a has a part along the way s of the front,
//! the air is pressed together and apart. Wings feel the velocity alone; a closed surface cannot keep out what flows
//! into it from all sides. The force on a spheroid of 2:1 in a one-minus-cosine gust along its axis is a tenth smaller
//! than with the front across.

use wingbeat_air::Gust;

use crate::setup::FlightSetup;

/// Cosine of the angle between gust and front that is rounding \[1\].
const ROUNDING: f64 = 1e-6;

impl FlightSetup {
    /// Says which gusts blow along the way of their front while bodies are in the lattice.
    pub fn gusts_that_press_air(&self) -> Vec<String> {
        let has_bodies = self.air.lattice().is_some_and(|air| air.body_surfaces)
            && !self.animal.solids().is_empty();
        let Some(wind) = self.air.wind().filter(|_| has_bodies) else {
            return vec![];
        };
        let say = |(k, g): (usize, &Gust)| {
            let along = g.amplitude.dot(g.slowness).abs();
            (along > ROUNDING * g.amplitude.length() * g.slowness.length()).then(|| {
                format!(
                    "air.gust[{k}] blows along the way of its front (front_m_s): such air is pressed together and apart, and \
                     a body in it has a net flow through its surface; let the front go across the gust, leave front_m_s \
                     out, or leave the body out of the lattice (air.body = false)"
                )
            })
        };
        wind.gusts.iter().enumerate().filter_map(say).collect()
    }
}
