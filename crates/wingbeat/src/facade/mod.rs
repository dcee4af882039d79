//! Flights as values: built, flown and read without case files or result directories.

mod batch;
mod ensemble;
mod error;
mod flight;
mod run;

pub use batch::fly_all;
pub use ensemble::{FailedMember, WatchedEnsemble, ensemble, ensemble_watched, members_kept};
pub use error::Error;
pub use flight::Flight;
pub use run::{Beat, Run};
