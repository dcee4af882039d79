//! Controllers of any kind behind sensors that are not perfect.

use std::sync::Arc;

use wingbeat_flight::{
    Aim, AirProbe, ControlModel, Controller, FlightError, FlightSetup, RESUME_AS_SAVED, Sensed,
};
use wingbeat_math::{DMat3, DVec3};
use wingbeat_model::motion::Adjustment;

use crate::control::sensors::Sensors;

/// A controller that sees what sensors make of the truth, at every so many looks.
#[derive(Clone, Debug)]
pub struct Sensing {
    /// The controller.
    pub controller: Arc<dyn ControlModel>,
    /// Noise and bias of what it sees; none: the truth.
    pub sensors: Option<Sensors>,
    /// Looks from one question to it to the next; its command is kept between them.
    pub every: usize,
}

impl ControlModel for Sensing {
    fn open(&self, setup: &FlightSetup) -> Result<Box<dyn Controller>, FlightError> {
        Ok(Box::new(Seeing {
            controller: self.controller.open(setup)?,
            sensors: self.sensors,
            every: self.every,
            command: vec![Adjustment::default(); setup.animal.wings.len()],
        }))
    }

    fn follows(&self) -> bool {
        self.controller.follows()
    }

    fn every(&self) -> usize {
        self.every
    }

    fn arrivals(&self) -> Vec<f64> {
        self.controller.arrivals()
    }

    fn holds_attitude(&self) -> bool {
        self.controller.holds_attitude()
    }

    fn velocity(&self, setup: &FlightSetup) -> Option<DVec3> {
        self.controller.velocity(setup)
    }

    fn holds_only_altitude(&self) -> bool {
        self.controller.holds_only_altitude()
    }

    fn redrawn(&self, by: u64) -> Option<Arc<dyn ControlModel>> {
        let sensors = self.sensors?.redrawn(by)?;
        Some(Arc::new(Self {
            sensors: Some(sensors),
            ..self.clone()
        }))
    }
}

/// The same in a flight.
struct Seeing {
    controller: Box<dyn Controller>,
    sensors: Option<Sensors>,
    every: usize,
    /// The newest, one for each wing.
    command: Vec<Adjustment>,
}

impl Controller for Seeing {
    fn command(&mut self, sensed: &Sensed) -> Result<Vec<Adjustment>, String> {
        if sensed.look.is_multiple_of(self.every) {
            let seen = self.sensors.map_or(*sensed, |s| s.seen(sensed));
            self.command = self.controller.command(&seen)?;
        }
        Ok(self.command.clone())
    }

    fn feels_air(&self) -> bool {
        self.controller.feels_air()
    }

    fn feel(&mut self, air: Option<AirProbe>) {
        self.controller.feel(air);
    }

    fn aim(&self, time: f64) -> Option<Aim> {
        self.controller.aim(time)
    }

    fn attitude(&self, look: usize, time: f64) -> Option<DMat3> {
        self.controller.attitude(look, time)
    }

    fn is_limited(&self) -> bool {
        self.controller.is_limited()
    }

    fn memory(&self) -> Vec<f64> {
        let numbers = |a: &Adjustment| a.numbers().map(|(_, x)| x);
        let command = self.command.iter().flat_map(numbers);
        command.chain(self.controller.memory()).collect()
    }

    fn restore(&mut self, memory: &[f64]) -> Result<(), String> {
        let (commands, rest) = memory
            .as_chunks::<8>()
            .0
            .split_at_checked(self.command.len())
            .map(|(commands, _)| (commands, &memory[8 * commands.len()..]))
            .ok_or_else(|| format!("it has no command for every wing; {RESUME_AS_SAVED}"))?;
        self.controller.restore(rest)?;
        self.command = commands
            .iter()
            .map(|x| Adjustment::of_numbers(*x))
            .collect();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use wingbeat_dynamics::BodyMotion;
    use wingbeat_flight::control::fits;

    use super::*;
    use crate::control::sensors::Channels;

    /// Commands what it sees of the height, of one wing.
    struct Height;

    impl Controller for Height {
        fn command(&mut self, sensed: &Sensed) -> Result<Vec<Adjustment>, String> {
            Ok(vec![Adjustment {
                stroke_amplitude: sensed.centre.z,
                ..Adjustment::default()
            }])
        }

        fn memory(&self) -> Vec<f64> {
            vec![7.0]
        }

        fn restore(&mut self, memory: &[f64]) -> Result<(), String> {
            fits(memory, 1)
        }
    }

    #[test]
    fn exact_a_controller_of_any_kind_sees_what_sensors_make_of_the_truth() {
        let sensors = Sensors {
            seed: 3,
            noise: Channels {
                position: 1e-3,
                ..Channels::default()
            },
            ..Sensors::default()
        };
        let seeing = || Seeing {
            controller: Box::new(Height),
            sensors: Some(sensors),
            every: 2,
            command: vec![Adjustment::default()],
        };
        let truth = |look| Sensed {
            look,
            time: 0.0,
            root: BodyMotion::REST,
            centre: DVec3::ZERO,
            velocity: DVec3::ZERO,
        };
        let mut controller = seeing();
        let first = controller.command(&truth(0)).unwrap();
        assert_eq!(first[0].stroke_amplitude, sensors.seen(&truth(0)).centre.z);
        assert!(first[0].stroke_amplitude != 0.0);
        // Between its looks the command is kept, over a checkpoint too.
        let mut resumed = seeing();
        resumed.restore(&controller.memory()).unwrap();
        assert_eq!(resumed.command(&truth(1)).unwrap(), first);
        assert_ne!(resumed.command(&truth(2)).unwrap(), first);
        assert!(resumed.restore(&[1.0; 8]).is_err() && resumed.restore(&[]).is_err());
    }
}
