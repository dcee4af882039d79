//! The coupled right-hand side: state -> body motions -> lattice nodes -> air loads -> wrenches
//! -> rates (seed sec. 4 and 5). Quadratures of work and impulse ride along, so that balances
//! are integrated exactly as accurately as the motion itself.

mod first;
pub(crate) mod free;
mod loads;
pub(crate) mod mirrored;
pub(crate) mod quadratures;
pub(crate) mod solver;
pub(crate) mod stages;
pub(crate) mod tethered;
pub(crate) mod towed;

use std::sync::Arc;

use wingbeat_dynamics::{
    AbsoluteForm, AddedMass, BodyMotion, Formulation, Mechanism, Solution, Stabilization,
    Workspace, Wrench, mass_centre, relative_energy,
};

use crate::air::dynamic_pressure::DynamicPressure;
use crate::air::{Air, AirScratch, Instant};
use crate::carried::{CarriedAir, CarriedScratch, CarriedState};
use crate::elastic::{ElasticScratch, ElasticState, ElasticWings};
use crate::equations::mirrored::Mirrored;
use crate::equations::quadratures::{QUADRATURES, Quadratures, WORKS};
use crate::equations::towed::Towed;
use crate::error::FlightError;
use crate::interface::memory::AirMemory;
use crate::setup::applied::{AppliedLoad, PointSpring};

/// What a flight remembers beside its state vector, frozen within a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Memory<'a> {
    /// The air.
    pub air: Option<&'a AirMemory>,
    /// The elastic wings; empty where there are none.
    pub wings: &'a [ElasticState],
    /// The wings that carry air along (on free joints, or of a light flyer); empty where there are none.
    pub carried: &'a [CarriedState],
}

/// The model: everything constant that the right-hand side needs.
#[derive(Debug)]
pub struct Equations {
    /// The bodies: free or tethered.
    pub core: Box<dyn Formulation>,
    /// The air around them.
    pub air: Arc<dyn Air>,
    /// What it could do to the wings, for the coefficients of a record.
    pub pressure: Arc<DynamicPressure>,
    /// The wings that loads bend.
    pub elastic: Arc<ElasticWings>,
    /// The wings that carry air along: on free joints, or all of a light flyer.
    pub carried: CarriedAir,
    /// All joints, for their coordinates.
    pub mechanism: Mechanism,
    /// Extra loads.
    pub applied: Vec<AppliedLoad>,
    /// Springs between points.
    pub springs: Vec<PointSpring>,
    /// The mirror that the motion keeps to, where one half of the air is computed and wings hang on free
    /// joints, or the flyer is light as a whole.
    pub mirror: Option<Mirrored>,
    /// Time step h [s].
    pub step: f64,
    /// Pass of a step from which those before speed the next ones up; none for plain passes.
    pub accelerated_from: Option<usize>,
    /// Whether a tether moves the root from the first to the last step.
    pub is_tethered: bool,
}

/// Intermediate results of one evaluation, kept between calls. After
/// [`Equations::evaluate`] they belong to the state last evaluated.
pub struct Scratch {
    /// Motions of the bodies.
    pub motions: Vec<BodyMotion>,
    /// Air load per body about its origin.
    pub air: Vec<Wrench>,
    /// Applied load per body about its origin.
    pub applied: Vec<Wrench>,
    /// What elastic wings do to their bodies otherwise than rigid ones; empty where there are none.
    elastic_loads: Vec<Wrench>,
    /// Sum of all, and of all but what elastic wings do.
    total: Vec<Wrench>,
    external: Vec<Wrench>,
    /// Masses carried along, and the time that they belong to.
    added: Vec<AddedMass>,
    added_at: Option<f64>,
    /// The same with those of elastic wings.
    carried: Vec<AddedMass>,
    /// Air that wings carry along.
    carried_air: CarriedScratch,
    /// What wings on free joints feel of each other's added mass at the first instant; empty at any other.
    coupling: Vec<Wrench>,
    /// Accelerations, reactions, energies.
    pub solution: Solution,
    /// Kinetic energy relative to the root [J] and its rate [W].
    pub relative: [f64; 2],
    /// The root by itself, where a tether moves it.
    pub towed: Towed,
    /// Power of what deforms each body against the air [W]; empty where nothing is deformed.
    pub deformation: Vec<f64>,
    /// Coordinates along the free directions of all joints, with their rates [rad or m].
    joints: Vec<[f64; 2]>,
    /// Power that dampers and stops of joints take up [W].
    dissipation: f64,
    dynamics: Workspace,
    /// Rates before the mirror has taken anything from them.
    rates: Vec<f64>,
    /// Scratch of the air.
    pub air_scratch: AirScratch,
    /// Scratch of the elastic wings.
    pub elastic: ElasticScratch,
}

impl Scratch {
    /// Room for the evaluations of `equations`.
    pub fn new(equations: &Equations) -> Self {
        let system = equations.core.system();
        let bodies = system.bodies().len();
        let none = vec![Wrench::default(); bodies];
        Self {
            motions: vec![BodyMotion::REST; bodies],
            air: none.clone(),
            applied: none.clone(),
            elastic_loads: match equations.elastic.is_empty() {
                true => vec![],
                false => none.clone(),
            },
            external: none.clone(),
            total: none,
            added: vec![],
            added_at: None,
            carried: vec![],
            carried_air: CarriedScratch::default(),
            coupling: vec![],
            solution: Solution::new(system),
            relative: [0.0; 2],
            towed: Towed::default(),
            deformation: vec![0.0; if equations.air.deforms() { bodies } else { 0 }],
            joints: vec![],
            dissipation: 0.0,
            dynamics: equations.core.workspace(),
            rates: vec![],
            air_scratch: equations.air.scratch(),
            elastic: equations.elastic.scratch(&equations.elastic.initial()),
        }
    }

    /// Forgets what it knows of the last evaluation: the same times and states may mean something else from now on.
    pub fn forget(&mut self) {
        self.dynamics.forget();
        self.added_at = None;
        self.carried_air.forget();
    }

    /// Makes room for the dynamics of other equations of the same bodies.
    pub fn fit(&mut self, equations: &Equations) {
        self.dynamics = equations.core.workspace();
        self.added_at = None;
        self.carried_air.forget();
    }

    /// Air and applied loads together.
    fn sum_loads(&mut self) {
        for ((sum, a), b) in self.total.iter_mut().zip(&self.air).zip(&self.applied) {
            *sum = *a;
            *sum += *b;
        }
        for (sum, c) in self.total.iter_mut().zip(&self.elastic_loads) {
            *sum += *c;
        }
    }
}

impl Equations {
    /// Motion of the root in the state `y` of the core at time `t` [s].
    ///
    /// # Errors
    /// Singular attitude, numbers that are not finite.
    pub fn root(&self, t: f64, y: &[f64], s: &mut Scratch) -> Result<BodyMotion, FlightError> {
        let moved = self.core.motions(t, y, &mut s.dynamics, &mut s.motions);
        Ok(moved.map(|()| s.motions[0])?)
    }

    /// Length of the state vector: core and quadratures.
    pub fn dim(&self) -> usize {
        self.core.dim() + QUADRATURES
    }

    /// Natural sizes of the state components; infinite for the quadratures, which follow the
    /// motion and do not decide on convergence.
    pub fn scales(&self) -> Vec<f64> {
        let mut s = self.core.scales();
        s.resize(self.dim(), f64::INFINITY);
        s
    }

    /// Rates of the state `y` at time `t` [s] with the frozen `memory`; leaves all
    /// intermediate results in `s`.
    ///
    /// # Errors
    /// What the dynamics or the air report: singular attitude, singular influence matrix,
    /// numbers that are not finite.
    pub fn evaluate(
        &self,
        t: f64,
        y: &[f64],
        memory: Memory<'_>,
        s: &mut Scratch,
        dy: &mut [f64],
    ) -> Result<(), FlightError> {
        let n = self.core.dim();
        self.loaded_rates(t, y, memory, s, dy)?;
        self.follow_shapes(t, &y[..n], s)?;
        self.core
            .solve(t, &y[..n], &s.total, &mut s.dynamics, &mut s.solution)?;
        self.correct_budget(s);
        s.relative = match self.elastic.are_passive() {
            true => [0.0; 2],
            false => relative_energy(self.core.system(), &s.motions, &s.solution.bodies),
        };
        if self.is_tethered {
            s.towed = Towed::at(self.core.system(), &s.motions, &s.solution.bodies);
        }
        self.deformation_power(t, s);
        self.dissipation(t, s);
        self.quadrature_rates(s).write(dy);
        Ok(())
    }

    /// How often a state from which a stage begins is evaluated: loads on elastic wings that follow
    /// accelerations need to know these, each time better.
    pub fn entries(&self) -> usize {
        match !self.elastic.is_empty() && self.air.follows_accelerations() {
            true => 4,
            false => 1,
        }
    }

    /// Whether accelerations of elastic wings may jump where the stage begins: not where that of the body is integrated
    /// itself, from that of rigid wings.
    pub fn begins_with_jump(&self) -> bool {
        !self.elastic.is_empty() && (self.core.takes_shapes() || self.core.is_supported())
    }

    /// Components of the state that nothing depends on and that a [`Self::pass`] leaves out.
    pub fn followers(&self) -> Vec<usize> {
        let works = if self.core.is_supported() {
            &[][..]
        } else {
            &WORKS
        };
        works.iter().map(|k| self.core.dim() + k).collect()
    }

    /// Rates of the state `y` without those of the [`Self::followers`].
    ///
    /// # Errors
    /// As [`Self::evaluate`].
    pub fn pass(
        &self,
        t: f64,
        y: &[f64],
        memory: Memory<'_>,
        s: &mut Scratch,
        dy: &mut [f64],
    ) -> Result<(), FlightError> {
        if self.core.is_supported() || !self.elastic.is_empty() {
            return self.evaluate(t, y, memory, s, dy); // impulses ask for the force of the support
        }
        self.loaded_rates(t, y, memory, s, dy)?;
        let centre = mass_centre(self.core.system(), &s.motions);
        let [impulse, angular_impulse] = self.external(s, centre, &Wrench::default());
        let quadratures = Quadratures {
            impulse,
            angular_impulse,
            ..Quadratures::default()
        };
        quadratures.write(dy);
        Ok(())
    }

    /// Rates of the core's part of the state `y` under all loads, which stay in `s`.
    fn loaded_rates(
        &self,
        t: f64,
        y: &[f64],
        memory: Memory<'_>,
        s: &mut Scratch,
        dy: &mut [f64],
    ) -> Result<(), FlightError> {
        let n = self.core.dim();
        self.loads(t, &y[..n], memory, s)?;
        let loads = match self.core.takes_shapes() && !self.elastic.is_empty() {
            true => {
                s.external.clone_from(&s.air);
                let both = s.external.iter_mut().zip(&s.applied);
                both.for_each(|(sum, applied)| *sum += *applied);
                &s.external
            }
            false => &s.total,
        };
        (self.core).rates(t, &y[..n], loads, &mut s.dynamics, &mut dy[..n])?;
        self.symmetrise((t, &y[..n]), s, &mut dy[..n])
    }

    fn symmetrise(
        &self,
        at: (f64, &[f64]),
        s: &mut Scratch,
        dy: &mut [f64],
    ) -> Result<(), FlightError> {
        let mirror = self.mirror.as_ref();
        mirror.map_or(Ok(()), |m| m.keep(self.core.as_ref(), at, dy, &mut s.rates))
    }

    /// Rates of the core's state `y` alone, without records and quadratures.
    ///
    /// # Errors
    /// As [`Self::evaluate`].
    pub fn rates(
        &self,
        t: f64,
        y: &[f64],
        memory: Memory<'_>,
        s: &mut Scratch,
        dy: &mut [f64],
    ) -> Result<(), FlightError> {
        self.known_loads(t, y, memory, s)?;
        let (ws, out) = (&mut s.dynamics, &mut s.solution);
        match s.added.is_empty() {
            true => (self.core).rates(t, y, &s.total, ws, dy)?,
            false => (self.core).rates_with((t, y), &s.added, &mut s.total, ws, out, dy)?,
        }
        self.symmetrise((t, y), s, dy)
    }

    /// Puts the state at time `t` [s] back onto what it must fulfil.
    ///
    /// # Errors
    /// The projection fails.
    pub fn normalise(&self, t: f64, y: &mut [f64], s: &mut Scratch) -> Result<(), FlightError> {
        let n = self.core.dim();
        Ok(self.core.normalise(t, &mut y[..n], &mut s.dynamics)?)
    }

    /// Names of joints that close loops and nearly ask for the same thing twice in the state `y` at
    /// time `t` [s]; none if the state has no such.
    pub fn nearly_redundant_joints(&self, t: f64, y: &[f64], s: &mut Scratch) -> Option<String> {
        let y = &y[..self.core.dim()];
        let moved = self.core.motions(t, y, &mut s.dynamics, &mut s.motions);
        let form = AbsoluteForm::new(self.mechanism.clone(), Stabilization::None);
        moved
            .ok()
            .and_then(|()| form.nearly_redundant(t, &s.motions))
    }

    /// Positions and velocities of the lattice nodes in the state `y` at time `t` [s].
    ///
    /// # Errors
    /// The state is singular; joined roots are too far apart.
    pub fn place_nodes(&self, t: f64, y: &[f64], s: &mut Scratch) -> Result<(), FlightError> {
        let n = self.core.dim();
        self.core
            .motions(t, &y[..n], &mut s.dynamics, &mut s.motions)?;
        let at = Instant {
            shapes: s.elastic.shapes(),
            ..Instant::rigid(t, self.step, &s.motions)
        };
        self.air.place(&at, &mut s.air_scratch)
    }

    /// The air around the bodies in the state `y0` at time zero: no wake yet.
    ///
    /// # Errors
    /// The state is singular.
    pub fn initial_air(
        &self,
        y0: &[f64],
        s: &mut Scratch,
    ) -> Result<Option<AirMemory>, FlightError> {
        self.place_nodes(0.0, y0, s)?;
        Ok(self.air.initial(&s.air_scratch))
    }

    /// Begins a step: elastic wings have no passes yet, and the wake of an accepted `air` moves on by it.
    ///
    /// # Errors
    /// Velocities that are not finite.
    pub fn advance_air(
        &self,
        air: &mut Option<AirMemory>,
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        s.elastic.begin_step();
        (self.air).advance(air, self.step, &mut s.air_scratch)
    }

    /// Accepts circulations and shapes of the state last evaluated.
    ///
    /// # Errors
    /// The wake has not been moved.
    pub fn accept(
        &self,
        air: &mut Option<AirMemory>,
        (wings, carried): (&mut [ElasticState], &mut [CarriedState]),
        s: &Scratch,
    ) -> Result<(), FlightError> {
        (self.carried).accept(&s.motions, &s.carried_air, carried);
        (self.elastic).accept(&s.solution.bodies, &s.elastic, wings);
        self.air.accept(air, &s.air_scratch)
    }
}
