//! Evidence for the air, by kind: benchmark, invariances, conservation, limits, bodies, wakes.

mod benchmark;
mod common;
