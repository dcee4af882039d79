//! All tests of the crate in one program: it is linked once.

mod air;
mod beats;
mod common;
mod coupled;
mod deforming;
mod steady;
mod unsteady;
