//! Choices of the air model.

mod air;
mod choices;
mod particles;
mod section_drag;
mod turbulence;
mod validate;
mod wind;

pub use air::AirSettings;
pub use choices::{CirculationRate, Convection, LeadingEdge, LoadMethod, NewestRow};
pub use particles::ParticleSettings;
pub use section_drag::{Friction, SectionDrag};
pub use turbulence::{Spectrum, Turbulence};
pub use wind::{Gust, GustShape, Wind};
