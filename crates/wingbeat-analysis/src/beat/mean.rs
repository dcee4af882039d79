//! Loads averaged over a beat while the body moves steadily.

use wingbeat_dynamics::{BodyAcceleration, BodyMotion, Wrench};
use wingbeat_flight::AppliedLoad;
use wingbeat_math::{DMat3, DQuat, DVec3};

use crate::AnalysisError;
use crate::beat::Beat;
use crate::beat::level::{Level, Perturbation};

impl Beat {
    /// Mean mass centre over the beat, root components [m].
    pub fn mean_centre(&self) -> DVec3 {
        let sum: DVec3 = self.configurations().map(|(_, whole)| whole.c).sum();
        sum / (2 * self.steps()) as f64
    }

    /// Mean inertia of the whole about the mean mass centre, root components [kg m2].
    pub fn mean_inertia(&self) -> DMat3 {
        let centre = self.mean_centre();
        let mut sum = DMat3::ZERO;
        for (_, whole) in self.configurations() {
            let t = wingbeat_math::tilde(whole.c - centre);
            sum += whole.inertia + t.transpose() * t * self.mass();
        }
        sum * (1.0 / (2 * self.steps()) as f64)
    }

    /// An error if loads cannot be averaged over this beat.
    ///
    /// # Errors
    /// Names the first joint that moves freely: how bodies move while the root moves steadily is then not known
    /// beforehand.
    pub fn check_averaged(&self) -> Result<(), AnalysisError> {
        let system = self.flight().system();
        let mut hinges = system.hinges().iter().zip(system.offsets());
        match hinges.find(|(_, offsets)| offsets.speeds > 0) {
            None => Ok(()),
            Some((hinge, _)) => Err(AnalysisError::not_covered(
                format!(
                    "joint `{}` moves freely, and loads averaged over a wingbeat need motions that are known beforehand",
                    hinge.name
                ),
                "Floquet's modes carry free joints along (`wingbeat stability` without --write); or prescribe the joint's motion",
            )),
        }
    }

    /// Mean angular momentum about the mass centre of the motion seen from the root, root components [kg m2/s]: that of
    /// wings whose strokes draw loops.
    pub fn mean_momentum(&self) -> DVec3 {
        let sum: DVec3 = self.configurations().map(|(_, whole)| whole.h).sum();
        sum / (2 * self.steps()) as f64
    }

    /// Buoyancy and other constant loads along gravity as the steady body of the mean mass properties feels them: of each
    /// the mean point of application from the mean mass centre, root components \[m\], and the force, N components \[N\].
    pub fn mean_weights(&self) -> Vec<[DVec3; 2]> {
        let centre = self.mean_centre();
        let mut motions = vec![BodyMotion::REST; self.flight().system().bodies().len()];
        let mut sums = vec![DVec3::ZERO; self.weights.len()];
        for (configuration, _) in self.configurations() {
            configuration.motions(&BodyMotion::REST, &mut motions);
            for (sum, load) in sums.iter_mut().zip(&self.weights) {
                let body = &motions[load.body];
                *sum += body.p + body.r * load.point;
            }
        }
        let n = (2 * self.steps()) as f64;
        let force = |load: &AppliedLoad| load.wrench(0.0, &BodyMotion::REST).force;
        let of = |(sum, load): (DVec3, &AppliedLoad)| [sum / n - centre, force(load)];
        sums.into_iter().zip(&self.weights).map(of).collect()
    }

    /// Mean air load when the mean mass centre moves with `velocity` [m/s] and the body turns with `rate`
    /// [rad/s], the rate and the velocity through the air steady in the level frame that turns with the body:
    /// components of that frame, the moment about the mean mass centre. Equal weights over the beat: spectrally
    /// accurate for a periodic motion.
    ///
    /// # Errors
    /// Free joints, whose motion is not known beforehand; what the air reports.
    pub fn mean_load(
        &self,
        level: &Level,
        velocity: DVec3,
        rate: DVec3,
    ) -> Result<Wrench, AnalysisError> {
        let state = Perturbation {
            velocity,
            rate,
            tilt: DVec3::ZERO,
        };
        self.changing_load(level, &state, [DVec3::ZERO; 2])
    }

    /// The same in a tilted attitude, and while the velocity through the air changes by `rates[0]` [m/s2] and
    /// the rate by `rates[1]` [rad/s2]: components of the level frame that turns and is tilted with the body,
    /// the load's too.
    pub(crate) fn changing_load(
        &self,
        level: &Level,
        state: &Perturbation,
        rates: [DVec3; 2],
    ) -> Result<Wrench, AnalysisError> {
        self.check_averaged()?;
        let system = self.flight().system();
        let centre = self.mean_centre();
        let tilted = level.to_n * DMat3::from_quat(DQuat::from_scaled_axis(state.tilt));
        let r = tilted * level.to_root.transpose();
        let (v, w) = (tilted * state.velocity, level.to_root * state.rate);
        let root = BodyMotion {
            p: DVec3::ZERO,
            r,
            v: v - r * w.cross(centre),
            w,
        };
        let [linear, angular] = rates.map(|x| level.to_root * x);
        let steady = w.cross(r.transpose() * (root.v - self.stream()));
        let turning = BodyAcceleration {
            linear: r * (steady + linear - angular.cross(centre)),
            angular,
        };
        let bodies = system.bodies().len();
        let mut motions = vec![BodyMotion::REST; bodies];
        let mut accelerations = vec![BodyAcceleration::default(); bodies];
        let mut scratch = self.flight().air().scratch();
        let (mut force, mut moment) = (DVec3::ZERO, DVec3::ZERO);
        for (k, (configuration, _)) in self.configurations().enumerate() {
            configuration.motions(&root, &mut motions);
            configuration.accelerations(&root, &turning, &mut accelerations);
            let t = k as f64 * self.half_step();
            let loads = (self.flight()).air_loads(t, &motions, &accelerations, &mut scratch)?;
            for (load, m) in loads.iter().zip(&motions) {
                force += load.force;
                moment += load.moment + (m.p - r * centre).cross(load.force);
            }
        }
        let n = (2 * self.steps()) as f64;
        let to_level = tilted.transpose() / n;
        Ok(Wrench {
            force: to_level * force,
            moment: to_level * moment,
        })
    }
}
