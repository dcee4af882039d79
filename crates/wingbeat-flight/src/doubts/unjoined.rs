//! Wings whose roots meet and are not joined: the lattice has a gap there, through which air passes.

use wingbeat_model::{Spacing, are_joined, pairs, roots_meet};

use crate::air::check_joined;
use crate::setup::FlightSetup;

/// How near roots are that meet, and those that lie on each other, whose filaments cancel, over their chords \[1\].
const NEAR: f64 = 0.1;
const SAME: f64 = 1e-6;

impl FlightSetup {
    /// Says which wings of a lattice have roots that meet ([`roots_meet`]) and neither are joined nor shed there, with a
    /// gap between their outermost filaments, and what to do about it; wings with joints of their own, whose motion is
    /// not known beforehand, are left out.
    pub fn unjoined_roots(&self) -> Vec<String> {
        let air = match self.air.lattice() {
            Some(air) if !air.lattice.shedding.root => air,
            _ => return vec![],
        };
        let pairs = pairs(self.prescribed_wings().into_iter());
        let apart = pairs.filter(|pair| !are_joined(&air.joined, *pair));
        let wings = &self.animal.wings;
        let reach = |w: usize| wings[w].mesh.columns == Spacing::Cosine || air.lattice.inset == 0.0;
        let closes =
            |pair: [usize; 2]| pair.into_iter().all(reach) && roots_meet(&self.animal, pair, SAME);
        let found = apart.filter(|&pair| roots_meet(&self.animal, pair, NEAR) && !closes(pair));
        found.map(|pair| self.say_unjoined(pair)).collect()
    }

    fn say_unjoined(&self, pair: [usize; 2]) -> String {
        let [a, b] = pair.map(|w| &self.animal.wings[w].name);
        let remedy = match check_joined(&self.animal, pair) {
            Ok(()) => "join them (joined = true of the wing), or move the hinges apart (hinge_m)",
            Err(_) => "move the hinges apart (hinge_m)",
        };
        format!(
            "the roots of wings `{a}` and `{b}` meet and are not joined: their circulation ends there, so that lift is low, by a seventh in a stream at an aspect ratio of 6, and drag high; {remedy}"
        )
    }
}
