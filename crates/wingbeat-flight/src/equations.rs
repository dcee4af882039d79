//! The coupled right-hand side: state -> body motions -> lattice nodes -> air loads -> wrenches
//! -> rates (seed sec. 4 and 5). Quadratures of work and impulse ride along, so that balances
//! are integrated exactly as accurately as the motion itself.

use std::sync::Arc;

use wingbeat_dynamics::budget::{mass_centre, relative_energy};
use wingbeat_dynamics::{
    AbsoluteForm, AddedMass, BodyMotion, Mechanism, Solution, Stabilization, Workspace, Wrench,
};
use wingbeat_math::DVec3;

use crate::air::{Air, AirScratch, Instant};
use crate::applied::{AppliedLoad, PointSpring};
use crate::carried::{CarriedAir, CarriedScratch, CarriedState};
use crate::core::Core;
use crate::elastic::{ElasticScratch, ElasticState, ElasticWings, Moment};
use crate::error::FlightError;
use crate::interface::Shape;
use crate::memory::AirMemory;
use crate::quadratures::{QUADRATURES, Quadratures, WORKS};

/// What a flight remembers beside its state vector, frozen within a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Memory<'a> {
    /// The air.
    pub air: Option<&'a AirMemory>,
    /// The elastic wings; empty where there are none.
    pub wings: &'a [ElasticState],
    /// The wings that carry air along on free joints; empty where there are none.
    pub carried: &'a [CarriedState],
}

/// The model: everything constant that the right-hand side needs.
#[derive(Debug)]
pub struct Equations {
    /// The bodies: free or tethered.
    pub core: Core,
    /// The air around them.
    pub air: Arc<dyn Air>,
    /// The wings that loads bend.
    pub elastic: Arc<ElasticWings>,
    /// The wings on free joints, which carry air along.
    pub carried: CarriedAir,
    /// All joints, for their coordinates.
    pub mechanism: Mechanism,
    /// Extra loads.
    pub applied: Vec<AppliedLoad>,
    /// Springs between points.
    pub springs: Vec<PointSpring>,
    /// Time step h [s].
    pub step: f64,
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
    /// Air that wings on free joints carry along.
    carried_air: CarriedScratch,
    /// Accelerations, reactions, energies.
    pub solution: Solution,
    /// Kinetic energy relative to the root [J] and its rate [W].
    pub relative: [f64; 2],
    /// Power of what deforms each body against the air [W]; empty where nothing is deformed.
    pub deformation: Vec<f64>,
    dynamics: Workspace,
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
            solution: Solution::new(system),
            relative: [0.0; 2],
            deformation: vec![0.0; if equations.air.deforms() { bodies } else { 0 }],
            dynamics: equations.core.workspace(),
            air_scratch: equations.air.scratch(),
            elastic: equations.elastic.scratch(&equations.elastic.initial()),
        }
    }
}

impl Scratch {
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
}

impl Scratch {
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

/// The bodies at an instant.
fn instant<'a>(
    time: f64,
    step: f64,
    motions: &'a [BodyMotion],
    shapes: &'a [Option<Shape>],
) -> Instant<'a> {
    Instant {
        time,
        step,
        motions,
        accelerations: &[],
        shapes,
    }
}

impl Equations {
    /// Motion of the root in the state `y` of the core at time `t` [s].
    ///
    /// # Errors
    /// Singular attitude, numbers that are not finite.
    pub fn root(&self, t: f64, y: &[f64], s: &mut Scratch) -> Result<BodyMotion, FlightError> {
        let moved = self.core.motions(t, y, &mut s.dynamics, &mut s.motions);
        moved.map(|()| s.motions[0])
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
        s.relative = relative_energy(self.core.system(), &s.motions, &s.solution.bodies);
        self.deformation_power(t, s);
        self.quadrature_rates(s).write(dy);
        Ok(())
    }

    /// How often a state from which a stage begins is evaluated: loads on elastic wings that follow accelerations need to know
    /// these, each time better.
    pub fn entries(&self) -> usize {
        match !self.elastic.is_empty() && self.air.follows_accelerations() {
            true => 4,
            false => 1,
        }
    }

    /// Components of the state that nothing depends on and that a [`Self::pass`] leaves out.
    pub fn followers(&self) -> Vec<usize> {
        let works = if self.core.is_held() { &[][..] } else { &WORKS };
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
        if self.core.is_held() || !self.elastic.is_empty() {
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
        (self.core).rates(t, &y[..n], loads, &mut s.dynamics, &mut dy[..n])
    }

    /// External force and its moment about the inertial origin, N components, with the mass centre at
    /// `centre` and the load `tether` of a support on the root.
    fn external(&self, s: &Scratch, centre: DVec3, tether: &Wrench) -> [DVec3; 2] {
        let system = self.core.system();
        let weight = system.total_mass() * system.gravity();
        let mut force = weight + tether.force;
        let mut moment = centre.cross(weight) + tether.moment + s.motions[0].p.cross(tether.force);
        for (k, (l, m)) in s.total.iter().zip(&s.motions).enumerate() {
            // What elastic wings do to their bodies is no external load.
            let l = s.elastic_loads.get(k).map_or(*l, |_| {
                let mut l = s.air[k];
                l += s.applied[k];
                l
            });
            force += l.force;
            moment += l.moment + m.p.cross(l.force);
        }
        [force, moment]
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
        (self.core).rates_with((t, y), &s.added, &mut s.total, ws, out, dy)
    }

    /// All loads on the bodies in the core's state `y` into `s.total`.
    fn loads(
        &self,
        t: f64,
        y: &[f64],
        memory: Memory<'_>,
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        self.known_loads(t, y, memory, s)?;
        if !self.elastic.is_empty() {
            return self.add_masses(t, y, s);
        }
        if !s.added.is_empty() {
            let (ws, out) = (&mut s.dynamics, &mut s.solution);
            (self.core).add_mass((t, y), &s.added, &mut s.total, ws, out)?;
            for ((air, total), applied) in s.air.iter_mut().zip(&s.total).zip(&s.applied) {
                *air = *total - *applied;
            }
            s.sum_loads();
        }
        Ok(())
    }

    /// Loads of the added masses of the air and of elastic wings, each to its own.
    fn add_masses(&self, t: f64, y: &[f64], s: &mut Scratch) -> Result<(), FlightError> {
        let at = Moment {
            time: t,
            step: self.step,
            motions: &s.motions,
            accelerations: &s.solution.bodies,
        };
        s.carried.clone_from(&s.added);
        let (loads, carried) = (&mut s.elastic_loads, &mut s.carried);
        self.elastic.add_mass(&at, &s.elastic, loads, carried);
        if s.carried.is_empty() {
            return Ok(());
        }
        s.sum_loads();
        let (ws, out) = (&mut s.dynamics, &mut s.solution);
        (self.core).add_mass((t, y), &s.carried, &mut s.total, ws, out)?;
        for (k, total) in s.total.iter().enumerate() {
            let own = match s.carried[s.added.len()..].iter().any(|a| a.body() == k) {
                true => [&mut s.elastic_loads[k], &mut s.air[k]],
                false => [&mut s.air[k], &mut s.elastic_loads[k]],
            };
            let [to, other] = own;
            *to = *total - *other - s.applied[k];
        }
        s.sum_loads();
        Ok(())
    }

    /// All loads but those of the added mass into `s.total`, the added mass into `s.added`.
    fn known_loads(
        &self,
        t: f64,
        y: &[f64],
        memory: Memory<'_>,
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        if self.elastic.is_empty() {
            self.place_nodes(t, y, s)?;
            self.applied_loads(t, s);
            let at = instant(t, self.step, &s.motions, &[]);
            (self.air).loads(&at, memory.air, &mut s.air_scratch, &mut s.air)?;
            let air = (self.air.as_ref(), memory.air);
            let scratch = (&s.air_scratch, &mut s.carried_air);
            (self.carried).take_out(&at, air, memory.carried, scratch, &mut s.air)?;
        } else {
            self.bend(t, y, memory, s)?;
        }
        if s.added_at != Some(t) {
            s.added.clear();
            self.air.added_mass(t, &mut s.added);
            s.added.extend(s.carried_air.masses());
            s.added_at = Some(t);
        }
        s.sum_loads();
        Ok(())
    }

    /// Shapes of the elastic wings and loads of the air that agree, in the core's state `y`.
    fn bend(
        &self,
        t: f64,
        y: &[f64],
        memory: Memory<'_>,
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        let n = self.core.dim();
        let known = &mut s.solution.bodies;
        (self.elastic).predict(self.step, memory.wings, &mut s.elastic, known);
        if self.core.takes_shapes() {
            let shapes = self.elastic.shape_masses(&s.elastic);
            s.dynamics.set_shapes(shapes);
        }
        self.core
            .motions(t, &y[..n], &mut s.dynamics, &mut s.motions)?;
        self.applied_loads(t, s);
        if self.core.prescribes_all() {
            let (ws, out) = (&mut s.dynamics, &mut s.solution);
            self.core.solve(t, &y[..n], &s.total, ws, out)?;
        }
        let at = Moment {
            time: t,
            step: self.step,
            motions: &s.motions,
            accelerations: &s.solution.bodies,
        };
        let air = (self.air.as_ref(), memory.air);
        let loads = (&mut s.air_scratch, &mut s.air[..]);
        (self.elastic).couple(&at, air, &mut s.elastic, loads)?;
        (self.elastic).wrenches(&s.motions, &s.elastic, &mut s.elastic_loads);
        Ok(())
    }

    /// Motions that have the momenta of the state with the shapes that have just been found.
    fn follow_shapes(&self, t: f64, y: &[f64], s: &mut Scratch) -> Result<(), FlightError> {
        if self.core.takes_shapes() && !self.elastic.is_empty() {
            let shapes = self.elastic.shape_masses(&s.elastic);
            s.dynamics.set_shapes(shapes);
            (self.core).motions(t, y, &mut s.dynamics, &mut s.motions)?;
        }
        Ok(())
    }

    /// Makes the budget that of the elastic wings.
    fn correct_budget(&self, s: &mut Scratch) {
        if !self.elastic.is_empty() {
            let mass = self.core.system().total_mass();
            let budget = &mut s.solution.budget;
            (self.elastic).correct_budget(&s.motions, &s.elastic, mass, budget);
        }
    }

    /// Puts the state at time `t` [s] back onto what it must fulfil.
    ///
    /// # Errors
    /// The projection fails.
    pub fn normalise(&self, t: f64, y: &mut [f64], s: &mut Scratch) -> Result<(), FlightError> {
        let n = self.core.dim();
        self.core.normalise(t, &mut y[..n], &mut s.dynamics)
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
        let at = instant(t, self.step, &s.motions, s.elastic.shapes());
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

    /// Moves the wake of an accepted `air` by one step.
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
        self.carried.accept(&s.motions, carried);
        (self.elastic).accept(&s.solution.bodies, &s.elastic, wings);
        self.air.accept(air, &s.air_scratch)
    }

    /// Wrenches of the applied loads and springs.
    fn applied_loads(&self, t: f64, s: &mut Scratch) {
        s.applied.fill(Wrench::default());
        for load in &self.applied {
            s.applied[load.body] += load.wrench(t, &s.motions[load.body]);
        }
        for spring in &self.springs {
            let wrenches = spring.wrenches(spring.bodies.map(|b| &s.motions[b]));
            for (body, wrench) in spring.bodies.into_iter().zip(wrenches) {
                s.applied[body] += wrench;
            }
        }
    }

    /// What deforming the wings takes at the state last evaluated.
    fn deformation_power(&self, t: f64, s: &mut Scratch) {
        if s.deformation.is_empty() {
            return;
        }
        let at = instant(t, self.step, &s.motions, s.elastic.shapes());
        let accelerations = &s.solution.bodies;
        (self.air).deformation_power(&at, accelerations, &s.air_scratch, &mut s.deformation);
    }

    /// Powers and external forces at the state last evaluated.
    fn quadrature_rates(&self, s: &Scratch) -> Quadratures {
        let power = |loads: &[Wrench]| -> f64 {
            loads.iter().zip(&s.motions).map(|(l, m)| l.power(m)).sum()
        };
        let tether = s.solution.tether;
        let [impulse, angular_impulse] = self.external(s, s.solution.budget.centre, &tether);
        let deformation: f64 = s.deformation.iter().sum();
        Quadratures {
            hinge_work: s.solution.hinge_power() - s.relative[1],
            air_work: power(&s.air) - deformation + self.elastic.air_power(&s.elastic),
            applied_work: power(&s.applied) + tether.power(&s.motions[0]),
            impulse,
            angular_impulse,
            deformation_work: deformation,
        }
    }
}
