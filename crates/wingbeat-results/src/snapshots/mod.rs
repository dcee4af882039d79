//! Snapshots in space: surfaces, wakes and particles of single steps for ParaView, written and read back.

mod arrays;
pub mod frames;
pub mod particles;
pub mod poses;
pub mod vtp;
