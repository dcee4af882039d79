//! Columns of time and motion.

use crate::series::quantity::Components::{Angles, Inertial, Own, Place, Quaternion};
use crate::series::quantity::Entry::{Count, Real};
use crate::series::quantity::{Frame, HistoryQuantity, Unit, scalar};

#[rustfmt::skip]
pub(super) const TIME: &[HistoryQuantity] = &[
    scalar("step", Unit::Count, "number of the step, 0 is the start", |r, _, _| Count(&mut r.step)),
    scalar("time", Unit::Second, "time", |r, _, _| Real(&mut r.time)).symbol("t"),
];

#[rustfmt::skip]
pub(super) const PRESCRIBED: &[HistoryQuantity] = &[
    scalar("{s}_prescribed_{c}", Unit::Radian,
        "prescribed angle of {s}: stroke phi, deviation theta, feathering psi",
        |r, s, c| Real(&mut r.wing_angles[s][c])).along(Angles, Frame::Stroke),
];

#[rustfmt::skip]
pub(super) const POSES: &[HistoryQuantity] = &[
    scalar("{s}_{c}", Unit::Metre, "position of the origin of {s}",
        |r, s, c| Real(&mut r.coordinates[6 * s + c])).along(Place, Frame::Inertial).symbol("q"),
    scalar("{s}_{c}", Unit::Radian,
        "Euler angle of {s} (phi is the pitch of the body, theta yaw, psi roll), without jumps: of the two triples of an attitude, with whole turns, the one nearest to the row before (the first to zero)",
        |r, s, c| Real(&mut r.coordinates[6 * s + 3 + c])).along(Angles, Frame::Attitude).symbol("q"),
];

#[rustfmt::skip]
pub(super) const RATES: &[HistoryQuantity] = &[
    scalar("{s}_{c}_rate", Unit::MetrePerSecond, "velocity of the origin of {s}",
        |r, s, c| Real(&mut r.rates[6 * s + c])).along(Place, Frame::Inertial).symbol("q\u{0307}"),
    scalar("{s}_{c}_rate", Unit::RadianPerSecond, "rate of the Euler angle of {s}",
        |r, s, c| Real(&mut r.rates[6 * s + 3 + c])).along(Angles, Frame::Attitude).symbol("q\u{0307}"),
];

#[rustfmt::skip]
pub(super) const ROOT: &[HistoryQuantity] = &[
    scalar("body_quaternion_{c}", Unit::One, "unit quaternion of the body's attitude",
        |r, _, c| Real(&mut r.root_quaternion[c])).along(Quaternion, Frame::BodyToInertial).symbol("R_NB"),
    scalar("body_angular_velocity_{c}", Unit::RadianPerSecond, "angular velocity of the body",
        |r, _, c| Real(&mut r.root_angular_velocity[c])).along(Own, Frame::Own).symbol("w"),
    scalar("mass_centre_{c}", Unit::Metre, "mass centre of the whole animal",
        |r, _, c| Real(&mut r.mass_centre[c])).along(Inertial, Frame::Inertial),
];

#[rustfmt::skip]
pub(super) const ACCELERATIONS: &[HistoryQuantity] = &[
    scalar("{s}_acceleration_{c}", Unit::MetrePerSecond2, "acceleration of the origin of {s}",
        |r, s, c| Real(&mut r.accelerations[s].linear[c])).along(Inertial, Frame::Inertial),
    scalar("{s}_angular_acceleration_{c}", Unit::RadianPerSecond2, "angular acceleration of {s}",
        |r, s, c| Real(&mut r.accelerations[s].angular[c])).along(Own, Frame::Own),
];
