//! Tethered: the root is moved by a support, and the support's load on it is what is asked for.

use wingbeat_math::{BodyAcceleration, BodyMotion, Wrench};

use crate::budget::{budget, load_power};
use crate::formulation::inverse::{multipliers, reactions};
use crate::{Solution, System, Violation, Workspace};

/// Prescribed motion of the root at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RootMotion {
    /// Position, attitude, velocities.
    pub motion: BodyMotion,
    /// Accelerations.
    pub acceleration: BodyAcceleration,
}

/// Motions of all bodies at time `t` \[s\] when the root moves like `root`.
pub fn tethered_motions(
    system: &System,
    t: f64,
    root: &BodyMotion,
    ws: &mut Workspace,
    out: &mut [BodyMotion],
) {
    ws.forget();
    ws.configuration.update(system, t);
    ws.configuration.motions(root, out);
}

/// Inverse dynamics at time `t` \[s\] of a system whose root is moved by a support:
/// accelerations, hinge reactions, multipliers, budget, and in `out.tether` the force and moment
/// (about the root's origin, N components) of the support on the root.
pub fn tethered(
    system: &System,
    t: f64,
    root: &RootMotion,
    loads: &[Wrench],
    ws: &mut Workspace,
    out: &mut Solution,
) {
    ws.forget();
    ws.configuration.update(system, t);
    ws.configuration.motions(&root.motion, &mut ws.motions);
    ws.configuration
        .accelerations(&root.motion, &root.acceleration, &mut out.bodies);
    reactions(system, loads, ws, out);
    multipliers(&out.hinges, &mut out.multipliers);
    out.violation = Violation::default();
    out.budget = budget(system, &ws.motions);
    out.load_power = load_power(loads, &ws.motions);
}
