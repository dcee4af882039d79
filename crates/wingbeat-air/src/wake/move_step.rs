//! What all nodes and particles of the wakes share that move within a step.

use crate::images::{Plane, ROUNDING};
use crate::lattice::Lattice;
use crate::settings::Convection;
use crate::state::AirState;
use crate::wake::contact::Obstacles;
use crate::wake::wake_flow::WakeFlow;
use wingbeat_math::DVec3;

/// A step of the wakes.
pub(crate) struct MoveStep<'a> {
    pub lattice: &'a Lattice,
    pub flow: &'a WakeFlow,
    pub obstacles: &'a Obstacles,
    /// Time at its start [s].
    pub time: f64,
    /// Its length [s].
    pub dt: f64,
    /// Largest displacement relative to the undisturbed air [m].
    pub limit: f64,
    /// Whether the step after it asks for the velocities of this one.
    pub looks_back: bool,
    /// Side of each plane of images on which the surfaces are \[1\], see [`Plane::side`].
    sides: [f64; 2],
    /// Weight of the change of velocity since the step before \[1\].
    pub change: f64,
}

impl<'a> MoveStep<'a> {
    /// That of `dt` [s] from `state` on, with surfaces in the way.
    pub(crate) fn new(
        lattice: &'a Lattice,
        (flow, obstacles): (&'a WakeFlow, &'a Obstacles),
        state: &AirState,
        dt: f64,
    ) -> Self {
        let looks_back = lattice.settings().convection == Convection::AdamsBashforth;
        Self {
            lattice,
            flow,
            obstacles,
            time: state.time,
            dt,
            limit: lattice.settings().max_displacement.unwrap_or(f64::INFINITY),
            looks_back,
            sides: [0, 1].map(|k| {
                let plane = lattice.settings().images.get(k);
                plane.map_or(1.0, |plane| plane.side(&state.position))
            }),
            change: if looks_back && state.dt_wake > 0.0 {
                0.5 * dt / state.dt_wake
            } else {
                0.0
            },
        }
    }

    /// Velocity of the undisturbed air at `x` [m/s], N components.
    pub(crate) fn stream(&self, x: DVec3) -> DVec3 {
        self.lattice.stream(x, self.time)
    }

    /// Where a point at `x` [m] ends that moves with the undisturbed air, `stream` [m/s], and with `v` relative to it,
    /// N components; and whether its displacement relative to that air was shortened to the limit.
    pub(crate) fn end(&self, x: DVec3, stream: DVec3, v: DVec3) -> (DVec3, bool) {
        let (d, is_limited) = self.displacement(v);
        (x + (self.dt * stream + d), is_limited)
    }

    /// Displacement relative to the undisturbed air, and whether it was shortened to the limit.
    fn displacement(&self, v: DVec3) -> (DVec3, bool) {
        let d = self.dt * v;
        let length = d.length();
        match length > self.limit {
            true => (d * (self.limit / length), true),
            false => (d, false),
        }
    }

    /// Keeps the ends of `paths` off surfaces and on the surfaces' side of planes; returns how many were
    /// changed, all and those that have `strength`, of nodes on planes when they come there.
    pub(crate) fn keep_clear(
        &self,
        (from, to): (&[DVec3], &mut [DVec3]),
        strength: impl Fn(usize) -> bool + Sync,
    ) -> [u64; 2] {
        let settings = self.lattice.settings();
        let off_surfaces = match settings.plane_wakes {
            true => self.obstacles.keep_rows_off(from, to, &strength),
            false => self.obstacles.keep_off(from, to, &strength),
        };
        let planes = settings.images.iter().zip(self.sides);
        planes.fold(off_surfaces, |count, plane| {
            sum(count, keep_on_side(plane, from, to, &strength))
        })
    }
}

/// Sum of two counts: of all, and of those that have strength.
pub(crate) fn sum(a: [u64; 2], b: [u64; 2]) -> [u64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// Nodes that would go to the other side of a plane of symmetry or a ground than this one end on it; returns
/// how many that changes, and how many that have `strength` come there from elsewhere. There they and their
/// images cancel.
fn keep_on_side(
    (plane, side): (&Plane, f64),
    from: &[DVec3],
    to: &mut [DVec3],
    strength: impl Fn(usize) -> bool,
) -> [u64; 2] {
    let mut count = [0; 2];
    for (i, (a, b)) in from.iter().zip(to).enumerate() {
        let [before, after] = [*a, *b].map(|x| side * plane.height(x));
        if after < 0.0 {
            // What moves along the plane lies now on one side of it, now on the other, by roundings.
            let way = ROUNDING * a.distance(*b);
            let is_changed = after < -way;
            *b = plane.foot(*b);
            let of = [is_changed, is_changed && before > way && strength(i)].map(u64::from);
            count = sum(count, of);
        }
    }
    count
}
