//! What the air remembers from step to step: circulations and wakes.

mod air_state;
mod impulse_account;
mod initial;
mod inner_flow;
mod particles;
mod wake_sheet;

pub use air_state::{AirState, WakeEvents};
pub use impulse_account::ImpulseAccount;
pub use inner_flow::InnerFlow;
pub use particles::Particles;
pub use wake_sheet::WakeSheet;
