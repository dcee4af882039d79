//! Where the impulse of the vorticity comes from, and where it goes.

use wingbeat_math::DVec3;

/// The impulse account of all vorticity since the air was at rest. What is there is
/// `created + moved + converted - cut - absorbed`; what [`crate::AirLoads::impulse`] counts, dropped wakes included, is
/// `created + moved + converted`.
///
/// Wakes that carry no force change their impulse only by what they do to the surfaces and these to them: the rate of
/// created and moved together is the inviscid force on all surfaces, reversed.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ImpulseAccount {
    /// Made by surfaces, by circulation that changes, by their motion and by what they shed, less the momentum of the
    /// fictitious fluid in closed ones [kg m/s], N components.
    pub created: DVec3,
    /// Gained by free wakes as they move and as their particles are stretched [kg m/s], N components.
    pub moved: DVec3,
    /// Gained where rings became particles, nothing but roundings [kg m/s], N components.
    pub converted: DVec3,
    /// What wakes had when they were dropped [kg m/s], N components.
    pub cut: DVec3,
    /// What surfaces and planes in the way took from wakes that they held back [kg m/s], N components.
    pub absorbed: DVec3,
}

impl ImpulseAccount {
    /// Impulse of the vorticity that is no longer there [kg m/s], N components.
    pub fn dropped(&self) -> DVec3 {
        self.cut + self.absorbed
    }
}

impl std::ops::AddAssign for ImpulseAccount {
    fn add_assign(&mut self, other: Self) {
        self.created += other.created;
        self.moved += other.moved;
        self.converted += other.converted;
        self.cut += other.cut;
        self.absorbed += other.absorbed;
    }
}
