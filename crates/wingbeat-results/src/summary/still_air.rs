//! Work that air at rest cannot do.
//!
//! Air that is at rest far away has the energy that bodies have given it and no other: the work of the air on all
//! bodies is at most the kinetic energy of the air at the start, whatever moves the bodies. The same holds in a stream
//! U in the frame that moves with it, where the work is `W - U . J`, J the impulse of the air. That energy is at most about
//! that of the added mass of plates and solids that move broadside on,
//!
//! ```text
//! E = rho/2 (sum over wings of pi/4 c S V^2 + sum over solids of their volume V^2)
//! ```
//!
//! with mean chord c, area S and V the largest speed of the wing. Forces of models that are no flow can do more: those of
//! sections that feather while they fly backwards, by the published laws.

use wingbeat_flight::{AirModel, FlightSetup, Record};
use wingbeat_math::{DVec3, larger};

use super::verdict::Warnings;

/// How many times the energy of the added mass at the start is allowed: the sphere has half its volume, the plate that
/// of its circle, chords are larger than their mean.
const ROOM: f64 = 2.0;

/// Work, over the largest of the works of hinges and deformation and of the kinetic energy, that balances leave open.
const OPEN: f64 = 1e-2;

/// Says that the air did more work from the `first` to the `last` record than it can.
pub(super) fn warn(setup: &FlightSetup, [first, last]: [&Record; 2], list: &mut Warnings) {
    let (Some(density), Some(stream)) = (setup.air.density(), even_stream(setup)) else {
        return;
    };
    let held = ROOM * energy_at_start(setup, first, (density, stream));
    let carried = stream.dot(last.air_impulse);
    let work = last.air_work - carried;
    let exchanged = [
        last.hinge_work,
        last.deformation_work,
        last.kinetic_energy,
        first.kinetic_energy,
        carried,
    ];
    let scale = exchanged.map(f64::abs).into_iter().fold(0.0, larger);
    if work > held + OPEN * scale {
        list.limit(format!(
            "Air does work out of nothing. In the frame in which it rests it has done {work:.3e} J on the flyer, and it moved with no more than {held:.1e} J at the start: its forces are wrong. {}",
            remedy(setup)
        ));
    }
}

/// Velocity of the air far away where it is the same everywhere and always, N components [m/s].
fn even_stream(setup: &FlightSetup) -> Option<DVec3> {
    let is_induced =
        matches!(&setup.air, AirModel::BladeElement(air) if air.induced != DVec3::ZERO);
    let is_even = !is_induced && setup.air.wind()?.is_none();
    setup.air.stream().filter(|_| is_even)
}

/// Kinetic energy that air of this density [kg/m3] has at most in its stream [m/s] as the flight begins \[J\].
fn energy_at_start(setup: &FlightSetup, first: &Record, (density, stream): (f64, DVec3)) -> f64 {
    // Largest speed of a body as far as `reach` [m] from its origin: turns about Euler's axes at most add up.
    let speed = |body: usize, reach: f64| {
        let rates = first.rates.get(6 * body..6 * body + 6).unwrap_or(&[0.0; 6]);
        let turn: f64 = rates[3..].iter().map(|x| x.abs()).sum();
        (DVec3::from_slice(rates) - stream).length() + turn * reach
    };
    let animal = &setup.animal;
    let wings = animal.wing_reports();
    let plates = wings.iter().zip(&animal.wings).enumerate();
    let plates = plates.map(|(w, (report, wing))| {
        let reach = wing.mesh.nodes.iter().map(|r| r.length());
        let v = speed(1 + w, reach.fold(0.0, larger));
        0.25 * std::f64::consts::PI * report.mean_chord * report.area * v * v
    });
    let solids = animal.solids();
    let solids = (solids.iter())
        .map(|(body, volume, centre)| volume * speed(*body, centre.length()).powi(2));
    0.5 * density * (plates.sum::<f64>() + solids.sum::<f64>())
}

/// What to do about it.
fn remedy(setup: &FlightSetup) -> &'static str {
    match &setup.air {
        AirModel::BladeElement(air) if !air.blade.damps_feathering() => {
            "Sections that feather while they fly backwards do so by the published laws: take air.blade.rotation = \"circulation\" without rotation_coefficient, or air.blade.unsteady."
        }
        AirModel::BladeElement(air) if air.blade.unsteady.is_none() => {
            "Circulation that follows the motion at once can do so, which wakes of strips (air.blade.unsteady) take up; look at coefficients of your own, too."
        }
        AirModel::BladeElement(_) => "Look at coefficients of your own, and take smaller steps.",
        _ => "Take smaller steps and finer panels, or larger cores.",
    }
}
