//! The first instant of wings on free joints: the loads hold no differences over steps yet, and so nothing of what the
//! wings, and other surfaces, do to each other's added mass. The lattice's answer to the accelerations has it; passes
//! bring both to agree, as within a step. What velocities do to it as surfaces move past each other comes with the
//! first step.

use wingbeat_dynamics::Wrench;
use wingbeat_math::ode::{Convergence, StepError, StepReport, scaled_difference};
use wingbeat_math::{DVec3, Secants};

use super::{Equations, Memory, Scratch};
use crate::error::FlightError;
use crate::interface::Instant;

impl Equations {
    /// Makes the rates `dy` of the state `y` at time `t` \[s\], which were asked for last, those in which accelerations
    /// and what surfaces do to each other's added mass agree. No passes where there is nothing of the kind.
    ///
    /// # Errors
    /// As [`Self::evaluate`]; passes that do not converge.
    pub fn couple_at_start(
        &self,
        (t, y): (f64, &[f64]),
        memory: Memory<'_>,
        convergence: &Convergence,
        s: &mut Scratch,
        dy: &mut [f64],
    ) -> Result<StepReport, StepError<FlightError>> {
        let mut report = StepReport::default();
        let (mut secants, scales) = (Secants::default(), self.scales());
        let mut units = None;
        while let Some(felt) = self.coupling(t, memory, s).map_err(StepError::Rates)? {
            let units = *units.get_or_insert_with(|| sizes(&felt));
            s.coupling.resize(felt.len(), Wrench::default());
            let mut change = numbers(&felt, &s.coupling, units);
            secants.accelerate(&mut change);
            for (load, by) in s.coupling.iter_mut().zip(change.chunks_exact(6)) {
                load.force += units[0] * DVec3::from_slice(&by[..3]);
                load.moment += units[1] * DVec3::from_slice(&by[3..]);
            }
            let before = dy.to_vec();
            self.evaluate(t, y, memory, s, dy)
                .map_err(StepError::Rates)?;
            report.passes += 1;
            report.residual = self.step * scaled_difference(&before, dy, &scales);
            if report.residual <= convergence.tolerance && report.passes == 1 {
                // It does not count: the instant is the same without it, to the bit.
                s.coupling.clear();
                self.evaluate(t, y, memory, s, dy)
                    .map_err(StepError::Rates)?;
                return Ok(StepReport::default());
            }
            if report.residual <= convergence.tolerance {
                break;
            }
            if report.passes == convergence.max_passes {
                match convergence.tolerance > 0.0 {
                    true => return Err(StepError::NotConverged(report)),
                    false => break,
                }
            }
        }
        s.coupling.clear();
        Ok(report)
    }

    /// What surfaces do to each other's added mass at the accelerations last found.
    fn coupling(
        &self,
        t: f64,
        memory: Memory<'_>,
        s: &Scratch,
    ) -> Result<Option<Vec<Wrench>>, FlightError> {
        if !self.elastic.is_empty() {
            return Ok(None);
        }
        let at = Instant {
            accelerations: &s.solution.bodies,
            ..Instant::rigid(t, self.step, &s.motions)
        };
        let mut out = vec![Wrench::default(); s.motions.len()];
        let (air, own) = (
            (self.air.as_ref(), memory.air),
            (&s.air_scratch, &s.carried_air),
        );
        let is_lacking = (self.carried).coupling_at_start(&at, air, own, &mut out)?;
        Ok(is_lacking.then_some(out))
    }
}

/// Largest force \[N\] and moment \[N m\]; 1 where there is none.
fn sizes(loads: &[Wrench]) -> [f64; 2] {
    let largest = |of: fn(&Wrench) -> DVec3| {
        let most = loads.iter().map(|w| of(w).length()).fold(0.0, f64::max);
        if most > 0.0 { most } else { 1.0 }
    };
    [largest(|w| w.force), largest(|w| w.moment)]
}

/// By how much loads are more than those before, in these units: six numbers for each body.
fn numbers(now: &[Wrench], before: &[Wrench], [force, moment]: [f64; 2]) -> Vec<f64> {
    let change = |(a, b): (&Wrench, &Wrench)| {
        let parts = [(a.force - b.force) / force, (a.moment - b.moment) / moment];
        parts.map(|v| v.to_array()).concat()
    };
    now.iter().zip(before).flat_map(change).collect()
}
