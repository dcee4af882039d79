//! Coupled flight: multibody dynamics and unsteady air, integrated together.
//!
//! The chapter in order: [`setup`] says what a flight is made of; [`joints`] and `bodies` map the animal to the
//! multibody system, `applied` adds loads and springs; `interface` is what is asked of the air, whose models
//! stand in [`air`]; `carried` and `light` are the air that wings carry along, and the flyers that weigh little
//! beside it, [`elastic`] the wings that loads bend; `equations` is the coupled right-hand side; `stages`
//! choose between free, `tethered` and held; [`control`] looks in between and adjusts the wings;
//! [`simulation`] integrates all of it with Hamming's predictor-corrector (or, without a wake, another method of
//! `solver`), the wake frozen during corrector passes (seed sec. 4 and 5); `recorder` turns every accepted step
//! into a [`Record`]. `doubts` says beforehand what of a setup is likely to be a mistake; nothing hangs on it.
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
mod bodies;
mod carried;
mod doubts;
pub mod elastic;
mod equations;
mod error;
mod interface;
pub mod setup;
pub mod simulation;

pub use air::{EdgeOnPlane, check_joined, check_joined_tip, strips};
pub use bodies::joint_steps::{JointSteps, growing_joint, inertia_about};
pub use bodies::joints::{self, closes_loop, faster};
pub use bodies::{
    JointCoordinate, WingLaw, check_assembly, doubtful_masses, joint_coordinates, loop_names,
    natural_units, system, system_of,
};
pub use doubts::stops::StruckStops;
pub use doubts::turned_over::TurnedOver;
pub use doubts::{CrossingWings, Doubt, DoubtKind};
pub use equations::free::{FreeFlight, FreeFlightScratch};
pub use error::{FlightError, RESUME_AS_SAVED};
pub use interface::air_probe::AirProbe;
pub use interface::controller::{Aim, Controller, Sensed};
pub use interface::memory::AirMemory;
pub use interface::record::{
    self, ElasticRecord, ParticleSnapshot, Record, STATIONS, SectionRecord, Snapshot,
    SurfaceSnapshot, WakeSnapshot,
};
pub use interface::{
    Air, AirScratch, Announcement, BentShape, ExternalAir, ExternalSession, Instant, WingInertia,
    WingResponse,
};
pub use setup::*;
pub use simulation::control::{self, MotionBlend};
pub use simulation::recorder::Ledger;
pub use simulation::{FlightState, Past, Simulation};
