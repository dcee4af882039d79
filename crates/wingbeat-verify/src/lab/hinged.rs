//! One wing on a fixed mount whose pitch a hinge leaves open.

use std::path::Path;

use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;

use crate::row::VerifyError;

/// The air around it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Air {
    /// Blade elements.
    Blade,
    /// Vortex lattice with wakes from all edges.
    Lattice,
}

/// A flight of the wing.
pub(crate) struct Flown {
    /// Pitch at all steps [deg].
    pitch: Vec<f64>,
    per_beat: usize,
}

impl Flown {
    /// Flies the case of this text with these keys changed.
    pub fn new(name: &str, text: &str, base: &Path, set: &[String]) -> Result<Self, VerifyError> {
        let case = LoadedCase::from_text(name, text, base, set)?;
        let time = case.setup.time;
        let per_beat = time.steps_per_beat().unwrap_or(1);
        let mut flight = Simulation::new(case.setup)?;
        // Where no hinge leaves it open, pitch is the third of the prescribed angles.
        let angle = |f: &Simulation| {
            let free = f.record().joints.first().map(|j| j[0]);
            free.unwrap_or(f.record().wing_angles[0].z).to_degrees()
        };
        let mut pitch = vec![angle(&flight)];
        while !flight.finished() {
            flight.step()?;
            pitch.push(angle(&flight));
        }
        Ok(Self { pitch, per_beat })
    }

    /// Pitch over the last beat [deg], both its ends.
    pub fn last_beat(&self) -> Vec<f64> {
        self.pitch[self.pitch.len() - 1 - self.per_beat..].to_vec()
    }
}

impl Air {
    /// That of the robots, in the words of a case.
    pub fn robobee(self) -> &'static str {
        match self {
            Self::Blade => {
                "\n[air]\nmodel = \"blade_element\"\ndensity_kg_m3 = 1.225\n\
                 [air.blade]\ncoefficients = \"whitney-wood-2010\"\ncentre_of_pressure = \"chen2016\"\n"
            }
            Self::Lattice => {
                "\n[air]\nmodel = \"vortex_lattice\"\ndensity_kg_m3 = 1.225\nbody = false\n\
                 clearance_m = 3.2e-4\n\
                 [air.bound_core.algebraic]\nradius_m = 3.2e-5\nviscosity_m2_s = 1.5e-5\n\
                 [air.wake_core.algebraic]\nradius_m = 2.24e-4\nviscosity_m2_s = 1.5e-5\n"
            }
        }
    }

    /// That of the fruit fly.
    pub fn fruit_fly(self) -> &'static str {
        match self {
            Self::Blade => "\n[air]\nmodel = \"blade_element\"\ndensity_kg_m3 = 1.225\n",
            Self::Lattice => {
                "\n[air]\nmodel = \"vortex_lattice\"\ndensity_kg_m3 = 1.225\nbody = false\n\
                 clearance_m = 7e-5\n\
                 [air.bound_core.algebraic]\nradius_m = 7e-6\nviscosity_m2_s = 1.5e-5\n\
                 [air.wake_core.algebraic]\nradius_m = 5e-5\nviscosity_m2_s = 1.5e-5\n"
            }
        }
    }
}
