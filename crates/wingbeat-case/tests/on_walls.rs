//! Half a model on a wall, and its counterpart of two wings with joined roots: what is said of them and what
//! they spend.

use crate::common;
use wingbeat_flight::{FlightSetup, Record, Simulation};
use wingbeat_math::DVec3;

/// A wing at 22 deg whose root lies on the wall y = 0 of a wind tunnel.
const HALF: &str = r#"
format = 1
gravity_m_s2 = [0, 0, 0]
[time]
step_s = 0.002
steps = 20
[flight]
mode = "tethered"
[air]
stream_m_s = [-3, 0, 0]
body = false
shed = ["trailing"]
ground = { normal = [0, 1, 0], point_m = [0, 0, 0] }
[body]
mass_kg = 0.02
inertia_about_centre_kg_m2 = [1e-5, 1e-5, 1e-5, 0, 0, 0]
[wing.right]
hinge_m = [0, 0, 0]
mirror = false
mass_kg = 0.0005
motion.psi.constant_deg = 22
planform.rectangle = { chord_m = 0.03, span_m = 0.09, axis_fraction = 0.25 }
mesh = { chordwise = 3, spanwise = 4 }
"#;

/// Both halves of the same.
const WHOLE: [&str; 3] = [
    "wing.right.mirror=true",
    "wing.right.joined=true",
    "air.ground=",
];

/// Elastic wings that feather.
const ELASTIC: [&str; 9] = [
    "time={ steps_per_beat = 40, beats = 1 }",
    "motion={ frequency_hz = 6, start = \"smooth\", start_beats = 1 }",
    "air.stream_m_s=[-10, 0, 0]",
    "wing.right.motion.psi={ fourier = { mean_deg = 4, sine_deg = [3] } }",
    "wing.right.planform.rectangle={ chord_m = 0.1, span_m = 0.3, axis_fraction = 0.25 }",
    "wing.right.mass_kg=0.02",
    "wing.right.structure.mass_damping_per_s=5",
    "wing.right.structure.beam={ axis_fraction = 0.25, flap_newton_m2 = [0.4, 0.3], torsion_newton_m2 = [0.06, 0.05], mass_fraction = 0.3 }",
    "air.loads=\"joukowski\"",
];

fn setup(keys: &[&str]) -> FlightSetup {
    let case = common::load(HALF, keys).unwrap_or_else(|e| panic!("{keys:?}: {e}"));
    case.setup
}

/// Bending is no deformation that anything drives: wings whose roots stay together, by a joint edge or by a
/// wall, need no power for that, and drive themselves with what wings need whose roots nothing joins, but for
/// the flow past these.
#[test]
fn exact_joining_the_roots_of_elastic_wings_that_stay_together_takes_no_power() {
    let flown = |keys: &[&str]| common::fly(setup(&[&ELASTIC, keys].concat()));
    let most = |records: &[Record], of: &dyn Fn(&Record) -> f64| {
        records.iter().map(of).map(f64::abs).fold(0.0, f64::max)
    };
    let driving = |r: &Record| r.driving_power() / r.elastic.len() as f64;
    let parted = ["wing.right.mirror=true", "air.ground="];
    let parted = most(&flown(&parted), &driving);
    for keys in [&[][..], &WHOLE] {
        let records = flown(keys);
        let joining = most(&records, &|r| {
            r.deformation_power.iter().fold(0.0, |m, p| p.abs().max(m))
        });
        let bending = most(&records, &|r| r.elastic[0].air_power);
        let driving = most(&records, &driving);
        println!(
            "{keys:?}: joining {joining:e} W, bending {bending:e} W, driving {driving:e} W, roots free {parted:e} W"
        );
        // Roots that are held do not move at all but for roundings of their places.
        assert!(
            bending > 1e-3 && joining < 1e-16 * bending,
            "{keys:?}: {joining:e}"
        );
        // The flow past free roots makes 1.4e-2; twice the bending would be 5 times as much.
        assert!((driving / parted - 1.0).abs() < 0.05, "{driving} {parted}");
    }
}

/// Where roots that are joined part, moving their edges takes of elastic wings that hardly bend what it takes
/// of rigid ones.
#[test]
fn limit_joining_stiff_elastic_wings_takes_what_joining_rigid_ones_takes() {
    let stiff = "wing.right.structure.beam={ axis_fraction = 0.25, flap_newton_m2 = [4000, 3000], torsion_newton_m2 = [600, 500], mass_fraction = 0.3 }";
    let unlike = "motion.difference.feathering_amplitude=0.2";
    let [rigid, bent] = [&ELASTIC[..6], &[&ELASTIC[..6], &[stiff]].concat()].map(|keys| {
        let keys = [keys, &WHOLE, &[ELASTIC[8], unlike]].concat();
        common::fly(setup(&keys))
    });
    let most = rigid.iter().flat_map(|r| &r.deformation_power);
    let most = most.fold(0.0, |m, p| p.abs().max(m));
    let both = rigid.iter().zip(&bent);
    let off = both.flat_map(|(a, b)| a.deformation_power.iter().zip(&b.deformation_power));
    let off = off.fold(0.0, |m, (a, b)| (a - b).abs().max(m));
    println!("joining {most:e} W, of stiff wings off by {off:e} W");
    // What is left of bending.
    assert!(most > 1e-6 && off < 1e-4 * most, "{off:e} of {most:e}");
}

/// What is said of half a model is said of the whole, too.
#[test]
fn invariant_doubts_of_half_a_model_are_those_of_the_whole() {
    let leading = "air.shed=[\"trailing\", \"tip\", \"leading\"]";
    let implicit = "air.leading_edge=\"suction_implicit\"";
    for (keys, is_named) in [
        (
            &["wing.right.motion.psi.constant_deg=30"][..],
            [true, false],
        ),
        (&[leading, implicit], [false, false]),
        (&["wing.right.motion.psi.constant_deg=6"], [false, false]),
    ] {
        for model in [&[][..], &WHOLE] {
            let set = setup(&[keys, model].concat());
            let said = [set.attached_beyond_stall(), set.one_sided_leading_edges()];
            let named = said.each_ref().map(Option::is_some);
            assert_eq!(named, is_named, "{keys:?} {model:?}: {said:?}");
        }
    }
    // Without the wall the root holds.
    let free = setup(&[leading, implicit, "air.ground="]);
    let said = free.one_sided_leading_edges();
    assert!(said.is_some_and(|s| s.contains("as roots hold")));
}

/// Beyond the wall on which half a model stands there is no air, wherever its body is.
#[test]
fn behaves_there_is_no_air_beyond_the_wall_of_half_a_model() {
    let flight = Simulation::new(setup(&[])).unwrap();
    let at = |y: f64| DVec3::new(0.1, y, 0.02);
    let in_air = flight.is_in_air(&[0.05, 1e-6, 0.0, -1e-6, -0.05].map(at));
    assert_eq!(in_air, [true, true, true, false, false]);
}

/// Roots that lie on the wall side by side are joined to their own images: no circulation ends there. Away from
/// it, wings that are not left and right of each other are not advised to be joined, which no key does.
#[test]
fn behaves_roots_that_meet_on_a_wall_are_not_to_be_joined() {
    let two = [
        "wing.right.motion={ phi.constant_deg = 20 }",
        "wing.upper={ side = \"right\", hinge_m = [0, 0, -1e-3], mass_kg = 5e-4, motion = { phi = { constant_deg = -20 } }, planform = { rectangle = { chord_m = 0.03, span_m = 0.09, axis_fraction = 0.25 } }, mesh = { chordwise = 3, spanwise = 4 } }",
    ];
    assert_eq!(setup(&two).unjoined_roots(), [""; 0]);
    let apart = setup(&[&two[..], &["air.ground="]].concat());
    let said = apart.unjoined_roots();
    assert!(
        said.len() == 1 && !said[0].contains("joined = true") && said[0].contains("hinge_m"),
        "{said:?}"
    );
    let whole = setup(&["wing.right.mirror=true", "air.ground="]).unjoined_roots();
    assert!(
        whole.len() == 1 && whole[0].contains("joined = true"),
        "{whole:?}"
    );
}

/// A root on the wall is joined to its image; two wings whose roots are joined there lie on both sides of it.
#[test]
fn refuses_a_joined_pair_across_a_wall() {
    let pair = setup(&WHOLE[..2]);
    let error = Simulation::new(pair).map(|_| ()).unwrap_err().to_string();
    for words in ["air.ground", "`left`", "`right`", "mirror = false"] {
        assert!(error.contains(words), "{error}");
    }
}

/// Wings that lie in the ground have no gap below them.
#[test]
fn behaves_wings_in_the_plane_of_the_ground_touch_it() {
    let flat = [
        "air.ground.normal=[0,0,1]",
        "wing.right.motion.psi.constant_deg=0",
    ];
    let said = setup(&flat).surfaces_in_narrow_gaps();
    assert!(
        said.len() == 1 && said[0].contains("surfaces touch") && !said[0].contains("inf"),
        "{said:?}"
    );
}
