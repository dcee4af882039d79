//! Wings whose beats repeat themselves in whole steps: known beforehand, and the same flight.

use crate::common;

use std::sync::Arc;

use common::{Fly, distance, fly};
use wingbeat_blade::BladeSettings;
use wingbeat_dynamics::{AddedMass, Wrench};
use wingbeat_flight::air::BladeAir;
use wingbeat_flight::*;

/// Steps of a wingbeat.
const STEPS: usize = 40;

fn options() -> BladeOptions {
    BladeOptions {
        blade: BladeSettings::insect(1.2),
        ..BladeOptions::insect(1.2)
    }
}

/// Four beats; they start over half a beat.
fn setup() -> FlightSetup {
    FlightSetup {
        air: AirModel::BladeElement(options()),
        ..Fly::default().setup(STEPS, 4.0)
    }
}

/// Blade elements that say they have a memory, so that the wings' motion is evaluated at every time anew.
#[derive(Debug)]
struct Remembering(BladeAir);

impl Air for Remembering {
    fn loads(
        &self,
        at: &Instant<'_>,
        memory: Option<&AirMemory>,
        scratch: &mut AirScratch,
        out: &mut [Wrench],
    ) -> Result<(), FlightError> {
        self.0.loads(at, memory, scratch, out)
    }

    fn added_mass(&self, t: f64, scratch: &mut AirScratch, out: &mut Vec<AddedMass>) {
        self.0.added_mass(t, scratch, out);
    }

    fn has_memory(&self) -> bool {
        true
    }
}

/// Nothing of what it remembers is in the state of the flight.
#[test]
fn refuses_to_resume_air_that_keeps_its_memory_to_itself() {
    let setup = setup();
    let air = BladeAir::new(&setup.animal, &options()).expect("blade elements");
    let own = FlightSetup {
        air: AirModel::Own(Arc::new(Remembering(air))),
        ..setup
    };
    let mut flight = Simulation::new(own.clone()).expect("a flight");
    flight.step().expect("a step");
    let state = flight.state().clone();
    assert!(!own.air.is_saved(state.air.as_ref()));
    let refused = Simulation::resume(own, state)
        .map(drop)
        .unwrap_err()
        .to_string();
    assert!(refused.contains("memory"), "{refused}");
}

#[test]
fn invariant_wings_of_all_beats_after_the_start_are_the_same_to_the_bit() {
    let setup = setup();
    let records = fly(setup.clone());
    for (k, r) in records.iter().enumerate().skip(2 * STEPS) {
        assert_eq!(r.wing_angles, records[k - STEPS].wing_angles, "{k}");
        for (w, angles) in setup.animal.wings.iter().zip(&r.wing_angles) {
            let now = w.motion.angles(r.time);
            let gap = (0..3).map(|i| (now[i][0] - angles[i]).abs());
            // The phase of four beats, to its roundings.
            assert!(gap.fold(0.0, f64::max) < 1e-14, "{k}");
        }
    }
}

#[test]
fn agrees_flight_on_beats_known_beforehand_with_one_that_evaluates_them() {
    let known = setup();
    let air = BladeAir::new(&known.animal, &options()).expect("blade elements");
    let evaluated = FlightSetup {
        air: AirModel::Own(Arc::new(Remembering(air))),
        ..known.clone()
    };
    let (mut known, evaluated) = (fly(known), fly(evaluated));
    for record in &mut known {
        record.dynamic_impulse = 0.0; // a model of one's own tells no density
    }
    // To the bit over the start, half a beat, and one beat; then the phase of the one lacks what the time loses.
    let differs = known.iter().zip(&evaluated).position(|(a, b)| a != b);
    assert!(
        differs.is_some_and(|k| k > STEPS / 2 + STEPS),
        "{differs:?}"
    );
    let last = 4 * STEPS;
    let gap = distance(&known[last], &evaluated[last]);
    let moved = distance(&known[last], &known[0]);
    // Roundings of two beats.
    assert!(gap < 1e-12 && moved > 1e-2, "{gap:.1e} {moved:.1e}");
}

#[test]
fn invariant_resumed_beats_go_on_bit_for_bit() {
    for integrator in [IntegratorChoice::Hamming, IntegratorChoice::RungeKutta] {
        let setup = FlightSetup {
            integrator,
            ..setup()
        };
        let mut whole = Simulation::new(setup.clone()).expect("a flight");
        (0..3 * STEPS - 7).for_each(|_| _ = whole.step().expect("a step"));
        let state = whole.state().clone();
        let mut resumed = Simulation::resume(setup, state).expect("its own state");
        for _ in 0..20 {
            let expected = whole.step().expect("a step").clone();
            assert_eq!(*resumed.step().expect("a step"), expected);
        }
    }
}
