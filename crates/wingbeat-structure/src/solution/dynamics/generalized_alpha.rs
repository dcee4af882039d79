//! Generalized-alpha on the Lie group of the nodes [Bruls & Cardona, J. Comput. Nonlinear Dyn. 5:031002, 2010; Chung &
//! Hulbert, J. Appl. Mech. 60:371, 1993].
//!
//! `n = h v_n + h^2 ((1/2 - beta) a_n + beta a_{n+1})`, `q_{n+1} = q_n exp(n)`, `v_{n+1} = v_n + h ((1 - gamma)
//! a_n + gamma a_{n+1})`, `(1 - alpha_m) a_{n+1} + alpha_m a_n = (1 - alpha_f) v'_{n+1} + alpha_f v'_n`,
//! equilibrium at the new time. Second order; the highest frequencies lose `1 - rho` of their amplitude a step,
//! the low ones hardly any.

use wingbeat_math::{DQuat, DVec3};

use crate::error::StructureError;
use crate::nodes::block::pair;
use crate::nodes::configuration::{Configuration, NODE};
use crate::structure::Structure;

/// What is integrated in time. Enough, with the motion of the frame, to go on bit for bit.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct State {
    /// Places and attitudes.
    pub configuration: Configuration,
    /// Six numbers a node: velocity relative to W, W components [m/s]; angular velocity relative to W, node components
    /// [rad/s].
    pub velocity: Vec<f64>,
    /// Time derivatives of `velocity` [m/s2, rad/s2].
    pub acceleration: Vec<f64>,
    /// The method's own accelerations, a mean of `acceleration` over time [m/s2, rad/s2].
    pub algorithmic: Vec<f64>,
    /// Energy that damping has dissipated so far \[J\].
    pub dissipated: f64,
    /// Power that damping dissipates now \[W\].
    pub dissipation: f64,
}

impl State {
    /// At rest in a configuration.
    pub fn at_rest(configuration: Configuration) -> Self {
        let zero = vec![0.0; NODE * configuration.len()];
        Self {
            configuration,
            velocity: zero.clone(),
            acceleration: zero.clone(),
            algorithmic: zero,
            dissipated: 0.0,
            dissipation: 0.0,
        }
    }

    /// Whether nothing accelerates: the state is that of a start.
    pub fn is_fresh(&self) -> bool {
        let mut both = self.acceleration.iter().chain(&self.algorithmic);
        both.all(|a| *a == 0.0)
    }

    /// Makes this the state of a start: its accelerations are those of before, and jump.
    pub fn begin(&mut self) {
        self.acceleration.fill(0.0);
        self.algorithmic.fill(0.0);
    }
}

/// A state that a step may end in, while it is sought.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trial {
    /// Places and attitudes.
    pub configuration: Configuration,
    /// Velocities, as [`State::velocity`].
    pub velocity: Vec<f64>,
    /// Accelerations, as [`State::acceleration`].
    pub acceleration: Vec<f64>,
    pub(crate) algorithmic: Vec<f64>,
    /// Increment of the six numbers of each node over the step.
    pub(crate) increment: Vec<f64>,
    /// Where the step began.
    pub(crate) start: Configuration,
    weights: Weights,
}

/// What an increment of the six numbers of the nodes changes along with them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Weights {
    /// Step \[s\].
    pub step: f64,
    /// Change of velocity by change of increment [1/s]: gamma / (h beta).
    pub velocity: f64,
    /// Change of acceleration by change of increment [1/s2].
    pub acceleration: f64,
    /// Change of the method's own acceleration by change of increment [1/s2]: 1 / (h^2 beta).
    algorithmic: f64,
}

impl Trial {
    /// A trial that is a state, without a step.
    pub fn of(state: &State) -> Self {
        Self {
            configuration: state.configuration.clone(),
            velocity: state.velocity.clone(),
            acceleration: state.acceleration.clone(),
            algorithmic: state.algorithmic.clone(),
            increment: vec![0.0; state.velocity.len()],
            start: state.configuration.clone(),
            weights: Weights::default(),
        }
    }

    /// The step and how velocities and accelerations change with places in it.
    pub fn weights(&self) -> Weights {
        self.weights
    }

    /// Takes all increments back: places and attitudes are those at the start of the step, stresses in balance
    /// there. Thin bodies are sought from here: a motion carried on stretches what hardly stretches.
    pub fn take_back(&mut self) {
        for n in 0..self.configuration.len() {
            let back: [f64; NODE] = std::array::from_fn(|d| -self.increment[NODE * n + d]);
            self.change(n, &back);
        }
    }

    /// Changes the increments of the six numbers of node n by `change`, and all that follows from them.
    pub(crate) fn change(&mut self, n: usize, change: &[f64; NODE]) {
        let w = self.weights;
        for (k, d) in (NODE * n..).zip(change) {
            self.increment[k] += d;
            self.velocity[k] += w.velocity * d;
            self.acceleration[k] += w.acceleration * d;
            self.algorithmic[k] += w.algorithmic * d;
        }
        self.place(n);
    }

    /// Place and attitude of node n from its increment.
    fn place(&mut self, n: usize) {
        let [dx, turn] = pair(&self.increment, n);
        self.configuration.position[n] = self.start.position[n] + dx;
        let turned = self.start.rotation[n] * DQuat::from_scaled_axis(turn);
        self.configuration.rotation[n] = turned.normalize();
    }

    /// Rotation vector \[rad\] of node n over the step.
    pub(crate) fn turn(&self, n: usize) -> DVec3 {
        pair(&self.increment, n)[1]
    }
}

/// The method's parameters.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct GeneralizedAlpha {
    alpha_m: f64,
    alpha_f: f64,
    gamma: f64,
    beta: f64,
}

impl GeneralizedAlpha {
    /// From the part of its amplitude that a motion of the highest frequencies keeps in a step, `rho` \[1\]: 1
    /// keeps all energy, 0 damps within a step; 0.8 to 0.95 is usual.
    ///
    /// # Errors
    /// [`StructureError::Number`] if it is not in 0 to 1.
    pub fn new(rho: f64) -> Result<Self, StructureError> {
        if !(0.0..=1.0).contains(&rho) {
            return Err(StructureError::Number {
                what: "spectral radius of generalized-alpha at high frequencies",
                value: rho,
                allowed: "from 0 (damps at once) to 1 (keeps all energy)",
            });
        }
        let alpha_m = (2.0 * rho - 1.0) / (rho + 1.0);
        let alpha_f = rho / (rho + 1.0);
        let gamma = 0.5 - alpha_m + alpha_f;
        Ok(Self {
            alpha_m,
            alpha_f,
            gamma,
            beta: 0.25 * (gamma + 0.5) * (gamma + 0.5),
        })
    }

    /// A first step that needs no acceleration at its start: over the step it is that of the end. Places and velocities
    /// have errors of third and of second order, as a single step of a method of second order may.
    pub fn first() -> Self {
        Self {
            alpha_m: 0.0,
            alpha_f: 0.0,
            gamma: 1.0,
            beta: 0.5,
        }
    }

    /// Euler's backward method, which knows no acceleration at the start.
    pub fn euler() -> Self {
        Self {
            alpha_m: 0.0,
            alpha_f: 0.0,
            gamma: 1.0,
            beta: 1.0,
        }
    }

    fn weights(&self, h: f64) -> Weights {
        let algorithmic = 1.0 / (h * h * self.beta);
        Weights {
            step: h,
            velocity: self.gamma / (h * self.beta),
            acceleration: algorithmic * (1.0 - self.alpha_m) / (1.0 - self.alpha_f),
            algorithmic,
        }
    }

    /// First trial of a step h \[s\]: accelerations stay.
    pub fn predict(&self, structure: &Structure, state: &State, h: f64, trial: &mut Trial) {
        trial.weights = self.weights(h);
        trial.start.clone_from(&state.configuration);
        trial.configuration.clone_from(&state.configuration);
        trial.acceleration.clone_from(&state.acceleration);
        trial.velocity.clone_from(&state.velocity);
        trial.algorithmic.clone_from(&state.algorithmic);
        trial.increment.clear();
        trial.increment.resize(state.velocity.len(), 0.0);
        for &k in &structure.number {
            let (now, mean) = (state.acceleration[k], state.algorithmic[k]);
            let next = (now - self.alpha_m * mean) / (1.0 - self.alpha_m);
            trial.algorithmic[k] = next;
            trial.velocity[k] += h * ((1.0 - self.gamma) * mean + self.gamma * next);
            trial.increment[k] =
                h * state.velocity[k] + h * h * ((0.5 - self.beta) * mean + self.beta * next);
        }
        (0..structure.nodes()).for_each(|n| trial.place(n));
    }
}
