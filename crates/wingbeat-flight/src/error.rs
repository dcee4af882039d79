//! What can go wrong in a flight.

use wingbeat_air::AirError;
use wingbeat_blade::BladeError;
use wingbeat_dynamics::DynamicsError;

/// Residual over the allowed one up to which a step that did not converge was nearly there.
const NEARLY: f64 = 100.0;

/// What to do where a saved state is that of another case.
pub const RESUME_AS_SAVED: &str = "resume with the case that was saved with it";

/// Why a flight cannot start or go on. Times in seconds.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FlightError {
    /// The multibody system cannot be built or evaluated.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
    /// An elastic wing cannot be built or solved.
    #[error(transparent)]
    Structure(#[from] wingbeat_structure::StructureError),
    /// An elastic wing cannot be made of what it is to be made of.
    #[error(transparent)]
    WingStructure(#[from] wingbeat_model::structure::WingStructureError),
    /// Shape and loads of elastic wings did not come to agree.
    #[error(
        "t = {time:.6e} s: shape and loads of {} did not agree after {passes} passes: unbalanced forces {unbalanced:.2e} of those at the nodes, allowed {tolerance:.0e}; try {remedy}",
        wings.join(" and ")
    )]
    ElasticNotConverged {
        /// Time \[s\].
        time: f64,
        /// Names of the wings.
        wings: Vec<String>,
        /// Passes made.
        passes: usize,
        /// Unbalanced forces over those at the nodes \[1\].
        unbalanced: f64,
        /// Allowed.
        tolerance: f64,
        /// What to try.
        remedy: &'static str,
    },
    /// The vortex lattice cannot be built or evaluated.
    #[error(transparent)]
    Air(#[from] AirError),
    /// The blade elements cannot be built.
    #[error(transparent)]
    Blade(#[from] BladeError),
    /// Wings that are joined at their roots moved apart there.
    #[error(
        "t = {time:.6e} s: the joined roots (or tip and root) of `{}` and `{}` are {gap:.3e} m apart, allowed {limit:.3e} m (half a panel): bring the hinges and the surfaces' roots together, feather less there (twist the wing instead), or do not join them",
        wings[0], wings[1]
    )]
    RootsApart {
        /// Names of the wings.
        wings: [String; 2],
        /// Time [s].
        time: f64,
        /// Largest distance of two nodes that should be one [m].
        gap: f64,
        /// Allowed distance [m].
        limit: f64,
    },
    /// The edge of an elastic wing that lies on a plane of images bends off it.
    #[error(
        "t = {time:.6e} s: the edge of `{wing}` on the plane of air.ground is {gap:.3e} m off it, allowed {limit:.3e} m (a quarter of a panel): hold the wing there (wing.{wing}.structure), or move it off the plane (hinge_m)"
    )]
    OffPlane {
        /// Name of the wing.
        wing: String,
        /// Time [s].
        time: f64,
        /// Largest distance of a node from the plane [m].
        gap: f64,
        /// Allowed distance [m].
        limit: f64,
    },
    /// The surface of a wing that changes its shape has folded over.
    #[error(
        "t = {time:.6e} s: the surface of wing `{wing}` has folded over: at panel {panel} its sides cross or have no length; {}",
        if *elastic { "it is too soft for its loads or its steps: take smaller steps (time.steps_per_beat, or time.step_s), more damping (structure.damping_s), or a stiffer or thicker wing (wing.NAME.structure); of a membrane look at its tension at rest (shell.prestress_newton_per_m) and at what holds its edges" }
        else { "its prescribed shape does so: look at units and size of wing.NAME.deformation" }
    )]
    Folded {
        /// Time [s].
        time: f64,
        /// Name of the wing.
        wing: String,
        /// Panel, counted in the wing.
        panel: usize,
        /// Whether loads bend it; else its deformation is prescribed.
        elastic: bool,
    },
    /// A controller has no command, or asks for something impossible.
    #[error("t = {time:.6e} s: no command from the controller: {problem}")]
    Control {
        /// Time [s].
        time: f64,
        /// What is wrong.
        problem: String,
    },
    /// Air computed elsewhere failed.
    #[error("external air: {0}")]
    External(String),
    /// The adaptive integrator cannot go on.
    #[error(
        "t = {time:.6e} s: the adaptive steps became too small ({step:.1e} s): a motion law or load jumps there, or the motion is singular; smooth it, or take integrator = \"hamming\""
    )]
    StepTooSmall {
        /// Time [s].
        time: f64,
        /// Step [s].
        step: f64,
    },
    /// A loop has come to a position where its motion is not determined.
    #[error(
        "t = {time:.6e} s: the joints {joints} come to a position in which they ask for the same thing twice (joints in line): the motion of their loop is not determined there; change lengths or start so that it is not reached, limit the motion by a stop, or free one of the joints"
    )]
    SingularPosition {
        /// Time reached [s].
        time: f64,
        /// Names of the joints.
        joints: String,
    },
    /// Motion that is not mirror-symmetric though only one half of the air is computed.
    #[error(
        "t = {time:.6e} s: the motion is not mirror-symmetric: within a step it parts from its image by {apart:.1e} of its natural sizes, by loads, springs, speeds or masses of one side, or by rounding in joints far stiffer than steps resolve; compute both halves: air.mirror = false"
    )]
    Asymmetric {
        /// Time \[s\].
        time: f64,
        /// Largest difference within a step over the natural size of what differs \[1\].
        apart: f64,
    },
    /// Bodies that were thrown about within a step, in which the integrator diverged.
    #[error(
        "t = {time:.6e} s: the motion diverges within a step: body `{body}` turns by {turned:.1e} deg and moves by {moved:.1e} m in it; take {remedy}"
    )]
    Diverged {
        /// Time \[s\].
        time: f64,
        /// Name of the body.
        body: String,
        /// By what it would turn in a step \[deg\].
        turned: f64,
        /// By what it would move in a step \[m\].
        moved: f64,
        /// What to try.
        remedy: &'static str,
    },
    /// A flight ended because what a free joint carries grew from step to step.
    #[error(
        "{}; take {remedy}. The flight ended so: {ended}",
        match acts {
            Some(acts) => format!("t = {time:.6e} s: {acts}"),
            None => format!("t = {time:.6e} s: the rate of joint `{joint}` alternates from step to step and grows: dynamics.integrator = \"{integrator}\" does not carry what acts on it in these steps"),
        }
    )]
    JointGrows {
        /// Time \[s\].
        time: f64,
        /// Name of the joint.
        joint: String,
        /// Name of the integrator.
        integrator: &'static str,
        /// What its springs and dampers do in a step, where they alone make it grow.
        acts: Option<String>,
        /// What to try.
        remedy: String,
        /// The error that ended the flight.
        ended: Box<FlightError>,
    },
    /// A joint has turned farther than what acts along its angle can know.
    #[error(
        "t = {time:.6e} s: joint `{joint}` has turned by more than half a turn, and its spring, stop or follower knows its angle within half a turn here: free flight by dynamics.formulation = \"momentum\" counts turns of revolute and universal joints, not that of a held root or by \"quaternion\" (joints that close loops); turns of spherical joints are counted nowhere; limit it by a stop, or make its spring stiffer"
    )]
    TurnedPast {
        /// Time \[s\].
        time: f64,
        /// Name of the joint.
        joint: String,
    },
    /// The adaptive integrator made too many steps.
    #[error(
        "t = {time:.6e} s: {most} adaptive steps inside one step of the time grid: something changes fast there (a stiff spring or stop, a law of a short period); make it softer or slower, or shorten the step"
    )]
    TooManySteps {
        /// Time reached [s].
        time: f64,
        /// Most steps.
        most: usize,
    },
    /// The corrector of a step did not converge.
    #[error(
        "step {step} (t = {time:.6e} s): {} after {passes} corrector passes: scaled residual {residual:.2e}, allowed {tolerance:.2e}; {}try a smaller step, more passes, or relaxation below {relaxation}{}{}",
        if *in_air { "bodies and air did not agree" } else { "the motion of the bodies did not converge" },
        if *light_by_hamming { "set dynamics.integrator = \"bdf\", which carries bodies that weigh less than three times the fluid that they displace; or " } else { "" },
        match (in_air, elastic) {
            (true, _) => " (light bodies with large wings need it), and look whether wings cut through each other or the body",
            (false, true) => "; of elastic wings more damping (structure.damping_s), and look at the units of what they are made of (`wingbeat check` helps)",
            (false, false) => "; integrator = \"order_eight\" chooses its steps itself",
        },
        if *residual < NEARLY * tolerance { "; it is nearly there, where the air's answer may be no smoother: a larger corrector.tolerance takes it" } else { "" }
    )]
    NotConverged {
        /// Step that failed.
        step: usize,
        /// Its time [s].
        time: f64,
        /// Passes made.
        passes: usize,
        /// Scaled change of the last pass.
        residual: f64,
        /// Allowed change.
        tolerance: f64,
        /// Relaxation in use.
        relaxation: f64,
        /// Whether there is air.
        in_air: bool,
        /// Whether the integrator is `hamming` and the flyer light beside the fluid that its body displaces.
        light_by_hamming: bool,
        /// Whether wings are elastic.
        elastic: bool,
    },
    /// The setup contradicts itself.
    #[error("{}: {problem}", match &value[..] { "" => (*key).to_owned(), value => format!("{key} = {value}") })]
    Setup {
        /// What is wrong, as a key of the setup.
        key: &'static str,
        /// Its value; empty where it has none in a word.
        value: String,
        /// What is allowed and what to try.
        problem: String,
    },
}

impl FlightError {
    /// A setup that contradicts itself at `key`, whose value is `value`: what is allowed and what to try.
    pub fn setup(key: &'static str, value: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Setup {
            key,
            value: value.into(),
            problem: problem.into(),
        }
    }

    /// A saved state of which `value` does not fit the case.
    pub(crate) fn misfit(value: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::setup("state", value, problem)
    }
}
