//! What carries a wing: the body, or another wing, in whose axes its place and its angles then are.

use wingbeat_math::DVec3;
use wingbeat_model::mirror_name;

use crate::raw::{Case, JointCase};

/// The wing that carries another one, and the place of the joint in its axes, from its hinge \[m\].
pub(crate) struct Carrier {
    pub joint: String,
    pub wing: String,
    pub at: DVec3,
}

/// What carries a wing, if that is a wing: its own first joint, or the image of that of the wing on the other side.
pub(crate) fn carrier(case: &Case, name: &str) -> Option<Carrier> {
    let link = link(case, name)?;
    let wing = link.parent.filter(|p| is_wing(case, p))?;
    let [x, y, z] = link.own.at_m?;
    let at = if link.is_image { [x, -y, z] } else { [x, y, z] };
    Some(Carrier {
        joint: link.joint,
        wing,
        at: DVec3::from_array(at),
    })
}

/// Whether another wing carries this one.
pub(crate) fn is_carried(case: &Case, name: &str) -> bool {
    carrier(case, name).is_some()
}

/// Whether this wing moves with another one, which carries it directly or by segments.
pub(crate) fn rides_on_wing(case: &Case, name: &str) -> bool {
    let mut body = name.to_owned();
    // No chain is longer than there are joints.
    for _ in 0..=case.joint.len() {
        match link(case, &body).and_then(|link| link.parent) {
            None => return false,
            Some(parent) if is_wing(case, &parent) => return true,
            Some(parent) => body = parent,
        }
    }
    false
}

/// The joint that carries a body.
struct Link<'a> {
    joint: String,
    own: &'a JointCase,
    /// None of the central body that is not named.
    parent: Option<String>,
    /// Whether it is the image of a joint of the other side.
    is_image: bool,
}

fn link<'a>(case: &'a Case, name: &str) -> Option<Link<'a>> {
    let of = |child: &str| case.joint.iter().find(|(_, j)| j.child == child);
    if let Some((joint, own)) = of(name) {
        return Some(Link {
            joint: joint.clone(),
            own,
            parent: own.parent.clone(),
            is_image: false,
        });
    }
    let other = mirror_name(name)?;
    let (joint, own) = of(&other).filter(|_| is_mirrored(case, &other))?;
    let there = |p: &String| is_wing(case, p) || case.segment.contains_key(p);
    let image = |p: &String| mirror_name(p).filter(there).unwrap_or_else(|| p.clone());
    Some(Link {
        joint: joint.clone(),
        own,
        parent: own.parent.as_ref().map(image),
        is_image: true,
    })
}

/// Whether there is a wing of this name, or it comes along as a mirror image.
fn is_wing(case: &Case, name: &str) -> bool {
    let image = || mirror_name(name).is_some_and(|other| is_mirrored(case, &other));
    case.wing.contains_key(name) || image()
}

/// Whether the case has this wing, and it brings its mirror image along.
fn is_mirrored(case: &Case, name: &str) -> bool {
    let wing = case.wing.get(name);
    wing.is_some_and(|w| w.mirror.unwrap_or(true))
}
