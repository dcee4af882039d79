//! What the air remembers from step to step: circulations and wakes.

use crate::state::impulse_account::ImpulseAccount;
use crate::state::inner_flow::InnerFlow;
use crate::state::wake_sheet::WakeSheet;
use wingbeat_math::DVec3;

/// How often the motion of the wake had to be limited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct WakeEvents {
    /// Displacements shortened to [`crate::AirSettings::max_displacement`], and strengths of particles held to
    /// a change of half in a step and twice their first size in all; leading edges that shed what they had too
    /// much where no solution holds the suction of all ([`crate::LeadingEdge::SuctionImplicit`]).
    pub limited: u64,
    /// Wake nodes and particles kept at [`crate::AirSettings::clearance`] from a surface; nodes of rows without
    /// circulation, which feel and do nothing, are not counted.
    pub near_surface: u64,
    /// Rings with circulation that left leading edges.
    pub leading_rings: u64,
    /// Rows of wake that were dropped.
    pub dropped_rows: u64,
    /// Particles made of rings.
    pub new_particles: u64,
    /// Particles that were dropped.
    pub dropped_particles: u64,
}

impl std::ops::AddAssign for WakeEvents {
    fn add_assign(&mut self, other: Self) {
        self.limited += other.limited;
        self.near_surface += other.near_surface;
        self.leading_rings += other.leading_rings;
        self.dropped_rows += other.dropped_rows;
        self.new_particles += other.new_particles;
        self.dropped_particles += other.dropped_particles;
    }
}

/// The state of the air: plain data, enough to go on bit for bit.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct AirState {
    /// Accepted steps so far.
    pub step: u64,
    /// Time of the last accepted step [s].
    pub time: f64,
    /// Whether the step was accepted but the wake not yet moved.
    pub wake_due: bool,
    /// Circulation of the panels at the last accepted step [m2/s].
    pub gamma: Vec<f64>,
    /// Circulation one accepted step earlier [m2/s].
    pub gamma_before: Vec<f64>,
    /// Time between these two [s].
    pub dt_before: f64,
    /// Circulation that the leading edge of each strip holds before flow leaves it, at the last accepted step [m2/s];
    /// what any edge may have before there was one.
    pub hold: Vec<f64>,
    /// Circulation that left the leading edge of each strip within the last accepted step, where that was part
    /// of the solution, counted as that of panels [m2/s]; zero once the wakes were moved.
    pub leaving: Vec<f64>,
    /// Chords for which the leading-edge vortex of each strip has been fed, less what was lost, at the last
    /// accepted step \[1\]; zero without ([`crate::VortexLift`]).
    pub fed: Vec<f64>,
    /// Length of the last step of the wakes [s], zero before it.
    pub dt_wake: f64,
    /// Positions of the surface nodes at the last accepted step [m], N components.
    pub position: Vec<DVec3>,
    /// Their velocities [m/s], N components.
    pub velocity: Vec<DVec3>,
    /// Flow of the fictitious fluid inside each surface at the last accepted step.
    pub inner: Vec<InnerFlow>,
    /// The same one accepted step earlier.
    pub inner_before: Vec<InnerFlow>,
    /// Wake sheets, in the order of [`crate::Lattice::sheets`].
    pub sheets: Vec<WakeSheet>,
    /// Regularised events since the start.
    pub events: WakeEvents,
    /// Where the impulse of the vorticity came from and where it went.
    pub impulse: ImpulseAccount,
    /// Impulse of what is attached, lattice and newest rows, less the momentum of the fictitious fluid, once
    /// the wakes were moved [kg m/s], N components.
    pub attached_impulse: DVec3,
    /// Impulse of free rings and particles [kg m/s], N components.
    pub free_impulse: DVec3,
}
