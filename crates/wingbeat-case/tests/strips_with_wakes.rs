//! Strips that leave wakes: flying either way, in winds that blow from the start.

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
