//! What `check` says before a flight: of gusts between the steps, of wings that a tether alone moves through a
//! viscous fluid, of gusts that blow while the lift is estimated, and how fast it says it of flights of very
//! many steps.

use std::path::Path;
use std::time::Instant;

use wingbeat_analysis::{doubtful_reynolds_numbers, estimate};
use wingbeat_case::LoadedCase;
use wingbeat_flight::{DoubtKind, Simulation};

/// Two wings of chord 0.16 m that revolve at 72 deg/s, their tips at 0.65 m/s; of this viscosity [m2/s] and
/// step \[s\], for so many steps.
fn rotor(viscosity: f64, (step, steps): (f64, u64), more: &str) -> LoadedCase {
    let text = format!(
        "format = 1\n{more}\n[time]\nstep_s = {step}\nsteps = {steps}\n[flight]\nmode = \"tethered\"\ntether.yaw.rate_deg_s = -72\n\
         [air]\ndensity_kg_m3 = 1.2\nbody = false\nshed = [\"trailing\"]\n\
         wake_core.algebraic = {{ radius_chords = 0.07, viscosity_m2_s = {viscosity} }}\n\
         [body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]\n\
         [wing.right]\nhinge_m = [0, 0, 0]\nmass_kg = 0\nmotion.psi.constant_deg = 40\n\
         planform.rectangle = {{ chord_m = 0.16, span_m = 0.46, root_offset_m = 0.06, axis_fraction = 0.25 }}\n\
         mesh = {{ chordwise = 4, spanwise = 8 }}\n[wing.left]\nmotion.psi.constant_deg = 140\n"
    );
    LoadedCase::from_text("rotor", &text, Path::new(""), &[]).unwrap()
}

fn fly_in(set: &[&str]) -> LoadedCase {
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    LoadedCase::find("fruit-fly-blade", &set).unwrap()
}

/// Tips at 0.66 m/s and a mean chord of 0.1415 m from the hinge on: 78 at 1.2e-3 m2/s, 104 at 9e-4 m2/s.
#[test]
fn behaves_low_reynolds_numbers_of_wings_that_a_tether_moves_are_named() {
    let said = |viscosity| doubtful_reynolds_numbers(&rotor(viscosity, (0.1, 20), "").setup);
    let low = said(1.2e-3);
    assert!(
        low.len() == 1 && low[0].contains("is below 100: there the lift of wings falls"),
        "{low:?}"
    );
    assert!(said(9e-4).is_empty(), "{:?}", said(9e-4));
}

/// A wing of 0.1 m chord that glides at 2 deg and 10 m/s (Reynolds number 66,667): the coefficients have 0.412 where twice
/// the friction of a plate is 4 x 1.328 / sqrt(66667), so the excess is 0.392 of the size 0.432 of the force.
#[test]
fn exact_drag_of_coefficients_of_slow_wings_is_named_at_small_incidence() {
    let said = |incidence: f64, more: &[&str]| {
        let text = format!(
            "format = 1\n[time]\nstep_s = 1e-3\nsteps = 20\n[flight]\nmode = \"tethered\"\npitch_deg = {incidence}\n\
             [air]\nmodel = \"blade_element\"\ndensity_kg_m3 = 1.2\nstream_m_s = [-10, 0, 0]\n\
             viscosity_m2_s = 1.5e-5\n\
             [body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]\n\
             [wing.right]\nhinge_m = [0, 0, 0]\nmass_kg = 0\nmotion.phi.constant_deg = 0\n\
             planform.rectangle = {{ chord_m = 0.1, span_m = 0.5 }}\n"
        );
        let set: Vec<String> = more.iter().map(|&s| s.to_owned()).collect();
        let case = LoadedCase::from_text("glide", &text, Path::new(""), &set).unwrap();
        doubtful_reynolds_numbers(&case.setup)
    };
    let glides = said(2.0, &[]);
    assert_eq!(glides.len(), 1, "{glides:?}");
    for part in [
        "about 66667",
        "of 0.02, for which these coefficients have 0.41",
        "91 % of",
    ] {
        assert!(glides[0].contains(part), "{part}: {glides:?}");
    }
    // Strokes at 40 deg, and coefficients of one's own, are not meant.
    assert_eq!(said(40.0, &[]), [""; 0]);
    let own = "air.blade.own={lift=1.2,drag_0=0.4,drag_90=2}";
    assert_eq!(said(2.0, &[own]), [""; 0]);
    for set in [
        ["flight.velocity_m_s=[0,0,0]"],
        ["flight.velocity_m_s=[1,0,0]"],
    ] {
        let flies = doubtful_reynolds_numbers(&fly_in(&set).setup);
        assert_eq!(flies, [""; 0], "{set:?}");
    }
}

/// A look at a rotor takes no longer where it is to fly for 1e9 steps, and says the same of attached flow at 40
/// deg.
#[test]
fn behaves_looks_at_long_flights_are_short() {
    let stall = |steps| {
        let setup = rotor(1.5e-5, (0.1, steps), "").setup;
        let doubts = setup.doubts().into_iter();
        let found: Vec<_> = doubts
            .filter(|d| d.kind == DoubtKind::AttachedBeyondStall)
            .collect();
        (found, estimate(&setup).wings[0].speed)
    };
    let begun = Instant::now();
    let (long, speed) = stall(1_000_000_000);
    // Of 1e9 steps it took minutes; 2000 looks take some ms, and other tests run beside.
    assert!(begun.elapsed().as_secs() < 20, "{:?}", begun.elapsed());
    let (short, known) = stall(2000);
    assert_eq!((long.len(), short.len()), (1, 1), "{long:?} {short:?}");
    assert!((speed - known).abs() < 1e-9, "{speed} {known}");
}

/// A foil that a tether heaves by a tenth of its chord at the reduced frequency 3.93 stays below stall, as the wake takes
/// half of its incidence, however long it is flown; by a look every 100 steps it would be far beyond.
#[test]
fn invariant_stall_of_a_foil_on_a_tether_under_the_length_of_its_flight() {
    let said = |steps: u64| {
        let text = format!(
            "format = 1\n[time]\nstep_s = 0.02\nsteps = {steps}\n[flight]\nmode = \"tethered\"\n\
             tether.z = {{ frequency_hz = 1.25, cosine_m = [0.1] }}\n\
             [air]\nstream_m_s = [-1, 0, 0]\nplane_wakes = true\nshed = [\"trailing\"]\n\
             [body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]\n\
             [wing.right]\nhinge_m = [0, 0, 0]\nmass_kg = 0\nmirror = false\nmotion.phi.constant_deg = 0\n\
             planform.rectangle = {{ chord_m = 1, span_m = 100 }}\n\
             mesh = {{ chordwise = 4, spanwise = 1, spanwise_spacing = \"uniform\" }}\n"
        );
        let case = LoadedCase::from_text("foil", &text, Path::new(""), &[]);
        case.unwrap().setup.attached_beyond_stall()
    };
    for steps in [400, 60_000, 200_000] {
        assert_eq!(said(steps), None, "{steps}");
    }
}

/// Gusts of three steps have their impulse to 4 %, of two or less they have not; a front is as long as it takes
/// to pass the flyer, half as long at the speed of the front against it.
#[test]
fn behaves_gusts_that_the_steps_do_not_resolve_are_named() {
    let named = |gust: &str, more: &[&str]| {
        let gust = format!("air.gust=[{{ amplitude_m_s = [2, 0, 0], start_s = 0.01, {gust} }}]");
        let doubts = fly_in(&[&[&gust[..]], more].concat()).setup.doubts();
        let mut found = doubts
            .into_iter()
            .filter(|d| d.kind == DoubtKind::ShortGusts);
        found.next().map(|d| d.said)
    };
    let towards = ["flight.velocity_m_s=[1, 0, 0]"];
    for (gust, more, is_named) in [
        ("duration_s = 6e-5", &[][..], true), // 1.2 steps
        ("duration_s = 1.4e-4", &[], true),
        ("duration_s = 1.5e-4", &[], false),
        ("duration_s = 1.6e-4, front_m_s = [1, 0, 0]", &[], false),
        (
            "duration_s = 2.9e-4, front_m_s = [-1, 0, 0]",
            &towards,
            true,
        ),
        (
            "duration_s = 3.1e-4, front_m_s = [-1, 0, 0]",
            &towards,
            false,
        ),
        ("table = [[0, 0], [1e-5, 1], [2e-5, 0]]", &[], true),
        ("table = [[0, 0], [1e-5, 1]]", &[], false), // it rises and stays
        ("table = [[0, 0], [1e-3, 1], [2e-3, 0]]", &[], false),
        ("turbulence = { time_scale_s = 4e-5 }", &[], true),
        ("turbulence = { time_scale_s = 6e-5 }", &[], false),
    ] {
        let said = named(gust, more);
        assert_eq!(said.is_some(), is_named, "{gust}: {said:?}");
        let key = |s: &str| s.contains("air.gust[0].") && s.contains("time.steps_per_beat");
        assert!(said.is_none_or(|s| key(&s)), "{gust}");
    }
    // Air that does not move.
    let still = fly_in(&["air.gust=[{ amplitude_m_s = [0, 0, 0], duration_s = 1e-5 }]"]).setup;
    assert!(still.gusts_between_steps().is_empty());
}

/// Turbulence and gusts that pass, 1 m/s down or up while the lift is estimated: the strokes are the same.
#[test]
fn invariant_the_estimate_of_lift_is_without_gusts_that_pass() {
    let lift = |set: &[&str]| {
        let found = estimate(&fly_in(set).setup);
        assert!(
            !found.doubts.iter().any(|d| d.contains("lift")),
            "{:?}",
            found.doubts
        );
        found.lift_over_weight.unwrap()
    };
    let still = lift(&[]);
    for gust in [
        "start_s = -1e300, turbulence = { time_scale_s = 1e-2 }",
        "start_s = -5e-3, duration_s = 2e-2",
        "start_s = -1, table = [[0, 1], [2, 1], [3, 0]]",
    ] {
        let gust = format!("air.gust=[{{ amplitude_m_s = [0, 0, 1], {gust} }}]");
        assert_eq!(lift(&[&gust]), still, "{gust}");
    }
}

#[test]
fn refuses_a_mirror_beside_a_tilt_with_what_to_do() {
    let set = [
        "air.mirror=true".to_owned(),
        "flight.roll_deg=10".to_owned(),
    ];
    let case = LoadedCase::find("fruit-fly-hover", &set).unwrap();
    let error = Simulation::new(case.setup.clone()).map(|_| ()).unwrap_err();
    let text = case.refused(&error).to_string();
    assert!(
        text.contains("set it to false: both sides are computed"),
        "{text}"
    );
}
