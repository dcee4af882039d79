//! Keys that change nothing in this flight and are no contradiction: they are named, not refused.

use wingbeat_flight::AirModel;
use wingbeat_model::Wing;

use crate::loaded::LoadedCase;
use crate::raw::{ControllerCase, TargetCase};

impl LoadedCase {
    /// Which keys change nothing, in sentences.
    pub fn idle_keys(&self) -> Vec<String> {
        [
            self.idle_biases(),
            self.idle_motion(),
            self.idle_camber(),
            self.idle_frequency(),
            self.idle_body(),
        ]
        .concat()
    }

    /// A frequency at which nothing beats, in a flight whose steps are not counted by it.
    fn idle_frequency(&self) -> Vec<String> {
        let (setup, raw) = (&self.setup, &self.raw);
        let is_still = setup.animal.wings.iter().all(Wing::is_still);
        let counts = raw.time.step_s.is_none() || raw.time.steps.is_none();
        let acts = !is_still
            || counts
            || !setup.joints.is_empty()
            || setup.feedback.is_some()
            || raw.flight.held_beats > 0.0;
        let period = setup.time.period.filter(|_| !acts);
        period
            .map(|period| {
                format!(
                    "motion.frequency_hz moves nothing: no wing has angles that vary over the beat (wing.NAME.motion); the flight is divided into beats of {period:.4e} s for means, and no more"
                )
            })
            .into_iter()
            .collect()
    }

    /// A body that is to be part of the lattice and has no parts.
    fn idle_body(&self) -> Vec<String> {
        let raw = &self.raw;
        let asks = raw.air.body && self.gives("air.body");
        let is_lattice = matches!(self.setup.air, AirModel::VortexLattice(_));
        match is_lattice && asks && raw.body.part.is_empty() {
            true => vec!["air.body = true changes nothing: the body has no parts that the air could meet; give its shape in [body.part.NAME]".to_owned()],
            false => vec![],
        }
    }

    /// How the beat of wings starts whose angles are all constant, as those of wings on joints that springs or
    /// moments move.
    fn idle_motion(&self) -> Vec<String> {
        let (wings, motion) = (&self.setup.animal.wings, &self.raw.motion);
        if wings.is_empty() || !wings.iter().all(Wing::is_still) {
            return vec![];
        }
        let acts = |key: &&str| ["phase", "start", "start_beats"].contains(key);
        let keys = motion.unlike_default().into_iter().filter(acts);
        keys.map(|key| {
            format!("motion.{key} changes nothing: no wing has angles that vary over the beat (wing.NAME.motion), and laws of joints have phases of their own")
        })
        .collect()
    }

    /// Camber that blade elements leave out.
    fn idle_camber(&self) -> Vec<String> {
        let blades = matches!(self.setup.air, AirModel::BladeElement(_));
        let wings = self.raw.wing.iter().filter(|_| blades);
        let has = wings.filter(|(_, w)| {
            let deformation = w.deformation.as_ref();
            deformation.is_some_and(|d| !d.camber.is_empty())
        });
        has.map(|(name, _)| {
            format!("wing.{name}.deformation.camber changes nothing: blade elements take twist and bending of the wings; camber is in their coefficients, or fly in the vortex lattice")
        })
        .collect()
    }

    /// Biases of `control.sensors`: with `control.hold = "start"` the flight that is held is what the first look sees,
    /// bias and all.
    fn idle_biases(&self) -> Vec<String> {
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
