//! A membrane of latex on a rigid frame in a stream.

use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;
use wingbeat_math::DVec3;

use crate::{Case, Part, Row, VerifyError};

pub(super) const CASES: &[Case] = &[Case {
    name: "membrane",
    about: "A membrane of latex on a rigid frame of aspect ratio 2 in a stream (Rojratsirikul et al. 2011): its largest mean \
            displacement and the normal force, attached flow.",
    part: Part::Experiments,
    quick: false,
    run,
}];

const CHORD: f64 = 0.0688;
const AREA: f64 = CHORD * 0.1375;
const DENSITY: f64 = 1.208;

/// Way of the stream in a step \[m\].
const WAY: f64 = 0.0069;

/// Steps, and those at the end over which is averaged.
const STEPS: usize = 600;
const MEAN: usize = 100;

const SOURCE: &str = "Rojratsirikul, Genc, Wang & Gursul 2011, J. Fluids Struct. 27:1296, figures digitised by others";

/// Mean of the largest displacement over the chord and of the normal force over dynamic pressure and area at a
/// speed [m/s] and an angle of attack \[deg\].
fn steady(
    speed: f64,
    angle: f64,
    [chordwise, spanwise]: [usize; 2],
) -> Result<[f64; 2], VerifyError> {
    let set = [
        format!("air.stream_m_s=[-{speed},0,0]"),
        format!("time.step_s={}", WAY / speed),
        format!("time.steps={STEPS}"),
        "air.max_wake_rows=40".to_owned(),
        format!("wing.right.structure.mass_damping_per_s={}", 6.0 * speed),
        format!("wing.right.motion.psi.constant_deg={angle}"),
        format!("wing.right.mesh.chordwise={chordwise}"),
        format!("wing.right.mesh.spanwise={spanwise}"),
    ];
    let case = LoadedCase::find("membrane-wing", &set)?;
    let mut flight = Simulation::new(case.setup)?;
    let built = flight.state().wings[0].structure.configuration.clone();
    let (mut deepest, mut force) = (0.0, DVec3::ZERO);
    while !flight.finished() {
        let counts = flight.record().step >= STEPS - MEAN;
        let record = flight.step()?;
        if counts {
            force += record.air_force() / MEAN as f64;
            let bent = &flight.state().wings[0].structure.configuration;
            let moved = bent.position.iter().zip(&built.position);
            deepest += moved.fold(0.0, |most: f64, (x, y)| most.max(x.distance(*y))) / MEAN as f64;
        }
    }
    let (sin, cos) = angle.to_radians().sin_cos();
    // The stream comes from ahead; gravity, were there any, would point along z.
    let normal = force.dot(DVec3::new(sin, 0.0, cos)).abs();
    let pressure = 0.5 * DENSITY * speed * speed;
    Ok([deepest / CHORD, normal / (pressure * AREA)])
}

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = vec![];
    let [coarse, fine] = [[6, 8], [8, 12]];
    let at = |mesh| steady(10.0, 8.0, mesh);
    let (a, b) = (at(coarse)?, at(fine)?);
    let change = [0, 1].map(|k| (a[k] / b[k] - 1.0).abs());
    for (speed, angle, measured) in [
        (10.0, 4.0, [0.0599, 0.4569]),
        (10.0, 8.0, [0.06106, 0.7708]),
        (10.0, 14.0, [0.07082, 1.1646]),
        (7.5, 8.0, [0.04377, 0.5677]),
        (5.0, 8.0, [0.02802, 0.4431]),
    ] {
        let here = steady(speed, angle, fine)?;
        let names = [
            "largest displacement over the chord",
            "normal force coefficient",
        ];
        for (k, name) in names.into_iter().enumerate() {
            rows.push(
                Row::new(format!("{name}, {speed} m/s, {angle} deg"), "1", here[k])
                    .against(measured[k], SOURCE)
                    .uncertain(change[k] * here[k])
                    .within_part(0.15, "stated beforehand: tension at rest is not reported, taken as none, nor Poisson's ratio (0.49); uncertainty: 6 x 8 panels for 8 x 12"),
            );
        }
    }
    Ok(rows)
}
