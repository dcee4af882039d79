//! How much the mass of the wings matters: flights with wings of 0 to 10 % of the body's mass
//! against the standard equations of a rigid aircraft, which massless wings leave.
//!
//! `cargo run --release -p wingbeat-draw --example wing_mass [PRESET] [FIGURE.svg]` prints a table and
//! draws the differences and their first-order limit.

use wingbeat_case::LoadedCase;
use wingbeat_draw::figures::{Chart, Panel, Series};
use wingbeat_flight::{FlightSetup, Record, Simulation};
use wingbeat_math::DQuat;

/// Mass of all wings over that of the body.
const FRACTIONS: [f64; 13] = [
    0.0, 1e-4, 1e-3, 0.0025, 0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1,
];
/// The fraction whose differences give the first-order limit.
const SMALL: usize = 1;

type Any = Box<dyn std::error::Error>;

fn main() -> Result<(), Any> {
    let mut arguments = std::env::args().skip(1);
    let preset = arguments.next().unwrap_or("fruit-fly-blade".into());
    let figure = arguments.next().unwrap_or("wing_mass.svg".into());
    let case = LoadedCase::find(&preset, &["time.beats=4".into()])?;
    let flights: Vec<Vec<Record>> = FRACTIONS
        .iter()
        .map(|f| fly(with_wings(&case.setup, *f)))
        .collect::<Result<_, _>>()?;
    let differences: Vec<[f64; 2]> = flights.iter().map(|f| differ(f, &flights[0])).collect();
    println!("wing mass / body mass   attitude [deg]   mass centre [mm]");
    for (f, [turn, way]) in FRACTIONS.iter().zip(&differences) {
        println!("{f:>21} {turn:>16.6} {way:>18.6}");
    }
    let panels = [("attitude [deg]", 0), ("mass centre [mm]", 1)];
    let chart = Chart {
        title: format!("{preset}, four wingbeats: largest difference to the rigid aircraft"),
        x_label: "mass of the wings / mass of the body".into(),
        x: FRACTIONS.to_vec(),
        shaded: vec![],
        panels: panels
            .map(|(label, k)| panel(label, &differences, k))
            .to_vec(),
    };
    std::fs::write(&figure, chart.to_svg())?;
    println!("drawn: {figure}");
    Ok(())
}

/// The setup with wings of `fraction` of the body's mass in all, their shape kept.
fn with_wings(setup: &FlightSetup, fraction: f64) -> FlightSetup {
    let mut setup = setup.clone();
    let present: f64 = setup.animal.wings.iter().map(|w| w.mass.mass).sum();
    let factor = fraction * setup.animal.body.mass / present;
    for wing in &mut setup.animal.wings {
        wing.mass = wing.mass.scaled(factor);
    }
    setup
}

fn fly(setup: FlightSetup) -> Result<Vec<Record>, wingbeat_flight::FlightError> {
    let mut flight = Simulation::new(setup)?;
    let mut records = vec![flight.record().clone()];
    while !flight.finished() {
        records.push(flight.step()?.clone());
    }
    Ok(records)
}

/// Largest differences over two flights: attitude [deg], body origin [mm].
fn differ(a: &[Record], b: &[Record]) -> [f64; 2] {
    let attitude = |r: &Record| {
        let [w, x, y, z] = r.root_quaternion;
        DQuat::from_xyzw(x, y, z, w)
    };
    let way = |r: &Record, k: usize| r.coordinates[k];
    let mut most = [0.0_f64; 2];
    for (a, b) in a.iter().zip(b) {
        let turn = attitude(a).angle_between(attitude(b)).to_degrees();
        let gap: f64 = (0..3).map(|k| (way(a, k) - way(b, k)).powi(2)).sum();
        most = [most[0].max(turn), most[1].max(1e3 * gap.sqrt())];
    }
    most
}

fn panel(label: &str, differences: &[[f64; 2]], k: usize) -> Panel {
    let slope = differences[SMALL][k] / FRACTIONS[SMALL];
    let series = |label: &str, values: Vec<f64>| Series {
        label: label.into(),
        values,
        measured: false,
    };
    Panel {
        label: label.into(),
        series: vec![
            series("flight", differences.iter().map(|d| d[k]).collect()),
            series("first order", FRACTIONS.iter().map(|f| slope * f).collect()),
        ],
        ..Panel::default()
    }
}
