//! Coupled flight: multibody dynamics and unsteady air, integrated together.
//!
//! The chapter in order: [`setup`] says what a flight is made of; [`joints`] and `bodies` map the animal to the
//! multibody system; `interface` is what is asked of the air, whose models stand in [`air`]; `equations` is the
//! coupled right-hand side; `stages` and `core` choose between free, tethered and held; [`simulation`]
//! integrates all of it with Hamming's predictor-corrector (or, without a wake, another method of `solver`),
//! the wake frozen during corrector passes (seed sec. 4 and 5); `recorder` turns every accepted step into a
//! [`Record`].
//!
//! Stated orders: bodies and balances fourth (Hamming's method); the air of the benchmark
//! discretisation first (explicit Euler wake, backward circulation rate); so a coupled flight
//! converges at first order in the step, bodies alone at fourth.
//!
//! | symbol | name in code | meaning | seed |
//! |---|---|---|---|
//! | q | [`Record::coordinates`] | absolute coordinates of all bodies, N frame [m, rad] | eq. 2 |
//! | lambda | [`Record::multipliers`] | Lagrange multipliers \[N, N m\] | eq. 11 |
//! | h | [`setup::TimeGrid::step`] | time step \[s\] | - |
//!
//! This is the only crate that sees both bodies and air. It does not know files, units other than
//! SI, or clocks.
#![warn(missing_docs)]

pub mod air;
mod air_past;
mod applied;
mod bodies;
mod bound_core;
mod carried;
pub mod control;
mod controller;
mod core;
mod dynamic_pressure;
mod edge_ahead;
pub mod elastic;
mod equations;
mod error;
mod felt;
mod free;
mod impossible;
mod interface;
mod joint_steps;
pub mod joints;
mod late_gusts;
mod light;
mod memory;
mod mirrored;
mod on_bodies;
mod prescribed;
mod quadratures;
pub mod record;
mod recorder;
mod scattered;
pub mod setup;
mod shed_by_motion;
pub mod simulation;
mod solver;
mod stages;
mod starts_apart;
mod turned_over;
mod turns;
mod unjoined;
mod validate;

pub use air::{check_joined, strips};
pub use bodies::{
    JointCoordinate, WingLaw, check_assembly, doubtful_masses, joint_coordinates, loop_names,
    natural_units, system, system_of, system_with,
};
pub use control::Passage;
pub use controller::{Aim, Controller, Sensed};
pub use error::FlightError;
pub use felt::FeltAir;
pub use free::{FreeFlight, FreeFlightScratch};
pub use impossible::CrossingWings;
pub use interface::{
    Air, AirScratch, Announcement, ExternalAir, ExternalSession, Instant, Shape, WingInertia,
    WingResponse,
};
pub use joint_steps::{JointSteps, growing_joint, inertia_about};
pub use joints::{closes_loop, faster, is_driven};
pub use memory::AirMemory;
pub use record::{
    ElasticRecord, ParticleSnapshot, Record, STATIONS, SectionRecord, Snapshot, SurfaceSnapshot,
    WakeSnapshot,
};
pub use recorder::Ledger;
pub use setup::*;
pub use simulation::{FlightState, Past, Simulation};
