//! Scratch of the Euler form.

use super::assembly::kinematics;
use super::condensed::Condensed;
use super::constraint::HingeKinematics;
use super::coordinates::{BodyKinematics, COORDINATES};
use crate::system::System;

/// Scratch of the Euler form.
#[derive(Clone, Debug)]
pub(crate) struct EulerScratch {
    pub bodies: Vec<BodyKinematics>,
    pub hinges: Vec<HingeKinematics>,
    pub condensed: Condensed,
}

impl EulerScratch {
    pub(crate) fn new(system: &System) -> Self {
        let zero = vec![0.0; COORDINATES * system.bodies().len()];
        let (bodies, hinges) = kinematics(system, 0.0, &zero, &zero);
        Self {
            bodies,
            hinges,
            condensed: Condensed::new(system),
        }
    }
}
