//! Columns of joints and loads.

use crate::series::quantity::Components::{Child, Inertial};
use crate::series::quantity::Entry::{Count, Real};
use crate::series::quantity::{Frame, HistoryQuantity, Unit, scalar};

#[rustfmt::skip]
pub(super) const CONNECTIONS: &[HistoryQuantity] = &[
    scalar("multiplier_{s}", Unit::Newton,
        "Lagrange multiplier of connection {s}, Roccia et al. (2011), eq. 11",
        |r, s, _| Real(&mut r.multipliers[s])).symbol("lambda"),
];

#[rustfmt::skip]
pub(super) const ORIENTATIONS: &[HistoryQuantity] = &[
    scalar("multiplier_{s}", Unit::NewtonMetre,
        "Lagrange multiplier of orientation {s}, Roccia et al. (2011), eq. 11",
        |r, s, _| Real(&mut r.multipliers[s])).symbol("lambda"),
];

#[rustfmt::skip]
pub(super) const HINGES: &[HistoryQuantity] = &[
    scalar("hinge_{s}_force_{c}", Unit::Newton, "force on {s} at its hinge",
        |r, s, c| Real(&mut r.hinges[s].force[c])).along(Inertial, Frame::Inertial),
    scalar("hinge_{s}_moment_{c}", Unit::NewtonMetre, "moment on {s} about its hinge",
        |r, s, c| Real(&mut r.hinges[s].moment[c])).along(Child, Frame::Own),
    scalar("hinge_{s}_power", Unit::Watt,
        "power at the hinge of {s}, positive when it feeds it: of its actuators, and on a free hinge of springs, dampers and stops",
        |r, s, _| Real(&mut r.hinges[s].power)),
];

#[rustfmt::skip]
pub(super) const LOOPS: &[HistoryQuantity] = &[
    scalar("loop_{s}_force_{c}", Unit::Newton, "force on the child of {s}, which closes a loop",
        |r, s, c| Real(&mut r.loops[s].force[c])).along(Inertial, Frame::Inertial),
    scalar("loop_{s}_moment_{c}", Unit::NewtonMetre, "moment on the child of {s}",
        |r, s, c| Real(&mut r.loops[s].moment[c])).along(Child, Frame::Own),
    scalar("loop_{s}_power", Unit::Watt, "power of the actuators, springs, dampers and stops of {s}",
        |r, s, _| Real(&mut r.loops[s].power)),
];

#[rustfmt::skip]
pub(super) const PASSIVE: &[HistoryQuantity] = &[
    scalar("passive_power", Unit::Watt,
        "power of springs, dampers and stops at all joints; what is left of the powers at hinges is that of actuators",
        |r, _, _| Real(&mut r.passive_power)),
    scalar("passive_work", Unit::Joule, "work of springs, dampers and stops at all joints so far",
        |r, _, _| Real(&mut r.passive_work)),
];

#[rustfmt::skip]
pub(super) const COORDINATES: &[HistoryQuantity] = &[
    scalar("joint_{s}", Unit::Coordinate, "{s}", |r, s, _| Real(&mut r.joints[s][0])).in_frame(Frame::Joint),
    scalar("joint_{s}_rate", Unit::CoordinateRate, "rate of the {s}",
        |r, s, _| Real(&mut r.joints[s][1])).in_frame(Frame::Joint),
];

#[rustfmt::skip]
pub(super) const DEFORMATION: &[HistoryQuantity] = &[
    scalar("deformation_{s}_power", Unit::Watt, "power of what deforms {s} against the air",
        |r, s, _| Real(&mut r.deformation_power[s])),
];

#[rustfmt::skip]
pub(super) const ELASTIC: &[HistoryQuantity] = &[
    scalar("tip_{s}_displacement_{c}", Unit::Metre,
        "displacement from rest of the middle of the tip's chord of {s}",
        |r, s, c| Real(&mut r.elastic[s].tip[c])).along(Child, Frame::Own),
    scalar("tip_{s}_twist", Unit::Radian, "twist of the tip of {s} from rest, positive like feathering",
        |r, s, _| Real(&mut r.elastic[s].twist)),
    scalar("deflection_quarter_{s}", Unit::Metre,
        "displacement along axis 3 from rest of the middle between leading and trailing edge at a quarter of the length of {s} from the root of its surface; a bulge between the edges is camber",
        |r, s, _| Real(&mut r.elastic[s].sections[0].deflection)),
    scalar("twist_quarter_{s}", Unit::Radian,
        "twist at a quarter of the length of {s} from the root of its surface from rest, positive like feathering",
        |r, s, _| Real(&mut r.elastic[s].sections[0].twist)),
    scalar("camber_quarter_{s}", Unit::One,
        "camber at a quarter of the length of {s} from the root of its surface: largest height over the chord, less that at rest, positive towards -axis 3 like prescribed camber",
        |r, s, _| Real(&mut r.elastic[s].sections[0].camber)),
    scalar("deflection_half_{s}", Unit::Metre,
        "displacement along axis 3 from rest of the middle between leading and trailing edge at half of the length of {s} from the root of its surface; a bulge between the edges is camber",
        |r, s, _| Real(&mut r.elastic[s].sections[1].deflection)),
    scalar("twist_half_{s}", Unit::Radian,
        "twist at half of the length of {s} from the root of its surface from rest, positive like feathering",
        |r, s, _| Real(&mut r.elastic[s].sections[1].twist)),
    scalar("camber_half_{s}", Unit::One,
        "camber at half of the length of {s} from the root of its surface: largest height over the chord, less that at rest, positive towards -axis 3 like prescribed camber",
        |r, s, _| Real(&mut r.elastic[s].sections[1].camber)),
    scalar("deflection_three_quarters_{s}", Unit::Metre,
        "displacement along axis 3 from rest of the middle between leading and trailing edge at three quarters of the length of {s} from the root of its surface; a bulge between the edges is camber",
        |r, s, _| Real(&mut r.elastic[s].sections[2].deflection)),
    scalar("twist_three_quarters_{s}", Unit::Radian,
        "twist at three quarters of the length of {s} from the root of its surface from rest, positive like feathering",
        |r, s, _| Real(&mut r.elastic[s].sections[2].twist)),
    scalar("camber_three_quarters_{s}", Unit::One,
        "camber at three quarters of the length of {s} from the root of its surface: largest height over the chord, less that at rest, positive towards -axis 3 like prescribed camber",
        |r, s, _| Real(&mut r.elastic[s].sections[2].camber)),
    scalar("deflection_tip_{s}", Unit::Metre,
        "displacement along axis 3 from rest of the middle between leading and trailing edge at the tip of {s}; a bulge between the edges is camber",
        |r, s, _| Real(&mut r.elastic[s].sections[3].deflection)),
    scalar("twist_tip_{s}", Unit::Radian, "twist of the tip section of {s} from rest, positive like feathering",
        |r, s, _| Real(&mut r.elastic[s].sections[3].twist)),
    scalar("camber_tip_{s}", Unit::One,
        "camber of the tip of {s}: largest height over the chord, less that at rest, positive towards -axis 3 like prescribed camber",
        |r, s, _| Real(&mut r.elastic[s].sections[3].camber)),
    scalar("air_power_{s}", Unit::Watt, "power of the air on what {s} moves relative to its frame",
        |r, s, _| Real(&mut r.elastic[s].air_power)),
    scalar("strain_power_{s}", Unit::Watt, "power that goes into the elastic energy of {s}",
        |r, s, _| Real(&mut r.elastic[s].strain_power)),
    scalar("strain_energy_{s}", Unit::Joule, "elastic energy of {s}",
        |r, s, _| Real(&mut r.elastic[s].strain_energy)),
    scalar("elastic_passes_{s}", Unit::Count,
        "most passes within the step that shape and loads of {s} took to agree",
        |r, s, _| Count(&mut r.elastic[s].passes)),
];

#[rustfmt::skip]
pub(super) const DISSIPATION: &[HistoryQuantity] = &[
    scalar("dissipated_energy", Unit::Joule, "energy that the damping of elastic wings has dissipated so far",
        |r, _, _| Real(&mut r.dissipated)),
];

#[rustfmt::skip]
pub(super) const AIR: &[HistoryQuantity] = &[
    scalar("air_{s}_force_{c}", Unit::Newton, "force of the air on {s}",
        |r, s, c| Real(&mut r.air[s].force[c])).along(Inertial, Frame::Inertial),
    scalar("air_{s}_moment_{c}", Unit::NewtonMetre, "moment of the air on {s} about its origin",
        |r, s, c| Real(&mut r.air[s].moment[c])).along(Inertial, Frame::Inertial),
];

#[rustfmt::skip]
pub(super) const APPLIED: &[HistoryQuantity] = &[
    scalar("applied_{s}_force_{c}", Unit::Newton, "applied force on {s}",
        |r, s, c| Real(&mut r.applied[s].force[c])).along(Inertial, Frame::Inertial),
    scalar("applied_{s}_moment_{c}", Unit::NewtonMetre, "applied moment on {s} about its origin",
        |r, s, c| Real(&mut r.applied[s].moment[c])).along(Inertial, Frame::Inertial),
];

#[rustfmt::skip]
pub(super) const TETHER: &[HistoryQuantity] = &[
    scalar("tether_force_{c}", Unit::Newton, "force of the tether on the body",
        |r, _, c| Real(&mut r.tether.force[c])).along(Inertial, Frame::Inertial),
    scalar("tether_moment_{c}", Unit::NewtonMetre, "moment of the tether on the body about its origin",
        |r, _, c| Real(&mut r.tether.moment[c])).along(Inertial, Frame::Inertial),
];
