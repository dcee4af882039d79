//! What of an estimate is implausible: a number outside wide limits.

use wingbeat_blade::SETS;
use wingbeat_flight::{AirModel, AirOptions, DoubtKind, FlightSetup, MotionMode};
use wingbeat_math::DVec3;
use wingbeat_model::{Animal, BodyPart, DeformingMesh, Wing};

use super::limit::{Doubts, Limit, rounded};
use super::numbers::{Estimate, WingEstimate};
use super::sides::{against_each_other, strokes_against_each_other};
use super::wake::kept_wake;
use super::{elastic, joints};
use crate::beat::level::Level;

const FREQUENCY: Limit = Limit {
    low: 0.05,
    high: 1100.0,
    hints: [
        "slower than the largest birds and robots; is it a period?",
        "the fastest known wings, those of midges, beat at about 1000 Hz; is it in rad/s?",
    ],
};

const WING_LOADING: Limit = Limit {
    low: 0.02,
    high: 500.0,
    hints: [
        "lighter than the smallest insects; is the mass in kg and the wing in m?",
        "heavier than any bird or insect on its wings; is the mass in kg and the wing in m?",
    ],
};

const TIP_SPEED: Limit = Limit {
    low: 0.02,
    high: 60.0,
    hints: [
        "slower than any wing that carries an animal",
        "faster than any animal's; are wing length and frequency right?",
    ],
};

const REYNOLDS: Limit = Limit {
    low: 3.0,
    high: 2e6,
    hints: [
        "friction rules there, and wingbeat's air has little or none",
        "larger than any animal's: look whether chord, speed and viscosity are right",
    ],
};

const REDUCED_FREQUENCY: Limit = Limit::at_most(
    3.0,
    "the wing hardly moves by its own chord in a beat; is the stroke in degrees?",
);

const STROKE: Limit = Limit::at_most(190.0, "left and right wing pass through each other");

const STROKE_OF_ONE_SIDE: Limit = Limit::at_most(
    190.0,
    "more than any animal's; is the stroke in degrees, and the amplitude half of it?",
);

const GYRATION: Limit = Limit {
    low: 0.03,
    high: 3.0,
    hints: [
        "a body this small for its wings; is the inertia in kg m2?",
        "a body this large for its wings; is the inertia in kg m2?",
    ],
};

const WING_MASS: Limit = Limit::at_most(
    0.4,
    "wings of animals are at most a fifth of the mass; is wing.mass_kg that of one wing?",
);

const LIFT: Limit = Limit {
    low: 0.5,
    high: 2.0,
    hints: [
        "it will fall; raise stroke or frequency, or let `wingbeat trim` find them",
        "it will rise; lower stroke or frequency, or let `wingbeat trim` find them",
    ],
};

const LIFT_DOWN: Limit = Limit {
    hints: [
        "it pushes the body down: look at the signs and phases of the wings' angles, the feathering (psi) first",
        "",
    ],
    ..LIFT
};

/// Lift over weight below which nothing is carried, neither up nor down.
const NO_LIFT: f64 = 1e-3;

const LIFT_NONE: Limit = Limit {
    hints: [
        "it carries nothing: look at stroke, wingbeat frequency, feathering (psi) and the density of the air",
        "",
    ],
    ..LIFT
};

/// Tethers carry what the lift does not, but no animal pushes itself down, nor lifts ten of itself.
const TETHERED_LIFT: Limit = Limit {
    low: -0.1,
    high: 10.0,
    hints: [
        LIFT_DOWN.hints[0],
        "more than any animal carries; look at mass and lengths, wingbeat frequency and the wings' angles",
    ],
};

const LIFT_NAME: &str = "mean lift over weight by blade elements";

/// A hundredth is what attached wings in a stream want.
const WAKE_CORE: Limit = Limit {
    low: 0.009,
    high: 0.4,
    hints: [
        "finer than the lattice can resolve; 0.07 chords are usual, 0.01 behind attached wings in a stream: air.wake_core, after the size of the animal",
        "it blurs the wake over the wing; 0.07 chords are usual: air.wake_core, after the size of the animal",
    ],
};

/// Lift of a rectangle of aspect ratio 0.5 is 3, 6 and 9 % high with 0.24, 0.48 and 0.8 of the column.
const BOUND_CORE_ACROSS: Limit = Limit::at_most(
    0.2,
    "lift and drag come out high, the more so the more columns there are: give air.bound_core a tenth of the columns' width or less",
);

/// Added mass of a sphere and of a spheroid ten times as long as wide is 4 and 29 % high with 0.28 and 0.65 of
/// the width.
const BOUND_CORE_OF_BODY: Limit = Limit::at_most(
    0.2,
    "its added mass and moments come out high, the more so the more panels there are: give air.bound_core a tenth of the width or less, or the part fewer panels",
);

const CLEARANCE: Limit = Limit::at_most(
    0.5,
    "wakes are pushed far off the wings; 0.1 chords are usual: air.clearance_m",
);

const TIP_STEP: Limit = Limit::at_most(1.5, "take more steps: time.steps_per_beat");

const DISPLACEMENT: Limit = Limit::at_most(0.6, "bending is in metres: deformation.bending");

const TURN: Limit = Limit::at_most(90.0, "twist is in degrees: deformation.twist");

pub(super) fn doubts(setup: &FlightSetup, e: &Estimate) -> Vec<String> {
    let mut list = Doubts::default();
    list.see(&FREQUENCY, "wingbeat frequency", e.frequency, " Hz");
    match setup.mode {
        MotionMode::Free(_) => free_flight(setup, e, &mut list),
        MotionMode::Tethered(_) => list.see(&TETHERED_LIFT, LIFT_NAME, e.lift_over_weight, ""),
    }
    joints::doubts(setup, e.frequency, &mut list);
    bodies(setup, &mut list);
    let Doubts(mut list) = list;
    list.extend(air_from_behind(setup, e));
    list.extend(setup.drag_of_slow_coefficients());
    let mut said = std::collections::BTreeSet::new();
    for (wing, w) in setup.animal.wings.iter().zip(&e.wings) {
        let mut own = wing_doubts(setup, wing, w);
        own.retain(|d| said.insert(d.clone())); // mirrored wings share their doubts
        let name = |d| format!("wing `{}`: {d}", wing.name);
        list.extend(own.into_iter().map(name));
    }
    list.extend(against_each_other(&setup.animal.wings));
    list.extend(cut_wake(setup));
    // A stroke with the wrong sign has the trailing edge ahead, however right the feathering is.
    let is_explained = strokes_against_each_other(&setup.animal.wings);
    let of_setup = setup.doubts().into_iter();
    let of_setup = of_setup.filter(|d| match d.kind {
        DoubtKind::EdgeAhead => !is_explained,
        DoubtKind::AttachedStrokes => false, // a choice, which the summary notes
        _ => true,
    });
    list.extend(of_setup.map(|d| d.said));
    list
}

/// Flight backwards at a speed that counts beside that of the tips, without wings beside that of a fall over a
/// wingbeat: no animal's, but of streams with a wrong sign.
fn air_from_behind(setup: &FlightSetup, e: &Estimate) -> Option<String> {
    const COUNTS: f64 = 0.3;
    // Of nothing at all beside nothing: a micrometre a second is no flight.
    const ROUNDING: f64 = 1e-6;
    // Horizontal part of the nose of a body that is pitched within 6 degrees of the vertical.
    const ON_END: f64 = 0.1;
    if matches!(setup.air, AirModel::None) {
        return None;
    }
    let root = setup.root_at_start();
    let (nose, level) = (root.r.x_axis, Level::new(root.r, setup.gravity));
    // Of a body that stands on end rounding would say which way it faces.
    if nose.reject_from(level.to_n.z_axis).length() < ON_END {
        return None;
    }
    let forward = level.to_n.x_axis;
    let speed = (root.v - setup.air_at_start()).dot(forward);
    let tips = e.wings.iter().map(|w| w.tip_speed).fold(0.0, f64::max);
    let fall = setup.gravity.length() * setup.time.period.unwrap_or(1.0);
    let size = if e.wings.is_empty() { fall } else { tips };
    (-speed > COUNTS * size && -speed > ROUNDING).then(|| {
        let remedy = match root.v == DVec3::ZERO {
            true => {
                let faced = setup.air.stream().unwrap_or_default() + 2.0 * speed * forward;
                let [x, y, z] = faced.to_array().map(|x| match x.abs() > 1e-9 * -speed {
                    true => rounded(x),
                    false => "0".to_owned(),
                });
                format!("a stream that the animal faces has air.stream_m_s = [{x}, {y}, {z}]")
            }
            false => "correct the signs of flight.velocity_m_s and air.stream_m_s, or turn the animal (flight.yaw_deg)".to_owned(),
        };
        format!("the air comes from behind at {} m/s: {remedy}", rounded(-speed))
    })
}

/// Densities from here on are those of liquids \[kg/m3\].
const LIQUID: f64 = 100.0;

/// Part of the weight that loads carry, beside which the lift of the wings tells nothing \[1\].
const BORNE: f64 = 0.5;

/// Weight, lift and inertia of a flyer that nothing holds.
fn free_flight(setup: &FlightSetup, e: &Estimate, list: &mut Doubts) {
    if setup.mode.is_held_throughout(setup.time.steps) {
        list.0.push(
            "the animal is held for as long as it is flown (flight.held_beats, flight.held_s): fly longer (time), or mode = \"tethered\""
                .to_owned(),
        );
    }
    // Those that are known are of flyers in air.
    if setup.air.density().is_none_or(|density| density < LIQUID) {
        list.see(&WING_LOADING, "wing loading", e.wing_loading, " N/m2");
    }
    let of_lift = match e.lift_over_weight {
        Some(lift) if lift.abs() < NO_LIFT => &LIFT_NONE,
        Some(lift) if lift < 0.0 => &LIFT_DOWN,
        _ => &LIFT,
    };
    // What buoyancy or other constant loads carry wings need not.
    let weight = e.mass * setup.gravity.length();
    if setup.lift_of_loads() < BORNE * weight || weight == 0.0 {
        list.see(of_lift, LIFT_NAME, e.lift_over_weight, "");
    }
    let wings: f64 = e.wings.iter().map(|w| w.report.mass).sum();
    let part = (e.mass > 0.0).then(|| wings / e.mass);
    let mass = "mass of the wings over that of the animal";
    list.see(&WING_MASS, mass, part, "");
    let body = setup.animal.body.mass;
    let length = e.wings.iter().map(|w| w.report.length).fold(0.0, f64::max);
    let radius = (e.inertia.max_element() / body).sqrt() / length;
    let radius = Some(radius).filter(|g| g.is_finite() && *g > 0.0);
    let gyration = "radius of gyration of the body over the wing length";
    list.see(&GYRATION, gyration, radius, "");
}

/// Reynolds number of wings, beating or moved by a tether, below which lift falls and drag rises. From 1800
/// down to about 100 the coefficients of a model of a fruit fly's wing change little, below they do
/// (Navier-Stokes: Wu & Sun 2004, J. Exp. Biol. 207:1137, with the speed at the radius of gyration, 0.5 to 0.6
/// of that of the tip); in plane flow the wake changes between 64 and 32 (Miller & Peskin 2004, J. Exp. Biol.
/// 207:3073).
const VISCOUS: f64 = 100.0;

/// Reynolds numbers that the air was not made for; none of what does not move, or has no friction.
fn see_reynolds(air: &AirModel, w: &WingEstimate, list: &mut Doubts) {
    let known = |re: &f64| w.speed > 0.0 && re.is_finite();
    let reynolds = w.reynolds.filter(known);
    let is_viscous = |re: &f64| (REYNOLDS.low..VISCOUS).contains(re);
    let [wings, evidence, outcome] = match w.tip_speed > 0.0 {
        true => ["beating wings", "", "power to carry the weight too small"],
        false => [
            "wings",
            "of beating wings: ",
            "drag and the power to move them too small",
        ],
    };
    match reynolds.filter(is_viscous).zip(without_viscosity(air)) {
        Some((re, air)) => list.0.push(format!(
            "Reynolds number {} is below {VISCOUS}: there the lift of {wings} falls and their drag rises ({evidence}Wu & Sun 2004, J. Exp. Biol. 207:1137), which {air}: lift comes out too large, {outcome}",
            rounded(re)
        )),
        None => list.see(&REYNOLDS, "Reynolds number", reynolds, ""),
    }
}

/// What says that the lift in this air does not hang on the Reynolds number; none of coefficients of one's own.
fn without_viscosity(air: &AirModel) -> Option<String> {
    match air {
        AirModel::VortexLattice(_) => Some("the lattice does not know".to_owned()),
        AirModel::BladeElement(air) => {
            let set = SETS.iter().find(|s| s.law == air.blade.translation)?;
            let measured = set.reynolds.map_or(String::new(), |re| {
                format!(", measured at a Reynolds number of {re}")
            });
            Some(format!(
                "coefficients do not know (air.blade.coefficients = \"{}\"{measured}; your own: [air.blade.own])",
                set.name
            ))
        }
        _ => None,
    }
}

/// The same of all wings, wings that say the same but once.
pub(super) fn reynolds_doubts(air: &AirModel, wings: &[WingEstimate]) -> Vec<String> {
    let mut list: Vec<String> = vec![];
    for w in wings {
        let mut own = Doubts::default();
        see_reynolds(air, w, &mut own);
        let new = own
            .0
            .into_iter()
            .find(|doubt| !list.iter().any(|said| said.ends_with(doubt)));
        list.extend(new.map(|doubt| format!("wing `{}`: {doubt}", w.report.name)));
    }
    list
}

fn wing_doubts(setup: &FlightSetup, wing: &Wing, w: &WingEstimate) -> Vec<String> {
    let mut list = Doubts::default();
    let flaps = Some(w.tip_speed).filter(|u| *u > 0.0 && !w.hangs_free);
    list.see(&TIP_SPEED, "mean tip speed", flaps, " m/s");
    let stroke = w.stroke_amplitude.to_degrees();
    let is_opposed = setup.animal.wings.iter().any(|w| w.side != wing.side);
    let of_stroke = if is_opposed {
        &STROKE
    } else {
        &STROKE_OF_ONE_SIDE
    };
    list.see(of_stroke, "stroke amplitude", stroke, " deg");
    see_reynolds(&setup.air, w, &mut list);
    let frequency = w.reduced_frequency;
    list.see(&REDUCED_FREQUENCY, "reduced frequency", frequency, "");
    let [away, turn] = deformation(wing);
    let way = "way that deformation moves the surface";
    list.see(&DISPLACEMENT, way, away / w.report.length, " wing lengths");
    list.see(&TURN, "turn of a section by deformation", turn, " deg");
    if let AirModel::VortexLattice(air) = &setup.air {
        let chord = w.report.mean_chord;
        let step = flaps.map(|u| u * setup.time.step / chord);
        list.see(&TIP_STEP, "way of the tip in a step", step, " chords");
        lattice_sizes(air, wing, chord, &mut list);
    }
    elastic::doubts(wing, w, setup.gravity.length(), &mut list);
    let Doubts(mut list) = list;
    let outward = wing.side.sign() * wing.hinge_b.y;
    // One wing alone may span both sides.
    if setup.animal.wings.len() > 1 && outward < -1e-3 * w.report.length {
        list.push(format!(
            "its hinge lies {:.3} mm on the other side of the body: the sign of hinge_m[1]",
            -1e3 * outward
        ));
    }
    list
}

/// Wakes that are cut so early that it is felt.
fn cut_wake(setup: &FlightSetup) -> Option<String> {
    let kept = kept_wake(setup)?;
    let felt = kept.is_short?;
    Some(format!("{}; {felt}", kept.said))
}

/// Phases at which a deformation is looked at.
const PHASES: usize = 24;

/// Largest displacement of a node by prescribed deformation \[m\], and largest turn of a chord \[deg\]; none of
/// a measured surface, which is the wing as it was seen.
fn deformation(wing: &Wing) -> [f64; 2] {
    let Some(shape) = wing.deformation.as_ref().filter(|d| d.surface.is_none()) else {
        return [0.0; 2];
    };
    let (mesh, rest) = (DeformingMesh::new(&wing.mesh, shape), &wing.mesh.nodes);
    let chord = |nodes: &[DVec3], j: usize| {
        nodes[wing.mesh.node(wing.mesh.rows, j)] - nodes[wing.mesh.node(0, j)]
    };
    let mut largest = [0.0_f64; 2];
    for k in 0..PHASES {
        let now = mesh.places(k as f64 / PHASES as f64);
        let moved = now.iter().zip(rest).map(|(a, b)| a.distance(*b));
        let chords = (0..=wing.mesh.cols).map(|j| [chord(rest, j), chord(&now, j)]);
        let turned = chords.filter(|c| c.iter().all(|c| c.length() > 0.0));
        let turned = turned.map(|[a, b]| a.angle_between(b).to_degrees());
        largest = [
            moved.fold(largest[0], f64::max),
            turned.fold(largest[1], f64::max),
        ];
    }
    largest
}

/// Wake core and clearance over the mean chord, bound core over the mean width of the panels.
fn lattice_sizes(air: &AirOptions, wing: &Wing, chord: f64, list: &mut Doubts) {
    let s = &air.lattice;
    if s.shedding.any() {
        let wake = s.wake_core.radius().map(|r| r / chord);
        list.see(&WAKE_CORE, "vortex core of the wake", wake, " mean chords");
        list.see(&CLEARANCE, "clearance", s.clearance / chord, " mean chords");
    }
    let mesh = &wing.mesh;
    let edge = mesh.nodes[mesh.node(0, mesh.cols)] - mesh.nodes[mesh.node(0, 0)];
    let column = edge.y.abs() / mesh.cols as f64;
    let across = s.bound_core.radius().map(|r| r / column);
    let what = "vortex core of the wing";
    list.see(&BOUND_CORE_ACROSS, what, across, " columns of panels");
}

/// All parts, those of the central body and of the segments.
fn parts(animal: &Animal) -> impl Iterator<Item = &BodyPart> {
    let of_segments = animal.segments.iter().flat_map(|s| &s.parts);
    animal.parts.iter().chain(of_segments)
}

/// Bound core over the mean width of the panels of parts of body and segments.
fn bodies(setup: &FlightSetup, list: &mut Doubts) {
    let AirModel::VortexLattice(air) = &setup.air else {
        return;
    };
    if !air.body_surfaces {
        return;
    }
    for part in parts(&setup.animal) {
        let width = part.mesh.mean_width();
        let core = air.lattice.bound_core.radius().map(|r| r / width);
        let what = format!("vortex core of the surfaces on the part `{}`", part.name);
        list.see(&BOUND_CORE_OF_BODY, &what, core, " widths of its panels");
    }
}
