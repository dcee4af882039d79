//! The coupled right-hand side: state -> body motions -> lattice nodes -> air loads -> wrenches
//! -> rates (seed sec. 4 and 5). Quadratures of work and impulse ride along, so that balances
//! are integrated exactly as accurately as the motion itself.

use std::sync::Arc;

use wingbeat_air::{AirLoads, AirState, AirWorkspace, Lattice, NodeMotion};
use wingbeat_blade::DerivativeTable;
use wingbeat_dynamics::budget::relative_energy;
use wingbeat_dynamics::{BodyMotion, Mechanism, Solution, Workspace, Wrench};
use wingbeat_math::DVec3;

use crate::blade::{self, BladeSide};
use crate::core::Core;
use crate::error::FlightError;
use crate::external::Session;
use crate::setup::AppliedLoad;
use crate::surfaces::SurfaceMap;

/// Quadratures appended to the state of the core.
pub const QUADRATURES: usize = 10;

/// Works and impulses since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quadratures {
    /// Work of the hinges less the change of the energy relative to the root [J]. What wings on
    /// a fixed root would take up and give back is known in closed form and left out, so that
    /// the quadrature has only the rest to integrate.
    pub hinge_work: f64,
    /// Work of the air on the bodies [J], on their deformation too.
    pub air_work: f64,
    /// Work of applied loads and tether [J].
    pub applied_work: f64,
    /// Impulse of all external forces, weight included, N components [N s].
    pub impulse: DVec3,
    /// Impulse of all external moments about the inertial origin, N components [N m s].
    pub angular_impulse: DVec3,
    /// Work of what deforms the wings against the air [J].
    pub deformation_work: f64,
}

impl Quadratures {
    /// Reads the tail of a state vector.
    pub fn from_state(y: &[f64]) -> Self {
        let q = &y[y.len() - QUADRATURES..];
        Self {
            hinge_work: q[0],
            air_work: q[1],
            applied_work: q[2],
            impulse: DVec3::new(q[3], q[4], q[5]),
            angular_impulse: DVec3::new(q[6], q[7], q[8]),
            deformation_work: q[9],
        }
    }

    /// Writes the tail of a state vector.
    fn write(&self, y: &mut [f64]) {
        let n = y.len() - QUADRATURES;
        let (f, m) = (self.impulse, self.angular_impulse);
        y[n..].copy_from_slice(&[
            self.hinge_work,
            self.air_work,
            self.applied_work,
            f.x,
            f.y,
            f.z,
            m.x,
            m.y,
            m.z,
            self.deformation_work,
        ]);
    }
}

/// The lattice and its map to the bodies.
#[derive(Debug)]
pub struct AirSide {
    /// The vortex lattice.
    pub lattice: Lattice,
    /// Which nodes and panels belong to which body.
    pub map: SurfaceMap,
}

/// The model: everything constant that the right-hand side needs.
#[derive(Debug)]
pub struct Equations {
    /// The bodies: free or tethered.
    pub core: Core,
    /// The vortex lattice, if that is the air.
    pub air: Option<Arc<AirSide>>,
    /// The blade elements, if they are.
    pub blade: Option<Arc<BladeSide>>,
    /// The stability derivatives, if they are.
    pub table: Option<DerivativeTable>,
    /// The air computed elsewhere, if that is it.
    pub external: Option<Session>,
    /// All joints, for their coordinates.
    pub mechanism: Mechanism,
    /// Extra loads.
    pub applied: Vec<AppliedLoad>,
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
    /// Sum of both.
    total: Vec<Wrench>,
    velocity_air: Vec<Wrench>,
    added: Vec<Wrench>,
    added_next: Vec<Wrench>,
    gap: Vec<f64>,
    /// Accelerations, reactions, energies.
    pub solution: Solution,
    /// Kinetic energy relative to the root [J] and its rate [W].
    pub relative: [f64; 2],
    /// Power of what deforms each body against the air [W]; empty where nothing is deformed.
    pub deformation: Vec<f64>,
    dynamics: Workspace,
    /// Lattice nodes.
    pub nodes: NodeMotion,
    /// Circulations, pressure jumps, panel forces.
    pub air_loads: AirLoads,
    /// Scratch of the lattice.
    pub air_workspace: AirWorkspace,
    nodes_done: NodeMotion,
    air_is_current: bool,
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
            total: none.clone(),
            velocity_air: none.clone(),
            added: none.clone(),
            added_next: none,
            gap: vec![0.0; 6 * bodies],
            solution: Solution::new(system),
            relative: [0.0; 2],
            deformation: vec![0.0; if equations.deforms() { bodies } else { 0 }],
            dynamics: equations.core.workspace(),
            nodes: NodeMotion::default(),
            air_loads: AirLoads::default(),
            air_workspace: equations
                .air
                .as_ref()
                .map_or_else(AirWorkspace::default, |a| a.lattice.workspace()),
            nodes_done: NodeMotion::default(),
            air_is_current: false,
        }
    }
}

impl Scratch {
    /// Makes room for the dynamics of other equations of the same bodies.
    pub fn fit(&mut self, equations: &Equations) {
        self.dynamics = equations.core.workspace();
    }
}

/// Most passes between added mass and accelerations.
const ADDED_MASS_PASSES: usize = 60;
/// Largest relative change of the loads that counts as agreement: a thousand roundings.
const ADDED_MASS_TOLERANCE: f64 = 1e-13;

impl Scratch {
    /// Air and applied loads together.
    fn sum_loads(&mut self) {
        for ((sum, a), b) in self.total.iter_mut().zip(&self.air).zip(&self.applied) {
            *sum = *a;
            *sum += *b;
        }
    }

    /// Aitken's relaxation factor from the gap `added_next - added` and that of the pass before;
    /// stores the gap. Forces and moments share one norm: moments of a wing are forces on a
    /// fixed length, and any norm gives a convergent rule.
    fn aitken(&mut self, pass: usize, before: f64) -> f64 {
        let (mut inner, mut square) = (0.0, 0.0);
        for (k, (a, b)) in self.added_next.iter().zip(&self.added).enumerate() {
            let gap = components(a, b);
            for (i, g) in gap.iter().enumerate() {
                let old = &mut self.gap[6 * k + i];
                let d = g - *old;
                inner += *old * d;
                square += d * d;
                *old = *g;
            }
        }
        if pass == 0 || square == 0.0 {
            return 1.0;
        }
        -before * inner / square
    }

    /// Moves the added-mass load towards its next value; the air load follows. Returns the change
    /// relative to the largest load.
    fn relax_added(&mut self, relaxation: f64) -> f64 {
        let (mut change, mut largest) = ([0.0_f64; 2], [0.0_f64; 2]);
        for k in 0..self.added.len() {
            let (old, next) = (self.added[k], self.added_next[k]);
            let step = Wrench {
                force: relaxation * (next.force - old.force),
                moment: relaxation * (next.moment - old.moment),
            };
            self.added[k] += step;
            self.air[k] = self.velocity_air[k];
            self.air[k] += self.added[k];
            let air = &self.air[k];
            change = [
                change[0].max(step.force.length()),
                change[1].max(step.moment.length()),
            ];
            largest = [
                largest[0].max(air.force.length()),
                largest[1].max(air.moment.length()),
            ];
        }
        let relative = |i: usize| {
            if change[i] == 0.0 {
                0.0
            } else {
                change[i] / largest[i]
            }
        };
        relative(0).max(relative(1))
    }
}

/// The six components of the difference of two wrenches.
fn components(a: &Wrench, b: &Wrench) -> [f64; 6] {
    let (f, m) = (a.force - b.force, a.moment - b.moment);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}

impl Equations {
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

    /// Rates of the state `y` at time `t` [s] in the frozen wake of `air`; leaves all
    /// intermediate results in `s`.
    ///
    /// # Errors
    /// What the dynamics or the air report: singular attitude, singular influence matrix,
    /// numbers that are not finite.
    pub fn evaluate(
        &self,
        t: f64,
        y: &[f64],
        air: Option<&AirState>,
        s: &mut Scratch,
        dy: &mut [f64],
    ) -> Result<(), FlightError> {
        let n = self.core.dim();
        self.place_nodes(t, y, s)?;
        self.air_loads(t, air, s)?;
        self.applied_loads(t, s);
        if let Some(strips) = &self.blade {
            strips.velocity_loads(t, &s.motions, &mut s.air);
            self.add_mass(strips, t, &y[..n], s)?;
        }
        if let Some(table) = &self.table {
            s.air.fill(Wrench::default());
            s.air[0] = blade::turned(&table.load(&blade::frame(&s.motions[0])), &s.motions[0]);
        }
        if let Some(session) = &self.external {
            session.loads(t, self.step, &s.motions, &mut s.air)?;
        }
        s.sum_loads();
        self.core
            .rates(t, &y[..n], &s.total, &mut s.dynamics, &mut dy[..n])?;
        self.core
            .solve(t, &y[..n], &s.total, &mut s.dynamics, &mut s.solution)?;
        s.relative = relative_energy(self.core.system(), &s.motions, &s.solution.bodies);
        self.deformation_power(t, s);
        self.quadrature_rates(s).write(dy);
        Ok(())
    }

    /// Puts the state at time `t` [s] back onto what it must fulfil.
    ///
    /// # Errors
    /// The projection fails.
    pub fn normalise(&self, t: f64, y: &mut [f64], s: &mut Scratch) -> Result<(), FlightError> {
        let n = self.core.dim();
        self.core.normalise(t, &mut y[..n], &mut s.dynamics)
    }

    /// Adds the load of the added mass to `s.air`, which holds the load of the velocities. Both
    /// sides of `load -> acceleration -> load` are affine: fixed-point passes, accelerated by
    /// Aitken's rule for vectors [Irons & Tuck 1969], end at the exact solution.
    fn add_mass(
        &self,
        blade: &BladeSide,
        t: f64,
        y: &[f64],
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        s.velocity_air.copy_from_slice(&s.air);
        s.added.fill(Wrench::default());
        let mut relaxation = 1.0;
        let mut change = f64::INFINITY;
        for pass in 0..ADDED_MASS_PASSES {
            s.sum_loads();
            self.core
                .solve(t, y, &s.total, &mut s.dynamics, &mut s.solution)?;
            blade.acceleration_loads(t, &s.motions, &s.solution.bodies, &mut s.added_next);
            relaxation = s.aitken(pass, relaxation);
            change = s.relax_added(relaxation);
            if change <= ADDED_MASS_TOLERANCE {
                return Ok(());
            }
        }
        Err(FlightError::AddedMass {
            time: t,
            passes: ADDED_MASS_PASSES,
            change,
        })
    }

    /// Positions and velocities of the lattice nodes in the state `y` at time `t` [s].
    ///
    /// # Errors
    /// The state is singular; joined roots are too far apart.
    pub fn place_nodes(&self, t: f64, y: &[f64], s: &mut Scratch) -> Result<(), FlightError> {
        let n = self.core.dim();
        self.core
            .motions(t, &y[..n], &mut s.dynamics, &mut s.motions)?;
        if let Some(side) = &self.air {
            side.map.node_motion(t, &s.motions, &mut s.nodes)?;
        }
        Ok(())
    }

    /// Moves the wake of an accepted `air` by one step.
    ///
    /// # Errors
    /// Velocities that are not finite.
    pub fn advance_air(
        &self,
        air: &mut Option<AirState>,
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        if let (Some(side), Some(air)) = (&self.air, air) {
            side.lattice.convect(air, self.step, &mut s.air_workspace)?;
            s.air_is_current = false;
        }
        Ok(())
    }

    /// Accepts the circulations of the state last evaluated.
    ///
    /// # Errors
    /// The wake has not been moved.
    pub fn accept_air(&self, air: &mut Option<AirState>, s: &Scratch) -> Result<(), FlightError> {
        if let (Some(side), Some(air)) = (&self.air, air) {
            side.lattice.accept(air, &s.nodes, &s.air_loads)?;
        }
        if let Some(session) = &self.external {
            session.accept()?;
        }
        Ok(())
    }

    /// Loads of the air on the bodies in their present motion. Unchanged nodes in an unchanged
    /// wake keep their loads.
    fn air_loads(
        &self,
        t: f64,
        air: Option<&AirState>,
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        let (Some(side), Some(state)) = (&self.air, air) else {
            return Ok(());
        };
        if !(s.air_is_current && s.nodes == s.nodes_done) {
            side.lattice.loads(
                state,
                t,
                self.step,
                &s.nodes,
                &mut s.air_workspace,
                &mut s.air_loads,
            )?;
            s.nodes_done.clone_from(&s.nodes);
            s.air_is_current = true;
        }
        side.map.wrenches(&s.air_loads, &s.motions, &mut s.air);
        Ok(())
    }

    /// Wrenches of the applied loads.
    fn applied_loads(&self, t: f64, s: &mut Scratch) {
        s.applied.fill(Wrench::default());
        for load in &self.applied {
            s.applied[load.body] += load.wrench(t, &s.motions[load.body]);
        }
    }

    /// Whether any wing moves otherwise than its body.
    pub fn deforms(&self) -> bool {
        self.air.as_ref().is_some_and(|a| a.map.deforms())
            || self.blade.as_ref().is_some_and(|b| b.deforms())
    }

    /// What deforming the wings takes at the state last evaluated.
    fn deformation_power(&self, t: f64, s: &mut Scratch) {
        if s.deformation.is_empty() {
            return;
        }
        if let Some(side) = &self.air {
            (side.map).deformation_power(&s.air_loads, &s.nodes, &s.motions, &mut s.deformation);
        }
        if let Some(blade) = &self.blade {
            blade.deformation_power(t, &s.motions, &s.solution.bodies, &mut s.deformation);
        }
    }

    /// Powers and external forces at the state last evaluated.
    fn quadrature_rates(&self, s: &Scratch) -> Quadratures {
        let power = |loads: &[Wrench]| -> f64 {
            loads.iter().zip(&s.motions).map(|(l, m)| l.power(m)).sum()
        };
        let system = self.core.system();
        let weight = system.total_mass() * system.gravity();
        let tether = s.solution.tether;
        let mut impulse = weight + tether.force;
        let mut angular = s.solution.budget.centre.cross(weight)
            + tether.moment
            + s.motions[0].p.cross(tether.force);
        for (l, m) in s.total.iter().zip(&s.motions) {
            impulse += l.force;
            angular += l.moment + m.p.cross(l.force);
        }
        let deformation: f64 = s.deformation.iter().sum();
        Quadratures {
            hinge_work: s.solution.hinge_power() - s.relative[1],
            air_work: power(&s.air) - deformation,
            applied_work: power(&s.applied) + tether.power(&s.motions[0]),
            impulse,
            angular_impulse: angular,
            deformation_work: deformation,
        }
    }
}
