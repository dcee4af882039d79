//! `wingbeat check`: a case is built but not flown.

use std::sync::Arc;

use wingbeat::case::external::Unasked;
use wingbeat::case::{IoError, LoadedCase};
use wingbeat::flight::{AirModel, FlightSetup, MotionMode, Simulation};
use wingbeat::results::fixed::fixed;

use crate::failure::Failure;
use crate::terminal::say;

/// Builds the flight up to step 0 and describes it. Nothing of the case is executed: a program
/// that computes the air is not started.
pub(crate) fn check(name: &str, set: &[String]) -> Result<(), Failure> {
    let case = LoadedCase::find(name, set)?;
    let mut setup = case.setup.clone();
    if let AirModel::External(air) = &mut setup.air {
        *air = Arc::new(Unasked);
    }
    let flight = Simulation::new(setup).map_err(|e| {
        let fault = case.fault("", e.to_string(), "correct the case and check it again");
        IoError::from(fault)
    })?;
    say!("{}: this case can be flown.\n", case.origin());
    describe(&case.setup);
    say!("{:<10}{} panels", "lattice", panels(&flight));
    if let Some(program) = case.program() {
        say!(
            "{:<10}`wingbeat run` will start this one with your rights: {program}",
            "program"
        );
    }
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
    say!(
        "{:<10}{:.4e} kg, of it body {:.4e} kg",
        "mass",
        animal.mass(),
        animal.body.mass
    );
    let centre = animal.body.centre().to_array().map(|x| fixed(1e3 * x, 3));
    say!(
        "{:<10}mass centre of the body at [{}] mm",
        "body",
        centre.join(", ")
    );
    for w in animal.wing_reports() {
        say!(
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
    say!("{:<10}{mode}, {air}", "flight");
    let time = &setup.time;
    say!("{:<10}{} steps of {:.4e} s", "time", time.steps, time.step);
}
