//! Air as a table of stability derivatives: loads on a rigid body, linear about a reference flight.
//!
//! ```text
//! (X, Y, Z, L, M, N) = reference + D (u - u0, v - v0, w - w0, p, q, r)
//! ```
//!
//! in axes fixed in the body (forward, right, down at the reference attitude), moments about
//! the mass centre, as flight dynamicists write them. Measured, from computed flow, or from the
//! cycle means of this program: the table does not say. It knows neither wings nor wingbeats.

use wingbeat_math::six_by_six::{from_entries, product, symmetric_part, times, transpose, unit};
use wingbeat_math::{BodyMotion, DMat3, DVec3, Six, SixBySix, Wrench, six};

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
    pub reference: Six,
    /// Rows X, Y, Z, L, M, N; columns u, v, w [m/s], p, q, r [rad/s].
    pub derivatives: SixBySix,
    /// Added mass of the air A: the load is smaller by A times the rates of (u, v, w) through the air and of
    /// (p, q, r), symmetric [kg, kg m, kg m2].
    pub added_mass: SixBySix,
    /// Velocity of the undisturbed air, N components [m/s].
    pub stream: DVec3,
}

impl DerivativeTable {
    /// Force and moment about the body's origin, body components, but for what follows its acceleration over the ground
    /// ([`Self::added_mass_of_body`]).
    pub fn load(&self, body: &BodyMotion) -> Wrench {
        let air = body.r.transpose() * (body.v - self.stream);
        let here = air + body.w.cross(self.point);
        let v = self.to_body.transpose() * here - self.velocity;
        let w = self.to_body.transpose() * body.w;
        let x = six(v, w);
        // Where the origin does not accelerate, its velocity through the air turns against the axes.
        let turning = -w.cross(self.to_body.transpose() * air);
        let turning = turning.to_array();
        let along =
            |row: &[f64; 6], x: &[f64]| -> f64 { row.iter().zip(x).map(|(d, x)| d * x).sum() };
        let row = |i: usize| -> f64 {
            let sum = along(&self.derivatives[i], &x);
            self.reference[i] + sum - along(&self.added_mass[i], &turning)
        };
        let force = self.to_body * DVec3::new(row(0), row(1), row(2));
        let moment = self.to_body * DVec3::new(row(3), row(4), row(5));
        Wrench {
            force,
            moment: moment + self.point.cross(force),
        }
    }

    /// The same air by a table about another point of the body, body components from the body's origin \[m\]: the
    /// velocity at the old point is `v + w x d` of that at the new one, d from the new point to the old.
    pub fn about(&self, point: DVec3) -> Self {
        if point == self.point {
            return *self; // to the bit
        }
        let d = self.to_body.transpose() * (self.point - point);
        let columns: SixBySix = std::array::from_fn(|k| {
            let [linear, angular] = unit(k);
            six(linear + angular.cross(d), angular)
        });
        // Loads do the same work: they are carried over by the transpose.
        let carried = |m: &SixBySix| product(&columns, &product(m, &transpose(&columns)));
        Self {
            point,
            reference: times(&columns, &self.reference),
            derivatives: carried(&self.derivatives),
            added_mass: symmetric_part(&carried(&self.added_mass)),
            ..*self
        }
    }

    /// Added mass about the body's origin, body components; none if it is zero.
    pub fn added_mass_of_body(&self) -> Option<SixBySix> {
        let is_zero = self.added_mass.as_flattened().iter().all(|x| *x == 0.0);
        if is_zero {
            return None;
        }
        // Rates at the reference point in the table's axes from those at the origin in the body's.
        let column = |k: usize| {
            let [linear, angular] = unit(k);
            let v = self.to_body.transpose() * (linear + angular.cross(self.point));
            let w = self.to_body.transpose() * angular;
            six(v, w)
        };
        let columns: SixBySix = std::array::from_fn(column);
        let entry = |j: usize, k: usize| -> f64 {
            let rows = self.added_mass.iter().zip(&columns[j]);
            rows.map(|(row, x)| x * row.iter().zip(&columns[k]).map(|(a, y)| a * y).sum::<f64>())
                .sum()
        };
        // Exactly symmetric, as energy asks.
        Some(symmetric_part(&from_entries(entry)))
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
    pub fn dimensional(&self, plus: &SixBySix) -> SixBySix {
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
        from_entries(|i, j| plus[i][j] * rows[i] * columns[j])
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
            added_mass: [[0.0; 6]; 6],
            stream: DVec3::ZERO,
        };
        let load = table.load(&BodyMotion {
            r: wingbeat_math::r2(std::f64::consts::FRAC_PI_2),
            v: DVec3::new(0.0, 0.0, -4.0),
            w: DVec3::new(0.0, 0.5, 0.0),
            ..BodyMotion::REST
        });
        // u = 4, w at the point = -0.5 * 2 = -1: X = 10 - 3 (4 - 1) = 1, Z = 7 / 2,
        // M = -5 about the point, less 2 Z at the origin.
        let close = |a: DVec3, b: DVec3| (a - b).length() < 1e-14;
        assert!(close(load.force, DVec3::new(1.0, 0.0, 3.5)), "{load:?}");
        assert!(close(load.moment, DVec3::new(0.0, -12.0, 0.0)), "{load:?}");
    }

    /// Loads on a moving body are the same by a table about another point, those of the air's inertia among them.
    #[test]
    fn invariant_loads_by_a_table_about_another_point() {
        let number = |k: usize| ((7 * k + 3) % 11) as f64 - 5.0;
        let table = DerivativeTable {
            to_body: wingbeat_math::r2(0.4),
            point: DVec3::new(2.0, -0.5, 1.0),
            velocity: DVec3::new(1.0, 0.2, 0.0),
            reference: std::array::from_fn(number),
            derivatives: from_entries(|i, j| number(6 * i + j)),
            added_mass: symmetric_part(&from_entries(|i, j| number(5 * i + j))),
            stream: DVec3::new(0.3, 0.0, 0.1),
        };
        let moved = table.about(DVec3::new(-1.0, 0.7, 0.3));
        let body = BodyMotion {
            r: wingbeat_math::r2(0.9),
            v: DVec3::new(0.4, -1.0, 2.0),
            w: DVec3::new(0.3, 0.5, -0.2),
            ..BodyMotion::REST
        };
        let [a, b] = [table.load(&body), moved.load(&body)];
        // Rounding of sums of some tens of numbers of size ten.
        assert!((a.force - b.force).length() < 1e-12, "{a:?} {b:?}");
        assert!((a.moment - b.moment).length() < 1e-12, "{a:?} {b:?}");
        let [a, b] = [&table, &moved].map(|t| t.added_mass_of_body().unwrap());
        for (a, b) in a.as_flattened().iter().zip(b.as_flattened()) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }

    /// Three kilograms down, felt 2 m ahead of the origin: a pitch that quickens lifts them by the lever.
    #[test]
    fn exact_added_mass_about_the_origin_by_hand() {
        let mut table = DerivativeTable {
            to_body: DMat3::IDENTITY,
            point: DVec3::new(2.0, 0.0, 0.0),
            velocity: DVec3::ZERO,
            reference: [0.0; 6],
            derivatives: [[0.0; 6]; 6],
            added_mass: [[0.0; 6]; 6],
            stream: DVec3::ZERO,
        };
        assert_eq!(table.added_mass_of_body(), None);
        table.added_mass[2][2] = 3.0;
        let mut about = [[0.0; 6]; 6];
        about[2][2] = 3.0;
        (about[2][4], about[4][2], about[4][4]) = (-6.0, -6.0, 12.0);
        assert_eq!(table.added_mass_of_body(), Some(about));
        // A body that goes ahead by 7 m/s through air of 2 m/s, without acceleration, and turns nose up by 0.5
        // rad/s: its velocity of 5 m/s through the air changes by -w x v = (0, 0, 2.5) m/s2 in its axes.
        table.stream = DVec3::new(2.0, 0.0, 0.0);
        let load = table.load(&BodyMotion {
            r: DMat3::IDENTITY,
            v: DVec3::new(7.0, 0.0, 0.0),
            w: DVec3::new(0.0, 0.5, 0.0),
            ..BodyMotion::REST
        });
        assert_eq!(load.force, DVec3::new(0.0, 0.0, -7.5));
    }
}
