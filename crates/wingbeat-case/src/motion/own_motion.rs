//! What wings have of their own motion, and what they take from `[motion]` or from the other side.

use wingbeat_model::{Animal, mirror_name};

use crate::motion::carrier::rides_on_wing;
use crate::raw::{ANGLES, Case, WingCase, WingMotionCase};

/// Whether a wing of this motion takes what it leaves out from the mirror image of that of its `counterpart`: it gives
/// no motion, or no angles.
pub(crate) fn takes(own: Option<&WingMotionCase>, counterpart: &WingMotionCase) -> bool {
    own.is_none_or(|own| !gives_angles(own) && gives_angles(counterpart))
}

/// Whether no wing takes from `[motion]` what a motion `has` of its own: stroke plane or data set, which are for wings
/// that hang on the body. False without wings.
pub(crate) fn every_wing(case: &Case, has: impl Fn(&WingMotionCase) -> bool) -> bool {
    every_wing_among(case, |name| !rides_on_wing(case, name), has)
}

/// Whether no wing of the `animal` of this case beats at the phase of `[motion]`: each has a phase of its own, or
/// angles and a shape that do not vary.
pub(crate) fn every_phase(case: &Case, animal: &Animal) -> bool {
    let is_still = |name: &str| (animal.wings.iter()).any(|w| w.name == name && w.is_still());
    every_wing_among(case, |name| !is_still(name), |own| own.phase.is_some())
}

/// Whether each of these wings `has` something of its own; a wing that takes its motion from the other side has none
/// to ask.
fn every_wing_among(
    case: &Case,
    is_asked: impl Fn(&str) -> bool,
    has: impl Fn(&WingMotionCase) -> bool,
) -> bool {
    let takes_all = |name: &str, wing: &WingCase| {
        let other = mirror_name(name).and_then(|other| case.wing.get(&other));
        let there = other.and_then(|w| w.motion.as_ref());
        there.is_some_and(|there| takes(wing.motion.as_ref(), there))
    };
    let none = WingMotionCase::default();
    let asked = (case.wing.iter()).filter(|(name, w)| is_asked(name) && !takes_all(name, w));
    let mut own = asked.map(|(_, w)| w.motion.as_ref().unwrap_or(&none));
    !case.wing.is_empty() && own.all(has)
}

/// Whether a wing of this motion leaves no angle to `motion.data`.
pub(crate) fn has_all_angles(own: &WingMotionCase) -> bool {
    own.data.is_some() || own.angles().count() == ANGLES.len()
}

/// Whether a wing of this motion has angles of its own.
pub(crate) fn gives_angles(motion: &WingMotionCase) -> bool {
    motion.data.is_some() || motion.angles().next().is_some()
}
