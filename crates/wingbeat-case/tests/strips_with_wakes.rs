//! Strips that leave wakes: flying either way, in winds that blow from the start.

use crate::common::preset;
use std::path::Path;
use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;

/// Upward force \[N\], step by step, on a wing hinged at mid chord in strips by Jones's exponentials; lines of the
/// flight and of the air.
fn lift(flight: &str, air: &str) -> Vec<f64> {
    let text = format!(
        "format = 1\ngravity_m_s2 = [0, 0, 0]\n[time]\nstep_s = 4e-4\nsteps = 300\n[flight]\nmode = \"tethered\"\n{flight}\n\
         [air]\nmodel = \"blade_element\"\ndensity_kg_m3 = 1.2\n{air}\n\
         [air.blade]\nunsteady = \"jones\"\nrotation = \"circulation\"\nown = {{ lift = 3.141592653589793, drag_0 = 0, drag_90 = 0 }}\n\
         [body]\nmass_kg = 1e-3\ninertia_about_centre_kg_m2 = [1e-7, 1e-7, 1e-7, 0, 0, 0]\n\
         [wing.right]\nhinge_m = [0, 0, 0]\nmass_kg = 1e-5\nmirror = false\nmesh = {{ chordwise = 1, spanwise = 2 }}\n\
         planform.rectangle = {{ chord_m = 0.018, span_m = 0.046, axis_fraction = 0.5 }}\n"
    );
    let case = LoadedCase::from_text("strips", &text, Path::new(""), &[]).unwrap();
    let mut flight = Simulation::new(case.setup).unwrap();
    let mut lift = vec![-flight.record().air_force().z];
    while !flight.finished() {
        lift.push(-flight.step().unwrap().air_force().z);
    }
    lift
}

/// One steady air in five ways: of the stream, of the flight, of a gust without a front and of one whose front has
/// passed, of a shear that is seen from another origin. The force at once, and from step to step.
#[test]
fn invariant_of_how_a_steady_wind_is_described() {
    let gust = |front: &str| {
        format!(
            "gust = [{{ amplitude_m_s = [-2, 0, -0.3], table = [[0, 1], [100, 1]], start_s = -10{front} }}]"
        )
    };
    let sheared = "shear_1_s = [[0, 3, 0], [0, 0, 0], [0, 5, 0]]";
    let of = |place: &str, stream: &str| lift(place, &format!("{stream}\n{sheared}"));
    let same = [
        lift("", "stream_m_s = [-2, 0, -0.3]"),
        lift("velocity_m_s = [2, 0, 0.3]", ""),
        lift("", &gust("")),
        lift("", &gust(", front_m_s = [-3, 0, 0]")),
    ];
    let shears = [
        of("", "stream_m_s = [-2, 0, -0.3]"),
        of("position_m = [0, 10, 0]", "stream_m_s = [-32, 0, -50.3]"),
        of("velocity_m_s = [2, 0, 0.3]", ""),
        of(
            "velocity_m_s = [1, 0, 0]\nposition_m = [0, -2, 0]",
            "stream_m_s = [5, 0, 9.7]",
        ),
    ];
    assert!(same[0][0] > 0.4 * same[0][300], "{:?}", &same[0][..2]); // Wagner's half
    for all in [same, shears] {
        for other in &all[1..] {
            let off = apart(&all[0], other);
            assert!(off < 1e-11, "{off:e}"); // rounding of 50 m/s beside 0.3 m/s; it was 1
        }
    }
}

/// Wings that beat in a shear, seen from another origin.
#[test]
fn invariant_wings_that_beat_in_a_shear_wherever_the_origin_is() {
    let flown = |set: &[&str]| -> Vec<f64> {
        let own = [
            "air.blade.unsteady=peters",
            "air.shear_1_s=[[0,0,20],[0,0,0],[0,0,0]]",
            "time.beats=2",
        ];
        let case = preset("fruit-fly-blade", &[&own[..], set].concat());
        let mut flight = Simulation::new(case.setup).unwrap();
        let mut force = vec![];
        while !flight.finished() {
            force.push(flight.step().unwrap().air_force().x);
        }
        force
    };
    let near = flown(&["air.stream_m_s=[-0.5,0,0]"]);
    let far = flown(&["air.stream_m_s=[1.5,0,0]", "flight.position_m=[0,0,-0.1]"]);
    let off = apart(&near, &far);
    assert!(off < 1e-9, "{off:e}"); // rounding, which a flight that is free makes more of
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    let most = a.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let pairs = a.iter().zip(b);
    pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / most
}

/// A wing that is alike before and behind its axis pitches and flies forwards, or is the mirror image of that.
#[test]
fn invariant_strips_that_fly_backwards_are_mirror_images() {
    let flown = |sense: f64| {
        let pitch = format!("tether.pitch = {{ frequency_hz = 17.7, cosine_deg = [{sense}] }}");
        lift(&format!("velocity_m_s = [{sense}, 0, 0]\n{pitch}"), "")
    };
    let off = apart(&flown(1.0), &flown(-1.0));
    assert!(off < 1e-12, "{off:e}"); // it was 0.3
}

/// A gust that blows everywhere from the start is the stream of the same velocity: Wagner's function from half on. One
/// whose front travels comes up by Kuessner's from nothing.
#[test]
fn agrees_a_wind_from_the_start_with_the_stream() {
    let wind = |extra: &str| {
        let gust = format!(
            "gust = [{{ amplitude_m_s = [0, 0, -1e-3], table = [[0, 1], [9, 1]]{extra} }}]"
        );
        lift("", &format!("stream_m_s = [-1, 0, 0]\n{gust}"))
    };
    let stream = lift("", "stream_m_s = [-1, 0, -1e-3]");
    let off = apart(&stream, &wind(""));
    assert!(off < 2e-3, "{off:e}"); // of the speed, to second order in 1e-3, and of the added mass's jump
    let shares = [&stream, &wind(", front_m_s = [-1, 0, 0]")].map(|l| l[1] / l[300]);
    println!("{shares:?}");
    assert!(shares[0] > 0.5 && shares[1] < 0.2, "{shares:?}");
}
