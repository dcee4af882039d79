//! Air at rest has no energy to give.

use wingbeat_case::LoadedCase;
use wingbeat_results::Summary;
use wingbeat_results::summary::Verdict;

use crate::flights::{flown, says};

/// What is said of air that gives energy which nothing gave it.
const FROM_NOTHING: &str = "Air does work out of nothing";

/// A fin without drag that feathers by 5 deg about its leading edge, held in water: long enough for what the air gives it
/// to exceed what is allowed for its energy at the start, 0.23 J.
const FIN: &str = r#"
format = 1
name = "fin"
gravity_m_s2 = [0, 0, 0]
time = { steps_per_beat = 60, beats = 36 }
motion = { frequency_hz = 2.0 }
flight.mode = "tethered"
air.model = "blade_element"
air.density_kg_m3 = 1000
air.viscosity_m2_s = 1e-6
air.blade.own = { lift = 3.0, drag_0 = 0, drag_90 = 0 }
dynamics.integrator = "bdf"
output = { frames_every = 0, figures = false, page = false }
body = { mass_kg = 0.5, inertia_about_centre_kg_m2 = [0.004, 0.006, 0.008, 0, 0, 0] }
[wing.fin]
side = "right"
hinge_m = [-0.15, 0, 0]
mass_kg = 0.002
planform.outline = { leading_m = [[0, 0], [0.08, 0]], trailing_m = [[0, -0.06], [0.08, -0.06]] }
mesh = { chordwise = 2, spanwise = 6 }
motion.psi.fourier = { sine_deg = [5] }
"#;

fn summary(set: &[&str]) -> Summary {
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    flown(&LoadedCase::from_text("fin", FIN, std::path::Path::new("."), &set).unwrap())
}

/// Flown backwards, towed or in a stream, by Sane & Dickinson's law air drives the fin; by thin-airfoil theory, with a wake or
/// without, it brakes it, as forwards.
#[test]
fn conserves_air_at_rest_gives_no_energy_by_theory_and_says_so_where_it_does() {
    const ONE_EDGE: &str = "air.blade.rotation=\"sane_dickinson\"";
    const WAKES: &str = "air.blade.unsteady=\"jones\"";
    for [to, law] in [
        ["air.stream_m_s=[1,0,0]", ONE_EDGE],
        ["flight.velocity_m_s=[-1,0,0]", ONE_EDGE],
        ["air.stream_m_s=[1,0,0]", ""],
        ["flight.velocity_m_s=[-1,0,0]", ""],
        ["air.stream_m_s=[1,0,0]", WAKES],
        ["flight.velocity_m_s=[-1,0,0]", WAKES],
        ["air.stream_m_s=[-1,0,0]", ONE_EDGE],
        ["flight.velocity_m_s=[1,0,0]", ONE_EDGE],
        ["air.stream_m_s=[-1,0,0]", ""],
    ] {
        let set: Vec<&str> = [to, law].into_iter().filter(|s| !s.is_empty()).collect();
        let found = summary(&set);
        let backwards = to == "air.stream_m_s=[1,0,0]" || to == "flight.velocity_m_s=[-1,0,0]";
        let out_of_nothing = law == ONE_EDGE && backwards;
        assert_eq!(
            says(&found, FROM_NOTHING),
            out_of_nothing,
            "{set:?} {:?}",
            found.warnings
        );
        if out_of_nothing {
            assert_eq!(found.verdict, Verdict::Amber);
            assert!(says(&found, "air.blade.rotation = \"circulation\""));
        }
        // Mean power of the hinge in the second and third wingbeat.
        let power = 0.5 * (found.beats[1].mean.power_watt + found.beats[2].mean.power_watt);
        assert_eq!(power < 0.0, out_of_nothing, "{set:?}: {power}");
    }
}
