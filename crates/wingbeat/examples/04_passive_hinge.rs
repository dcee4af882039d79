//! A robot whose wings feather by themselves on springs, damped, between stops at 75 deg: range of the passive
//! angle and lift against stiffness, at 100 Hz in blade elements.
//! `cargo run --release --example 04_passive_hinge`

use wingbeat::dynamics::ElementLaw;
use wingbeat::prelude::*;

/// Springs of all joints this many times as stiff.
fn stiffened(mut flight: Flight, factor: f64) -> Flight {
    let joints = flight.setup.joints.iter_mut();
    for element in joints.flat_map(|j| &mut j.model.elements) {
        if let ElementLaw::Spring { stiffness, .. } = &mut element.law {
            *stiffness *= factor;
        }
    }
    flight
}

/// Least and greatest angle [rad] of the right wing's hinge in the last of three wingbeats, and the
/// mean lift in it over the weight [1].
pub(crate) fn last_beat(factor: f64) -> Result<[f64; 3], Error> {
    let robot = Flight::preset("robobee")?.air(AirModel::BladeElement(BladeOptions::insect(1.225)));
    let run = stiffened(robot, factor)
        .frequency_hz(100.0)
        .beats(3.0)
        .fly()?;
    let angle = run.joint("hinge-right", 0).expect("a hinge of the preset");
    let last = &angle[angle.len() * 2 / 3..];
    let least = last.iter().copied().fold(f64::INFINITY, f64::min);
    let most = last.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Ok([least, most, run.beats()[2].lift_over_weight])
}

pub(crate) fn main() -> Result<(), Error> {
    for factor in [0.5, 1.0, 2.0, 4.0] {
        let [least, most, lift] = last_beat(factor)?;
        println!(
            "{factor:3} times as stiff: feathers from {:+6.1} to {:+6.1} deg, lift {lift:.2} weights",
            least.to_degrees(),
            most.to_degrees()
        );
    }
    Ok(())
}
