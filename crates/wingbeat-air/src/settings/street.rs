//! A von Karman vortex street, smooth and without end.

use std::f64::consts::TAU;

use crate::error::{AirError, is_positive, require};
use wingbeat_math::DVec3;

/// Two rows of vortices of opposite sense, a half spacing apart along each other, that travel as they are: the
/// wake of a bluff body, or of an animal ahead.
///
/// Each row is Stuart's, with vortices of finite size; towards `concentration` 1 they become points [Stuart 1967, J.
/// Fluid Mech. 29:417; von Karman 1911].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VortexStreet {
    /// Circulation of a vortex [m2/s]. Positive: between the rows the air goes against the drift.
    pub circulation: f64,
    /// From vortex to vortex of a row [m].
    pub spacing: f64,
    /// From row to row [m].
    pub width: f64,
    /// How concentrated the vortices are \[1\], above 0 and below 1.
    pub concentration: f64,
    /// Velocity with which the street travels along its rows [m/s], N components.
    pub drift: DVec3,
    /// Axis of the vortices, N components \[1\].
    pub axis: DVec3,
    /// A point midway between the rows at time 0, abreast of a vortex of the row towards `axis x drift` [m], N
    /// components.
    pub point: DVec3,
}

/// Width over spacing at which a street of point vortices is not unstable at first order [von Karman 1911].
pub const NEUTRAL_WIDTH: f64 = 0.280_549_928;

impl VortexStreet {
    /// Velocity [m/s] at `x` [m] and time `t` [s], N components.
    pub fn at(&self, x: DVec3, t: f64) -> DVec3 {
        let along = self.drift.normalize();
        let across = self.axis.normalize().cross(along);
        let r = x - self.point - t * self.drift;
        let (x, y) = (r.dot(along), r.dot(across));
        let [u, v] = self.row(x, y - 0.5 * self.width);
        let [p, q] = self.row(x + 0.5 * self.spacing, y + 0.5 * self.width);
        // The row ahead of `across` turns from `across` to `along`, the other one back.
        (p - u) * along + (q - v) * across
    }

    /// Velocity along and across a row of vortices that turn from `along` to `across`, one at the origin.
    fn row(&self, x: f64, y: f64) -> [f64; 2] {
        let wave = TAU / self.spacing;
        // Beyond this the row is a step of velocity to the last digit, and cosh overflows later.
        let y = (wave * y).clamp(-40.0, 40.0);
        let (sin, cos) = (wave * x).sin_cos();
        let c = self.concentration;
        let below = y.cosh() - c * cos;
        let half = 0.5 * self.circulation / self.spacing;
        [-half * y.sinh() / below, half * c * sin / below]
    }

    /// Rate [m/s2] of that velocity at a point that is at `x` [m] and moves with `v` [m/s] at time `t` [s], N
    /// components.
    pub fn rate(&self, x: DVec3, v: DVec3, t: f64) -> DVec3 {
        let along = self.drift.normalize();
        let across = self.axis.normalize().cross(along);
        let r = x - self.point - t * self.drift;
        let (x, y) = (r.dot(along), r.dot(across));
        // The street stands still in its own frame.
        let through = v - self.drift;
        let (dx, dy) = (through.dot(along), through.dot(across));
        let [[ux, uy], [vx, vy]] = self.row_slopes(x, y - 0.5 * self.width);
        let [[px, py], [qx, qy]] = self.row_slopes(x + 0.5 * self.spacing, y + 0.5 * self.width);
        let (u, v) = (
            (px - ux) * dx + (py - uy) * dy,
            (qx - vx) * dx + (qy - vy) * dy,
        );
        u * along + v * across
    }

    /// Slopes of the two velocities of [`Self::row`] along and across it [1/s].
    fn row_slopes(&self, x: f64, y: f64) -> [[f64; 2]; 2] {
        let wave = TAU / self.spacing;
        let y = (wave * y).clamp(-40.0, 40.0);
        let (sin, cos) = (wave * x).sin_cos();
        let (sinh, cosh) = (y.sinh(), y.cosh());
        let c = self.concentration;
        let below = cosh - c * cos;
        let size = 0.5 * self.circulation / self.spacing * wave / (below * below);
        let shear = size * c * sinh * sin;
        [
            [shear, -size * (1.0 - c * cos * cosh)],
            [size * c * (cos * cosh - c), -shear],
        ]
    }

    /// # Errors
    /// [`AirError::Setting`] names the first number that makes no sense.
    pub(crate) fn validate(&self) -> Result<(), AirError> {
        require(
            self.circulation.is_finite(),
            "vortex street circulation",
            self.circulation,
            "a finite number in m2/s",
        )?;
        require(
            is_positive(self.spacing) && is_positive(self.width),
            "vortex street spacing",
            format!("{}, width {}", self.spacing, self.width),
            "lengths in m above 0",
        )?;
        let c = self.concentration;
        require(
            c > 0.0 && c < 1.0,
            "vortex street concentration",
            c,
            "a number above 0 and below 1",
        )?;
        let (drift, axis) = (self.drift, self.axis);
        let is_square = drift.dot(axis).abs() <= 1e-9 * drift.length() * axis.length();
        require(
            drift.is_finite() && axis.is_finite() && drift.length() > 0.0 && axis.length() > 0.0,
            "vortex street drift",
            format!("{drift}, axis {axis}"),
            "a velocity in m/s and an axis, both finite and not 0",
        )?;
        require(
            is_square,
            "vortex street axis",
            format!("{axis}, drift {drift}"),
            "an axis square to the drift",
        )?;
        require(
            self.point.is_finite(),
            "vortex street point",
            self.point,
            "a place in m, finite",
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn street(concentration: f64) -> VortexStreet {
        VortexStreet {
            circulation: 0.3,
            spacing: 0.2,
            width: NEUTRAL_WIDTH * 0.2,
            concentration,
            drift: DVec3::new(0.0, 0.0, -1.5),
            axis: DVec3::new(0.0, 2.0, 0.0),
            point: DVec3::new(0.1, 0.0, 0.3),
        }
    }

    #[test]
    fn exact_a_street_of_points_is_the_sum_of_its_vortices() {
        // Second method: 40,001 point vortices a row one by one; what is left out is the far ends, 1e-5 of the
        // velocity.
        let s = street(1.0 - 1e-12);
        let along = s.drift.normalize();
        let across = s.axis.normalize().cross(along);
        let (x, t) = (DVec3::new(0.13, 0.7, 0.21), 0.05);
        let r = x - s.point - t * s.drift;
        let mut sum = DVec3::ZERO;
        for (sense, shift, side) in [(-1.0, 0.0, 0.5), (1.0, -0.5, -0.5)] {
            for k in -20_000..=20_000 {
                let place = (f64::from(k) + shift) * s.spacing;
                let (dx, dy) = (r.dot(along) - place, r.dot(across) - side * s.width);
                let swirl = sense * s.circulation / (TAU * (dx * dx + dy * dy));
                sum += swirl * (dx * across - dy * along);
            }
        }
        let v = s.at(x, t);
        assert!((v - sum).length() < 1e-4 * v.length(), "{v} {sum}");
    }

    #[test]
    fn exact_smooth_streets_hold_the_circulation_and_no_sources() {
        let s = street(0.7);
        // Around a vortex of the first row, half way to its neighbours and to the middle and as far outside.
        let (a, h) = (0.5 * s.spacing, 6.0 * s.spacing);
        let (along, across) = (-DVec3::Z, DVec3::Y.cross(-DVec3::Z));
        let n = 4000;
        let line = |from: DVec3, to: DVec3| -> f64 {
            let at = |k: usize| from.lerp(to, (k as f64 + 0.5) / n as f64);
            let part = (to - from) / n as f64;
            (0..n).map(|k| s.at(at(k), 0.0).dot(part)).sum()
        };
        let corner = |x: f64, y: f64| s.point + x * along + y * across;
        // A period of both rows: their circulations cancel. Of the row ahead: its own.
        let whole = [(-a, -h), (a, -h), (a, h), (-a, h)].map(|(x, y)| corner(x, y));
        let around = |c: [DVec3; 4]| -> f64 { (0..4).map(|k| line(c[k], c[(k + 1) % 4])).sum() };
        assert!(around(whole).abs() < 1e-9 * s.circulation);
        let one = |x: f64, y: f64| s.row(x, y);
        let top: f64 = (0..n)
            .map(|k| (k as f64 + 0.5) / n as f64 * s.spacing)
            .map(|x| (one(x, -h)[0] - one(x, h)[0]) * s.spacing / n as f64)
            .sum();
        assert!((top / s.circulation - 1.0).abs() < 1e-9, "{top}");
        // Divergence by central differences of 1e-5 of the spacing, over the shear.
        let (x, d) = (corner(0.03, 0.04), 1e-5 * s.spacing);
        let slope = |e: DVec3| (s.at(x + d * e, 0.0) - s.at(x - d * e, 0.0)) / (2.0 * d);
        let divergence = slope(along).dot(along) + slope(across).dot(across);
        assert!(
            divergence.abs() < 1e-6 * slope(across).length(),
            "{divergence}"
        );
    }

    #[test]
    fn refuses_streets_by_what_is_wrong_with_them() {
        let point = VortexStreet {
            point: DVec3::new(0.0, f64::NAN, 0.0),
            ..street(0.7)
        };
        let axis = VortexStreet {
            axis: DVec3::new(0.0, 1.0, 0.1),
            ..street(0.7)
        };
        for (street, key) in [(point, "point"), (axis, "axis")] {
            let error = street.validate().map_err(|e| e.to_string());
            let error = error.map_or_else(|e| e, |()| "none".to_owned());
            assert!(error.contains(&format!("vortex street {key}")), "{error}");
        }
    }

    #[test]
    fn behaves_a_wake_street_holds_back_between_its_rows_and_travels() {
        let s = street(0.9);
        let middle = s.at(s.point, 0.0);
        assert!(middle.dot(s.drift) < 0.0, "{middle}");
        let (x, t) = (DVec3::new(0.0, 0.4, 0.1), 0.07);
        let gone = (s.at(x + t * s.drift, t) - s.at(x, 0.0)).length();
        assert!(gone < 1e-12, "{gone}");
    }
}
