//! A flight of which one half of the air is computed keeps to the mirror, or ends.

use wingbeat_dynamics::{Formulation, MirrorSymmetry};

use crate::error::FlightError;

/// What may part a motion from its mirror image within a step, over the natural sizes of the state \[1\]:
/// rounding is less, and a load on one side is more.
const ROUNDING: f64 = 1e-9;

/// The mirror, and what rates are measured by.
#[derive(Clone, Debug)]
pub struct Mirrored {
    symmetry: MirrorSymmetry,
    /// Natural sizes of the state's components over the step \[unit of y / s\].
    sizes: Vec<f64>,
}

impl Mirrored {
    /// For the states of `core` in steps of `step` \[s\].
    pub fn new(symmetry: MirrorSymmetry, core: &dyn Formulation, step: f64) -> Self {
        let sizes = core.scales().iter().map(|s| s / step).collect();
        Self { symmetry, sizes }
    }

    /// Projects the rates `dy` of the state `y` of `core` at time `t` \[s\] onto mirror-symmetric motions. `before`
    /// is scratch.
    ///
    /// # Errors
    /// [`FlightError::Asymmetric`]: what is taken away is more than rounding.
    pub fn keep(
        &self,
        core: &dyn Formulation,
        (t, y): (f64, &[f64]),
        dy: &mut [f64],
        before: &mut Vec<f64>,
    ) -> Result<(), FlightError> {
        before.clear();
        before.extend_from_slice(dy);
        core.symmetrise(&self.symmetry, y, dy);
        let both = before.iter().zip(dy.iter()).zip(&self.sizes);
        let apart = both.map(|((a, b), size)| (a - b).abs() / size);
        let apart = apart.fold(0.0, f64::max);
        match apart > ROUNDING {
            true => Err(FlightError::Asymmetric { time: t, apart }),
            false => Ok(()),
        }
    }
}
