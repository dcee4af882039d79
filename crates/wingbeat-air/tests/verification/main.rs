//! Evidence for the air, by kind: benchmark, invariances, conservation, limits, bodies, wakes.

mod benchmark;
mod bodies;
mod common;
mod errors;
mod impulse;
mod invariance;
mod known_shapes;
mod particles;
mod peers;
mod seams;
mod section_drag;
mod wakes;
mod wings;
