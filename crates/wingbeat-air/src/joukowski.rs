//! Forces on segments: Joukowski's theorem, and Polhamus's analogy built on it.
//!
//! A segment l of net circulation G that moves with the surface at U in air of velocity V feels
//! `rho G (V - U) x l`; the panels feel `rho A dG/dt` along their normals besides. In sum this is the
//! pressure on the sheet and the suction at its free edges. A segment of an edge that sheds counts
//! half, as its other half is wake.

use crate::filaments::Filaments;
use crate::lattice::Lattice;
use crate::loads::{AirLoads, AirWorkspace};
use crate::settings::LoadMethod;
use crate::state::{AirState, NodeMotion};
use crate::strips;
use wingbeat_math::DVec3;

/// Replaces (or completes) the pressure forces of open surfaces as [`LoadMethod`] says.
pub(crate) fn segment_forces(
    lattice: &Lattice,
    state: &AirState,
    motion: &NodeMotion,
    ws: &mut AirWorkspace,
    out: &mut AirLoads,
) {
    out.couple.clear();
    out.couple.resize(lattice.panel_count(), DVec3::ZERO);
    let method = lattice.settings().loads;
    if method == LoadMethod::Pressure {
        return;
    }
    middle_velocities(lattice, ws, out.time);
    collect(lattice, state, ws, out);
    match method {
        LoadMethod::Joukowski => joukowski(lattice, ws, out),
        _ => polhamus(lattice, motion, ws, out),
    }
}

/// Velocity of the air relative to the middle of every bound segment.
fn middle_velocities(lattice: &Lattice, ws: &mut AirWorkspace, t: f64) {
    let Filaments { bound, .. } = &ws.filaments;
    ws.middle.clear();
    for &[a, b] in &bound.edges {
        let ends = [a, b].map(|n| bound.nodes.get(n as usize));
        ws.middle.push(0.5 * (ends[0] + ends[1]));
    }
    ws.middle_velocity.reset(bound.edges.len());
    let mirrors = lattice.mirrors();
    let (points, sum) = (&ws.middle, &mut ws.middle_velocity);
    ws.sums.add(points, mirrors, sum);
    for (e, &[a, b]) in bound.edges.iter().enumerate() {
        let surface = 0.5 * (ws.rings.velocity[a as usize] + ws.rings.velocity[b as usize]);
        let v = sum.get(e) + lattice.stream(points.get(e), t) - surface;
        sum.set(e, v);
    }
}

/// Force and moment about the control point that the segments give to every panel of an open
/// surface; a shared segment gives half to either side.
fn collect(lattice: &Lattice, state: &AirState, ws: &mut AirWorkspace, out: &AirLoads) {
    let rho = lattice.settings().density;
    let bound = &ws.filaments.bound;
    ws.panel_force.clear();
    ws.panel_force
        .resize(lattice.panel_count(), [DVec3::ZERO; 2]);
    for (e, edge) in lattice.topology().edges.iter().enumerate() {
        let l = bound.nodes.get(edge.to) - bound.nodes.get(edge.from);
        let force = rho * bound.gamma[e] * ws.middle_velocity.get(e).cross(l);
        let shared = edge.minus.is_some();
        let sheds = edge.wake.is_some() && !lattice.is_attached(state, edge);
        let share = if shared || sheds { 0.5 } else { 1.0 } * force;
        for p in [Some(edge.plus), edge.minus].into_iter().flatten() {
            let arm = ws.middle.get(e) - out.panels.point[p];
            ws.panel_force[p][0] += share;
            ws.panel_force[p][1] += arm.cross(share);
        }
    }
}

fn joukowski(lattice: &Lattice, ws: &AirWorkspace, out: &mut AirLoads) {
    let rho = lattice.settings().density;
    for p in 0..lattice.panel_count() {
        let surface = lattice.topology().panel_surface[p];
        if lattice.surfaces()[surface].closed {
            continue;
        }
        let unsteady = rho * out.gamma_rate[p] * out.panels.area[p] * out.panels.normal[p];
        let [force, moment] = ws.panel_force[p];
        out.force[p] = force + unsteady;
        out.couple[p] = moment;
    }
}

/// The suction of a strip is the part of its segments' forces along the chord, forward; it is added
/// to the leading panel along its normal, on the side to which the pressure of the strip pushes.
fn polhamus(lattice: &Lattice, motion: &NodeMotion, ws: &AirWorkspace, out: &mut AirLoads) {
    for strip in lattice.strips() {
        let (aft, _) = strips::chord(strip, &motion.position);
        let forward: DVec3 = strip.panels.iter().map(|&p| ws.panel_force[p][0]).sum();
        let suction = (-forward.dot(aft)).max(0.0);
        let lead = strip.panels[0];
        let normal = out.panels.normal[lead];
        let push: DVec3 = strip.panels.iter().map(|&p| out.force[p]).sum();
        out.force[lead] += suction * push.dot(normal).signum() * normal;
    }
}
