//! All tests of the crate in one program: it is linked once.

mod bent_wings;
mod columns;
mod flights;
mod gaps;
mod history;
mod impulse;
mod in_play;
mod mutations;
mod passive_joints;
mod still_air;
mod summary;
mod told;
mod turned_over;
mod warnings;
