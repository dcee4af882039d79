//! Bad input for the air, one test each, through the case file: the report names file, line, key and
//! remedy, the exit code is 2, and nothing is written.

use std::fs;

use crate::support::{Scratch, refused_with, wingbeat};

/// A tethered flight in the lattice with a cube for a body; fine and quick.
const GOOD: &str = r#"format = 1
name = "good"

[time]
steps_per_beat = 20
beats = 0.1

[motion]
frequency_hz = 100.0

[flight]
mode = "tethered"

[air]
leading_edge = "suction"
leading_edge_threshold = 0.2
bound_core.scully = { radius_m = 1e-5 }
wake_core.scully = { radius_m = 1e-4 }
wake_overlap = 0
particles = { after_rows = 2 }

[[air.gust]]
amplitude_m_s = [0, 0, 1]
table = [[0.0, 0.0], [1e-3, 1.0], [2e-3, 0.0]]

[body]
[body.part.cube]
nodes_m = [
  [-1e-3, -1e-3, -1e-3],
  [1e-3, -1e-3, -1e-3],
  [1e-3, 1e-3, -1e-3],
  [-1e-3, 1e-3, -1e-3],
  [-1e-3, -1e-3, 1e-3],
  [1e-3, -1e-3, 1e-3],
  [1e-3, 1e-3, 1e-3],
  [-1e-3, 1e-3, 1e-3],
]
quads = [
  [0, 3, 2, 1],
  [4, 5, 6, 7],
  [0, 1, 5, 4],
  [1, 2, 6, 5],
  [2, 3, 7, 6],
  [3, 0, 4, 7],
]
mass_kg = 1e-6

[wing.right]
hinge_m = [0, 1.5e-3, 0]
mass_kg = 1e-8
[wing.right.planform.outline]
leading_m = [[0.0, 0.2e-3], [2e-3, 0.2e-3]]
trailing_m = [[0.0, -0.8e-3], [2e-3, -0.8e-3]]
[wing.right.mesh]
chordwise = 2
spanwise = 3
"#;

fn refused(name: &str, from: &str, to: &str, at: &str, wanted: &[&str]) {
    refused_with(GOOD, name, [from, to], at, wanted);
}

#[test]
fn exact_the_good_case_flies_in_the_lattice() {
    let scratch = Scratch::new("air-good");
    fs::write(scratch.0.join("case.toml"), GOOD).unwrap();
    let args = ["run", "case.toml", "--out", "run", "--quiet"];
    let out = wingbeat(&scratch.0, &args);
    let said = String::from_utf8_lossy(&out.stderr).into_owned();
    assert!(out.status.success(), "{said}");
}

#[test]
fn refuses_an_inverted_panel() {
    refused(
        "air-inverted",
        "[1, 2, 6, 5]",
        "[5, 6, 2, 1]",
        "[body.part.cube]",
        &["body.part.cube", "nodes 1 and 5", "turn all faces outward"],
    );
}

#[test]
fn refuses_a_body_turned_inside_out() {
    let turned = "[\n  [1, 2, 3, 0],\n  [7, 6, 5, 4],\n  [4, 5, 1, 0],\n  [5, 6, 2, 1],\n  \
                  [6, 7, 3, 2],\n  [7, 4, 0, 3],\n]";
    let quads = &GOOD[GOOD.find("quads = [").unwrap() + 8..GOOD.find("\nmass_kg").unwrap()];
    refused(
        "air-inside",
        quads,
        turned,
        "[body.part.cube]",
        &["body.part.cube", "inward", "reverse the corner order"],
    );
}

#[test]
fn refuses_an_open_body() {
    refused(
        "air-open",
        "  [3, 0, 4, 7],\n",
        "",
        "[body.part.cube]",
        &["body.part.cube", "not closed", "close the holes"],
    );
}

#[test]
fn refuses_coincident_nodes() {
    refused(
        "air-coincident",
        "  [-1e-3, 1e-3, 1e-3],\n",
        "  [1e-3, 1e-3, 1e-3],\n",
        "  [4, 5, 6, 7]",
        &[
            "body.part.cube.quads[1]",
            "6 and 7 coincide",
            "remove the other",
        ],
    );
}

#[test]
fn refuses_an_edge_without_length() {
    refused(
        "air-edge",
        "[[0.0, -0.8e-3], [2e-3, -0.8e-3]]",
        "[[0.0, -0.8e-3], [0.0, -0.8e-3]]",
        "[wing.right.planform.outline]",
        &["trailing, row 2", "does not increase from root to tip"],
    );
}

#[test]
fn refuses_a_gust_table_that_goes_backwards() {
    refused(
        "air-gust",
        "[2e-3, 0.0]]",
        "[0.5e-3, 0.0]]",
        "table",
        &["air.gust[0].table[2]", "not later", "allowed: ", "try: "],
    );
}

#[test]
fn refuses_a_criterion_without_its_threshold() {
    refused(
        "air-threshold-deg",
        "leading_edge = \"suction\"\nleading_edge_threshold = 0.2\n",
        "leading_edge = \"angle_of_attack\"\n",
        "[air]",
        &[
            "air.leading_edge_threshold_deg",
            "needs this threshold",
            "try: ",
        ],
    );
}

#[test]
fn refuses_particles_without_a_radius_or_rows() {
    refused(
        "air-radius",
        "wake_core.scully = { radius_m = 1e-4 }\n",
        "wake_core.cut_off = { length_m = 1e-4 }\n",
        "particles",
        &["air.particles", "need a radius"],
    );
    refused(
        "air-rows",
        "after_rows = 2",
        "after_rows = 0",
        "particles",
        &["air.particles.after_rows = 0", "too small"],
    );
    refused(
        "air-nothing",
        "after_rows = 2",
        "leading_edge = false",
        "particles",
        &["air.particles", "nothing becomes a particle"],
    );
}

#[test]
fn refuses_choices_that_do_not_fit_each_other_in_the_words_of_the_case() {
    refused(
        "air-rows-beside-particles",
        "after_rows = 2 }\n",
        "after_rows = 2 }\nmax_wake_rows = 3\n",
        "max_wake_rows",
        &["air.max_wake_rows = 3", ": 3 does not fit"],
    );
    let air = GOOD.split("[air]\n").nth(1).unwrap();
    let air = air.split("\n\n").next().unwrap();
    let at_once = "leading_edge = \"never\"
bound_core.scully = { radius_m = 1e-5 }
wake_core.scully = { radius_m = 1e-4 }
wake_overlap = 0
particles = { leading_edge = true }";
    refused(
        "air-particles-of-no-edge",
        air,
        at_once,
        "particles",
        &["air.particles.leading_edge = true", "does not fit"],
    );
    refused(
        "air-lift-of-pressures",
        "leading_edge = \"suction\"\n",
        "leading_edge = \"vortex_lift\"\nloads = \"pressure\"\n",
        "loads",
        &["air.loads = \"pressure\"", ": pressure does not fit"],
    );
}
