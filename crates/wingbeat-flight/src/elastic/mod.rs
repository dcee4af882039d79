//! Wings that loads bend: elastic bodies on the frames of the wings, coupled with the air.
//!
//! Within a step, at given motions and accelerations of the bodies, shape and loads are brought to agree
//! (`coupling`): each pass, Newton's iteration brings an elastic body to balance under loads that follow its
//! motion as the air has answered to it (`step`, `tangent`); what passes have shown accelerates them
//! ([`Secants`](wingbeat_math::Secants)). Of wings that are mirror images of each other, in air of which one
//! half is computed, one is brought to balance (`image`). The multibody system sees a wing as the rigid body it
//! is at rest; what the elastic one does to it besides is a load ([`ElasticWings::wrenches`]), its answer to
//! accelerations an added mass, and its momentum part of that of the flyer.

mod balance;
mod coupling;
mod image;
mod span;
mod step;
mod tangent;
mod wing;
mod wings;

pub use coupling::{ElasticScratch, MAX_PASSES};
pub use wing::{ElasticState, ElasticWing};
pub use wings::ElasticWings;
