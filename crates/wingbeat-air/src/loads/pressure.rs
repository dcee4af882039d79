//! Unsteady Bernoulli: from circulation to pressure jump and force.

use crate::lattice::Lattice;
use crate::loads::lag::add_lag;
use crate::loads::leading_strip::add_front;
use crate::loads::rate::{couple_of_rate, rate_weights};
use crate::loads::values::AirLoads;
use crate::settings::LoadMethod;
use crate::state::AirState;
use crate::wake::Filaments;
use wingbeat_math::DVec3;

/// Vorticity `w Gamma l` [m3/s] that each edge of a panel lends it, an edge shared by two rings giving half to either
/// side (w = 1/2), a free edge all (w = 1), one that sheds what the wing feels of it; and the middle of the edge [m].
fn shares<'a>(
    lattice: &'a Lattice,
    state: &'a AirState,
    filaments: &'a Filaments,
    panel: usize,
) -> impl Iterator<Item = [DVec3; 2]> + 'a {
    let (topology, bound) = (lattice.topology(), &filaments.bound);
    topology.panel_edges[panel].iter().map(move |e| {
        let edge = &topology.edges[e.edge];
        let [a, b] = [edge.from, edge.to].map(|n| bound.nodes.get(n));
        let net = bound.gamma[e.edge];
        let weight = lattice.felt_part(state, edge, net, &filaments.newest);
        [weight * net * (b - a), a.midpoint(b)]
    })
}

/// Jump of the tangential velocity across each panel [m/s]: the vorticity of the panel's edges
/// spread over its area, `dV = (sum w Gamma l) x n / A`.
pub(crate) fn velocity_jump(
    lattice: &Lattice,
    state: &AirState,
    filaments: &Filaments,
    out: &mut AirLoads,
) {
    out.velocity_jump.clear();
    for p in 0..lattice.panel_count() {
        let mut vorticity = DVec3::ZERO;
        for [share, _] in shares(lattice, state, filaments, p) {
            vorticity += share;
        }
        let jump = vorticity.cross(out.panels.normal[p]) / out.panels.area[p];
        out.velocity_jump.push(jump);
    }
}

/// Rate of change of the circulation on the moving panel [m2/s2]; zero at the very first step,
/// which has no past.
pub(crate) fn circulation_rate(lattice: &Lattice, state: &AirState, out: &mut AirLoads) {
    let [a, b, c] = rate_weights(lattice, state, out.dt);
    out.gamma_rate.clear();
    for p in 0..lattice.panel_count() {
        let rate = a * out.gamma[p] + b * state.gamma[p] + c * state.gamma_before[p];
        out.gamma_rate.push(rate);
    }
}

/// Unsteady Bernoulli across the sheet in the frame of the moving panel [Pa]:
/// `dp = rho ((V - V_panel) . dV + dGamma/dt)`.
pub(crate) fn pressure_jump(lattice: &Lattice, out: &mut AirLoads) {
    let rho = lattice.settings().density;
    out.pressure_jump.clear();
    for p in 0..lattice.panel_count() {
        let relative = out.velocity[p] - out.panels.velocity[p];
        let dp = rho * (relative.dot(out.velocity_jump[p]) + out.gamma_rate[p]);
        out.pressure_jump.push(dp);
    }
}

/// Pressure jump times area along the normal [N]. On an open surface the part of `dGamma/dt` acts in the middle of the
/// ring; the part of the vorticity where that lies: half a panel ahead of the control point where it is that of the
/// leading edge, which on eight panels is two fifths of the lift. Open surfaces whose loads are those of segments get
/// none here.
pub(crate) fn forces(
    lattice: &Lattice,
    state: &AirState,
    filaments: &Filaments,
    position: &[DVec3],
    out: &mut AirLoads,
) {
    let rho = lattice.settings().density;
    let by_segments = lattice.settings().loads == LoadMethod::Joukowski;
    for list in [&mut out.force, &mut out.couple] {
        list.clear();
        list.resize(lattice.panel_count(), DVec3::ZERO);
    }
    for p in 0..lattice.panel_count() {
        let is_closed = lattice.surfaces()[lattice.topology().panel_surface[p]].closed;
        if by_segments && !is_closed {
            continue;
        }
        let (x, normal) = (out.panels.point[p], out.panels.normal[p]);
        out.force[p] = out.pressure_jump[p] * out.panels.area[p] * normal;
        if !is_closed {
            let relative = out.velocity[p] - out.panels.velocity[p];
            for [share, middle] in shares(lattice, state, filaments, p) {
                let part = rho * relative.dot(share.cross(normal)) * normal;
                out.couple[p] += (middle - x).cross(part);
            }
            let unsteady = rho * out.gamma_rate[p] * out.panels.area[p] * normal;
            if let Some(aside) = couple_of_rate(lattice, filaments, p, unsteady) {
                out.couple[p] += aside;
            }
        }
    }
    if !by_segments {
        add_front(lattice, state, filaments, position, out);
        add_lag(lattice, state, filaments, position, out);
    }
}
