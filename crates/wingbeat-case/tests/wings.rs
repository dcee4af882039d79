//! Deforming and joined wings, section drag and side edges from case files; what does not fit is
//! refused at its line.

use crate::common::{fly, load};
use wingbeat_flight::{AirModel, FlightSetup, Simulation};
use wingbeat_math::DVec3;
use wingbeat_model::{Wing, WingMotion};

const GOOD: &str = r#"format = 1
name = "wings"
[time]
steps_per_beat = 20
beats = 0.4
[motion]
frequency_hz = 5
[flight]
mode = "tethered"
[air]
stream_m_s = [-5, 0, 0]
scheme = "accurate"
shed = ["trailing"]
[body]
mass_kg = 0.1
inertia_about_centre_kg_m2 = [1e-4, 1e-4, 1e-4, 0, 0, 0]
[wing.right]
hinge_m = [0, 0, 0]
mass_kg = 0.01
motion.phi.fourier = { sine_deg = [20] }
[wing.right.planform.rectangle]
chord_m = 0.1
span_m = 0.4
[wing.right.mesh]
chordwise = 2
spanwise = 4
"#;

const TWIST: &str = "
[[wing.right.deformation.twist]]
table_deg = [[0, 0], [0.5, 2], [1, 10]]
fourier = { mean = 0.5, cosine = [1] }
";

fn good(text: &str, set: &[&str]) -> FlightSetup {
    load(text, set).unwrap_or_else(|e| panic!("{e}")).setup
}

fn why_refused(set: &[&str]) -> String {
    match load(GOOD, set) {
        Ok(_) => panic!("{set:?} is accepted"),
        Err(why) => why,
    }
}

/// The case is refused at the line of `at`, and the report has all of `wanted`.
fn refused(text: &str, at: &str, wanted: &[&str]) {
    let report = load(text, &[]).expect_err("refused");
    let line = text.lines().position(|l| l.contains(at)).unwrap() + 1;
    assert!(
        report.contains(&format!("case.toml:{line}:")),
        "line {line} not in:\n{report}"
    );
    for part in wanted {
        assert!(report.contains(part), "`{part}` not in:\n{report}");
    }
}

/// Nodes of a wing of four panels along the span, row by row.
fn rows_of(wing: &Wing) -> Vec<Vec<[f64; 3]>> {
    let row = |row: &[DVec3]| row.iter().map(|x| x.to_array()).collect();
    wing.mesh.nodes.chunks(5).map(row).collect()
}

#[test]
fn exact_wing_by_its_nodes_is_that_of_its_planform() {
    let by_planform = good(GOOD, &[]);
    let rows = rows_of(&by_planform.animal.wings[1]);
    let planform = "[wing.right.planform.rectangle]\nchord_m = 0.1\nspan_m = 0.4\n";
    let mesh = "[wing.right.mesh]\nchordwise = 2\nspanwise = 4\n";
    let with =
        |rows: &[Vec<[f64; 3]>]| GOOD.replace(planform, &format!("planform.nodes_m = {rows:?}\n"));
    let by_nodes = good(&with(&rows).replace(mesh, ""), &[]);
    assert_eq!(by_nodes.animal, by_planform.animal); // its mirror image, too
    refused(
        &with(&rows),
        "[wing.right.mesh]",
        &["no effect beside wing.right.planform.nodes_m"],
    );
    let mut ragged = rows.clone();
    ragged[1].pop();
    refused(
        &with(&ragged).replace(mesh, ""),
        "nodes_m",
        &["nodes_m[1]", "4 nodes", "the first row 5"],
    );
    let flat = vec![rows[0].clone(), rows[0].clone()];
    refused(&with(&flat).replace(mesh, ""), "nodes_m", &["area"]);
    refused(
        &with(&rows[..1]).replace(mesh, ""),
        "nodes_m",
        &["at least two rows"],
    );
}

/// What divides the planform of one wing of a pair is not for the nodes of the other.
#[test]
fn exact_pair_of_a_wing_by_its_nodes_and_one_by_its_planform() {
    let by_planform = good(GOOD, &[]).animal;
    let rows = rows_of(&by_planform.wings[0]);
    let own = format!("[wing.left]\nplanform.nodes_m = {rows:?}\n");
    assert_eq!(good(&format!("{GOOD}{own}"), &[]).animal, by_planform);
    let both = format!("{GOOD}{own}mesh.chordwise = 3\nmesh.spanwise = 3\n");
    let wanted = "wing.left.mesh: this has no effect beside wing.left.planform.nodes_m";
    refused(&both, "mesh.chordwise = 3", &[wanted]);
}

#[test]
fn exact_deformation_of_a_case_is_that_of_the_model() {
    let setup = good(&format!("{GOOD}{TWIST}"), &[]);
    for wing in &setup.animal.wings {
        let d = wing
            .deformation
            .as_ref()
            .expect("both wings, the image too");
        let value = d.twist[0].span.at(0.75, 0.0);
        assert!((value - 6f64.to_radians()).abs() < 1e-15); // roundings
        assert_eq!((d.twist[0].time.mean, d.twist[0].time.cos[0]), (0.5, 1.0));
        assert_eq!((d.axis_fraction, d.camber_peak), (0.25, 0.5));
    }
    // Bending is a length and grows with the animal, twist does not.
    let bending = "
[[wing.right.deformation.bending]]
linear_m = [0, 0.02]
";
    let large = good(&format!("{GOOD}{TWIST}{bending}"), &["animal.scale=2"]);
    let d = large.animal.wings[0].deformation.as_ref().unwrap();
    assert!((d.bending[0].span.at(1.0, 0.0) - 0.04).abs() < 1e-15);
    assert!((d.twist[0].span.at(0.75, 0.0) - 6f64.to_radians()).abs() < 1e-15);
}

/// A wing that flaps by 0.1 rad as its surface, measured at nine phases.
fn surface(extra: &str) -> String {
    let phases: Vec<f64> = (0..9).map(|k| 0.02 + f64::from(k) / 9.0).collect();
    let at = |x: &f64| {
        let tip = 0.04 * (std::f64::consts::TAU * x).sin();
        let row = |x: f64| [[x, 0.0, 0.0], [x, 0.4, tip]];
        [row(0.025), row(-0.075)]
    };
    let nodes: Vec<_> = phases.iter().map(at).collect();
    let table = "[wing.right.deformation.surface]";
    format!("{GOOD}{table}\nphases = {phases:?}\nnodes_m = {nodes:?}\n{extra}")
}

#[test]
fn exact_surface_of_a_case_moves_both_wings() {
    let setup = good(&surface(""), &["animal.scale=2"]);
    for wing in &setup.animal.wings {
        let mesh = wingbeat_model::DeformingMesh::new(
            &wing.mesh,
            wing.deformation.as_ref().expect("the image too"),
        );
        let tip = mesh.places(0.25)[wing.mesh.node(2, 4)];
        let far = 0.8 * wing.mesh.nodes[wing.mesh.cols].y.signum();
        let wanted = wingbeat_math::DVec3::new(-0.15, far, 0.08);
        assert!((tip - wanted).length() < 1e-14, "{tip}"); // roundings of the least squares
    }
    let still = ["wing.right.motion.phi={ constant_deg = 0 }"];
    let case = load(&surface("harmonics = 3\n"), &still).unwrap();
    let again = wingbeat_case::case_of(&case.setup, None).unwrap();
    let deformations = [&case, &again].map(|c| c.setup.animal.wings[0].deformation.clone());
    assert_eq!(deformations[0], deformations[1]);
    // The tip goes up and down by 0.04 m five times in a second; blade elements have nothing to say.
    let estimate = wingbeat_analysis::estimate(&case.setup);
    assert!(estimate.lift_over_weight.is_none());
    let speed = estimate.wings[0].tip_speed;
    assert!((speed - 4.0 * 0.04 * 5.0).abs() < 1e-3, "{speed}"); // chords of 200 pieces
    assert!(!fly(case.setup).is_empty());
}

#[test]
fn refuses_surfaces_that_do_not_fit() {
    let first = surface("");
    let phase = "phases = [0.02, ";
    refused(
        &first.replace(phase, "phases = [0.02, 0.01, "),
        "phases",
        &["surface.phases", "rise"],
    );
    refused(&surface("harmonics = 5\n"), "phases", &["fewer harmonics"]);
    refused(&surface("harmonics = 0\n"), "harmonics", &["harmonics"]);
    let short = surface("harmonics = 2\n").replace(phase, "phases = [");
    refused(&short, "nodes_m", &["9 surfaces for 8 phases"]);
    let twist = first.replace(
        "[wing.right.deformation.surface]",
        &format!("{TWIST}[wing.right.deformation.surface]"),
    );
    refused(
        &twist,
        "[[wing.right.deformation.twist]]",
        &["wing.right.deformation.twist", "surface"],
    );
    let lattice = "scheme = \"accurate\"\nshed = [\"trailing\"]";
    let blade = "model = \"blade_element\"";
    refused(
        &first.replace(lattice, blade),
        "[wing.right.deformation.surface]",
        &["wing.right.deformation.surface", "vortex_lattice"],
    );
    // Chosen on the command line: the flight refuses it.
    let setup = good(&first, &["air={ model = \"blade_element\" }"]);
    let error = Simulation::new(setup).err().expect("refused").to_string();
    assert!(error.contains("measured surface"), "{error}");
}

#[test]
fn agrees_page_poses_with_the_lattice() {
    // Where no frames are written the page draws wings from history rows; both see one shape.
    let setup = good(&format!("{GOOD}{TWIST}"), &[]);
    let wing = &setup.animal.wings[1];
    let mesh = wingbeat_model::DeformingMesh::new(&wing.mesh, wing.deformation.as_ref().unwrap());
    let mut flight = Simulation::new(setup.clone()).unwrap();
    for _ in 0..4 {
        flight.step().unwrap();
    }
    let t = flight.record().time;
    let motion = wingbeat_math::RotationLaw::at(&wing.motion, t);
    let places = mesh.places(wing.motion.phase_at(t)[0]);
    let surface = &flight.snapshot().surfaces[1];
    assert_eq!(surface.name, "right");
    for (x, y) in places.iter().zip(&surface.nodes) {
        assert!((motion.c * *x - *y).length() < 1e-14); // roundings of 0.4 m
    }
}

#[test]
fn exact_joined_wings_of_a_case_share_their_root() {
    let joined = GOOD.replace("mass_kg = 0.01", "mass_kg = 0.01\njoined = true");
    let setup = good(&joined, &[]);
    let AirModel::VortexLattice(air) = &setup.air else {
        panic!("a lattice")
    };
    assert_eq!(air.joined, [[0, 1]]);
    let [one, two] = [fly(setup), fly(good(GOOD, &[]))].map(|r| r.last().unwrap().air.clone());
    let lift = |air: &[wingbeat_dynamics::Wrench]| air.iter().map(|l| l.force.z).sum::<f64>();
    println!(
        "lift joined {:.4} N, apart {:.4} N",
        -lift(&one),
        -lift(&two)
    );
    assert!(lift(&one).abs() > 1.02 * lift(&two).abs()); // no root vortices
    // Half of it computed is the same.
    let half = fly(good(&joined, &["air.mirror=true"]));
    let gap = lift(&half.last().unwrap().air) - lift(&one);
    assert!(gap.abs() < 1e-9 * lift(&one).abs()); // roundings in a free wake
}

#[test]
fn exact_side_edges_shed_from_a_case() {
    let setup = good(GOOD, &["air.shed=[\"trailing\", \"tip\", \"root\"]"]);
    let lattice = |setup: &FlightSetup| {
        let mut flight = Simulation::new(setup.clone()).unwrap();
        flight.step().unwrap();
        flight.snapshot()
    };
    let wakes = lattice(&setup).wakes;
    assert_eq!(wakes.len(), 2);
    // Tip 2, trailing edge 4, root 2 panels.
    assert!(wakes.iter().all(|w| w.cols == 8));
    // Joined roots are no edge: nothing leaves there.
    let joined = GOOD.replace("mass_kg = 0.01", "mass_kg = 0.01\njoined = true");
    let setup = good(&joined, &["air.shed=[\"trailing\", \"tip\", \"root\"]"]);
    assert!(lattice(&setup).wakes.iter().all(|w| w.cols == 6));
}

#[test]
fn exact_section_drag_of_a_case() {
    let still = GOOD
        .replace(
            "steps_per_beat = 20\nbeats = 0.4",
            "step_s = 0.01\nsteps = 3",
        )
        .replace("motion.phi.fourier = { sine_deg = [20] }\n", "")
        .replace("frequency_hz = 5\n", "");
    let with = |keys: &str| format!("{still}\n[air.section_drag]\n{keys}\n");
    let drag = |text: &str| fly(good(text, &[])).last().unwrap().air[2].force.x;
    let closed = |viscosity: f64, cd0: f64| {
        let reynolds: f64 = 5.0 * 0.1 / viscosity;
        let friction = 2.656 / reynolds.sqrt() + 5.34 / reynolds.powf(0.875);
        -0.5 * 1.225 * 25.0 * 0.04 * (friction + cd0)
    };
    let is = |text: &str, closed: f64| {
        let drag = drag(text);
        assert!((drag / closed - 1.0).abs() < 1e-12, "{drag} {closed}"); // roundings
    };
    is(
        &with("viscosity_m2_s = 3e-5\ncd0 = 0.01"),
        closed(3e-5, 0.01),
    );
    // Friction in the air that wake_core spreads in, if nothing else is said; none where it has no viscosity.
    is(&still, closed(1.5e-5, 0.0));
    is(&with("cd0 = 0.01"), closed(1.5e-5, 0.01));
    assert_eq!(drag(&with("friction = \"none\"")), 0.0);
    let cores = "scheme = \"accurate\"\nbound_core.scully = { radius_chords = 0.01 }\nwake_core.scully = { radius_chords = 0.07 }";
    assert_eq!(drag(&still.replace("scheme = \"accurate\"", cores)), 0.0);
}

#[test]
fn refuses_deformations_that_do_not_fit() {
    let with = |from: &str, to: &str| {
        assert!(TWIST.contains(from));
        format!("{GOOD}{}", TWIST.replace(from, to))
    };
    let span = "table_deg = [[0, 0], [0.5, 2], [1, 10]]";
    let table = |rows: &str| with(span, &format!("table_deg = {rows}"));
    let at = "table_deg";
    refused(
        &table("[[0.2, 0], [1, 1]]"),
        at,
        &["twist[0].table_deg[0]", "cover"],
    );
    refused(
        &table("[[0, 0], [0.8, 1]]"),
        at,
        &["twist[0].table_deg[1]", "cover"],
    );
    refused(
        &table("[[0, 0], [0.7, 1], [0.6, 1], [1, 0]]"),
        at,
        &["table_deg[2]", "does not increase"],
    );
    refused(&table("[[0, 0], [1, nan]]"), at, &["table_deg"]);
    refused(&table("[[0, 0]]"), at, &["at least 2 elements"]);
    refused(&with("mean = 0.5", "mean = inf"), "mean = inf", &["mean"]);
    refused(
        &with(span, ""),
        "[[wing.right.deformation.twist]]",
        &["linear_deg or table_deg"],
    );
    refused(
        &with("table_deg", "table_m"),
        "table_m",
        &["unknown key", "table_deg"],
    );
    let peak = format!("{GOOD}[wing.right.deformation]\ncamber_peak = 1.5\n");
    refused(&peak, "camber_peak", &["> 0 and < 1"]);
    let unknown = format!("{GOOD}{}", TWIST.replace("right", "rigth"));
    refused(&unknown, "[[wing.rigth", &["wing.rigth"]);
    let still = format!("{GOOD}{TWIST}")
        .replace("frequency_hz = 5\n", "")
        .replace("motion.phi.fourier = { sine_deg = [20] }\n", "")
        .replace(
            "steps_per_beat = 20\nbeats = 0.4",
            "step_s = 0.01\nsteps = 3",
        );
    refused(&still, "mean = 0.5", &["no wingbeat frequency"]);
}

#[test]
fn refuses_roots_that_do_not_meet_and_drag_without_sense() {
    let joined = GOOD.replace("mass_kg = 0.01", "mass_kg = 0.01\njoined = true");
    let apart = joined.replace("hinge_m = [0, 0, 0]", "hinge_m = [0, 0.1, 0]");
    refused(
        &apart,
        "joined = true",
        &["right", "left", "2.000e-1 m apart"],
    );
    let alone = joined.replace("joined = true", "joined = true\nmirror = false");
    refused(
        &alone,
        "joined = true",
        &["no mirror image on the other side"],
    );
    let drag = |keys: &str| format!("{GOOD}[air.section_drag]\n{keys}\n");
    refused(
        &drag("cd0 = 0.1").replace(
            "scheme = \"accurate\"",
            "bound_core.scully = { radius_chords = 0.01 }\nwake_core.scully = { radius_chords = 0.07 }",
        ),
        "[air.section_drag]",
        &["viscosity_m2_s", "wake_core has none"],
    );
    refused(&drag("viscosity_m2_s = -1"), "viscosity", &["negative"]);
    refused(&drag("friction = \"none\"\ncd0 = -1"), "cd0", &["negative"]);
    refused(
        &drag("friction = \"none\"\ncd2_per_rad2 = nan"),
        "cd2",
        &["cd2_per_rad2"],
    );
    refused(
        &drag("friction = \"turbulent\""),
        "friction",
        &["blasius, none"],
    );
    // Wings that part in flight say when.
    let parting = joined
        .replace("motion.phi", "motion.psi.constant_deg = 40\nmotion.phi")
        .replace("sine_deg = [20]", "sine_deg = [60]")
        .replace("beats = 0.4", "beats = 1");
    let mut flight = Simulation::new(good(&parting, &[])).unwrap();
    let error = loop {
        match flight.step() {
            Ok(_) => assert!(!flight.finished(), "never refused"),
            Err(e) => break e.to_string(),
        }
    };
    assert!(
        error.contains("joined roots") && error.contains("t = "),
        "{error}"
    );
}

#[test]
fn refuses_what_acts_on_one_point_of_an_elastic_wing() {
    let beam = "[wing.right.structure.beam]\nflap_newton_m2 = [1, 1]\ntorsion_newton_m2 = [1, 1]\n";
    let load_on = "[[load]]\non = \"right\"\nforce_newton = [0, 0, 1]\npoint_m = [0, 0.4, 0]\n";
    let spring = "[spring.t]\nbetween = [\"body\", \"right\"]\nat_m = [[0, 0, 0.1], [0, 0.4, 0]]\nstiffness_newton_per_m = 1\n";
    let store = "[segment.store]\nmass_kg = 1e-3\ncentre_m = [0, 0, 0]\ninertia_about_centre_kg_m2 = [1e-7, 1e-7, 1e-7, 0, 0, 0]\n[joint.s]\nparent = \"right\"\nchild = \"store\"\nat_m = [0, 0.4, 0]\n";
    for (what, key) in [
        (load_on, "load[0].on"),
        (spring, "spring.t.between[1]"),
        (store, "joint.s.parent"),
    ] {
        let rigid = format!("{GOOD}{what}");
        good(&rigid, &["air.model=none"]);
        let error = load(&format!("{rigid}{beam}"), &["air.model=none"]).unwrap_err();
        assert!(error.contains(key) && error.contains("bends"), "{error}");
    }
}

#[test]
fn invariant_motion_that_a_wing_leaves_out_is_the_mirror_image_of_its_counterpart() {
    let right_of = [
        "wing.right.motion.psi.fourier={ mean_deg = 8, cosine_deg = [30] }",
        "wing.right.motion.stroke_plane_pitch_deg=20",
    ];
    let wings = |left: &str| {
        let set: Vec<&str> = right_of.iter().copied().chain([left]).collect();
        let wings = good(GOOD, &set).animal.wings;
        ["left", "right"].map(|name| {
            let named = wings.iter().find(|w| w.name == name);
            named.map(|w| w.motion.clone()).expect("the wing")
        })
    };
    let [left, right] = wings("wing.left.motion.phase=0.25");
    let late = WingMotion {
        phase: 0.25,
        ..right.mirrored()
    };
    assert_eq!(left, late);
    assert_eq!(right.phase, 0.0);

    // Measured angles are whole: nothing of the other wing is mixed in.
    let [left, right] = wings("wing.left.motion.data=\"fry-hover\"");
    assert_ne!(left.angles.psi, right.angles.psi);
    assert_ne!(left.angles.theta, right.mirrored().angles.theta);
    assert_eq!(left.stroke_plane_pitch, 0.0);
}

#[test]
fn refuses_strokes_and_feathering_of_one_wing_alone() {
    let right_of = ["wing.right.motion.psi.fourier={ mean_deg = 8, cosine_deg = [30] }"];
    for (key, more) in [
        ("psi", "wing.left.motion.phi.fourier={ sine_deg = [25] }"),
        ("phi", "wing.left.motion.theta={ constant_deg = 3 }"),
    ] {
        let refused = why_refused(&[right_of[0], more]);
        let key = format!("wing.left.motion.{key}");
        assert!(
            refused.contains(&key) && refused.contains("constant_deg = 0"),
            "{refused}"
        );
    }
}

#[test]
fn refuses_panels_that_one_wing_of_a_pair_leaves_out() {
    let refused = why_refused(&["wing.left.mesh.chordwise=3"]);
    for word in ["wing.left.mesh.spanwise", "10", "4 on wing `right`"] {
        assert!(refused.contains(word), "{refused}");
    }
    let setup = good(GOOD, &["wing.left.mesh={ chordwise = 3, spanwise = 4 }"]);
    let panels = |name: &str| {
        let wing = setup.animal.wings.iter().find(|w| w.name == name);
        wing.map(|w| [w.mesh.rows, w.mesh.cols]).expect("the wing")
    };
    assert_eq!([panels("left"), panels("right")], [[3, 4], [2, 4]]);
}
