//! How far the results of a vortex lattice can be trusted.

use wingbeat_air::{
    AirSettings, CirculationRate, Convection, CoreModel, Friction, LeadingEdge, LoadMethod,
    SectionDrag,
};
use wingbeat_flight::{
    AirOptions, Doubt, DoubtKind, FlightSetup, IntegratorChoice, MotionMode, growing_joint,
};

use super::doubts::{self, Place};
use crate::summary::numbers::Summary;
use crate::summary::verdict::Warnings;

/// Steps in a row in which the force of a wing turns back, from which on the integrator is not stable. Presets
/// have 0 to 4; a body that is light in pitch, by `hamming`, all.
const ALTERNATING: usize = 10;

/// Steepest widening of cores along the sheet \[1\] and largest radius over the mean chord \[1\] behind which induced drag
/// is within 3 %; 0.03 and 0.01 are advised, 0.25 and 0.07 the defaults.
const SHARP: [f64; 2] = [0.05, 0.02];

/// What cores and columns do to the drag of attached wings.
const INDUCED_DRAG: &str = "Induced drag behind attached wings hangs on the cores of the wake and on the columns of the mesh: wide cores take up to an eighth of it away, evenly spaced columns add up to a tenth, and mean lift is 2 % high at most.";

/// Cores and mesh of attached wings whose drag or thrust counts.
const THIN_CORES: &str = "For drag, thrust and power in a stream take one table [air.wake_core.algebraic] with radius_chords = 0.01, air.bound_core likewise, air.wake_overlap_slope = 0.03 and mesh.spanwise_spacing = \"cosine\", and join roots that meet (docs/lattice-settings.md, \"Induced drag of attached wings\").";

/// Loads of circulations as if these did not change.
const RATE_OMITTED: &str = "Loads are quasi-steady: the rate of the circulation is left out of them (air.circulation_rate = \"omitted\"), and with it forces of added mass. The impulse of the vorticity, which has it, is no second way to them.";

/// What a reader should know of the air: what it leaves out, where it was used beyond what it was made for,
/// what was put in, and signs that it failed.
pub(super) fn warnings(
    setup: &FlightSetup,
    doubts: &[Doubt],
    air: &AirOptions,
    summary: &Summary,
    list: &mut Warnings,
) {
    let lattice = &air.lattice;
    left_out(setup, lattice, list);
    use DoubtKind::{LongSteps, OneSidedEdges, SweptShedding, ThinWakeCores};
    let of_shedding = |d: &Doubt| {
        matches!(
            d.kind,
            OneSidedEdges | LongSteps | SweptShedding | ThinWakeCores
        )
    };
    let held = leading_edges_held(setup, summary);
    let kept = doubts.iter().filter(|d| !(held && of_shedding(d)));
    doubts::say(setup, &Vec::from_iter(kept.cloned()), Place::Air, list);
    inputs(setup, air, summary, list);
    failures(setup, &air.lattice, summary, list);
}

/// Whether leading edges that may shed have shed nothing, in a whole beat where there are beats.
fn leading_edges_held(setup: &FlightSetup, summary: &Summary) -> bool {
    let is_whole = setup
        .time
        .period
        .is_none_or(|period| summary.time_s >= period);
    is_whole && summary.leading_rings == Some(0.0)
}

/// Whether cores of the wake are so thin, beside an overlap that keeps its impulse, that induced drag is that of thin
/// filaments.
fn has_sharp_wake(setup: &FlightSetup, lattice: &AirSettings) -> bool {
    let chord = mean_chord(setup);
    let [slope, radius] = SHARP;
    let overlaps = lattice.wake_overlap > 0.0 && lattice.overlap_slope <= slope;
    lattice.is_symmetric() && overlaps && core(&lattice.wake_core).1 <= radius * chord
}

/// Friction and suction.
fn left_out(setup: &FlightSetup, lattice: &AirSettings, list: &mut Warnings) {
    if setup.animal.wings.is_empty() {
        list.note("The air is inviscid, and bodies leave no wakes: in a steady stream a moment acts on them, but neither lift nor drag; other forces are those of added mass and of a stream that changes.");
        return;
    }
    let suction = suction(lattice);
    if has_vortex_lift(lattice) && setup.animal.wings.len() > 2 {
        list.limit("Vortex lift was tried on two pairs of wings and failed: 0.65 to 2.4 times the lift of the references (docs/separated-flow-evidence.md). Take air.loads = pressure without shedding from leading edges, or leading-edge vorticity.");
    }
    list.note(match &lattice.section_drag {
        None => format!("The air is inviscid: without friction, drag and power come out low, the more so the smaller the Reynolds number. {suction}"),
        Some(drag) => format!("The air is inviscid; drag of the sections was added to its forces (air.section_drag: {}, cd0 = {}, cd2 = {} per rad2), from the undisturbed air past each strip. {suction}", friction(lattice, drag), drag.cd0, drag.cd2),
    });
}

/// What was chosen, and the results depend on.
fn inputs(setup: &FlightSetup, air: &AirOptions, summary: &Summary, list: &mut Warnings) {
    let lattice = &air.lattice;
    let has_wings = !setup.animal.wings.is_empty();
    let has_wakes = has_wings && lattice.shedding.any();
    if has_wakes {
        list.note(core_is_an_input(setup, lattice));
    } else if has_wings {
        list.note("No edge of the wings sheds a wake (air.shed is empty): circulation about the wings stays zero. Forces are those of added mass; there is neither lift nor induced drag in a steady stream.");
    }
    if lattice.rate == CirculationRate::Omitted {
        match period(setup).is_some() {
            true => list.limit(RATE_OMITTED),
            false => list.note(RATE_OMITTED),
        }
    }
    if air.mirror {
        list.note("Mirror symmetry was assumed (air.mirror): a real flow of this kind loses it, and with it roll, yaw and sideways drift would come.");
    }
    let may_shed = has_wings && lattice.leading_edges_shed();
    let hold = may_shed && leading_edges_held(setup, summary);
    if hold {
        list.note("Leading edges may shed (air.shed), and shed nothing: they hold the suction that they had.");
    } else if may_shed {
        list.note("Leading edges shed: such sheets have no converged history beyond the first half stroke. Read means over several beats and their spread, not single peaks.");
    }
    let is_attached = !lattice.shedding.tip && !may_shed;
    if has_wakes && (is_attached || hold) {
        let smoothed = smoothed_by_cores(setup, lattice);
        let text = match has_sharp_wake(setup, lattice) {
            true => smoothed,
            false => {
                let induced =
                    (is_attached && !lattice.plane_wakes).then(|| INDUCED_DRAG.to_owned());
                let said: Vec<String> = [induced, smoothed].into_iter().flatten().collect();
                (!said.is_empty()).then(|| format!("{} {THIN_CORES}", said.join(" ")))
            }
        };
        text.into_iter().for_each(|text| list.note(text));
    }
    let yaws = !air.mirror && matches!(setup.mode, MotionMode::Free(_));
    let explicit = matches!(lattice.leading, LeadingEdge::Suction { .. });
    let sheds = may_shed && !hold;
    if sheds && yaws && explicit && setup.time.period.is_some() {
        list.note("Sheets shed by air.leading_edge = \"suction\" take much of the damping of yaw from beating wings (docs/flight-mechanics.md): for turns and what else hangs on yaw take \"vortex_lift\", or \"suction_implicit\".");
    }
    if setup.time.period.is_some() && lattice.convection == Convection::Euler {
        list.limit("The air is first order in the step and the wings are coarse: halve the step and double the panels before quoting a number.");
    }
}

/// Loads that alternate from step to step: by the motion they make, or by shedding that is a step late.
fn failures(setup: &FlightSetup, lattice: &AirSettings, summary: &Summary, list: &mut Warnings) {
    if summary.alternating_steps < ALTERNATING {
        return;
    }
    let turns_back = format!(
        "Forces alternate from step to step (up to {} steps in a row)",
        summary.alternating_steps
    );
    if let Some(found) = growing_joint(setup) {
        let (said, remedy) = (found.said(setup), found.remedy);
        list.fault(format!(
            "{turns_back}: {said}, and the motion means nothing; take {remedy}."
        ));
    } else if setup.is_moved_by_forces() {
        list.fault(moved_by_what_alternates(setup, lattice, &turns_back));
    } else {
        list.note(format!(
            "{turns_back}: read means{}.",
            match sheds_by_the_step_before(lattice) {
                true => format!(", or {NOT_A_STEP_LATE}"),
                false => String::new(),
            }
        ));
    }
}

/// What to take where leading edges shed by the suction of the step before.
const NOT_A_STEP_LATE: &str =
    "take air.leading_edge = \"suction_implicit\", which does not shed by the step before";

/// Why forces alternate that move something, and what to do: where both may be the cause, both are named.
fn moved_by_what_alternates(setup: &FlightSetup, air: &AirSettings, turns_back: &str) -> String {
    let remedy = match setup.integrator {
        IntegratorChoice::Bdf => "take smaller steps, or larger ones",
        _ => "set dynamics.integrator = \"bdf\"",
    };
    let heavy = "the air that moves with wings or body weighs too much for the integrator";
    match sheds_by_the_step_before(air) {
        false => format!("{turns_back}: {heavy}, and the motion means nothing; {remedy}."),
        true => format!(
            "{turns_back}, and what they move means nothing. Either leading edges that shed by the step before alternate, as they do on wings that nothing but their law moves where steps are short beside the panels: {NOT_A_STEP_LATE}, or larger steps, or more panels. Or {heavy}: {remedy}. It is the leading edges if the forces alternate without \"leading\" in air.shed no more."
        ),
    }
}

fn sheds_by_the_step_before(air: &AirSettings) -> bool {
    matches!(air.leading, LeadingEdge::Suction { .. }) && air.shedding.leading
}

/// Part of what the vorticity shed at the beat makes at the wing that cores take away, from which on it is said \[1\].
const SMOOTHED: f64 = 0.05;

/// Says how far cores smooth the wake that beating wings or a moving tether shed in a stream.
///
/// Vorticity on a line with the wave number `2 pi f / U`, each vortex with the velocity of an algebraic core of radius r,
/// makes `exp(-2 pi f r / U)` of its velocity on the line [Fourier transform of ln(x^2 + r^2)]. Plates that
/// plunge by a hundredth of the chord with cores of 0.07 chords, over Garrick's thrust: 0.99, 0.83 to 0.90 and 0.76 at
/// reduced frequencies of 0.5, 2 and 3.9, where the factor is 0.93, 0.76 and 0.58; their lift is 3 to 6 % high.
fn smoothed_by_cores(setup: &FlightSetup, lattice: &AirSettings) -> Option<String> {
    let period = period(setup)?;
    let root = setup.root_at_start();
    let speed = (root.v - setup.air_at_start()).length();
    let radius = core(&lattice.wake_core).1;
    let wavelength = speed * period;
    let lost = 1.0 - (-std::f64::consts::TAU * radius / wavelength).exp();
    (wavelength > 0.0 && lost >= SMOOTHED).then(|| {
        format!(
            "The flow past attached wings hangs on the cores of the wake where it changes fast: what is shed in a period lies over {:.1} mean chords, and cores of {:.3} chords take up to {:.0} % of its velocity at the wing away. The thrust of plunging plates was low by up to as much, and their lift high by 3 to 6 %.",
            wavelength / mean_chord(setup),
            radius / mean_chord(setup),
            100.0 * lost
        )
    })
}

/// Period of the beat or of a tether that moves \[s\].
fn period(setup: &FlightSetup) -> Option<f64> {
    setup.time.period.or(match &setup.mode {
        MotionMode::Tethered(motion) => motion.period(),
        MotionMode::Free(_) => None,
    })
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

/// Mean chord of all wings \[m\]; 1 without wings.
fn mean_chord(setup: &FlightSetup) -> f64 {
    setup.animal.mean_chord().unwrap_or(1.0)
}

/// So many lengths of a filament, in words.
fn of_length(times: f64) -> String {
    match times == 1.0 {
        true => "the filament's length".to_owned(),
        false => format!("{times} times the filament's length"),
    }
}

/// What is said of the vortex core of the wakes.
fn core_is_an_input(setup: &FlightSetup, lattice: &AirSettings) -> String {
    let chord = mean_chord(setup);
    let (kind, size) = core(&lattice.wake_core);
    let overlap = match lattice.wake_overlap {
        0.0 => String::new(),
        part if lattice.is_symmetric() => format!(
            ", widened to {} but to no more than {} of its distance along the sheet from the edge",
            of_length(part),
            lattice.overlap_slope
        ),
        part => format!(", widened to {}", of_length(part)),
    };
    let blobs = match lattice.wake_blob_length {
        None => String::new(),
        Some(length) => format!("; filaments longer than {length:.1e} m are blobs"),
    };
    format!(
        "The vortex core ({kind}; radius in the wake {size:.1e} m = {:.3} mean chords{overlap}{blobs}) is an input, not a result: vary it and see what changes.",
        size / chord
    )
}

/// What the lift that was flown has or lacks beside the inviscid one.
pub(super) fn differences(lattice: &AirSettings) -> Option<&'static str> {
    let is_lost = held(lattice).is_some_and(|[_, efficiency]| efficiency < 1.0);
    match (lattice.loads, lattice.section_drag) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat_case::LoadedCase;

    /// Where leading edges shed by the suction of the step before, both causes of alternating forces are named with
    /// both remedies; elsewhere the integrator alone.
    #[test]
    fn behaves_both_causes_of_alternating_forces_are_named() {
        let said = |edges: &str| {
            let set = [edges, "air.leading_edge=suction"].map(str::to_owned);
            let case = LoadedCase::find("fruit-fly-hover", &set).unwrap();
            let air = case.setup.air.lattice().unwrap();
            moved_by_what_alternates(&case.setup, &air.lattice, "Forces alternate")
        };
        let both = said("air.shed=[\"trailing\", \"tip\", \"leading\"]");
        for words in ["suction_implicit", "dynamics.integrator", "more panels"] {
            assert!(both.contains(words), "{both}");
        }
        let case = LoadedCase::find("bird-cruise", &["flight.mode=free".to_owned()]).unwrap();
        let air = case.setup.air.lattice().unwrap();
        let one = moved_by_what_alternates(&case.setup, &air.lattice, "Forces alternate");
        assert!(one.contains("bdf") && !one.contains("suction"), "{one}");
    }
}
