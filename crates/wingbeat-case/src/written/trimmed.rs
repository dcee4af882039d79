//! A trimmed flight as a case file.

use wingbeat_analysis::wake::WakeTrim;
use wingbeat_analysis::{AnalysisError, Trim, TrimSolution, glides, shifts_body, tail_wings};
use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::{FlightSetup, closes_loop};
use wingbeat_math::{DVec3, EulerSequence};
use wingbeat_model::motion::Adjustment;
use wingbeat_model::{Side, Wing, mirror_name};

use super::flight::tethered;
use crate::build::mirrored_joints;
use crate::loaded::LoadedCase;
use crate::loaded::written_to_change as written;
use crate::motion::own_motion::{every_phase, gives_angles};
use crate::raw::{
    AdjustCase, AngleCase, Case, ControlCase, ControllerCase, CorrectorCase, DynamicsCase,
    FlightCase, Formulation, IntegratorCase, JointCase, JointKind, Mode, StabilisationCase,
    StartCase, TargetCase, TimeCase,
};

/// The case of a trimmed flight as TOML: the given case with the adjusted wing motion, hinges and
/// the state of body and free joints at the start of the periodic beat, impulsively started, in the
/// trim's steps by the trim's method: what was trimmed is what flies. Feedback holds it as it begins.
///
/// # Errors
/// A trimmed wingbeat whose numbers do not stay finite.
pub fn trimmed_case(case: &LoadedCase, trim: &Trim) -> Result<String, AnalysisError> {
    let mut raw = adjusted(case, &trim.solution);
    turn_tail(&mut raw, case, trim.solution.tail_incidence);
    lead(&mut raw, case, &trim.setup);
    let time = &case.setup.time;
    let flown = time.steps as f64 * time.step / trim.beat.period();
    // Without a wingbeat all steps are alike: those of the case remain.
    if time.period.is_some() {
        raw.time = TimeCase {
            steps_per_beat: Some(trim.beat.steps()),
            beats: raw.time.beats.or(Some(flown)),
            ..TimeCase::default()
        };
    }
    let joints = &case.setup.joints;
    let (formulation, stabilisation) = match (0..joints.len()).any(|k| closes_loop(joints, k)) {
        true => (Formulation::Quaternion, StabilisationCase::Projection),
        false => (Formulation::Momentum, StabilisationCase::Baumgarte),
    };
    raw.dynamics = DynamicsCase {
        formulation: formulation.into(),
        stabilisation,
        wings: raw.dynamics.wings,
        integrator: IntegratorCase::RungeKutta.into(),
        ..DynamicsCase::default()
    };
    raw.corrector = CorrectorCase::default(); // of integrators that iterate
    start_joints(&mut raw, case, trim);
    let sizes = [trim.beat.wing_length(), trim.beat.period()];
    let flight = released_into(&trim.beat.root(&trim.state), sizes);
    hold(&mut raw, trim.mean_velocity()?);
    Ok(with_start(case, raw, flight, &trim.solution))
}

/// Free joints are at the start where the periodic beat begins. Mirror images of joints are not in the file but where
/// their state is not the mirror image of that of their counterparts.
fn start_joints(raw: &mut Case, case: &LoadedCase, trim: &Trim) {
    let rate = 1.0 / trim.beat.period();
    let released = |mut joint: JointCase, coordinates: &[f64], rates: &[f64]| {
        if joint.kind == JointKind::Prismatic {
            (joint.start_m, joint.start_m_s) = (Some(coordinates[0]), Some(rates[0]));
        } else {
            let degrees = |list: &[f64], size: f64| {
                let clear = list.iter().map(|&x| beyond_rounding(x, size).to_degrees());
                Some(clear.collect())
            };
            joint.start_deg = degrees(coordinates, 1.0);
            joint.start_deg_s = degrees(rates, rate);
        }
        joint
    };
    let states = trim.beat.joints(&trim.state);
    for (name, coordinates, rates) in &states {
        if let Some(joint) = raw.joint.get_mut(name) {
            *joint = released(joint.clone(), coordinates, rates);
        }
    }
    let images =
        mirrored_joints(raw, &case.setup.animal).expect("the joints of a case that was loaded");
    for (name, image) in images {
        let Some((_, coordinates, rates)) = states.iter().find(|s| s.0 == name) else {
            continue;
        };
        let own = released(image.clone(), coordinates, rates);
        let sizes = [
            1f64.to_degrees(),
            rate.to_degrees(),
            trim.beat.wing_length(),
        ];
        if starts_apart(&own, &image, sizes) {
            raw.joint.insert(name, own);
        }
    }
}

/// Whether two joints start apart by more than [`ALIKE`] of these sizes: of angles \[deg\], their rates \[deg/s\] and
/// lengths \[m\], whose rates are to the rates of angles as lengths are to angles.
fn starts_apart(a: &JointCase, b: &JointCase, [angle, rate, length]: [f64; 3]) -> bool {
    let starts = |j: &JointCase| {
        let degrees = [(&j.start_deg, angle), (&j.start_deg_s, rate)];
        let lengths = [(j.start_m, length), (j.start_m_s, length * rate / angle)];
        let all =
            degrees.map(|(list, size)| list.iter().flatten().map(move |x| x / size).collect());
        let [places, rates]: [Vec<f64>; 2] = all;
        let lengths = lengths.map(|(x, size)| x.unwrap_or(0.0) / size);
        places
            .into_iter()
            .chain(rates)
            .chain(lengths)
            .collect::<Vec<f64>>()
    };
    let pairs = starts(a).into_iter().zip(starts(b));
    pairs.fold(0.0_f64, |most, (x, y)| most.max((x - y).abs())) > ALIKE
}

/// States of joints that differ by less are alike on the right and on the left, as trims are found \[1\].
const ALIKE: f64 = 1e-9;

/// Whether the case of a trimmed flight goes without the feedback of `case`: it is laid out for flights that
/// are alike on the right and on the left, and right and left were trimmed apart.
pub fn lacks_feedback(case: &LoadedCase, trimmed: &TrimSolution) -> bool {
    let control = case.raw.control.as_ref();
    let is_laid_out = control.is_some_and(|c| LAWS.contains(&c.controller));
    is_laid_out && trimmed.unknowns.iter().any(|u| u.is_lateral())
}

/// Controllers that are laid out for a trimmed flight.
const LAWS: [ControllerCase; 2] = [ControllerCase::Regulator, ControllerCase::Stabiliser];

/// Feedback holds the flight as it begins, with the mean velocity `velocity` [m/s] of what was trimmed. Waypoints lead
/// along a way of their own.
fn hold(raw: &mut Case, velocity: DVec3) {
    let holds = |c: &&mut ControlCase| LAWS.contains(&c.controller) && c.waypoint.is_empty();
    let Some(control) = raw.control.as_mut().filter(holds) else {
        return;
    };
    // Trims are found to a billionth of their speeds.
    let rounded = |x: f64| (x * 1e9).round() / 1e9 + 0.0;
    control.hold = TargetCase::Start;
    (control.forward_m_s, control.climb_m_s) = (rounded(velocity.x), rounded(-velocity.z));
}

/// Wingbeats of the rise of the beat and of the hold in which elastic wings and wakes of strips come into their
/// motion. The clock of the wings lags by half of the rise: a whole wingbeat, so that the release is at the
/// beginning of one.
const RISE: f64 = 2.0;
const HELD_WITH_WINGS: f64 = 5.0;
/// The same of wakes of strips, which die out slowly: of a hawkmoth the first free beat departs by 0.9, 0.2, 0.05 and
/// 0.01 deg of pitch after 2, 5, 10 and 20 wingbeats.
const HELD_WITH_STRIP_WAKES: f64 = 20.0;

/// Times by which a glide is analysed, sqrt(R / g) / 4, of the tow in which wakes of strips and elastic wings come to
/// rest: the slowest state of Wagner's function has lost all but 1e-8 after so many of some 3 chords.
const TOWED_WITH_WINGS: f64 = 60.0;

/// The same for a flight in air with memory, or with elastic wings: held while the wake grows, or the wings
/// come into their motion, then released.
pub fn wake_trimmed_case(case: &LoadedCase, trim: &WakeTrim) -> String {
    let mut raw = adjusted(case, &trim.solution);
    turn_tail(&mut raw, case, trim.solution.tail_incidence);
    if trim.solution.unknowns.iter().any(|u| u.is_lateral()) {
        raw.air.mirror = false; // right and left part
    }
    let (start, time) = (trim.start(), &trim.setup.time);
    let period = time.period.unwrap_or(1.0);
    let sizes = [trim.setup.animal.wing_length(), period];
    let root = BodyMotion {
        p: start.position,
        r: start.rotation(),
        v: start.velocity,
        w: start.angular_velocity,
    };
    if trim.glide().is_some() {
        let held = match trim.is_orbit() {
            true => TOWED_WITH_WINGS * period,
            false => start.held_steps as f64 * time.step,
        };
        return glide_case(case, raw, trim, (held, released_into(&root, sizes)));
    }
    // While elastic wings and wakes of strips come into their motion the body moves as on the orbit that was trimmed.
    let (held, flight) = match &trim.orbit {
        Some(orbit) if trim.setup.air.has_strip_wakes() => (HELD_WITH_STRIP_WAKES, tethered(orbit)),
        Some(orbit) => (HELD_WITH_WINGS, tethered(orbit)),
        None => {
            let held = start.held_steps as f64 * time.step / period;
            (held, released_into(&root, sizes))
        }
    };
    // The hold and the free wingbeat that was trimmed, in its steps: of another frequency, they are no longer those
    // that a case has in seconds.
    raw.time = TimeCase {
        steps_per_beat: time.steps_per_beat(),
        beats: Some(held + 1.0),
        ..TimeCase::default()
    };
    raw.motion.start = case.raw.motion.start;
    if trim.is_orbit() {
        (raw.motion.start, raw.motion.start_beats) = (StartCase::Smooth, RISE);
        lead(&mut raw, case, &trim.setup);
    }
    let flight = FlightCase {
        held_beats: held,
        ..flight
    };
    hold(&mut raw, trim.velocity);
    with_start(case, raw, flight, &trim.solution)
}

/// The same of a flyer in which nothing beats: towed for so long \[s\], then free from this start on for the time that
/// the case flies.
fn glide_case(
    case: &LoadedCase,
    mut raw: Case,
    trim: &WakeTrim,
    (held, start): (f64, FlightCase),
) -> String {
    let (own, time) = (&case.setup.time, &trim.setup.time);
    let flown = own.steps as f64 * own.step;
    let flight = match own.period {
        // Wings that stand still at a frequency: holds are counted in its beats.
        Some(period) => {
            raw.time.beats = Some((held + flown) / period);
            raw.time.steps = None;
            FlightCase {
                held_beats: held / period,
                ..start
            }
        }
        None => {
            raw.time.step_s = Some(time.step);
            raw.time.steps = Some(((held + flown) / time.step).round() as usize);
            FlightCase {
                held_s: Some(held),
                ..start
            }
        }
    };
    with_start(case, raw, flight, &trim.solution)
}

/// The case with the adjusted wing motion and hinges, drives of joints and mass centre of the body.
fn adjusted(case: &LoadedCase, by: &TrimSolution) -> Case {
    let mut raw = case.raw.clone();
    let motion = &mut raw.motion;
    // Side by side: what the case has, then what trim has.
    let sides = [Side::Right, Side::Left].map(|side| {
        let own = Adjustment::from(&motion.adjust).on(side, &Adjustment::from(&motion.difference));
        own.then(&by.adjustment.on(side, &by.difference))
    });
    let [right, left] = sides;
    motion.adjust = written_adjustment(&right.mean(&left));
    motion.difference = written_adjustment(&right.less(&left));
    motion.frequency_hz = (motion.frequency_hz.value() * (1.0 + by.adjustment.frequency)).into();
    if case.setup.time.period.is_some() {
        motion.start = StartCase::Impulsive;
    }
    let given = raw.joint.values_mut().flat_map(frequencies);
    given.for_each(|f| *f *= 1.0 + by.adjustment.frequency);
    let given = raw.joint.values_mut().flat_map(swings);
    given.for_each(|x| *x *= 1.0 + by.drive_amplitude);
    let shift = by.mass_centre / raw.animal.scale;
    if shifts_body(&case.setup) {
        let [x, y, z] = raw.body.centre_shift_m.unwrap_or_default();
        let shifted = [x + shift, y, z];
        raw.body.centre_shift_m = Some(shifted).filter(|x| *x != [0.0; 3]);
        return raw;
    }
    for hinge in raw.wing.values_mut().filter_map(|w| w.hinge_m.as_mut()) {
        hinge[0] -= shift;
    }
    raw
}

/// The case with the tail's feathering changed by `incidence` \[rad\]. The angle stands where a wing of the tail gives
/// angles, in one of its wings where none does; in both where their names tell no pair, as neither takes from the other.
fn turn_tail(raw: &mut Case, case: &LoadedCase, incidence: f64) {
    let wings = &case.setup.animal.wings;
    let Some(tail) = tail_wings(&case.setup).ok().filter(|_| incidence != 0.0) else {
        return;
    };
    let mut given: Vec<&Wing> = tail.iter().map(|&w| &wings[w]).collect();
    given.retain(|wing| raw.wing.contains_key(&wing.name));
    let has_angles = |wing: &&Wing| {
        let motion = raw.wing[&wing.name].motion.as_ref();
        motion.is_some_and(gives_angles)
    };
    let count = given.iter().filter(|w| has_angles(w)).count();
    let [left, right] = tail.map(|w| &wings[w].name);
    match (mirror_name(left).as_ref() == Some(right), count) {
        (false, _) => (),
        (true, 0) => given.truncate(1),
        (true, _) => given.retain(has_angles),
    }
    // What `motion.adjust` adds to it stands there.
    let [all, apart] = [&case.raw.motion.adjust, &case.raw.motion.difference].map(Adjustment::from);
    let own = |wing: &Wing| {
        let psi = wing.motion.angles.psi.at(0.0)[0];
        match glides(&case.setup) {
            true => psi - all.on(wing.side, &apart).feathering_offset,
            false => psi,
        }
    };
    for wing in given {
        let (name, psi) = (&wing.name, own(wing));
        let wing = raw.wing.get_mut(name).expect("retained as one of the file");
        let motion = wing.motion.get_or_insert_default();
        let turned = beyond_rounding(psi + incidence, 1.0).to_degrees();
        motion.psi = Some(AngleCase::ConstantDeg(turned));
    }
}

/// Phases of the wings as in the setup that was trimmed: where joints are driven in time, the beat begins at
/// the phase that wings have whose start has delayed them.
fn lead(raw: &mut Case, case: &LoadedCase, trimmed: &FlightSetup) {
    let wings = |setup: &FlightSetup| setup.animal.wings.first().map_or(0.0, |w| w.motion.phase);
    let lead = wings(trimmed) - wings(&case.setup);
    let motions = raw.wing.values_mut().filter_map(|w| w.motion.as_mut());
    let own = motions.filter_map(|m| m.phase.as_mut());
    own.for_each(|phase| *phase += lead);
    if !every_phase(raw, &case.setup.animal) {
        raw.motion.phase += lead; // refused where no wing reads it
    }
}

/// An adjustment as a case has it; the frequency stands elsewhere.
fn written_adjustment(a: &Adjustment) -> AdjustCase {
    let number = |x| beyond_rounding(x, 1.0);
    let degrees = |x| number(x).to_degrees();
    AdjustCase {
        stroke_amplitude: number(a.stroke_amplitude),
        stroke_offset_deg: degrees(a.stroke_offset),
        feathering_amplitude: number(a.feathering_amplitude),
        feathering_offset_deg: degrees(a.feathering_offset),
        feathering_lead: number(a.feathering_lead),
        deviation_offset_deg: degrees(a.deviation_offset),
        stroke_plane_deg: degrees(a.stroke_plane),
    }
}

/// The frequencies of their own at which a joint is driven.
fn frequencies(joint: &mut JointCase) -> Vec<&mut f64> {
    let turn = joint
        .turn
        .iter_mut()
        .filter_map(|t| t.frequency_hz.as_mut());
    let travel = joint
        .travel
        .iter_mut()
        .filter_map(|t| t.frequency_hz.as_mut());
    let series = joint.element.iter_mut().flat_map(|e| {
        let efforts = [e.moment_newton_m.as_mut(), e.force_newton.as_mut()];
        let target = e.follow.as_mut().map(|f| &mut f.angle_deg);
        let all = efforts.into_iter().chain([target]).flatten();
        all.filter_map(|s| s.frequency_hz.as_mut())
    });
    turn.chain(travel).chain(series).collect()
}

/// Moments and forces that drive a joint, and by how much the angles swing that its actuators follow.
fn swings(joint: &mut JointCase) -> impl Iterator<Item = &mut f64> {
    joint.element.iter_mut().flat_map(|e| {
        let efforts = [e.moment_newton_m.as_mut(), e.force_newton.as_mut()];
        let efforts = efforts.into_iter().flatten();
        let efforts = efforts.flat_map(|s| {
            let harmonics = s.cosine.iter_mut().chain(&mut s.sine);
            std::iter::once(&mut s.mean).chain(harmonics)
        });
        let target = e.follow.as_mut().map(|f| &mut f.angle_deg);
        let target = target.into_iter();
        efforts.chain(target.flat_map(|s| s.cosine.iter_mut().chain(&mut s.sine)))
    })
}

/// Part of its natural size below which a number is rounding, a thousandth of what a trim is found to \[1\].
const STANDSTILL: f64 = 1e-12;

/// A number of this natural size, 0 where it is what rounding left of nothing.
fn beyond_rounding(x: f64, size: f64) -> f64 {
    clear(x, STANDSTILL * size)
}

/// A root that is free from this motion on; the natural sizes of its speeds follow from wing length \[m\] and period
/// \[s\].
fn released_into(root: &BodyMotion, [length, period]: [f64; 2]) -> FlightCase {
    let degrees = |x: f64, size: f64| beyond_rounding(x, size).to_degrees();
    let angles = EulerSequence::BODY_231.angles(root.r).to_array();
    let [pitch_deg, yaw_deg, roll_deg] = angles.map(|x| degrees(x, 1.0));
    let speed = |v: f64| beyond_rounding(v, length / period);
    FlightCase {
        pitch_deg,
        yaw_deg,
        roll_deg,
        velocity_m_s: root.v.to_array().map(speed),
        angular_velocity_deg_s: root.w.to_array().map(|w| degrees(w, 1.0 / period)),
        ..FlightCase::default()
    }
}

/// The case as text with this start of its free flight, in the place that it had.
fn with_start(
    case: &LoadedCase,
    mut raw: Case,
    flight: FlightCase,
    trimmed: &TrimSolution,
) -> String {
    raw.flight = FlightCase {
        mode: Mode::Free,
        position_m: raw.flight.position_m,
        ..flight
    };
    let mut without = "";
    if lacks_feedback(case, trimmed) {
        raw.control = None;
        without = "# Without its feedback, which is designed for flights that are alike on the right and on the left.\n";
    }
    let body = written(&raw);
    format!(
        "# `{}`, trimmed: largest residual {:.1e} of weight, weight times wing length, radian and\n# wing length per beat.\n{without}{body}",
        case.name,
        trimmed.error()
    )
}

/// A number, 0 where it is no larger than `rounding`.
pub(super) fn clear(x: f64, rounding: f64) -> f64 {
    if x.abs() > rounding { x } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn behaves_numbers_of_rounding_are_written_as_none() {
        let root = BodyMotion {
            r: EulerSequence::BODY_231.rotation(DVec3::new(0.2, 3e-65, -2e-16)),
            v: DVec3::new(0.1, -1.8e-17, 0.0),
            w: DVec3::new(0.0, 4e-14, 0.3),
            ..BodyMotion::REST
        };
        let flight = released_into(&root, [3e-3, 5e-3]);
        let [p, q, r] = flight.angular_velocity_deg_s;
        assert!([p, q] == [0.0; 2] && r == 0.3_f64.to_degrees());
        let text = format!(
            "{:?} {:?}",
            flight.velocity_m_s,
            [flight.yaw_deg, flight.roll_deg]
        );
        assert_eq!(text, "[0.1, 0.0, 0.0] [0.0, 0.0]", "not -0.0 either");
        assert!((flight.pitch_deg - 0.2_f64.to_degrees()).abs() < 1e-13);
        // A deviation that trim has found is written to its last digit, whatever its size.
        let found = written_adjustment(&Adjustment {
            stroke_offset: 2e-11,
            stroke_plane: 1.5e-16,
            ..Adjustment::default()
        });
        assert_eq!(found.stroke_offset_deg, 2e-11_f64.to_degrees());
        assert_eq!(found.stroke_plane_deg, 0.0);
    }
}
