//! `wingbeat check`: a case is built but not flown.

use wingbeat::case::{IoError, LoadedCase};
use wingbeat::flight::{FlightSetup, MotionMode, Simulation};

/// Builds the flight up to step 0 and describes it.
pub(crate) fn check(name: &str, set: &[String]) -> Result<(), IoError> {
    let case = LoadedCase::find(name, set)?;
    let flight = Simulation::new(case.setup.clone());
    let flight = flight.map_err(|e| case.refused(&e))?;
    println!("{}: this case can be flown.\n", case.origin());
    describe(&case.setup);
    println!("{:<10}{} panels", "lattice", panels(&flight));
    Ok(())
}

fn panels(flight: &Simulation) -> usize {
    flight
        .snapshot()
        .surfaces
        .iter()
        .map(|s| s.quads.len())
        .sum()
}

fn describe(setup: &FlightSetup) {
    let animal = &setup.animal;
    println!(
        "{:<10}{:.4e} kg, of it body {:.4e} kg",
        "mass",
        animal.mass(),
        animal.body.mass
    );
    let centre = animal.body.centre() * 1e3;
    println!("{:<10}mass centre of the body at {centre:.3} mm", "body");
    for w in animal.wing_reports() {
        println!(
            "{:<10}`{}`: length {:.3} mm, area {:.3} mm2, mean chord {:.3} mm, r2_hat {:.3}, mass {:.3e} kg",
            "wing",
            w.name,
            w.length * 1e3,
            w.area * 1e6,
            w.mean_chord * 1e3,
            w.r2_hat,
            w.mass
        );
    }
    let mode = match setup.mode {
        MotionMode::Free(_) => "free flight",
        MotionMode::Tethered(_) => "tethered",
    };
    let air = setup.air.name();
    println!("{:<10}{mode}, {air}", "flight");
    let time = &setup.time;
    println!("{:<10}{} steps of {:.4e} s", "time", time.steps, time.step);
}
