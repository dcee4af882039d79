//! Linear models of flight: averaged over the beat, and Floquet's.

pub(crate) mod derivatives;
pub(crate) mod disturbance;
pub(crate) mod eigen;
pub(crate) mod jacobian;
pub(crate) mod modes;
pub(crate) mod rigid_body;
pub(crate) mod steady;
pub(crate) mod table;
mod welded;

use wingbeat_math::six_by_six::from_entries;
use wingbeat_math::{DMat3, DVec3, SixBySix, r3, six};

use crate::AnalysisError;
use crate::beat::level::{Level, Perturbation};
use crate::beat::{Beat, JOINTS, State};
use crate::stability::derivatives::{ControlDerivative, control_derivatives};
use crate::stability::eigen::eigen;
use crate::stability::jacobian::jacobian;
use crate::stability::modes::{ModeSet, Scales};
use crate::stability::rigid_body::RigidBody;
use crate::trim::Trim;

/// Names of the six loads.
pub const LOADS: [&str; 6] = ["X", "Y", "Z", "L", "M", "N"];

/// The cycle-averaged linear model about a reference flight: a rigid body of the mean mass
/// properties under the mean air loads of a beat.
#[derive(Clone, Debug)]
pub struct LinearModel {
    /// Mean velocity of the flight over the ground, level frame [m/s]: its angular velocity and tilt are 0.
    pub velocity: DVec3,
    /// Rates of (u, v, w, p, q, r, phi, theta, psi), 9 x 9 by rows [SI: m, s, rad].
    pub matrix: Vec<f64>,
    /// Derivatives of (X, Y, Z, L, M, N) by (u, v, w, p, q, r), 6 x 6 by rows [SI: N, m, s, rad].
    pub derivatives: SixBySix,
    /// Added mass of the air: derivatives of (X, Y, Z, L, M, N), reversed, by the rates of (u, v, w, p, q, r)
    /// through the air, 6 x 6 by rows [SI: N, m, s, rad].
    pub added_mass: SixBySix,
    /// Mean angular momentum of the beating wings seen from the body, level frame [kg m2/s].
    pub momentum: DVec3,
    /// What the mean loads of the steady body lack to balance: force over the weight, moment over the weight
    /// and the wing length \[1\]. The free wingbeat is in balance; where this is not small, so much moves
    /// within a beat that averages say little.
    pub imbalance: [f64; 2],
    /// Modes, their velocities those through the air: in a stream they are those of still air.
    pub modes: ModeSet,
}

impl LinearModel {
    /// How far behind the mass centre the lift acts that a change of incidence adds, M_w / Z_w \[m\]: the neutral point of
    /// a glider, whose static margin it is over the chord.
    pub fn neutral_point(&self) -> f64 {
        self.derivatives[4][2] / self.derivatives[2][2]
    }
}

/// The natural sizes of perturbations of a beat.
fn scales(beat: &Beat) -> Scales {
    Scales::new(beat.wing_length(), beat.period())
}

/// The steady flight with the mean attitude and velocity of the orbit through `state`.
///
/// # Errors
/// Numbers that are not finite.
pub(crate) fn reference(
    beat: &Beat,
    state: &State,
) -> Result<(Level, Perturbation), AnalysisError> {
    let level = Level::new(beat.mean_attitude(state)?, beat.gravity());
    let end = beat.advance(state)?;
    let travelled = DVec3::from_slice(&end) - DVec3::from_slice(state);
    let steady = Perturbation {
        velocity: level.to_n.transpose() * travelled / beat.period(),
        ..Perturbation::default()
    };
    Ok((level, steady))
}

/// The cycle-averaged model about steady flight with the mean attitude and mean velocity of the
/// periodic orbit through `state`.
///
/// # Errors
/// Numbers that are not finite.
pub fn linear_model(beat: &Beat, state: &State) -> Result<LinearModel, AnalysisError> {
    let (level, reference) = reference(beat, state)?;
    let size = scales(beat);
    let body = RigidBody::of(beat, &level, &reference)?;
    let stream = beat.stream();
    let f = |x: &[f64]| -> Result<Vec<f64>, AnalysisError> {
        let rates = body.rates(x, |through| {
            let state = through.moved(&level, stream);
            beat.changing_load(&level, &state, [DVec3::ZERO; 2])
        })?;
        Ok(rates.to_vec())
    };
    // Mean loads are smooth: steps of 1e-3 of the natural sizes, error of the formula 1e-12.
    let steps = size.array().map(|s| 1e-3 * s);
    let through = reference.relative_to(&level, stream);
    let matrix = jacobian(f, &through.to_array(), &steps)?;
    let modes = ModeSet::of_exponents(eigen(&matrix, 9)?, &size);
    let matrix = over_ground(matrix, level.to_n.transpose() * stream);
    let load = beat.changing_load(&level, &reference, [DVec3::ZERO; 2])?;
    let weight = body.mass * body.gravity;
    let (size, weights) = (weight.length(), body.weights(DMat3::IDENTITY));
    Ok(LinearModel {
        velocity: reference.velocity,
        imbalance: [
            (load.force + weights.force + weight).length() / size,
            (load.moment + weights.moment).length() / (size * beat.wing_length()),
        ],
        derivatives: load_derivatives(beat, &level, &reference, &steps)?,
        added_mass: body.added_mass,
        momentum: body.momentum,
        matrix,
        modes,
    })
}

/// The matrix of a linear map of perturbations and more numbers, velocities over the ground, from that in which they are
/// those through the air: a body tilted in a `stream`, level frame \[m/s\], that goes on through the air as it did, goes
/// on by `stream x tilt` faster over the ground, seen from its axes.
pub(crate) fn over_ground(mut m: Vec<f64>, stream: DVec3) -> Vec<f64> {
    if stream == DVec3::ZERO {
        return m; // to the bit
    }
    let n = m.len().isqrt();
    for j in 0..3 {
        let by_tilt = stream.cross(DVec3::AXES[j]).to_array();
        for (i, by) in by_tilt.into_iter().enumerate() {
            (0..n).for_each(|k| m[n * i + k] += by * m[n * (6 + j) + k]);
        }
    }
    for j in 0..3 {
        let by_tilt = stream.cross(DVec3::AXES[j]).to_array();
        for (i, by) in by_tilt.into_iter().enumerate() {
            (0..n).for_each(|k| m[n * k + 6 + j] -= m[n * k + i] * by);
        }
    }
    m
}

/// Control derivatives about the steady flight with the mean attitude and velocity of a trimmed one.
///
/// # Errors
/// As [`control_derivatives`].
pub fn trimmed_controls(trim: &Trim) -> Result<Vec<ControlDerivative>, AnalysisError> {
    let attitude = trim.beat.mean_attitude(&trim.state)?;
    let level = Level::new(attitude, trim.beat.gravity());
    let velocity = level.to_n.transpose() * trim.mean_velocity()?;
    control_derivatives(&trim.setup, attitude, velocity, trim.beat.steps())
}

/// How the averaged model about the flight through `state` answers controls: derivatives of the rates of (u, v, w, p,
/// q, r, phi, theta, psi) by each of `controls`, by rows, 9 x their number.
///
/// Rates are those that the loads give the mean rigid body with the added mass of the air: the input matrix B beside
/// [`LinearModel::matrix`].
///
/// # Errors
/// What the air reports.
pub fn input_matrix(
    beat: &Beat,
    state: &State,
    controls: &[ControlDerivative],
) -> Result<Vec<f64>, AnalysisError> {
    let (level, reference) = reference(beat, state)?;
    inputs_of(&RigidBody::of(beat, &level, &reference)?, controls)
}

/// The same of the averaged model of `body`.
pub(crate) fn inputs_of(
    body: &RigidBody,
    controls: &[ControlDerivative],
) -> Result<Vec<f64>, AnalysisError> {
    let n = controls.len();
    let mut b = vec![0.0; 9 * n];
    for (k, control) in controls.iter().enumerate() {
        let [velocity, rate] = body.accelerations(&control.derivative)?;
        let rates = Perturbation {
            velocity,
            rate,
            tilt: DVec3::ZERO,
        };
        let column = rates.to_array();
        (0..9).for_each(|i| b[i * n + k] = column[i]);
    }
    Ok(b)
}

/// Derivatives of the mean loads by velocities and rates.
fn load_derivatives(
    beat: &Beat,
    level: &Level,
    reference: &Perturbation,
    steps: &[f64; 9],
) -> Result<SixBySix, AnalysisError> {
    let f = |x: &[f64]| -> Result<Vec<f64>, AnalysisError> {
        let load = beat.mean_load(level, DVec3::from_slice(x), DVec3::from_slice(&x[3..]))?;
        Ok(six(load.force, load.moment).to_vec())
    };
    let d = jacobian(f, &reference.to_array()[..6], &steps[..6])?;
    Ok(from_entries(|i, j| d[6 * i + j]))
}

/// The monodromy matrix of the periodic orbit through `state`: the nine components of
/// [`Perturbation`] (position left out, for the flight is the same everywhere), then the coordinates and
/// speeds of the free joints. A spherical joint's quaternion adds a multiplier of zero: its length is
/// none of the flight's.
///
/// # Errors
/// Numbers that are not finite.
pub fn orbit_monodromy(beat: &Beat, state: &State) -> Result<Vec<f64>, AnalysisError> {
    let through = turning_monodromy(beat, state, 0.0)?;
    let stream = Level::of(beat, state).to_n.transpose() * beat.stream();
    Ok(over_ground(through, stream))
}

/// The same with velocities through the air, of an orbit that has turned by `turned` \[rad\] about n3 after a beat, seen
/// from axes that turn with it.
fn turning_monodromy(beat: &Beat, state: &State, turned: f64) -> Result<Vec<f64>, AnalysisError> {
    let level = Level::of(beat, state);
    let ahead = Level {
        to_n: r3(turned) * level.to_n,
        ..level
    };
    let seen = |level: &Level, y: &[f64]| {
        let through = Perturbation::of(beat, level, y).relative_to(level, beat.stream());
        let mut x = through.to_array().to_vec();
        x.extend_from_slice(&y[JOINTS..]);
        x
    };
    let map = |x: &[f64]| -> Result<Vec<f64>, AnalysisError> {
        let start = Perturbation::from_array(x[..9].try_into().expect("nine components"));
        let start = start.moved(&level, beat.stream());
        let end = beat.advance(&start.state(beat, &level, &x[9..]))?;
        Ok(seen(&ahead, &end))
    };
    let x = seen(&level, state);
    let steps: Vec<f64> = orbit_scales(beat).iter().map(|s| 1e-4 * s).collect();
    jacobian(map, &x, &steps)
}

/// Natural sizes of the components of the orbit's perturbations.
fn orbit_scales(beat: &Beat) -> Vec<f64> {
    let mut sizes = scales(beat).array().to_vec();
    sizes.extend_from_slice(beat.joint_sizes());
    sizes
}

/// Floquet's modes of the periodic orbit through `state`: exponents `ln(multiplier) / T` (principal
/// branch: periods below two wingbeats cannot be told from slower ones). Velocities in them are those through the air.
///
/// # Errors
/// Numbers that are not finite.
pub fn floquet(beat: &Beat, state: &State) -> Result<ModeSet, AnalysisError> {
    multiplied(beat, &turning_monodromy(beat, state, 0.0)?)
}

/// Floquet's modes of a trimmed flight, straight or in a steady turn: that is periodic in axes that turn with it.
///
/// # Errors
/// Numbers that are not finite.
pub fn floquet_of_trim(trim: &Trim) -> Result<ModeSet, AnalysisError> {
    let turned = trim.turn_rate * trim.beat.period();
    let m = turning_monodromy(&trim.beat, &trim.state, turned)?;
    multiplied(&trim.beat, &m)
}

fn multiplied(beat: &Beat, m: &[f64]) -> Result<ModeSet, AnalysisError> {
    let n = 9 + beat.joints_at_start().len();
    let pairs = eigen(m, n)?;
    Ok(ModeSet::of_multipliers(
        pairs,
        &scales(beat),
        beat.joint_sizes(),
    ))
}
