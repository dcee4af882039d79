//! Hover for long, and with wakes cut short.

use crate::lab::insect::middle;
use crate::lab::series::mean;
use crate::{Case, Part, Row, VerifyError};
use std::path::Path;
use wingbeat_case::{LoadedCase, presets};
use wingbeat_flight::Simulation;
use wingbeat_math::DVec3;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "hover-20-beats",
        about: "The preset fruit-fly-tethered with all its settings, body and wakes from all edges, for 20 \
                beats with nothing truncated.",
        part: Part::Sensitivity,
        quick: false,
        run: twenty,
    },
    Case {
        name: "hover-20-beats-blobs",
        about: "The same with wake filaments longer than two chords as vortex blobs: the cost of a step grows with \
                the wake and not with its square.",
        part: Part::Sensitivity,
        quick: false,
        run: twenty_with_blobs,
    },
    Case {
        name: "wake-truncation",
        about: "The preset fruit-fly-tethered with all its settings and its body, beats 3 to 8: mean lift with the \
                wakes cut by count, age and distance against nothing cut.",
        part: Part::Sensitivity,
        quick: false,
        run: truncation,
    },
];

fn twenty(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    long_hover(&[])
}

fn twenty_with_blobs(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    long_hover(&[
        "air.wake_blob_length_m=1.4e-3",
        "air.bound_core={lamb_oseen={radius_m=7e-6}}",
        "air.wake_core={lamb_oseen={radius_m=5e-5}}",
    ])
}

fn long_hover(also: &[&str]) -> Result<Vec<Row>, VerifyError> {
    const BEATS: usize = 20;
    let also = also.iter().map(|&s| s.to_owned()).collect();
    let flown = hover(BEATS, also)?;
    let [early, spread] = middle(&flown.lifts[1..10]);
    let [late, late_spread] = middle(&flown.lifts[10..]);
    Ok(vec![
        Row::new(
            "largest force over the weight in any step",
            "1",
            flown.largest,
        )
        .against(0.0, "no blow-up")
        .within(
            10.0,
            "the peaks measured on fruit flies are 2 to 3 weights; a wake that blows up passes \
                 every bound within a few steps",
        ),
        Row::new("rings at the end", "1", flown.rings as f64).because("none dropped"),
        Row::new("mean lift over the weight, beats 2 to 10", "1", early)
            .uncertain(spread)
            .because("uncertainty: half the span of the beats' means"),
        Row::new("mean lift over the weight, beats 11 to 20", "1", late).uncertain(late_spread),
    ])
}

/// A flight of the tethered fly.
struct Hover {
    /// Mean lift of each beat over the weight [-].
    lifts: Vec<f64>,
    /// Largest force over the weight in any step [-].
    largest: f64,
    /// Rings of the wakes at the end.
    rings: usize,
}

/// Flies the preset `fruit-fly-tethered` for so many beats, with these keys `also` set.
fn hover(beats: usize, also: Vec<String>) -> Result<Hover, VerifyError> {
    let preset = presets::find("fruit-fly-tethered")?;
    let mut set = vec![
        format!("time.beats={beats}"),
        "output.frames_every=0".to_owned(),
    ];
    set.extend(also);
    let case = LoadedCase::from_text(preset.name, preset.text, Path::new(""), &set)?;
    let weight = case.setup.animal.mass() * case.setup.gravity.length();
    let mut flight = Simulation::new(case.setup)?;
    let force = |f: &Simulation| f.record().air.iter().map(|a| a.force).sum::<DVec3>();
    let mut forces = vec![force(&flight)];
    while !flight.finished() {
        flight.step()?;
        forces.push(force(&flight));
    }
    let per_beat = (forces.len() - 1) / beats;
    let lift: Vec<f64> = forces.iter().map(|f| -f.z / weight).collect();
    let beat = |b: usize| mean(&lift[b * per_beat..=(b + 1) * per_beat]);
    Ok(Hover {
        lifts: (0..beats).map(beat).collect(),
        largest: forces.iter().map(|f| f.length()).fold(0.0, f64::max) / weight,
        rings: flight.record().wake_rings,
    })
}

/// What each cut of a wake is called, and the key that makes it: steps of 1/40 of a beat of 5 ms, wings of 2.5 mm.
const CUTS: [(&str, &str); 7] = [
    ("20 rows, half a beat", "air.max_wake_rows=20"),
    ("40 rows, a beat", "air.max_wake_rows=40"),
    ("80 rows, two beats", "air.max_wake_rows=80"),
    ("120 rows, three beats", "air.max_wake_rows=120"),
    ("age of a beat", "air.max_wake_age_s=5e-3"),
    (
        "distance of one wing length",
        "air.max_wake_distance_m=2.5e-3",
    ),
    (
        "distance of two wing lengths",
        "air.max_wake_distance_m=5e-3",
    ),
];

fn truncation(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    const BEATS: usize = 8;
    // By then the whole wake is older than any that is kept.
    const FROM: usize = 2;
    let mut rows = Vec::new();
    for (model, shed) in [
        (
            "leading-edge sheets",
            r#"air.shed=["trailing","tip","leading"]"#,
        ),
        ("attached", r#"air.shed=["trailing","tip"]"#),
    ] {
        let lifts = |cut: Option<&str>| -> Result<Vec<f64>, VerifyError> {
            let also = std::iter::once(shed).chain(cut).map(str::to_owned);
            Ok(hover(BEATS, also.collect())?.lifts.split_off(FROM))
        };
        let [lift, spread] = middle(&lifts(None)?);
        rows.push(
            Row::new(format!("{model}: mean lift, nothing cut"), "weights", lift)
                .uncertain(spread)
                .because("beats 3 to 8; uncertainty: half the span of the beats' means"),
        );
        for (name, key) in CUTS {
            let [cut, spread] = middle(&lifts(Some(key))?);
            rows.push(
                Row::new(format!("{model}: change of mean lift, {name}"), "1", cut / lift - 1.0)
                    .against(0.0, "our own wake with nothing cut")
                    .uncertain(spread / lift)
                    .because("what was cut off is missing; rows go as whole rings, so that circulation stays balanced"),
            );
        }
    }
    Ok(rows)
}
