//! Velocity induced by straight vortex segments: the Biot-Savart sum.
//!
//! What it computes: for targets p the sum over segments a -> b of
//!
//! v(p) = Gamma/(4 pi) (r1 x r2) K,  r1 = p - a,  r2 = p - b,
//!
//! where K depends on |r1|, |r2|, r1.r2 and on the regularisation ([`CoreModel`]).
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | Gamma | `gamma` | m^2/s | circulation, right-handed about a -> b |
//! | r0 | `b - a` | m | the segment |
//! | h | | m | distance of p from the line through a and b, h = abs(r1 x r2)/abs(r0) |
//! | r_c | `radius` | m | core radius |
//! | core | `core` | see [`CoreModel::core`] | regularisation number of a segment |
//!
//! Vectors are in the inertial frame N.
//!
//! One sum, [`FastSum`], takes every segment at every target, in double or in single precision, or sums far
//! segments by the cells of a tree, expansions of bare filaments or interpolation of the kernel of wide ones,
//! or wide filaments of algebraic cores by Gaussians on meshes, to a tolerance that it checks at every call.
//!
//! Two more sum over vortex blobs: [`GaussianSum`] one by one or on a mesh, [`AlgebraicSum`] one by one, with the rate
//! at which blobs stretch each other.
//!
//! Promises: the same bits for every instruction set ([`InstructionSet`]) and any number of threads;
//! never NaN or infinite for finite input, on a node and on a filament included; nothing is
//! allocated after the first call with a given size.
//!
//! What it does not know: panels, wings, wakes, time.

mod cores;
mod direct;
mod fast;
mod gaussian_sum;
mod instruction_set;
mod interpolation;
mod multilevel;
mod particle_mesh;
mod preorder;
mod quadrature;
mod sources;
mod tree;
mod work;

pub use cores::{CoreModel, LAMB_ALPHA};
pub use direct::reference;
pub use direct::{AlgebraicSum, BLOCK, Stretching, UnitEdges, WINDOW, add_velocity};
pub use fast::{FastSettings, FastSum, MESH_TOLERANCE, Method, Report, Tally};
pub use gaussian_sum::{GaussianReport, GaussianSum};
pub use glam::DVec3;
pub use instruction_set::InstructionSet;
pub use sources::{Blob, Network, Points};
