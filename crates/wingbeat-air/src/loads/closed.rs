//! Closed surfaces: from the jump across the skin to the pressure of the outer air alone.
//!
//! The rings of a closed skin make a flow inside as well. Inside there is no vorticity and the
//! normal velocity at the skin is the skin's, so its potential is that of a vessel full of fluid. About the centroid X,
//!
//! ```text
//! phi = V . x + 1/2 x . H x        velocity V + H x        x from X
//! ```
//!
//! V is exactly the velocity of the centroid, from the momentum `rho surface-integral x (v . n) dA` of the
//! inner fluid. H, symmetric without trace, is of all quadratic potentials the one nearest in energy (Ritz):
//! with the second moments S of the volume the solution of `int (H_i x) . (H x) dV = surface-integral phi_i (v
//! . n) dA` for the five H_i that span them. For ellipsoids it is the exact flow, whose angular momentum is
//! `rho Vol (b^2 - c^2)^2 / (5 (b^2 + c^2))` times the angular velocity about axis a (Lamb, Hydrodynamics, art. 110);
//! for other shapes it holds somewhat less than there is.
//!
//! The jump of pressure across the skin holds the pressure of the inner fluid, which no real body feels; it is
//! given back:
//!
//! ```text
//! -p = rho (V' . x + 1/2 x . (H' + H H) x) + const
//! ```
//!
//! Rates V', H' are differences over steps with the weights that the rate of the circulation has in the jump:
//! what is added leaves no trace of its own order.
//!
//! Bernoulli's equation is that of irrotational air. In a wind U of vorticity w (a shear, a gust that travels)
//! the body feels the pressure gradient of the wind itself, `rho DU/Dt`, where Bernoulli's equation has
//! `rho (DU/Dt + W x w)`, W the velocity of the wind past the body. What the body does to that vorticity makes
//! the rest a gradient again, to first order in w: a sphere in a shear has the lift `1/2 rho Vol W x w` [Auton
//! 1987, J. Fluid Mech. 183], slender bodies in a gust have the force of its rate. So the outer pressure has
//! besides
//!
//! ```text
//! p = rho (g . x + 1/2 x . G x)        its gradient nearest to W x w in the volume, as H is to the velocity
//! ```
//!
//! with `int w dVol = surface-integral n x U dA`, which knows fronts that jump, too.

use crate::geometry::Panels;
use crate::lattice::Lattice;
use crate::loads::rate::rate_weights;
use crate::loads::values::AirLoads;
use crate::state::{AirState, InnerFlow};
use std::ops::Range;
use wingbeat_math::{DMat3, DVec3, outer, solve_small, tilde, trace};

/// Adds to the panel forces of every closed surface what the inner fluid took, and makes of its pressure jumps
/// ambient less outer pressure: so far as a constant goes by the dynamic pressure of the wind past its centroid,
/// which is that of steady flow.
pub(crate) fn outer_forces(lattice: &Lattice, state: &AirState, out: &mut AirLoads) {
    let rho = lattice.settings().density;
    let weights = rate_weights(lattice, state, out.dt);
    out.inner.clear();
    for (s, surface) in lattice.surfaces().iter().enumerate() {
        if !surface.closed {
            out.inner.push(InnerFlow::REST);
            continue;
        }
        let panels = lattice.panels_of(s);
        let solid = Solid::of(&out.panels, panels.clone());
        let now = solid.inner_flow(rho, &out.panels, panels.clone());
        out.inner.push(now);
        let velocity = now.momentum / (rho * solid.volume);
        let past = lattice.stream(solid.centroid, out.time) - velocity;
        let stagnation = 0.5 * rho * past.length_squared();
        let (mut gradient, mut bend) = (DVec3::ZERO, DMat3::ZERO);
        // Without dGamma/dt the jump holds nothing of the inner fluid.
        if weights[0] != 0.0 {
            let flows = [now, state.inner[s], state.inner_before[s]];
            let mut rate = InnerFlow::REST;
            for (weight, flow) in weights.iter().zip(&flows) {
                rate.momentum += *weight * flow.momentum;
                rate.strain += flow.strain * *weight;
            }
            gradient = rate.momentum / solid.volume;
            bend = (rate.strain + now.strain * now.strain) * (0.5 * rho);
        }
        if !lattice.settings().wind.is_uniform() {
            let lift = solid.lift_of_vorticity(lattice, velocity, out, panels.clone());
            gradient -= rho * lift.0;
            bend -= lift.1 * (0.5 * rho);
        }
        for p in panels {
            let x = out.panels.point[p] - solid.centroid;
            let inner = gradient.dot(x) + x.dot(bend * x);
            out.force[p] += inner * out.panels.vector_area[p];
            out.pressure_jump[p] += inner - stagnation;
        }
    }
}

/// The volume within a closed surface: volume [m3], centroid [m], second moments about it `int x x^T dV` [m5],
/// N components.
struct Solid {
    volume: f64,
    centroid: DVec3,
    moments: DMat3,
}

impl Solid {
    /// By one point on each panel.
    fn of(panels: &Panels, range: Range<usize>) -> Self {
        let middle = mean(&panels.point[range.clone()]);
        // x . n dA is 3, 4, 5 times what a cone from the middle has of volume, first and second moments.
        let cones = |from: DVec3| {
            let cone = move |p: usize| {
                let x = panels.point[p] - from;
                (x, x.dot(panels.vector_area[p]))
            };
            range.clone().map(cone)
        };
        let volume = cones(middle).map(|(_, d)| d / 3.0).sum::<f64>();
        let first: DVec3 = cones(middle).map(|(x, d)| x * (d / 4.0)).sum();
        let centroid = middle + first / volume;
        let second = cones(centroid).map(|(x, d)| outer(x) * (d / 5.0));
        Self {
            volume,
            centroid,
            moments: second.fold(DMat3::ZERO, |sum, m| sum + m),
        }
    }

    fn inner_flow(&self, rho: f64, panels: &Panels, range: Range<usize>) -> InnerFlow {
        let (middle, mean_velocity) = (
            mean(&panels.point[range.clone()]),
            mean(&panels.velocity[range.clone()]),
        );
        // On plane panels `sum x (V . A)` is Vol V only up to the error of the quadrature, which turns with the
        // body: as the rate of a momentum it would be a force that grows with the speed of the observer.
        let flux = range.clone().map(|p| {
            let x = panels.point[p] - middle;
            x * (panels.velocity[p] - mean_velocity).dot(panels.vector_area[p])
        });
        let velocity = mean_velocity + flux.sum::<DVec3>() / self.volume;
        let mut through = [0.0; 5];
        for p in range {
            let x = panels.point[p] - self.centroid;
            let flux = (panels.velocity[p] - velocity).dot(panels.vector_area[p]);
            for (sum, h) in through.iter_mut().zip(&QUADRATICS) {
                *sum += 0.5 * x.dot(*h * x) * flux;
            }
        }
        InnerFlow {
            momentum: rho * self.volume * velocity,
            strain: self.nearest_strain(through),
        }
    }

    /// Of the wind's velocity past the body times its vorticity, `W x w`: the mean [m/s2] and the gradient about
    /// the centroid [1/s2], symmetric without trace, N components. The body has the velocity `velocity` \[m/s\].
    fn lift_of_vorticity(
        &self,
        lattice: &Lattice,
        velocity: DVec3,
        loads: &AirLoads,
        range: Range<usize>,
    ) -> (DVec3, DMat3) {
        let panels = &loads.panels;
        let middle = lattice.stream(self.centroid, loads.time);
        // Integrals over the volume: of the vorticity, of its moments `w x^T`, and of the wind less that at the
        // centroid.
        let (mut vorticity, mut moments) = (DVec3::ZERO, DMat3::ZERO);
        let mut wind = DVec3::ZERO;
        for p in range {
            let x = panels.point[p] - self.centroid;
            let u = lattice.stream(panels.point[p], loads.time) - middle;
            let turn = panels.vector_area[p].cross(u);
            vorticity += turn;
            moments += DMat3::from_cols(turn * x.x, turn * x.y, turn * x.z);
            wind += u * (x.dot(panels.vector_area[p]) / 4.0);
        }
        moments += tilde(wind); // less `e_j x int U dVol` in column j
        let past = middle + wind / self.volume - velocity;
        let lift = tilde(past) * moments;
        let mut along = [0.0; 5];
        for (sum, h) in along.iter_mut().zip(&QUADRATICS) {
            *sum = trace(h.transpose() * lift);
        }
        let mean = past.cross(vorticity) / self.volume;
        (mean, self.nearest_strain(along))
    }

    /// H from `surface-integral phi_i (v . n) dA`; none in a volume without extent in some direction.
    fn nearest_strain(&self, mut through: [f64; 5]) -> DMat3 {
        let product = |i: usize, j: usize| trace(QUADRATICS[i] * self.moments * QUADRATICS[j]);
        let mut energies: [f64; 25] = std::array::from_fn(|k| product(k / 5, k % 5));
        match solve_small(&mut energies, &mut through) {
            Ok(()) => (through.iter().zip(&QUADRATICS)).fold(DMat3::ZERO, |h, (c, q)| h + *q * *c),
            Err(_) => DMat3::ZERO,
        }
    }
}

/// A basis of the symmetric matrices without trace.
const QUADRATICS: [DMat3; 5] = [
    symmetric([0.0; 3], [1.0, 0.0, 0.0]),
    symmetric([0.0; 3], [0.0, 1.0, 0.0]),
    symmetric([0.0; 3], [0.0, 0.0, 1.0]),
    symmetric([1.0, -1.0, 0.0], [0.0; 3]),
    symmetric([0.0, 1.0, -1.0], [0.0; 3]),
];

/// With this diagonal and the entries yz, zx, xy.
const fn symmetric([xx, yy, zz]: [f64; 3], [yz, zx, xy]: [f64; 3]) -> DMat3 {
    DMat3::from_cols(
        DVec3::new(xx, xy, zx),
        DVec3::new(xy, yy, yz),
        DVec3::new(zx, yz, zz),
    )
}

fn mean(of: &[DVec3]) -> DVec3 {
    of.iter().sum::<DVec3>() / of.len() as f64
}
