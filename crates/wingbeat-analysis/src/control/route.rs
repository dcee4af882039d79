//! A route: waypoints with their times, and the smooth way between them.
//!
//! From one waypoint to the next place and heading go over by the polynomial of degree seven that begins and ends at
//! rest ([`smoothstep7`]); the last one is held. At the middle of the way the velocity is 35/16 of its mean.

use wingbeat_flight::Aim;
use wingbeat_math::{DVec3, smoothstep7};

/// Where to be, and when.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Waypoint {
    /// Time since the release [s].
    pub time: f64,
    /// Place of the mass centre relative to that at the release, N components [m].
    pub position: DVec3,
    /// Heading relative to that of the reference flight, to the right \[rad\].
    pub heading: f64,
}

/// Waypoints in the order of their times, the first later than the release; none: the place of the release is held.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Route(pub Vec<Waypoint>);

impl Route {
    /// When each waypoint is to be reached, after the release [s].
    pub fn arrivals(&self) -> Vec<f64> {
        self.0.iter().map(|w| w.time).collect()
    }

    /// Where to be at `time` [s] since the release, relative to place and heading there.
    ///
    /// ```
    /// use wingbeat_analysis::control::{Route, Waypoint};
    /// use wingbeat_math::DVec3;
    /// let there = Waypoint { time: 2.0, position: DVec3::X, heading: 0.0 };
    /// let middle = Route(vec![there]).at(1.0);
    /// assert_eq!(middle.position.x, 0.5);
    /// assert!((middle.velocity.x - 35.0 / 16.0 * 0.5).abs() < 1e-15); // m/s
    /// ```
    pub fn at(&self, time: f64) -> Aim {
        let next = self.0.partition_point(|w| w.time <= time);
        let from = match next {
            0 => Waypoint::default(),
            _ => self.0[next - 1],
        };
        let Some(to) = self.0.get(next) else {
            return Aim {
                position: from.position,
                heading: from.heading,
                ..Aim::default()
            };
        };
        let [way, rate, _] = smoothstep7(time, from.time, to.time - from.time);
        let (step, turn) = (to.position - from.position, to.heading - from.heading);
        Aim {
            position: from.position + way * step,
            velocity: rate * step,
            heading: from.heading + way * turn,
            heading_rate: rate * turn,
        }
    }
}
