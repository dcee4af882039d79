//! What one accepted step leaves behind: every quantity a reader may ask for, SI and radians.

use std::ops::{Add, Mul};

use wingbeat_air::ImpulseAccount;
use wingbeat_dynamics::{BodyAcceleration, HingeReaction, Mechanism, Passive, Wrench};
use wingbeat_math::{DMat3, DQuat, DVec3};
use wingbeat_model::motion::Adjustment;

use crate::interface::controller::Aim;

/// The record of one accepted step. Body 0 is the root, wings follow in the animal's order.
#[derive(Debug, Default, PartialEq)]
pub struct Record {
    /// Step number, 0 is the start.
    pub step: usize,
    /// Time [s].
    pub time: f64,
    /// Wing angles per wing: phi, theta, psi [rad].
    pub wing_angles: Vec<DVec3>,
    /// Per wing: the command of feedback at the end of the transition under way; empty without feedback.
    pub commands: Vec<Adjustment>,
    /// Looks of feedback so far, and of them those at which the command stood at a limit.
    pub looks: [usize; 2],
    /// Where feedback is to bring the flyer; empty where nothing is followed.
    pub reference: Vec<Aim>,
    /// Angle by which the attitude of the root departs from the one that feedback held at its newest look [rad]; empty
    /// where that follows from the attitude at the release, and without feedback.
    pub attitude_departure: Vec<f64>,
    /// Generalized coordinates q of seed eq. 2: per body x, y, z [m], phi, theta, psi [rad].
    pub coordinates: Vec<f64>,
    /// Time derivatives of the coordinates [m/s, rad/s].
    pub rates: Vec<f64>,
    /// Unit quaternion (w, x, y, z) of the root's R_NB \[1\].
    pub root_quaternion: [f64; 4],
    /// Angular velocity of the root, root components [rad/s].
    pub root_angular_velocity: DVec3,
    /// Mass centre of the whole animal, N components [m].
    pub mass_centre: DVec3,
    /// Per body: accelerations.
    pub accelerations: Vec<BodyAcceleration>,
    /// Lagrange multipliers in the seed's order [N, N m].
    pub multipliers: Vec<f64>,
    /// Per hinge (wing): what the body does to the wing; powers are those of actuators, springs, dampers and stops.
    pub hinges: Vec<HingeReaction>,
    /// Per joint that closes a loop: what the parent does to the child.
    pub loops: Vec<HingeReaction>,
    /// Coordinate and rate along every free direction of every joint, in the order of the joints
    /// [rad or m, per s]; angles of revolute and universal joints go on beyond half a turn.
    pub joints: Vec<[f64; 2]>,
    /// Per wing: power of what deforms it against the air [W]; empty where nothing is deformed.
    pub deformation_power: Vec<f64>,
    /// Per elastic wing, in the order of the wings: how it is bent.
    pub elastic: Vec<ElasticRecord>,
    /// Per body: air load.
    pub air: Vec<Wrench>,
    /// Per body: applied load.
    pub applied: Vec<Wrench>,
    /// Tether reaction on the root (zero in free flight).
    pub tether: Wrench,
    /// Kinetic energy [J].
    pub kinetic_energy: f64,
    /// Potential energy of weight, zero at the inertial origin, and elastic energy of wings [J].
    pub potential_energy: f64,
    /// Work done so far at all joints [J]: of actuators, springs, dampers and stops.
    pub hinge_work: f64,
    /// Power of springs, dampers and stops along the free directions of joints [W].
    pub passive_power: f64,
    /// Their work so far [J].
    pub passive_work: f64,
    /// Work of actuators and of prescribed deformation where it is positive, joint by joint, since the start \[J\]:
    /// what they give if nothing that they take up comes back. Counted step by step with the trapezoidal rule.
    pub positive_work: f64,
    /// Impulse that the wings would have had from the air at a coefficient of one, since the start [N s]: the integral
    /// over time, by the trapezoidal rule, of `1/2 rho int U^2 dA` over all wings, U the velocity of the feathering axes
    /// through the undisturbed air. Zero in a vacuum and where the model of the air tells no density.
    pub dynamic_impulse: f64,
    /// Work done so far by the air on the bodies [J], on their deformation too.
    pub air_work: f64,
    /// Work done so far by what deforms the wings against the air [J].
    pub deformation_work: f64,
    /// Work done so far by applied loads and the tether [J].
    pub applied_work: f64,
    /// Energy that the damping of elastic wings has dissipated so far [J].
    pub dissipated: f64,
    /// Energy residual: kinetic + potential (weight, elastic wings) - start - all work + what was dissipated [J].
    pub energy_residual: f64,
    /// Linear momentum, N components [kg m/s].
    pub momentum: DVec3,
    /// Angular momentum about the inertial origin, N components [kg m2/s].
    pub angular_momentum: DVec3,
    /// Momentum residual, N components: momentum - start - impulse of all external forces [kg m/s].
    pub momentum_residual: DVec3,
    /// The same with the impulse integrated as the works are, N components [kg m/s]: in a frame of velocity u the
    /// energy residual is less by u times this one. Not a number of results that do not say it.
    pub momentum_residual_of_works: DVec3,
    /// The same for angular momentum about the inertial origin, N components [kg m2/s].
    pub angular_momentum_residual: DVec3,
    /// Largest violation of a connection constraint phi_1..6 [m].
    pub violation_position: f64,
    /// Largest violation of an orientation constraint phi_7..12 [1].
    pub violation_orientation: f64,
    /// Smallest |cos theta| over all bodies: distance from the Euler singularity [1].
    pub euler_regularity: f64,
    /// Corrector passes of the step.
    pub corrector_passes: usize,
    /// Scaled residual of the last corrector pass [1].
    pub corrector_residual: f64,
    /// Impulse of all vorticity [kg m/s], N components, less the momentum of the fictitious fluid in closed
    /// surfaces; zero without a lattice. In air at rest far away its rate of decrease is the inviscid
    /// force of the air on all bodies, see [`wingbeat_air::AirLoads::impulse`].
    pub vortex_impulse: DVec3,
    /// Impulse of the air's force on all bodies since the start, N components [N s], by the
    /// trapezoidal rule over the steps.
    pub air_impulse: DVec3,
    /// The same of the inviscid force alone, with the suction that pressures lack, without friction, N components [N
    /// s]; zero without a lattice. See [`wingbeat_air::AirLoads::inviscid_force`].
    pub inviscid_impulse: DVec3,
    /// Where the vortex impulse came from and went; zero without a lattice.
    pub impulse_account: ImpulseAccount,
    /// What the impulse of all vorticity and that of the inviscid force have gained together since the start, N
    /// components [kg m/s]: nothing where wakes carry no force, in air at rest far away and without a ground.
    pub impulse_residual: DVec3,
    /// Wake rings.
    pub wake_rings: usize,
    /// Vortex particles of the wakes.
    pub wake_particles: usize,
    /// Events in which a near-singular velocity was regularised in this step.
    pub regularised: usize,
    /// Of these, ways of wake nodes and strengths of particles that were limited, and leading edges that shed what they
    /// had too much ([`wingbeat_air::WakeEvents::limited`]).
    pub limited: usize,
    /// Rings with circulation that left leading edges in this step, of a mirror-symmetric flow on the half computed \[1\]; not
    /// a number of results that do not say it.
    pub leading_rings: f64,
    /// Largest net-flux residual of the closed surfaces: a uniform normal velocity [m/s].
    pub net_flux_residual: f64,
}

/// A copy into the room of another record allocates nothing.
impl Clone for Record {
    fn clone(&self) -> Self {
        let mut copy = Self::default();
        copy.clone_from(self);
        copy
    }

    fn clone_from(&mut self, other: &Self) {
        *self = Self {
            wing_angles: over(&mut self.wing_angles, &other.wing_angles),
            commands: over(&mut self.commands, &other.commands),
            reference: over(&mut self.reference, &other.reference),
            attitude_departure: over(&mut self.attitude_departure, &other.attitude_departure),
            coordinates: over(&mut self.coordinates, &other.coordinates),
            rates: over(&mut self.rates, &other.rates),
            accelerations: over(&mut self.accelerations, &other.accelerations),
            multipliers: over(&mut self.multipliers, &other.multipliers),
            hinges: over(&mut self.hinges, &other.hinges),
            loops: over(&mut self.loops, &other.loops),
            joints: over(&mut self.joints, &other.joints),
            deformation_power: over(&mut self.deformation_power, &other.deformation_power),
            elastic: over(&mut self.elastic, &other.elastic),
            air: over(&mut self.air, &other.air),
            applied: over(&mut self.applied, &other.applied),
            ..*other
        };
    }
}

/// A copy of `list` in the room of `old`.
fn over<T: Copy>(old: &mut Vec<T>, list: &[T]) -> Vec<T> {
    let mut copy = std::mem::take(old);
    copy.clear();
    copy.extend_from_slice(list);
    copy
}

/// Rotation R_NB of an attitude given by a unit quaternion (w, x, y, z).
pub fn rotation_of([w, x, y, z]: [f64; 4]) -> DMat3 {
    DMat3::from_quat(DQuat::from_xyzw(x, y, z, w))
}

impl Record {
    /// Attitude of the root, R_NB.
    pub fn root_rotation(&self) -> DMat3 {
        rotation_of(self.root_quaternion)
    }

    /// Force of the air on all bodies, N components [N].
    pub fn air_force(&self) -> DVec3 {
        self.air.iter().map(|load| load.force).sum()
    }

    /// Force of the air against gravity [N], which points along the unit vector `down`.
    pub fn lift(&self, down: DVec3) -> f64 {
        -self.air_force().dot(down)
    }

    /// Power at each hinge [W]: of its actuators, springs, dampers and stops and, for wings, of what deforms
    /// them against the air. Wings first, then segments.
    pub fn hinge_powers(&self) -> impl Iterator<Item = f64> {
        let deforming = self.deformation_power.iter().copied();
        let deforming = deforming.chain(std::iter::repeat(0.0));
        self.hinges.iter().zip(deforming).map(|(h, d)| h.power + d)
    }

    /// Puts in what springs, dampers and stops of all joints do, by their coordinates; `work` makes of the time
    /// [s] and of that the work up to this record [J].
    pub fn put_passive(&mut self, mechanism: &Mechanism, work: impl FnOnce(f64, &Passive) -> f64) {
        let mut sum = Passive::default();
        for joint in mechanism.passive(self.time, &self.joints) {
            sum.power += joint.power;
            sum.stored += joint.stored;
            sum.dissipation += joint.dissipation;
        }
        self.passive_power = sum.power;
        self.passive_work = work(self.time, &sum);
    }

    /// Power of what drives each joint [W], of prescribed deformation too, springs, dampers and stops left out; joints
    /// and loops in the order of the mechanism.
    pub fn driving_powers<'a>(
        &'a self,
        mechanism: &'a Mechanism,
    ) -> impl Iterator<Item = f64> + 'a {
        let joints = self
            .hinge_powers()
            .chain(self.loops.iter().map(|l| l.power));
        let passive = mechanism.passive(self.time, &self.joints);
        joints
            .zip(passive)
            .map(|(all, passive)| all - passive.power)
    }

    /// Power of all actuators and of all prescribed deformation [W].
    pub fn driving_power(&self) -> f64 {
        let loops: f64 = self.loops.iter().map(|l| l.power).sum();
        self.hinge_powers().sum::<f64>() + loops - self.passive_power
    }

    /// Work of all actuators and of all prescribed deformation since the start [J], the integral
    /// of [`Self::driving_power`].
    pub fn driving_work(&self) -> f64 {
        self.hinge_work + self.deformation_work - self.passive_work
    }
}

/// The integral of a rate since time 0 (the impulse of a force, the work of a power), counted step by step with the
/// trapezoidal rule: over whole beats of a periodic rate it errs by no more than harmonics beyond half the steps in a
/// beat.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Integral<T> {
    time: f64,
    rate: T,
    sum: T,
}

impl<T: Copy + Add<Output = T> + Mul<f64, Output = T>> Integral<T> {
    /// Counts on to `time` [s], where the rate is `rate`; returns the integral up to there. The first call, at time
    /// 0, sets the rate of the start.
    pub fn count(&mut self, time: f64, rate: T) -> T {
        self.sum = self.sum + (self.rate + rate) * (0.5 * (time - self.time));
        (self.time, self.rate) = (time, rate);
        self.sum
    }
}

/// How an elastic wing is bent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ElasticRecord {
    /// Displacement of the middle of the tip's chord from rest, wing components [m].
    pub tip: DVec3,
    /// Twist of the tip from rest, positive like feathering: leading edge towards -axis 3 [rad].
    pub twist: f64,
    /// Its sections at [`STATIONS`] of the surface's length from its root.
    pub sections: [SectionRecord; 4],
    /// Elastic energy [J].
    pub strain_energy: f64,
    /// Power that goes into it [W].
    pub strain_power: f64,
    /// Power of the air on what the wing moves relative to its frame [W].
    pub air_power: f64,
    /// Passes that shape and loads took to agree.
    pub passes: usize,
}

/// Where sections are looked at, in parts of the surface's length from its root.
pub const STATIONS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// What a section has other than at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionRecord {
    /// Displacement of the middle of its chord along axis 3 of the wing \[m\].
    pub deflection: f64,
    /// Twist, positive like feathering: leading edge towards -axis 3 \[rad\].
    pub twist: f64,
    /// Camber: largest height over its chord, over the chord, positive towards -axis 3 as prescribed camber is \[1\].
    pub camber: f64,
}

/// The geometry of one instant, for pictures and for the eyes of ParaView.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// Step number.
    pub step: usize,
    /// Time [s].
    pub time: f64,
    /// Bound surfaces: wings and body parts.
    pub surfaces: Vec<SurfaceSnapshot>,
    /// Wake sheets.
    pub wakes: Vec<WakeSnapshot>,
}

/// One bound surface at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceSnapshot {
    /// Name of the wing or body part.
    pub name: String,
    /// Nodes, N components [m].
    pub nodes: Vec<DVec3>,
    /// Panels as four node indices.
    pub quads: Vec<[usize; 4]>,
    /// Ring circulation per panel [m2/s], positive when its lift is along the normal: left-handed about the corners.
    pub circulation: Vec<f64>,
    /// Pressure jump per panel [Pa], positive along the panel normal (pushes along the normal).
    pub pressure_jump: Vec<f64>,
}

/// One wake sheet at one instant: `rows` x `cols` rings, newest row first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WakeSnapshot {
    /// Name: surface and edge it leaves.
    pub name: String,
    /// Ring rows, newest first.
    pub rows: usize,
    /// Rings per row.
    pub cols: usize,
    /// (rows + 1) x (cols + 1) nodes, row by row, N components [m].
    pub nodes: Vec<DVec3>,
    /// Ring circulations, row by row [m2/s], right-handed about the corners (row, column), (row + 1, column),
    /// (row + 1, column + 1), (row, column + 1).
    pub circulation: Vec<f64>,
    /// Circulations of those that have become particles, 0 of rings \[m2/s\]: filaments that they have in
    /// common with rings carry them, too. None in flights without particles.
    pub shared_circulation: Option<Vec<f64>>,
    /// Vortex particles that rings of the sheet have become, oldest first.
    pub particles: Vec<ParticleSnapshot>,
}

/// One vortex particle at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ParticleSnapshot {
    /// Place, N components [m].
    pub position: DVec3,
    /// Vorticity times volume, N components [m3/s].
    pub strength: DVec3,
    /// Radius of the ball over which the vorticity is spread [m].
    pub radius: f64,
}
