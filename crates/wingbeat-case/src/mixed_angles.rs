//! Wings whose angles come partly from the case and partly from a set of measured ones.

use crate::carrier::rides_on_wing;
use crate::loaded::LoadedCase;
use crate::raw::{ANGLES, WingMotionCase};

/// A wing with angles of its own, and with others from a shipped set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MixedAngles {
    /// Name of the wing.
    pub wing: String,
    /// Its angles that the case gives: `phi`, `theta`, `psi`.
    pub given: Vec<&'static str>,
    /// Those that it leaves to the set.
    pub from_set: Vec<&'static str>,
    /// The key that names the set, and its name.
    pub set: [String; 2],
}

impl LoadedCase {
    /// The wings of which some angles are given and others come from `motion.data` or `wing.NAME.motion.data`.
    pub fn mixed_angles(&self) -> Vec<MixedAngles> {
        let shared = self.raw.motion.data.as_ref();
        let shared = shared.map(|set| ["motion.data".to_owned(), set.clone()]);
        let wings = self.raw.wing.iter();
        let motions = wings.filter_map(|(name, wing)| Some((name, wing.motion.as_ref()?)));
        let shared = |name: &str| shared.clone().filter(|_| !rides_on_wing(&self.raw, name));
        motions
            .filter_map(|(name, motion)| mixed(name, motion, shared(name)))
            .collect()
    }
}

fn mixed(name: &str, motion: &WingMotionCase, shared: Option<[String; 2]>) -> Option<MixedAngles> {
    let own = motion.data.as_ref();
    let own = own.map(|set| [format!("wing.{name}.motion.data"), set.clone()]);
    let set = own.or(shared)?;
    let given: Vec<&'static str> = motion.angles().map(|(angle, _)| angle).collect();
    let from_set = ANGLES.into_iter().filter(|angle| !given.contains(angle));
    let from_set: Vec<&'static str> = from_set.collect();
    (!given.is_empty() && !from_set.is_empty()).then_some(MixedAngles {
        wing: name.to_owned(),
        given,
        from_set,
        set,
    })
}
