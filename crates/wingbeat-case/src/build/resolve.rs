//! From the raw case to the resolved one: keys that follow from others where the case leaves them
//! out get their values, so that what comes after has nothing to decide.

use wingbeat_air::{AirSettings, OVERLAP_SLOPE, viscosity_of_density};
use wingbeat_math::DVec3;

use crate::error::Fault;
use crate::motion::own_motion::{every_wing, has_all_angles};
use crate::raw::{
    AirCase, AirModel, Case, CoreCase, Formulation, IntegratorCase, JointCase, JointKind, Mode,
    MotionCase, SchemeCase, TimeCase,
};
use crate::shipped::data::find_data;

/// Steps per wingbeat where the case does not say.
const STEPS_PER_BEAT: usize = 40;
/// Wingbeats where the case does not say.
const BEATS: f64 = 5.0;
/// Distance that wakes keep from surfaces where the case does not say, mean chords.
const CLEARANCE: f64 = 0.1;

/// Radius of cores of the wake where the case gives another of their keys alone, mean chords.
const WAKE_CORE: f64 = 0.07;

/// Fills in what the case leaves open.
pub(crate) fn resolve(case: &mut Case) -> Result<(), Fault> {
    let shares_plane =
        !case.wing.is_empty() && !every_wing(case, |own| own.stroke_plane_pitch_deg.is_some());
    motion(&mut case.motion, shares_plane)?;
    let beats = case.motion.frequency_hz.value() > 0.0;
    time(&mut case.time, beats);
    air(&mut case.air);
    dynamics(case);
    Ok(())
}

/// Leaves out the set of measured motion of a resolved case whose angles no wing takes from it: what else it gave is
/// filled in by now.
pub(crate) fn leave_out_data(case: &mut Case) {
    if case.wing.is_empty() || every_wing(case, has_all_angles) {
        case.motion.data = None;
    }
}

/// Frequency and stroke plane of the data set, the latter where some wing `shares_plane`; without a set, wings that do
/// not beat.
fn motion(case: &mut MotionCase, shares_plane: bool) -> Result<(), Fault> {
    let data = match &case.data {
        Some(name) => Some(find_data("motion.data", name)?),
        None => None,
    };
    let frequency = data.as_ref().and_then(|d| d.frequency);
    let plane = data.as_ref().filter(|_| shares_plane);
    let pitch = plane.and_then(|d| d.stroke_plane_pitch);
    case.frequency_hz.decide(frequency.unwrap_or(0.0));
    case.stroke_plane_pitch_deg
        .decide(pitch.unwrap_or(0.0).to_degrees());
    Ok(())
}

/// Time is counted in beats where wings beat, unless seconds and steps are given.
fn time(case: &mut TimeCase, beats: bool) {
    if beats && case.step_s.is_none() {
        case.steps_per_beat.get_or_insert(STEPS_PER_BEAT);
    }
    if beats && case.steps.is_none() {
        case.beats.get_or_insert(BEATS);
    }
}

/// Whether cores of the wake are as wide as a part of the way along the sheet.
pub(crate) fn has_slope(case: &AirCase) -> bool {
    matches!(case.wake_core, CoreCase::Algebraic(_)) && case.wake_overlap.value() > 0.0
}

/// What the scheme says; cores that spread in air and widen where they have a radius; distance of the wake.
pub(crate) fn air(case: &mut AirCase) {
    let scheme = match case.scheme {
        SchemeCase::Benchmark => AirSettings::benchmark,
        SchemeCase::Accurate => AirSettings::accurate,
    };
    let scheme = scheme(case.density_kg_m3, DVec3::ZERO);
    case.circulation_rate.decide(scheme.rate);
    case.convection.decide(scheme.convection);
    case.ring_inset.decide(scheme.inset);
    if let CoreCase::LambOseen(core) | CoreCase::Algebraic(core) = &mut case.wake_core {
        if case.viscosity_m2_s.is_none() {
            let default = viscosity_of_density(case.density_kg_m3);
            core.viscosity_m2_s.get_or_insert(default);
        }
        if core.radius_m.is_none() {
            core.radius_chords.get_or_insert(WAKE_CORE);
        }
    }
    let has_radius = !matches!(case.wake_core, CoreCase::CutOff { .. });
    case.wake_overlap.decide(if has_radius { 1.0 } else { 0.0 });
    if has_slope(case) {
        case.wake_overlap_slope.get_or_insert(OVERLAP_SLOPE);
    }
    if case.clearance_m.is_none() {
        case.clearance_chords.get_or_insert(CLEARANCE);
    }
}

/// The quaternion form where joints close loops, and of a held root with free joints, the momentum form else;
/// Hamming's method with air, order eight without. What moves freely in a wake, as wings on passive hinges do,
/// weighs little beside the air that moves with it: backward differences, which bear that, and the vibrations
/// of elastic wings on such joints, too. Elastic wings remember their shape, as air remembers its wakes.
fn dynamics(case: &mut Case) {
    let children: Vec<&str> = case.joint.values().map(|j| j.child.as_str()).collect();
    let again = |k: usize| children[..k].contains(&children[k]);
    let loops = (0..children.len()).any(again);
    let is_free = |j: &JointCase| !matches!(j.kind, JointKind::Weld | JointKind::PointOnLine);
    let has_free = case.joint.values().any(is_free);
    let is_held = case.flight.mode == Mode::Tethered;
    (case.dynamics.formulation).decide(match loops || (is_held && has_free) {
        true => Formulation::Quaternion,
        false => Formulation::Momentum,
    });
    let bends = case
        .wing
        .values()
        .any(|w| w.structure.as_ref().is_some_and(|s| !s.rigid));
    case.dynamics.integrator.decide(match case.air.model {
        AirModel::None if !bends => IntegratorCase::OrderEight,
        AirModel::VortexLattice if has_free => IntegratorCase::Bdf,
        _ if has_free && bends => IntegratorCase::Bdf,
        _ => IntegratorCase::Hamming,
    });
}
