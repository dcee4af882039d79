//! Wings on a body in a stream.

use std::path::Path;
use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;
use wingbeat_math::DVec3;

use crate::{Case, Part, Row, VerifyError};

pub(super) const CASES: &[Case] = &[Case {
    name: "wing-body",
    about: "Rectangular wings on a slender body of revolution at 4 deg (NACA Report 1307): lift of wings and body over that of the wings \
            put together; beating, the force over the rate of the impulse.",
    part: Part::Analytic,
    quick: false,
    run,
}];

/// Radius and length of the body, chord of the wings \[m\].
const RADIUS: f64 = 0.1;
const LENGTH: f64 = 1.6;
const CHORD: f64 = 0.2;
const STEPS: usize = 60;
const BEAT: usize = 40;

const REPORT: &str = "Pitts, Nielsen & Kaattari 1957, NACA Report 1307, slender-body theory";

const CHORDS: &str = "stated beforehand: the theory knows no chord, these have aspect ratios of 9 to 2.3; uncertainty: 16 x 24 panels of the \
                      body for 24 x 36";
const BEHIND: &str =
    "stated beforehand: what a body gets beside wings of some chord is not known to the theory";
const SHORT: &str = "of wings of aspect ratio 2.3 the theory has the body's share too low: another lattice, with straight wakes, has 0.54";

/// Wings of this length \[m\] on the body of this mesh, or put together without it; they beat by this angle \[deg\].
fn flight(
    length: f64,
    body: Option<[usize; 2]>,
    amplitude: f64,
) -> Result<Simulation, VerifyError> {
    let [meridians, stations] = body.unwrap_or([8, 6]);
    let (root, diameter) = (if body.is_some() { RADIUS } else { 0.0 }, 2.0 * RADIUS);
    let spanwise = (30.0 * length).round() as usize;
    let text = format!(
        "format = 1\ngravity_m_s2 = [0, 0, 0]\n[time]\nstep_s = 0.005\nsteps = {STEPS}\n[flight]\nmode = \"tethered\"\npitch_deg = 4\n\
         [air]\ndensity_kg_m3 = 1\nstream_m_s = [-10, 0, 0]\nshed = [\"trailing\"]\nbody = {on_body}\n\
         wake_core.algebraic.radius_chords = 0.01\nwake_overlap = 0\nsection_drag = {{ friction = \"none\" }}\n\
         [body]\nmass_kg = 0.1\ninertia_about_centre_kg_m2 = [1e-2, 1e-2, 1e-2, 0, 0, 0]\n\
         [body.part.trunk]\ncentre_m = [0, 0, 0]\nlength_m = {LENGTH}\ndiameter_m = {diameter}\nmeridians = {meridians}\n\
         stations = {stations}\n\
         [motion]\nfrequency_hz = 5\n\
         [wing.right]\nhinge_m = [0.05, {root}, 0]\nmass_kg = 0\njoined = {joined}\n\
         planform.rectangle = {{ chord_m = {CHORD}, span_m = {length}, axis_fraction = 0.25 }}\n\
         mesh = {{ chordwise = 6, spanwise = {spanwise} }}\nmotion.phi.fourier.sine_deg = [{amplitude}]\n",
        on_body = body.is_some(),
        joined = body.is_none(),
    );
    let case = LoadedCase::from_text("wings on a body", &text, Path::new(""), &[])?;
    Ok(Simulation::new(case.setup)?)
}

/// Lift of the body, and of the wings, at the end \[N\].
fn lift(length: f64, body: Option<[usize; 2]>) -> Result<[f64; 2], VerifyError> {
    let mut flight = flight(length, body, 0.0)?;
    while !flight.finished() {
        flight.step()?;
    }
    let air = &flight.record().air;
    let up = |from: usize, to: usize| air[from..to].iter().map(|a| -a.force.z).sum();
    Ok([up(0, 1), up(1, 3)])
}

/// Mean force of the last beat, and that by the rate of the impulse of all vorticity \[N\].
fn forces(length: f64, body: [usize; 2]) -> Result<[DVec3; 2], VerifyError> {
    let mut flight = flight(length, Some(body), 20.0)?;
    let mut gained = [DVec3::ZERO; 2];
    while !flight.finished() {
        flight.step()?;
        let record = flight.record();
        let sign = match record.step {
            STEPS => 1.0,
            step if step + BEAT == STEPS => -1.0,
            _ => continue,
        };
        gained[0] += sign * record.inviscid_impulse;
        gained[1] -= sign * record.vortex_impulse;
    }
    Ok(gained.map(|impulse| 5.0 * impulse))
}

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = vec![];
    let meshes = [[16, 24], [24, 36]];
    for (ratio, theory) in [
        (0.1, [0.133, 1.077]),
        (0.2, [0.278, 1.162]),
        (0.3, [0.437, 1.253]),
    ] {
        let length = RADIUS / ratio - RADIUS;
        let [_, alone] = lift(length, None)?;
        let [coarse, fine] = [
            lift(length, Some(meshes[0]))?.map(|l| l / alone),
            lift(length, Some(meshes[1]))?.map(|l| l / alone),
        ];
        let row = |k: usize, name: &str| {
            let quantity =
                format!("lift of the {name} over that of the wings put together, r/s = {ratio}");
            Row::new(quantity, "1", fine[k])
                .against(theory[k], REPORT)
                .uncertain(coarse[k] - fine[k])
        };
        rows.push(row(1, "wings").within_part(0.05, CHORDS));
        rows.push(match ratio < 0.3 {
            true => row(0, "body").within_part(0.25, BEHIND),
            false => row(0, "body").because(SHORT),
        });
    }
    let [force, by_impulse] = forces(0.4, meshes[1])?;
    rows.push(
        Row::new(
            "mean force of a beat by the pressures over that by the impulse",
            "1",
            force.length() / by_impulse.length(),
        )
        .against(1.0, "two ways to one force")
        .within(0.02, "twice what panels of half a chord leave"),
    );
    Ok(rows)
}
