//! From the last evaluation to a [`Record`]: every quantity in the units a reader expects.

use std::f64::consts::{PI, TAU};

use wingbeat_air::{WakeEvents, WakeSheet};
use wingbeat_dynamics::{Body, BodyMotion, Budget};
use wingbeat_math::ode::StepReport;
use wingbeat_math::{DQuat, DVec3, larger};

use crate::elastic::ElasticState;
use crate::equations::quadratures::Quadratures;
use crate::equations::towed::Towed;
use crate::equations::{Equations, Scratch};
use crate::error::FlightError;
use crate::interface::memory::{AirMemory, wakes_of};
use crate::interface::record::{Integral, Record};
use crate::simulation::turns;

/// Below this |cos theta| the first and the last Euler angle have no digits of their own, only together.
const EULER_LIMIT: f64 = 1e-6;

/// What balances are counted from, and the angles last recorded (so that they go on without
/// jumps).
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Ledger {
    /// Energy at the start [J].
    pub energy: f64,
    /// Kinetic energy relative to the root at the start [J].
    pub relative_energy: f64,
    /// Linear momentum at the start [kg m/s], N components.
    pub momentum: DVec3,
    /// Angular momentum about the inertial origin at the start [kg m2/s], N components.
    pub angular_momentum: DVec3,
    /// The root alone at the start, where a tether moves it.
    pub towed: Towed,
    /// Coordinates last recorded (seed eq. 2) [m, rad].
    pub coordinates: Vec<f64>,
    /// Their rates [m/s, rad/s].
    pub rates: Vec<f64>,
    /// Coordinates along the free directions of all joints last recorded [rad or m].
    pub joints: Vec<f64>,
    /// Energy stored in springs and stops of the joints at the start [J].
    pub stored: Option<f64>,
    /// Regularised events of the air up to the last record, and those of them that were limits.
    pub events: [u64; 2],
    /// Rings with circulation that left leading edges up to the last record.
    pub leading_rings: u64,
    /// Impulse of the air on all bodies up to the last record.
    pub air_impulse: Integral<DVec3>,
    /// The same of the inviscid force alone.
    pub inviscid_impulse: Integral<DVec3>,
    /// Impulse of all vorticity at the start [kg m/s], N components.
    pub vortex_impulse: DVec3,
    /// Positive work of what drives the joints up to the last record.
    pub positive_work: Integral<f64>,
    /// Impulse of the dynamic pressure past the wings up to the last record.
    pub dynamic_impulse: Integral<f64>,
}

impl Ledger {
    /// Opens the books at the state last evaluated.
    pub fn open(s: &Scratch) -> Self {
        let budget = &s.solution.budget;
        Self {
            energy: s.solution.energy(),
            relative_energy: s.relative[0],
            momentum: budget.momentum,
            angular_momentum: about_origin(budget),
            towed: s.towed,
            vortex_impulse: s.air_scratch.loads.impulse,
            ..Self::default()
        }
    }

    /// A jump of the motion that nothing in the flight makes, as when a root is released with another velocity:
    /// the balances go on as if it had been there from the start. The books were opened `before` and `after`
    /// it.
    pub fn count_jump(&mut self, before: &Self, after: &Self) {
        self.energy += after.energy - before.energy;
        self.relative_energy += after.relative_energy - before.relative_energy;
        self.momentum += after.momentum - before.momentum;
        self.angular_momentum += after.angular_momentum - before.angular_momentum;
    }
}

/// Everything a record is made from, but for angles and commands of the wings.
pub struct Sources<'a> {
    /// The equations in force.
    pub equations: &'a Equations,
    /// Intermediate results of the last evaluation.
    pub scratch: &'a Scratch,
    /// State vector last evaluated.
    pub y: &'a [f64],
    /// The air, not yet moved on.
    pub air: Option<&'a AirMemory>,
    /// The elastic wings, not yet moved on.
    pub wings: &'a [ElasticState],
    /// What the corrector did.
    pub report: StepReport,
}

impl Sources<'_> {
    /// Makes `r` the record of step `step` at time `time` [s], in the room that it has; the ledger takes note of the
    /// angles.
    ///
    /// # Errors
    /// A joint has turned farther than its elements can know.
    pub fn write(
        &self,
        step: usize,
        time: f64,
        ledger: &mut Ledger,
        r: &mut Record,
    ) -> Result<(), FlightError> {
        (r.step, r.time) = (step, time);
        self.write_motion(time, ledger, r)?;
        self.write_loads(r);
        let dissipated = Quadratures::from_state(self.y).dissipated;
        r.put_passive(&self.equations.mechanism, |_, now| {
            *ledger.stored.get_or_insert(now.stored) - now.stored - dissipated
        });
        let powers = r.driving_powers(&self.equations.mechanism);
        let positive = powers.map(|p| p.max(0.0)).sum();
        r.positive_work = ledger.positive_work.count(time, positive);
        self.write_balances(ledger, r);
        self.write_air(time, ledger, r);
        Ok(())
    }

    /// Coordinates, attitudes, accelerations, and how well they are determined.
    fn write_motion(
        &self,
        time: f64,
        ledger: &mut Ledger,
        r: &mut Record,
    ) -> Result<(), FlightError> {
        let (s, solution) = (self.scratch, &self.scratch.solution);
        let bodies = self.equations.core.system().bodies();
        r.euler_regularity = note_coordinates(bodies, &s.motions, ledger);
        r.coordinates.clone_from(&ledger.coordinates);
        r.rates.clone_from(&ledger.rates);
        r.root_quaternion = quaternion(&s.motions[0]);
        r.root_angular_velocity = s.motions[0].w;
        r.mass_centre = solution.budget.centre;
        r.accelerations.clone_from(&solution.bodies);
        self.write_joints(time, ledger, r)?;
        r.violation_position = solution.violation.position;
        r.violation_orientation = solution.violation.orientation;
        r.corrector_passes = self.report.passes;
        r.corrector_residual = self.report.residual;
        Ok(())
    }

    /// Loads on bodies, reactions of joints.
    fn write_loads(&self, r: &mut Record) {
        let (s, solution) = (self.scratch, &self.scratch.solution);
        r.multipliers.clone_from(&solution.multipliers);
        r.hinges.clone_from(&solution.hinges);
        r.loops.clone_from(&solution.loops);
        let wings = 1..s.deformation.len().min(r.wing_angles.len() + 1);
        r.deformation_power.clear();
        (r.deformation_power).extend_from_slice(s.deformation.get(wings).unwrap_or(&[]));
        r.air.clone_from(&s.air);
        r.applied.clone_from(&s.applied);
        r.tether = solution.tether;
        self.equations.elastic.records(&s.elastic, &mut r.elastic);
    }

    /// Energies, momenta, and what is missing in them.
    fn write_balances(&self, ledger: &Ledger, r: &mut Record) {
        let (s, work) = (self.scratch, Quadratures::from_state(self.y));
        let (solution, budget) = (&s.solution, &s.solution.budget);
        r.kinetic_energy = budget.kinetic;
        r.potential_energy = budget.potential;
        r.hinge_work = work.hinge_work + s.relative[0] - ledger.relative_energy;
        r.air_work = work.air_work;
        r.deformation_work = work.deformation_work;
        let (towed_energy, towed_momentum, towed_spin) = s.towed.gained(&ledger.towed);
        r.applied_work = work.applied_work + towed_energy;
        r.dissipated = self.equations.elastic.dissipated(self.wings, &s.elastic);
        let done = r.hinge_work + work.air_work + work.deformation_work + r.applied_work;
        r.energy_residual = solution.energy() - ledger.energy - done + r.dissipated;
        r.momentum = budget.momentum;
        r.angular_momentum = about_origin(budget);
        let gained = budget.momentum - ledger.momentum - towed_momentum;
        r.momentum_residual = gained - work.impulse;
        r.momentum_residual_of_works = gained - work.impulse_of_works;
        let spin = r.angular_momentum - ledger.angular_momentum - towed_spin;
        r.angular_momentum_residual = spin - work.angular_impulse;
    }

    /// Impulses of the air and the state of its wakes.
    fn write_air(&self, time: f64, ledger: &mut Ledger, r: &mut Record) {
        let (s, loads) = (self.scratch, &self.scratch.air_scratch.loads);
        let events = wakes_of(self.air).map_or(WakeEvents::default(), |air| air.events);
        let regularised = [events.limited + events.near_surface, events.limited];
        [r.regularised, r.limited] = [0, 1].map(|k| (regularised[k] - ledger.events[k]) as usize);
        r.leading_rings = (events.leading_rings - ledger.leading_rings) as f64;
        (ledger.events, ledger.leading_rings) = (regularised, events.leading_rings);
        r.vortex_impulse = loads.impulse;
        let air_force = s.air.iter().map(|w| w.force).sum();
        r.air_impulse = ledger.air_impulse.count(time, air_force);
        let dynamic = self.equations.pressure.force(time, &s.motions);
        r.dynamic_impulse = ledger.dynamic_impulse.count(time, dynamic);
        r.inviscid_impulse = ledger.inviscid_impulse.count(time, loads.inviscid_force);
        r.impulse_account = loads.account;
        r.impulse_residual = loads.impulse - ledger.vortex_impulse + r.inviscid_impulse;
        r.wake_rings = self.in_wake(WakeSheet::ring_count);
        r.wake_particles = self.in_wake(|w| w.particles.len());
        r.net_flux_residual = self.net_flux_residual();
    }

    /// Coordinates along the free directions of all joints.
    fn write_joints(
        &self,
        time: f64,
        ledger: &mut Ledger,
        r: &mut Record,
    ) -> Result<(), FlightError> {
        r.joints.clear();
        let Equations {
            core, mechanism, ..
        } = self.equations;
        let system = core.system();
        if system.speeds() == 0 && system.loops().is_empty() {
            return Ok(());
        }
        mechanism.coordinates(time, &self.scratch.motions, &mut r.joints);
        turns::check_spherical(mechanism, time, &r.joints, &ledger.joints)?;
        turns::count(mechanism, &mut r.joints, &mut ledger.joints);
        match core.counts_turns() {
            true => Ok(()),
            false => turns::check(mechanism, time, &r.joints),
        }
    }

    /// Sum over all wake sheets.
    fn in_wake(&self, count: impl Fn(&WakeSheet) -> usize) -> usize {
        let sheets = wakes_of(self.air).map_or(&[][..], |a| &a.sheets);
        sheets.iter().map(count).sum()
    }

    /// Largest net-flux residual of a closed surface; the loads of a vacuum are empty.
    fn net_flux_residual(&self) -> f64 {
        let surfaces = &self.scratch.air_scratch.loads.surfaces;
        surfaces
            .iter()
            .fold(0.0, |m, s| larger(m, s.net_flux_residual.abs()))
    }
}

/// Angular momentum about the inertial origin.
fn about_origin(b: &Budget) -> DVec3 {
    b.angular_momentum + b.centre.cross(b.momentum)
}

/// Unit quaternion (w, x, y, z) of R_NB with w >= 0.
fn quaternion(m: &BodyMotion) -> [f64; 4] {
    let q = DQuat::from_mat3(&m.r).normalize();
    let q = if q.w < 0.0 { -q } else { q };
    [q.w, q.x, q.y, q.z]
}

/// Writes coordinates and rates of all bodies (seed eq. 2) into the ledger, angles without jumps,
/// the first those nearest to zero; returns the smallest |cos theta|.
fn note_coordinates(bodies: &[Body], motions: &[BodyMotion], ledger: &mut Ledger) -> f64 {
    let first = ledger.coordinates.is_empty();
    ledger.coordinates.resize(6 * bodies.len(), 0.0);
    ledger.rates.resize(6 * bodies.len(), 0.0);
    let mut smallest = f64::INFINITY;
    for (i, (body, m)) in bodies.iter().zip(motions).enumerate() {
        let at = 6 * i;
        m.p.write_to_slice(&mut ledger.coordinates[at..]);
        m.v.write_to_slice(&mut ledger.rates[at..]);
        let eta = body.sequence.angles(m.r);
        let regularity = body.sequence.regularity(eta);
        smallest = smallest.min(regularity);
        let before = DVec3::from_slice(&ledger.coordinates[at + 3..]);
        let is_singular = regularity < EULER_LIMIT;
        let eta = match is_singular {
            true => body.sequence.singular_angles(m.r, before),
            false => eta,
        };
        let near = without_jumps(eta, before);
        let eta = if first && near == eta { eta } else { near }; // zeros keep their signs
        let rates = match is_singular {
            true => body.sequence.singular_rates(eta, m.w),
            false => body.sequence.g(eta).inverse() * m.w,
        };
        eta.write_to_slice(&mut ledger.coordinates[at + 3..]);
        rates.write_to_slice(&mut ledger.rates[at + 3..]);
    }
    smallest
}

/// The angles of the attitude `eta` that come nearest to `before`: with whole turns more or less, and of the
/// two triples (a, b, c) and (a + pi, pi - b, c + pi), which are one attitude.
fn without_jumps(eta: DVec3, before: DVec3) -> DVec3 {
    let nearest = |eta: DVec3| eta + TAU * ((before - eta) / TAU).round();
    let one = nearest(eta);
    let other = nearest(DVec3::new(eta.x + PI, PI - eta.y, eta.z + PI));
    match other.distance_squared(before) < one.distance_squared(before) {
        true => other,
        false => one,
    }
}
