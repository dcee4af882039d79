//! Nodes: where they are, how they move with the frame that carries them, what acts on them, what follows them.

pub(crate) mod block;
pub(crate) mod configuration;
pub(crate) mod follower;
pub(crate) mod frame;
pub(crate) mod inertia;
pub(crate) mod loads;
pub(crate) mod screw;
