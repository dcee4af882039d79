//! Which equations are integrated, how, and in which steps.

/// Which equations of motion are integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FormulationChoice {
    /// Momentum form: mass centre, quaternion, linear and angular momentum (default).
    Momentum,
    /// The seed's Euler coordinates with multipliers and Baumgarte stabilisation.
    Euler(BaumgarteChoice),
    /// Positions and quaternions of all bodies with multipliers: loops, free joints, singular
    /// nowhere.
    Quaternion(StabilizationChoice),
}

/// How the constraints of the quaternion form are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StabilizationChoice {
    /// Not at all.
    None,
    /// By feedback.
    Baumgarte(BaumgarteChoice),
    /// By projection of positions and velocities after every step; one-step integrators only.
    Projection,
}

/// The time integrator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IntegratorChoice {
    /// Hamming's modified predictor-corrector, order four: carries a wake along where the air that
    /// moves with the wings weighs less than a third of what carries it.
    Hamming,
    /// Backward differences of order four: carries a wake along whatever the air weighs. Where elastic wings
    /// hang on free joints, a formula of order two that damps the fastest vibrations as their structures do.
    Bdf,
    /// Adams-Bashforth-Moulton, order four.
    Adams,
    /// Runge-Kutta, order four.
    RungeKutta,
    /// Dormand and Prince's method of order eight, steps inside the time grid chosen by its error
    /// estimate.
    OrderEight {
        /// Error allowed per step, relative to the natural size of each component [1].
        tolerance: f64,
    },
}

impl IntegratorChoice {
    /// Name, that of case files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Hamming => "hamming",
            Self::Bdf => "bdf",
            Self::Adams => "adams",
            Self::RungeKutta => "runge_kutta",
            Self::OrderEight { .. } => "order_eight",
        }
    }

    /// Whether the method evaluates loads at the ends of steps only, as a wake demands, which is
    /// moved once a step.
    pub fn carries_wake(&self) -> bool {
        matches!(self, Self::Hamming | Self::Bdf)
    }

    /// Whether the method needs nothing but the present state.
    pub fn is_one_step(&self) -> bool {
        matches!(self, Self::RungeKutta | Self::OrderEight { .. })
    }
}

/// Constants of Baumgarte's stabilisation (seed eq. 29).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BaumgarteChoice {
    /// alpha = beta = `a / h` with the step h.
    StepTied(f64),
    /// alpha and beta given [1/s]; zero for both reproduces seed eq. 28.
    Fixed {
        /// Damping constant alpha [1/s].
        alpha: f64,
        /// Stiffness constant beta [1/s].
        beta: f64,
    },
}

/// Equal time steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeGrid {
    /// Step h [s].
    pub step: f64,
    /// Number of steps.
    pub steps: usize,
    /// Period of one wingbeat [s], for cycle means; `None` for motions without one.
    pub period: Option<f64>,
}

impl TimeGrid {
    /// Steps of a wingbeat, the nearest whole number; none of motions without one.
    pub fn steps_per_beat(&self) -> Option<usize> {
        let steps = (self.period? / self.step).round() as usize;
        (steps > 0).then_some(steps)
    }

    /// Instants at which one looks at a prescribed motion \[s\]: the first `most` steps, and where there are
    /// more, as many again over the rest of the flight.
    ///
    /// ```
    /// let grid = |steps| wingbeat_flight::TimeGrid { step: 0.5, steps, period: None };
    /// assert_eq!(grid(3).instants(10).collect::<Vec<_>>(), [0.0, 0.5, 1.0, 1.5]);
    /// assert!(grid(1_000_000_000).instants(10).count() <= 21);
    /// ```
    pub fn instants(&self, most: usize) -> impl Iterator<Item = f64> + use<> {
        let (steps, step, most) = (self.steps, self.step, most.max(1));
        let stride = steps.saturating_sub(most).div_ceil(most).max(1);
        let later = (most..=steps).skip(1).step_by(stride);
        (0..=steps.min(most))
            .chain(later)
            .map(move |k| k as f64 * step)
    }

    /// How many looks at equal distances, and their distance \[s\], show a prescribed motion: each step of a
    /// flight that has no more than `most`; of longer ones with wingbeats about a hundred of each beat, as many
    /// beats as fit, of others the whole flight.
    pub fn looks(&self, most: usize) -> (usize, f64) {
        let whole = self.steps.div_ceil(most.max(1)).max(1);
        let of_beat = self.steps_per_beat().map(|n| (n / LOOKS_OF_BEAT).max(1));
        let stride = of_beat.map_or(whole, |n| n.min(whole));
        ((self.steps / stride).min(most), stride as f64 * self.step)
    }
}

/// Looks at a wingbeat in long flights, at least.
const LOOKS_OF_BEAT: usize = 100;

/// Looks at a prescribed motion in a flight, at most: what only looks takes no longer where a flight has more
/// steps.
pub const LOOKS: usize = 2000;

/// When the corrector of one step has converged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CorrectorSettings {
    /// Largest scaled change between two passes that counts as converged [1].
    pub tolerance: f64,
    /// Most passes before the step is given up with an error.
    pub max_passes: usize,
    /// Relaxation factor of a pass \[1\], above 0 and up to 1; 1 is the plain iteration.
    pub relaxation: f64,
}

impl Default for CorrectorSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            max_passes: 60,
            relaxation: 1.0,
        }
    }
}
