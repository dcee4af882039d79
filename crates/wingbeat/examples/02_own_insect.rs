//! An insect of one's own in blade elements and in the vortex lattice.
//! `cargo run --release --example 02_own_insect`

use wingbeat::model::species::{FlyOptions, drosophila_melanogaster};
use wingbeat::prelude::*;

/// Air at sea level: density [kg/m3], kinematic viscosity [m2/s].
const AIR: [f64; 2] = [1.225, 1.5e-5];

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A fruit fly half as large again, its wings a third heavier.
    let mut insect = drosophila_melanogaster(&FlyOptions {
        scale: 1.5,
        frequency: 150.0,
        wing_rows: 3,
        wing_cols: 6,
        ..FlyOptions::default()
    })?;
    for wing in &mut insect.wings {
        wing.mass = wing.mass.scaled(4.0 / 3.0);
    }
    let start = StartState {
        angles: DVec3::new(47.5_f64.to_radians(), 0.0, 0.0),
        ..StartState::default()
    };
    let quick = AirModel::BladeElement(BladeOptions::insect(AIR[0]));
    let whole = AirModel::VortexLattice(AirOptions::insect(AIR[0], AIR[1], 1.05e-3));
    for air in [quick, whole] {
        let flight = Flight::new("my insect", insect.clone(), air)
            .start(start.clone())
            .beats(2.0);
        let run = flight.fly()?;
        let last = run.beats()[1];
        println!(
            "{}: lift {:.2} weights",
            flight.setup.air.name(),
            last.lift_over_weight
        );
    }
    Ok(())
}
