//! All tests of the crate in one program: it is linked once.

mod absurd;
mod angle_tables;
mod counterparts;
mod defaults;
mod differences;
mod held;
mod hinged;
mod idle;
mod insects;
mod joints;
mod keys;
mod measured;
mod meshes;
mod mirrored_joints;
mod outlines;
mod presets;
mod shedding;
mod slips;
mod table1;
mod tables;
mod times;
mod turns;
mod wingless;
mod wings;
mod wings_on_bodies;
mod written;
