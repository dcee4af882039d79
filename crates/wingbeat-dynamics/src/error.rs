//! What can be wrong with a system of bodies or with its state, and what to try.

use wingbeat_math::MassError;

/// Why a system cannot be built or its motion cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DynamicsError {
    /// The system has no body at all.
    #[error("a system needs at least one body: the root")]
    NoBodies,
    /// The mass properties of a body are impossible.
    #[error("body `{body}`: {source}")]
    Mass {
        /// Name of the body.
        body: String,
        /// The condition that fails.
        source: MassError,
    },
    /// No body has mass.
    #[error("the total mass is zero: give at least the root body a mass")]
    NoMass,
    /// A number of the input is not finite, or a unit is not positive.
    #[error("{what} is {value}, it must be a finite number{bound}")]
    BadNumber {
        /// What the number is.
        what: String,
        /// Its value.
        value: f64,
        /// An additional bound, as text (" > 0"), or empty.
        bound: &'static str,
    },
    /// A hinge names a body that does not exist.
    #[error("hinge `{hinge}` joins body {index}, but the system has bodies 0 to {last}")]
    NoSuchBody {
        /// Name of the hinge.
        hinge: String,
        /// The index that does not exist.
        index: usize,
        /// The last index that exists.
        last: usize,
    },
    /// The hinges do not join the bodies to a tree rooted at body 0.
    #[error(
        "body `{body}` is the child of {hinges} hinges and {reached} reached from the root: every body but the root must hang on exactly one hinge, and the root on none"
    )]
    NotATree {
        /// Name of a body that breaks the tree.
        body: String,
        /// How many hinges have it as their child.
        hinges: usize,
        /// "is" or "is not".
        reached: &'static str,
    },
    /// A matrix that should be a rotation is not orthogonal with determinant one.
    #[error(
        "{what} at t = {time} s is not a rotation matrix (R^T R deviates from the identity by {deviation:.2e}, determinant {determinant})"
    )]
    NotARotation {
        /// Which matrix.
        what: String,
        /// Time \[s\].
        time: f64,
        /// Largest entry of `|R^T R - I|`.
        deviation: f64,
        /// Determinant.
        determinant: f64,
    },
    /// The Euler angles of a body come too close to their singularity.
    #[error(
        "body `{body}` at t = {time:.6e} s: the middle Euler angle is {theta_deg:.2} deg, |cos| = {cosine:.4} is below {limit}, where the Euler angles become singular{}; use the momentum form (`formulation = \"momentum\"`), which has no such limit", beyond(*theta_deg)
    )]
    Singular {
        /// Name of the body.
        body: String,
        /// Time \[s\].
        time: f64,
        /// Middle angle theta \[deg\].
        theta_deg: f64,
        /// |cos theta|.
        cosine: f64,
        /// The least cosine allowed.
        limit: f64,
    },
    /// Newton-Raphson found an orientation that fulfils the three equations but is not the one meant.
    #[error(
        "hinge `{hinge}` at t = {time:.6e} s: the child is turned by {angle_deg:.1} deg against the prescribed orientation although the orientation constraints vanish (they do so at eight rotations); start from the prescribed orientation"
    )]
    WrongBranch {
        /// Name of the hinge.
        hinge: String,
        /// Time \[s\].
        time: f64,
        /// Angle of the relative rotation \[deg\].
        angle_deg: f64,
    },
    /// Newton-Raphson for consistent coordinates did not converge.
    #[error(
        "consistent coordinates at t = {time:.6e} s not found: residual {residual:.2e} (natural units) after {iterations} iterations, {tolerance:.0e} is needed; start nearer to the prescribed orientation"
    )]
    Assembly {
        /// Time \[s\].
        time: f64,
        /// Largest scaled residual.
        residual: f64,
        /// The residual that was needed.
        tolerance: f64,
        /// Iterations made.
        iterations: usize,
    },
    /// The saddle-point matrix of seed eq. 30 is singular.
    #[error(
        "the saddle-point matrix (seed eq. 30) is singular at t = {time:.6e} s: the root body needs mass and inertia; with a massless root use the momentum form"
    )]
    SingularSaddle {
        /// Time \[s\].
        time: f64,
    },
    /// The inertia of the whole system about its mass centre is singular.
    #[error(
        "the inertia of the whole system about its mass centre is singular at t = {time:.6e} s (principal moments about {scale:.2e} kg m2): the bodies need extent in all three directions"
    )]
    SingularInertia {
        /// Time \[s\].
        time: f64,
        /// A third of the trace [kg m2].
        scale: f64,
    },
    /// The state is no longer a set of finite numbers.
    #[error(
        "the state is not finite at t = {time:.6e} s ({what}, component {component}, is {value}): the integration has broken down, use a smaller step"
    )]
    NotFinite {
        /// Time \[s\].
        time: f64,
        /// Index of the component in the state vector.
        component: usize,
        /// What that is.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A joint's numbers are impossible.
    #[error("joint `{joint}`: {what} is {value}")]
    BadJoint {
        /// Name of the joint.
        joint: String,
        /// What the number is.
        what: String,
        /// Its value.
        value: f64,
    },
    /// A body is joined to nothing.
    #[error(
        "body `{body}` is not joined to {from} by any chain of joints: add a joint, or leave the body out"
    )]
    Disconnected {
        /// Name of the body.
        body: String,
        /// "the ground" or "body 0".
        from: &'static str,
    },
    /// Joints ask for the same thing twice.
    #[error(
        "at t = {time:.6e} s the joints {joints} ask for the same thing twice, so their reactions are not determined: free one of them (a planar loop closes with `point_on_line` in place of its last revolute joint), or start away from a singular position"
    )]
    Redundant {
        /// Time \[s\].
        time: f64,
        /// Names of the joints.
        joints: String,
    },
    /// Joints ask for different things.
    #[error(
        "at t = {time:.6e} s the joints {joints} contradict each other: what they ask for differs by {residual:.2e} (natural units)"
    )]
    Contradiction {
        /// Time \[s\].
        time: f64,
        /// Names of the joints.
        joints: String,
        /// Size of the contradiction.
        residual: f64,
    },
    /// The bodies cannot be moved so that all joints close.
    #[error(
        "joint `{joint}` cannot be closed at t = {time:.6e} s: it stays open by {residual:.2e} (natural units) after {iterations} iterations; check lengths and anchors, or start nearer to the closed position"
    )]
    NotAssembled {
        /// Time \[s\].
        time: f64,
        /// Name of the joint.
        joint: String,
        /// What stays open.
        residual: f64,
        /// Iterations made.
        iterations: usize,
    },
    /// A joint starts otherwise than closed loops let it.
    #[error("joint `{joint}` starts at {given}, where the closed loops ask for {asked}")]
    NotTheStart {
        /// Name of the joint.
        joint: String,
        /// Whether this is the rate and not the coordinate.
        is_rate: bool,
        /// What is given, with its unit.
        given: String,
        /// What the loops ask for, with its unit.
        asked: String,
    },
    /// The equations of a mechanism are singular.
    #[error(
        "the equations of motion are singular at t = {time:.6e} s at {what}: a body without mass or inertia that its joints leave free, or joints that ask for the same thing twice in this position"
    )]
    SingularMechanism {
        /// Time \[s\].
        time: f64,
        /// Body or joint.
        what: String,
    },
    /// Added masses and accelerations that cannot agree.
    #[error(
        "the equations of motion are singular at t = {time:.6e} s: no accelerations agree with the added mass of the air; check masses and sizes, or leave the added mass out"
    )]
    SingularAddedMass {
        /// Time \[s\].
        time: f64,
    },
    /// A loop near a position in which its motion is not determined.
    #[error(
        "at t = {time:.6e} s the loop of the joints {joints} is near a position in which it may go on in several ways; change lengths or amplitudes so that it stays away from it"
    )]
    SingularPosition {
        /// Time \[s\].
        time: f64,
        /// Names of the joints.
        joints: String,
    },
    /// A loop whose motion is not prescribed.
    #[error(
        "joint `{joint}` closes a loop that leaves {free} of its coordinates free: prescribe as many of them (`turn`, `travel`)"
    )]
    LooseLoop {
        /// Name of the joint.
        joint: String,
        /// Coordinates left free.
        free: usize,
    },
    /// The formulation flies trees only.
    #[error(
        "joint `{joint}` closes a loop, which the {form} form does not have; use the quaternion form (`formulation = \"quaternion\"`)"
    )]
    Loop {
        /// Name of the joint.
        joint: String,
        /// Name of the formulation.
        form: &'static str,
    },
    /// The Euler form has no free joints.
    #[error(
        "hinge `{hinge}` has a free or travelling joint, which the Euler form does not have; use the momentum form (`formulation = \"momentum\"`) or the quaternion form"
    )]
    NotInEulerForm {
        /// Name of the hinge.
        hinge: String,
    },
}

/// Names in quotes, each once, in the order in which they come first.
pub(crate) fn quoted_once<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut quoted: Vec<String> = vec![];
    for name in names.map(|name| format!("`{name}`")) {
        if !quoted.contains(&name) {
            quoted.push(name);
        }
    }
    quoted.join(", ")
}

/// A middle angle passes its singularity at 90 degrees only within one step.
fn beyond(theta_deg: f64) -> &'static str {
    match theta_deg.abs() < 180.0 {
        true => "",
        false => {
            " (so far beyond 90 deg within one step: the step diverged; smaller steps may do, too)"
        }
    }
}
