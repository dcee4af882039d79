//! Scratch room of the equations of motion.

use crate::euler::EulerScratch;
use crate::free::FreeScratch;
use crate::mechanism::form::AbsoluteScratch;
use crate::posture::Posture;
use crate::{BodyAcceleration, BodyMotion, DynamicsError, System, Wrench};

/// Intermediate results, kept between calls so that nothing is allocated. Holds no state: any
/// workspace of the same system serves any call.
#[derive(Clone, Debug)]
pub struct Workspace {
    pub(crate) posture: Posture,
    pub(crate) motions: Vec<BodyMotion>,
    pub(crate) demand: Vec<Wrench>,
    pub(crate) euler: EulerScratch,
    pub(crate) free: FreeScratch,
    pub(crate) bias: Vec<BodyAcceleration>,
    pub(crate) absolute: Option<AbsoluteScratch>,
}

impl Workspace {
    /// Room for `system`.
    pub fn new(system: &System) -> Self {
        let bodies = system.bodies().len();
        Self {
            posture: Posture::new(system),
            motions: vec![BodyMotion::REST; bodies],
            demand: vec![Wrench::default(); bodies],
            euler: EulerScratch::new(system),
            free: FreeScratch::new(system),
            bias: vec![BodyAcceleration::default(); bodies],
            absolute: None,
        }
    }
}

/// An error if a component of the state is not finite.
pub(crate) fn check_finite(time: f64, y: &[f64]) -> Result<(), DynamicsError> {
    match y.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(component) => Err(DynamicsError::NotFinite {
            time,
            component,
            value: y[component],
        }),
    }
}
