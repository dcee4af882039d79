//! Biases of sensors that a flight under feedback takes for the flight that it holds.

use crate::loaded::LoadedCase;
use crate::raw::{ControllerCase, TargetCase};

impl LoadedCase {
    /// Which biases of `control.sensors` change nothing, in sentences: with `control.hold = "start"` the flight that is
    /// held is what the first look sees, bias and all.
    pub fn idle_biases(&self) -> Vec<String> {
        let control = self.raw.control.as_ref();
        let Some(control) = control.filter(|_| self.setup.feedback.is_some()) else {
            return vec![];
        };
        let held_as_seen = control.hold == TargetCase::Start
            && matches!(
                control.controller,
                ControllerCase::Regulator | ControllerCase::Stabiliser
            );
        let Some(sensors) = control.sensors.as_ref().filter(|_| held_as_seen) else {
            return vec![];
        };
        let biases = [
            ("velocity_bias_m_s", sensors.velocity_bias_m_s),
            ("tilt_bias_deg", sensors.tilt_bias_deg),
            ("rate_bias_deg_s", sensors.rate_bias_deg_s),
        ];
        let given = biases.iter().filter(|(_, bias)| *bias != [0.0; 3]);
        given
            .map(|(key, bias)| {
                format!(
                    "control.sensors.{key} = {bias:?} changes next to nothing: with control.hold = \"start\" the flight that is held is what the first look sees, bias and all; control.hold = \"trim\" holds one that is known"
                )
            })
            .collect()
    }
}
