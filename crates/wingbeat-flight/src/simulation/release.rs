//! From the stage in which the root is held into free flight.

use wingbeat_dynamics::BodyMotion;
use wingbeat_math::DVec3;
use wingbeat_math::ode::StepReport;

use crate::bodies::carry;
use crate::equations::quadratures::{QUADRATURES, Quadratures};
use crate::equations::towed::Towed;
use crate::error::FlightError;
use crate::setup::MotionMode;
use crate::simulation::Simulation;
use crate::simulation::recorder::Ledger;

impl Simulation {
    /// Goes over into the next stage where one starts, records, accepts, starts.
    pub(super) fn arrive(&mut self, report: StepReport) -> Result<(), FlightError> {
        let next = self.state.stage + 1;
        let enters = self
            .stages
            .get(next)
            .is_some_and(|s| s.from_step == self.state.step);
        if enters {
            let past = &self.state.past.y[self.newest()];
            let quadratures = Quadratures::from_state(past);
            let quadratures = self.without_support(quadratures);
            let (root, jumps) = self.released();
            let core = &self.stages[next].equations.core;
            let mut motions = self.scratch.motions.clone();
            carry(&mut motions, &root);
            let elastic = &self.stages[next].equations.elastic;
            let shapes: Vec<_> = elastic.shape_masses(&self.scratch.elastic).collect();
            let mut y0 = core.initial_shaped(self.time(self.state.step), &motions, &shapes)?;
            y0.resize(y0.len() + QUADRATURES, 0.0);
            quadratures.write(&mut y0);
            self.state.stage = next;
            let before = jumps.then(|| Ledger::open(&self.scratch));
            self.begin_wings();
            self.enter_stage(y0)?;
            if let Some(before) = before {
                let after = Ledger::open(&self.scratch);
                self.state.ledger.count_jump(&before, &after);
            }
        }
        self.finish_arrival(report, enters)
    }

    /// Works and impulses where a hold ends: from here on the root is one of the bodies that the quadratures
    /// are of, and what the support did to it alone, known in closed form, joins them.
    fn without_support(&mut self, quadratures: Quadratures) -> Quadratures {
        let (held, ledger) = (&mut self.scratch.towed, &mut self.state.ledger.towed);
        let (energy, momentum, spin) = held.gained(ledger);
        (*held, *ledger) = (Towed::default(), Towed::default());
        Quadratures {
            applied_work: quadratures.applied_work + energy,
            impulse: quadratures.impulse + momentum,
            impulse_of_works: quadratures.impulse_of_works + momentum,
            angular_impulse: quadratures.angular_impulse + spin,
            ..quadratures
        }
    }

    /// Elastic wings where a hold ends: they have the places and velocities of the last step, and their accelerations jump
    /// with what held the root. Those of the last step stay in the record of this instant.
    fn begin_wings(&mut self) {
        let equations = &self.stages[self.state.stage].equations;
        if !equations.begins_with_jump() {
            return;
        }
        let elastic = &equations.elastic;
        let (bodies, s) = (&self.scratch.solution.bodies, &mut self.scratch.elastic);
        elastic.accept(bodies, s, &mut self.state.wings);
        *s = elastic.scratch(&self.state.wings);
        let all = self.state.wings.iter_mut();
        all.for_each(|w| w.structure.begin());
    }

    /// How the root goes on when its hold ends, and whether with another velocity or attitude than it had.
    fn released(&mut self) -> (BodyMotion, bool) {
        let mut root = self.scratch.motions[0];
        let mut jumps = self.release.is_some();
        // As `StartState::released`; a root that is held still has no rounding of its support.
        if let MotionMode::Free(start) = &self.setup.mode {
            let swaying = start.held_motion.as_ref().map(|_| root.w);
            root.w = start.angular_velocity + swaying.unwrap_or_default();
            jumps |= start.angular_velocity != DVec3::ZERO;
        }
        (self.release.take().unwrap_or(root), jumps)
    }
}
