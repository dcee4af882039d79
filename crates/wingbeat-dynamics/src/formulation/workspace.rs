//! Scratch room of the equations of motion.

use wingbeat_math::{BodyAcceleration, BodyMotion, Wrench};

use crate::System;
use crate::configuration::{Composite, CompositeRates, Configuration};
use crate::formulation::euler::scratch::EulerScratch;
use crate::free::FreeScratch;
use crate::mechanism::form::AbsoluteScratch;
use crate::prescribed::{Carried, Turning};
use crate::response::Response;
use crate::system::shape::ShapeMass;

/// Intermediate results, kept between calls so that nothing is allocated. Holds no state: any
/// workspace of the same system serves any call of it.
#[derive(Clone, Debug)]
pub struct Workspace {
    pub(crate) configuration: Configuration,
    pub(crate) motions: Vec<BodyMotion>,
    pub(crate) bias_force: Vec<Wrench>,
    pub(crate) euler: EulerScratch,
    pub(crate) free: FreeScratch,
    pub(crate) bias: Vec<BodyAcceleration>,
    pub(crate) absolute: Option<AbsoluteScratch>,
    /// The whole of `configuration`, and its rates where no joint is free.
    pub(crate) whole: Composite,
    pub(crate) whole_rates: CompositeRates,
    /// The inverse of its inertia.
    pub(crate) turning: Turning,
    /// Added masses last met, where no joint is free.
    pub(crate) carried: Carried,
    /// Of added masses where joints are free, and in the other forms.
    pub(crate) response: Response,
    /// What bodies that change their shape do otherwise than rigid ones; the whole with that, and the inverse
    /// of its inertia.
    pub(crate) shapes: Vec<ShapeMass>,
    pub(crate) shaped: Composite,
    pub(crate) shaped_turning: Turning,
    /// Time of `configuration` and its whole, where nothing but time decides on them.
    pub(crate) prescribed: Option<f64>,
    /// Time and state that `motions` belong to, where no joint is free.
    pub(crate) unfolded: Option<(f64, [f64; MOMENTUM_STATE])>,
}

/// Length of the momentum form's state without free joints.
pub(crate) const MOMENTUM_STATE: usize = 13;

impl Workspace {
    /// Room for `system`.
    pub fn new(system: &System) -> Self {
        let bodies = system.bodies().len();
        Self {
            whole: Composite::default(),
            whole_rates: CompositeRates::default(),
            turning: Turning::default(),
            carried: Carried::default(),
            response: Response::default(),
            shapes: vec![],
            shaped: Composite::default(),
            shaped_turning: Turning::default(),
            configuration: Configuration::new(system),
            motions: vec![BodyMotion::REST; bodies],
            bias_force: vec![Wrench::default(); bodies],
            euler: EulerScratch::new(system),
            free: FreeScratch::new(system),
            bias: vec![BodyAcceleration::default(); bodies],
            absolute: None,
            prescribed: None,
            unfolded: None,
        }
    }

    /// Gives bodies other shapes.
    pub fn set_shapes(&mut self, shapes: impl Iterator<Item = ShapeMass>) {
        self.shapes.clear();
        self.shapes.extend(shapes);
        self.unfolded = None;
    }

    /// The whole that momenta belong to, and the inverse of its inertia.
    pub(crate) fn moving(&self) -> (&Composite, &Turning) {
        match self.shapes.is_empty() {
            true => (&self.whole, &self.turning),
            false => (&self.shaped, &self.shaped_turning),
        }
    }

    /// Forgets what it knows of the last evaluation.
    pub fn forget(&mut self) {
        (self.prescribed, self.unfolded, self.carried.at) = (None, None, None);
    }

    /// Whether `motions` are those of the state `y` at time `t` already.
    pub(crate) fn knows(&self, t: f64, y: &[f64]) -> bool {
        let same = |(at, state): &(f64, [f64; MOMENTUM_STATE])| *at == t && state.as_slice() == y;
        self.unfolded.as_ref().is_some_and(same)
    }

    /// Takes note that `motions` are those of the state `y` at time `t`.
    pub(crate) fn note(&mut self, t: f64, y: &[f64]) {
        let state = <[f64; MOMENTUM_STATE]>::try_from(y);
        self.unfolded = state.ok().map(|state| (t, state));
    }

    /// Motions of all bodies as last evaluated.
    pub fn motions(&self) -> &[BodyMotion] {
        &self.motions
    }
}
