//! From the animal to the multibody system: the root body and one driven hinge per wing.

use std::sync::Arc;

use wingbeat_dynamics::{Body, DynamicsError, Hinge, NaturalUnits, System};
use wingbeat_math::{DVec3, EulerSequence};
use wingbeat_model::Animal;

/// The multibody system of an animal: body 0 is the central body (2-3-1 angles), then its wings
/// (1-3-2 angles), each on a hinge whose rotation is prescribed (seed sec. 3).
///
/// # Errors
/// What the dynamics refuses: see [`System::new`].
pub fn system(
    animal: &Animal,
    gravity: DVec3,
    units: NaturalUnits,
) -> Result<System, DynamicsError> {
    let mut bodies = vec![Body {
        name: "body".into(),
        mass: animal.body,
        sequence: EulerSequence::BODY_231,
    }];
    let mut hinges = vec![];
    for (i, wing) in animal.wings.iter().enumerate() {
        bodies.push(Body {
            name: wing.name.clone(),
            mass: wing.mass,
            sequence: EulerSequence::WING_132,
        });
        hinges.push(Hinge {
            name: wing.name.clone(),
            parent: 0,
            child: i + 1,
            anchor_parent: wing.hinge_b,
            anchor_child: DVec3::ZERO,
            law: Arc::new(wing.motion.clone()),
        });
    }
    System::new(bodies, hinges, gravity, units)
}
