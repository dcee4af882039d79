//! A flight of which one half of the air is computed keeps to the mirror, or ends.

use wingbeat_dynamics::{Formulation, MirrorSymmetry};
use wingbeat_math::largest;

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
        let apart = largest(apart);
        match apart <= ROUNDING {
            true => Ok(()),
            false => Err(FlightError::Asymmetric { time: t, apart }),
        }
    }
}

#[cfg(test)]
mod tests {
    use wingbeat_dynamics::{Body, BodyMotion, MomentumForm, NaturalUnits, System};
    use wingbeat_math::{DMat3, DVec3, EulerSequence, MassProperties};

    use super::*;

    #[test]
    fn refuses_rates_that_are_not_numbers() {
        let ball = Body {
            name: "ball".into(),
            mass: MassProperties::about_centre(1.0, DVec3::ZERO, DMat3::IDENTITY),
            sequence: EulerSequence::BODY_231,
        };
        let (length, time) = (1.0, 1.0);
        let units = NaturalUnits { length, time };
        let system = System::new(vec![ball], vec![], DVec3::ZERO, units).expect("a ball");
        let symmetry = MirrorSymmetry::new(&system, DVec3::Y, vec![]);
        let core = MomentumForm::new(system);
        let mirrored = Mirrored::new(symmetry, &core, 0.1);
        let y = core.initial(0.0, &BodyMotion::REST).expect("a state");
        let keep = |dy: &mut [f64]| mirrored.keep(&core, (0.0, &y), dy, &mut vec![]);
        assert!(keep(&mut vec![0.0; y.len()]).is_ok());
        for k in 0..y.len() {
            let mut dy = vec![0.0; y.len()];
            dy[k] = f64::NAN;
            let said = keep(&mut dy);
            assert!(
                matches!(said, Err(FlightError::Asymmetric { apart, .. }) if apart.is_nan()),
                "{k}"
            );
        }
    }
}
