//! Bad values in cases, and cases of impossible size.

use std::fs;

use crate::field::{Field, Wanted};
use crate::support::QUICK;

/// Numbers of a case by their keys.
const NUMBERS: [&str; 24] = [
    "time.beats",
    "time.steps_per_beat",
    "motion.frequency_hz",
    "motion.phase",
    "gravity_m_s2",
    "animal.scale",
    "corrector.tolerance",
    "corrector.max_passes",
    "corrector.relaxation",
    "air.density_kg_m3",
    "air.stream_m_s",
    "flight.pitch_deg",
    "flight.held_beats",
    "flight.velocity_m_s",
    "output.frames_every",
    "output.checkpoint_every",
    "output.checkpoint_interval_s",
    "body.part.thorax.length_m",
    "body.part.thorax.mass_kg",
    "body.part.thorax.stations",
    "wing.right.mass_kg",
    "wing.right.hinge_m",
    "wing.right.mesh.spanwise",
    "wing.right.planform.rectangle.span_m",
];

#[test]
fn refuses_bad_values_in_cases() {
    let mut field = Field::new("attack-values");
    for key in NUMBERS {
        for value in [
            "nan",
            "-inf",
            "\"5\"",
            "[]",
            "[[1]]",
            "{}",
            "true",
            "1979-05-27",
        ] {
            let set = format!("{key}={value}");
            field.refused(&["check", "case.toml", "--set", &set]);
        }
        for value in [
            "1e308",
            "-1e308",
            "1e-308",
            "0",
            "9223372036854775807",
            "-1",
        ] {
            let set = format!("{key}={value}");
            let args = ["check", "case.toml", "--set", &set];
            field.attack(Wanted::Survived, &args);
        }
    }
    let deep = |n: usize| vec!["a"; n].join(".") + "=1";
    let lists = |n: usize| format!("gravity_m_s2={}{}", "[".repeat(n), "]".repeat(n));
    let sets = [
        deep(33),
        deep(30_000),
        lists(30_000),
        lists(100),
        "=".into(),
        "=1".into(),
        "a".into(),
        "a.=1".into(),
        ".a=1".into(),
        "load[0].x=1".into(),
        "load[99999999999]=1".into(),
        "load[=1".into(),
        "name=../../x".into(),
        "name=\"a/b\"".into(),
        "wing=1".into(),
        "wing.right=[]".into(),
        "format=2".into(),
        "format=-1".into(),
        "time.steps=5".into(),
        "air.model=\"external\"".into(),
        "air.modell=".into(),
        format!("name=\"{}\"", "x".repeat(100_000)),
    ];
    for set in &sets {
        field.refused(&["check", "case.toml", "--set", set]);
    }
    field.end(300);
}

#[test]
fn refuses_cases_beyond_all_size() {
    let mut field = Field::new("attack-size");
    let parts: String = (0..3000)
        .map(|k| format!("[body.part.p{k}]\nlength_m = 1e-3\ndiameter_m = 1e-3\nmass_kg = 1e-9\n"))
        .collect();
    let lattice = QUICK.replace("\"none\"", "\"vortex_lattice\"");
    field.file("parts.toml", lattice.clone() + &parts);
    let segments: String = (0..500)
        .map(|k| format!("[segment.s{k}]\nmass_kg = 1e-9\ncentre_m = [0, 0, 0]\ninertia_about_centre_kg_m2 = [1e-15, 1e-15, 1e-15, 0, 0, 0]\n[joint.j{k}]\nkind = \"spherical\"\nparent = \"body\"\nchild = \"s{k}\"\nat_m = [0, 0, 0]\n"))
        .collect();
    field.file("segments.toml", QUICK.to_owned() + &segments);
    let wings: String = (0..150)
        .map(|k| format!("[wing.right{k}]\nhinge_m = [0, 0, 0]\nmass_kg = 1e-9\n[wing.right{k}.planform.rectangle]\nchord_m = 1e-3\nspan_m = 1e-3\n"))
        .collect();
    field.file("wings.toml", QUICK.to_owned() + &wings);
    let fine = [
        "--set",
        "wing.right.mesh.chordwise=100",
        "--set",
        "wing.right.mesh.spanwise=101",
    ];
    field.refused(&["check", "parts.toml"]);
    field.refused(&["run", "parts.toml", "--out", "new"]);
    field.refused(&["check", "segments.toml"]);
    field.refused(&["check", "wings.toml"]);
    field.refused(&[&["check", "case.toml"], &fine[..]].concat());
    let huge = "wing.right.mesh.spanwise=9223372036854775807";
    field.refused(&["check", "case.toml", "--set", huge]);
    for steps in [
        "time.beats=1e9",
        "time.steps_per_beat=1000000000000",
        "time.beats=1e300",
    ] {
        field.refused(&["check", "case.toml", "--set", steps]);
    }
    field.refused(&["trim", "--steps", "1000000000"]);
    field.end(10);
}

#[test]
fn behaves_in_flights_of_impossible_numbers() {
    let mut field = Field::new("attack-flights");
    let keys = [
        "gravity_m_s2=[0,0,1e300]",
        "gravity_m_s2=[1e154,1e154,1e154]",
        "flight.velocity_m_s=[1e200,0,0]",
        "flight.pitch_deg=1e300",
        "motion.frequency_hz=1e300",
        "motion.frequency_hz=1e-300",
        "animal.scale=1e60",
        "animal.scale=1e-60",
        "wing.right.mass_kg=1e300",
        "wing.right.mass_kg=1e-300",
        "body.part.thorax.mass_kg=1e-300",
        "body.part.thorax.mass_kg=1e300",
        "wing.right.motion.phi.fourier.cosine_deg=[1e300]",
        "corrector.tolerance=1e-300",
        "time.beats=1e-300",
        "dynamics.formulation=\"euler\"",
    ];
    for air in ["none", "blade_element", "vortex_lattice"] {
        for key in keys {
            let model = format!("air.model=\"{air}\"");
            let out = field
                .dir()
                .parent()
                .unwrap()
                .join(format!("attack-{}", std::process::id()));
            let out = out.to_str().unwrap().to_owned();
            let args = [
                "run",
                "case.toml",
                "--quiet",
                "--out",
                &out,
                "--set",
                &model,
                "--set",
                key,
            ];
            field.attack(Wanted::Survived, &args);
            let _ = fs::remove_dir_all(out);
        }
    }
    field.end(40);
}
