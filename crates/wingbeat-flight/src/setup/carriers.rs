//! What carries wings: the body, other wings, joints that move; and which of them are steered.

use wingbeat_dynamics::{Joint, JointType};
use wingbeat_model::Animal;

/// The joints that carry body number `body`, from its own to that on the central body; none of one without a joint.
pub fn chain(joints: &[Joint], body: usize) -> Vec<&Joint> {
    let mut found: Vec<&Joint> = vec![];
    let mut next = Some(body);
    while let Some(joint) = joints.iter().find(|j| Some(j.child) == next) {
        if found.iter().any(|j| std::ptr::eq(*j, joint)) {
            break; // refused elsewhere
        }
        found.push(joint);
        next = joint.parent;
    }
    found
}

/// Whether wing `w` stands still beside wings that beat: a tail, or a surface that is held. Wings beat by angles or shapes
/// of their own that vary; where joints are driven, those on joints that move do, too.
pub fn is_held(animal: &Animal, joints: &[Joint], w: usize) -> bool {
    let stands = |w: usize| animal.wings[w].is_still();
    let moves = |joint: &&Joint| joint.model.kind != JointType::Weld || is_driven(joint);
    let is_moved = |w: usize| chain(joints, w + 1).iter().any(moves);
    let all = 0..animal.wings.len();
    let beats_by_itself = all.clone().any(|v| !stands(v));
    let beats_on_joints =
        || joints.iter().any(is_driven) && !is_moved(w) && all.clone().any(is_moved);
    stands(w) && (beats_by_itself || beats_on_joints())
}

/// The innermost of the wings that carry wing `w` of `wings`, directly or by segments; itself where none does.
pub fn wing_on_body(wings: usize, joints: &[Joint], w: usize) -> usize {
    let carriers = chain(joints, w + 1).into_iter().filter_map(|j| j.parent);
    let mut on_wing = carriers.filter(|body| (1..=wings).contains(body));
    on_wing.next_back().map_or(w, |body| body - 1)
}

/// Whether what changes all strokes of the flyer (the controls of trim, commands to all wings) acts on wing `w`: not on
/// one that rides on another wing, nor on one that stands still beside wings that beat ([`is_held`]), as a tail does.
pub fn is_adjusted(animal: &Animal, joints: &[Joint], w: usize) -> bool {
    wing_on_body(animal.wings.len(), joints, w) == w && !is_held(animal, joints, w)
}

/// Whether anything at the joint follows a law of time: rotation, travel, actuators.
pub fn is_driven(joint: &Joint) -> bool {
    let model = &joint.model;
    let mut drives = model.elements.iter().filter_map(|e| e.law.drive());
    joint.law.is_some() || model.travel.is_some() || drives.any(|s| !s.is_constant())
}
