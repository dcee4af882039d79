//! Bodies, joints and springs that cannot be built are refused at their line.

use std::path::Path;

use wingbeat_case::{LoadedCase, presets};

/// The report on a preset whose text has `from` replaced by `to`; the line that holds `at` must be
/// named.
fn refused(preset: &str, from: &str, to: &str, at: &str) -> String {
    let text = presets::find(preset).unwrap().text;
    assert!(text.contains(from), "the test replaces nothing");
    let text = text.replacen(from, to, 1);
    let e = LoadedCase::from_text("case.toml", &text, Path::new(""), &[]);
    let report = e
        .err()
        .unwrap_or_else(|| panic!("accepted: {to}"))
        .to_string();
    let line = text.lines().position(|l| l.contains(at)).unwrap() + 1;
    assert!(
        report.contains(&format!("case.toml:{line}:")),
        "line {line} not in:\n{report}"
    );
    println!("{report}\n");
    report
}

const WAIST: &str =
    "[joint.waist]              # free to nod, held by a spring\nchild = \"abdomen\"";

#[test]
fn refuses_a_disconnected_body() {
    let to = "[joint.waist]\nchild = \"head\"";
    let report = refused("fruit-fly-abdomen-spring", WAIST, to, "[segment.abdomen]");
    assert!(report.contains("disconnected") && report.contains("child = \"abdomen\""));
}

#[test]
fn refuses_a_body_that_does_not_exist() {
    let to = "[joint.waist]\nchild = \"abdomn\"";
    let report = refused("fruit-fly-abdomen-spring", WAIST, to, "abdomn");
    assert!(report.contains("there is no body `abdomn`") && report.contains("abdomen"));
}

#[test]
fn refuses_a_loop_that_cannot_close() {
    // A second bar from the body to the abdomen's end, whose two ends are farther apart than the
    // nodding abdomen can reach.
    let stay = "[joint.zstay]\nchild = \"abdomen\"\nat_m = [0, 0, 3e-3]\nat_child_m = [-1.2e-3, 0, 0]\nkind = \"spherical\"\n\n";
    let report = refused(
        "fruit-fly-abdomen-spring",
        WAIST,
        &format!("{stay}{WAIST}"),
        "[joint.zstay]",
    );
    assert!(
        report.contains("cannot be closed") || report.contains("contradict"),
        "{report}"
    );
}

#[test]
fn refuses_two_joints_of_one_pair_that_contradict() {
    let weld = "[joint.zweld]\nchild = \"abdomen\"\nat_m = [-0.174e-3, 0, 0]\nturn = { axis = [1, 0, 0], mean_deg = 20 }\n\n";
    let report = refused(
        "fruit-fly-abdomen-spring",
        WAIST,
        &format!("{weld}{WAIST}"),
        "[joint.zweld]",
    );
    assert!(
        report.contains("`waist`") && report.contains("`zweld`"),
        "{report}"
    );
}

/// A slider and its crank, which leads; crank 0.1 m, rod 0.3 m.
const SLIDER_CRANK: &str = "format = 1
time = { step_s = 0.001, steps = 5 }
flight.mode = \"tethered\"
air.model = \"none\"
[body]
mass_kg = 2
inertia_about_centre_kg_m2 = [0.1, 0.1, 0.1, 0, 0, 0]
[segment.crank]
mass_kg = 0.2
centre_m = [0.05, 0, 0]
inertia_about_centre_kg_m2 = [1e-4, 2e-4, 2e-4, 0, 0, 0]
[segment.slide]
mass_kg = 0.05
centre_m = [0.4, 0, 0]
inertia_about_centre_kg_m2 = [1e-5, 1e-5, 1e-5, 0, 0, 0]
[segment.rod]
mass_kg = 0.1
centre_m = [0.25, 0, 0]
inertia_about_centre_kg_m2 = [1e-4, 1e-3, 1e-3, 0, 0, 0]
[joint.a_crank]
child = \"crank\"
at_m = [0, 0, 0]
kind = \"revolute\"
axis = [0, 1, 0]
start_deg = [60]
start_deg_s = [500]
[joint.b_rod]
child = \"rod\"
parent = \"crank\"
at_m = [0.1, 0, 0]
kind = \"revolute\"
axis = [0, 1, 0]
[joint.c_slide]
child = \"slide\"
at_m = [0.4, 0, 0]
kind = \"prismatic\"
axis = [1, 0, 0]
[joint.d_pin]
child = \"rod\"
parent = \"slide\"
at_m = [0.4, 0, 0]
kind = \"point_on_line\"
axis = [0, 1, 0]
";

#[test]
fn refuses_starts_that_closed_loops_do_not_admit() {
    let load = |set: &[String]| {
        let case = LoadedCase::from_text("crank", SLIDER_CRANK, Path::new(""), set);
        case.map_err(|e| e.to_string())
    };
    load(&[]).unwrap();
    // By the law of sines, with the rates: angles of crank a and rod b against the slide, sin b = sin a / 3.
    let (a, a_rate) = (60f64.to_radians(), 500f64.to_radians());
    let b = (a.sin() / 3.0).asin();
    let b_rate = a.cos() / 3.0 / b.cos() * a_rate;
    let [turn, rate] = [-(a + b), -(a_rate + b_rate)].map(f64::to_degrees);
    let slid = 0.1 * (a.cos() - 1.0) + 0.3 * (b.cos() - 1.0);
    let speed = -0.1 * a.sin() * a_rate - 0.3 * b.sin() * b_rate;
    for (key, asked, unit) in [
        ("b_rod.start_deg", turn, "deg"),
        ("b_rod.start_deg_s", rate, "deg/s"),
        ("c_slide.start_m", slid, "m"),
        ("c_slide.start_m_s", speed, "m/s"),
    ] {
        let set = |x: f64| match unit {
            "deg" | "deg/s" => [format!("joint.{key}=[{x}]")],
            _ => [format!("joint.{key}={x}")],
        };
        let said = load(&set(1.1 * asked)).unwrap_err();
        let words = format!(
            "the closed loops ask for {:.2}",
            (asked * 1e2).trunc() / 1e2
        );
        assert!(said.contains(&format!("joint.{key}")), "{said}");
        assert!(said.contains(&words), "{words}: {said}");
        load(&set(asked)).unwrap_or_else(|e| panic!("{e}"));
        load(&set((asked * 1e6).round() / 1e6)).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn refuses_joints_that_ask_for_the_same_twice() {
    let weld = "[joint.zagain]\nchild = \"abdomen\"\nat_m = [-0.174e-3, 0, 0]\nkind = \"revolute\"\naxis = [0, 1, 0]\n\n";
    let report = refused(
        "fruit-fly-abdomen-spring",
        WAIST,
        &format!("{weld}{WAIST}"),
        "[joint.zagain]",
    );
    assert!(report.contains("the same thing twice"), "{report}");
}

#[test]
fn refuses_inertia_that_no_body_has() {
    for (inertia, why) in [
        ("[1e-14, 1e-14, 5e-14, 0, 0, 0]", "triangle"),
        ("[1e-14, 1e-14, 1e-14, 2e-14, 0, 0]", "inertia"),
    ] {
        let to =
            format!("[segment.abdomen]\nmass_kg = 0.4e-6\ninertia_about_centre_kg_m2 = {inertia}");
        let report = refused(
            "fruit-fly-abdomen-spring",
            "[segment.abdomen]",
            &to,
            inertia,
        );
        assert!(report.contains(why), "{report}");
    }
}

#[test]
fn refuses_axes_directions_and_units_that_do_not_fit() {
    let preset = "fruit-fly-abdomen-spring";
    refused(
        preset,
        "axis = [0, 1, 0]",
        "axis = [0, 0, 0]",
        "axis = [0, 0, 0]",
    );
    refused(
        preset,
        "kind = \"revolute\"",
        "kind = \"prismatic\"",
        "stiffness_newton_m_per_rad",
    );
    let second = "[[joint.waist.element]]\ndirection = 1";
    refused(preset, "[[joint.waist.element]]", second, "direction = 1");
    let euler = "[dynamics]\nformulation = \"euler\"\n";
    let line = "formulation = \"euler\"";
    refused(preset, "[dynamics]\n", euler, line);
}

#[test]
fn refuses_springs_that_span_nothing() {
    let said = |spring: &str| {
        let set = ["air.model=none", "spring.tendon="].map(str::to_owned);
        let set = [set[0].clone(), format!("{}{spring}", set[1])];
        LoadedCase::find("fruit-fly-vacuum", &set)
            .map(|_| ())
            .unwrap_err()
            .to_string()
    };
    let one = said("{ between = [\"body\", \"body\"], at_m = [[0, 0, 0], [1e-3, 0, 0]] }");
    assert!(
        one.contains("spring.tendon.between") && one.contains("two bodies"),
        "{one}"
    );
    let none = said("{ between = [\"body\", \"tail\"], at_m = [[0, 0, 0], [1e-3, 0, 0]] }");
    assert!(
        none.contains("spring.tendon.between[1]") && none.contains("right"),
        "{none}"
    );
    let idle = said("{ between = [\"body\", \"right\"], at_m = [[0, 0, 0], [1e-3, 0, 0]] }");
    assert!(
        idle.contains("spring.tendon") && idle.contains("no effect"),
        "{idle}"
    );
}
