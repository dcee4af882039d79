//! A joint between two bodies, or between the ground and a body.

use std::sync::Arc;

use wingbeat_math::{DMat3, DVec3, MovingRotation, RotationLaw};

use crate::error::DynamicsError;
use crate::system::check::check_finite;
use crate::system::joint_model::{JointModel, JointType};

/// A joint between two bodies, or between the ground and a body.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Name, for messages and results.
    pub name: String,
    /// Index of the parent body; the ground (frame N) if none.
    pub parent: Option<usize>,
    /// Index of the child body.
    pub child: usize,
    /// Joint point in the parent's frame \[m\].
    pub anchor_parent: DVec3,
    /// Joint point in the child's frame \[m\].
    pub anchor_child: DVec3,
    /// Prescribed rotation C(t) of the joint's frame K: K components to parent components (seed eq. 4); none: no
    /// rotation.
    pub law: Option<Arc<dyn RotationLaw>>,
    /// What is free, and what acts.
    pub model: JointModel,
}

impl Joint {
    /// The prescribed rotation of the joint's frame at time `t` \[s\].
    pub fn rotation(&self, t: f64) -> MovingRotation {
        let still = || MovingRotation::fixed(DMat3::IDENTITY);
        self.law.as_ref().map_or_else(still, |law| law.at(t))
    }

    /// The parent of a joint of a tree.
    pub(crate) fn tree_parent(&self) -> usize {
        self.parent.expect("joints of a tree hang on bodies")
    }

    /// A joint between `parent` and `child` with frames parallel at zero coordinates.
    pub fn new(name: &str, parent: Option<usize>, child: usize, kind: JointType) -> Self {
        Self {
            name: name.into(),
            parent,
            child,
            anchor_parent: DVec3::ZERO,
            anchor_child: DVec3::ZERO,
            law: None,
            model: JointModel::new(kind),
        }
    }

    /// The same at the point `parent` \[m\] of the parent and `child` \[m\] of the child.
    pub fn at(self, parent: DVec3, child: DVec3) -> Self {
        Self {
            anchor_parent: parent,
            anchor_child: child,
            ..self
        }
    }
}

pub(crate) fn check_joint(l: &Joint, bodies: usize) -> Result<(), DynamicsError> {
    for index in l.parent.into_iter().chain([l.child]) {
        if index >= bodies {
            return Err(DynamicsError::NoSuchBody {
                hinge: l.name.clone(),
                index,
                last: bodies - 1,
            });
        }
    }
    if l.parent == Some(l.child) {
        return Err(DynamicsError::BadJoint {
            joint: l.name.clone(),
            what: "child is its own parent: body".into(),
            value: l.child as f64,
        });
    }
    check_numbers_of(l)
}

/// Checks the numbers of a joint.
pub(crate) fn check_numbers_of(l: &Joint) -> Result<(), DynamicsError> {
    if let Some((what, value)) = l.model.fault() {
        return Err(DynamicsError::BadJoint {
            joint: l.name.clone(),
            what,
            value,
        });
    }
    check_finite(
        &format!("joint `{}`: anchor on the parent [m]", l.name),
        l.anchor_parent,
    )?;
    check_finite(
        &format!("joint `{}`: anchor on the child [m]", l.name),
        l.anchor_child,
    )
}
