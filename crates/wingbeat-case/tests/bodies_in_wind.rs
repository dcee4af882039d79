//! Bodies in the air of a case: cores beside their panels, winds that no air has, gusts that never arrive.

use std::path::Path;
use wingbeat_air::CoreModel;
use wingbeat_analysis::estimate;
use wingbeat_case::LoadedCase;
use wingbeat_flight::{AirModel, Simulation};

/// A spheroid of length 1 m and this diameter \[m\], of as many meridians as stations, that heaves in the air
/// \[Hz, m\]; lines more.
fn spheroid(diameter: f64, panels: usize, more: &str) -> Result<LoadedCase, String> {
    let text = format!(
        "format = 1\ngravity_m_s2 = [0, 0, 0]\n[time]\nstep_s = 0.01\nsteps = 4\n[flight]\nmode = \"tethered\"\n\
         tether.z = {{ frequency_hz = 1.0, sine_m = [0.1] }}\n[air]\ndensity_kg_m3 = 1\n{more}\n\
         [body.part.s]\nlength_m = 1\ndiameter_m = {diameter}\nmass_kg = 1\nmeridians = {panels}\nstations = {panels}\n"
    );
    LoadedCase::from_text("spheroid", &text, Path::new(""), &[]).map_err(|e| e.to_string())
}

fn core(case: &LoadedCase) -> f64 {
    match &case.setup.air {
        AirModel::VortexLattice(air) => match air.lattice.bound_core {
            CoreModel::Algebraic { radius, .. } => radius,
            other => panic!("{other:?}"),
        },
        _ => panic!("a lattice"),
    }
}

/// The coefficient 0.9602 of a spheroid of 10:1 across its axis [Lamb, Hydrodynamics, art. 114]; with cores of a
/// hundredth of its length it came out 1.30, the higher the finer the panels.
#[test]
fn exact_added_mass_of_a_slender_body_with_the_default_core() {
    let case = spheroid(0.1, 32, "").unwrap();
    let volume = std::f64::consts::PI / 6.0 * 0.01;
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    for _ in 0..3 {
        flight.step().unwrap();
    }
    let force = flight.record().air[0].force.z;
    let wave = std::f64::consts::TAU;
    let acceleration = -0.1 * wave * wave * (wave * 0.03).sin();
    let k = -force / (volume * acceleration);
    println!("k {k:.4}, core {:.2e} m", core(&case));
    assert!((k - 0.9602).abs() < 0.01, "{k}");
}

#[test]
fn behaves_cores_wide_beside_the_panels_of_a_body_are_doubted() {
    let wide = "bound_core.algebraic.radius_m = 0.01\nwake_core.algebraic.radius_m = 0.01";
    let said = |more: &str| estimate(&spheroid(0.1, 32, more).unwrap().setup).doubts;
    assert!(said("").is_empty(), "{:?}", said(""));
    let doubts = said(wide);
    assert!(
        doubts[0].contains("part `s`") && doubts[0].contains("air.bound_core"),
        "{doubts:?}"
    );
}

#[test]
fn refuses_a_shear_that_flows_apart() {
    let shear = |rows: &str| spheroid(1.0, 6, &format!("shear_1_s = {rows}"));
    let error = shear("[[0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]]").unwrap_err();
    assert!(
        error.contains("air.shear_1_s") && error.contains("density"),
        "{error}"
    );
    assert!(shear("[[0.1, 0, 3], [0, 0.1, 0], [0, 0, -0.2]]").is_ok());
}

#[test]
fn behaves_gusts_that_never_arrive_are_named() {
    let said = |gust: &str| {
        let more = format!("gust = [{{ amplitude_m_s = [0, 1, 0], {gust} }}]");
        let doubts = estimate(&spheroid(1.0, 6, &more).unwrap().setup).doubts;
        doubts.iter().filter(|d| d.contains("air.gust[0]")).count()
    };
    for (gust, count) in [
        ("duration_s = 1", 0),
        ("duration_s = 1, start_s = 5", 1),
        ("duration_s = 1, start_s = -5", 1),
        ("table = [[0, 0], [1, 1]], start_s = 0.03", 0),
        ("table = [[2, 0], [3, 1]]", 1),
        ("table = [[0, 0], [1, 1]], start_s = -5", 0),
        ("table = [[0, 1], [1, 0]], start_s = -5", 1),
        ("table = [[0, 1], [1, 0]], start_s = -0.9", 0),
        ("duration_s = 1, front_m_s = [0, 0, 1]", 0),
    ] {
        assert_eq!(said(gust), count, "{gust}");
    }
}

/// The ends of a body of 1 m meet a front of 1 m/s half a second before and after its middle: a gust that is said to
/// be without effect has none on the loads, and one that has some is not.
#[test]
fn agrees_gusts_that_are_named_with_loads_that_they_leave_alone() {
    let loads = |case: &LoadedCase| {
        let mut flight = Simulation::new(case.setup.clone()).unwrap();
        let mut all = vec![flight.record().air.clone()];
        while !flight.finished() {
            all.push(flight.step().unwrap().air.clone());
        }
        all
    };
    let calm = loads(&spheroid(0.5, 8, "").unwrap());
    for (start, has_effect) in [(0.3, true), (0.6, false), (-1.3, true), (-1.6, false)] {
        let gust = format!(
            "gust = [{{ amplitude_m_s = [0, 1, 0], duration_s = 1, front_m_s = [1, 0, 0], start_s = {start} }}]"
        );
        let case = spheroid(0.5, 8, &gust).unwrap();
        assert_eq!(loads(&case) != calm, has_effect, "{start}");
        let said = case.setup.gusts_that_never_arrive();
        assert_eq!(said.is_empty(), has_effect, "{start}: {said:?}");
    }
}

/// What is said goes by the air where the flight starts, be that written as a stream or as a shear.
#[test]
fn invariant_what_is_said_of_a_stream_is_said_of_a_shear() {
    let turning = "flight.tether.yaw.rate_deg_s=1000";
    for (speed, more, word) in [
        (20.0, "motion.frequency_hz=1", "ahead"), // of strokes, which the air passes from behind
        (-40.0, turning, ""),
        (-1.0, turning, "turns so that the trailing edge is ahead"),
    ] {
        let of = |stream: f64, shear: f64| {
            let set = [
                format!("air.stream_m_s=[{stream},0,0]"),
                format!("air.shear_1_s=[[0,0,{shear}],[0,0,0],[0,0,0]]"),
                "flight.position_m=[0,0,-2]".to_owned(),
                more.to_owned(),
            ];
            let case = LoadedCase::find("rectangular-wing", &set).unwrap();
            let found = estimate(&case.setup);
            let behind = |d: &String| d.contains("the air comes from behind at 20.0 m/s");
            let wings = found
                .wings
                .iter()
                .map(|w| (w.reynolds, w.reduced_frequency));
            let wings: Vec<_> = wings.collect();
            let behind = found.doubts.iter().any(behind);
            (case.setup.doubts(), found.flight_speed, wings, behind)
        };
        // A shear that is nowhere felt, for what is said of all shears.
        let [stream, shear] = [of(speed, 1e-300), of(0.0, -0.5 * speed)];
        assert_eq!(stream, shear);
        assert_eq!(stream.1, speed.abs());
        assert_eq!(stream.3, speed == 20.0);
        let says = |word: &str| stream.0.iter().any(|d| d.said.contains(word));
        assert!(says(word) || word.is_empty(), "{:?}", stream.0);
        assert!(!word.is_empty() || !says("turns so"), "{:?}", stream.0);
    }
}

#[test]
fn refuses_cores_of_two_kinds_in_the_words_of_the_case() {
    let error = spheroid(1.0, 6, "bound_core.cut_off.length_m = 1e-3").unwrap_err();
    assert!(
        error.contains("cut_off") && !error.contains("CutOff"),
        "{error}"
    );
}

/// The velocity `a f(t - s.x)` has the divergence `-a.s f'`: no gust of air blows along the way of its front.
#[test]
fn behaves_gusts_that_press_the_air_together_past_bodies_are_named() {
    let pressed = |gust: &str| {
        let more = format!("gust = [{{ duration_s = 0.2, {gust} }}]");
        let setup = spheroid(0.5, 8, &more).unwrap().setup;
        setup.gusts_that_press_air().len()
    };
    let along = "amplitude_m_s = [-1, 0, 0], front_m_s = [-1, 0, 0]";
    assert_eq!(pressed(along), 1);
    // A front that is fast, so that the gust is long beside the body.
    assert_eq!(
        pressed("amplitude_m_s = [-1, 0, 0], front_m_s = [-500, 0, 0]"),
        0
    );
    assert_eq!(
        pressed("amplitude_m_s = [0, 0, 1], front_m_s = [-1, 0, 0]"),
        0
    );
    assert_eq!(pressed("amplitude_m_s = [-1, 0, 0]"), 0);
}
