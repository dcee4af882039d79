//! What episodes remember, to go on from there later: their numbers one after the other.

use wingbeat_dynamics::BodyMotion;
use wingbeat_math::{DMat3, DVec3};

use crate::beat::level::Perturbation;
use crate::control::departure::Departure;

/// Everything that an episode remembers: another one of the same course goes on from it, bit for bit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kept {
    /// Seed, episodes begun with it before this one, looks, integration steps.
    pub counts: [u64; 4],
    /// State of the momentum form, motion of the root, commands of the wings, departures under way \[SI\].
    pub numbers: Vec<f64>,
}

/// Numbers that are read one after the other.
pub(super) struct Numbers<'a>(pub(super) &'a [f64]);

impl Numbers<'_> {
    /// The next ones; as many as are asked for have been counted.
    pub(super) fn next<const N: usize>(&mut self) -> [f64; N] {
        let (next, rest) = self.0.split_first_chunk().expect("as many as were counted");
        self.0 = rest;
        *next
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::from_array(self.next())
    }

    /// What [`of_motion`] made of one.
    pub(super) fn motion(&mut self) -> BodyMotion {
        BodyMotion {
            p: self.vector(),
            r: DMat3::from_cols_array(&self.next()),
            v: self.vector(),
            w: self.vector(),
        }
    }

    /// What [`of_departure`] made of one.
    pub(super) fn departure(&mut self) -> Departure {
        let [look] = self.next();
        Departure {
            look: look as usize,
            position: self.vector(),
            state: Perturbation::from_array(self.next()),
        }
    }
}

/// Place, rotation, velocity, angular velocity.
pub(super) fn of_motion(motion: &BodyMotion) -> Vec<f64> {
    let [p, v, w] = [motion.p, motion.v, motion.w].map(|x| x.to_array());
    [&p[..], &motion.r.to_cols_array(), &v, &w].concat()
}

/// Look, place, velocity, angular velocity, tilt.
pub(super) fn of_departure(departure: &Departure) -> Vec<f64> {
    let (place, state) = (departure.position.to_array(), departure.state.to_array());
    [&[departure.look as f64][..], &place, &state].concat()
}
