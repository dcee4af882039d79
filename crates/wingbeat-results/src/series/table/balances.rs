//! Columns of balances, quality and wakes.

use crate::series::quantity::Components::Inertial;
use crate::series::quantity::Entry::{Count, Real};
use crate::series::quantity::Fold::{Largest, Smallest, Sum};
use crate::series::quantity::{Frame, HistoryQuantity, Unit, scalar};

#[rustfmt::skip]
pub(super) const ENERGIES: &[HistoryQuantity] = &[
    scalar("kinetic_energy", Unit::Joule, "kinetic energy", |r, _, _| Real(&mut r.kinetic_energy)),
    scalar("potential_energy", Unit::Joule,
        "energy of weight, zero at the inertial origin, and elastic energy of wings",
        |r, _, _| Real(&mut r.potential_energy)),
    scalar("hinge_work", Unit::Joule, "work at all joints so far: of actuators, springs, dampers and stops",
        |r, _, _| Real(&mut r.hinge_work)),
    scalar("positive_work", Unit::Joule,
        "work of actuators and of prescribed deformation so far where it is positive, joint by joint: what is given if nothing comes back",
        |r, _, _| Real(&mut r.positive_work)),
    scalar("air_work", Unit::Joule, "work of the air so far, on deformation too",
        |r, _, _| Real(&mut r.air_work)),
    scalar("deformation_work", Unit::Joule, "work so far of what deforms the wings against the air",
        |r, _, _| Real(&mut r.deformation_work)),
    scalar("applied_work", Unit::Joule, "work of applied loads and tether so far",
        |r, _, _| Real(&mut r.applied_work)),
    scalar("energy_residual", Unit::Joule,
        "energy less that of the start less all work, with what was dissipated; what a jump of the velocity at a release changes is left out",
        |r, _, _| Real(&mut r.energy_residual)),
];

#[rustfmt::skip]
pub(super) const MOMENTA: &[HistoryQuantity] = &[
    scalar("momentum_{c}", Unit::Momentum, "linear momentum",
        |r, _, c| Real(&mut r.momentum[c])).along(Inertial, Frame::Inertial),
    scalar("angular_momentum_{c}", Unit::AngularMomentum, "angular momentum about the inertial origin",
        |r, _, c| Real(&mut r.angular_momentum[c])).along(Inertial, Frame::Inertial),
    scalar("momentum_residual_{c}", Unit::Momentum,
        "momentum less that of the start less the impulse of all external forces",
        |r, _, c| Real(&mut r.momentum_residual[c])).along(Inertial, Frame::Inertial),
    scalar("momentum_residual_of_works_{c}", Unit::Momentum,
        "momentum less that of the start less the impulse of all external forces as works are integrated: in a frame of velocity u the energy residual is less by u times this one",
        |r, _, c| Real(&mut r.momentum_residual_of_works[c])).along(Inertial, Frame::Inertial),
    scalar("angular_momentum_residual_{c}", Unit::AngularMomentum, "the same for angular momentum",
        |r, _, c| Real(&mut r.angular_momentum_residual[c])).along(Inertial, Frame::Inertial),
];

#[rustfmt::skip]
pub(super) const QUALITY: &[HistoryQuantity] = &[
    scalar("violation_position", Unit::Metre, "largest violation of a connection constraint",
        |r, _, _| Real(&mut r.violation_position)).fold(Largest),
    scalar("violation_orientation", Unit::One, "largest violation of an orientation constraint",
        |r, _, _| Real(&mut r.violation_orientation)).fold(Largest),
    scalar("euler_regularity", Unit::One, "smallest |cos theta| of all bodies",
        |r, _, _| Real(&mut r.euler_regularity)).fold(Smallest),
    scalar("corrector_passes", Unit::Count, "corrector passes of the step",
        |r, _, _| Count(&mut r.corrector_passes)).fold(Largest),
    scalar("corrector_residual", Unit::One, "scaled residual of the last corrector pass",
        |r, _, _| Real(&mut r.corrector_residual)).fold(Largest),
];

#[rustfmt::skip]
pub(super) const WAKE: &[HistoryQuantity] = &[
    scalar("vortex_impulse_{c}", Unit::Momentum,
        "impulse of all vorticity, less the momentum of the air that moving bodies of the lattice displace; with vortex particles, whose vorticity does not close, it depends on the origin, of half a model on a wall its part across the wall does",
        |r, _, c| Real(&mut r.vortex_impulse[c])).along(Inertial, Frame::Inertial),
    scalar("air_impulse_{c}", Unit::NewtonSecond,
        "impulse of the air's force on all bodies so far, by the trapezoidal rule over the steps",
        |r, _, c| Real(&mut r.air_impulse[c])).along(Inertial, Frame::Inertial),
    scalar("dynamic_impulse", Unit::NewtonSecond,
        "impulse of the dynamic pressure on all wings so far: 1/2 rho times the squared velocity of the feathering axis through the undisturbed air, over area and time; nothing where the density of the air is not known",
        |r, _, _| Real(&mut r.dynamic_impulse)),
    scalar("inviscid_impulse_{c}", Unit::NewtonSecond,
        "impulse of the air's inviscid force on all bodies so far: with the suction that pressures lack, without friction",
        |r, _, c| Real(&mut r.inviscid_impulse[c])).along(Inertial, Frame::Inertial),
    scalar("impulse_created_{c}", Unit::Momentum,
        "impulse that surfaces have given to the vorticity so far: by its circulation, by their motion, by what they shed; how much of the whole this is depends on the inertial frame",
        |r, _, c| Real(&mut r.impulse_account.created[c])).along(Inertial, Frame::Inertial),
    scalar("impulse_moved_{c}", Unit::Momentum,
        "impulse that free wakes have gained so far as they moved; with the one created it is the vortex impulse, in which their parts depend on the inertial frame",
        |r, _, c| Real(&mut r.impulse_account.moved[c])).along(Inertial, Frame::Inertial),
    scalar("impulse_converted_{c}", Unit::Momentum,
        "impulse gained so far where rings became particles, nothing but roundings",
        |r, _, c| Real(&mut r.impulse_account.converted[c])).along(Inertial, Frame::Inertial),
    scalar("impulse_cut_{c}", Unit::Momentum,
        "impulse that wakes had when they were dropped, so far; it counts in the vortex impulse; with vortex particles it depends on the origin",
        |r, _, c| Real(&mut r.impulse_account.cut[c])).along(Inertial, Frame::Inertial),
    scalar("impulse_absorbed_{c}", Unit::Momentum,
        "impulse that surfaces took so far from wakes that they held back; it counts in the vortex impulse",
        |r, _, c| Real(&mut r.impulse_account.absorbed[c])).along(Inertial, Frame::Inertial),
    scalar("impulse_residual_{c}", Unit::Momentum,
        "vortex impulse and inviscid impulse together, less those of the start: nothing where wakes carry no force, in still air without a ground and without particles",
        |r, _, c| Real(&mut r.impulse_residual[c])).along(Inertial, Frame::Inertial),
    scalar("wake_rings", Unit::Count, "rings of the wakes", |r, _, _| Count(&mut r.wake_rings)),
    scalar("wake_particles", Unit::Count, "vortex particles of the wakes",
        |r, _, _| Count(&mut r.wake_particles)),
    scalar("regularised", Unit::Count, "times a near-singular velocity was regularised; with air.mirror on the half computed, as the two that follow",
        |r, _, _| Count(&mut r.regularised)).fold(Sum),
    scalar("limited", Unit::Count,
        "ways of wake nodes (air.max_displacement_m) and strengths of particles that were limited, and leading edges that shed what they had too much: all among the regularised",
        |r, _, _| Count(&mut r.limited)).fold(Sum),
    scalar("leading_rings", Unit::Count,
        "wake rings with circulation that left leading edges, with air.mirror on the half computed",
        |r, _, _| Real(&mut r.leading_rings)).fold(Sum),
    scalar("net_flux_residual", Unit::MetrePerSecond,
        "largest net-flux residual of closed surfaces, a uniform normal velocity",
        |r, _, _| Real(&mut r.net_flux_residual)).fold(Largest),
];
