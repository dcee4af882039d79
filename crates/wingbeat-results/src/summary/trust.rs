//! How far the results can be trusted.

mod doubts;
mod impulse;
mod lattice;
mod motion;
mod wakes;

use wingbeat_flight::{
    AirModel, BladeOptions, Doubt, DoubtKind, FlightSetup, FormulationChoice, MotionMode,
};
use wingbeat_math::DVec3;
use wingbeat_model::NarrowGaps;

use self::doubts::Place;
pub(super) use self::motion::flown_crossings;
use super::means::too_few_left;
use super::numbers::Summary;
use super::verdict::{Verdict, Warnings};

/// Relative difference from a whole number of steps in a wingbeat that is rounding.
const WHOLE: f64 = 1e-9;

/// A balance with a larger residual is open; the tolerances are lower where the motion is smooth.
const OPEN: f64 = 1e-2;

/// The momentum of a held flyer is open from the first on, and its motion is not resolved from the second on, over what
/// moves beside its body. A fly in 40, 20, 14, 10 and 4 steps a beat: 1e-3, 0.03, 0.08, 0.24 and 1.5, whose lift is 0,
/// 0.05, 0.1, 0.6 and 16 % off.
const HELD: [f64; 2] = [0.04, 0.4];

/// From here on steps do not resolve how passive joints move.
const UNRESOLVED: f64 = 0.1;

/// Energy that may be missing without a wake, over what is turned over. Of the presets of blade elements, free
/// for six beats, lift is right to 0.3 % and place to 1.3 % below it (30 to 40 steps a beat), to 0.01 and 0.5 %
/// at a fifth of it.
const SMOOTH: f64 = 5e-5;

/// The same of elastic wings, which are of second order in the step. Of `hawkmoth-elastic` in blade elements the mean
/// power is 2.5, 0.9, 0.3 and 0.05 % off at 9e-3, 5e-3, 2e-3 and 6e-4 (60, 80, 120 and 240 steps a beat), of
/// `hawkmoth-veins` 6, 2, 0.7 and 0.1 % at 1e-2, 3e-3, 9e-4 and 2e-4.
const ELASTIC: f64 = 2e-3;

/// The same of the momentum of flyers whose elastic wings exchange it with the bodies step by step: of second
/// order in the step, 3e-6 at 320 steps a beat.
const ELASTIC_MOMENTUM: f64 = 1e-4;

/// Doubts about the setup; of narrow gaps those that were flown, where these are not known beforehand.
pub(super) fn doubts_of(setup: &FlightSetup, flown: Option<&NarrowGaps>) -> Vec<Doubt> {
    let mut doubts = setup.doubts();
    if let Some(gaps) = flown {
        let kind = DoubtKind::NarrowGaps;
        doubts.retain(|d| d.kind != kind);
        let said = setup.say_narrow_gaps(gaps, "flight").into_iter();
        doubts.extend(said.map(|said| Doubt { kind, said }));
    }
    doubts
}

/// What a reader should know before using the numbers. `momentum`: residuals of the momentum while a support has the
/// body and in free flight \[1\]. `doubts`: those of the setup.
pub(super) fn warnings(
    setup: &FlightSetup,
    doubts: &[Doubt],
    summary: &Summary,
    momentum: [f64; 2],
) -> Warnings {
    let mut list = Warnings::default();
    let scatters = doubts.iter().any(|d| d.kind == DoubtKind::ScatteredAngles);
    balances(setup, summary, (momentum, scatters), &mut list);
    passive_joints(summary, &mut list);
    let mut causes = Warnings::default();
    doubts::say(setup, doubts, Place::Cause, &mut causes);
    list.put_first(causes);
    motion::warnings(setup, doubts, summary, &mut list);
    air(setup, doubts, summary, &mut list);
    deformation(setup, &mut list);
    feedback(setup, summary, &mut list);
    loads(setup, &mut list);
    euler_angles(setup, summary, &mut list);
    steps(setup, summary, &mut list);
    mode(setup, summary, &mut list);
    list
}

/// What the model of the air leaves out.
fn air(setup: &FlightSetup, doubts: &[Doubt], summary: &Summary, list: &mut Warnings) {
    match &setup.air {
        AirModel::None => list.note(
            "There is no air: this is the motion that weight and wing inertia alone give."
                .to_owned(),
        ),
        AirModel::VortexLattice(air) => {
            lattice::warnings(setup, doubts, air, summary, list);
            impulse::warnings(setup, &air.lattice, summary, list);
            wakes::warnings(setup, &air.lattice, summary, list);
        }
        AirModel::BladeElement(_) if setup.animal.wings.is_empty() => list.note("The air is the drag of the body alone (air.blade.body_drag): quasi-steady, along and across its axis, without lift and without a wake.".to_owned()),
        AirModel::BladeElement(air) if air.blade.unsteady.is_some() => {
            strips(setup, air, summary, list);
        }
        AirModel::BladeElement(_) => list.note("The air is quasi-steady: blade elements with measured coefficients, no wake, no interaction of the wings with each other or with the air they moved before."),
        AirModel::Derivatives(_) => list.note("The air is a table of stability derivatives: linear about its reference flight, and wrong far from it."),
        AirModel::Own(_) => list.note("The air is a model of your own: wingbeat vouches for the motion under its loads, not for the loads."),
        AirModel::External(_) => list.note("The air was computed by another program: wingbeat vouches for the motion under its loads, not for the loads."),
    }
}

/// What of the weight constant loads carry.
fn loads(setup: &FlightSetup, list: &mut Warnings) {
    let weight = setup.animal.mass() * setup.gravity.length();
    let borne = setup.lift_of_loads();
    if weight > 0.0 && borne.abs() >= 0.005 * weight {
        list.note(format!(
            "Constant loads (buoyancy, [[load]]) carry {:.3} of the weight; the lift of the air is without them.",
            borne / weight
        ));
    }
}

/// Angles near their singularity, and constraints that drift.
fn euler_angles(setup: &FlightSetup, summary: &Summary, list: &mut Warnings) {
    let is_euler = matches!(setup.formulation, FormulationChoice::Euler(_));
    if summary.euler_regularity < 0.05 {
        let close = format!(
            "An Euler angle came close to its singularity (|cos theta| = {:.3})",
            summary.euler_regularity
        );
        match is_euler {
            true => list.limit(format!(
                "{close}: accelerations are inaccurate there; use the momentum form."
            )),
            false => list.note(format!(
                "{close}: the equations in use pass through unharmed, but the angles and rates in history.csv are steep there."
            )),
        }
    }
    if is_euler {
        list.note(format!(
            "Euler form: the constraints drift; here by at most {:.1e} m and {:.1e} rad.",
            summary.violation_position_m, summary.violation_orientation
        ));
    }
}

/// Largest tolerance of the corrector that a case may have: starting steps with a larger residual are no solution.
const LOOSEST: f64 = 1e-3;

/// Starting steps whose sweeps do not converge (a history that answers to the smallest change may not); later steps that
/// do not are an error. `residual`: the largest of a last pass \[1\].
pub(super) fn starting_steps(setup: &FlightSetup, residual: f64, list: &mut Warnings) {
    let tolerance = setup.corrector.tolerance;
    if tolerance <= 0.0 || residual <= tolerance {
        return;
    }
    let verdict = match residual <= LOOSEST {
        true => Verdict::Amber,
        false => Verdict::Red,
    };
    list.add(verdict, format!("The starting steps have not converged: the states that they begin from differ by {residual:.1e} from one sweep over them to the next, and corrector.tolerance is {tolerance:.1e}. Make the steps smaller (time.steps_per_beat), or start smoothly (motion.start, flight.held_beats)."));
}

/// Wingbeats that are not a whole number of steps.
fn steps(setup: &FlightSetup, summary: &Summary, list: &mut Warnings) {
    if let (Some(period), false) = (setup.time.period, summary.beats.is_empty()) {
        let steps = period / setup.time.step;
        if (steps - steps.round()).abs() > WHOLE * steps {
            list.limit(format!("A wingbeat is {steps:.4} steps long: what is called a wingbeat here are {:.0} steps, and means over them drift through the beat. Give time.steps_per_beat in place of time.step_s.", steps.round()));
        }
    }
}

/// Bodies that do not answer to the forces on them.
fn mode(setup: &FlightSetup, summary: &Summary, list: &mut Warnings) {
    if let MotionMode::Tethered(motion) = &setup.mode {
        list.note(match motion.rests() {
            true => "Tethered: the body does not answer to the forces on it.",
            false => "Tethered: the body does not answer to the forces on it. What the tether spends on moving it is no part of the power, which is that of hinges and prescribed deformation; it is in applied_work_joule of history.csv.",
        });
    }
    if setup.mode.is_held_throughout(summary.steps) {
        list.note(
            "Held to its end (flight.held_beats, flight.held_s): the body has not been released.",
        );
    }
    if !summary.has_n3_down() {
        let along = summary
            .gravity_direction
            .map(|x| format!("{x:.3}"))
            .join(", ");
        list.note(format!("Gravity is along [{along}] in N, not along n3: lift is the force of the air against it, what is called forward is along n1, and Euler angles are those between body and N."));
    }
    too_few_left(setup, summary.beats.len())
        .into_iter()
        .for_each(|text| list.note(text));
}

/// Wing lengths by which a flyer passes through the air in a wingbeat below which wings come back into their
/// wakes \[1\].
const PASSES: f64 = 2.0;

/// What strips know of their wakes.
fn strips(setup: &FlightSetup, air: &BladeOptions, summary: &Summary, list: &mut Warnings) {
    list.note("The air is blade elements whose strips each leave a wake of plane flow straight behind (air.blade.unsteady): no interaction of strips or wings with each other or with the air they moved before.");
    let Some(period) = setup.time.period else {
        return;
    };
    let length = setup.animal.wing_length();
    let flown = DVec3::from_array(summary.displacement_m) / summary.time_s;
    let wind = air.wind.at(DVec3::ZERO, 0.5 * summary.time_s);
    let passed = (flown - air.blade.free_stream - wind).length() * period / length;
    if summary.time_s > 0.0 && passed < PASSES {
        list.limit(format!(
            "The flyer passes {passed:.2} wing lengths through the air in a wingbeat: its wings come back into wakes that strips take to be left behind, and coefficients measured on flapping wings hold a part of the lag already. Leave air.blade.unsteady out in hover, or take the vortex lattice."
        ));
    }
}

/// What prescribed deformation leaves out.
fn deformation(setup: &FlightSetup, list: &mut Warnings) {
    let deformed = || {
        setup
            .animal
            .wings
            .iter()
            .filter_map(|w| w.deformation.as_ref())
    };
    if deformed().next().is_none() {
        return;
    }
    list.note("The wings' deformation is prescribed: it does not answer to the air, and for their inertia the wings stay rigid, so hinge moments lack what the moving shape would add. What deforms the wings against the air is in the power and in its own columns (deformation_...).");
    if matches!(setup.air, AirModel::BladeElement(_)) && deformed().any(|d| !d.camber.is_empty()) {
        list.note("Blade elements take twist and bending of the wings, not their camber: that is in the coefficients or nowhere.");
    }
}

/// Wing lengths from its place at which a flyer under feedback is lost.
const LOST: f64 = 20.0;

/// The same of one that is turned by more than these degrees from the attitude that it is to hold, as many wing lengths
/// from its place: where the attitude at the release is held, one that was released tumbling and came back to its place
/// is turned from that, too.
const TURNED: [f64; 2] = [90.0, 5.0];

/// How far a flight under feedback was from what it is to hold.
fn feedback(setup: &FlightSetup, summary: &Summary, list: &mut Warnings) {
    let departures = summary.departures.as_ref();
    // A body that is held to its end is not steered.
    let Some(departures) = departures.filter(|_| !setup.mode.is_held_throughout(summary.steps))
    else {
        return;
    };
    let turn = departures.attitude_deg;
    let feedback = setup.feedback.as_ref();
    let its = match feedback.is_some_and(|f| f.controller.holds_only_altitude()) {
        true => "altitude",
        false => "place",
    };
    let (place, away) = match &departures.place_wing_lengths {
        Some(d) => (
            format!(
                "{:.1} wing lengths from its {its} at most and {:.1} in the end, and ",
                d.largest, d.last
            ),
            Some(d.last),
        ),
        None => (String::new(), None),
    };
    let limited = 100.0 * departures.limited;
    let held = match feedback.is_some_and(|f| f.controller.holds_attitude()) {
        true => "that of trim",
        false => "that of the release",
    };
    let unheard = match setup.commands_too_late() {
        Some(_) => ", and none of them acted",
        None => "",
    };
    let text = format!(
        "commands stood at their limits at {limited:.0} % of the looks{unheard}; at these it was {place}{:.0} deg from the attitude that it is to hold ({held}, turned by the heading of waypoints) at most and {:.0} in the end.",
        turn.largest, turn.last
    );
    let [over, near] = TURNED;
    let turned = turn.last > over && away.is_none_or(|a| a > near);
    match (turned, away.is_some_and(|a| a > LOST)) {
        (false, false) => list.note(format!("Feedback: {text}")),
        (true, _) => list.limit(format!("The flyer turned over under feedback: {text}")),
        (false, true) => list.limit(format!("The flyer is lost under feedback: {text}")),
    }
}

/// A balance worse than it should be. Without a wake the motion is smooth; a wake's loads jump where it starts
/// and where it is regularised, and elastic wings are of second order in the step. The momentum of a tethered
/// animal, or of one while it is held, follows from its prescribed motion: what is open there is the quadrature of
/// the support's reaction, which measures how well the steps follow that motion.
fn balances(
    setup: &FlightSetup,
    summary: &Summary,
    (momentum, scatters): ([f64; 2], bool),
    list: &mut Warnings,
) {
    let energy = match (setup.air.keeps_wake(), setup.animal.is_elastic()) {
        (true, _) => OPEN,
        (false, true) => ELASTIC,
        (false, false) => SMOOTH,
    };
    // Through samples that scatter wings beat with the noise, which smaller steps follow.
    let scattered = "the samples of wing angles scatter, which smaller steps do not mend";
    let motion = match scatters {
        _ if setup.excited_torsion().is_some() => {
            "the air excites the torsion of the wings, which smaller steps do not mend"
        }
        _ if is_free_and_elastic_by_momenta(setup) && summary.energy_residual_relative > OPEN => {
            "take smaller steps, or of heavy wings dynamics.formulation = \"euler\", before trusting the motion"
        }
        true => scattered,
        false => "take smaller steps before trusting the motion",
    };
    let reaction = match scatters {
        true => scattered,
        false => "take smaller steps before trusting the reaction of the support",
    };
    let [held, free] = momentum;
    let balances = [
        (
            "energy",
            summary.energy_residual_relative,
            [energy, OPEN],
            motion,
        ),
        ("momentum", held, HELD, reaction),
        ("momentum", free, [momentum_tolerance(setup), OPEN], motion),
    ];
    for (what, residual, [tolerance, open], advice) in balances {
        let text = format!(
            "The {what} balance does not close: residual {residual:.1e} (tolerance {tolerance:.0e}); {advice}."
        );
        match residual {
            r if r <= tolerance => {}
            r if r <= open => list.limit(text),
            _ => list.fault(text), // NaN, too
        }
    }
}

/// Heavy elastic wings that fly freely gain energy by the momentum form, less by that of Euler, which has no joints.
fn is_free_and_elastic_by_momenta(setup: &FlightSetup) -> bool {
    let is_free = matches!(setup.mode, MotionMode::Free(_));
    let by_momenta = matches!(setup.formulation, FormulationChoice::Momentum);
    is_free && by_momenta && setup.animal.is_elastic() && setup.joints.is_empty()
}

/// Motion along passive joints that gains or loses energy by the steps: 0.02 to 0.1 % in presets, 1 % of a wing
/// on a hinge at 40 steps a beat; 1.4, 0.4 and 0.1 % of a rotor of two blades that starts at full speed with 98
/// steps a turn, twice and four times as many, all of it in the first steps.
fn passive_joints(summary: &Summary, list: &mut Warnings) {
    let residual = summary.joint_residual_relative;
    let text = format!(
        "Free joints gain or lose {:.1} % of the energy turned over beside what acts on them: the steps do not resolve how they move (vibrations, sudden starts); take smaller ones.",
        100.0 * residual
    );
    match residual {
        r if r <= OPEN => {}
        r if r <= UNRESOLVED => list.limit(text),
        _ => list.fault(text), // NaN, too
    }
}

/// Elastic wings keep the momentum to round-off where it is what is integrated, and no joint is free.
fn momentum_tolerance(setup: &FlightSetup) -> f64 {
    let has_free_joints = || wingbeat_flight::system_of(setup).is_ok_and(|s| s.speeds() > 0);
    let is_integrated = matches!(setup.formulation, FormulationChoice::Momentum);
    match setup.animal.is_elastic() && (!is_integrated || has_free_joints()) {
        true => ELASTIC_MOMENTUM,
        false => 1e-6,
    }
}
