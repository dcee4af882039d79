//! Evidence for the air, by kind: benchmark, invariances, conservation, limits, bodies, wakes.

mod benchmark;
mod bodies;
mod common;
mod errors;
mod impulse;
mod invariance;
mod particles;
mod peers;
mod wakes;
mod wings;
