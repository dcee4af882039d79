//! Mechanical power of flapping: aerodynamic, inertial, and what the muscles pay.

use wingbeat_flight::{AirModel, FlightSetup, Simulation};

use crate::AnalysisError;
use crate::progress;

/// Mean mechanical powers over one wingbeat [W] and over masses [W/kg].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Power {
    /// Mean of the power against the air, `sum over wings of the hinge power with air less that
    /// without`.
    pub aerodynamic: f64,
    /// Mean over the beat of the positive part of the inertial power.
    pub inertial_positive: f64,
    /// What muscles pay if springs return all negative power: the mean of the total, not less
    /// than 0.
    pub perfect_storage: f64,
    /// What they pay if negative power is lost: mean of the positive part, wing by wing.
    pub no_storage: f64,
    /// Largest total power of a step.
    pub peak: f64,
    /// Mass of the animal [kg].
    pub mass: f64,
}

impl Power {
    /// Power per body mass [W/kg].
    pub fn body_specific(&self, power: f64) -> f64 {
        power / self.mass
    }

    /// Power per mass of flight muscle [W/kg], `muscle` its part of the body mass.
    pub fn muscle_specific(&self, power: f64, muscle: f64) -> f64 {
        power / (muscle * self.mass)
    }
}

/// Powers over the last full wingbeat of the setup, which must be tethered: the same motion is
/// flown with and without air, and hinge moments of inertia, weight and air add up.
///
/// # Errors
/// A setup in free flight or shorter than a beat; what the flight reports.
pub fn power(setup: &FlightSetup) -> Result<Power, AnalysisError> {
    let period = setup.time.period.unwrap_or(0.0);
    let per_beat = (period / setup.time.step).round() as usize;
    let tethered = matches!(setup.mode, wingbeat_flight::MotionMode::Tethered(_));
    if per_beat == 0 || setup.time.steps < per_beat || !tethered {
        return Err(AnalysisError::not_covered(
            "power needs a tethered flight of at least one wingbeat",
            "tether the animal at its trimmed attitude",
        ));
    }
    progress::task("power with air", 0, 2);
    let with = hinge_powers(setup.clone(), per_beat)?;
    progress::task("power without air", 1, 2);
    let without = hinge_powers(
        FlightSetup {
            air: AirModel::None,
            ..setup.clone()
        },
        per_beat,
    )?;
    let n = with.len() as f64;
    let total = |p: &Vec<f64>| p.iter().sum::<f64>();
    let positive = |p: &Vec<f64>| p.iter().map(|x| x.max(0.0)).sum::<f64>();
    let mean =
        |list: &[Vec<f64>], f: &dyn Fn(&Vec<f64>) -> f64| list.iter().map(f).sum::<f64>() / n;
    Ok(Power {
        aerodynamic: mean(&with, &total) - mean(&without, &total),
        inertial_positive: mean(&without, &positive),
        perfect_storage: mean(&with, &total).max(0.0),
        no_storage: mean(&with, &positive),
        peak: with.iter().map(total).fold(0.0, f64::max),
        mass: setup.animal.mass(),
    })
}

/// Powers of hinge and deformation of every wing at every step of the last beat.
fn hinge_powers(setup: FlightSetup, per_beat: usize) -> Result<Vec<Vec<f64>>, AnalysisError> {
    let first = setup.time.steps - per_beat;
    let mut flight = Simulation::new(setup)?;
    let mut list = Vec::with_capacity(per_beat);
    while !flight.finished() {
        let record = flight.step()?;
        if record.step > first {
            let mut powers: Vec<f64> = record.hinges.iter().map(|h| h.power).collect();
            for (power, deforming) in powers.iter_mut().zip(&record.deformation_power) {
                *power += deforming;
            }
            list.push(powers);
        }
    }
    Ok(list)
}
