//! Where wings hinge: at a place of the body, or where a joint has them on the wing that carries them.

use wingbeat_math::{DVec3, mirrored};
use wingbeat_model::mirror_name;

use super::fault::Built;
use super::numbers::vector;
use crate::error::Fault;
use crate::raw::Case;

/// The wing that carries another one, and the place of the joint in its axes, from its hinge \[m\].
pub(super) struct Carrier {
    pub joint: String,
    pub wing: String,
    at: DVec3,
}

/// The hinge of a wing in body axes \[m\], all angles of the wings being zero: where it is given, or, of a wing that
/// another one carries, at the joint.
pub(super) fn hinge(case: &Case, name: &str) -> Built<DVec3> {
    let given = given(case, name);
    let Some(carrier) = carrier(case, name) else {
        return given.map(|(_, hinge)| hinge).ok_or_else(|| missing(name));
    };
    let base = place(case, &carrier.wing, 0).ok_or_else(|| missing(&carrier.wing))?;
    let there = base + carrier.at;
    match given {
        Some((from, hinge)) if hinge.distance(there) > 1e-9 * (base.length() + there.length()) => {
            let place = there.to_array();
            Err(Fault::new(
                format!("wing.{from}.hinge_m"),
                format!(
                    "this is another place than that of joint.{} on wing `{}`, which carries the wing `{name}`",
                    carrier.joint, carrier.wing
                ),
                format!("none, or the place of the joint where all angles are zero: {place:?}"),
                "remove hinge_m; the place of a wing on a wing is at_m of its joint",
            ))
        }
        _ => Ok(there),
    }
}

/// Whether another wing carries this one.
pub(super) fn is_carried(case: &Case, name: &str) -> bool {
    carrier(case, name).is_some()
}

fn missing(name: &str) -> Fault {
    Fault::missing(
        format!("wing.{name}.hinge_m"),
        "the hinge in body axes [forward, right, down] in metres",
        "add `hinge_m = [..., ..., ...]`",
    )
}

/// The hinge that is given for a wing, or for the one on the other side, and whose it is.
fn given(case: &Case, name: &str) -> Option<(String, DVec3)> {
    let of = |name: &str| case.wing.get(name)?.hinge_m.map(vector);
    let own = of(name).map(|hinge| (name.to_owned(), hinge));
    own.or_else(|| {
        let other = mirror_name(name)?;
        let hinge = of(&other)?;
        Some((other, mirrored(hinge)))
    })
}

/// The hinge of a wing in body axes \[m\], over as many joints as there are.
fn place(case: &Case, name: &str, joints: usize) -> Option<DVec3> {
    match carrier(case, name).filter(|_| joints <= case.joint.len()) {
        Some(carrier) => Some(place(case, &carrier.wing, joints + 1)? + carrier.at),
        None => given(case, name).map(|(_, hinge)| hinge),
    }
}

/// What carries a wing, if that is a wing: its own first joint, or the image of that of the wing on the other side.
pub(super) fn carrier(case: &Case, name: &str) -> Option<Carrier> {
    let of = |child: &str| case.joint.iter().find(|(_, j)| j.child == child);
    let new = |joint: &str, wing: String, at: [f64; 3]| Carrier {
        joint: joint.to_owned(),
        wing,
        at: vector(at),
    };
    if let Some((joint, own)) = of(name) {
        let wing = own.parent.as_ref().filter(|p| is_wing(case, p))?;
        return Some(new(joint, wing.clone(), own.at_m?));
    }
    let other = mirror_name(name)?;
    let (joint, own) = of(&other).filter(|_| is_mirrored(case, &other))?;
    let wing = own.parent.as_ref().filter(|p| is_wing(case, p))?;
    let image = mirror_name(wing).filter(|w| is_wing(case, w));
    let [x, y, z] = own.at_m?;
    Some(new(joint, image.unwrap_or(wing.clone()), [x, -y, z]))
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
