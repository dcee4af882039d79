//! Evidence for the air, by kind: benchmark, invariances, conservation, limits, bodies, wakes.

mod answers;
mod benchmark;
mod bodies;
mod carry_through;
mod centre_of_pressure;
mod common;
mod errors;
mod held;
mod implicit_suction;
mod impulse;
mod impulse_account;
mod invariance;
mod joined_edges;
mod known_shapes;
mod leaving;
mod nodal;
mod particles;
mod peers;
mod plane_wakes;
mod planes;
mod section_drag;
mod separated;
mod swept;
mod vortex_lift;
mod wakes;
mod wings;
