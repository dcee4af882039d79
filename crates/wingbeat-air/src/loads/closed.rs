//! Closed surfaces: from the jump across the skin to the force of the outer air alone.
//!
//! The rings of a closed skin make a flow inside as well. Inside there is no vorticity and the
//! normal velocity at the skin is the skin's, so the momentum of the inner fluid is exactly
//! `P = rho surface-integral x (v . n) dA`, which for a rigid body is rho x volume x velocity of the
//! centroid. The jump of pressure across the skin holds `-dP/dt` of inner fluid, which no real
//! body feels; it is given back as the pressure field `rho a . x` of a fluid accelerated as a
//! whole, whose resultant is `dP/dt` and which has no moment about the centroid. What is left out
//! is the rate of the inner angular momentum about the centroid: zero for a sphere,
//! `rho Vol (b^2 - c^2)^2 / (5 (b^2 + c^2))` times the angular acceleration about axis a for an
//! ellipsoid (Lamb, Hydrodynamics, art. 110), so below the body's own by the ratio of the
//! densities of air and body, 1e-3 for an insect.

use crate::geometry::Panels;
use crate::lattice::Lattice;
use crate::loads::rate::rate_weights;
use crate::loads::values::AirLoads;
use crate::state::AirState;
use std::ops::Range;
use wingbeat_math::DVec3;

/// Adds to the panel forces of every closed surface what the inner fluid took.
pub(crate) fn outer_forces(lattice: &Lattice, state: &AirState, out: &mut AirLoads) {
    let rho = lattice.settings().density;
    out.inner_momentum.clear();
    for (s, surface) in lattice.surfaces().iter().enumerate() {
        let panels = lattice.panels_of(s);
        if !surface.closed {
            out.inner_momentum.push(DVec3::ZERO);
            continue;
        }
        let (volume, flux) = volume_and_flux(&out.panels, panels.clone());
        let momentum = rho * flux;
        out.inner_momentum.push(momentum);
        if rate_weights(lattice, state, out.dt)[0] == 0.0 {
            continue; // without dGamma/dt the jump holds nothing of the inner fluid
        }
        let gradient = (momentum - state.inner_momentum[s]) / out.dt / volume;
        let centre = mean(&out.panels.point[panels.clone()]);
        for p in panels {
            let pressure = gradient.dot(out.panels.point[p] - centre);
            out.force[p] += pressure * out.panels.vector_area[p];
        }
    }
}

/// Volume Vol [m3] and `surface-integral x (v . n) dA` [m4/s] of a closed surface, in the form
/// `Vol V + surface-integral x ((v - V) . n) dA` with the mean velocity V.
///
/// On plane panels `sum x (V . A)` is Vol V only up to the error of the quadrature, which turns with the body: as the rate of a
/// momentum it would be a force that grows with the speed of the observer.
fn volume_and_flux(panels: &Panels, range: Range<usize>) -> (f64, DVec3) {
    let centre = mean(&panels.point[range.clone()]);
    let velocity = mean(&panels.velocity[range.clone()]);
    let (mut volume, mut flux) = (0.0, DVec3::ZERO);
    for p in range {
        let x = panels.point[p] - centre;
        volume += x.dot(panels.vector_area[p]) / 3.0;
        flux += x * (panels.velocity[p] - velocity).dot(panels.vector_area[p]);
    }
    (volume, volume * velocity + flux)
}

fn mean(of: &[DVec3]) -> DVec3 {
    of.iter().sum::<DVec3>() / of.len() as f64
}
