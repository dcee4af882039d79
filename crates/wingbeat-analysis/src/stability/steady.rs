//! The steady flight that an averaged model is about.

use std::borrow::Cow;

use wingbeat_math::{DMat3, DVec3};

use crate::AnalysisError;
use crate::beat::Beat;
use crate::beat::level::Level;
use crate::stability::reference;
use crate::trim::Trim;

/// The flyer of a trimmed flight in its mean attitude, at its mean velocity.
#[derive(Clone, Debug)]
pub struct SteadyFlight<'a> {
    /// A beat that has its mass properties and weights.
    pub(crate) beat: Cow<'a, Beat>,
    /// Mean attitude, root to N.
    pub attitude: DMat3,
    pub(crate) level: Level,
    /// Mean velocity through the air, level frame [m/s].
    pub(crate) through: DVec3,
}

impl<'a> SteadyFlight<'a> {
    /// That of a flight trimmed in air without memory.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn of(trim: &'a Trim) -> Result<Self, AnalysisError> {
        let (level, steady) = reference(&trim.beat, &trim.state)?;
        Ok(Self {
            attitude: trim.beat.mean_attitude(&trim.state)?,
            through: steady.velocity - level.to_n.transpose() * trim.beat.stream(),
            level,
            beat: Cow::Borrowed(&trim.beat),
        })
    }

    /// A beat that has its mass properties and weights.
    pub fn beat(&self) -> &Beat {
        &self.beat
    }
}
