//! Mechanical power of flapping: aerodynamic, inertial, and what the actuators (muscles, motors) pay.

use wingbeat_dynamics::{Body, BodyMotion, Mechanism, Wrench};
use wingbeat_flight::{FlightSetup, Past, Record, Simulation, system_of};
use wingbeat_math::DVec3;

use crate::AnalysisError;
use crate::progress;
use crate::trim::Trim;
use crate::wake::WakeTrim;

/// Part of the peak by which powers of successive beats may differ for the motion to count as periodic.
const PERIODIC: f64 = 1e-7;

/// Mean mechanical powers over one wingbeat [W] and over masses [W/kg].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Power {
    /// Mean of the power against the air, in the motion relative to the root.
    pub aerodynamic: f64,
    /// Mean over the beat of the positive part of the inertial power, limb by limb (a wing, or all that hangs
    /// on the body together).
    pub inertial_positive: f64,
    /// What actuators pay if springs return all negative power: the mean of the total, not less
    /// than 0.
    pub perfect_storage: f64,
    /// What they pay if negative power is lost: mean of the positive part, joint by joint.
    pub no_storage: f64,
    /// Largest total power of a step.
    pub peak: f64,
    /// Mean of what the damping of elastic wings takes.
    pub damping: f64,
    /// Mass of the animal [kg].
    pub mass: f64,
}

/// One of the powers of a [`Power`], each in watts.
#[derive(Clone, Copy, Debug)]
pub struct PowerQuantity {
    /// Its name, as the field of [`Power`] has it.
    pub name: &'static str,
    /// What stands before it where all are listed.
    pub label: &'static str,
    /// What it is, in words.
    pub about: &'static str,
    /// Takes it [W].
    pub of: fn(&Power) -> f64,
}

const fn row(
    name: &'static str,
    label: &'static str,
    about: &'static str,
    of: fn(&Power) -> f64,
) -> PowerQuantity {
    PowerQuantity {
        name,
        label,
        about,
        of,
    }
}

impl Power {
    /// All powers, as the command line and campaigns list them.
    #[rustfmt::skip]
    pub const QUANTITIES: [PowerQuantity; 6] = [
        row("aerodynamic", "against the air, relative to the body",
            "mean power against the air, of the motion relative to the body", |p| p.aerodynamic),
        row("inertial_positive", "inertial, positive part", "positive part of the inertial power",
            |p| p.inertial_positive),
        row("perfect_storage", "actuators, perfect elastic storage", "power of actuators (muscles, motors) with perfect elastic storage",
            |p| p.perfect_storage),
        row("no_storage", "actuators, no elastic storage", "power of actuators (muscles, motors) without elastic storage",
            |p| p.no_storage),
        row("peak", "peak of all wings", "peak power of all wings", |p| p.peak),
        row("damping", "damping of elastic wings", "mean of what the damping of elastic wings takes",
            |p| p.damping),
    ];

    /// Power per body mass [W/kg].
    pub fn body_specific(&self, power: f64) -> f64 {
        power / self.mass
    }

    /// Power per mass of the actuators (flight muscle, motors) [W/kg], `muscle` its part of the mass of the flyer \[1\].
    pub fn muscle_specific(&self, power: f64, muscle: f64) -> f64 {
        power / (muscle * self.mass)
    }
}

/// Powers over the last full wingbeat of the setup, which must be tethered, or over the first that is like the one
/// before.
///
/// What joints exert is what actuators and the springs and dampers along free directions exert; the power of
/// the latter is not the muscles'. Against the air goes what the air takes from the motion relative to the root;
/// what is left of the power of joints and of springs between points moves masses: the inertial power.
///
/// # Errors
/// A setup in free flight or shorter than a beat; free joints that have not found a periodic motion at its end;
/// what the flight reports.
pub fn power(setup: &FlightSetup) -> Result<Power, AnalysisError> {
    let per_beat = setup.time.steps_per_beat().unwrap_or(0);
    let tethered = matches!(setup.mode, wingbeat_flight::MotionMode::Tethered(_));
    if per_beat == 0 || setup.time.steps < per_beat || !tethered {
        return Err(AnalysisError::not_covered(
            "power needs a tethered flight of at least one wingbeat",
            "tether the animal at its trimmed attitude",
        ));
    }
    let limbs = Limbs::of(setup)?;
    let mut flight = Simulation::new(setup.clone())?;
    let beats = setup.time.steps / per_beat;
    for _ in 0..setup.time.steps - beats * per_beat {
        flight.step()?;
    }
    let mut last = Power::default();
    for beat in 0..beats {
        progress::task("power", beat, beats);
        let now = over_beat(&limbs, &mut flight, per_beat)?;
        let is_periodic = now.is_near(&last);
        last = now;
        if is_periodic {
            break;
        }
        if beat + 1 == beats && !flight.record().joints.is_empty() {
            return Err(AnalysisError::NotPeriodic {
                what: format!(
                    "the free joints find no periodic motion within {beats} wingbeats while the body is held"
                ),
                remedy: "give them damping (joint.NAME.element), or fly longer with `run` and read the powers of the history",
            });
        }
    }
    last.mass = setup.animal.mass();
    Ok(last)
}

/// Powers over the free wingbeat of a flight that was trimmed in air without memory. (A body carried at one
/// attitude is not in balance: a bird whose pitch swings by 12 degrees was asked for 1.7 times the power.)
///
/// # Errors
/// As [`power`].
pub fn power_of_trim(trim: &Trim) -> Result<Power, AnalysisError> {
    over_free_beat(&trim.free(), 0, &Past::default())
}

/// Powers over the free wingbeat of a flight that was trimmed in air with memory, or with elastic wings.
///
/// # Errors
/// What the flight reports.
pub fn power_with_wake(trim: &WakeTrim) -> Result<Power, AnalysisError> {
    over_free_beat(&trim.setup, trim.start().held_steps, &trim.past)
}

/// Powers over a free flight after `held` steps, its elastic wings and wakes of strips beginning as in `past`
/// if there are any.
fn over_free_beat(setup: &FlightSetup, held: usize, past: &Past) -> Result<Power, AnalysisError> {
    let limbs = Limbs::of(setup)?;
    let mut flight = match past.is_empty() {
        true => Simulation::new(setup.clone())?,
        false => Simulation::after(setup.clone(), past)?,
    };
    for step in 0..held {
        progress::task("power", step, setup.time.steps);
        flight.step()?;
    }
    let mut found = over_beat(&limbs, &mut flight, setup.time.steps - held)?;
    found.mass = setup.animal.mass();
    Ok(found)
}

impl Power {
    /// Whether it is that of the next beat of a motion that has become periodic.
    fn is_near(&self, other: &Self) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= PERIODIC * self.peak;
        near(self.perfect_storage, other.perfect_storage) && near(self.peak, other.peak)
    }
}

/// Powers over the next `steps` steps of a flight.
fn over_beat(limbs: &Limbs, flight: &mut Simulation, steps: usize) -> Result<Power, AnalysisError> {
    let Limbs {
        mechanism,
        limbs,
        elastic,
    } = limbs;
    let mut sums = Power::default();
    let (begun, before) = (flight.record().time, flight.record().dissipated);
    for _ in 0..steps {
        let record = flight.step()?;
        let joints = joint_powers(record);
        let motions = motions(mechanism, record);
        let mut air = air_powers(&motions, record);
        let applied = relative_powers(&motions, &record.applied);
        for (&wing, bent) in elastic.iter().zip(&record.elastic) {
            air[wing + 1] -= bent.air_power;
        }
        let muscles: Vec<f64> = record.driving_powers(mechanism).collect();
        let mut inertial = vec![0.0; mechanism.bodies().len()];
        for (joint, p) in mechanism.joints().iter().zip(&joints) {
            inertial[limbs[joint.child]] += p;
        }
        (1..air.len()).for_each(|body| inertial[limbs[body]] += applied[body] - air[body]);
        let total: f64 = muscles.iter().sum();
        sums.aerodynamic += air.iter().sum::<f64>();
        sums.inertial_positive += positive(&inertial);
        sums.perfect_storage += total;
        sums.no_storage += positive(&muscles);
        sums.peak = sums.peak.max(total);
    }
    let n = steps as f64;
    let now = flight.record();
    Ok(Power {
        damping: (now.dissipated - before) / (now.time - begun),
        aerodynamic: sums.aerodynamic / n,
        inertial_positive: sums.inertial_positive / n,
        perfect_storage: (sums.perfect_storage / n).max(0.0),
        no_storage: sums.no_storage / n,
        peak: sums.peak,
        mass: 0.0,
    })
}

/// The bodies, the limb of each, and the numbers of the elastic wings.
struct Limbs {
    mechanism: Mechanism,
    limbs: Vec<usize>,
    elastic: Vec<usize>,
}

impl Limbs {
    fn of(setup: &FlightSetup) -> Result<Self, AnalysisError> {
        let mechanism = Mechanism::of(&system_of(setup)?);
        let wings = setup.animal.wings.iter().enumerate();
        let elastic = wings.filter(|(_, w)| w.structure.is_some());
        Ok(Self {
            limbs: limbs(&mechanism),
            elastic: elastic.map(|(i, _)| i).collect(),
            mechanism,
        })
    }
}

fn positive(powers: &[f64]) -> f64 {
    powers.iter().map(|p| p.max(0.0)).sum()
}

/// The number of the limb that each body belongs to, that of one of its bodies: bodies that joints join without
/// the root between them.
fn limbs(mechanism: &Mechanism) -> Vec<usize> {
    let mut limbs: Vec<usize> = (0..mechanism.bodies().len()).collect();
    for joint in mechanism.joints() {
        let Some(parent) = joint.parent.filter(|p| *p != 0 && joint.child != 0) else {
            continue;
        };
        let (one, other) = (limbs[parent], limbs[joint.child]);
        let joined = limbs.iter_mut().filter(|l| **l == other);
        joined.for_each(|l| *l = one);
    }
    limbs
}

/// Power of what every joint exerts, and of what deforms the wing on it [W], in the order of the mechanism.
fn joint_powers(record: &Record) -> Vec<f64> {
    let loops = record.loops.iter().map(|l| l.power);
    record.hinge_powers().chain(loops).collect()
}

/// Motions of all bodies.
fn motions(mechanism: &Mechanism, record: &Record) -> Vec<BodyMotion> {
    let motion = |(i, body): (usize, &Body)| {
        let [q, rates] = [&record.coordinates, &record.rates].map(|x| &x[6 * i..6 * i + 6]);
        let (eta, sequence) = (DVec3::from_slice(&q[3..]), body.sequence);
        BodyMotion {
            p: DVec3::from_slice(q),
            r: sequence.rotation(eta),
            v: DVec3::from_slice(rates),
            w: sequence.g(eta) * DVec3::from_slice(&rates[3..]),
        }
    };
    mechanism.bodies().iter().enumerate().map(motion).collect()
}

/// Power of loads on all bodies in their motions relative to the root [W].
fn relative_powers(motions: &[BodyMotion], loads: &[Wrench]) -> Vec<f64> {
    let root = &motions[0];
    let spin = root.r * root.w;
    let power = |(m, load): (&BodyMotion, &Wrench)| {
        let v = m.v - root.v - spin.cross(m.p - root.p);
        load.force.dot(v) + load.moment.dot(m.r * m.w - spin)
    };
    motions.iter().zip(loads).map(power).collect()
}

/// Power that every body gives to the air by its motion relative to the root, deformation included [W].
fn air_powers(motions: &[BodyMotion], record: &Record) -> Vec<f64> {
    let mut powers = relative_powers(motions, &record.air);
    powers.iter_mut().for_each(|p| *p = -*p);
    let wings = powers[1..].iter_mut().zip(&record.deformation_power);
    wings.for_each(|(p, deforming)| *p += deforming);
    powers
}
