//! Which cases leave room for a controller of the user's own, and what their `[control]` says to it.

use crate::build::{OwnControl, own_control};
use crate::error::CaseError;
use crate::loaded::LoadedCase;
use crate::raw::ControllerCase;

/// Keys of `[control]` that are about any controller, and act on one of the user's own.
const OF_ANY: [&str; 5] = [
    "sensors",
    "looks_per_beat",
    "every_beats",
    "latency_beats",
    "lag_beats",
];

impl LoadedCase {
    /// What `[control]` says to a controller of the user's own; none without the table. That is for cases with
    /// `controller = "none"`, where keys stand by, and for those whose `[control]` has keys of any controller alone.
    ///
    /// # Errors
    /// A case with a controller of its own; times that no look falls on.
    pub fn own_control(&self) -> Result<Option<OwnControl>, Box<CaseError>> {
        let Some(control) = &self.raw.control else {
            return Ok(None);
        };
        let is_for_one = |key: &&str| !OF_ANY.contains(key);
        let given = self.keys_in("control");
        if control.controller != ControllerCase::None && given.iter().any(is_for_one) {
            return Err(Box::new(self.fault(
                "control.controller",
                "the case has a controller already".to_owned(),
                "set(\"control.controller\", \"none\") first",
            )));
        }
        let own = own_control(&self.raw, control);
        own.map(Some).map_err(|fault| Box::new(self.located(fault)))
    }
}
