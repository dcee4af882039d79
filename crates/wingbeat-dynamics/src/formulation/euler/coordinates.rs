//! Generalized coordinates of a body and what follows from them (seed eq. 2, 3, 14-16).

use wingbeat_math::{BodyMotion, DMat3, DVec3, EulerMatrices};

use crate::{Body, DynamicsError};

/// Coordinates per body: x, y, z, phi, theta, psi (seed eq. 2).
pub const COORDINATES: usize = 6;

/// Least |cos theta| at which the Euler angles are trusted.
pub const REGULARITY_LIMIT: f64 = 0.05;

/// A body's coordinates, their rates, and the matrices that depend on them.
#[derive(Clone, Copy, Debug)]
pub struct BodyKinematics {
    /// Position, rotation, velocity, angular velocity.
    pub motion: BodyMotion,
    /// Euler angles eta \[rad\].
    pub eta: DVec3,
    /// Rates of the Euler angles [rad/s].
    pub eta_dot: DVec3,
    /// G, `w = G eta'` (seed eq. 15).
    pub g: DMat3,
    /// Time derivative of G [1/s].
    pub g_dot: DMat3,
    /// Derivatives of G by the second and third angle.
    pub g_partials: [DMat3; 2],
}

impl BodyKinematics {
    /// From the six coordinates `q` and rates `qd` of the body.
    pub fn new(body: &Body, q: &[f64], qd: &[f64]) -> Self {
        let v = |x: &[f64], i: usize| DVec3::new(x[i], x[i + 1], x[i + 2]);
        let (eta, eta_dot) = (v(q, 3), v(qd, 3));
        let EulerMatrices { r, g, g_partials } = body.sequence.matrices(eta);
        Self {
            motion: BodyMotion {
                p: v(q, 0),
                r,
                v: v(qd, 0),
                w: g * eta_dot,
            },
            eta,
            eta_dot,
            g,
            g_dot: g_partials[0] * eta_dot.y + g_partials[1] * eta_dot.z,
            g_partials,
        }
    }

    /// An error near the singularity of the Euler angles.
    ///
    /// # Errors
    /// [`DynamicsError::Singular`] below [`REGULARITY_LIMIT`].
    pub fn check(&self, body: &Body, time: f64) -> Result<(), DynamicsError> {
        let cosine = body.sequence.regularity(self.eta);
        if cosine >= REGULARITY_LIMIT {
            return Ok(());
        }
        Err(DynamicsError::Singular {
            body: body.name.clone(),
            time,
            theta_deg: self.eta.y.to_degrees(),
            cosine,
            limit: REGULARITY_LIMIT,
        })
    }
}

/// Writes six coordinates (or their rates) of body `i`.
pub(crate) fn write(out: &mut [f64], i: usize, position: DVec3, angles: DVec3) {
    position.write_to_slice(&mut out[COORDINATES * i..]);
    angles.write_to_slice(&mut out[COORDINATES * i + 3..]);
}
