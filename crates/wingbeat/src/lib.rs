//! **wingbeat**, a simulator of flapping-wing flight: one multibody system, one unsteady vortex
//! lattice, integrated together.
//!
//! This crate re-exports the library crates under one roof; `command` is the command line, behind the feature `cli`,
//! which is on by default: `default-features = false` builds the library without it.
//!
//! | module | what it holds |
//! |---|---|
//! | [`math`] | rotations, Euler sequences, mass properties, integrators |
//! | [`model`] | the animal: meshes, masses, wing motion |
//! | [`dynamics`] | constrained multibody dynamics |
//! | [`vortex`] | Biot-Savart sums over vortex filaments and blobs |
//! | [`blade`] | blade elements, quasi-steady or with wakes of strips; stability derivatives |
//! | [`air`] | unsteady vortex lattice with free wakes |
//! | [`flight`] | the two together |
//! | [`analysis`] | analysis of flights |
//! | [`case`] | case files and presets |
//! | [`results`] | result directories: writer, readers, summary, exports |
//! | [`draw`] | figures, flight page, animation |
//! | [`campaign`] | thousands of flights from one file |
//! | [`verify`] | the verification suite |
//!
//! A flight from a preset, three steps long:
//!
//! ```
//! let overrides = ["time.steps_per_beat=100".to_owned(), "time.beats=0.03".to_owned()];
//! let case = wingbeat::case::LoadedCase::find("fruit-fly-vacuum", &overrides)?;
//! let mut flight = wingbeat::flight::Simulation::new(case.setup)?;
//! let start = flight.record().mass_centre;
//! while !flight.finished() {
//!     flight.step()?;
//! }
//! // After t = 0.15 ms the mass centre has fallen g t^2 / 2 = 1.1e-7 m (n3 is down).
//! let fallen = flight.record().mass_centre - start;
//! assert!((fallen.z - 0.5 * 9.81 * 1.5e-4_f64.powi(2)).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Everyday types are in [`prelude`]; a flight is a [`Flight`], a flight that was flown a [`Run`];
//! [`fly_all`] flies many over the processor's threads.
#![warn(missing_docs)]

extern crate self as wingbeat; // the command line is written as any other user of the library

#[cfg(feature = "cli")]
pub mod command;
mod facade;

pub use facade::{
    Beat, Error, FailedMember, Flight, Run, WatchedEnsemble, ensemble, ensemble_watched, fly_all,
    members_kept,
};

/// What a program that flies needs: `use wingbeat::prelude::*;`.
///
/// ```
/// use wingbeat::prelude::*;
/// let vacuum = Flight::preset("fruit-fly-vacuum")?; // starts to flap smoothly, from rest
/// let run = vacuum.start(StartState::default()).beats(0.2).fly()?;
/// let [start, end] = [&run.records[0], run.records.last().expect("a start at least")];
/// let fallen: DVec3 = end.mass_centre - start.mass_centre; // m; n3 points down
/// assert!((fallen.z - 0.5 * 9.81 * end.time.powi(2)).abs() < 1e-12);
/// # Ok::<(), Error>(())
/// ```
pub mod prelude {
    pub use crate::{Beat, Error, Flight, Run, fly_all};
    pub use wingbeat_air::{Gust, GustShape};
    pub use wingbeat_dynamics::{BodyMotion, Wrench};
    pub use wingbeat_flight::{
        Air, AirMemory, AirModel, AirOptions, AirScratch, BladeOptions, Controller, Feedback,
        FlightError, FlightSetup, Instant, MotionMode, Record, Sensed, Simulation, StartState,
    };
    pub use wingbeat_math::{DMat3, DVec3};
    pub use wingbeat_model::motion::Adjustment;
    pub use wingbeat_model::{Animal, Side, Wing, WingMotion};
}

pub use wingbeat_air as air;
pub use wingbeat_analysis as analysis;
pub use wingbeat_blade as blade;
pub use wingbeat_campaign as campaign;
pub use wingbeat_case as case;
pub use wingbeat_draw as draw;
pub use wingbeat_dynamics as dynamics;
pub use wingbeat_flight as flight;
pub use wingbeat_math as math;
pub use wingbeat_model as model;
pub use wingbeat_results as results;
pub use wingbeat_verify as verify;
pub use wingbeat_vortex as vortex;

/// The program of the page for programmers compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
