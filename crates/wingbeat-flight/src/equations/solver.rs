//! The time integrators behind one face: a step of the coupled equations.

use wingbeat_math::ode::{
    AdamsBashforthMoulton, AdaptiveError, Asked, Bdf, Convergence, Dop853, Hamming, Multistep, Rk4,
    StepError, StepReport, Tolerance,
};

use crate::equations::{Equations, Memory, Scratch};
use crate::error::FlightError;
use crate::setup::{CorrectorSettings, IntegratorChoice};

/// Most steps inside one step of the time grid.
const MAX_SUBSTEPS: usize = 10_000;

/// An integrator with its scratch.
#[derive(Debug)]
pub enum Solver {
    /// Predictor-corrector with memory.
    Hamming(Hamming),
    /// Backward differences.
    Bdf(Bdf),
    /// Predictor-corrector with memory.
    Adams(AdamsBashforthMoulton),
    /// One step, order four.
    RungeKutta(Rk4, Buffers),
    /// Adaptive steps, order eight.
    OrderEight(Dop853, Buffers),
}

/// State and rates at the end of a step.
#[derive(Clone, Debug)]
pub struct Buffers {
    step: f64,
    y: Vec<f64>,
    f: Vec<f64>,
}

impl Buffers {
    fn new(equations: &Equations) -> Self {
        let zero = vec![0.0; equations.dim()];
        Self {
            step: equations.step,
            y: zero.clone(),
            f: zero,
        }
    }

    /// Projects the new state, evaluates it in its place and makes it the newest of the past.
    fn accept(
        &mut self,
        t: f64,
        past: &mut Multistep,
        (equations, memory): (&Equations, Memory<'_>),
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        equations.normalise(t, &mut self.y, s)?;
        equations.evaluate(t, &self.y, memory, s, &mut self.f)?;
        past.push(&self.y, &self.f);
        Ok(())
    }
}

impl Solver {
    /// The integrator of a stage.
    pub fn new(equations: &Equations, choice: IntegratorChoice, c: &CorrectorSettings) -> Self {
        let (step, scales) = (equations.step, equations.scales());
        match choice {
            IntegratorChoice::Hamming => {
                let method = Hamming::new(step, convergence(c, equations), scales);
                Self::Hamming(method.followed_by(equations.followers()))
            }
            IntegratorChoice::Bdf => {
                let method = Bdf::new(step, convergence(c, equations), scales);
                Self::Bdf(match equations.elastic.damping_on_joints() {
                    Some(rho) => method.order_two(rho),
                    None => method,
                })
            }
            IntegratorChoice::Adams => {
                Self::Adams(AdamsBashforthMoulton::new(step, equations.dim()))
            }
            IntegratorChoice::RungeKutta => {
                Self::RungeKutta(Rk4::new(equations.dim()), Buffers::new(equations))
            }
            IntegratorChoice::OrderEight { tolerance } => {
                let tolerance = Tolerance {
                    relative: tolerance,
                    absolute: tolerance,
                    max_steps: MAX_SUBSTEPS,
                };
                let method = Dop853::new(tolerance, scales).starting_with(1.0);
                Self::OrderEight(method, Buffers::new(equations))
            }
        }
    }

    /// One step from `t` to `end` [s] with the frozen `memory`: `past` moves on, and the newest state
    /// is the one last evaluated in `s`.
    ///
    /// # Errors
    /// The right-hand side fails, the corrector does not converge, or the steps become too small.
    pub fn advance(
        &mut self,
        (t, end): (f64, f64),
        past: &mut Multistep,
        equations: &Equations,
        memory: Memory<'_>,
        s: &mut Scratch,
    ) -> Result<StepReport, StepError<FlightError>> {
        let once = StepReport {
            passes: 1,
            residual: 0.0,
        };
        match self {
            Self::Hamming(method) => method.advance_asking(past, |asked, y, dy| match asked {
                Asked::Pass => equations.pass(end, y, memory, s, dy),
                Asked::Accepted => equations.evaluate(end, y, memory, s, dy),
            }),
            Self::Bdf(method) => {
                method.advance(past, |y, dy| equations.evaluate(end, y, memory, s, dy))
            }
            Self::Adams(method) => method
                .advance(past, |y, dy| equations.evaluate(end, y, memory, s, dy))
                .map(|()| once)
                .map_err(StepError::Rates),
            Self::RungeKutta(method, b) => {
                b.y.copy_from_slice(past.newest());
                method
                    .advance(t, b.step, &mut b.y, |t, y, dy| {
                        equations.evaluate(t, y, memory, s, dy)
                    })
                    .and_then(|()| b.accept(end, past, (equations, memory), s))
                    .map(|()| once)
                    .map_err(StepError::Rates)
            }
            Self::OrderEight(method, b) => {
                b.y.copy_from_slice(past.newest());
                let rates =
                    |t: f64, y: &[f64], dy: &mut [f64]| equations.evaluate(t, y, memory, s, dy);
                let report = method
                    .integrate((t, end), &mut b.y, rates)
                    .map_err(|e| StepError::Rates(adaptive(e, equations, &b.y, s)))?;
                b.accept(end, past, (equations, memory), s)
                    .map_err(StepError::Rates)?;
                Ok(StepReport {
                    passes: report.accepted + report.rejected,
                    residual: 0.0,
                })
            }
        }
    }
}

/// Why the adaptive method ended at the state `y`.
fn adaptive(
    e: AdaptiveError<FlightError>,
    equations: &Equations,
    y: &[f64],
    s: &mut Scratch,
) -> FlightError {
    let (time, otherwise) = match e {
        AdaptiveError::Rates(e) => return e,
        AdaptiveError::StepTooSmall { time, step } => {
            (time, FlightError::StepTooSmall { time, step })
        }
        AdaptiveError::TooManySteps { time } => {
            let most = MAX_SUBSTEPS;
            (time, FlightError::TooManySteps { time, most })
        }
    };
    let joints = equations.nearly_redundant_joints(time, y, s);
    joints.map_or(otherwise, |joints| FlightError::SingularPosition {
        time,
        joints,
    })
}

/// The corrector's settings in the integrator's words, for these equations.
pub fn convergence(c: &CorrectorSettings, equations: &Equations) -> Convergence {
    Convergence {
        tolerance: c.tolerance,
        max_passes: c.max_passes,
        relaxation: c.relaxation,
        accelerated_from: equations.accelerated_from,
    }
}
