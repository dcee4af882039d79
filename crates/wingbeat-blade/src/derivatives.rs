//! Air as a table of stability derivatives: loads on a rigid body, linear about a reference flight.
//!
//! ```text
//! (X, Y, Z, L, M, N) = reference + D (u - u0, v - v0, w - w0, p, q, r)
//! ```
//!
//! in axes fixed in the body (forward, right, down at the reference attitude), moments about
//! the mass centre, as flight dynamicists write them. Measured, from computed flow, or from the
//! cycle means of this program: the table does not say. It knows neither wings nor wingbeats.

use wingbeat_math::{DMat3, DVec3};

use crate::wing::{FrameMotion, Load};

/// A table of stability derivatives, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DerivativeTable {
    /// Rotation: components in the axes of the table to body components.
    pub to_body: DMat3,
    /// Reference point (mass centre), body components from the body's origin [m].
    pub point: DVec3,
    /// Reference velocity (u0, v0, w0), axes of the table [m/s].
    pub velocity: DVec3,
    /// Loads in the reference flight: X, Y, Z \[N\], L, M, N [N m].
    pub reference: [f64; 6],
    /// Rows X, Y, Z, L, M, N; columns u, v, w [m/s], p, q, r [rad/s].
    pub derivatives: [[f64; 6]; 6],
    /// Velocity of the undisturbed air, N components [m/s].
    pub stream: DVec3,
}

impl DerivativeTable {
    /// Force and moment about the body's origin, body components.
    pub fn load(&self, body: &FrameMotion) -> Load {
        let air = body.rotation.transpose() * (body.velocity - self.stream);
        let here = air + body.rate.cross(self.point);
        let v = self.to_body.transpose() * here - self.velocity;
        let w = self.to_body.transpose() * body.rate;
        let x = [v.x, v.y, v.z, w.x, w.y, w.z];
        let row = |i: usize| -> f64 {
            let sum: f64 = self.derivatives[i].iter().zip(x).map(|(d, x)| d * x).sum();
            self.reference[i] + sum
        };
        let force = self.to_body * DVec3::new(row(0), row(1), row(2));
        let moment = self.to_body * DVec3::new(row(3), row(4), row(5));
        Load {
            force,
            moment: moment + self.point.cross(force),
        }
    }
}

/// The sizes by which Sun and co-workers make derivatives dimensionless: forces by
/// `rho U^2 S / 2`, moments by that times c, velocities by U, rates by 1/T [Sun & Xiong 2005].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceSizes {
    /// Density of the air [kg/m3].
    pub density: f64,
    /// Reference speed U [m/s].
    pub speed: f64,
    /// Area of all wings S [m2].
    pub area: f64,
    /// Mean chord c [m].
    pub chord: f64,
    /// Period of the wingbeat T [s].
    pub period: f64,
}

impl ReferenceSizes {
    /// Dimensional derivatives from dimensionless ones.
    pub fn dimensional(&self, plus: &[[f64; 6]; 6]) -> [[f64; 6]; 6] {
        let force = 0.5 * self.density * self.speed * self.speed * self.area;
        let rows = [1.0, 1.0, 1.0, self.chord, self.chord, self.chord].map(|x| x * force);
        let by_speed = 1.0 / self.speed;
        let columns = [
            by_speed,
            by_speed,
            by_speed,
            self.period,
            self.period,
            self.period,
        ];
        std::array::from_fn(|i| std::array::from_fn(|j| plus[i][j] * rows[i] * columns[j]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_table_loads_by_hand() {
        // Body pitched up 90 degrees: forward is up. The table's axes are the body's own; the
        // reference point lies 2 m ahead of the origin.
        let mut d = [[0.0; 6]; 6];
        d[0][0] = -3.0; // X_u
        d[4][2] = 5.0; // M_w
        d[2][4] = 7.0; // Z_q
        let table = DerivativeTable {
            to_body: DMat3::IDENTITY,
            point: DVec3::new(2.0, 0.0, 0.0),
            velocity: DVec3::new(1.0, 0.0, 0.0),
            reference: [10.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            derivatives: d,
            stream: DVec3::ZERO,
        };
        let load = table.load(&FrameMotion {
            rotation: wingbeat_math::r2(std::f64::consts::FRAC_PI_2),
            velocity: DVec3::new(0.0, 0.0, -4.0),
            rate: DVec3::new(0.0, 0.5, 0.0),
        });
        // u = 4, w at the point = -0.5 * 2 = -1: X = 10 - 3 (4 - 1) = 1, Z = 7 / 2,
        // M = -5 about the point, less 2 Z at the origin.
        let close = |a: DVec3, b: DVec3| (a - b).length() < 1e-14;
        assert!(close(load.force, DVec3::new(1.0, 0.0, 3.5)), "{load:?}");
        assert!(close(load.moment, DVec3::new(0.0, -12.0, 0.0)), "{load:?}");
    }
}
