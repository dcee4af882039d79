//! Every row of the literature table (docs/table1) is a preset that runs.

use std::fs;

use crate::support::{Scratch, said};

/// Presets with the trim that belongs to them; none for the linear rows.
const ROWS: [(&str, &[&str]); 12] = [
    ("table1-taylor-thomas-2003", &[]),
    ("table1-sun-xiong-2005", &[]),
    ("table1-sun-2007", &[]),
    ("table1-sun-2007-hawkmoth", &[]),
    ("table1-doman-2009", HOVER),
    ("table1-deng-2001", HOVER),
    ("table1-bolender-2009", HOVER),
    ("table1-orlowski-2010", HOVER),
    ("table1-lasek-sibilski-2002", HOVER),
    ("table1-buler-2004", CRUISE_6),
    ("table1-grauer-hubbard-2009", CRUISE_8),
    ("table1-dietl-garcia-2008", CRUISE_6),
];
const HOVER: &[&str] = &["--forward", "0"];
const CRUISE_6: &[&str] = &[
    "--forward",
    "6",
    "--unknowns",
    "body_pitch",
    "frequency",
    "mass_centre",
];
const CRUISE_8: &[&str] = &[
    "--forward",
    "8",
    "--unknowns",
    "body_pitch",
    "frequency",
    "mass_centre",
];

#[test]
fn balances_every_row_flies() {
    let scratch = Scratch::new("table1-run");
    for (preset, _) in ROWS {
        said(
            &scratch.0,
            &[
                "run",
                preset,
                "--quiet",
                "--out",
                preset,
                "--set",
                "time.beats=1",
                "--set",
                "time.steps_per_beat=60",
                "--set",
                "output.figures=false",
            ],
        );
        let summary: serde_json::Value = serde_json::from_str(
            &fs::read_to_string(scratch.0.join(preset).join("summary.json")).unwrap(),
        )
        .unwrap();
        assert!(summary.is_object(), "{preset}");
        let rows = fs::read_to_string(scratch.0.join(preset).join("history.csv")).unwrap();
        assert!(
            rows.lines().count() > 60 && !rows.contains("NaN"),
            "{preset}"
        );
    }
}

#[test]
fn balances_every_flapping_row_trims_and_has_modes() {
    let scratch = Scratch::new("table1-trim");
    for (preset, trim) in ROWS {
        let text = said(&scratch.0, &[&["stability", preset], trim].concat());
        assert!(text.contains("longitudinal"), "{preset}: {text}");
        if !trim.is_empty() {
            assert!(text.contains("trimmed after"), "{preset}: {text}");
        }
    }
}

/// Names of the longitudinal modes of the first table of `wingbeat stability`.
fn names(text: &str, count: usize) -> Vec<String> {
    let rows = text
        .lines()
        .filter_map(|l| l.trim_start().strip_prefix("longitudinal "));
    let name = |l: &str| {
        l.trim_start()
            .split("   ")
            .next()
            .unwrap()
            .trim()
            .to_owned()
    };
    rows.map(name).take(count).collect()
}

#[test]
fn published_locust_has_a_divergence_a_subsidence_and_a_stable_oscillation() {
    // Taylor & Thomas 2003 measured that structure. Our blade elements find it, not its numbers.
    let scratch = Scratch::new("table1-locust");
    let text = said(&scratch.0, &["stability", "table1-taylor-thomas-2003"]);
    assert_eq!(
        names(&text, 3),
        ["divergence", "subsidence", "stable oscillation"]
    );
}

#[test]
fn agrees_hawkmoth_eigenvalues_with_an_independent_calculation() {
    // The same derivatives and mass properties, eigenvalues per wingbeat worked out elsewhere with
    // forces made dimensionless by rho U^2 S: half the density of the preset's rho U^2 S / 2.
    let scratch = Scratch::new("table1-hawkmoth");
    let text = said(
        &scratch.0,
        &[
            "stability",
            "table1-sun-2007-hawkmoth",
            "--set",
            "air.density_kg_m3=2.5508",
        ],
    );
    let found: Vec<[f64; 2]> = text
        .lines()
        .filter(|l| {
            !l.contains("neutral") && (l.contains("subsidence") || l.contains("oscillation"))
        })
        .map(|l| {
            let numbers: Vec<f64> = l
                .split_whitespace()
                .filter_map(|w| w.parse().ok())
                .collect();
            [numbers[0] / 26.1, numbers[1] / 26.1]
        })
        .collect();
    // Printed with three decimals there.
    let expected = [
        [0.118, 0.507],
        [-0.050, 0.106],
        [-0.246, 0.0],
        [-0.755, 0.0],
        [-0.800, 0.0],
        [-2.040, 0.0],
    ];
    assert_eq!(found.len(), expected.len(), "{text}");
    for (a, b) in found.iter().zip(expected) {
        assert!(
            (a[0] - b[0]).abs() < 1.1e-3 && (a[1] - b[1]).abs() < 1.1e-3,
            "{a:?} {b:?}"
        );
    }
}

/// Commands of the pages, word for word.
#[test]
fn behaves_the_commands_of_every_page_do_what_they_say() {
    let docs = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/table1");
    let scratch = Scratch::new("table1-pages");
    let mut count = 0;
    for page in fs::read_dir(docs).unwrap() {
        let page = page.unwrap().path();
        if page.extension().is_none_or(|e| e != "md") {
            continue;
        }
        let text = fs::read_to_string(page).unwrap();
        for line in text.lines().filter_map(|l| l.strip_prefix("wingbeat ")) {
            let command = line.split(" #").next().unwrap().replace('\'', "");
            let args: Vec<&str> = command.split_whitespace().collect();
            said(&scratch.0, &args);
            count += 1;
        }
    }
    assert!(count >= 2 * ROWS.len());
}

#[test]
fn regress_every_row_has_a_page_with_a_figure() {
    let docs = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/table1");
    for (preset, _) in ROWS {
        let name = preset.trim_start_matches("table1-");
        let page = fs::read_to_string(docs.join(format!("{name}.md")));
        let page = page.unwrap_or_else(|e| panic!("docs/table1/{name}.md: {e}"));
        assert!(page.contains(preset), "{name}");
        assert!(page.contains(&format!("({name}.svg)")), "{name}");
        assert!(docs.join(format!("{name}.svg")).exists(), "{name}.svg");
    }
}
