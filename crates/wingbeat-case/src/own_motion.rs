//! What wings have of their own motion, and what they take from `[motion]` or from the other side.

use wingbeat_model::mirror_name;

use crate::raw::{Case, WingCase, WingMotionCase};

/// Whether a wing of this motion takes what it leaves out from the mirror image of that of its `counterpart`: it gives
/// no motion, or no angles.
pub(crate) fn takes(own: Option<&WingMotionCase>, counterpart: &WingMotionCase) -> bool {
    own.is_none_or(|own| !gives_angles(own) && gives_angles(counterpart))
}

/// Whether every wing `has` something of its own; a wing that takes its motion from the other side has none to ask.
/// False without wings.
pub(crate) fn every_wing(case: &Case, has: impl Fn(&WingMotionCase) -> bool) -> bool {
    let takes_all = |name: &str, wing: &WingCase| {
        let other = mirror_name(name).and_then(|other| case.wing.get(&other));
        let there = other.and_then(|w| w.motion.as_ref());
        there.is_some_and(|there| takes(wing.motion.as_ref(), there))
    };
    let none = WingMotionCase::default();
    let mut own = case.wing.iter().filter(|(name, w)| !takes_all(name, w));
    !case.wing.is_empty() && own.all(|(_, w)| has(w.motion.as_ref().unwrap_or(&none)))
}

/// Whether a wing of this motion leaves no angle to `motion.data`.
pub(crate) fn has_all_angles(own: &WingMotionCase) -> bool {
    own.data.is_some()
        || [&own.phi, &own.theta, &own.psi]
            .into_iter()
            .all(Option::is_some)
}

/// Whether a wing of this motion has angles of its own.
pub(crate) fn gives_angles(motion: &WingMotionCase) -> bool {
    let angles = [&motion.phi, &motion.theta, &motion.psi];
    motion.data.is_some() || angles.into_iter().any(Option::is_some)
}
