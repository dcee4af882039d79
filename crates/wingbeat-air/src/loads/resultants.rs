//! What panels, filaments and closed surfaces give together.

use crate::error::AirError;
use crate::lattice::Lattice;
use crate::loads::values::{AirLoads, SurfaceLoads};
use crate::state::AirState;
use crate::wake::Filaments;
use wingbeat_math::{DVec3, larger};

/// Force and moment of every surface, and what the boundary condition leaves; `net_flux_residual` as
/// [`SurfaceLoads::net_flux_residual`].
pub(crate) fn resultants(lattice: &Lattice, net_flux_residual: &[f64], out: &mut AirLoads) {
    out.surfaces.clear();
    out.normal_velocity_residual = 0.0;
    for s in 0..lattice.surfaces().len() {
        let mut sum = SurfaceLoads {
            net_flux_residual: net_flux_residual[s],
            ..SurfaceLoads::default()
        };
        for p in lattice.panels_of(s) {
            let (x, normal) = (out.panels.point[p], out.panels.normal[p]);
            sum.force += out.force[p];
            sum.moment += x.cross(out.force[p]) + out.couple[p];
            if lattice.surfaces()[s].carry_through {
                continue;
            }
            let through =
                (out.velocity[p] - out.panels.velocity[p]).dot(normal) + sum.net_flux_residual;
            out.normal_velocity_residual = larger(out.normal_velocity_residual, through.abs());
        }
        out.surfaces.push(sum);
    }
}

/// Impulse of all vorticity, see [`AirLoads::impulse`], and its account up to now.
pub(crate) fn impulse(
    lattice: &Lattice,
    state: &AirState,
    filaments: &Filaments,
    out: &mut AirLoads,
) {
    let inner: DVec3 = out.inner.iter().map(|i| i.momentum).sum();
    let present = lattice.settings().density * filaments.impulse(lattice, DVec3::ZERO) - inner;
    out.impulse = present + state.impulse.dropped();
    out.attached_impulse = present - state.free_impulse;
    out.account = state.impulse;
    out.account.created += out.attached_impulse - state.attached_impulse;
}

/// # Errors
/// [`AirError::PanelNotFinite`] names the first panel whose circulation, pressure or force is not a number.
pub(crate) fn check_finite(
    lattice: &Lattice,
    state: &AirState,
    out: &AirLoads,
) -> Result<(), AirError> {
    let force: &dyn Fn(usize) -> f64 = &|p| out.force[p].length();
    let quantities: [(&str, &dyn Fn(usize) -> f64); 3] = [
        ("circulation", &|p| out.gamma[p]),
        ("pressure jump", &|p| out.pressure_jump[p]),
        ("force", force),
    ];
    for (what, value) in quantities {
        if let Some(p) = (0..lattice.panel_count()).find(|&p| !value(p).is_finite()) {
            let (surface, panel) = lattice.topology().locate_panel(p);
            return Err(AirError::PanelNotFinite {
                step: state.step,
                surface,
                panel,
                what,
                value: value(p),
            });
        }
    }
    Ok(())
}
