//! How far the results can be trusted.

use wingbeat_air::{
    AirSettings, Convection, CoreModel, Friction, LeadingEdge, LoadMethod, SectionDrag,
};
use wingbeat_flight::{
    AirModel, BladeOptions, FlightSetup, FormulationChoice, IntegratorChoice, MotionMode,
};
use wingbeat_math::DVec3;
use wingbeat_model::Crossing;

use super::beats::BeatMeans;
use super::numbers::Summary;
use super::verdict::Warnings;

/// No animal carries this many of its weights over a whole wingbeat.
const IMPLAUSIBLE_LIFT: f64 = 10.0;

/// Steps in a row in which the force of a wing turns back, from which on the integrator is not stable. Presets have 0 to 4;
/// a body that is light in pitch, by `hamming`, all.
const ALTERNATING: usize = 10;

/// Relative difference from a whole number of steps in a wingbeat that is rounding.
const WHOLE: f64 = 1e-9;

/// A balance with a larger residual is open; the tolerances are lower where the motion is smooth.
const OPEN: f64 = 1e-2;

/// The same of the momentum of flyers whose elastic wings exchange it with the bodies step by step: of second order in the step,
/// 3e-6 at 320 steps a beat.
const ELASTIC_MOMENTUM: f64 = 1e-4;

/// What a reader should know before using the numbers.
pub(super) fn warnings(setup: &FlightSetup, summary: &Summary) -> Warnings {
    let mut list = Warnings::default();
    // Without wings, as of a table of derivatives, there is no length to judge the mass by.
    let is_sized = !setup.animal.wings.is_empty();
    let system = is_sized.then(|| wingbeat_flight::system_of(setup).ok());
    let of_joints = system.flatten().map_or(vec![], |s| s.warnings());
    of_joints.into_iter().for_each(|text| list.limit(text));
    match &setup.air {
        AirModel::None => list.note(
            "There is no air: this is the motion that weight and wing inertia alone give."
                .to_owned(),
        ),
        AirModel::VortexLattice(air) => air_warnings(setup, air, summary, &mut list),
        AirModel::BladeElement(air) if air.blade.unsteady.is_some() => {
            wake_of_strips(setup, air, summary, &mut list);
        }
        AirModel::BladeElement(_) => list.note("The air is quasi-steady: blade elements with measured coefficients, no wake, no interaction of the wings with each other or with the air they moved before.".to_owned()),
        AirModel::Derivatives(_) => list.note("The air is a table of stability derivatives: linear about its reference flight, and wrong far from it.".to_owned()),
        AirModel::Own(_) => list.note("The air is a model of your own: wingbeat vouches for the motion under its loads, not for the loads.".to_owned()),
        AirModel::External(_) => list.note("The air was computed by another program: wingbeat vouches for the motion under its loads, not for the loads.".to_owned()),
    }
    deformation_warnings(setup, &mut list);
    balance_warnings(setup, summary, &mut list);
    power_notes(setup, &mut list);
    if summary.euler_regularity < 0.05 {
        let held = match setup.formulation {
            FormulationChoice::Momentum | FormulationChoice::Quaternion(_) => {
                "the equations in use pass through unharmed, but the angles and rates in history.csv are steep there"
            }
            FormulationChoice::Euler(_) => {
                "accelerations are inaccurate there; use the momentum form"
            }
        };
        let text = format!(
            "An Euler angle came close to its singularity (|cos theta| = {:.3}): {held}.",
            summary.euler_regularity
        );
        match setup.formulation {
            FormulationChoice::Euler(_) => list.limit(text),
            FormulationChoice::Momentum | FormulationChoice::Quaternion(_) => list.note(text),
        }
    }
    if matches!(setup.formulation, FormulationChoice::Euler(_)) {
        list.note(format!(
            "Euler form: the constraints drift; here by at most {:.1e} m and {:.1e} rad.",
            summary.violation_position_m, summary.violation_orientation
        ));
    }
    if let (Some(period), false) = (setup.time.period, summary.beats.is_empty()) {
        let steps = period / setup.time.step;
        if (steps - steps.round()).abs() > WHOLE * steps {
            list.limit(format!("A wingbeat is {steps:.4} steps long: what is called a wingbeat here are {:.0} steps, and means over them drift through the beat. Give time.steps_per_beat in place of time.step_s.", steps.round()));
        }
    }
    if matches!(setup.mode, MotionMode::Tethered(_)) {
        list.note("Tethered: the body does not answer to the forces on it.".to_owned());
    }
    if let MotionMode::Free(start) = &setup.mode
        && start.held_steps >= summary.steps
    {
        list.note(
            "Held to its end (flight.held_beats): the body has not been released.".to_owned(),
        );
    }
    list
}

/// Wings that passed through each other as they were flown, where their prescribed motion alone does not.
pub(super) fn flown_crossings(setup: &FlightSetup, found: &[Crossing], list: &mut Warnings) {
    if !setup.crossing_wings().is_empty() {
        return;
    }
    let texts = found.iter().map(|c| setup.say_flown_crossing(c));
    for text in texts {
        match &setup.air {
            AirModel::VortexLattice(_) => list.limit(format!(
                "The motion that was flown is impossible: {text}. The forces of those instants have no meaning."
            )),
            _ => list.note(format!("The motion that was flown is impossible: {text}.")),
        }
    }
}

/// Wing lengths by which a flyer passes through the air in a wingbeat below which wings come back into their wakes \[1\].
const PASSES: f64 = 2.0;

/// What strips know of their wakes.
fn wake_of_strips(setup: &FlightSetup, air: &BladeOptions, summary: &Summary, list: &mut Warnings) {
    list.note("The air is blade elements whose strips each leave a wake of plane flow straight behind (air.blade.unsteady): no interaction of strips or wings with each other or with the air they moved before.".to_owned());
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
fn deformation_warnings(setup: &FlightSetup, list: &mut Warnings) {
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
    list.note("The wings' deformation is prescribed: it does not answer to the air, and for their inertia the wings stay rigid, so hinge moments lack what the moving shape would add. What deforms the wings against the air is in the power and in its own columns (deformation_...).".to_owned());
    if matches!(setup.air, AirModel::BladeElement(_)) && deformed().any(|d| !d.camber.is_empty()) {
        list.note("Blade elements take twist and bending of the wings, not their camber: that is in the coefficients or nowhere.".to_owned());
    }
}

/// What powers of hinges count beside actuators.
fn power_notes(setup: &FlightSetup, list: &mut Warnings) {
    let mut free = (setup.joints.iter()).filter(|j| j.model.kind.directions() > 0);
    if free.any(|j| !j.model.elements.is_empty()) {
        list.note("Powers at free hinges are those of their actuators, springs, dampers and stops together: what dampers and stops take up is missing in the mean. `wingbeat power` has that of the actuators.".to_owned());
    }
}

/// A balance worse than it should be. Without a wake the motion is smooth and integrated to many
/// digits; a wake's loads jump where it starts and where it is regularised, and elastic wings are of second order in the
/// step. The momentum of a tethered animal, or of one held at first, follows from its prescribed motion and the support's reaction from that: it is as
/// open as the quadrature of that reaction, which says nothing of the motion.
fn balance_warnings(setup: &FlightSetup, summary: &Summary, list: &mut Warnings) {
    let is_smooth = !setup.air.keeps_wake() && !setup.animal.is_elastic();
    let energy = if is_smooth { 1e-6 } else { OPEN };
    let balances = [
        ("energy", summary.energy_residual_relative, energy),
        (
            "momentum",
            summary.momentum_residual_relative,
            momentum_tolerance(setup),
        ),
    ];
    let is_held = match &setup.mode {
        MotionMode::Tethered(_) => true,
        MotionMode::Free(start) => start.held_steps > 0,
    };
    let counted = if is_held { 1 } else { 2 };
    for (what, residual, tolerance) in balances.into_iter().take(counted) {
        let text = format!(
            "The {what} balance does not close: residual {residual:.1e} (tolerance {tolerance:.0e}); take smaller steps before trusting the motion."
        );
        match residual {
            r if r <= tolerance => {}
            r if r <= OPEN => list.limit_first(text),
            _ => list.fault(text), // NaN, too
        }
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

fn air_warnings(
    setup: &FlightSetup,
    air: &wingbeat_flight::AirOptions,
    summary: &Summary,
    list: &mut Warnings,
) {
    let lattice = &air.lattice;
    let suction = suction(lattice);
    if has_vortex_lift(lattice) && setup.animal.wings.len() > 2 {
        list.limit("Vortex lift was tried on two pairs of wings and failed: 0.65 to 2.4 times the lift of the references (docs/separated-flow.md). Take air.loads = pressure without shedding from leading edges, or leading-edge vorticity.".to_owned());
    }
    list.note(match &lattice.section_drag {
        None => format!("The air is inviscid: without friction, drag and power come out low, the more so the smaller the Reynolds number. {suction}"),
        Some(drag) => format!("The air is inviscid; drag of the sections was added to its forces (air.section_drag: {}, cd0 = {}, cd2 = {} per rad2), from the undisturbed air past each strip. {suction}", friction(lattice, drag), drag.cd0, drag.cd2),
    });
    let no_meaning = |crossing| {
        format!(
            "The prescribed motion is impossible: {crossing}. The forces of those instants have no meaning."
        )
    };
    let crossing = setup.crossing_wings().into_iter().map(no_meaning);
    crossing.for_each(|text| list.limit(text));
    let no_meaning = |inside| {
        format!(
            "A wing and a body cannot both be surfaces of the lattice in one place: {inside}. The forces of those instants have no meaning."
        )
    };
    let inside = setup.wings_inside_parts().into_iter().map(no_meaning);
    inside.for_each(|text| list.limit(text));
    if let Some(text) = setup.vortex_lift_of_swept_edges() {
        list.limit(format!("Outside of what it was made for: {text}."));
    }
    let by_motion = [
        setup.one_sided_leading_edges(),
        setup.tips_of_attached_wings(),
    ];
    for text in by_motion.into_iter().flatten() {
        list.limit(format!("By the prescribed motion {text}."));
    }
    list.note(core_is_an_input(setup, lattice));
    if air.mirror {
        list.note("Mirror symmetry was assumed (air.mirror): a real flow of this kind loses it, and with it roll, yaw and sideways drift would come.".to_owned());
    }
    if lattice.shedding.leading && lattice.leading.sheds() {
        list.note("Leading edges shed: such sheets have no converged history beyond the first half stroke. Read means over several beats and their spread, not single peaks.".to_owned());
    }
    if setup.time.period.is_some() && lattice.convection == Convection::Euler {
        list.limit("The air is first order in the step and the wings are coarse: halve the step and double the panels before quoting a number.".to_owned());
    }
    let weights = |b: &BeatMeans| b.lift_over_weight.unwrap_or(0.0).abs();
    if let Some(b) = summary.beats.iter().find(|b| weights(b) > IMPLAUSIBLE_LIFT) {
        list.fault(format!(
            "The air diverged: a mean lift of {:.0} weights in beat {} is not physical. Enlarge the wake core, take smaller steps, keep fewer wake rows, or do not shed from leading edges.",
            weights(b), b.beat
        ));
    }
    if summary.alternating_steps >= ALTERNATING {
        let remedy = match setup.integrator {
            IntegratorChoice::Bdf => "take smaller steps, or larger ones",
            _ => "set dynamics.integrator = \"bdf\"",
        };
        list.fault(format!(
            "Forces alternate from step to step (up to {} steps in a row): the air that moves with the wings weighs too much for the integrator, and the motion means nothing; {remedy}.",
            summary.alternating_steps
        ));
    }
    let still = lattice.images.is_empty() && lattice.wind.is_none();
    if let Some(beat) = summary.beats.last().filter(|_| still) {
        two_ways_to_the_lift(lattice, beat, list);
    }
    of_wakes(summary, list);
}

/// What was limited or left over in the wakes.
fn of_wakes(summary: &Summary, list: &mut Warnings) {
    if summary.wake_particles > 0 {
        list.note(format!(
            "Part of the wake is vortex particles ({} at the end); their radius is an input, not a result.",
            summary.wake_particles
        ));
    }
    if summary.regularised > 0 {
        list.note(format!(
            "{} times a wake node was stopped, ran close to a surface, or left a leading edge that has more suction than it holds, and was regularised.",
            summary.regularised
        ));
    }
    if summary.net_flux_residual_m_s > 0.0 {
        list.note(format!(
            "Net flux through closed body surfaces: a normal velocity of at most {:.1e} m/s is left (their influence matrix has a null space of one dimension).",
            summary.net_flux_residual_m_s
        ));
    }
}

/// What is said of the suction of leading edges.
fn suction(lattice: &AirSettings) -> String {
    match (lattice.loads, held(lattice)) {
        (LoadMethod::Pressure, _) => {
            "Forces are pressure times normal, without leading-edge suction.".to_owned()
        }
        (LoadMethod::Joukowski, None) => {
            "Forces hold the full suction of the edges that do not shed.".to_owned()
        }
        (LoadMethod::Joukowski, Some([threshold, efficiency])) if has_vortex_lift(lattice) => {
            format!(
                "No vorticity leaves leading edges: they hold a suction parameter of {threshold} and have {efficiency} of its force \
             (air.leading_edge_threshold, air.leading_edge_suction_efficiency), what is beyond it is the lift of a vortex that \
             grows and is lost by a law from measurements (air.leading_edge = vortex_lift)."
            )
        }
        (LoadMethod::Joukowski, Some([threshold, efficiency])) => format!(
            "Leading edges hold a suction parameter of {threshold} and have {efficiency} of its force (air.leading_edge_threshold, \
             air.leading_edge_suction_efficiency)."
        ),
        (LoadMethod::Polhamus, _) => {
            "The suction of attached leading edges is turned into a normal force (Polhamus)."
                .to_owned()
        }
    }
}

/// Suction parameter that leading edges hold and part of its force that acts, where they may shed by this criterion.
fn held(lattice: &AirSettings) -> Option<[f64; 2]> {
    lattice
        .leading
        .suction()
        .filter(|_| lattice.shedding.leading)
}

/// Whether leading edges have vortex lift in place of free vorticity.
fn has_vortex_lift(lattice: &AirSettings) -> bool {
    lattice.shedding.leading && matches!(lattice.leading, LeadingEdge::VortexLift(_))
}

/// What is said of the vortex core of the wakes.
fn core_is_an_input(setup: &FlightSetup, lattice: &AirSettings) -> String {
    let chord = setup
        .animal
        .wing_reports()
        .first()
        .map_or(1.0, |r| r.mean_chord);
    let (kind, size) = core(&lattice.wake_core);
    let overlap = match lattice.wake_overlap {
        0.0 => String::new(),
        part if lattice.is_symmetric() => format!(
            ", at least {part} times a filament's length or a quarter of the way from its edge"
        ),
        part => format!(", at least {part} times a filament's length"),
    };
    let blobs = match lattice.wake_blob_length {
        None => String::new(),
        Some(length) => format!("; filaments longer than {length:.1e} m are blobs"),
    };
    format!(
        "The vortex core ({kind}, {size:.1e} m = {:.3} mean chords{overlap}{blobs}) is an input, not a result: vary it and see what changes.",
        size / chord
    )
}

/// The inviscid lift of a beat by the loads and by the impulse of the vortices, and what it means if they differ.
fn two_ways_to_the_lift(lattice: &AirSettings, beat: &BeatMeans, list: &mut Warnings) {
    if lattice.particles.is_some() {
        list.note(
            "The vorticity of particles does not close: the vortex impulse depends on the origin, and its rate is no second way to the lift.",
        );
        return;
    }
    let (other, inviscid, lift) = (
        beat.lift_by_impulse_newton,
        beat.inviscid_lift_newton,
        beat.lift_newton,
    );
    let loads = match lattice.loads {
        LoadMethod::Joukowski => "Joukowski's forces",
        LoadMethod::Pressure | LoadMethod::Polhamus => {
            "pressures and the suction of edges that do not shed"
        }
    };
    let is_lost = held(lattice).is_some_and(|[_, efficiency]| efficiency < 1.0);
    let differs = match (lattice.loads, lattice.section_drag) {
        (LoadMethod::Joukowski, None) if has_vortex_lift(lattice) => {
            Some("with the vortex lift of leading edges")
        }
        (LoadMethod::Joukowski, Some(_)) if has_vortex_lift(lattice) => {
            Some("with section drag and the vortex lift of leading edges")
        }
        (LoadMethod::Joukowski, None) if is_lost => Some("without the suction that is lost"),
        (LoadMethod::Joukowski, None) => None,
        (LoadMethod::Joukowski, Some(_)) if is_lost => {
            Some("with section drag, without the suction that is lost")
        }
        (LoadMethod::Joukowski, Some(_)) => Some("with section drag"),
        (LoadMethod::Pressure, None) => Some("without the suction"),
        (LoadMethod::Pressure, Some(_)) => Some("with section drag, without the suction"),
        (LoadMethod::Polhamus, None) => Some("with the suction turned into a normal force"),
        (LoadMethod::Polhamus, Some(_)) => {
            Some("with section drag and the suction turned into a normal force")
        }
    };
    let flown = differs.map_or(String::new(), |how| {
        format!(" (the flight has {lift:.3e} N, {how})")
    });
    let both = format!(
        "Mean lift of the last beat by the rate of the vortex impulse, another way to the same force: {other:.3e} N; by {loads} {inviscid:.3e} N{flown}."
    );
    // A tenth: six times what the two differ by in attached hover with algebraic cores, and what they do with
    // leading-edge sheets.
    match (other - inviscid).abs() > 0.1 * inviscid.abs() {
        false => list.note(both),
        true => list.limit(format!(
            "Two ways to the mean lift are apart: the wake does not keep its impulse (cores that are not algebraic, steps too long for its rolled-up parts, nodes held off surfaces), so its shape is not to be trusted. {both}"
        )),
    }
}

fn friction(lattice: &AirSettings, drag: &SectionDrag) -> String {
    match drag.friction {
        Friction::None => "no friction".to_owned(),
        Friction::Blasius { viscosity } => {
            let of = match lattice.flow_may_leave_leading_edges() {
                true => ", less on faces that the flow has left at the leading edge",
                false => "",
            };
            format!("laminar friction at a viscosity of {viscosity:.2e} m2/s{of}")
        }
    }
}

fn core(model: &CoreModel) -> (&'static str, f64) {
    match *model {
        CoreModel::CutOff { delta } => ("cut-off", delta),
        CoreModel::Vatistas { radius } => ("Vatistas", radius),
        CoreModel::Scully { radius } => ("Scully", radius),
        CoreModel::LambOseen { radius, .. } => ("Lamb-Oseen", radius),
        CoreModel::Algebraic { radius, .. } => ("algebraic", radius),
    }
}
