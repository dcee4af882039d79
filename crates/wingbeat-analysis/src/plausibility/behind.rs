//! Wings that stand in the wakes of others.

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::FlightSetup;
use wingbeat_math::{DVec3, RotationLaw};

/// Way downstream [m] that the wake of wing `ahead` has to go so that wings behind it meet it: to the trailing
/// edge of the last of them, and beyond it by the length of the wing ahead. Wings aside of the wake by more
/// than that length are left out; none where there are no others, and in air at rest.
pub(super) fn way_to_wings_behind(setup: &FlightSetup, ahead: usize) -> Option<f64> {
    let root = setup.root_at_start();
    let downstream = (root.r.transpose() * (setup.air_at_start() - root.v)).try_normalize()?;
    let length = setup.animal.wings[ahead].report().length;
    let of_wake = Place::of(setup, ahead, downstream);
    let others = (0..setup.animal.wings.len()).filter(|w| *w != ahead);
    let behind = others.map(|w| Place::of(setup, w, downstream));
    let met = behind.filter(|p| p.middle() > of_wake.rear && p.aside(&of_wake) < length);
    let ways = met.map(|p| p.rear - of_wake.rear + length);
    ways.reduce(f64::max)
}

/// Where a wing is at the start.
struct Place {
    /// Nodes across the stream [m], body components.
    across: Vec<DVec3>,
    /// Least and largest way of a node along the stream [m].
    front: f64,
    rear: f64,
}

impl Place {
    fn of(setup: &FlightSetup, w: usize, downstream: DVec3) -> Self {
        let wing = &setup.animal.wings[w];
        let moving = setup.prescribed_in_body(w, 0.0);
        let moving = moving.unwrap_or_else(|| BodyMotion {
            p: wing.hinge_b,
            r: wing.motion.at(0.0).c,
            ..BodyMotion::REST
        });
        let nodes = wing.mesh.nodes.iter().map(|x| moving.p + moving.r * *x);
        let ways = nodes.clone().map(|x| x.dot(downstream));
        Self {
            front: ways.clone().fold(f64::INFINITY, f64::min),
            rear: ways.fold(f64::NEG_INFINITY, f64::max),
            across: nodes.map(|x| x.reject_from(downstream)).collect(),
        }
    }

    fn middle(&self) -> f64 {
        self.front.midpoint(self.rear)
    }

    /// Least distance of nodes across the stream [m].
    fn aside(&self, other: &Self) -> f64 {
        let pairs = self.across.iter().flat_map(|a| {
            let others = other.across.iter();
            others.map(|b| a.distance(*b))
        });
        pairs.fold(f64::INFINITY, f64::min)
    }
}
