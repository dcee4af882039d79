//! The Pazy wing: frequencies, weights hung at its tip, its shape in a stream, flutter.

use std::f64::consts::TAU;
use std::path::Path;

use wingbeat_analysis::flutter::{Condition, ElasticRig, FlutterSettings, condition, crossings};
use wingbeat_case::LoadedCase;
use wingbeat_flight::FlightSetup;
use wingbeat_math::{DMat3, DVec3};
use wingbeat_model::{BeamMass, Members};
use wingbeat_structure::{FrameMotion, NodeLoad, StaticSettings, equilibrium, modes};

use crate::lab::series::Table;
use crate::{Case, Comparison, Part, Row, VerifyError};

pub(super) const CASES: &[Case] = &[
    Case {
        name: "pazy-structure",
        about: "The Pazy wing of the Technion as the equivalent beam of Riso & Cesnik, 15 elements with lumped masses: \
                frequencies without air, and weights hung at its tip.",
        part: Part::Programs,
        quick: true,
        run: structure,
    },
    Case {
        name: "pazy-stream",
        about: "The same wing in a stream at 7 degrees: where its tip is.",
        part: Part::Experiments,
        quick: false,
        run: stream,
    },
    Case {
        name: "pazy-flutter",
        about: "The same wing at 3 and 7 degrees: the speed at which it flutters, about its deformed state.",
        part: Part::Experiments,
        quick: false,
        run: flutter,
    },
];

const SPAN: f64 = 0.549_843_7;
const CHORD: f64 = 0.1;
/// Elastic axis behind the leading edge over the chord \[1\].
const AXIS: f64 = 0.441;
const GRAVITY: f64 = 9.81;

fn setup(set: &[&str]) -> Result<FlightSetup, VerifyError> {
    let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
    let text = include_str!("../../data/pazy.toml");
    Ok(LoadedCase::from_text("pazy", text, Path::new(""), &set)?.setup)
}

const BEAM: &str = "UM/NAST, the same beam: Riso & Cesnik 2023, J. Aircraft; UM-A2SRL/AePW3-LDWG";
const TESTS: &str = "Technion, UM-A2SRL/AePW3-LDWG";
const TUNNEL: &str = "Technion's tunnel: Avin, Raveh, Drachinsky, Ben-Shmuel & Tur 2022, AIAA J. 60:1753; ngoiz/pazy-aepw3-results";

fn structure(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let setup = setup(&[])?;
    let body = body(&setup, None)?;
    let known = [4.190_634, 28.493_241, 41.878_928, 83.064_586, 105.891_904];
    let found = modes(&body, body.rest(), &FrameMotion::REST, None)?;
    let mut rows: Vec<Row> = (known.iter().zip(&found).enumerate())
        .map(|(k, (known, mode))| {
            let name = format!("frequency {} without air", k + 1);
            Row::new(name, "Hz", mode.frequency() / TAU)
                .against(*known, BEAM)
                .within_part(0.03, "stated beforehand")
        })
        .collect();
    rows.extend(tip_loads(&setup)?);
    Ok(rows)
}

fn right(setup: &FlightSetup) -> &wingbeat_model::Wing {
    let wings = &setup.animal.wings;
    wings
        .iter()
        .find(|w| w.name == "right")
        .unwrap_or(&wings[0])
}

/// The elastic body of the right wing, with a weight hung at its tip.
fn body(
    setup: &FlightSetup,
    weight: Option<(f64, f64)>,
) -> Result<wingbeat_structure::Structure, VerifyError> {
    let wing = right(setup);
    let mut structure = wing.structure.clone().expect("an elastic wing");
    if let (Members::Beam(beam), Some((mass, ahead))) = (&mut structure.members, weight) {
        beam.masses.push(BeamMass {
            at: 1.0,
            mass,
            offset: ahead * DVec3::X,
            inertia: DMat3::ZERO,
        });
    }
    let body = structure.body(&wing.blank());
    Ok(body.map_err(wingbeat_model::ModelError::from)?.structure)
}

/// Displacement of the middle of the tip's chord along gravity over the span \[%\] and rotation of the chord
/// \[deg\] under a weight `mass` \[kg\] whose centre is `ahead` \[m\] of the elastic axis, less those of the
/// wing alone.
fn hung(setup: &FlightSetup, mass: f64, ahead: f64) -> Result<[f64; 2], VerifyError> {
    let at = |weight| -> Result<[f64; 2], VerifyError> {
        let body = body(setup, weight)?;
        let frame = FrameMotion {
            acceleration: -GRAVITY * DVec3::Z, // as gravity along w3
            ..FrameMotion::REST
        };
        let settings = StaticSettings {
            steps: 4,
            ..StaticSettings::default()
        };
        let none: &[NodeLoad] = &[];
        let bent = equilibrium(&body, body.rest(), &frame, none, &settings)?;
        let tip = bent.len() - 1;
        let chord = bent.rotation[tip] * DVec3::X;
        let middle = bent.position[tip] - (0.5 - AXIS) * CHORD * chord;
        let twist = (-chord.z).atan2(chord.x);
        Ok([100.0 * middle.z / SPAN, twist.to_degrees()])
    };
    let (loaded, alone) = (at(Some((mass, ahead)))?, at(None)?);
    Ok([0, 1].map(|k| loaded[k] - alone[k]))
}

/// Weights at mid chord (bending) and 80 mm before the leading edge (torsion).
fn tip_loads(setup: &FlightSetup) -> Result<Vec<Row>, VerifyError> {
    let table = Table::new(include_str!("../../data/pazy_tip_loads.csv"));
    let [mass, down, turned] =
        ["mass_kg", "displacement_percent", "rotation_deg"].map(|k| table.numbers(k));
    let mut rows = vec![];
    for (test, ahead) in [
        ("bending", (AXIS - 0.5) * CHORD),
        ("torsion", AXIS * CHORD + 0.08),
    ] {
        let of: Vec<usize> = (table.words("test").enumerate())
            .filter(|(_, t)| *t == test)
            .map(|(k, _)| k)
            .collect();
        let all = of.iter().map(|&k| hung(setup, mass[k], ahead));
        let all: Vec<[f64; 2]> = all.collect::<Result<_, _>>()?;
        let measured = [
            (&down, "displacement of the tip", "%"),
            (&turned, "rotation of the tip", "deg"),
        ];
        for (q, (known, what, unit)) in measured.into_iter().enumerate() {
            if test == "bending" && q == 1 {
                continue;
            }
            let points = of.iter().zip(&all);
            let comparison = Comparison {
                quantity: format!("{what} [{unit}]").into(),
                along: "mass at the tip [kg]".into(),
                against: "measured".into(),
                name: test.into(),
                points: points
                    .map(|(&k, a)| [mass[k], known[k].abs(), a[q].abs()])
                    .collect(),
            };
            let part = comparison.points.iter().map(|p| (p[2] / p[1] - 1.0).abs());
            let largest = part.fold(0.0, f64::max);
            rows.push(
                Row::new(
                    format!("{test} by weights at the tip: largest part by which {what} is off"),
                    "1",
                    largest,
                )
                .against(0.0, TESTS)
                .because("weights of 0.2 to 3 kg; measured from the wing without them, as here")
                .drawn(comparison),
            );
        }
    }
    Ok(rows)
}

/// Place of the tip across the undeformed wing over the span \[%\] at a speed [m/s].
fn tip(set: &[&str], speed: f64) -> Result<f64, VerifyError> {
    let rig = ElasticRig::new(&setup(set)?, speed)?;
    let (_, steady) = rig.to_steady(&FlutterSettings::default())?;
    Ok(100.0 * steady[0].tip.z.abs() / SPAN)
}

/// Panels along the span: rings on the edges make coarse wings too long.
const FINE: &[&str] = &["wing.right.mesh.spanwise=24"];

fn stream(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = vec![];
    let change = tip(FINE, 30.0)? / tip(&[], 30.0)? - 1.0;
    // Speed, UM/NAST with a lattice \[%\], measured in Technion's tunnel \[m\].
    for (speed, lattice, measured) in [
        (30.0, 13.768_249, 0.077_541_69),
        (40.0, 25.065_289, 0.135_950_8),
        (50.0, 38.565_703, 0.219_760_33),
    ] {
        let here = tip(FINE, speed)?;
        let name = |what: &str| format!("tip at {speed} m/s and 7 deg, {what}");
        rows.push(
            Row::new(name("UM/NAST with a lattice"), "% of span", here)
                .against(lattice, BEAM)
                .uncertain(change * here)
                .within_part(0.02, "stated beforehand; uncertainty: change at 30 m/s by 24 panels along the span for 12"),
        );
        rows.push(
            Row::new(name("measured"), "% of span", here)
                .against(100.0 * measured / 0.55, TUNNEL)
                .within_part(0.06, "stated beforehand; at 40 m/s the mean of two points"),
        );
    }
    Ok(rows)
}

/// Speed [m/s] at which flutter begins and its frequency \[Hz\], from speeds about it.
fn onset(angle: f64, speeds: &[f64]) -> Result<[f64; 2], VerifyError> {
    let set = format!("wing.right.motion.psi.constant_deg={angle}");
    let setup = setup(&[&set])?;
    let at = |&speed: &f64| condition(&setup, speed, &FlutterSettings::default());
    let all: Vec<Vec<Condition>> = speeds.iter().map(at).collect::<Result<_, _>>()?;
    let all = all.concat();
    let begins = crossings(&all).into_iter().find(|c| c.begins);
    Ok(begins.map_or([f64::NAN; 2], |c| [c.speed, c.frequency / TAU]))
}

fn flutter(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = vec![];
    for (angle, speeds, measured, hertz) in [
        (7.0, [36.0, 38.0], 38.0, 29.4),
        (3.0, [47.0, 49.0], 49.0, 30.0),
    ] {
        let [speed, frequency] = onset(angle, &speeds)?;
        let name = |what: &str| format!("{what} at {angle} deg");
        rows.push(
            Row::new(name("flutter begins"), "m/s", speed)
                .against(measured, TESTS)
                .within_part(0.04, "stated beforehand; no structural damping"),
        );
        rows.push(
            Row::new(name("its frequency"), "Hz", frequency)
                .against(hertz, TESTS)
                .because("stated, not judged"),
        );
    }
    Ok(rows)
}
