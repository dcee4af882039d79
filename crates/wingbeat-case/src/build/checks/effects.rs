//! Keys that others make idle in ways no single key tells: each is refused by name.

use wingbeat_flight::{FlightSetup, MotionMode};
use wingbeat_model::motion::Adjustment;
use wingbeat_model::planform::Spacing;
use wingbeat_model::{Animal, Wing, mirror_name};

use crate::build::checks::{model_keys, spacing, still, wingless};
use crate::build::fault::{Built, idle};
use crate::error::Fault;
use crate::motion::own_motion::{every_phase, every_wing, has_all_angles};
use crate::raw::{
    ANGLES, AirModel, Case, Formulation, JointCase, Mode, TurnCase, WingCase, WingMeshCase,
};
use crate::shipped::data::find_data;
use crate::text::source::CaseSource;

/// Checks what takes more than one look: `setup` was made of `case`, which was read from `source`.
pub(crate) fn check(case: &Case, setup: &FlightSetup, source: &CaseSource) -> Built<()> {
    bodies(case)?;
    meshes(case, source)?;
    spacing::check(case)?;
    motion(case, &setup.animal, source)?;
    adjustments(case, setup)?;
    still::motion(case, setup)?;
    joints(case)?;
    frames(case, source)?;
    wingless::check(case, source)?;
    model_keys::check(case, source)?;
    senses(case, source)?;
    loads(case, source)?;
    springs(case)?;
    hold(case, setup)?;
    tether(case, setup)?;
    formulation(case, setup)
}

/// Springs that neither pull nor damp.
fn springs(case: &Case) -> Built<()> {
    for (name, spring) in &case.spring {
        if spring.stiffness_newton_per_m == 0.0 && spring.damping_newton_s_per_m == 0.0 {
            let why = "without stiffness_newton_per_m or damping_newton_s_per_m";
            let acts = "with stiffness_newton_per_m or damping_newton_s_per_m above 0";
            return Err(idle(format!("spring.{name}"), why, acts));
        }
    }
    Ok(())
}

/// A hold that is none, or that is counted in what there is not.
fn hold(case: &Case, setup: &FlightSetup) -> Built<()> {
    const SHORT: [&str; 2] = [
        "as it is shorter than half a step of the flight",
        "0, or half a step or more",
    ];
    let flight = &case.flight;
    let is_short = matches!(&setup.mode, MotionMode::Free(start) if start.held_steps == 0);
    let refused = |key: &str, [why, acts]: [&str; 2]| Err(idle(key, why, acts));
    match setup.time.period {
        Some(_) if flight.held_s.is_some() => refused(
            "flight.held_s",
            ["where wings beat", "with flight.held_beats, in wingbeats"],
        ),
        None if flight.held_s.is_some() && is_short => refused("flight.held_s", SHORT),
        _ if flight.held_beats <= 0.0 => Ok(()),
        None => refused(
            "flight.held_beats",
            [
                "where nothing beats",
                "with motion.frequency_hz above 0; or flight.held_s, in seconds",
            ],
        ),
        Some(_) if is_short => refused("flight.held_beats", SHORT),
        Some(_) => Ok(()),
    }
}

/// A tether that holds nothing, oscillates at no frequency, or starts what does not start.
fn tether(case: &Case, setup: &FlightSetup) -> Built<()> {
    let Some(tether) = &case.flight.tether else {
        return Ok(());
    };
    still::on_tether(tether)?;
    let starts = tether.start_s.is_some();
    let start = |why, acts| Err(idle("flight.tether.start_s", why, acts));
    match &setup.mode {
        MotionMode::Free(start) if start.held_steps == 0 => Err(idle(
            "flight.tether",
            "in free flight that is not held at first",
            "with flight.held_beats above 0 (flight.held_s where nothing beats), or with mode = \"tethered\"",
        )),
        MotionMode::Free(_) if starts => start(
            "in free flight, which goes on as it is held",
            "with mode = \"tethered\"",
        ),
        MotionMode::Tethered(motion) if starts && motion.rests() => start(
            "on a body at rest",
            "with x, y, z, pitch, yaw or roll that move it",
        ),
        _ => Ok(()),
    }
}

/// A formulation that a held body does not take.
fn formulation(case: &Case, setup: &FlightSetup) -> Built<()> {
    const KEY: &str = "dynamics.formulation";
    let has_joints = setup.joints.iter().any(|j| j.model.kind.directions() > 0);
    match (has_joints, case.dynamics.formulation.value()) {
        _ if case.flight.mode != Mode::Tethered => Ok(()),
        (false, Formulation::Momentum) | (true, Formulation::Quaternion) => Ok(()),
        (false, _) => {
            let why = "with flight.mode = \"tethered\": all motion is prescribed";
            Err(idle(
                KEY,
                why,
                "in free flight, or with joints that move freely",
            ))
        }
        (true, _) => Err(Fault::new(
            KEY,
            "a held body with free joints is integrated in the quaternion form, whatever this says",
            "\"quaternion\"",
            "remove it, or set it to \"quaternion\"",
        )),
    }
}

/// Frames of air without surfaces and wakes. Those that the file wants for a lattice stand by where the command
/// line chose another model.
fn frames(case: &Case, source: &CaseSource) -> Built<()> {
    const KEY: &str = "output.frames_every";
    let wanted = case.output.frames_every > 0 && source.gives(KEY);
    let stands_by = source.chooses("air.model") && !source.touches(KEY);
    if case.air.model == AirModel::VortexLattice || !wanted || stands_by {
        return Ok(());
    }
    Err(Fault::new(
        KEY,
        "this has no effect in air without wakes: no frames are written",
        "0, or air.model = \"vortex_lattice\"",
        "remove it; page and animation draw the flight from its history",
    ))
}

/// Masses that a total replaces, masses without inertia, mirror images nobody can name.
fn bodies(case: &Case) -> Built<()> {
    let body = &case.body;
    if body.mass_kg.is_some() && body.inertia_about_centre_kg_m2.is_some() {
        for (name, part) in &body.part {
            let path = |key: &str| format!("body.part.{name}.{key}");
            let why = "beside body.mass_kg and body.inertia_about_centre_kg_m2";
            let acts = "without one of these two, of which parts then make up the other";
            if part.density_kg_m3.is_some() {
                return Err(idle(path("density_kg_m3"), why, acts));
            }
            if part.mass_kg.is_some() {
                return Err(idle(path("mass_kg"), why, acts));
            }
        }
    }
    for (name, wing) in &case.wing {
        if wing.mirror.is_some() && mirror_name(name).is_none() {
            let why = "for a wing whose name has neither left nor right";
            let acts = "for a wing whose name has left or right in it, as `right-fin`";
            return Err(idle(format!("wing.{name}.mirror"), why, acts));
        }
        if wing.mass_kg == Some(0.0) && wing.inertia_about_centre_kg_m2.is_some() {
            let key = format!("wing.{name}.inertia_about_centre_kg_m2");
            return Err(idle(
                key,
                "for a wing of mass_kg = 0",
                "with mass_kg above 0",
            ));
        }
    }
    Ok(())
}

/// Panels that one wing of a pair leaves out and the other gives: the default would part them.
fn meshes(case: &Case, source: &CaseSource) -> Built<()> {
    for (name, wing) in &case.wing {
        let other = mirror_name(name).and_then(|other| Some((case.wing.get(&other)?, other)));
        let (Some(mesh), Some((counterpart, other))) = (&wing.mesh, other) else {
            continue;
        };
        let Some(there) = &counterpart.mesh else {
            continue;
        };
        let name_of = |of: Spacing| format!("{of:?}").to_lowercase();
        let keys = |m: &WingMeshCase| {
            [
                ("chordwise", m.chordwise.to_string()),
                ("spanwise", m.spanwise.to_string()),
                ("chordwise_spacing", name_of(m.chordwise_spacing)),
                ("spanwise_spacing", name_of(m.spanwise_spacing)),
            ]
        };
        for ((key, own), (_, theirs)) in keys(mesh).into_iter().zip(keys(there)) {
            let path = format!("wing.{name}.mesh.{key}");
            if own != theirs && source.gives(&format!("wing.{name}.mesh")) && !source.gives(&path) {
                return Err(Fault::new(
                    path,
                    format!(
                        "left out beside other panels of this wing it would be {own}, and {theirs} on wing `{other}`"
                    ),
                    "the panels of this wing",
                    format!("give {theirs}, or remove [wing.{name}.mesh]"),
                ));
            }
        }
    }
    Ok(())
}

/// Motions of wings that are not there.
fn motion_without_wings(case: &Case, source: &CaseSource) -> Built<()> {
    // A data set gives the frequency where the case does not.
    let data = case.motion.data.is_some() && source.gives("motion.frequency_hz");
    let acts = |key: &&str| case.joint.is_empty() || !key.starts_with("start");
    let keys = data.then_some("data").into_iter();
    match keys.chain(case.motion.unlike_default()).find(acts) {
        Some(key) => Err(idle(
            format!("motion.{key}"),
            "without wings",
            "with a wing ([wing.NAME])",
        )),
        None => Ok(()),
    }
}

/// Motions for all wings that every wing replaces.
fn motion(case: &Case, animal: &Animal, source: &CaseSource) -> Built<()> {
    if case.wing.is_empty() {
        return motion_without_wings(case, source);
    }
    let own = |wing: &WingCase| wing.motion.clone().unwrap_or_default();
    let all_angles = |wing: &WingCase| own(wing).angles().count() == ANGLES.len();
    for (name, wing) in &case.wing {
        if own(wing).data.is_some() && all_angles(wing) {
            let key = format!("wing.{name}.motion.data");
            let acts = "without one of these, which it then gives";
            return Err(idle(key, "beside phi, theta and psi", acts));
        }
    }
    let every = "beside that of every wing";
    let is_still = animal.wings.iter().all(Wing::is_still); // said by `still::motion`
    if case.motion.phase != 0.0 && !is_still && every_phase(case, animal) {
        let why = "beside that of every wing whose angles vary";
        let acts = "with a wing whose angles vary and that has no phase of its own";
        return Err(idle("motion.phase", why, acts));
    }
    let gives = |key: &str| source.gives(&format!("motion.{key}"));
    let own_planes = every_wing(case, |own| own.stroke_plane_pitch_deg.is_some());
    let pitch = case.motion.stroke_plane_pitch_deg.value();
    if pitch != 0.0 && gives("stroke_plane_pitch_deg") && own_planes {
        let acts = "with a wing that has no stroke_plane_pitch_deg of its own";
        return Err(idle("motion.stroke_plane_pitch_deg", every, acts));
    }
    let Some(name) = case.motion.data.as_deref() else {
        return Ok(());
    };
    let set = find_data("motion.data", name)?;
    let takes_frequency = set.frequency.is_some() && !gives("frequency_hz");
    let takes_plane =
        set.stroke_plane_pitch.is_some() && !gives("stroke_plane_pitch_deg") && !own_planes;
    if !takes_frequency && !takes_plane && every_wing(case, has_all_angles) {
        return Err(idle(
            "motion.data",
            "where frequency, stroke plane and angles that it has are all given otherwise",
            "without one of motion.frequency_hz, stroke_plane_pitch_deg and the angles of a wing, which it then gives",
        ));
    }
    Ok(())
}

/// Changes of what does not vary on any wing.
fn adjustments(case: &Case, setup: &FlightSetup) -> Built<()> {
    let wings = &setup.animal.wings;
    let motion = &case.motion;
    for (table, by) in [
        ("adjust", &motion.adjust),
        ("difference", &motion.difference),
    ] {
        let by = Adjustment::from(by);
        let mut parts = by.numbers().into_iter();
        let lost_on = |(w, wing): (usize, &Wing), part: &(&str, f64)| {
            !setup.is_adjusted(w) || wing.motion.idle(&by).any(|i| i == *part)
        };
        let each = || wings.iter().enumerate();
        let lost = parts.find(|part| !wings.is_empty() && each().all(|w| lost_on(w, part)));
        if let Some((part, _)) = lost {
            let key = format!("motion.{table}.{part}");
            return Err(idle(
                key,
                "on wings whose angle is constant",
                "with a wing whose angle of this name varies over the beat",
            ));
        }
    }
    Ok(())
}

/// What sees no otherwise than without, and leads nowhere.
fn senses(case: &Case, source: &CaseSource) -> Built<()> {
    let Some(control) = &case.control else {
        return Ok(());
    };
    // One without place and heading in between is a stay; at the end there is nothing that it waits for.
    if let Some((last, w)) = control.waypoint.iter().enumerate().next_back()
        && w.position_m.is_none()
        && w.heading_deg.is_none()
    {
        let why = "without position_m or heading_deg at the end: the place and heading before it are held anyway";
        let acts = "with position_m or heading_deg, or before another waypoint";
        return Err(idle(format!("control.waypoint[{last}]"), why, acts));
    }
    let given = source.keys_at("control.sensors");
    let has = |ending: &str| given.iter().any(|key| key.contains(ending));
    if control.sensors.is_some() && !has("_noise_") {
        if !has("_bias_") {
            return Err(idle(
                "control.sensors",
                "without noise or bias",
                "with a key of noise or bias, e.g. rate_noise_deg_s",
            ));
        }
        if has("seed") {
            return Err(idle(
                "control.sensors.seed",
                "without noise",
                "with a key of noise, e.g. rate_noise_deg_s",
            ));
        }
    }
    Ok(())
}

/// Harmonics that stand still.
fn loads(case: &Case, source: &CaseSource) -> Built<()> {
    for (k, load) in case.load.iter().enumerate() {
        let path = |key: &str| format!("load[{k}].{key}");
        // One of zero may be where a campaign begins.
        if !LOADS.iter().any(|key| source.gives(&path(key))) {
            return Err(idle(
                format!("load[{k}]"),
                "without a force or a couple",
                "with force_newton, couple_newton_m or harmonics of them",
            ));
        }
        let series = [
            ("force_cosine_newton", load.force_cosine_newton.is_empty()),
            (
                "couple_cosine_newton_m",
                load.couple_cosine_newton_m.is_empty(),
            ),
        ];
        let oscillates = source.gives(&path("frequency_hz"));
        if let Some((key, _)) = series.iter().find(|s| !s.1 && !oscillates) {
            return Err(Fault::new(
                path(key),
                "without frequency_hz this stands still: it is a constant load",
                "beside frequency_hz",
                "give frequency_hz, or the constant part: force_newton, couple_newton_m",
            ));
        }
    }
    Ok(())
}

/// Keys of forces and couples.
const LOADS: [&str; 6] = [
    "force_newton",
    "force_cosine_newton",
    "force_sine_newton",
    "couple_newton_m",
    "couple_cosine_newton_m",
    "couple_sine_newton_m",
];

/// What joints are told and cannot do.
fn joints(case: &Case) -> Built<()> {
    let given = |name: &str| case.wing.contains_key(name);
    let is_wing = |name: &str| given(name) || mirror_name(name).is_some_and(|other| given(&other));
    for (name, joint) in &case.joint {
        let path = |key: &str| format!("joint.{name}.{key}");
        let JointCase { child, travel, .. } = joint;
        let carried = joint.parent.as_deref().is_some_and(is_wing);
        let on_wing =
            is_wing(child) || carried && crate::build::joints::joint::carries(case, joint);
        if joint.at_child_m.is_some() && on_wing {
            return Err(idle(
                path("at_child_m"),
                "at a wing, which turns about its hinge and closes loops there",
                "at joints between body and segments; a wing has hinge_m",
            ));
        }
        let moves = |t: &crate::raw::TravelCase| !t.cosine_m.is_empty() || !t.sine_m.is_empty();
        let turns =
            |t: &TurnCase| t.mean_deg != 0.0 || !t.cosine_deg.is_empty() || !t.sine_deg.is_empty();
        if joint.turn.as_ref().is_some_and(|t| !turns(t)) {
            return Err(idle(
                path("turn"),
                "without mean_deg, cosine_deg or sine_deg",
                "with one of these",
            ));
        }
        if travel.as_ref().is_some_and(|t| !moves(t)) {
            return Err(idle(
                path("travel"),
                "without cosine_m or sine_m",
                "with one of these",
            ));
        }
        still::joint(name, joint, case.motion.frequency_hz.value())?;
    }
    Ok(())
}
