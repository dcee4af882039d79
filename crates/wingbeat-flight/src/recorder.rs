//! From the last evaluation to a [`Record`]: every quantity in the units a reader expects.

use wingbeat_air::{AirState, WakeSheet};
use wingbeat_dynamics::{Body, BodyMotion, Budget, Wrench};
use wingbeat_math::ode::StepReport;
use wingbeat_math::{DQuat, DVec3};
use wingbeat_model::motion::Adjustment;

use crate::equations::{Equations, Scratch};
use crate::quadratures::Quadratures;
use crate::record::{AccelerationRecord, AirImpulse, HingeRecord, LoadRecord, Record};

/// Below this |cos theta| Euler angles and their rates are not evaluated but kept: they lose
/// all their digits there.
const EULER_LIMIT: f64 = 1e-6;

/// What balances are counted from, and the angles last recorded (so that they go on without
/// jumps of a whole turn).
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Ledger {
    /// Energy at the start [J].
    pub energy: f64,
    /// Kinetic energy relative to the root at the start [J].
    pub relative_energy: f64,
    /// Linear momentum at the start [kg m/s], N.
    pub momentum: DVec3,
    /// Angular momentum about the inertial origin at the start [kg m2/s], N.
    pub angular_momentum: DVec3,
    /// Coordinates last recorded (seed eq. 2).
    pub coordinates: Vec<f64>,
    /// Their rates.
    pub rates: Vec<f64>,
    /// Regularised events of the air up to the last record.
    pub events: u64,
    /// Impulse of the air on all bodies up to the last record.
    pub air_impulse: AirImpulse,
    /// The same of the inviscid force alone.
    pub inviscid_impulse: AirImpulse,
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
            ..Self::default()
        }
    }
}

/// Everything a record is made from.
pub struct Sources<'a> {
    /// Angles of the wings [rad].
    pub wing_angles: Vec<DVec3>,
    /// Commands of feedback.
    pub commands: Vec<Adjustment>,
    /// The equations in force.
    pub equations: &'a Equations,
    /// Intermediate results of the last evaluation.
    pub scratch: &'a Scratch,
    /// State vector last evaluated.
    pub y: &'a [f64],
    /// The air, not yet moved on.
    pub air: Option<&'a AirState>,
    /// What the corrector did.
    pub report: StepReport,
}

impl Sources<'_> {
    /// The record of step `step` at time `time` [s]; the ledger takes note of the angles.
    pub fn record(&self, step: usize, time: f64, ledger: &mut Ledger) -> Record {
        let (s, work) = (self.scratch, Quadratures::from_state(self.y));
        let system = self.equations.core.system();
        let regularity = note_coordinates(system.bodies(), &s.motions, ledger);
        let (solution, budget) = (&s.solution, &s.solution.budget);
        let angular_momentum = about_origin(budget);
        let events = self.air.map_or(0, total_events);
        let new_events = events - ledger.events;
        ledger.events = events;
        let hinge_work = work.hinge_work + s.relative[0] - ledger.relative_energy;
        let done = hinge_work + work.air_work + work.deformation_work + work.applied_work;
        let air_force = s.air.iter().map(|w| w.force).sum();
        let wings = 1..s.deformation.len().min(self.wing_angles.len() + 1);
        Record {
            step,
            time,
            wing_angles: self.wing_angles.clone(),
            commands: self.commands.clone(),
            coordinates: ledger.coordinates.clone(),
            rates: ledger.rates.clone(),
            root_quaternion: quaternion(&s.motions[0]),
            root_angular_velocity: s.motions[0].w,
            mass_centre: budget.centre,
            accelerations: solution.bodies.iter().map(acceleration).collect(),
            multipliers: solution.multipliers.clone(),
            hinges: solution.hinges.iter().map(hinge).collect(),
            loops: solution.loops.iter().map(hinge).collect(),
            joints: self.joint_coordinates(time),
            deformation_power: s.deformation.get(wings).unwrap_or(&[]).to_vec(),
            air: s.air.iter().map(load).collect(),
            applied: s.applied.iter().map(load).collect(),
            tether: load(&solution.tether),
            kinetic_energy: budget.kinetic,
            potential_energy: budget.potential,
            hinge_work,
            air_work: work.air_work,
            deformation_work: work.deformation_work,
            applied_work: work.applied_work,
            energy_residual: solution.energy() - ledger.energy - done,
            momentum: budget.momentum,
            angular_momentum,
            momentum_residual: budget.momentum - ledger.momentum - work.impulse,
            angular_momentum_residual: angular_momentum
                - ledger.angular_momentum
                - work.angular_impulse,
            violation_position: solution.violation.position,
            violation_orientation: solution.violation.orientation,
            euler_regularity: regularity,
            corrector_passes: self.report.passes,
            corrector_residual: self.report.residual,
            vortex_impulse: s.air_scratch.loads.impulse,
            air_impulse: ledger.air_impulse.count(time, air_force),
            inviscid_impulse: (ledger.inviscid_impulse)
                .count(time, s.air_scratch.loads.inviscid_force),
            wake_rings: self.in_wake(WakeSheet::ring_count),
            wake_particles: self.in_wake(|w| w.particles.len()),
            regularised: new_events as usize,
            net_flux_residual: self.net_flux_residual(),
        }
    }

    /// Coordinates along the free directions of all joints.
    fn joint_coordinates(&self, time: f64) -> Vec<[f64; 2]> {
        let mut out = vec![];
        let system = self.equations.core.system();
        if system.speeds() == 0 && system.loops().is_empty() {
            return out;
        }
        (self.equations.mechanism).coordinates(time, &self.scratch.motions, &mut out);
        out
    }

    /// Sum over all wake sheets.
    fn in_wake(&self, count: impl Fn(&WakeSheet) -> usize) -> usize {
        let sheets = self.air.map_or(&[][..], |a| &a.sheets);
        sheets.iter().map(count).sum()
    }

    /// Largest net-flux residual of a closed surface; the loads of a vacuum are empty.
    fn net_flux_residual(&self) -> f64 {
        let surfaces = &self.scratch.air_scratch.loads.surfaces;
        surfaces
            .iter()
            .fold(0.0, |m, s| m.max(s.net_flux_residual.abs()))
    }
}

/// All regularised events of the air so far.
fn total_events(air: &AirState) -> u64 {
    air.events.limited + air.events.near_surface
}

/// Angular momentum about the inertial origin.
fn about_origin(b: &Budget) -> DVec3 {
    b.angular_momentum + b.centre.cross(b.momentum)
}

fn load(w: &Wrench) -> LoadRecord {
    LoadRecord {
        force: w.force,
        moment: w.moment,
    }
}

fn acceleration(a: &wingbeat_dynamics::BodyAcceleration) -> AccelerationRecord {
    AccelerationRecord {
        linear: a.linear,
        angular: a.angular,
    }
}

fn hinge(h: &wingbeat_dynamics::HingeReaction) -> HingeRecord {
    HingeRecord {
        force: h.force,
        moment: h.moment,
        power: h.power,
    }
}

/// Unit quaternion (w, x, y, z) of R_NB with w >= 0.
fn quaternion(m: &BodyMotion) -> [f64; 4] {
    let q = DQuat::from_mat3(&m.r).normalize();
    let q = if q.w < 0.0 { -q } else { q };
    [q.w, q.x, q.y, q.z]
}

/// Writes coordinates and rates of all bodies (seed eq. 2) into the ledger, angles without jumps
/// of a turn; returns the smallest |cos theta|.
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
        if regularity < EULER_LIMIT && !first {
            continue;
        }
        let before = DVec3::from_slice(&ledger.coordinates[at + 3..]);
        let eta = if first {
            eta
        } else {
            without_turns(eta, before)
        };
        let rates = body.sequence.g(eta).inverse() * m.w;
        eta.write_to_slice(&mut ledger.coordinates[at + 3..]);
        if rates.is_finite() {
            rates.write_to_slice(&mut ledger.rates[at + 3..]);
        }
    }
    smallest
}

/// The angles plus whole turns that come nearest to `before`. The two attitudes (a, b, c) and
/// (a + pi, pi - b, c + pi) are one; the first, with b in [-pi/2, pi/2], is always reported.
fn without_turns(eta: DVec3, before: DVec3) -> DVec3 {
    let turn = 2.0 * std::f64::consts::PI;
    eta + turn * ((before - eta) / turn).round()
}
