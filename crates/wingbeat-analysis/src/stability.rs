//! Linear models of flight: averaged over the beat, and Floquet's.

use wingbeat_math::{DMat3, DQuat, DVec3, r3};

use crate::AnalysisError;
use crate::beat::{Beat, JOINTS, State};
use crate::derivatives::ControlDerivative;
use crate::eigen::eigen;
use crate::level::{Level, Perturbation};
use crate::mean::MeanLoad;
use crate::modes::{ModeSet, Scales};
use crate::monodromy::monodromy;
use crate::trim::Trim;

/// Names of the six loads.
pub const LOADS: [&str; 6] = ["X", "Y", "Z", "L", "M", "N"];

/// The cycle-averaged linear model about a reference flight: a rigid body of the mean mass
/// properties under the mean air loads of a beat.
#[derive(Clone, Debug)]
pub struct LinearModel {
    /// Rates of (u, v, w, p, q, r, phi, theta, psi), 9 x 9 by rows [SI: m, s, rad].
    pub matrix: Vec<f64>,
    /// Derivatives of (X, Y, Z, L, M, N) by (u, v, w, p, q, r), 6 x 6 by rows [SI: N, m, s, rad].
    pub derivatives: [[f64; 6]; 6],
    /// Modes.
    pub modes: ModeSet,
}

/// The natural sizes of perturbations of a beat.
fn scales(beat: &Beat) -> Scales {
    Scales {
        velocity: beat.wing_length() / beat.period(),
        rate: 1.0 / beat.period(),
        period: beat.period(),
    }
}

/// The cycle-averaged model about steady flight with the attitude and mean velocity of the
/// periodic orbit through `state`.
///
/// # Errors
/// Numbers that are not finite.
pub fn linear_model(beat: &Beat, state: &State) -> Result<LinearModel, AnalysisError> {
    let level = Level::new(beat.root(state).r, beat.gravity());
    let end = beat.advance(state)?;
    let travelled = DVec3::from_slice(&end) - DVec3::from_slice(state);
    let velocity = level.to_n.transpose() * travelled / beat.period();
    let reference = Perturbation {
        velocity,
        ..Perturbation::default()
    };
    let size = scales(beat);
    let f = |x: &[f64]| -> Result<Vec<f64>, AnalysisError> {
        Ok(averaged_rates(beat, &level, x)?.to_vec())
    };
    // Mean loads are smooth: steps of 1e-3 of the natural sizes, error of the formula 1e-12.
    let steps = size.array().map(|s| 1e-3 * s);
    let matrix = monodromy(f, &reference.to_array(), &steps)?;
    let modes = ModeSet::of_exponents(eigen(&matrix, 9)?, &size);
    Ok(LinearModel {
        derivatives: load_derivatives(beat, &level, &reference, &steps)?,
        matrix,
        modes,
    })
}

/// Newton's and Euler's laws for the mean rigid body in the level frame that turns with it.
fn averaged_rates(beat: &Beat, level: &Level, x: &[f64]) -> Result<[f64; 9], AnalysisError> {
    let body = RigidBody {
        mass: beat.mass(),
        inertia: level.to_root.transpose() * beat.mean_inertia() * level.to_root,
        gravity: level.to_n.transpose() * beat.gravity(),
        stream: level.to_n.transpose() * beat.stream(),
    };
    body.rates(x, |v, w| beat.mean_load(level, v, w))
}

/// What the equations of a rigid aircraft need; axes fixed in the body, level in the reference
/// attitude.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RigidBody {
    pub(crate) mass: f64,
    /// About the mass centre.
    pub(crate) inertia: DMat3,
    /// In the reference attitude.
    pub(crate) gravity: DVec3,
    /// Velocity of the undisturbed air in the reference attitude.
    pub(crate) stream: DVec3,
}

impl RigidBody {
    /// Rates of the nine components of [`Perturbation`] under the air's `load(velocity, rate)` in the reference attitude: in
    /// another the stream comes from elsewhere, as if the body moved otherwise through that of the reference.
    pub(crate) fn rates<E>(
        &self,
        x: &[f64],
        load: impl Fn(DVec3, DVec3) -> Result<MeanLoad, E>,
    ) -> Result<[f64; 9], E> {
        let state = Perturbation::from_array(x.try_into().expect("nine components"));
        let (v, w, j) = (state.velocity, state.rate, self.inertia);
        let tilt = DMat3::from_quat(DQuat::from_scaled_axis(state.tilt));
        let load = load(v + (self.stream - tilt.transpose() * self.stream), w)?;
        // To first order in tilt and rate the rotation vector changes at the rate w.
        let rates = Perturbation {
            velocity: load.force / self.mass + tilt.transpose() * self.gravity - w.cross(v),
            rate: j.inverse() * (load.moment - w.cross(j * w)),
            tilt: w,
        };
        Ok(rates.to_array())
    }
}

/// How the averaged model about the flight through `state` answers controls: derivatives of the rates of (u, v, w, p,
/// q, r, phi, theta, psi) by each of `controls`, by rows, 9 x their number.
///
/// `d(u, v, w)' = dF / m`, `d(p, q, r)' = J^-1 dM`, J the mean inertia about the mean mass centre, level frame: the
/// input matrix B beside [`LinearModel::matrix`].
pub fn input_matrix(beat: &Beat, state: &State, controls: &[ControlDerivative]) -> Vec<f64> {
    let level = Level::new(beat.root(state).r, beat.gravity());
    let inertia = level.to_root.transpose() * beat.mean_inertia() * level.to_root;
    let n = controls.len();
    let mut b = vec![0.0; 9 * n];
    for (k, control) in controls.iter().enumerate() {
        let load = &control.derivative;
        let rates = Perturbation {
            velocity: load.force / beat.mass(),
            rate: inertia.inverse() * load.moment,
            tilt: DVec3::ZERO,
        };
        let column = rates.to_array();
        (0..9).for_each(|i| b[i * n + k] = column[i]);
    }
    b
}

/// Derivatives of the mean loads by velocities and rates.
fn load_derivatives(
    beat: &Beat,
    level: &Level,
    reference: &Perturbation,
    steps: &[f64; 9],
) -> Result<[[f64; 6]; 6], AnalysisError> {
    let f = |x: &[f64]| -> Result<Vec<f64>, AnalysisError> {
        let load = beat.mean_load(level, DVec3::from_slice(x), DVec3::from_slice(&x[3..]))?;
        let (f, m) = (load.force, load.moment);
        Ok(vec![f.x, f.y, f.z, m.x, m.y, m.z])
    };
    let d = monodromy(f, &reference.to_array()[..6], &steps[..6])?;
    Ok(std::array::from_fn(|i| {
        std::array::from_fn(|j| d[6 * i + j])
    }))
}

/// The monodromy matrix of the periodic orbit through `state`: the nine components of
/// [`Perturbation`] (position left out, for the flight is the same everywhere), then the coordinates and
/// speeds of the free joints. A spherical joint's quaternion adds a multiplier of zero: its length is
/// none of the flight's.
///
/// # Errors
/// Numbers that are not finite.
pub fn orbit_monodromy(beat: &Beat, state: &State) -> Result<Vec<f64>, AnalysisError> {
    turning_monodromy(beat, state, 0.0)
}

/// The same of an orbit that has turned by `turned` \[rad\] about n3 after a beat, seen from axes that turn with it.
fn turning_monodromy(beat: &Beat, state: &State, turned: f64) -> Result<Vec<f64>, AnalysisError> {
    let level = Level::new(beat.root(state).r, beat.gravity());
    let ahead = Level {
        to_n: r3(turned) * level.to_n,
        ..level
    };
    let seen = |level: &Level, y: &[f64]| {
        let mut x = Perturbation::of(beat, level, y).to_array().to_vec();
        x.extend_from_slice(&y[JOINTS..]);
        x
    };
    let map = |x: &[f64]| -> Result<Vec<f64>, AnalysisError> {
        let start = Perturbation::from_array(x[..9].try_into().expect("nine components"));
        let end = beat.advance(&start.state(beat, &level, &x[9..]))?;
        Ok(seen(&ahead, &end))
    };
    let x = seen(&level, state);
    let steps: Vec<f64> = orbit_scales(beat).iter().map(|s| 1e-4 * s).collect();
    monodromy(map, &x, &steps)
}

/// Natural sizes of the components of the orbit's perturbations.
fn orbit_scales(beat: &Beat) -> Vec<f64> {
    let mut sizes = scales(beat).array().to_vec();
    sizes.extend_from_slice(beat.joint_sizes());
    sizes
}

/// Floquet's modes of the periodic orbit through `state`: exponents `ln(multiplier) / T` (principal
/// branch: periods below two wingbeats cannot be told from slower ones).
///
/// # Errors
/// Numbers that are not finite.
pub fn floquet(beat: &Beat, state: &State) -> Result<ModeSet, AnalysisError> {
    multiplied(beat, &orbit_monodromy(beat, state)?)
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
