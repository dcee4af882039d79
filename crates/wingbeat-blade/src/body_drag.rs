//! Drag of a slender body by its components along and across the body's axis.

use wingbeat_math::DVec3;

use crate::error::{BladeError, require};

/// `F = -1/2 rho S abs(V) (C_along V_along + C_across V_across)` at a point of the body that moves with V
/// through the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyDrag {
    /// Reference area S [m2].
    pub area: f64,
    /// Coefficient along the body axis b1 \[1\].
    pub along: f64,
    /// Coefficient across it \[1\].
    pub across: f64,
    /// Where it acts, body components from the body's origin \[m\]; none leaves the point to whoever knows the body.
    pub centre: Option<DVec3>,
}

impl BodyDrag {
    /// The force \[N\], body components, on a body whose point moves through air of `density` [kg/m3] with
    /// `velocity` [m/s], body components.
    pub fn force(&self, density: f64, velocity: DVec3) -> DVec3 {
        let c = DVec3::new(self.along, self.across, self.across);
        -0.5 * density * self.area * velocity.length() * (c * velocity)
    }

    /// Checks every number.
    ///
    /// # Errors
    /// [`BladeError::Value`] names the first below 0, or a point that is not finite.
    pub fn check(&self) -> Result<(), BladeError> {
        let ok = |x: f64| x.is_finite() && x >= 0.0;
        let number = "a finite number >= 0";
        require(ok(self.area), "body_drag.area", self.area, number)?;
        require(ok(self.along), "body_drag.along", self.along, number)?;
        require(ok(self.across), "body_drag.across", self.across, number)?;
        let far = self.centre.map_or(0.0, DVec3::length);
        let place = "a finite place";
        require(far.is_finite(), "body_drag.centre", far, place)
    }
}
