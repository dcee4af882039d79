//! Every quantity that a history holds, in the order of its columns.

use crate::quantity::Components::{Angles, Child, Inertial, Own, Place, Quaternion};
use crate::quantity::Fold::{Largest, Smallest, Sum};
use crate::quantity::Frame;
use crate::quantity::Slot::{Count, Real};
use crate::quantity::{Group, Of, Quantity, Unit};

const fn group(of: Of, quantities: &'static [Quantity]) -> Group {
    Group { of, quantities }
}

const fn scalar(
    name: &'static str,
    unit: Unit,
    about: &'static str,
    slot: fn(&mut wingbeat_flight::Record, usize, usize) -> crate::quantity::Slot<'_>,
) -> Quantity {
    Quantity::scalar(name, unit, about, slot)
}

/// The columns, group after group.
pub(crate) const GROUPS: &[Group] = &[
    group(Of::Flight, TIME),
    group(Of::Wings, PRESCRIBED),
    group(Of::Bodies, POSES),
    group(Of::Bodies, RATES),
    group(Of::Flight, ROOT),
    group(Of::Bodies, ACCELERATIONS),
    group(Of::Connections, CONNECTIONS),
    group(Of::Orientations, ORIENTATIONS),
    group(Of::Children, HINGES),
    group(Of::Loops, LOOPS),
    group(Of::Coordinates, COORDINATES),
    group(Of::Deforming, DEFORMATION),
    group(Of::Bodies, AIR),
    group(Of::Bodies, APPLIED),
    group(Of::Flight, TETHER),
    group(Of::Flight, ENERGIES),
    group(Of::Flight, MOMENTA),
    group(Of::Flight, QUALITY),
    group(Of::Flight, WAKE),
    group(Of::Commanded, COMMANDS),
];

const TIME: &[Quantity] = &[
    scalar(
        "step",
        Unit::Count,
        "number of the step, 0 is the start",
        |r, _, _| Count(&mut r.step),
    ),
    scalar("time", Unit::Second, "time", |r, _, _| Real(&mut r.time)).symbol("t"),
];

const PRESCRIBED: &[Quantity] = &[scalar(
    "{s}_prescribed_{c}",
    Unit::Radian,
    "prescribed angle of {s}: stroke phi, deviation theta, feathering psi",
    |r, s, c| Real(&mut r.wing_angles[s][c]),
)
.along(Angles, Frame::Stroke)];

const POSES: &[Quantity] = &[
    scalar(
        "{s}_{c}",
        Unit::Metre,
        "position of the origin of {s}",
        |r, s, c| Real(&mut r.coordinates[6 * s + c]),
    )
    .along(Place, Frame::Inertial)
    .symbol("q"),
    scalar(
        "{s}_{c}",
        Unit::Radian,
        "Euler angle of {s}, without jumps of a turn",
        |r, s, c| Real(&mut r.coordinates[6 * s + 3 + c]),
    )
    .along(Angles, Frame::Attitude)
    .symbol("q"),
];

const RATES: &[Quantity] = &[
    scalar(
        "{s}_{c}_rate",
        Unit::MetrePerSecond,
        "velocity of the origin of {s}",
        |r, s, c| Real(&mut r.rates[6 * s + c]),
    )
    .along(Place, Frame::Inertial)
    .symbol("q\u{0307}"),
    scalar(
        "{s}_{c}_rate",
        Unit::RadianPerSecond,
        "rate of the Euler angle of {s}",
        |r, s, c| Real(&mut r.rates[6 * s + 3 + c]),
    )
    .along(Angles, Frame::Attitude)
    .symbol("q\u{0307}"),
];

const ROOT: &[Quantity] = &[
    scalar(
        "body_quaternion_{c}",
        Unit::One,
        "unit quaternion of the body's attitude",
        |r, _, c| Real(&mut r.root_quaternion[c]),
    )
    .along(Quaternion, Frame::BodyToInertial)
    .symbol("R_NB"),
    scalar(
        "body_angular_velocity_{c}",
        Unit::RadianPerSecond,
        "angular velocity of the body",
        |r, _, c| Real(&mut r.root_angular_velocity[c]),
    )
    .along(Own, Frame::Own)
    .symbol("w"),
    scalar(
        "mass_centre_{c}",
        Unit::Metre,
        "mass centre of the whole animal",
        |r, _, c| Real(&mut r.mass_centre[c]),
    )
    .along(Inertial, Frame::Inertial),
];

const ACCELERATIONS: &[Quantity] = &[
    scalar(
        "{s}_acceleration_{c}",
        Unit::MetrePerSecond2,
        "acceleration of the origin of {s}",
        |r, s, c| Real(&mut r.accelerations[s].linear[c]),
    )
    .along(Inertial, Frame::Inertial)
    .new_here(),
    scalar(
        "{s}_angular_acceleration_{c}",
        Unit::RadianPerSecond2,
        "angular acceleration of {s}",
        |r, s, c| Real(&mut r.accelerations[s].angular[c]),
    )
    .along(Own, Frame::Own)
    .new_here(),
];

const CONNECTIONS: &[Quantity] = &[scalar(
    "multiplier_{s}",
    Unit::Newton,
    "Lagrange multiplier of connection {s}, seed eq. 11",
    |r, s, _| Real(&mut r.multipliers[s]),
)
.symbol("lambda")];

const ORIENTATIONS: &[Quantity] = &[scalar(
    "multiplier_{s}",
    Unit::NewtonMetre,
    "Lagrange multiplier of orientation {s}, seed eq. 11",
    |r, s, _| Real(&mut r.multipliers[s]),
)
.symbol("lambda")];

const HINGES: &[Quantity] = &[
    scalar(
        "hinge_{s}_force_{c}",
        Unit::Newton,
        "force on {s} at its hinge",
        |r, s, c| Real(&mut r.hinges[s].force[c]),
    )
    .along(Inertial, Frame::Inertial),
    scalar(
        "hinge_{s}_moment_{c}",
        Unit::NewtonMetre,
        "moment on {s} about its hinge",
        |r, s, c| Real(&mut r.hinges[s].moment[c]),
    )
    .along(Child, Frame::Own),
    scalar(
        "hinge_{s}_power",
        Unit::Watt,
        "power of the actuators at the hinge of {s}, positive when they feed it",
        |r, s, _| Real(&mut r.hinges[s].power),
    ),
];

const LOOPS: &[Quantity] = &[
    scalar(
        "loop_{s}_force_{c}",
        Unit::Newton,
        "force on the child of {s}, which closes a loop",
        |r, s, c| Real(&mut r.loops[s].force[c]),
    )
    .along(Inertial, Frame::Inertial)
    .new_here(),
    scalar(
        "loop_{s}_moment_{c}",
        Unit::NewtonMetre,
        "moment on the child of {s}",
        |r, s, c| Real(&mut r.loops[s].moment[c]),
    )
    .along(Child, Frame::Own)
    .new_here(),
    scalar(
        "loop_{s}_power",
        Unit::Watt,
        "power of the actuators of {s}",
        |r, s, _| Real(&mut r.loops[s].power),
    )
    .new_here(),
];

const COORDINATES: &[Quantity] = &[
    scalar("joint_{s}", Unit::Coordinate, "{s}", |r, s, _| {
        Real(&mut r.joints[s][0])
    })
    .in_frame(Frame::Joint)
    .formerly("joint_coordinate_{s}", "rad_or_m"),
    scalar(
        "joint_{s}_rate",
        Unit::CoordinateRate,
        "rate of the {s}",
        |r, s, _| Real(&mut r.joints[s][1]),
    )
    .in_frame(Frame::Joint)
    .formerly("joint_rate_{s}", "rad_or_m_per_s"),
];

const DEFORMATION: &[Quantity] = &[scalar(
    "deformation_{s}_power",
    Unit::Watt,
    "power of what deforms {s} against the air",
    |r, s, _| Real(&mut r.deformation_power[s]),
)];

const AIR: &[Quantity] = &[
    scalar(
        "air_{s}_force_{c}",
        Unit::Newton,
        "force of the air on {s}",
        |r, s, c| Real(&mut r.air[s].force[c]),
    )
    .along(Inertial, Frame::Inertial),
    scalar(
        "air_{s}_moment_{c}",
        Unit::NewtonMetre,
        "moment of the air on {s} about its origin",
        |r, s, c| Real(&mut r.air[s].moment[c]),
    )
    .along(Inertial, Frame::Inertial),
];

const APPLIED: &[Quantity] = &[
    scalar(
        "applied_{s}_force_{c}",
        Unit::Newton,
        "applied force on {s}",
        |r, s, c| Real(&mut r.applied[s].force[c]),
    )
    .along(Inertial, Frame::Inertial),
    scalar(
        "applied_{s}_moment_{c}",
        Unit::NewtonMetre,
        "applied moment on {s} about its origin",
        |r, s, c| Real(&mut r.applied[s].moment[c]),
    )
    .along(Inertial, Frame::Inertial),
];

const TETHER: &[Quantity] = &[
    scalar(
        "tether_force_{c}",
        Unit::Newton,
        "force of the tether on the body",
        |r, _, c| Real(&mut r.tether.force[c]),
    )
    .along(Inertial, Frame::Inertial),
    scalar(
        "tether_moment_{c}",
        Unit::NewtonMetre,
        "moment of the tether on the body about its origin",
        |r, _, c| Real(&mut r.tether.moment[c]),
    )
    .along(Inertial, Frame::Inertial),
];

const ENERGIES: &[Quantity] = &[
    scalar(
        "kinetic_energy",
        Unit::Joule,
        "kinetic energy",
        |r, _, _| Real(&mut r.kinetic_energy),
    ),
    scalar(
        "potential_energy",
        Unit::Joule,
        "energy of weight, zero at the inertial origin",
        |r, _, _| Real(&mut r.potential_energy),
    ),
    scalar(
        "hinge_work",
        Unit::Joule,
        "work of the actuators of all joints so far",
        |r, _, _| Real(&mut r.hinge_work),
    ),
    scalar(
        "air_work",
        Unit::Joule,
        "work of the air so far, on deformation too",
        |r, _, _| Real(&mut r.air_work),
    ),
    scalar(
        "deformation_work",
        Unit::Joule,
        "work so far of what deforms the wings against the air",
        |r, _, _| Real(&mut r.deformation_work),
    ),
    scalar(
        "applied_work",
        Unit::Joule,
        "work of applied loads and tether so far",
        |r, _, _| Real(&mut r.applied_work),
    ),
    scalar(
        "energy_residual",
        Unit::Joule,
        "energy less that of the start less all work",
        |r, _, _| Real(&mut r.energy_residual),
    ),
];

const MOMENTA: &[Quantity] = &[
    scalar(
        "momentum_{c}",
        Unit::Momentum,
        "linear momentum",
        |r, _, c| Real(&mut r.momentum[c]),
    )
    .along(Inertial, Frame::Inertial),
    scalar(
        "angular_momentum_{c}",
        Unit::AngularMomentum,
        "angular momentum about the inertial origin",
        |r, _, c| Real(&mut r.angular_momentum[c]),
    )
    .along(Inertial, Frame::Inertial),
    scalar(
        "momentum_residual_{c}",
        Unit::Momentum,
        "momentum less that of the start less the impulse of all external forces",
        |r, _, c| Real(&mut r.momentum_residual[c]),
    )
    .along(Inertial, Frame::Inertial),
    scalar(
        "angular_momentum_residual_{c}",
        Unit::AngularMomentum,
        "the same for angular momentum",
        |r, _, c| Real(&mut r.angular_momentum_residual[c]),
    )
    .along(Inertial, Frame::Inertial),
];

const QUALITY: &[Quantity] = &[
    scalar(
        "violation_position",
        Unit::Metre,
        "largest violation of a connection constraint",
        |r, _, _| Real(&mut r.violation_position),
    )
    .fold(Largest),
    scalar(
        "violation_orientation",
        Unit::One,
        "largest violation of an orientation constraint",
        |r, _, _| Real(&mut r.violation_orientation),
    )
    .fold(Largest),
    scalar(
        "euler_regularity",
        Unit::One,
        "smallest |cos theta| of all bodies",
        |r, _, _| Real(&mut r.euler_regularity),
    )
    .fold(Smallest),
    scalar(
        "corrector_passes",
        Unit::Count,
        "corrector passes of the step",
        |r, _, _| Count(&mut r.corrector_passes),
    )
    .fold(Largest),
    scalar(
        "corrector_residual",
        Unit::One,
        "scaled residual of the last corrector pass",
        |r, _, _| Real(&mut r.corrector_residual),
    )
    .fold(Largest),
];

const WAKE: &[Quantity] = &[
    scalar(
        "vortex_impulse_{c}",
        Unit::Momentum,
        "impulse of all vorticity",
        |r, _, c| Real(&mut r.vortex_impulse[c]),
    )
    .along(Inertial, Frame::Inertial),
    scalar(
        "air_impulse_{c}",
        Unit::NewtonSecond,
        "impulse of the air's force on all bodies so far, by the trapezoidal rule over the steps",
        |r, _, c| Real(&mut r.air_impulse[c]),
    )
    .along(Inertial, Frame::Inertial)
    .new_here(),
    scalar(
        "wake_rings",
        Unit::Count,
        "rings of the wakes",
        |r, _, _| Count(&mut r.wake_rings),
    ),
    scalar(
        "wake_particles",
        Unit::Count,
        "vortex particles of the wakes",
        |r, _, _| Count(&mut r.wake_particles),
    ),
    scalar(
        "regularised",
        Unit::Count,
        "times a near-singular velocity was regularised",
        |r, _, _| Count(&mut r.regularised),
    )
    .fold(Sum),
    scalar(
        "leak_velocity",
        Unit::MetrePerSecond,
        "largest uniform leak velocity of closed surfaces",
        |r, _, _| Real(&mut r.leak_velocity),
    )
    .fold(Largest),
];

/// What feedback commands.
const COMMANDS: &[Quantity] = &[
    scalar(
        "command_{s}_stroke_amplitude",
        Unit::One,
        "relative change of the stroke of {s}",
        |r, s, _| Real(&mut r.commands[s].stroke_amplitude),
    ),
    scalar(
        "command_{s}_stroke_offset",
        Unit::Radian,
        "added to the stroke angle of {s}, positive forward",
        |r, s, _| Real(&mut r.commands[s].stroke_offset),
    ),
    scalar(
        "command_{s}_feathering_offset",
        Unit::Radian,
        "added to the feathering angle of {s}",
        |r, s, _| Real(&mut r.commands[s].feathering_offset),
    ),
    scalar(
        "command_{s}_feathering_amplitude",
        Unit::One,
        "relative change of the feathering of {s}",
        |r, s, _| Real(&mut r.commands[s].feathering_amplitude),
    ),
    scalar(
        "command_{s}_feathering_lead",
        Unit::Wingbeat,
        "lead of the feathering of {s}",
        |r, s, _| Real(&mut r.commands[s].feathering_lead),
    ),
    scalar(
        "command_{s}_deviation_offset",
        Unit::Radian,
        "added to the deviation of {s}, in the sense of a right wing",
        |r, s, _| Real(&mut r.commands[s].deviation_offset),
    ),
    scalar(
        "command_{s}_stroke_plane",
        Unit::Radian,
        "added to the pitch of the stroke plane of {s}",
        |r, s, _| Real(&mut r.commands[s].stroke_plane),
    ),
    scalar(
        "command_{s}_frequency",
        Unit::One,
        "relative change of the frequency of {s}",
        |r, s, _| Real(&mut r.commands[s].frequency),
    ),
];
