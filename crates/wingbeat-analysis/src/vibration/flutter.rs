//! Flutter: when the vibrations of elastic wings in a stream grow.
//!
//! At each speed the wings are flown to their deformed steady state with much damping, first with long steps
//! (`settling`). From there two flights go on with the damping of the wings themselves, one of them with small
//! velocities added in the leading modes of each deformed wing (`disturbance`). The difference of the two is the
//! response of the system linearised about the deformed state, wakes and all; [`realise_sampled`] finds its
//! eigenvalues, in the response of each wing. Wings that are mirror images of each other, deformation and all, are
//! disturbed as such, or against each other. Growth that changes its sign between speeds is an onset or an end of
//! flutter ([`crossings`]),
//! if it differs from zero by more than is not known of it (`uncertainty`). The disturbance of half the size
//! tells how far the response is linear; where it is not, the disturbance is made smaller (`response`).
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | V | [`Condition::speed`] | speed of the stream | m/s |
//! | sigma | [`Vibration::growth`] | growth of a mode | 1/s |
//! | - | [`Condition::uncertainty`] | what is not known of sigma | 1/s |
//! | omega | [`Vibration::frequency`] | angular frequency of a mode | rad/s |
//!
//! A motion that grows without vibrating is static divergence ([`Condition::divergence`]); wings with incidence
//! pass it by a steep rise of the steady deflection ([`steep`]).
//!
//! The step of the setup goes with the speed: the stream passes the same way in a step as in the setup.

mod condition;
mod deflection;
mod disturbance;
mod images;
mod onset;
mod response;
mod sampling;
mod settings;
mod settling;
mod steady;
mod uncertainty;

pub use crate::vibration::realisation::{
    NOISE, Realisation, Sampled, Vibration, realise, realise_sampled,
};
pub use condition::{Condition, MAX_DAMPING, MIN_SHARE, condition};
pub use deflection::{Steep, steep};
pub use onset::{Onset, by_wing, crossings, growing, likely};
pub use settings::FlutterSettings;
pub use steady::{ElasticRig, SteadyWing};
