//! Keys that others make idle in ways no single key tells: each is refused by name.

use wingbeat_flight::{FlightSetup, MotionMode};
use wingbeat_model::motion::Adjustment;
use wingbeat_model::planform::Spacing;
use wingbeat_model::{Animal, Wing, mirror_name};

use crate::build::checks::{model_keys, spacing, wingless};
use crate::build::fault::{Built, idle};
use crate::error::Fault;
use crate::motion::carrier::rides_on_wing;
use crate::motion::own_motion::{every_phase, every_wing, has_all_angles};
use crate::raw::{
    ANGLES, AirModel, Case, Formulation, JointCase, Mode, TetherCase, TurnCase, WingCase,
    WingMeshCase,
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
    still_motion(case, setup)?;
    joints(case)?;
    frames(case, source)?;
    wingless::check(case, source)?;
    model_keys::check(case, source)?;
    senses(case, source)?;
    loads(case, source)?;
    springs(case)?;
    held_beats(case, setup)?;
    tether(case, setup)?;
    formulation(case, setup)
}

/// Springs that neither pull nor damp.
fn springs(case: &Case) -> Built<()> {
    for (name, spring) in &case.spring {
        if spring.stiffness_newton_per_m == 0.0 && spring.damping_newton_s_per_m == 0.0 {
            let why = "without stiffness_newton_per_m or damping_newton_s_per_m";
            return Err(idle(format!("spring.{name}"), why));
        }
    }
    Ok(())
}

/// Beats at which a body is to be held that are none.
fn held_beats(case: &Case, setup: &FlightSetup) -> Built<()> {
    let why = match (setup.time.period, &setup.mode) {
        _ if case.flight.held_beats <= 0.0 => return Ok(()),
        (None, _) => "where nothing beats",
        (_, MotionMode::Free(start)) if start.held_steps == 0 => {
            "as it is shorter than half a step of the flight"
        }
        _ => return Ok(()),
    };
    Err(idle("flight.held_beats", why))
}

/// A tether that holds nothing, oscillates at no frequency, or starts what does not start.
fn tether(case: &Case, setup: &FlightSetup) -> Built<()> {
    let Some(tether) = &case.flight.tether else {
        return Ok(());
    };
    still_on_tether(tether)?;
    let starts = tether.start_s.is_some();
    let start = |why| Err(idle("flight.tether.start_s", why));
    match &setup.mode {
        MotionMode::Free(_) if case.flight.held_beats == 0.0 => Err(idle(
            "flight.tether",
            "in free flight that is not held at first: give flight.held_beats, or mode = \"tethered\"",
        )),
        MotionMode::Free(_) if starts => start("in free flight, which goes on as it is held"),
        MotionMode::Tethered(motion) if starts && motion.rests() => start("on a body at rest"),
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
            Err(idle(KEY, why))
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
            if part.density_kg_m3.is_some() {
                return Err(idle(path("density_kg_m3"), why));
            }
            if part.mass_kg.is_some() {
                return Err(idle(path("mass_kg"), why));
            }
        }
    }
    for (name, wing) in &case.wing {
        if wing.mirror.is_some() && mirror_name(name).is_none() {
            let why = "for a wing whose name has neither left nor right";
            return Err(idle(format!("wing.{name}.mirror"), why));
        }
        if wing.mass_kg == Some(0.0) && wing.inertia_about_centre_kg_m2.is_some() {
            let key = format!("wing.{name}.inertia_about_centre_kg_m2");
            return Err(idle(key, "for a wing of mass_kg = 0"));
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
        Some(key) => Err(idle(format!("motion.{key}"), "without wings")),
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
            return Err(idle(key, "beside phi, theta and psi"));
        }
    }
    let every = "beside that of every wing";
    let is_still = animal.wings.iter().all(Wing::is_still); // said by `still_motion`
    if case.motion.phase != 0.0 && !is_still && every_phase(case, animal) {
        let why = "beside that of every wing whose angles vary";
        return Err(idle("motion.phase", why));
    }
    let gives = |key: &str| source.gives(&format!("motion.{key}"));
    let own_planes = every_wing(case, |own| own.stroke_plane_pitch_deg.is_some());
    let pitch = case.motion.stroke_plane_pitch_deg.value();
    if pitch != 0.0 && gives("stroke_plane_pitch_deg") && own_planes {
        return Err(idle("motion.stroke_plane_pitch_deg", every));
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
        ));
    }
    Ok(())
}

/// Changes of what does not vary on any wing.
fn adjustments(case: &Case, setup: &FlightSetup) -> Built<()> {
    let wings = &setup.animal.wings;
    let any_beats = wings.iter().any(|w| !w.is_still());
    let motion = &case.motion;
    for (table, by) in [
        ("adjust", &motion.adjust),
        ("difference", &motion.difference),
    ] {
        let by = Adjustment::from(by);
        let mut parts = by.numbers().into_iter();
        let lost_on = |wing: &Wing, part: &(&str, f64)| {
            rides_on_wing(case, &wing.name)
                || any_beats && wing.is_still()
                || wing.motion.idle(&by).any(|i| i == *part)
        };
        let lost = parts.find(|part| !wings.is_empty() && wings.iter().all(|w| lost_on(w, part)));
        if let Some((part, _)) = lost {
            let key = format!("motion.{table}.{part}");
            return Err(idle(key, "on wings whose angle is constant"));
        }
    }
    Ok(())
}

/// Phase and length of the start of wings whose angles are all constant.
fn still_motion(case: &Case, setup: &FlightSetup) -> Built<()> {
    let wings = &setup.animal.wings;
    if wings.is_empty() || !wings.iter().all(Wing::is_still) || !case.joint.is_empty() {
        return Ok(());
    }
    let acts = |key: &&str| ["phase", "start_beats"].contains(key);
    match case.motion.unlike_default().into_iter().find(acts) {
        Some(key) => {
            let why = "on wings whose angles are all constant";
            Err(idle(format!("motion.{key}"), why))
        }
        None => Ok(()),
    }
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
        return Err(idle(format!("control.waypoint[{last}]"), why));
    }
    let given = source.keys_at("control.sensors");
    let has = |ending: &str| given.iter().any(|key| key.contains(ending));
    if control.sensors.is_some() && !has("_noise_") {
        if !has("_bias_") {
            return Err(idle("control.sensors", "without noise or bias"));
        }
        if has("seed") {
            return Err(idle("control.sensors.seed", "without noise"));
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
            return Err(idle(format!("load[{k}]"), "without a force or a couple"));
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

/// Sines of a tether at no frequency.
fn still_on_tether(tether: &TetherCase) -> Built<()> {
    let paths = [("x", &tether.x), ("y", &tether.y), ("z", &tether.z)];
    let paths = paths.map(|(name, path)| {
        let path = path.as_ref();
        (name, "sine_m", path.map(|p| (p.frequency_hz, &p.sine_m)))
    });
    let turns = [
        ("pitch", &tether.pitch),
        ("yaw", &tether.yaw),
        ("roll", &tether.roll),
    ];
    let turns = turns.map(|(name, turn)| {
        let turn = turn.as_ref();
        (
            name,
            "sine_deg",
            turn.map(|t| (t.frequency_hz, &t.sine_deg)),
        )
    });
    for (name, key, oscillation) in paths.into_iter().chain(turns) {
        if oscillation.is_some_and(|(frequency, sine)| frequency == 0.0 && !sine.is_empty()) {
            return Err(idle(
                format!("flight.tether.{name}.{key}"),
                "at a frequency_hz of 0",
            ));
        }
    }
    Ok(())
}

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
            ));
        }
        let moves = |t: &crate::raw::TravelCase| !t.cosine_m.is_empty() || !t.sine_m.is_empty();
        let turns =
            |t: &TurnCase| t.mean_deg != 0.0 || !t.cosine_deg.is_empty() || !t.sine_deg.is_empty();
        if joint.turn.as_ref().is_some_and(|t| !turns(t)) {
            return Err(idle(
                path("turn"),
                "without mean_deg, cosine_deg or sine_deg",
            ));
        }
        if travel.as_ref().is_some_and(|t| !moves(t)) {
            return Err(idle(path("travel"), "without cosine_m or sine_m"));
        }
        still_joint(name, joint, case.motion.frequency_hz.value())?;
    }
    Ok(())
}

/// Oscillations of a joint, and of what acts along it, at no frequency; `beat` is that of the wings \[Hz\].
fn still_joint(name: &str, joint: &JointCase, beat: f64) -> Built<()> {
    let turn = joint.turn.iter().map(|t| {
        let still = t.cosine_deg.is_empty() && t.sine_deg.is_empty();
        ("turn".to_owned(), t.frequency_hz, still)
    });
    let travel = joint.travel.iter().map(|t| {
        let still = t.cosine_m.is_empty() && t.sine_m.is_empty();
        ("travel".to_owned(), t.frequency_hz, still)
    });
    let along = joint.element.iter().enumerate().flat_map(|(k, e)| {
        let follow = e.follow.as_ref().map(|f| &f.angle_deg);
        let efforts = [
            ("moment_newton_m", e.moment_newton_m.as_ref()),
            ("force_newton", e.force_newton.as_ref()),
            ("follow.angle_deg", follow),
        ];
        efforts.into_iter().filter_map(move |(key, series)| {
            let s = series?;
            let still = s.cosine.is_empty() && s.sine.is_empty();
            Some((format!("element[{k}].{key}"), s.frequency_hz, still))
        })
    });
    for (key, frequency, still) in turn.chain(travel).chain(along) {
        if !still && frequency.unwrap_or(beat) == 0.0 {
            return Err(Fault::new(
                format!("joint.{name}.{key}"),
                "its sines and cosines stand still at a frequency of 0",
                "harmonics of a frequency above 0",
                "give frequency_hz here or in [motion], or the mean alone",
            ));
        }
    }
    Ok(())
}
