//! Columns of feedback: commands and reference.

use crate::series::quantity::Components::Place;
use crate::series::quantity::Entry::{Count, Real};
use crate::series::quantity::{Frame, HistoryQuantity, Unit, scalar};

/// What feedback commands.
#[rustfmt::skip]
pub(super) const COMMANDS: &[HistoryQuantity] = &[
    scalar("command_{s}_stroke_amplitude", Unit::One, "relative change of the stroke of {s}",
        |r, s, _| Real(&mut r.commands[s].stroke_amplitude)),
    scalar("command_{s}_stroke_offset", Unit::Radian, "added to the stroke angle of {s}, positive forward",
        |r, s, _| Real(&mut r.commands[s].stroke_offset)),
    scalar("command_{s}_feathering_offset", Unit::Radian, "added to the feathering angle of {s}",
        |r, s, _| Real(&mut r.commands[s].feathering_offset)),
    scalar("command_{s}_feathering_amplitude", Unit::One, "relative change of the feathering of {s}",
        |r, s, _| Real(&mut r.commands[s].feathering_amplitude)),
    scalar("command_{s}_feathering_lead", Unit::Wingbeat, "lead of the feathering of {s}",
        |r, s, _| Real(&mut r.commands[s].feathering_lead)),
    scalar("command_{s}_deviation_offset", Unit::Radian,
        "added to the deviation of {s}, in the sense of a right wing",
        |r, s, _| Real(&mut r.commands[s].deviation_offset)),
    scalar("command_{s}_stroke_plane", Unit::Radian, "added to the pitch of the stroke plane of {s}",
        |r, s, _| Real(&mut r.commands[s].stroke_plane)),
    scalar("command_{s}_frequency", Unit::One, "relative change of the frequency of {s}",
        |r, s, _| Real(&mut r.commands[s].frequency)),
];

/// How often feedback looked.
#[rustfmt::skip]
pub(super) const LOOKS: &[HistoryQuantity] = &[
    scalar("looks", Unit::Count, "looks of feedback so far", |r, _, _| Count(&mut r.looks[0])),
    scalar("limited_looks", Unit::Count, "looks so far at which the command stood at a limit",
        |r, _, _| Count(&mut r.looks[1])),
];

/// How far from the attitude to be held the flyer is.
#[rustfmt::skip]
pub(super) const HELD: &[HistoryQuantity] = &[
    scalar("attitude_departure", Unit::Radian,
        "angle from the trimmed attitude that feedback held at its newest look",
        |r, _, _| Real(&mut r.attitude_departure[0])),
];

/// Where feedback is to bring the flyer.
#[rustfmt::skip]
pub(super) const REFERENCE: &[HistoryQuantity] = &[
    scalar("reference_{c}", Unit::Metre, "where the mass centre is to be",
        |r, _, c| Real(&mut r.reference[0].position[c])).along(Place, Frame::Inertial),
    scalar("reference_{c}_rate", Unit::MetrePerSecond, "velocity that it is to have",
        |r, _, c| Real(&mut r.reference[0].velocity[c])).along(Place, Frame::Inertial),
    scalar("reference_heading", Unit::Radian, "where the flyer is to head, about n3 from n1",
        |r, _, _| Real(&mut r.reference[0].heading)),
    scalar("reference_heading_rate", Unit::RadianPerSecond, "rate of that heading",
        |r, _, _| Real(&mut r.reference[0].heading_rate)),
];
