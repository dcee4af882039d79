//! Which wings belong together: those that are joined, those whose circulation goes on through a body.

use wingbeat_model::{PairOnPart, inside, pairs_on_parts};

use crate::air::{check_joined, wing_pairs};
use crate::setup::{AirOptions, FlightSetup};

/// Distance of two roots over their chord below which there is no room for a body's panels between them.
const CLOSE: f64 = 0.25;

impl FlightSetup {
    /// Whether wing `w` hangs on a joint of its own.
    pub(crate) fn has_own_joint(&self, w: usize) -> bool {
        self.joints.iter().any(|j| j.child == w + 1)
    }

    /// Wings without joints of their own.
    pub(crate) fn prescribed_wings(&self) -> Vec<usize> {
        let all = 0..self.animal.wings.len();
        all.filter(|&w| !self.has_own_joint(w)).collect()
    }

    /// Pairs of wings that are joined at their roots; where no air joins them, those that could be.
    pub fn joined_pairs(&self) -> Vec<[usize; 2]> {
        match self.air.lattice() {
            Some(air) => air.joined.clone(),
            None => {
                let mut pairs = wing_pairs(&self.animal);
                pairs.retain(|&pair| check_joined(&self.animal, pair).is_ok());
                pairs
            }
        }
    }

    /// Pairs of wings, each the mirror image of the other, whose circulation the lattice carries through the
    /// part of the body on which both roots lie ([`pairs_on_parts`]), so that these roots shed nothing: where bodies are
    /// surfaces of `air`; not those that are joined or inside parts or too close to each other, nor those with
    /// joints of their own.
    pub fn carried_pairs(&self, air: &AirOptions) -> Vec<PairOnPart> {
        if !air.body_surfaces {
            return vec![];
        }
        let mut pairs = wing_pairs(&self.animal);
        let prescribed = self.prescribed_wings();
        let is_joined = |w: &usize| air.joined.iter().flatten().any(|j| j == w);
        pairs.retain(|pair| (pair.iter()).all(|w| prescribed.contains(w) && !is_joined(w)));
        let mut found = pairs_on_parts(&self.animal, &pairs);
        let wings: Vec<usize> = found.iter().flat_map(|p| p.wings).collect();
        let within = inside(&self.animal, &wings);
        found.retain(|p| within.iter().all(|i| !p.wings.contains(&i.wing)));
        found.retain(|p| p.apart_chords >= CLOSE);
        found
    }
}
