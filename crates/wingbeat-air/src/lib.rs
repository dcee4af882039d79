//! Non-linear unsteady vortex lattice with free wakes (seed sec. 2.1).
//!
//! Wings are thin sheets and bodies closed skins of quadrilateral panels; every panel carries a
//! vortex ring on its edges. Each step the rings are given the circulations that let no air
//! through the control points; the unsteady Bernoulli equation turns them into pressure jumps and
//! forces; then the wakes, sheets of rings shed from trailing edge, tip and leading edge with the
//! circulation of the panel they leave (unsteady Kutta condition), move with the air.
//!
//! The recipe of a step:
//! 1. [`Lattice::loads`]: motion of the nodes in, loads out, in the frozen wake; repeated while
//!    bodies and air come to agree;
//! 2. [`Lattice::accept`]: the circulations become those of the state;
//! 3. [`Lattice::convect`]: the wakes move once with the velocities of the accepted step and a new
//!    row is shed; they stay frozen until the next accepted step.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | Gamma | `gamma` | circulation of a ring, the jump of the potential along the normal | m2/s |
//! | n | `normal` | unit normal, along (c2 - c0) x (c3 - c1) | 1 |
//! | V | `velocity` | velocity at the control point, mean of the two sides | m/s |
//! | dV | `velocity_jump` | jump of the tangential velocity along the normal | m/s |
//! | dp | `pressure_jump` | pressure behind less pressure before the panel, seen along n | Pa |
//! | rho | `density` | density of the air | kg/m3 |
//!
//! All vectors are components in the inertial frame N, though nothing here depends on which way
//! its axes point. The ring of a panel runs c0 -> c3 -> c2 -> c1, left-handed about the normal: then
//! positive circulation is lift along the normal.
//!
//! Old rows of wake, or those of leading edges at once, can become vortex particles ([`ParticleSettings`]).
//!
//! Surfaces may change their shape: their nodes move as the caller says. [`JoinedEdge`] joins surfaces to one;
//! strips with [`Surface::carry_through`] carry the circulation of two wings through the body they stand on;
//! [`SectionDrag`] adds friction and profile drag.
//!
//! The crate reads downward, and each storey knows those below it only: `step` (the recipes), `workspace`, `loads`
//! (from circulations to forces), `solve` (the circulations), `wake` (filaments, their velocities, their motion),
//! `state`, `lattice`, `geometry`, `settings`. The sums are those of [`wingbeat_vortex`].
//!
//! What this crate does not know: coordinates, joints, animals, gravity, files. What the method
//! does not know: viscosity (no friction drag of its own, wakes do not decay unless their cores grow),
//! separation other than at the edges told to shed. Forces are pressure times normal unless
//! [`LoadMethod`] says otherwise, so without the suction at edges that do not shed.

mod edges;
pub mod error;
mod geometry;
mod images;
mod lattice;
mod loads;
mod response;
mod settings;
mod solve;
mod state;
mod step;
mod wake;
mod workspace;

pub use edges::{EdgeKind, SheddingKinds};
pub use error::AirError;
pub use geometry::{
    Edge, JoinedColumns, JoinedEdge, MirrorPairs, NodeMotion, PanelEdge, Panels, SheddingSegment,
    Sheet, Surface, Topology, WakeColumn,
};
pub use images::Plane;
pub use lattice::Lattice;
pub use loads::{AirLoads, SurfaceLoads};
pub use settings::{
    AIR_VISCOSITY, AirSettings, CirculationRate, Convection, Friction, Gust, GustShape,
    LIQUID_DENSITY, LeadingEdge, LoadMethod, NEUTRAL_WIDTH, NewestRow, OVERLAP_SLOPE,
    ParticleSettings, SectionDrag, Spectrum, Turbulence, VortexLift, VortexStreet, Wind,
    viscosity_of_density,
};
pub use state::{AirState, ImpulseAccount, InnerFlow, Particles, WakeEvents, WakeSheet};
pub use wake::Filaments;
pub use wingbeat_vortex::{CoreModel, Method, Points, Stretching, Tally};
pub use workspace::AirWorkspace;
