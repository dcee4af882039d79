//! How far a flight under feedback was from what it is to hold.

use serde::{Deserialize, Serialize};
use wingbeat_flight::record::rotation_of;
use wingbeat_flight::{FlightSetup, MotionMode, Record};
use wingbeat_math::{DMat3, DVec3};

/// The largest and the last of a number, in the unit of that number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    /// The largest \[1\] or \[deg\].
    pub largest: f64,
    /// The last \[1\] or \[deg\].
    pub last: f64,
}

impl Departure {
    fn take(&mut self, x: f64) {
        self.largest = self.largest.max(x);
        self.last = x;
    }
}

/// Departures of a flight under feedback, at its looks.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Departures {
    /// Part of the looks at which the command stood at a limit \[1\].
    pub limited: f64,
    /// Of the mass centre from where it is to be, in lengths of the longest wing \[1\], under a controller that holds
    /// the altitude and no other place that of its altitude; none where that is not known.
    pub place_wing_lengths: Option<Departure>,
    /// Of the attitude from the one that is held \[deg\]: the trimmed one where it is known, otherwise that at the
    /// release, turned to where the flyer is to head.
    pub attitude_deg: Departure,
    release: Option<Release>,
}

/// A flyer at its release.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Release {
    time: f64,
    centre: DVec3,
    /// Unit quaternion (w, x, y, z) of R_NB.
    attitude: [f64; 4],
    heading: f64,
}

impl Departures {
    /// Of a flight of `setup` before its start; none without feedback.
    pub(super) fn of(setup: &FlightSetup) -> Option<Self> {
        setup.feedback.as_ref().map(|_| Self::default())
    }

    /// Takes the next step; only looks after the release count.
    pub(super) fn take(&mut self, r: &Record, setup: &FlightSetup) {
        let (Some(feedback), MotionMode::Free(start)) = (&setup.feedback, &setup.mode) else {
            return;
        };
        let [looks, limited] = r.looks;
        self.limited = limited as f64 / looks.max(1) as f64;
        let since = r.step.checked_sub(start.held_steps);
        if since.is_none_or(|steps| !steps.is_multiple_of(feedback.interval)) {
            return;
        }
        let aim = r.reference.first();
        let heading = aim.map_or(0.0, |aim| aim.heading);
        let release = *self.release.get_or_insert(Release {
            time: r.time,
            centre: r.mass_centre,
            attitude: r.root_quaternion,
            heading,
        });
        let turn = DMat3::from_rotation_z(heading - release.heading);
        let now = r.root_rotation();
        let turned = (turn * rotation_of(release.attitude)).transpose() * now;
        let cosine = 0.5 * (turned.x_axis.x + turned.y_axis.y + turned.z_axis.z - 1.0);
        let from_release = cosine.clamp(-1.0, 1.0).acos();
        // Histories of older builds lack the departure from the trimmed attitude.
        let known = r.attitude_departure.first().filter(|x| x.is_finite());
        let angle = known.copied().unwrap_or(from_release);
        self.attitude_deg.take(angle.to_degrees());
        let straight = |v: DVec3| release.centre + (r.time - release.time) * v;
        let place = aim.map(|aim| aim.position);
        let place = place.or_else(|| feedback.controller.velocity(setup).map(straight));
        if let Some(place) = place {
            let off = r.mass_centre - place;
            let away = match feedback.controller.holds_only_altitude() {
                true => off.dot(setup.gravity.normalize_or(DVec3::Z)).abs(),
                false => off.length(),
            };
            let away = away / setup.animal.wing_length();
            self.place_wing_lengths.get_or_insert_default().take(away);
        }
    }
}
