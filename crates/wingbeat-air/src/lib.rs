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
//! Old rows of wake, or those of leading edges at once, can become vortex [`particles`].
//!
//! Surfaces may change their shape: their nodes move as the caller says. [`seams`] joins surfaces to
//! one; [`section_drag`] adds friction and profile drag.
//!
//! What this crate does not know: coordinates, joints, animals, gravity, files. What the method
//! does not know: viscosity (no friction drag of its own, wakes do not decay unless their cores grow),
//! separation other than at the edges told to shed. Forces are pressure times normal unless
//! [`LoadMethod`] says otherwise, so without the suction at edges that do not shed.

mod circulation;
mod closed;
mod contact;
pub mod error;
pub mod filaments;
mod front;
pub mod images;
mod influence;
mod joukowski;
pub mod lattice;
pub mod loads;
mod own;
pub mod panels;
mod particle_motion;
pub mod particles;
mod pressure;
mod rings;
mod row_blocks;
pub mod seams;
pub mod section_drag;
pub mod settings;
pub mod state;
pub mod strips;
mod summation;
pub mod surface;
pub mod topology;
pub mod twins;
mod wake;
pub mod wind;

pub use error::AirError;
pub use images::Plane;
pub use lattice::Lattice;
pub use loads::{AirLoads, AirWorkspace, SurfaceLoads};
pub use panels::Panels;
pub use particles::{ParticleSettings, Particles};
pub use seams::Seam;
pub use section_drag::{Friction, SectionDrag};
pub use settings::{
    AirSettings, CirculationRate, Convection, LeadingEdge, LoadMethod, NewestRow, SheddingKinds,
};
pub use state::{AirState, NodeMotion, WakeEvents, WakeSheet};
pub use surface::{EdgeKind, SheddingSegment, Surface};
pub use twins::Twins;
pub use wind::{Gust, GustShape, Wind};
pub use wingbeat_vortex::{CoreModel, Method, Points, Stretching};
