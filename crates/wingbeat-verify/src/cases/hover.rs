//! Hover for long, and with wakes cut short.

use crate::lab::insect::{Choice, Cut, MODELS, fruit_fly_wings, middle};
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
        about: "Tethered hover of the fruit fly without its body: mean lift with the wakes cut by count, \
                age and distance against nothing cut.",
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
    let preset = presets::find("fruit-fly-tethered")?;
    let mut set = vec![
        format!("time.beats={BEATS}"),
        "output.frames_every=0".to_owned(),
    ];
    set.extend(also.iter().map(|&s| s.to_owned()));
    let case = LoadedCase::from_text(preset.name, preset.text, Path::new(""), &set)?;
    let weight = case.setup.animal.mass() * case.setup.gravity.length();
    let mut flight = Simulation::new(case.setup)?;
    let force = |f: &Simulation| f.record().air.iter().map(|a| a.force).sum::<DVec3>();
    let mut forces = vec![force(&flight)];
    while !flight.finished() {
        flight.step()?;
        forces.push(force(&flight));
    }
    let per_beat = (forces.len() - 1) / BEATS;
    let lift: Vec<f64> = forces.iter().map(|f| -f.z / weight).collect();
    let beat = |b: usize| mean(&lift[b * per_beat..=(b + 1) * per_beat]);
    let [early, spread] = middle(&(1..10).map(beat).collect::<Vec<_>>());
    let [late, late_spread] = middle(&(10..BEATS).map(beat).collect::<Vec<_>>());
    let largest = forces.iter().map(|f| f.length()).fold(0.0, f64::max) / weight;
    let rings = flight.record().wake_rings;
    Ok(vec![
        Row::new("largest force over the weight in any step", "1", largest)
            .against(0.0, "no blow-up")
            .within(
                10.0,
                "the peaks measured on fruit flies are 2 to 3 weights; a wake that blows up passes \
                 every bound within a few steps",
            ),
        Row::new("rings at the end", "1", rings as f64).because("none dropped"),
        Row::new("mean lift over the weight, beats 2 to 10", "1", early)
            .uncertain(spread)
            .because("uncertainty: half the span of the beats' means"),
        Row::new("mean lift over the weight, beats 11 to 20", "1", late).uncertain(late_spread),
    ])
}

fn truncation(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let (fly, weight) = fruit_fly_wings();
    let mut rows = Vec::new();
    for (model, base) in [MODELS[0], MODELS[2]] {
        let whole = fly.lifts(base)?;
        let [lift, spread] = middle(&whole);
        rows.push(
            Row::new(
                format!("{model}: mean lift, nothing cut"),
                "weights",
                lift / weight,
            )
            .uncertain(spread / weight)
            .because("beats 2 and 3; uncertainty: half their difference"),
        );
        for (name, cut) in [
            ("20 rows, half a beat", Cut::Rows(20)),
            ("40 rows, a beat", Cut::Rows(40)),
            ("60 rows, a beat and a half", Cut::Rows(60)),
            ("age of a beat", Cut::Beats(1.0)),
            ("distance of one wing length", Cut::Lengths(1.0)),
        ] {
            let changed = fly.lifts(Choice { cut, ..base })?;
            let [mean, spread] = middle(&changed);
            rows.push(
                Row::new(format!("{model}: change of mean lift, {name}"), "1", mean / lift - 1.0)
                    .against(0.0, "our own wake with nothing cut")
                    .uncertain(spread / lift)
                    .because("what was cut off is missing; rows go as whole rings, so that circulation stays balanced"),
            );
        }
    }
    Ok(rows)
}
