//! Choices of the air model.

mod air;
mod choices;
mod particles;
mod section_drag;
mod street;
mod turbulence;
mod validate;
mod vortex_lift;
mod wind;

pub use air::{AIR_VISCOSITY, AirSettings, LIQUID_DENSITY, OVERLAP_SLOPE, viscosity_of_density};
pub use choices::{CirculationRate, Convection, LeadingEdge, LoadMethod, NewestRow};
pub use particles::ParticleSettings;
pub use section_drag::{Friction, SectionDrag};
pub use street::{NEUTRAL_WIDTH, VortexStreet};
pub use turbulence::{Spectrum, Turbulence};
pub use vortex_lift::VortexLift;
pub(crate) use vortex_lift::{ForceFactors, Passage};
pub use wind::{Gust, GustShape, Wind};
