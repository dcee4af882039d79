//! What a glide is measured by: its angle, its ratio of lift to drag, the power that its height pays.

use wingbeat_math::DVec3;

use crate::AnalysisError;
use crate::beat::glide::glides;
use crate::trim::Trim;

/// A steady flight in which nothing beats: weight and air balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glide {
    /// Speed through the air [m/s].
    pub airspeed: f64,
    /// Angle by which its way through the air points below the level \[rad\].
    pub angle: f64,
    /// Level way over height lost, which is lift over drag where the air is at rest or moves steadily \[1\].
    pub ratio: f64,
    /// Rate at which its weight loses height, in the air, times that weight \[W\].
    pub power: f64,
}

impl Glide {
    /// That of a flyer of `mass` \[kg\] that moves with the velocity `through` the air [m/s] under `gravity` [m/s2], N
    /// components.
    pub(crate) fn of(mass: f64, through: DVec3, gravity: DVec3) -> Self {
        let down = gravity.normalize();
        let sink = through.dot(down);
        let level = (through - sink * down).length();
        Self {
            airspeed: through.length(),
            angle: sink.atan2(level),
            ratio: level / sink,
            power: mass * gravity.length() * sink,
        }
    }
}

impl Trim {
    /// The glide, where nothing of the flyer beats.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn glide(&self) -> Result<Option<Glide>, AnalysisError> {
        if !glides(&self.setup) {
            return Ok(None);
        }
        let through = self.mean_velocity()? - self.beat.stream();
        let (mass, gravity) = (self.beat.mass(), self.beat.gravity());
        Ok(Some(Glide::of(mass, through, gravity)))
    }
}
