//! Derivatives of the loads of a glider in air that keeps wakes, and the rigid body under them.
//!
//! A flyer that keeps velocity and angular velocity in axes fixed in it goes along a straight line, a circle or a helix
//! and leaves a wake that is steady in these axes. So its loads are as well defined as those of the glide itself, and
//! differences between such tows are the derivatives by u, v, w, p, q, r (the rates at constant incidence, sideslip and
//! speed). What a wake does not know yet while the motion changes (the lag of the downwash at a tail), and the mass of
//! air that is carried along, are left out: [`wake_floquet`](super::wake_floquet) flies them.

use std::borrow::Cow;
use std::f64::consts::TAU;

use wingbeat_flight::{
    AirModel, FlightSetup, MotionMode, PrescribedMotion, Record, Simulation, StartState,
};
use wingbeat_math::six_by_six::from_entries;
use wingbeat_math::{DMat3, DVec3, SixBySix, Wrench, six};

use super::free_beat::{level, scales};
use super::trim::WakeTrim;
use crate::AnalysisError;
use crate::beat::Beat;
use crate::beat::level::{Level, Perturbation};
use crate::progress;
use crate::stability::derivatives::{Control, ControlDerivative, differences};
use crate::stability::eigen::eigen;
use crate::stability::jacobian::jacobian;
use crate::stability::modes::ModeSet;
use crate::stability::rigid_body::RigidBody;
use crate::stability::steady::SteadyFlight;
use crate::stability::{LinearModel, inputs_of, over_ground};

/// Disturbances over natural sizes \[1\].
const PART: f64 = 1e-2;

/// Steps of the table in which a rigid body without air is laid out; nothing of it moves.
const STEPS: usize = 4;

/// The rigid body of a glider that was trimmed in air with wakes, under the derivatives of its steady loads.
///
/// # Errors
/// A flight that beats, bends, or has no wakes in space; what the tows report.
pub fn steady_model(trim: &WakeTrim) -> Result<LinearModel, AnalysisError> {
    let flight = steady_flight(trim)?;
    let (level, sizes) = (flight.level, scales(&trim.setup));
    let stream = level.to_n.transpose() * stream(&trim.setup);
    let through = Perturbation {
        velocity: flight.through,
        ..Perturbation::default()
    };
    let body = body_of(&flight)?;
    let tow = SteadyTow::of(trim, level);
    let reference = tow.load(through.velocity, None)?;
    let derivatives = tow.derivatives(through.velocity, sizes.velocity, sizes.rate)?;
    let load = |state: &Perturbation| {
        let by = *state - through;
        let by = six(by.velocity, by.rate);
        let change = |i: usize| (0..6).map(|j| derivatives[i][j] * by[j]).sum::<f64>();
        let part = |i: usize| DVec3::new(change(i), change(i + 1), change(i + 2));
        Ok(Wrench {
            force: reference.force + part(0),
            moment: reference.moment + part(3),
        })
    };
    let rates = |x: &[f64]| Ok::<_, AnalysisError>(body.rates(x, load)?.to_vec());
    // As in the averaged model of air without memory.
    let steps = sizes.array().map(|s| 1e-3 * s);
    let matrix = jacobian(rates, &through.to_array(), &steps)?;
    let modes = ModeSet::of_exponents(eigen(&matrix, 9)?, &sizes);
    let weight = body.mass * body.gravity;
    let (size, weights) = (weight.length(), body.weights(DMat3::IDENTITY));
    Ok(LinearModel {
        velocity: flight.through + stream,
        imbalance: [
            (reference.force + weights.force + weight).length() / size,
            (reference.moment + weights.moment).length() / (size * body.length),
        ],
        derivatives,
        added_mass: body.added_mass,
        momentum: body.momentum,
        matrix: over_ground(matrix, stream),
        modes,
    })
}

/// Control derivatives of a glider that was trimmed in air with wakes: loads at the end of tows along the glide with
/// each of its wings steered, and all, by what acts on wings that stand still.
///
/// # Errors
/// As [`steady_model`]; wings that cannot be steered alone.
pub fn steady_controls(trim: &WakeTrim) -> Result<Vec<ControlDerivative>, AnalysisError> {
    let flight = steady_flight(trim)?;
    let tow = SteadyTow::of(trim, flight.level);
    differences(
        &trim.setup,
        &Control::OF_STILL_WINGS,
        PART,
        |setup, wing| {
            let is_uneven = wing.is_some();
            let steered = SteadyTow {
                setup,
                is_uneven,
                ..tow
            };
            steered.load(flight.through, None)
        },
    )
}

/// How [`steady_model`] answers `controls`, as [`input_matrix`](crate::input_matrix) has it.
///
/// # Errors
/// As [`steady_flight`].
pub fn steady_inputs(
    trim: &WakeTrim,
    controls: &[ControlDerivative],
) -> Result<Vec<f64>, AnalysisError> {
    inputs_of(&body_of(&steady_flight(trim)?)?, controls)
}

/// The glide of a flyer that was trimmed in air with wakes.
///
/// # Errors
/// A flight that beats, bends, or has no wakes in space.
pub fn steady_flight(trim: &WakeTrim) -> Result<SteadyFlight<'static>, AnalysisError> {
    let setup = &trim.setup;
    if trim.tow.is_none() || setup.animal.is_elastic() {
        return Err(AnalysisError::not_covered(
            "derivatives by steady tows are those of gliders with rigid wings in air that keeps wakes",
            "see the modes of the flight (`wingbeat stability`), or trim rigid wings in blade elements",
        ));
    }
    let level = level(setup);
    let over = Perturbation {
        velocity: level.to_n.transpose() * trim.velocity,
        ..Perturbation::default()
    };
    let stream = stream(setup);
    Ok(SteadyFlight {
        beat: Cow::Owned(in_vacuum(setup)?),
        attitude: super::free_beat::start(setup).rotation(),
        through: over.relative_to(&level, stream).velocity,
        level,
    })
}

/// The rigid body of a steady flight, its air without mass.
fn body_of(flight: &SteadyFlight<'_>) -> Result<RigidBody, AnalysisError> {
    RigidBody::of(flight.beat(), &flight.level, &Perturbation::default())
}

/// The flyer without air.
fn in_vacuum(setup: &FlightSetup) -> Result<Beat, AnalysisError> {
    let vacuum = FlightSetup {
        air: AirModel::None,
        ..setup.clone()
    };
    Beat::new(&vacuum, STEPS)
}

/// Velocity of the air, N components [m/s].
fn stream(setup: &FlightSetup) -> DVec3 {
    setup.air.stream().unwrap_or(DVec3::ZERO)
}

/// Tows of a glider with constant velocity through the air and angular velocity in axes fixed in it.
#[derive(Clone, Copy)]
struct SteadyTow<'a> {
    setup: &'a FlightSetup,
    /// The hold of the trimmed flight.
    start: &'a StartState,
    level: Level,
    /// Velocity of the air, N components [m/s].
    stream: DVec3,
    /// Axes of the attitude of the hold before its roll, N components: turns about each are those of one Euler angle.
    pitched: DMat3,
    /// Whether one side of the flyer is steered alone.
    is_uneven: bool,
}

impl<'a> SteadyTow<'a> {
    /// That of the flyer as it was trimmed.
    fn of(trim: &'a WakeTrim, level: Level) -> Self {
        let start = super::free_beat::start(&trim.setup);
        Self {
            setup: &trim.setup,
            start,
            level,
            stream: stream(&trim.setup),
            pitched: DMat3::from_rotation_y(start.angles.x),
            is_uneven: false,
        }
    }

    /// The load of the air, about the mass centre, at the end of the tow with `velocity` through the air and a turn about
    /// one of the axes by a rate [rad/s]: level components.
    fn load(&self, velocity: DVec3, turn: Option<(usize, f64)>) -> Result<Wrench, AnalysisError> {
        let (start, steps) = (self.start, self.start.held_steps);
        let mut setup = self.setup.clone();
        let is_lateral =
            self.is_uneven || velocity.y != 0.0 || turn.is_some_and(|(axis, _)| axis != 1);
        if let (AirModel::VortexLattice(air), true) = (&mut setup.air, is_lateral) {
            air.mirror = false; // right and left part
        }
        let through = self.level.to_n * velocity;
        let mut motion =
            PrescribedMotion::straight(DVec3::ZERO, self.stream + through, start.angles);
        if let Some((axis, rate)) = turn.filter(|t| t.1 != 0.0) {
            // Euler angles are pitch, yaw, roll.
            motion.angles[[2, 0, 1][axis]].rate = rate;
            self.bend(&mut motion, through, self.pitched.col(axis) * rate)?;
        }
        setup.mode = MotionMode::Tethered(motion);
        setup.time.steps = steps;
        let mut flight = Simulation::new(setup)?;
        for _ in 0..steps {
            flight.step()?;
        }
        let record = flight.record();
        let load = about_mass_centre(record);
        let back =
            self.level.to_n.transpose() * start.rotation() * record.root_rotation().transpose();
        Ok(Wrench {
            force: back * load.force,
            moment: back * load.moment,
        })
    }

    /// Bends the way of the root so that the mass centre keeps its velocity `through` the air in axes that turn by `rate`
    /// [rad/s], N components.
    fn bend(
        &self,
        motion: &mut PrescribedMotion,
        through: DVec3,
        rate: DVec3,
    ) -> Result<(), AnalysisError> {
        let omega = rate.length();
        let axis = rate / omega;
        let along = through.dot(axis) * axis;
        let across = through - along;
        // The mass centre goes round, and the root about it, from the origin on.
        let centre = self.start.rotation() * in_vacuum(self.setup)?.mean_centre();
        let arm = centre - centre.dot(axis) * axis;
        let sine = across / omega - axis.cross(arm);
        let cosine = -axis.cross(across) / omega - arm;
        let drift = (self.stream + along).to_array();
        for (k, x) in motion.position.iter_mut().enumerate() {
            x.constant = -cosine[k];
            x.rate = drift[k];
            x.frequency = omega / TAU;
            x.cosine = vec![cosine[k]];
            x.sine = vec![sine[k]];
        }
        Ok(())
    }

    /// Derivatives of (X, Y, Z, L, M, N) by (u, v, w, p, q, r) about a flight with `velocity` through the air, level axes,
    /// by differences over parts of these sizes of velocity [m/s] and rate [rad/s].
    fn derivatives(
        &self,
        velocity: DVec3,
        speed: f64,
        rate: f64,
    ) -> Result<SixBySix, AnalysisError> {
        let mut columns = [[0.0; 6]; 6];
        let axes = self.level.to_n.transpose() * self.pitched;
        for k in 0..6 {
            progress::task("derivatives by tows", k, 6);
            let by = PART * [speed, rate][k / 3];
            let at = |s: f64| match k {
                0..3 => self.load(velocity + s * by * DVec3::AXES[k], None),
                _ => self.load(velocity, Some((k - 3, s * by))),
            };
            let (plus, minus) = (at(1.0)?, at(-1.0)?);
            let half = 0.5 / by;
            let slope = six(
                half * (plus.force - minus.force),
                half * (plus.moment - minus.moment),
            );
            match k {
                0..3 => columns[k] = slope,
                // Of an axis that is not one of the level frame each has its share.
                _ => (0..3).for_each(|j| {
                    let share = axes.col(k - 3)[j];
                    let of = columns[3 + j].iter_mut().zip(slope);
                    of.for_each(|(sum, s)| *sum += share * s);
                }),
            }
        }
        Ok(from_entries(|i, j| columns[j][i]))
    }
}

/// The load of the air on all bodies about the mass centre, N components.
fn about_mass_centre(record: &Record) -> Wrench {
    let mut sum = Wrench::default();
    for (load, place) in record.air.iter().zip(record.coordinates.chunks_exact(6)) {
        let arm = DVec3::from_slice(place) - record.mass_centre;
        sum.force += load.force;
        sum.moment += load.moment + arm.cross(load.force);
    }
    sum
}
