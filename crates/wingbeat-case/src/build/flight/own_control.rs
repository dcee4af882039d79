//! What `[control]` says to a controller of the user's own: when it looks, when it acts, what it sees.

use std::sync::Arc;

use wingbeat_analysis::control::{Sensing, Sensors};
use wingbeat_flight::{ControlModel, Feedback};

use crate::build::fault::Built;
use crate::build::flight::control::{interval, lag, sensors, timing};
use crate::raw::{Case, ControlCase};

/// How `[control]` has a controller of the user's own look and act.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnControl {
    /// Time steps from one look to the next.
    pub interval: usize,
    /// Looks from one question to the controller to the next.
    pub every: usize,
    /// Looks from sensing to acting.
    pub latency: usize,
    /// Time constant of the actuators [s].
    pub lag: f64,
    /// Noise and bias of what it sees; none: the truth.
    pub sensors: Option<Sensors>,
}

impl OwnControl {
    /// Feedback by `controller`.
    pub fn feedback(&self, controller: Arc<dyn ControlModel>) -> Feedback {
        Feedback {
            controller: Arc::new(Sensing {
                controller,
                sensors: self.sensors,
                every: self.every,
            }),
            interval: self.interval,
            latency: self.latency,
            lag: self.lag,
        }
    }
}

/// What `[control]` says to a controller of the user's own.
pub(crate) fn own_control(case: &Case, control: &ControlCase) -> Built<OwnControl> {
    let timing = timing(case, control)?;
    Ok(OwnControl {
        interval: interval(case)? / control.looks_per_beat,
        every: control.every_beats,
        latency: timing.latency,
        lag: lag(case, control),
        sensors: control.sensors.as_ref().map(sensors),
    })
}
