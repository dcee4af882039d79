//! Mass matrix, its rate, kinetic energy and the quadratic velocity vector of one body
//! (seed eq. 17-26).

use wingbeat_math::{DMat3, DVec3, Wrench, tilde};

use super::coordinates::BodyKinematics;
use super::forces::generalized_wrench;
use crate::system::body::{Body, weight_wrench};

/// Blocks of the symmetric mass matrix of one body (seed eq. 18), or of its rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MassBlocks {
    /// m^{RR} = `rr` I_3 \[kg\].
    pub rr: f64,
    /// m^{R eta} [kg m].
    pub r_eta: DMat3,
    /// m^{eta eta} [kg m2].
    pub eta_eta: DMat3,
}

impl MassBlocks {
    /// Product with the pair (position part, angle part).
    pub fn times(&self, v: DVec3, eta_dot: DVec3) -> [DVec3; 2] {
        [
            self.rr * v + self.r_eta * eta_dot,
            self.r_eta.transpose() * v + self.eta_eta * eta_dot,
        ]
    }
}

/// Mass matrix (seed eq. 19): m I, -R U G, G^T I G, with U = tilde(S).
pub fn mass_matrix(body: &Body, k: &BodyKinematics) -> MassBlocks {
    let u = tilde(body.mass.first_moment);
    MassBlocks {
        rr: body.mass.mass,
        r_eta: -(k.motion.r * u * k.g),
        eta_eta: k.g.transpose() * body.mass.inertia * k.g,
    }
}

/// Time derivative of the mass matrix (seed eq. 25), with R' = R tilde(w).
pub fn mass_matrix_rate(body: &Body, k: &BodyKinematics) -> MassBlocks {
    let (u, j, r) = (tilde(body.mass.first_moment), body.mass.inertia, k.motion.r);
    let r_dot = r * tilde(k.motion.w);
    MassBlocks {
        rr: 0.0,
        r_eta: -(r_dot * u * k.g) - r * u * k.g_dot,
        eta_eta: k.g_dot.transpose() * j * k.g + k.g.transpose() * j * k.g_dot,
    }
}

/// Derivative of the kinetic energy by the angles at fixed rates (the last terms of seed eq. 26):
/// `-(R^T v) . [g_k x (S x w) + S x (dG/deta_k eta')] + (dG/deta_k eta') . I w`, where g_k is
/// column k of G because dR/deta_k = R tilde(g_k).
pub fn kinetic_energy_gradient(body: &Body, k: &BodyKinematics) -> DVec3 {
    let (s, w) = (body.mass.first_moment, k.motion.w);
    let seen = k.motion.r.transpose() * k.motion.v;
    let (spun, spin) = (s.cross(w), body.mass.inertia * w);
    let slopes = [
        DVec3::ZERO, // G does not depend on the first angle
        k.g_partials[0] * k.eta_dot,
        k.g_partials[1] * k.eta_dot,
    ];
    let entry = |i: usize| {
        let (g, d) = (k.g.col(i), slopes[i]);
        -seen.dot(g.cross(spun) + s.cross(d)) + d.dot(spin)
    };
    DVec3::new(entry(0), entry(1), entry(2))
}

/// Quadratic velocity vector (seed eq. 26): `Q^v = -M' q' + dT/dq`, position and angle part.
pub fn quadratic_velocity(body: &Body, k: &BodyKinematics) -> [DVec3; 2] {
    let [p, h] = mass_matrix_rate(body, k).times(k.motion.v, k.eta_dot);
    [-p, -h + kinetic_energy_gradient(body, k)]
}

/// Mass matrix and right-hand side `Q^v + Q` of one body (seed eq. 21), weight included.
pub fn equations(
    body: &Body,
    k: &BodyKinematics,
    load: &Wrench,
    gravity: DVec3,
) -> (MassBlocks, [DVec3; 2]) {
    let mut applied = *load;
    applied += weight_wrench(body, &k.motion, gravity);
    let (quadratic, forces) = (quadratic_velocity(body, k), generalized_wrench(k, &applied));
    let sum = [quadratic[0] + forces[0], quadratic[1] + forces[1]];
    (mass_matrix(body, k), sum)
}
