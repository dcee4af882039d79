//! Works and impulses as quadratures that ride along with the motion.

use wingbeat_math::DVec3;

/// Quadratures appended to the state of the core.
pub const QUADRATURES: usize = 14;

/// Which of them are works, and the impulse that is integrated as they are.
pub(crate) const WORKS: [usize; 8] = [0, 1, 2, 9, 10, 11, 12, 13];

/// Works and impulses since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quadratures {
    /// Work of the hinges less the change of the energy relative to the root [J]. What wings on
    /// a fixed root would take up and give back is known in closed form and left out, so that
    /// the quadrature has only the rest to integrate.
    pub hinge_work: f64,
    /// Work of the air on the bodies [J], on their deformation too.
    pub air_work: f64,
    /// Work of applied loads and tether [J], without what a tether spends on the energy of the root alone: that
    /// is known in closed form ([`crate::equations::towed`]). So are the impulses without its momenta.
    pub applied_work: f64,
    /// Impulse of all external forces, weight included, N components [N s].
    pub impulse: DVec3,
    /// Impulse of all external moments about the inertial origin, N components [N m s].
    pub angular_impulse: DVec3,
    /// Work of what deforms the wings against the air [J].
    pub deformation_work: f64,
    /// Energy that dampers and stops of joints took up [J].
    pub dissipated: f64,
    /// Impulse of all external forces, weight included, integrated as the works are, N components [N s]: where
    /// correctors follow the motion to a tolerance, [`Self::impulse`] has the loads of their passes, works those of
    /// the accepted state. Seen from a frame of velocity u, works are less by u times this one.
    pub impulse_of_works: DVec3,
}

impl Quadratures {
    /// Reads the tail of a state vector.
    pub fn from_state(y: &[f64]) -> Self {
        let q = &y[y.len() - QUADRATURES..];
        Self {
            hinge_work: q[0],
            air_work: q[1],
            applied_work: q[2],
            impulse: DVec3::new(q[3], q[4], q[5]),
            angular_impulse: DVec3::new(q[6], q[7], q[8]),
            deformation_work: q[9],
            dissipated: q[10],
            impulse_of_works: DVec3::new(q[11], q[12], q[13]),
        }
    }

    /// Writes the tail of a state vector.
    pub(crate) fn write(&self, y: &mut [f64]) {
        let n = y.len() - QUADRATURES;
        let (f, m) = (self.impulse, self.angular_impulse);
        let w = self.impulse_of_works;
        y[n..].copy_from_slice(&[
            self.hinge_work,
            self.air_work,
            self.applied_work,
            f.x,
            f.y,
            f.z,
            m.x,
            m.y,
            m.z,
            self.deformation_work,
            self.dissipated,
            w.x,
            w.y,
            w.z,
        ]);
    }
}
