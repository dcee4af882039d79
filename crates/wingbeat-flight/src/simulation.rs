//! The flight itself: from a setup to accepted steps and their records.
//!
//! One step is a recipe: move the wake once with the velocities of the accepted step and freeze
//! it; predict; correct bodies and air together until they agree; accept both; record.

mod arrival;
pub mod control;
mod ending;
mod fits;
mod fly;
mod newest;
pub(crate) mod recorder;
mod release;
mod start;
mod state;
pub(crate) mod turns;
mod wings;

pub use state::{FlightState, Past};

use wingbeat_air::Tally;
use wingbeat_dynamics::BodyMotion;
use wingbeat_math::ode::{
    BACKWARD_START, Multistep, StepError, StepReport, block_start, order_two_start,
    scaled_difference, stepwise_start,
};

use self::fits::check_fits;
use self::start::StartingSteps;
use self::wings::WingAngles;
use crate::bodies::own_motion;
use crate::elastic::ElasticState;
use crate::equations::quadratures::QUADRATURES;
use crate::equations::solver::{Solver, convergence};
use crate::equations::stages::{Stage, stages};
use crate::equations::{Equations, Memory, Scratch};
use crate::error::FlightError;
use crate::interface::memory::{AirMemory, wakes_of};
use crate::interface::record::Record;
use crate::setup::{AirModel, FlightSetup, IntegratorChoice};
use crate::simulation::control::{FeedbackLoop, feedback};
use crate::simulation::recorder::Ledger;

/// Target of the `log` events that say that a step begins; fields `step`, `steps`.
pub const STEP_EVENT: &str = "wingbeat::step";

/// A flight in progress.
pub struct Simulation {
    setup: FlightSetup,
    stages: Vec<Stage>,
    state: FlightState,
    solver: Solver,
    scratch: Scratch,
    record: Record,
    wings: WingAngles,
    release: Option<BodyMotion>,
    feedback: Option<FeedbackLoop>,
}

impl Simulation {
    /// Builds the flight and evaluates its start; the record of step 0 is available at once.
    ///
    /// # Errors
    /// A setup that contradicts itself, bodies or surfaces that are impossible, a start state
    /// without consistent coordinates, a start that does not converge.
    pub fn new(setup: FlightSetup) -> Result<Self, FlightError> {
        Self::begun(setup, None, None)
    }

    /// The same, the elastic wings bent and moving as in `wings` at the start, in their order: to go on with a
    /// beat that begins where another one ended.
    ///
    /// # Errors
    /// As [`Self::new`]; wings that are not those of the setup.
    pub fn bent(setup: FlightSetup, wings: &[ElasticState]) -> Result<Self, FlightError> {
        Self::begun(setup, Some(wings), None)
    }

    /// The same with the `past` of elastic wings and of the wakes of strips.
    ///
    /// # Errors
    /// As [`Self::bent`]; wakes that are not those of the setup's strips.
    pub fn after(setup: FlightSetup, past: &Past) -> Result<Self, FlightError> {
        Self::begun(setup, Some(&past.wings), past.air.as_ref())
    }

    fn begun(
        setup: FlightSetup,
        bent: Option<&[ElasticState]>,
        air: Option<&AirMemory>,
    ) -> Result<Self, FlightError> {
        setup.validate()?;
        let feedback = feedback(&setup)?;
        let wings = feedback.as_ref().map(FeedbackLoop::wings);
        let stages = stages(&setup, &|k, wing| match wings {
            Some(wings) => wings[k].clone(),
            None => own_motion(k, wing),
        })?;
        let first = &stages[0].equations;
        if let Some(bent) = bent {
            fits::check_wings(&stages[0], bent)?;
        }
        if air.is_some() {
            first.air.check(air)?;
        }
        let state = FlightState {
            step: 0,
            stage: 0,
            started_at: 0,
            past: Multistep::default(),
            start_report: StepReport::default(),
            air: None,
            wings: bent.map_or_else(|| first.elastic.initial(), without_dissipated_energy),
            carried: first.carried.initial(),
            ledger: Ledger::default(),
            control: feedback.as_ref().map(FeedbackLoop::state),
        };
        let mut flight = Self {
            solver: Solver::new(first, setup.integrator, &setup.corrector),
            scratch: Scratch::new(first),
            record: Record::default(),
            wings: WingAngles::new(&setup, stages[0].equations.core.system()),
            release: None,
            feedback,
            setup,
            state,
            stages,
        };
        flight.scratch.elastic = flight.equations().elastic.scratch(&flight.state.wings);
        match flight.begin(bent.is_some_and(|b| !b.is_empty()), air) {
            Ok(()) => Ok(flight),
            Err(ended) => Err(flight.explained(ended)),
        }
    }

    /// Goes on from a saved state of the same setup. The next [`Self::step`] makes the first new
    /// record; until then [`Self::record`] is that of step 0.
    ///
    /// # Errors
    /// As [`Self::new`]; the state does not fit the setup.
    pub fn resume(setup: FlightSetup, state: FlightState) -> Result<Self, FlightError> {
        if !setup.air.is_saved(state.air.as_ref()) {
            return Err(FlightError::External(
                "the memory of what computes it is not in the saved state; fly from the start"
                    .into(),
            ));
        }
        let mut flight = Self::new(setup)?;
        check_fits(
            &state,
            &flight.stages,
            (&flight.state.ledger, flight.feedback.is_some()),
        )?;
        flight.state = state;
        let time = flight.newest_time();
        (flight.state.air.iter_mut()).for_each(|air| air.set_time(time));
        let first = &flight.stages[flight.state.stage].equations;
        flight.solver = flight.new_solver();
        flight.scratch = Scratch::new(first);
        flight.scratch.elastic = first.elastic.scratch(&flight.state.wings);
        if let (Some(feedback), Some(state)) = (&mut flight.feedback, &flight.state.control) {
            feedback.restore(state)?;
        }
        flight.lay_out()?;
        Ok(flight)
    }

    /// A second flight where this one is: both go on from here, bit for bit alike unless controllers or models of
    /// the air from outside remember what they have been asked.
    ///
    /// # Errors
    /// As [`Self::resume`].
    pub fn branch(&self) -> Result<Self, FlightError> {
        let mut branch = Self::resume(self.setup.clone(), self.state.clone())?;
        branch.record.clone_from(&self.record);
        branch.release = self.release;
        let (loads, own) = (&mut branch.scratch.air_scratch.loads, &self.scratch);
        loads
            .pressure_jump
            .clone_from(&own.air_scratch.loads.pressure_jump);
        Ok(branch)
    }

    /// Bodies, nodes and circulations as the state has them. What the pressure was it does not tell.
    fn lay_out(&mut self) -> Result<(), FlightError> {
        let (t, k) = (self.time(self.state.step), self.newest());
        let (y, s) = (&self.state.past.y[k], &mut self.scratch);
        let equations = &self.stages[self.state.stage].equations;
        equations.place_nodes(t, y, s)?;
        if let Some(air) = wakes_of(self.state.air.as_ref()) {
            let loads = &mut s.air_scratch.loads;
            loads.gamma.clone_from(&air.gamma);
            loads.pressure_jump = vec![f64::NAN; air.gamma.len()];
        }
        Ok(())
    }

    /// The setup.
    pub fn setup(&self) -> &FlightSetup {
        &self.setup
    }

    /// The state after the newest step.
    pub fn state(&self) -> &FlightState {
        &self.state
    }

    /// The record of the newest step.
    pub fn record(&self) -> &Record {
        &self.record
    }

    /// Sums over the wakes of a lattice that were checked since the flight began or went on.
    pub fn tally(&self) -> Tally {
        self.scratch.air_scratch.workspace.tally()
    }

    /// Sets the root into the motion `root` when its hold ends; the air stays as it is. For
    /// disturbances: a jump of the attitude is one of the wings, too.
    pub fn release_into(&mut self, root: BodyMotion) {
        self.release = Some(root);
    }

    /// Time of the newest step [s].
    pub fn newest_time(&self) -> f64 {
        self.time(self.state.step)
    }

    /// Whether the last step of the setup has been made.
    pub fn finished(&self) -> bool {
        self.state.step >= self.setup.time.steps
    }

    /// One step.
    ///
    /// # Errors
    /// Bodies and air do not agree; an attitude is singular; numbers are not finite. The flight
    /// cannot go on after an error.
    pub fn step(&mut self) -> Result<&Record, FlightError> {
        let (step, steps) = (self.state.step, self.setup.time.steps);
        log::trace!(target: STEP_EVENT, step, steps; "");
        if let Err(ended) = self.advance() {
            return Err(self.explained(ended));
        }
        Ok(&self.record)
    }

    fn advance(&mut self) -> Result<(), FlightError> {
        let equations = &self.stages[self.state.stage].equations;
        equations.advance_air(&mut self.state.air, &mut self.scratch)?;
        self.state.step += 1;
        let has_start = !self.setup.integrator.is_one_step();
        let report = if has_start && self.state.step - self.state.started_at <= 3 {
            self.replay_start()?
        } else {
            self.predict_and_correct()?
        };
        self.arrive(report)
    }

    fn equations(&self) -> &Equations {
        &self.stages[self.state.stage].equations
    }

    fn time(&self, step: usize) -> f64 {
        step as f64 * self.setup.time.step
    }

    fn new_solver(&self) -> Solver {
        let (method, corrector) = (self.setup.integrator, &self.setup.corrector);
        Solver::new(self.equations(), method, corrector)
    }

    /// Number of the newest state within `past`.
    fn newest(&self) -> usize {
        if self.setup.integrator.is_one_step() {
            return 3;
        }
        (self.state.step - self.state.started_at).min(3)
    }

    /// The first moment: consistent coordinates, circulation without a wake, open books.
    fn begin(&mut self, is_bent: bool, air: Option<&AirMemory>) -> Result<(), FlightError> {
        let root = self.setup.root_at_start();
        let Equations { core, elastic, .. } = &self.stages[0].equations;
        let mut y0 = core.initial(0.0, &root)?;
        if is_bent && core.dim() > 0 {
            let mut motions = self.scratch.motions.clone();
            core.motions(0.0, &y0, &mut core.workspace(), &mut motions)?;
            let shapes: Vec<_> = elastic.shape_masses(&self.scratch.elastic).collect();
            y0 = core.initial_shaped(0.0, &motions, &shapes)?;
        }
        y0.resize(y0.len() + QUADRATURES, 0.0);
        self.state.air = (self.stages[0].equations).initial_air(&y0, &mut self.scratch)?;
        if let Some(air) = air {
            self.state.air = Some(air.clone().restarted());
        }
        let report = self.enter_stage(y0)?;
        self.state.ledger = Ledger::open(&self.scratch);
        self.finish_arrival(report, true)
    }

    /// One of the three starting steps, already known: evaluates it again in its place.
    fn replay_start(&mut self) -> Result<StepReport, FlightError> {
        let (t, k) = (self.time(self.state.step), self.newest());
        let equations = &self.stages[self.state.stage].equations;
        let mut dy = vec![0.0; equations.dim()];
        let y = &self.state.past.y[k];
        equations.evaluate(t, y, self.state.memory(), &mut self.scratch, &mut dy)?;
        if equations.begins_with_jump() || equations.elastic.damping_on_joints().is_some() {
            // Bodies accelerate as wings bend, and wings bend as they accelerate: the step before does not tell.
            let scales = equations.scales();
            let convergence = convergence(&self.setup.corrector, equations);
            for _ in 0..convergence.max_passes {
                let before = dy.clone();
                equations.evaluate(t, y, self.state.memory(), &mut self.scratch, &mut dy)?;
                let change = scaled_difference(&before, &dy, &scales);
                if self.setup.time.step * change <= convergence.tolerance {
                    break;
                }
            }
        }
        Ok(self.state.start_report)
    }

    /// One step of the integrator; Hamming's corrects in the frozen wake.
    fn predict_and_correct(&mut self) -> Result<StepReport, FlightError> {
        let (before, t) = (self.time(self.state.step - 1), self.time(self.state.step));
        let equations = &self.stages[self.state.stage].equations;
        let scratch = &mut self.scratch;
        let memory = Memory {
            air: self.state.air.as_ref(),
            wings: &self.state.wings,
            carried: &self.state.carried,
        };
        let past = &mut self.state.past;
        self.solver
            .advance((before, t), past, equations, memory, scratch)
            .map_err(|e| failure(e, self.state.step, t, &self.setup))
    }

    /// Makes `y0` the state at the present step in the equations of the present stage, and says what passes that took
    /// beside the evaluation.
    fn enter_stage(&mut self, y0: Vec<f64>) -> Result<StepReport, FlightError> {
        let t = self.time(self.state.step);
        let equations = &self.stages[self.state.stage].equations;
        self.scratch.fit(equations);
        let mut f0 = vec![0.0; y0.len()];
        for _ in 0..equations.entries() {
            equations.evaluate(t, &y0, self.state.memory(), &mut self.scratch, &mut f0)?;
        }
        let convergence = convergence(&self.setup.corrector, equations);
        let memory = self.state.memory();
        let report = equations
            .couple_at_start((t, &y0), memory, &convergence, &mut self.scratch, &mut f0)
            .map_err(|e| failure(e, self.state.step, t, &self.setup))?;
        self.solver = self.new_solver();
        self.state.started_at = self.state.step;
        self.state.past = Multistep::from_start(
            std::array::from_fn(|_| y0.clone()),
            std::array::from_fn(|_| f0.clone()),
        );
        Ok(report)
    }

    /// Starting values of the order of the method: bodies and air replayed over three steps until
    /// they agree. The state of the air stays where it is.
    fn start(&mut self) -> Result<(), FlightError> {
        let equations = &self.stages[self.state.stage].equations;
        let (h, first, state) = (self.setup.time.step, self.state.step, &mut self.state);
        let mut start = StartingSteps {
            equations,
            scratch: Scratch::new(equations),
            first,
            at_start: &state.air,
            air: None,
            wings_at_start: &state.wings,
            wings: vec![],
            carried_at_start: &state.carried,
            carried: vec![],
        };
        let (y0, f0) = (&state.past.y[0], &state.past.f[0]);
        let convergence = convergence(&self.setup.corrector, equations);
        let scales = equations.scales();
        // Rates at the start lack the added mass of the body, and sweeps over the block would lead away.
        let is_light = self.setup.integrator == IntegratorChoice::Bdf
            && self.setup.mass_over_carried_fluid().is_some();
        let rho = equations.elastic.damping_on_joints();
        let weights = rho.map(order_two_start);
        let started = match weights.or(is_light.then_some(BACKWARD_START)) {
            Some(weights) => {
                let (from, how) = ((&y0[..], &f0[..]), (convergence, &scales[..]));
                stepwise_start(from, h, &weights, how, &mut start)
            }
            None => block_start(y0, f0, h, convergence, &scales, &mut start),
        };
        let (past, report) = started.map_err(|e| {
            // Where the motion has come to, for what is said of its end.
            self.scratch.motions.clone_from(&start.scratch.motions);
            failure(e, first + 1, start.time(1), &self.setup)
        })?;
        (state.past, state.start_report) = (past, report);
        Ok(())
    }
}

/// Elastic wings at the start of a flight, whose books begin there.
fn without_dissipated_energy(wings: &[ElasticState]) -> Vec<ElasticState> {
    let mut wings = wings.to_vec();
    (wings.iter_mut()).for_each(|w| w.structure.dissipated = 0.0);
    wings
}

/// The error of a failed step.
fn failure(e: StepError<FlightError>, step: usize, time: f64, setup: &FlightSetup) -> FlightError {
    let settings = &setup.corrector;
    match e {
        StepError::Rates(e) => e,
        StepError::NotConverged(StepReport { passes, residual }) => FlightError::NotConverged {
            step,
            time,
            passes,
            residual,
            tolerance: settings.tolerance,
            relaxation: settings.relaxation,
            in_air: !matches!(setup.air, AirModel::None),
            light_by_hamming: setup.integrator == IntegratorChoice::Hamming
                && setup.light_beside_fluid().is_some(),
            elastic: setup.animal.is_elastic(),
        },
    }
}
