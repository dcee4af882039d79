//! Cases that ask for more than any machine has are refused while they are read, and do not end
//! the program for want of memory or time.

use std::path::Path;

use crate::common::{preset, refusal};
use wingbeat_case::{LoadedCase, presets};
use wingbeat_flight::Simulation;

/// What is said about the fruit fly with one more override.
fn refused(set: &str) -> String {
    refusal("fruit-fly-hover", &[set])
}

#[test]
fn refuses_absurd_sizes() {
    for (key, value, allowed) in [
        ("wing.right.mesh.spanwise", "5000", "10000 panels"),
        (
            "wing.right.mesh.chordwise",
            "9007199254740993",
            "10000 panels",
        ),
        ("body.part.thorax.stations", "1000000000000", "10000 panels"),
        (
            "body.part.thorax.meridians",
            "9000000000000000000",
            "10000 panels",
        ),
        ("time.beats", "1e300", "as much as 1000000000 steps"),
        (
            "time.steps_per_beat",
            "9000000000000000000",
            "as much as 1000000000 steps",
        ),
        ("corrector.max_passes", "9000000000000000000", "<= 10000"),
    ] {
        let said = refused(&format!("{key}={value}"));
        assert!(said.contains(allowed) && said.contains("try: "), "{said}");
        // Too many steps are the fault of the longest flight, whatever made them many.
        let named = key != "time.steps_per_beat";
        assert!(!named || said.contains(key), "{said}");
    }
}

/// Lengths and times of winds near 0 are refused by themselves; steps were to blame for what they did.
#[test]
fn refuses_winds_that_no_air_has() {
    let gust = "air.gust=[{ amplitude_m_s = [0, 0, 1], turbulence = { time_scale_s = 1e-300 } }]";
    let street =
        "air.vortex_street={ circulation_m2_s = 1e-3, spacing_m = 1e-300, drift_m_s = [-1, 0, 0] }";
    for (set, key) in [
        (gust, "air.gust[0].turbulence.time_scale_s"),
        (street, "air.vortex_street.spacing_m"),
    ] {
        let said = refused(set);
        assert!(said.contains(key), "{said}");
    }
}

/// A scale at which masses are no numbers is the fault of the scale.
#[test]
fn refuses_a_scale_beyond_numbers_by_name() {
    for scale in ["1e200", "1e-200"] {
        let said = refused(&format!("animal.scale={scale}"));
        assert!(said.contains("animal.scale"), "{said}");
    }
}

/// Lengths and masses that nothing has are refused by their ranges, those of insects and whales are not.
#[test]
fn refuses_lengths_and_masses_that_nothing_has() {
    for (key, value, allowed) in [
        ("body.length_m", "1e300", "<= 100000"),
        ("body.length_m", "1e-300", ">= 1e-9"),
        ("body.mass_kg", "1e308", "<= 1e9"),
        ("body.mass_kg", "1e-300", ">= 1e-15"),
        ("body.mass_kg", "0", ">= 1e-15"),
        ("body.part.thorax.length_m", "1e200", "<= 100000"),
        ("body.part.thorax.diameter_m", "1e-10", ">= 1e-9"),
        ("body.part.thorax.mass_kg", "1e300", "<= 1e9"),
        ("wing.right.mass_kg", "1e308", "<= 1e9"),
        ("wing.right.planform.beta.length_m", "1e200", "<= 100000"),
    ] {
        let said = refused(&format!("{key}={value}"));
        assert!(said.contains(&format!("{key} = {value}: this ")), "{said}");
        assert!(said.contains(allowed) && said.contains("try: "), "{said}");
    }
    for set in ["body.mass_kg=1e-9", "body.mass_kg=1e5"] {
        preset("fruit-fly-blade", &[set]);
    }
}

/// Masses that are no numbers are the fault of the number that made them so.
#[test]
fn refuses_sizes_beyond_numbers_by_name() {
    let far = "body.part.thorax.centre_m=[1e200, 0, 0]";
    let said = refused(far);
    assert!(said.contains("body.part.thorax.centre_m"), "{said}");
}

/// Radii of veins and reference speeds that nothing has are refused at their keys, before stiffnesses and times are.
#[test]
fn refuses_veins_and_speeds_that_nothing_has() {
    let said = |case: &str, set: String| LoadedCase::find(case, &[set]).unwrap_err().to_string();
    for radius in ["1e300", "1e-300"] {
        let set = format!("wing.right.structure.vein[0].radius_m=[{radius},{radius}]");
        let said = said("hawkmoth-veins", set);
        assert!(said.contains("vein[0].radius_m"), "{said}");
        assert!(said.contains("from 1e-9 to 1"), "{said}");
    }
    let set = "air.derivatives.dimensionless.speed_m_s=1e10".to_owned();
    let said = said("table1-sun-xiong-2005", set);
    assert!(
        said.contains("dimensionless.speed_m_s = 10000000000"),
        "{said}"
    );
    assert!(said.contains("<= 340"), "{said}");
}

/// Speeds, frequencies and accelerations that no flyer has are refused at their keys, not by what they do to steps; those
/// beyond all animals are flown.
#[test]
fn refuses_speeds_and_frequencies_that_no_flyer_has_at_their_keys() {
    let found = |set: &str| LoadedCase::find("fruit-fly-blade", &[set.to_owned()]);
    for (key, set, allowed) in [
        (
            "air.stream_m_s[0]",
            "air.stream_m_s=[1e300, 0, 0]",
            "<= 10000",
        ),
        (
            "air.stream_m_s[2]",
            "air.stream_m_s=[0, 0, -1e5]",
            ">= -10000",
        ),
        (
            "flight.velocity_m_s[0]",
            "flight.velocity_m_s=[1e300, 0, 0]",
            "<= 10000",
        ),
        (
            "air.gust[0].amplitude_m_s[1]",
            "air.gust=[{ amplitude_m_s = [0, 1e9, 0] }]",
            "<= 10000",
        ),
        ("gravity_m_s2[2]", "gravity_m_s2=[0, 0, 1e300]", "<= 10000"),
        (
            "motion.frequency_hz",
            "motion.frequency_hz=1e300",
            "<= 1000000",
        ),
        (
            "motion.frequency_hz",
            "motion.frequency_hz=1.1e6",
            "<= 1000000",
        ),
    ] {
        let said = found(set).unwrap_err().to_string();
        assert!(said.starts_with(&format!("error: {key} = ")), "{said}");
        assert!(said.contains(allowed) && said.contains("try: "), "{said}");
    }
    for set in ["motion.frequency_hz=1e6", "air.stream_m_s=[-1e4, 0, 0]"] {
        assert!(found(set).is_ok(), "{set}");
    }
}

/// What ends the first steps of a case is said of its key.
fn ended(case: &str, set: &[&str], steps: usize) -> String {
    let case = preset(case, set);
    let flown = Simulation::new(case.setup.clone()).and_then(|mut flight| {
        (0..steps).try_for_each(|_| flight.step().map(drop))?;
        Ok(flight)
    });
    let ended = flown.err().expect("it breaks down");
    case.refused(&ended).to_string()
}

/// Numbers of the case beyond all that flies are to blame for states that are no numbers, not the time.
#[test]
fn refuses_numbers_that_end_the_flight_by_name() {
    for (case, set, key) in [
        (
            "fruit-fly-blade",
            "air.blade.body_drag.across=1.7e308",
            "air.blade.body_drag.across",
        ),
        (
            "table1-sun-xiong-2005",
            "body.inertia_about_centre_kg_m2=[0,0,0,0,0,0]",
            "body.inertia_about_centre_kg_m2",
        ),
    ] {
        let said = ended(case, &[set], 20);
        assert!(said.starts_with(&format!("error: {key}")), "{said}");
    }
}

/// Coarse steps in which the Euler form diverges are to blame for surfaces that are thrown about, not the mirror.
#[test]
fn refuses_diverging_steps_before_mirrors_and_panels() {
    for (steps_per_beat, mirror) in [
        (10, true),
        (14, true),
        (14, false),
        (16, true),
        (20, true),
        (24, false),
    ] {
        let said = ended(
            "fruit-fly-hover",
            &[
                "dynamics.formulation=euler",
                &format!("time.steps_per_beat={steps_per_beat}"),
                "wing.right.mesh.chordwise=3",
                "wing.right.mesh.spanwise=4",
                &format!("air.mirror={mirror}"),
            ],
            60,
        );
        assert!(said.contains("the motion diverges within a step"), "{said}");
        assert!(
            said.contains("dynamics.formulation = \"momentum\""),
            "{said}"
        );
    }
}

#[test]
fn refuses_what_is_no_file() {
    let text = presets::find("fruit-fly-vacuum").unwrap().text;
    let text = text.replace("[body.part.thorax]", "[body.part.thorax]\nfile = \"/\"");
    let said = LoadedCase::from_text("case.toml", &text, Path::new(""), &[]);
    let said = said.unwrap_err().to_string();
    assert!(
        said.contains("body.part.thorax.file") && said.contains("it is not a file"),
        "{said}"
    );
}

/// On its own line a turned filament is as near as rounding makes it: without a core that is a lift of 1e12 N.
#[test]
fn refuses_bound_cores_that_are_lost_in_rounding() {
    for (core, size) in [
        ("cut_off", "length"),
        ("vatistas", "radius"),
        ("scully", "radius"),
        ("lamb_oseen", "radius"),
    ] {
        for chords in ["0", "1e-7"] {
            let set = format!("air.bound_core={{{core}={{{size}_chords={chords}}}}}");
            let said = refusal("flapping-rectangles", &[&set]);
            let key = format!("air.bound_core.{core}.{size}_m");
            assert!(
                said.contains(&key) && said.contains("a millionth of the mean chord"),
                "{said}"
            );
        }
    }
    let zero = "air.bound_core={algebraic={radius_chords=0}}".to_owned();
    LoadedCase::find(Path::new("fruit-fly-hover"), &[zero]).unwrap();
}
