//! Flat wings, a sphere, motions, and the stepping of a lattice. The tests of the air share it.

use wingbeat_air::{AirError, AirLoads, AirState, AirWorkspace, Lattice, NodeMotion};
use wingbeat_math::DVec3;

/// Nodes of a flat rectangle of `rows` x `cols` panels: leading edge on the axis of `span`.
pub fn rectangle(rows: usize, cols: usize, chord: DVec3, span: DVec3) -> Vec<DVec3> {
    let at =
        |i: usize, j: usize| chord * (i as f64 / rows as f64) + span * (j as f64 / cols as f64);
    (0..=rows)
        .flat_map(|i| (0..=cols).map(move |j| at(i, j)))
        .collect()
}

/// Nodes that move with one velocity [m/s].
pub fn translating(position: Vec<DVec3>, velocity: DVec3) -> NodeMotion {
    let velocity = vec![velocity; position.len()];
    NodeMotion { position, velocity }
}

/// A run in steps of one length: the state after the last accepted step, its wake not yet moved,
/// and the loads of the last step.
pub struct Run {
    /// State.
    pub state: AirState,
    /// Loads.
    pub loads: AirLoads,
    /// Scratch memory.
    pub ws: AirWorkspace,
}

/// Steps 0 to `last` of length `dt` [s] with the motion as a function of time; `see` is shown every
/// accepted step.
///
/// # Errors
/// As the lattice's.
pub fn fly(
    lattice: &Lattice,
    motion: impl Fn(f64) -> NodeMotion,
    dt: f64,
    last: usize,
    mut see: impl FnMut(usize, &AirState, &AirLoads, &mut AirWorkspace),
) -> Result<Run, AirError> {
    let mut run = Run {
        state: lattice.initial_state(&motion(0.0)),
        loads: AirLoads::default(),
        ws: lattice.workspace(),
    };
    for step in 0..=last {
        let t = step as f64 * dt;
        if step > 0 {
            lattice.convect(&mut run.state, dt, &mut run.ws)?;
        }
        let now = motion(t);
        lattice.loads(&run.state, t, dt, &now, &mut run.ws, &mut run.loads)?;
        lattice.accept(&mut run.state, &now, &run.loads)?;
        see(step, &run.state, &run.loads, &mut run.ws);
    }
    Ok(run)
}

/// Force on all surfaces [N].
pub fn total_force(loads: &AirLoads) -> DVec3 {
    loads.surfaces.iter().map(|s| s.force).sum()
}

/// Quadrilaterals on the unit sphere, `n` x `n` on each face of a cube, normals outward.
pub fn sphere(n: usize) -> (Vec<DVec3>, Vec<[usize; 4]>) {
    let mut nodes: Vec<DVec3> = Vec::new();
    let mut node = |p: DVec3| {
        let p = p.normalize();
        let known = nodes.iter().position(|q| q.distance(p) < 1e-9);
        known.unwrap_or_else(|| {
            nodes.push(p);
            nodes.len() - 1
        })
    };
    let angle = |i: usize| (std::f64::consts::FRAC_PI_4 * (2.0 * i as f64 / n as f64 - 1.0)).tan();
    let mut quads = Vec::new();
    for axis in 0..3 {
        for side in [1.0, -1.0] {
            let (w, u) = (DVec3::AXES[axis] * side, DVec3::AXES[(axis + 1) % 3]);
            let v = w.cross(u);
            let at = |i: usize, j: usize| w + u * angle(i) + v * angle(j);
            for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
                let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                quads.push(corners.map(&mut node));
            }
        }
    }
    (nodes, quads)
}

/// Slope of the logarithm of the error when the size of a panel or step is halved.
pub fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).abs().log2()
}
