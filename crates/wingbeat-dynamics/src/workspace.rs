//! Scratch room of the equations of motion.

use crate::posture::Posture;
use crate::{BodyMotion, System};

/// Intermediate results, kept between calls so that nothing is allocated. Holds no state: any
/// workspace of the same system serves any call.
#[derive(Clone, Debug)]
pub struct Workspace {
    pub(crate) posture: Posture,
    pub(crate) motions: Vec<BodyMotion>,
}

impl Workspace {
    /// Room for `system`.
    pub fn new(system: &System) -> Self {
        Self {
            posture: Posture::new(system),
            motions: vec![BodyMotion::REST; system.bodies().len()],
        }
    }
}
