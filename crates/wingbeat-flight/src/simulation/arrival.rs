//! What is done at the end of a step: the controller looks, the record is made, the air is accepted.

use std::sync::Arc;

use wingbeat_air::Points;
use wingbeat_math::ode::StepReport;
use wingbeat_math::{DVec3, facing, heading, rotation_vector_of_matrix};

use super::Simulation;
use crate::equations::{Equations, Scratch};
use crate::error::FlightError;
use crate::interface::air_probe::AirProbe;
use crate::interface::controller::Aim;
use crate::interface::memory::AirMemory;
use crate::interface::record::Record;
use crate::setup::FlightSetup;
use crate::simulation::control::Sensed;
use crate::simulation::recorder::Sources;

impl Simulation {
    /// Record, acceptance of the air, and the start of a stage that begins here.
    pub(super) fn finish_arrival(
        &mut self,
        report: StepReport,
        starts: bool,
    ) -> Result<(), FlightError> {
        self.control()?;
        let (step, time) = (self.state.step, self.time(self.state.step));
        let (wings, feedback) = (&self.wings, self.feedback.as_ref());
        wings.write(&self.setup, feedback, step, &mut self.record);
        let sources = Sources {
            equations: &self.stages[self.state.stage].equations,
            scratch: &self.scratch,
            y: &self.state.past.y[self.newest()],
            air: self.state.air.as_ref(),
            wings: &self.state.wings,
            report,
        };
        sources.write(step, time, &mut self.state.ledger, &mut self.record)?;
        self.write_reference();
        let equations = &self.stages[self.state.stage].equations;
        let remembered = (&mut self.state.wings[..], &mut self.state.carried[..]);
        equations.accept(&mut self.state.air, remembered, &self.scratch)?;
        if starts && !self.finished() && !self.setup.integrator.is_one_step() {
            self.start()?;
        }
        Ok(())
    }

    /// Puts where the flyer is to be, and how far from the attitude to be held it is, into the record.
    fn write_reference(&mut self) {
        let since = self.state.step - self.stages[self.state.stage].from_step;
        let time = since as f64 * self.setup.time.step;
        let feedback = self.feedback.as_ref();
        let aim = feedback.and_then(|f| f.reference(time, || held(&self.record, &self.setup)));
        self.record.reference.clear();
        self.record.reference.extend(aim);
        let is_released = self.state.stage + 1 == self.stages.len();
        let (since, time) = if is_released { (since, time) } else { (0, 0.0) };
        let held = feedback.and_then(|f| f.attitude(since, time));
        let turn = held.map(|held| held.transpose() * self.record.root_rotation());
        self.record.attitude_departure.clear();
        let angle = turn.map(|turn| rotation_vector_of_matrix(turn).length());
        self.record.attitude_departure.extend(angle);
    }

    /// Asks the controller, where there is one and it is time; a flyer that is held is not steered.
    fn control(&mut self) -> Result<(), FlightError> {
        let Some(feedback) = &mut self.feedback else {
            return Ok(());
        };
        let stage = &self.stages[self.state.stage];
        let since = self.state.step - stage.from_step;
        let is_last = self.state.stage + 1 == self.stages.len();
        if is_last && feedback.looks_at(since) {
            let budget = &self.scratch.solution.budget;
            let t = self.state.step as f64 * self.setup.time.step;
            let sensed = Sensed {
                look: feedback.look(),
                time: since as f64 * self.setup.time.step,
                root: self.scratch.motions[0],
                centre: budget.centre,
                velocity: budget.momentum / stage.equations.core.system().total_mass(),
            };
            if feedback.feels_air() {
                let (equations, air) = (&stage.equations, self.state.air.as_ref());
                feedback.feel(felt(equations, air, &self.scratch)?);
            }
            feedback.update(t, &sensed)?;
            // What the scratch knows of the wings at this instant is that of the passage before.
            self.scratch.fit(&stage.equations);
            self.state.control = Some(feedback.state());
        }
        Ok(())
    }
}

/// Where the flyer of a record is, and where it goes and heads.
fn held(record: &Record, setup: &FlightSetup) -> Aim {
    let attitude = record.root_rotation();
    let down = setup.gravity.try_normalize().unwrap_or(DVec3::Z);
    Aim {
        position: record.mass_centre,
        velocity: record.momentum / setup.animal.mass(),
        heading: heading(facing(attitude, down), down),
        heading_rate: (attitude * record.root_angular_velocity).dot(down),
    }
}

/// The air that is felt at the end of the step whose motion `s` holds, which `memory` has not accepted yet;
/// none where it is no vortex lattice.
fn felt(
    equations: &Equations,
    memory: Option<&AirMemory>,
    s: &Scratch,
) -> Result<Option<AirProbe>, FlightError> {
    if memory.and_then(AirMemory::wakes).is_none() {
        return Ok(None);
    }
    let (air, mut memory) = (Arc::clone(&equations.air), memory.cloned());
    air.accept(&mut memory, &s.air_scratch)?;
    let velocity = move |points: &Points| air.velocity(memory.as_ref(), points);
    Ok(Some(AirProbe::new(velocity)))
}
