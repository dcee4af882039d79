//! The undisturbed air: uniform stream, steady shear, gusts, a vortex street.

use crate::error::{AirError, is_positive, require};
use crate::images::{Mirror, Plane, ROUNDING};
use crate::settings::street::VortexStreet;
use crate::settings::turbulence::Turbulence;
use wingbeat_math::{DMat3, DVec3, interpolate_pairs, largest, trace};

/// How a gust rises and falls with its own time tau [s]: the share of its amplitude.
#[derive(Clone, Debug, PartialEq)]
pub enum GustShape {
    /// `(1 - cos(2 pi tau / duration)) / 2` for tau between 0 and `duration` [s].
    OneMinusCosine {
        /// From rise to fall [s].
        duration: f64,
    },
    /// Straight lines between (tau [s], share); nothing before the first row, the last value after
    /// the last one.
    Table(Vec<(f64, f64)>),
    /// Turbulence of the amplitude as root mean square, from the start on; a front that travels carries it
    /// along, frozen [Taylor 1938].
    Turbulence(Turbulence),
}

/// A gust: `amplitude x shape(t - start - slowness . x)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Gust {
    /// Velocity at share one [m/s], N components.
    pub amplitude: DVec3,
    /// When it begins at the origin of N [s].
    pub start: f64,
    /// Direction over speed of a front that travels [s/m], N components; zero: everywhere at once.
    pub slowness: DVec3,
    /// The course.
    pub shape: GustShape,
}

impl GustShape {
    /// Share of the amplitude at the gust's own time `tau` [s].
    ///
    /// ```
    /// let gust = wingbeat_air::GustShape::OneMinusCosine { duration: 2.0 };
    /// assert_eq!(gust.at(-0.1), 0.0);
    /// assert!((gust.at(1.0) - 1.0).abs() < 1e-15);
    /// ```
    pub fn at(&self, tau: f64) -> f64 {
        match self {
            Self::OneMinusCosine { duration } if tau > 0.0 && tau < *duration => {
                0.5 - 0.5 * (std::f64::consts::TAU * tau / duration).cos()
            }
            Self::OneMinusCosine { .. } => 0.0,
            Self::Table(rows) => table(rows, tau),
            Self::Turbulence(air) if tau >= 0.0 => air.at(tau),
            Self::Turbulence(_) => 0.0,
        }
    }

    /// Rate of that share at the gust's own time `tau` [1/s]; at a corner of a table that of the line after it.
    /// Jumps have none.
    ///
    /// ```
    /// use wingbeat_air::GustShape;
    /// assert_eq!(GustShape::Table(vec![(0.0, 1.0), (2.0, 4.0)]).rate(1.0), 1.5);
    /// ```
    pub fn rate(&self, tau: f64) -> f64 {
        match self {
            Self::OneMinusCosine { duration } if tau > 0.0 && tau < *duration => {
                let wave = std::f64::consts::TAU / duration;
                0.5 * wave * (wave * tau).sin()
            }
            Self::OneMinusCosine { .. } => 0.0,
            Self::Table(rows) => table_rate(rows, tau),
            Self::Turbulence(air) if tau >= 0.0 => air.rate(tau),
            Self::Turbulence(_) => 0.0,
        }
    }
}

fn table_rate(rows: &[(f64, f64)], tau: f64) -> f64 {
    let after = rows.partition_point(|row| row.0 <= tau);
    match after == 0 || after == rows.len() {
        true => 0.0,
        false => {
            let (a, b) = (rows[after - 1], rows[after]);
            (b.1 - a.1) / (b.0 - a.0)
        }
    }
}

fn table(rows: &[(f64, f64)], tau: f64) -> f64 {
    match rows.first() {
        Some(first) if tau >= first.0 => interpolate_pairs(rows, tau),
        _ => 0.0,
    }
}

/// What is added to the uniform stream.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wind {
    /// Gradient of a steady shear [1/s], if any: the velocity `shear x` is added at the place x, N.
    pub shear: Option<DMat3>,
    /// Gusts, added up.
    pub gusts: Vec<Gust>,
    /// A vortex street, if any.
    pub street: Option<VortexStreet>,
}

impl Wind {
    /// Whether there is anything to add.
    pub fn is_none(&self) -> bool {
        self.shear.is_none() && self.gusts.is_empty() && self.street.is_none()
    }

    /// Whether it is the same everywhere: no shear, no street, no gust whose front travels.
    pub fn is_uniform(&self) -> bool {
        let travels = |g: &Gust| g.slowness != DVec3::ZERO;
        self.shear.is_none() && self.street.is_none() && !self.gusts.iter().any(travels)
    }

    /// Velocity [m/s] that is added at `x` [m] and time `t` [s], N components.
    pub fn at(&self, x: DVec3, t: f64) -> DVec3 {
        let gust = |g: &Gust| g.amplitude * g.shape.at(t - g.start - g.slowness.dot(x));
        let shear = self.shear.map_or(DVec3::ZERO, |s| s * x);
        let street = self.street.map_or(DVec3::ZERO, |s| s.at(x, t));
        shear + self.gusts.iter().map(gust).sum::<DVec3>() + street
    }

    /// Rate [m/s2] of that velocity at a point that is at `x` [m] and moves with `v` [m/s] at time `t` [s], N
    /// components. Jumps of tables have none.
    pub fn rate(&self, x: DVec3, v: DVec3, t: f64) -> DVec3 {
        let gust = |g: &Gust| {
            let passing = 1.0 - g.slowness.dot(v);
            g.amplitude * (passing * g.shape.rate(t - g.start - g.slowness.dot(x)))
        };
        let shear = self.shear.map_or(DVec3::ZERO, |s| s * v);
        let street = self.street.map_or(DVec3::ZERO, |s| s.rate(x, v, t));
        shear + self.gusts.iter().map(gust).sum::<DVec3>() + street
    }

    /// What of that velocity is the same everywhere at time `t` [s], that of gusts without a front, with its
    /// rate [m/s, m/s2], N components.
    pub fn at_once(&self, t: f64) -> [DVec3; 2] {
        let gusts = self.gusts.iter();
        let everywhere = gusts.filter(|g| g.slowness == DVec3::ZERO);
        everywhere.fold([DVec3::ZERO; 2], |[v, rate], g| {
            let tau = t - g.start;
            [
                v + g.amplitude * g.shape.at(tau),
                rate + g.amplitude * g.shape.rate(tau),
            ]
        })
    }

    /// The first part that this mirror does not leave as it is.
    pub(crate) fn asymmetric_part(&self, mirror: &Mirror) -> Option<&'static str> {
        let turns = |v: DVec3| mirror.vector(v).distance(v) > ROUNDING * v.length();
        let turns_shear = |s: DMat3| {
            let change = largest_entry(mirror.gradient(s) - s);
            let size = largest_entry(s);
            // The air of a mirrored place also lacks what the shear makes of the way to it.
            let rest = (s * mirror.shift()).length();
            change > ROUNDING * size || rest > ROUNDING * size * mirror.shift().length()
        };
        let gusts = || self.gusts.iter();
        if self.shear.is_some_and(turns_shear) {
            Some("the shear")
        } else if gusts().any(|g| turns(g.amplitude)) {
            Some("the amplitude of a gust")
        } else if gusts().any(|g| turns(g.slowness)) {
            Some("the front of a gust")
        } else if self
            .street
            .is_some_and(|s| turns(s.drift) || !turns_over(mirror, s.axis))
        {
            Some("the vortex street")
        } else {
            None
        }
    }

    /// The first part that goes through this plane.
    pub(crate) fn part_through(&self, plane: &Plane) -> Option<&'static str> {
        let n = plane.normal.normalize();
        let crosses = |v: DVec3| v.dot(n).abs() > ROUNDING * v.length();
        // At p + t, t along the plane, n . shear (p + t) is to be 0.
        let crosses_by_shear = |s: DMat3| {
            let (size, across) = (largest_entry(s), s.transpose() * n);
            let along = across - across.dot(n) * n;
            let place = plane.point.dot(n);
            along.length() > ROUNDING * size
                || (across.dot(n) * place).abs() > ROUNDING * size * place.abs()
        };
        let is_square = |axis: DVec3| axis.cross(n).length() <= ROUNDING * axis.length();
        if self.shear.is_some_and(crosses_by_shear) {
            Some("shear")
        } else if self.gusts.iter().any(|g| crosses(g.amplitude)) {
            Some("gust")
        } else if self.street.is_some_and(|s| !is_square(s.axis)) {
            Some("vortex street")
        } else {
            None
        }
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// [`AirError::Setting`] or [`AirError::GustTable`] names the first one that makes no sense.
    pub fn validate(&self) -> Result<(), AirError> {
        if let Some(shear) = self.shear {
            require(shear.is_finite(), "shear", shear, "finite numbers in 1/s")?;
            let size = largest_entry(shear);
            require(
                trace(shear).abs() <= 1e-9 * size,
                "shear",
                format!("a diagonal that adds up to {:.4} 1/s", trace(shear)),
                "a sum of 0 of the diagonal elements: air that flows apart everywhere loses its density",
            )?;
        }
        if let Some(street) = &self.street {
            street.validate()?;
        }
        for (gust, g) in self.gusts.iter().enumerate() {
            require(
                g.amplitude.is_finite() && g.slowness.is_finite() && g.start.is_finite(),
                "gust",
                format!("{g:?}"),
                "a finite amplitude in m/s, slowness in s/m and start in s",
            )?;
            match &g.shape {
                GustShape::OneMinusCosine { duration } => require(
                    is_positive(*duration),
                    "gust duration",
                    duration,
                    "a time in s above 0",
                )?,
                GustShape::Table(rows) => check_table(gust, rows)?,
                GustShape::Turbulence(_) => {} // checked when it is made
            }
        }
        Ok(())
    }
}

/// Whether the mirror reverses this direction: it is that of its normal.
fn turns_over(mirror: &Mirror, v: DVec3) -> bool {
    (mirror.vector(v) + v).length() <= ROUNDING * v.length()
}

/// Largest entry by size.
fn largest_entry(of: DMat3) -> f64 {
    largest(of.to_cols_array().map(f64::abs))
}

fn check_table(gust: usize, rows: &[(f64, f64)]) -> Result<(), AirError> {
    let wrong = |row, problem| Err(AirError::GustTable { gust, row, problem });
    if rows.len() < 2 {
        return wrong(rows.len(), "a table needs at least two rows");
    }
    if let Some(k) = rows.iter().position(|r| !(r.0 + r.1).is_finite()) {
        return wrong(k, "a number is not finite");
    }
    match rows.windows(2).position(|w| w[1].0 <= w[0].0) {
        Some(k) => wrong(k + 1, "its time is not later than that of the row before"),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wind of all kinds.
    fn rough() -> Wind {
        let gust = |slowness, shape| Gust {
            amplitude: DVec3::new(0.4, -1.0, 0.7),
            start: 0.05,
            slowness,
            shape,
        };
        let turbulence = Turbulence::new(crate::Spectrum::DrydenAcross, 0.3, 4);
        let rows = vec![(0.0, 0.2), (0.11, 1.0), (0.3, 0.4), (0.5, 0.5)];
        Wind {
            shear: Some(DMat3::from_cols(
                DVec3::X,
                DVec3::Z,
                DVec3::new(2.0, 0.5, -1.0),
            )),
            gusts: vec![
                gust(DVec3::ZERO, GustShape::OneMinusCosine { duration: 0.9 }),
                gust(DVec3::X / 7.0, GustShape::Table(rows)),
                gust(
                    DVec3::Y / 4.0,
                    GustShape::Turbulence(match turbulence {
                        Ok(air) => air,
                        Err(e) => panic!("{e}"),
                    }),
                ),
            ],
            street: Some(VortexStreet {
                circulation: 0.3,
                spacing: 0.2,
                width: 0.06,
                concentration: 0.8,
                drift: DVec3::new(0.3, 0.0, -1.5),
                axis: DVec3::Y,
                point: DVec3::new(0.1, 0.0, 0.3),
            }),
        }
    }

    #[test]
    fn agrees_rate_of_the_wind_at_a_moving_point_with_differences() {
        let wind = rough();
        let (x, v) = (DVec3::new(0.02, 0.3, 0.21), DVec3::new(1.1, -0.6, 0.8));
        for k in 1..40 {
            let (t, h) = (0.017 * f64::from(k), 1e-6);
            let at = |t: f64| wind.at(x + t * v, t);
            let difference = (at(t + h) - at(t - h)) / (2.0 * h);
            let rate = wind.rate(x + t * v, v, t);
            // Rounding of the difference: 1e-16 / 1e-6; its error h^2 times the third derivative of waves of
            // some 100 1/s.
            assert!(
                (rate - difference).length() < 1e-6 * rate.length().max(1.0),
                "{t}: {rate} {difference}"
            );
            let still = |t: f64| wind.at_once(t)[0];
            let difference = (still(t + h) - still(t - h)) / (2.0 * h);
            let rate = wind.at_once(t)[1];
            assert!((rate - difference).length() < 1e-6 * rate.length().max(1.0));
        }
        let one = DVec3::new(0.4, -1.0, 0.7) * wind.gusts[0].shape.at(0.25);
        assert_eq!(wind.at_once(0.3)[0], one);
    }

    #[test]
    fn exact_sharp_gust_is_not_felt_before_it_comes() {
        let gust = Gust {
            amplitude: DVec3::Z,
            start: 2.0,
            slowness: DVec3::X / 4.0,
            shape: GustShape::Table(vec![(0.0, 1.0), (1.0, 0.5)]),
        };
        let wind = Wind {
            gusts: vec![gust],
            ..Wind::default()
        };
        let share = |x: f64, t: f64| wind.at(x * DVec3::X, t).z;
        assert_eq!(share(0.0, 1.99), 0.0);
        assert_eq!(share(0.0, 2.0), 1.0);
        assert_eq!(share(0.0, 2.5), 0.75);
        assert_eq!(share(0.0, 9.0), 0.5);
        // Its front takes a second for 4 m.
        assert_eq!([share(4.0, 2.9), share(4.0, 3.0)], [0.0, 1.0]);
    }
}
