//! What summaries say of flights without wakes, in thick air and on tethers that move.

use crate::flights::{flown, preset, says};
use wingbeat_flight::Simulation;

/// A bird's wings in a stream, of which no edge sheds.
const NO_WAKE: [&str; 5] = [
    "air.shed=[]",
    "air.clearance_m=",
    "air.bound_core=",
    "air.wake_core=",
    "time.beats=0.1",
];

#[test]
fn behaves_nothing_is_said_of_wakes_that_are_not_shed() {
    let still = flown(&preset("bird-cruise", &NO_WAKE));
    assert!(
        says(&still, "No edge of the wings sheds"),
        "{:?}",
        still.warnings
    );
    for words in ["vortex core (", "Induced drag behind attached wings"] {
        assert!(!says(&still, words), "{:?}", still.warnings);
    }
    let flies = flown(&preset("bird-cruise", &["time.beats=0.1"]));
    assert!(says(&flies, "vortex core (") && !says(&flies, "No edge"));
}

/// Forces where there is no wake, with a core of wakes of this radius.
fn force(radius: f64) -> [f64; 3] {
    let core =
        format!("air.wake_core.algebraic={{ radius_chords = {radius}, viscosity_m2_s = 2e-5 }}");
    let set = [&NO_WAKE[..], &[&core]].concat();
    let mut flight = Simulation::new(preset("bird-cruise", &set).setup).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
    flight.record().air[1].force.to_array()
}

#[test]
fn invariant_cores_of_wakes_that_are_not_shed_act_on_nothing() {
    let [thin, wide] = [0.01, 0.3].map(force);
    assert_eq!(thin, wide);
    assert!(thin.iter().any(|f| *f != 0.0));
}

#[test]
fn behaves_reynolds_numbers_at_which_friction_rules_are_told() {
    let low = "Reynolds number";
    let set = ["time.beats=0.5", "animal.scale=0.1"];
    let small = flown(&preset("fruit-fly-blade", &set));
    assert!(says(&small, low), "{:?}", small.warnings);
    let fly = flown(&preset("fruit-fly-blade", &set[..1]));
    assert!(!says(&fly, low), "{:?}", fly.warnings);
    // A third of the fly's size at its frequency: 13. Coefficients of one's own may know it.
    let third = ["time.beats=0.2", "animal.scale=0.3333"];
    let named = flown(&preset("fruit-fly-blade", &third));
    assert!(
        says(&named, "`left`: Reynolds number 13.") && says(&named, "dickson-2008"),
        "{:?}",
        named.warnings
    );
    let own = "air.blade={own={lift=1,drag_0=0.4,drag_90=3}}";
    let own = flown(&preset("fruit-fly-blade", &[&third[..], &[own]].concat()));
    assert!(!says(&own, low), "{:?}", own.warnings);
}

/// A frequency below 0 turns the phase alone; an amplitude of 0 moves nothing.
#[test]
fn behaves_what_a_period_of_the_tether_sheds_is_told_where_it_oscillates() {
    let says_so = |frequency: f64, amplitude: f64| {
        let tether = format!(
            "flight.tether.z={{ frequency_hz = {frequency:?}, cosine_m = [{amplitude:?}] }}"
        );
        let summary = flown(&preset("benchmark-1", &[&tether, "time.steps=4"]));
        says(&summary, "what is shed in a period")
    };
    assert!(says_so(50.0, 1e-3) && says_so(-50.0, 1e-3));
    assert!(!says_so(50.0, 0.0));
}

/// A smooth start takes half of its length, here half a beat, from the strokes alone.
#[test]
fn exact_tethers_out_of_step_with_the_strokes_are_told_by_how_much() {
    let tether = "flight.tether.z={ frequency_hz = 200, cosine_m = [1e-4] }";
    let said = |more: &[&str]| {
        let all = [
            &[
                "flight.mode=tethered",
                "motion.frequency_hz=200",
                "motion.start=smooth",
                "time.beats=0.2",
                tether,
            ],
            more,
        ]
        .concat();
        let summary = flown(&preset("fruit-fly-blade", &all));
        assert!(
            says(&summary, "no part of the power"),
            "{:?}",
            summary.warnings
        );
        let told = summary
            .warnings
            .into_iter()
            .find(|w| w.contains("out of step"));
        told.map(|w| w.split("and is ").nth(1).unwrap()[..5].to_owned())
    };
    assert_eq!(said(&[]).as_deref(), Some("0.500"));
    assert_eq!(said(&["motion.start_beats=0.5"]).as_deref(), Some("0.250"));
    for in_step in [
        "motion.start=impulsive",
        "motion.start_beats=2",
        "flight.tether.start_s=5e-3",
    ] {
        assert_eq!(said(&[in_step]), None, "{in_step}");
    }
    let other = "flight.tether.z.frequency_hz=270";
    assert_eq!(said(&[other]), None);
}

/// Leading edges that may shed: at a small incidence they hold their suction, and nothing is said or counted of what
/// they did not shed.
#[test]
fn behaves_only_what_leading_edges_shed_is_told() {
    for (incidence, sheds) in [(2.0, false), (25.0, true)] {
        let summary = flown(&preset(
            "rectangular-wing",
            &[
                "time.steps=20",
                "air.shed=[\"trailing\", \"leading\"]",
                "air.leading_edge=suction",
                "air.scheme=accurate",
                "air.bound_core=",
                "air.wake_core=",
                "air.loads=joukowski",
                "air.clearance_m=1e-2",
                &format!("wing.right.motion.psi.constant_deg={incidence}"),
            ],
        ));
        let rings = summary.leading_rings.unwrap();
        assert_eq!(rings > 0.0, sheds, "{incidence}: {rings}");
        assert_eq!(says(&summary, "Leading edges shed:"), sheds);
        assert_eq!(says(&summary, "and shed nothing"), !sheds);
        assert_eq!(summary.regularised > 0, sheds, "{:?}", summary.warnings);
    }
}

/// Loads without the rate of the circulation lack added mass; the impulse of the vorticity, which has it, is not held
/// against them.
#[test]
fn behaves_loads_without_the_circulation_rate_are_named() {
    let set = [
        "air.mirror=true",
        "air.body=false",
        "air.shed=[\"trailing\"]",
        "air.circulation_rate=omitted",
        "time.beats=0.4",
        "wing.right.mesh={ chordwise = 2, spanwise = 4 }",
    ];
    let summary = flown(&preset("fruit-fly-tethered", &set));
    let said = &summary.warnings;
    assert!(says(&summary, "Loads are quasi-steady"), "{said:?}");
    assert!(!says(&summary, "impulse in play"), "{said:?}");
}

/// Nothing leaves leading edges that never shed, though `air.shed` names them: flow is attached.
#[test]
fn behaves_leading_edges_that_never_shed_are_those_of_attached_flow() {
    let shed = "air.shed=[\"trailing\", \"leading\"]";
    let set = [shed, "air.leading_edge=never", "time.beats=0.1"];
    let summary = flown(&preset("bird-cruise", &set));
    let said = &summary.warnings;
    assert!(
        says(&summary, "Induced drag behind attached wings"),
        "{said:?}"
    );
    assert!(!says(&summary, "less on faces"), "{said:?}");
}

/// Wide cores smooth the wake of a plate that plunges, whether its leading edge may not shed or sheds nothing.
#[test]
fn behaves_smoothed_wakes_are_told_where_leading_edges_hold_their_suction() {
    for (shed, radius, is_told) in [
        (r#"["trailing"]"#, 0.07, true),
        (r#"["trailing", "leading"]"#, 0.07, true),
        (r#"["trailing", "tip", "leading"]"#, 0.07, true),
        (r#"["trailing", "leading"]"#, 0.005, false),
    ] {
        let summary = flown(&preset(
            "rectangular-wing",
            &[
                "time.steps=24",
                "flight.tether.z={ frequency_hz = 20, cosine_m = [-1e-3] }",
                &format!("air.shed={shed}"),
                "air.scheme=accurate",
                "air.bound_core=",
                &format!("air.wake_core={{ algebraic = {{ radius_chords = {radius} }} }}"),
                "air.loads=joukowski",
                "wing.right.motion.psi.constant_deg=1",
            ],
        ));
        let said = says(
            &summary,
            "hangs on the cores of the wake where it changes fast",
        );
        assert_eq!(said, is_told, "{shed} {radius}: {:?}", summary.warnings);
    }
}
