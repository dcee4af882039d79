//! The wind beside the free stream as the strips of a wing see it: its velocity, and what its changes do.
//!
//! A plate across whose chord the wind is the same feels the added mass `m` of its normal velocity w through
//! the air, whoever makes that change: force `-m w'`, in which the wind has the part `m n . dU/dt`, `dU/dt` the
//! rate at the strip as it moves. What accelerates air beside that, the pressure of the stream itself (Froude
//! and Krylov's force), is the mass of the air that the body displaces: zero for a plate.
//!
//! Strips with wakes come into a gust by Kuessner's function, which has the added mass of it. A wind that
//! changes everywhere at once is not come into: to it a strip answers as to its own motion, by Wagner's
//! function and the added mass [Miles 1956: gusts whose fronts travel, between both limits]. Gusts with a
//! front, shear and streets are taken as come into, whatever the speed of their front. The wind that is all
//! over a strip at the start of a flight is there as the stream is: at the start strips come only into what has
//! reached the edge in front and not yet the other one.

use wingbeat_math::DVec3;

/// The wind beside the free stream on a wing at an instant, wing components.
///
/// A closure is a wind that has velocities alone: steady and uniform, or, with wakes, come into.
pub trait LocalWind {
    /// Its velocity at a point of the wing frame [m/s].
    fn velocity(&self, point: DVec3) -> DVec3;

    /// Rate [m/s2] of that velocity (its components in axes that do not turn) at a point that moves with the
    /// velocity `through` [m/s] through the free stream.
    fn rate(&self, _point: DVec3, _through: DVec3) -> DVec3 {
        DVec3::ZERO
    }

    /// Of the part that is the same everywhere: by how much it has changed since the memory of the strips [m/s]
    /// (of no account where they remember nothing yet), and its rate [m/s2].
    fn at_once(&self) -> [DVec3; 2] {
        [DVec3::ZERO; 2]
    }

    /// Whether there is none.
    fn is_calm(&self) -> bool {
        false
    }
}

impl<F: Fn(DVec3) -> DVec3> LocalWind for F {
    fn velocity(&self, point: DVec3) -> DVec3 {
        self(point)
    }
}

/// No wind beside the free stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Calm;

impl LocalWind for Calm {
    fn velocity(&self, _point: DVec3) -> DVec3 {
        DVec3::ZERO
    }

    fn is_calm(&self) -> bool {
        true
    }
}
