//! The dynamic pressure of the undisturbed air past the wings: what forces are divided by for mean coefficients.

use wingbeat_air::Wind;
use wingbeat_dynamics::BodyMotion;
use wingbeat_math::DVec3;

use crate::air::strips;
use crate::setup::FlightSetup;

/// The wings as strips, and the air that they move through.
///
/// Each strip has the velocity of its point on the feathering axis: what a wing does about that axis is no part of it,
/// and neither are bending and deformation. The mean coefficients of hovering wings are made with this speed
/// [Ellington 1984, Phil. Trans. R. Soc. B 305:145].
#[derive(Clone, Debug, Default)]
pub struct DynamicPressure {
    density: f64,
    stream: DVec3,
    wind: Wind,
    /// Strips of all wings; none where the density of the air is not known.
    strips: Vec<PressureStrip>,
}

/// A strip of a wing.
#[derive(Clone, Copy, Debug)]
struct PressureStrip {
    /// Number of its body.
    body: usize,
    /// Its point on the feathering axis \[m\], wing frame.
    axis: DVec3,
    /// Its area [m2].
    area: f64,
}

impl DynamicPressure {
    /// Of the wings of a flight; without strips in a vacuum and in air whose model tells no density.
    pub fn of(setup: &FlightSetup) -> Self {
        let (Some(density), Some(stream), Some(wind)) =
            (setup.air.density(), setup.air.stream(), setup.air.wind())
        else {
            return Self::default();
        };
        let wings = setup.animal.wings.iter().enumerate();
        let of_wing = wings.flat_map(|(i, wing)| {
            strips(wing).into_iter().map(move |s| PressureStrip {
                body: i + 1,
                axis: s.axis,
                area: s.strip.chord * s.strip.width,
            })
        });
        Self {
            density,
            stream,
            wind: wind.clone(),
            strips: of_wing.collect(),
        }
    }

    /// Force \[N\] that wings whose bodies move like `motions` would feel at a coefficient of one at time `t` \[s\]:
    /// `1/2 rho int U^2 dA` over all wings.
    pub fn force(&self, t: f64, motions: &[BodyMotion]) -> f64 {
        let of_strip = |s: &PressureStrip| {
            let m = &motions[s.body];
            let air = self.stream + self.wind.at(m.point(s.axis), t);
            s.area * (m.point_velocity(s.axis) - air).length_squared()
        };
        0.5 * self.density * self.strips.iter().map(of_strip).sum::<f64>()
    }
}
