//! Prescribed angles of the wings, step after step.

use wingbeat_dynamics::{Cycle, System};
use wingbeat_math::DVec3;

use crate::equations::stages::cycle;
use crate::interface::record::Record;
use crate::setup::FlightSetup;
use crate::simulation::control::FeedbackLoop;

/// Angles of the wings: known beforehand where their motion repeats itself in whole steps.
pub(super) struct WingAngles {
    /// All wings at a step, then at the next.
    beat: Option<(Cycle, Vec<DVec3>)>,
}

impl WingAngles {
    /// Of a flight of `setup`, whose bodies are `system`.
    pub fn new(setup: &FlightSetup, system: &System) -> Self {
        // What a joint turns by a law of its own is not the wing's motion.
        let own = setup.joints.iter().all(|j| j.law.is_none());
        let beat = cycle(setup, system).filter(|_| own).map(|cycle| {
            let times = (0..=cycle.last()).map(|k| k as f64 * setup.time.step);
            (cycle, times.flat_map(|t| angles(setup, t)).collect())
        });
        Self { beat }
    }

    /// Puts the angles phi, theta, psi at step number `step` and the commands of feedback into the record.
    pub fn write(
        &self,
        setup: &FlightSetup,
        feedback: Option<&FeedbackLoop>,
        step: usize,
        r: &mut Record,
    ) {
        r.wing_angles.clear();
        r.commands.clear();
        let t = step as f64 * setup.time.step;
        match (feedback, &self.beat) {
            (Some(feedback), _) => {
                r.wing_angles.extend(feedback.angles(t));
                r.commands.extend_from_slice(feedback.commands());
                r.looks = [feedback.look(), feedback.limited_looks()];
            }
            (None, Some((cycle, known))) => {
                let wings = setup.animal.wings.len();
                let from = wings * cycle.fold(step);
                (r.wing_angles).extend_from_slice(&known[from..from + wings]);
            }
            (None, None) => r.wing_angles.extend(angles(setup, t)),
        }
    }
}

/// Angles phi, theta, psi of the wings at time `t` [s] without feedback.
fn angles(setup: &FlightSetup, t: f64) -> impl Iterator<Item = DVec3> {
    let value = |a: [[f64; 3]; 3]| DVec3::new(a[0][0], a[1][0], a[2][0]);
    let wings = setup.animal.wings.iter();
    wings.map(move |w| value(w.motion.angles(t)))
}
