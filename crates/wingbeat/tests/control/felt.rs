//! Controllers that feel the air.

use std::sync::{Arc, Mutex};

use wingbeat::air::Points;
use wingbeat::flight::{AirProbe, Controller, Feedback, Sensed, Simulation};
use wingbeat::math::DVec3;
use wingbeat::model::motion::Adjustment;

use super::{case, in_blades};

/// Velocity of the air at one point at each look; none where nothing is felt.
type Felt = Arc<Mutex<Vec<Option<DVec3>>>>;

fn point() -> Points {
    [DVec3::new(1e-3, 0.0, 2e-3)].into_iter().collect()
}

/// Takes down what it feels.
#[derive(Clone, Debug)]
struct Feeling(Felt);

impl Controller for Feeling {
    fn feels_air(&self) -> bool {
        true
    }

    fn feel(&mut self, air: Option<AirProbe>) {
        let velocity = air.and_then(|air| air.velocity(&point()).unwrap());
        self.0.lock().unwrap().push(velocity.map(|v| v.get(0)));
    }

    fn command(&mut self, _: &Sensed) -> Result<Vec<Adjustment>, String> {
        Ok(vec![Adjustment::default(); 2])
    }
}

fn feedback(felt: &Felt) -> Option<Feedback> {
    Some(Feedback {
        controller: Arc::new(Feeling(Arc::clone(felt))),
        interval: 4,
        latency: 0,
        lag: 0.0,
    })
}

/// The wakes at a look are those at the end of its step.
#[test]
fn agrees_the_air_at_a_look_with_that_after_its_step() {
    let keys = [
        "time.beats=1",
        "flight.held_beats=0.2",
        "time.steps_per_beat=20",
        "wing.right.mesh={chordwise=2,spanwise=3}",
        "control.controller=none",
    ];
    let (felt, mut after) = (Felt::default(), vec![]);
    let mut setup = case(&keys).setup;
    setup.feedback = feedback(&felt);
    let mut flight = Simulation::new(setup).unwrap();
    while !flight.finished() {
        if felt.lock().unwrap().len() > after.len() {
            after.push(flight.air_velocity(&point()).unwrap().map(|v| v.get(0)));
        }
        flight.step().unwrap();
    }
    let felt = felt.lock().unwrap();
    assert!(after.len() >= 3 && after.iter().all(Option::is_some));
    assert_eq!(felt[..after.len()], after[..]);
    assert_ne!(felt[0], felt[1]);
}

/// Blade elements have no air at points.
#[test]
fn behaves_nothing_is_felt_where_the_air_is_no_lattice() {
    let felt = Felt::default();
    let mut setup = in_blades(&["time.beats=1"]);
    setup.feedback = feedback(&felt);
    wingbeat::Flight::from(setup).fly().unwrap();
    let felt = felt.lock().unwrap();
    assert!(felt.len() > 3 && felt.iter().all(Option::is_none));
}
