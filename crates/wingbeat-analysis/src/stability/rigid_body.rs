//! The rigid body of the averaged model: Newton's and Euler's laws with the added mass of the air and the
//! angular momentum of the beating wings.

use wingbeat_math::six_by_six::symmetric_part;
use wingbeat_math::{DMat3, DQuat, DVec3, SixBySix, Wrench, six, solve_small};

use crate::AnalysisError;
use crate::beat::Beat;
use crate::beat::level::{Level, Perturbation};

/// What the equations of a rigid aircraft need; axes fixed in the body, level in the reference attitude.
#[derive(Clone, Debug)]
pub(crate) struct RigidBody {
    pub(crate) mass: f64,
    /// About the mass centre.
    pub(crate) inertia: DMat3,
    /// In the reference attitude.
    pub(crate) gravity: DVec3,
    /// Buoyancy and other constant loads along gravity: of each the point from the mass centre \[m\], and the force in the
    /// reference attitude \[N\].
    pub(crate) weights: Vec<[DVec3; 2]>,
    /// Mean angular momentum of the wings seen from the body [kg m2/s].
    pub(crate) momentum: DVec3,
    /// Force and moment that the air takes for rates of the velocity through it and of the angular velocity,
    /// SI, 6 x 6 by rows.
    pub(crate) added_mass: SixBySix,
    /// By which forces and moments are compared [m].
    pub(crate) length: f64,
}

impl RigidBody {
    /// That of the wingbeat `beat` about the steady flight `reference`: its mean mass properties, and the mean
    /// answer of its air.
    ///
    /// # Errors
    /// What the air reports.
    pub(crate) fn of(
        beat: &Beat,
        level: &Level,
        reference: &Perturbation,
    ) -> Result<Self, AnalysisError> {
        let to_level = level.to_root.transpose();
        let weight =
            |[point, force]: [DVec3; 2]| [to_level * point, level.to_n.transpose() * force];
        Ok(Self {
            mass: beat.mass(),
            inertia: to_level * beat.mean_inertia() * level.to_root,
            gravity: level.to_n.transpose() * beat.gravity(),
            weights: beat.mean_weights().into_iter().map(weight).collect(),
            momentum: to_level * beat.mean_momentum(),
            added_mass: added_mass(beat, level, reference)?,
            length: beat.wing_length(),
        })
    }

    /// Rates of the nine components of [`Perturbation`], its velocity that through the air, under the air's
    /// `load(state)`, that of a velocity through the air and a rate which do not change.
    pub(crate) fn rates(
        &self,
        x: &[f64],
        load: impl Fn(&Perturbation) -> Result<Wrench, AnalysisError>,
    ) -> Result<[f64; 9], AnalysisError> {
        let state = Perturbation::from_array(x.try_into().expect("nine components"));
        let (w, j) = (state.rate, self.inertia);
        let back = DMat3::from_quat(DQuat::from_scaled_axis(state.tilt)).transpose();
        let (load, weights) = (load(&state)?, self.weights(back));
        let [velocity, rate] = self.accelerations(&Wrench {
            force: load.force
                + weights.force
                + self.mass * (back * self.gravity - w.cross(state.velocity)),
            moment: load.moment + weights.moment - w.cross(j * w + self.momentum),
        })?;
        // To first order in tilt and rate the rotation vector changes at the rate w.
        let rates = Perturbation {
            velocity,
            rate,
            tilt: w,
        };
        Ok(rates.to_array())
    }

    /// Buoyancy and other constant loads along gravity in all, about the mass centre, in the attitude that `back` turns
    /// from the reference to.
    pub(crate) fn weights(&self, back: DMat3) -> Wrench {
        let mut sum = Wrench::default();
        for [point, force] in &self.weights {
            let force = back * *force;
            sum.force += force;
            sum.moment += point.cross(force);
        }
        sum
    }

    /// Linear and angular acceleration under these loads.
    ///
    /// # Errors
    /// Masses that are none.
    pub(crate) fn accelerations(&self, load: &Wrench) -> Result<[DVec3; 2], AnalysisError> {
        // Moments and angles by the length: all numbers are of one size.
        let scale = |i: usize| if i < 3 { 1.0 } else { self.length };
        let own = |i: usize, j: usize| match (i < 3, j < 3) {
            (true, true) if i == j => self.mass,
            (false, false) => self.inertia.col(j - 3)[i - 3],
            _ => 0.0,
        };
        let entry = |k: usize| {
            let (i, j) = (k / 6, k % 6);
            (own(i, j) + self.added_mass[i][j]) / (scale(i) * scale(j))
        };
        let mut a: [f64; 36] = std::array::from_fn(entry);
        let mut x = six(load.force, load.moment / self.length);
        solve_small(&mut a, &mut x).map_err(|e| AnalysisError::Numbers(e.to_string()))?;
        Ok([
            DVec3::from_slice(&x),
            DVec3::from_slice(&x[3..]) / self.length,
        ])
    }
}

/// What mean loads are smaller by for rates of each of (u, v, w, p, q, r).
fn added_mass(
    beat: &Beat,
    level: &Level,
    reference: &Perturbation,
) -> Result<SixBySix, AnalysisError> {
    let load = |rates: [DVec3; 2]| beat.changing_load(level, reference, rates);
    let still = load([DVec3::ZERO; 2])?;
    // Loads are linear in accelerations: any step will do that rounding does not see.
    let angular = (std::f64::consts::TAU / beat.period()).powi(2);
    let steps = [angular * beat.wing_length(), angular];
    let mut mass = [[0.0; 6]; 6];
    for j in 0..6 {
        let mut rates = [DVec3::ZERO; 2];
        rates[j / 3][j % 3] = steps[j / 3];
        let load = load(rates)?;
        let change = [still.force - load.force, still.moment - load.moment];
        for (i, row) in mass.iter_mut().enumerate() {
            row[j] = change[i / 3][i % 3] / steps[j / 3];
        }
    }
    // Symmetric but for rounding, as energy asks.
    Ok(symmetric_part(&mass))
}
