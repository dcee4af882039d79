//! Loads averaged over a beat while the body moves steadily.

use wingbeat_blade::FrameAcceleration;
use wingbeat_math::{DMat3, DVec3};

use crate::beat::Beat;
use crate::level::Level;

/// Mean force and moment of the air over a beat, components of the level frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeanLoad {
    /// Force X, Y, Z \[N\].
    pub force: DVec3,
    /// Moment L, M, N about the mean mass centre [N m].
    pub moment: DVec3,
}

impl Beat {
    /// Mean mass centre over the beat, root components [m].
    pub fn mean_centre(&self) -> DVec3 {
        let sum: DVec3 = self.cycle().iter().map(|at| at.c).sum();
        sum / self.cycle().len() as f64
    }

    /// Mean inertia of the whole about the mean mass centre, root components [kg m2].
    pub fn mean_inertia(&self) -> DMat3 {
        let centre = self.mean_centre();
        let n = self.cycle().len() as f64;
        let mut sum = DMat3::ZERO;
        for at in self.cycle() {
            let t = wingbeat_math::tilde(at.c - centre);
            sum += at.inertia + t.transpose() * t * self.mass;
        }
        sum * (1.0 / n)
    }

    /// Mean air load when the mean mass centre moves with `velocity` [m/s] and the body turns with
    /// `rate` [rad/s], both steady in the level frame that turns with the body. Equal weights over
    /// the beat: spectrally accurate for a periodic motion.
    pub fn mean_load(&self, level: &Level, velocity: DVec3, rate: DVec3) -> MeanLoad {
        let centre = self.mean_centre();
        let (v, w) = (level.to_root * velocity, level.to_root * rate);
        let origin = v - w.cross(centre);
        let stream = |s: DVec3| level.to_root * (level.to_n.transpose() * s);
        let (mut force, mut moment) = (DVec3::ZERO, DVec3::ZERO);
        for at in self.cycle() {
            for (wing, p) in self.wings.iter().zip(&at.wings) {
                let frame = p.frame(origin - stream(self.stream_wings), w);
                let seen = p.rotation.transpose() * w;
                let acc = FrameAcceleration {
                    linear: w.cross(origin)
                        + w.cross(w.cross(p.d))
                        + 2.0 * w.cross(p.d_dot)
                        + p.d_ddot,
                    angular: p.turn - p.rate.cross(seen),
                };
                let load = wing.load(&frame, &acc);
                let f = p.rotation * load.force;
                force += f;
                moment += p.rotation * load.moment + (p.d - centre).cross(f);
            }
        }
        let n = self.cycle().len() as f64;
        (force, moment) = (force / n, moment / n);
        if let Some((drag, density)) = &self.drag {
            let f = drag.force(*density, origin - stream(self.stream_body));
            force += f;
            moment -= centre.cross(f);
        }
        let to_level = level.to_root.transpose();
        MeanLoad {
            force: to_level * force,
            moment: to_level * moment,
        }
    }
}
