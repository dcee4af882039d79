//! Every key of the case language: a bad value is refused at the key and its line; every key says
//! what it is and when to change it; the page of keys is that of the program.

use std::path::Path;

use serde_json::Value;
use wingbeat_case::{CaseError, IoError, LoadedCase};

/// A case without air whose tables the walk adds keys to.
const BASE: &str = r#"format = 1
[time]
[motion]
frequency_hz = 100.0
[flight]
[dynamics]
[air]
[body]
[body.part.thorax]
length_m = 1e-3
diameter_m = 1e-3
mass_kg = 1e-6
[wing.right]
hinge_m = [0, 0.5e-3, 0]
mass_kg = 1e-8
[wing.right.planform.rectangle]
chord_m = 1e-3
span_m = 2e-3
"#;

/// A table of the case language, where it stands, and what makes it complete.
struct Site {
    /// Name of its type in the schema.
    kind: &'static str,
    /// Path of the table.
    path: &'static str,
    /// Keys that it needs, or that give the bad key an effect.
    with: &'static [&'static str],
}

const fn site(kind: &'static str, path: &'static str, with: &'static [&'static str]) -> Site {
    Site { kind, path, with }
}

const SERVO: &[&str] = &[
    "joint.waist.kind=revolute",
    "joint.waist.child=right",
    "joint.waist.axis=[0,1,0]",
];

/// Where each table of the schema can stand.
const SITES: &[Site] = &[
    site("", "", &[]),
    site("AnimalCase", "animal", &[]),
    site("TimeCase", "time", &[]),
    site("MotionCase", "motion", &[]),
    site("AdjustCase", "motion.adjust", &[]),
    site("FlightCase", "flight", &[]),
    site("ControlCase", "control", &[]),
    site("WeightsCase", "control.weights", &[]),
    site(
        "StiffnessCase",
        "control.stiffness",
        &["control.controller=stabiliser"],
    ),
    site("SensorsCase", "control.sensors", &[]),
    site(
        "ObserverCase",
        "control.observer",
        &["control.sensors.tilt_noise_deg=1"],
    ),
    site("TetherCase", "flight.tether", &["flight.mode=tethered"]),
    site(
        "PathOscillation",
        "flight.tether.x",
        &["flight.mode=tethered"],
    ),
    site(
        "AngleOscillation",
        "flight.tether.roll",
        &["flight.mode=tethered"],
    ),
    site("DynamicsCase", "dynamics", &[]),
    site(
        "BaumgarteCase",
        "dynamics.baumgarte",
        &["dynamics.formulation=euler"],
    ),
    site("CorrectorCase", "corrector", &[]),
    site("AirCase", "air", &[]),
    site("CutOffCase", "air.wake_core.cut_off", &[]),
    site("RadiusCase", "air.wake_core.scully", &[]),
    site("LambOseenCase", "air.wake_core.lamb_oseen", &[]),
    site("GroundCase", "air.ground", &[]),
    site("ParticlesCase", "air.particles", &[]),
    site("SectionDragCase", "air.section_drag", &[]),
    site("BladeCase", "air.blade", &["air.model=blade_element"]),
    site(
        "OwnCoefficients",
        "air.blade.own",
        &["air.model=blade_element"],
    ),
    site(
        "ViscousCase",
        "air.blade.viscous",
        &["air.model=blade_element"],
    ),
    site(
        "BodyDragCase",
        "air.blade.body_drag",
        &["air.model=blade_element"],
    ),
    site(
        "DerivativesCase",
        "air.derivatives",
        &["air.model=derivatives"],
    ),
    site(
        "DimensionlessCase",
        "air.derivatives.dimensionless",
        &["air.model=derivatives"],
    ),
    site("VortexStreetCase", "air.vortex_street", &[]),
    site("ExternalCase", "air.external", &["air.model=external"]),
    site("OutputCase", "output", &[]),
    site("BodyCase", "body", &[]),
    site("PartCase", "body.part.thorax", &[]),
    site("WingCase", "wing.right", &[]),
    site("WingMeshCase", "wing.right.mesh", &[]),
    site("BetaCase", "wing.right.planform.beta", &[]),
    site("RectangleCase", "wing.right.planform.rectangle", &[]),
    site("OutlineCase", "wing.right.planform.outline", &[]),
    site("WingMotionCase", "wing.right.motion", &[]),
    site("FourierCase", "wing.right.motion.phi.fourier", &[]),
    site("ShapedCase", "wing.right.motion.phi.smooth_square", &[]),
    site("OvalCase", "wing.right.motion.theta.oval", &[]),
    site("SplitCycleCase", "wing.right.motion.phi.split_cycle", &[]),
    site("TableCase", "wing.right.motion.phi.table", &[]),
    site("DeformationCase", "wing.right.deformation", &[]),
    site("SurfaceCase", "wing.right.deformation.surface", &[]),
    site(
        "StructureCase",
        "wing.right.structure",
        &[
            "wing.right.structure.beam.flap_newton_m2=[1,1]",
            "wing.right.structure.beam.torsion_newton_m2=[1,1]",
        ],
    ),
    site("BeamCase", "wing.right.structure.beam", &[]),
    site("ShellCase", "wing.right.structure.shell", &[]),
    site("SegmentCase", "segment.tail", &[]),
    site("JointCase", "joint.waist", &["joint.waist.child=right"]),
    site("TurnCase", "joint.waist.turn", SERVO),
    site("TravelCase", "joint.waist.travel", SERVO),
    site("SpringCase", "spring.tendon", &[]),
];

/// Tables in lists: they are written out.
const LISTED: &[(&str, &str)] = &[
    ("GustCase", "[[air.gust]]\n"),
    (
        "TurbulenceCase",
        "[[air.gust]]\namplitude_m_s = [0, 0, 1]\n[air.gust.turbulence]\n",
    ),
    ("LoadCase", "[[load]]\n"),
    ("WaypointCase", "[[control.waypoint]]\n"),
    ("TwistCase", "[[wing.right.deformation.twist]]\n"),
    ("CamberCase", "[[wing.right.deformation.camber]]\n"),
    ("BendingCase", "[[wing.right.deformation.bending]]\n"),
    (
        "CourseCase",
        "[[wing.right.deformation.twist]]\nlinear_deg = [0, 1]\n[wing.right.deformation.twist.fourier]\n",
    ),
    ("VeinCase", "[[wing.right.structure.vein]]\n"),
    ("RegionCase", "[[wing.right.structure.region]]\n"),
    ("BeamMassCase", "[[wing.right.structure.beam.mass]]\n"),
    ("ElementCase", "[[joint.waist.element]]\n"),
    (
        "StopCase",
        "[[joint.waist.element]]\n[joint.waist.element.stop]\n",
    ),
    (
        "SeriesCase",
        "[[joint.waist.element]]\n[joint.waist.element.moment_newton_m]\n",
    ),
    (
        "FollowCase",
        "[[joint.waist.element]]\n[joint.waist.element.follow]\n",
    ),
];

fn schema() -> Value {
    serde_json::from_str(&wingbeat_case::schema()).unwrap()
}

/// The properties of a type of the schema, or of the whole case.
fn keys_of<'a>(schema: &'a Value, kind: &str) -> impl Iterator<Item = (&'a String, &'a Value)> {
    let table = if kind.is_empty() {
        schema
    } else {
        &schema["$defs"][kind]
    };
    let own = table["properties"].as_object().into_iter().flatten();
    // What a choice holds: `step_factor`, `fixed`.
    let choices = table["oneOf"].as_array().into_iter().flatten();
    own.chain(choices.flat_map(|v| v["properties"].as_object().into_iter().flatten()))
}

/// A value that the key refuses: out of its range where it has one, else of a wrong type.
fn bad(key: &Value) -> String {
    let bound = |name: &str| key[name].as_f64();
    let whole = key["type"] == "integer";
    let number = |x: f64| {
        if whole {
            format!("{x}")
        } else {
            format!("{x:?}")
        }
    };
    if let Some(low) = bound("exclusiveMinimum") {
        return number(low);
    }
    match bound("minimum") {
        Some(low) if low > 0.0 => return number(low - 1.0),
        Some(low) if !whole => return number(low - 0.5),
        _ => {}
    }
    match key["type"].as_str() {
        Some("string" | "boolean") => "0.5".to_owned(),
        _ => "\"nonsense\"".to_owned(),
    }
}

/// A value that the key takes.
fn good(schema: &Value, key: &Value) -> String {
    if let Some(name) = key["$ref"].as_str() {
        return good(
            schema,
            &schema["$defs"][name.trim_start_matches("#/$defs/")],
        );
    }
    match key["type"].as_str() {
        Some("number") => "0.5".to_owned(),
        Some("integer") => "1".to_owned(),
        Some("string") => "\"right\"".to_owned(),
        Some("array") => {
            let count = key["minItems"].as_u64().unwrap_or(0);
            let items: Vec<String> = (0..count).map(|_| good(schema, &key["items"])).collect();
            format!("[{}]", items.join(", "))
        }
        _ => "{}".to_owned(),
    }
}

/// The other keys that a table cannot be without, `KEY = VALUE`.
fn required(schema: &Value, kind: &str, but: &str) -> Vec<String> {
    let table = &schema["$defs"][kind];
    let names = table["required"].as_array().into_iter().flatten();
    let names = names.filter_map(Value::as_str).filter(|n| *n != but);
    names
        .map(|n| format!("{n}={}", good(schema, &table["properties"][n])))
        .collect()
}

fn refusal(text: &str, what: &str) -> Box<CaseError> {
    match LoadedCase::from_text("case.toml", text, Path::new(""), &[]) {
        Err(IoError::Case(e)) => e,
        Err(e) => panic!("{what}: {e}"),
        Ok(_) => panic!("{what} is accepted\n{text}"),
    }
}

/// The base case with these keys set, as text: later keys replace earlier ones.
fn text_with(sets: &[String]) -> String {
    let shaped = sets.iter().any(|s| s.starts_with("wing.right.planform."));
    let base = if shaped {
        BASE.split("[wing.right.planform").next().unwrap()
    } else {
        BASE
    };
    let mut case: toml::Table = base.parse().unwrap();
    for set in sets {
        let (path, value) = set.split_once('=').unwrap();
        let value = format!("v = {value}").parse::<toml::Table>().map_or_else(
            |_| toml::Value::String(value.to_owned()),
            |t| t["v"].clone(),
        );
        let mut table = &mut case;
        let mut names: Vec<&str> = path.split('.').collect();
        let last = names.pop().unwrap();
        for name in names {
            let fresh = || toml::Value::Table(toml::Table::new());
            let slot = table.entry(name).or_insert_with(fresh);
            table = slot.as_table_mut().unwrap();
        }
        table.insert(last.to_owned(), value);
    }
    toml::to_string(&case).unwrap()
}

/// The report names the key and its line.
fn assert_named(text: &str, path: &str, name: &str, value: &str) {
    let error = refusal(text, path);
    let at = error.key.split('[').next().unwrap();
    let listed = error.key.contains("].");
    assert!(
        error.key == path || at == path || (listed && error.key.ends_with(&format!(".{name}"))),
        "{path} = {value} is refused as {}:\n{error}",
        error.key
    );
    let line = error
        .line
        .unwrap_or_else(|| panic!("{path}: no line in\n{error}"));
    let written = text.lines().nth(line - 1).unwrap();
    assert!(
        written.contains(name),
        "{path}: line {line} is `{written}`\n{error}"
    );
    assert!(
        !error.remedy.is_empty(),
        "{path}: nothing to try in\n{error}"
    );
}

#[test]
fn refuses_a_bad_value_at_every_key_with_its_line() {
    let schema = schema();
    let mut walked = 0;
    for site in SITES {
        for (name, key) in keys_of(&schema, site.kind) {
            let path = if site.path.is_empty() {
                name.clone()
            } else {
                format!("{}.{name}", site.path)
            };
            let value = bad(key);
            let mut sets: Vec<String> = site.with.iter().map(|s| (*s).to_owned()).collect();
            let beside = required(&schema, site.kind, name);
            sets.extend(beside.iter().map(|set| format!("{}.{set}", site.path)));
            sets.push(format!("{path}={value}"));
            assert_named(&text_with(&sets), &path, name, &value);
            walked += 1;
        }
    }
    for (kind, head) in LISTED {
        for (name, key) in keys_of(&schema, kind) {
            let value = bad(key);
            let beside = required(&schema, kind, name).join("\n");
            let text = format!("{BASE}{head}{name} = {value}\n{beside}\n");
            let path = head.trim().trim_matches(['[', ']']).to_owned();
            assert_named(&text, &format!("{path}.{name}"), name, &value);
            walked += 1;
        }
    }
    println!("{walked} keys");
}

#[test]
fn invariant_the_walk_knows_every_table_of_the_schema() {
    let schema = schema();
    for (kind, table) in schema["$defs"].as_object().unwrap() {
        let has_keys = table["properties"].is_object();
        let known = SITES.iter().any(|s| s.kind == kind) || LISTED.iter().any(|l| l.0 == kind);
        assert!(known || !has_keys, "{kind} is not walked");
    }
}

#[test]
fn invariant_every_key_says_what_it_is_and_when_to_change_it() {
    let schema = schema();
    let kinds = schema["$defs"]
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str);
    for kind in kinds.chain([""]) {
        let is_choice = schema["$defs"][kind]["oneOf"].is_array();
        for (name, key) in keys_of(&schema, kind).filter(|_| !is_choice) {
            let text = key["description"].as_str().unwrap_or("");
            let holds_table =
                key.get("$ref").is_some() || key["type"] == "object" || key["type"] == "array";
            let says = text.contains("\n\nChange it ");
            assert!(
                !text.is_empty() && (says || holds_table),
                "{kind}.{name}: {text}"
            );
        }
    }
}

#[test]
fn invariant_the_key_of_coefficients_names_all_shipped_sets() {
    let schema = schema();
    let mut of_blades = keys_of(&schema, "BladeCase");
    let (_, key) = of_blades.find(|(name, _)| *name == "coefficients").unwrap();
    let about = key["description"].as_str().unwrap();
    for set in wingbeat_blade::SETS {
        assert!(about.contains(&format!("`{}`", set.name)), "{}", set.name);
    }
}

#[test]
fn regress_the_page_of_keys_is_that_of_the_program() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/case-keys.md");
    let page = std::fs::read_to_string(file).unwrap();
    assert!(
        page == wingbeat_case::keys::page(),
        "docs/case-keys.md is old: cargo run -p wingbeat-case --example case_keys > docs/case-keys.md"
    );
}

/// The fuzzer finds no key by chance.
#[test]
fn regress_the_dictionary_of_the_fuzzer_has_every_key_and_choice() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/case.dict");
    let words = std::fs::read_to_string(file).unwrap();
    let schema = schema();
    let tables = schema["$defs"].as_object().unwrap().values();
    for table in tables.chain([&schema]) {
        let choices = table["oneOf"].as_array().into_iter().flatten();
        let names = choices
            .clone()
            .filter_map(|choice| choice["const"].as_str());
        let keys = [table].into_iter().chain(choices);
        let keys = keys.filter_map(|table| table["properties"].as_object());
        for word in keys
            .flat_map(|keys| keys.keys().map(String::as_str))
            .chain(names)
        {
            let is_there = words.lines().any(|line| line == format!("\"{word}\""));
            assert!(is_there, "fuzz/case.dict lacks \"{word}\"");
        }
    }
}

#[test]
fn exact_nothing_behind_the_equals_sign_takes_a_key_away() {
    let sets = |sets: &[&str]| sets.iter().map(|s| (*s).to_owned()).collect::<Vec<_>>();
    let tethered = "flight.mode=tethered";
    let held = LoadedCase::find("fruit-fly-hover", &sets(&[tethered]));
    let Err(error) = held else {
        panic!("a body on a tether is held for no beats");
    };
    assert!(
        error.to_string().contains("`flight.held_beats=`"),
        "{error}"
    );
    assert!(LoadedCase::find("fruit-fly-hover", &sets(&[tethered, "flight.held_beats="])).is_ok());
    // Whole tables, too.
    let headless = LoadedCase::find("fruit-fly-blade", &sets(&["body.part.head="])).unwrap();
    assert_eq!(headless.setup.animal.parts.len(), 2);
    let missing = LoadedCase::find("fruit-fly-blade", &sets(&["time.step_s="]));
    let Err(error) = missing else {
        panic!("a key that is not there was taken away");
    };
    let words = "no such key to take away (which `time.step_s=`";
    assert!(error.to_string().contains(words), "{error}");
    // Elements of lists, the others closing up.
    let loads = "load=[{ force_newton = [1e-6, 0, 0] }, { force_newton = [2e-6, 0, 0] }]";
    let blade = |all: &[&str]| LoadedCase::find("fruit-fly-blade", &sets(all));
    let left = blade(&[loads, "load[0]="]).unwrap().setup.loads;
    assert_eq!(left, blade(&[loads]).unwrap().setup.loads[1..]);
    for (wrong, words) in [
        ("load[2]=", "no such key to take away"),
        ("load[]=", "`load[]` is no key"),
        ("time.beats[]=3", "`time.beats[]` is no key"),
        ("load[0]force_newton=[0, 0, 0]", "is no key"),
        ("load[0=1", "is no key"),
        ("load[-1]=", "is no key"),
    ] {
        let error = blade(&[loads, wrong]).map(|_| wrong).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
}
