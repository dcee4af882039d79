//! Where wings hinge: at a place of the body, or where a joint has them on the wing that carries them.

use wingbeat_math::{DVec3, mirrored};
use wingbeat_model::mirror_name;

use crate::build::fault::Built;
use crate::build::numbers::vector;
use crate::error::Fault;
use crate::motion::carrier::carrier;
use crate::raw::Case;

/// The hinge of a wing in body axes \[m\], all angles of the wings being zero: where it is given, or, of a wing that
/// another one carries, at the joint.
pub(crate) fn hinge(case: &Case, name: &str) -> Built<DVec3> {
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
