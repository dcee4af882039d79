//! All tests of the crate in one program: it is linked once.

mod added_mass;
mod common;
mod conservation;
mod convergence;
mod driven;
mod formulations;
mod joints;
mod mechanism_motions;
mod mechanisms;
mod mobility;
mod refusals;
mod solutions;
mod spherical;
mod tether;
mod verification;
