//! Which edges of wings lie on a plane of images, joined to their own mirror images there: a wing on the wall of a
//! wind tunnel is half of a wing of twice the span.

use wingbeat_air::{EdgeKind, NodeMotion, Plane};
use wingbeat_dynamics::BodyMotion;
use wingbeat_math::RotationLaw;

use crate::air::{EdgeOnPlane, ON_PLANE, SurfaceMap};
use crate::interface::Instant;
use crate::setup::{AirOptions, FlightSetup, LOOKS, MotionMode};

/// How far off a plane an edge lies that is near it, over its length \[1\].
const NEAR: f64 = 0.1;

/// Part of the width of its panels by which a wing rises from a plane on which it stands, at least \[1\]: one that lies
/// along a ground has no edge there.
const RISES: f64 = 0.5;

impl FlightSetup {
    /// Roots and tips that begin on a plane of images of the lattice, or within a tenth of their length of one. Those
    /// that stay there in their prescribed motion, elastic wings at rest, are joined to their mirror images.
    /// Wings with joints of their own are left out.
    pub fn edges_on_planes(&self, air: &AirOptions) -> Vec<EdgeOnPlane> {
        if air.lattice.images.is_empty() {
            return vec![];
        }
        let map = SurfaceMap::new(&self.animal, false, (&[], &[]));
        let mut found = vec![];
        for wing in self.prescribed_wings() {
            for kind in [EdgeKind::Root, EdgeKind::Tip] {
                let planes = air.lattice.images.iter();
                let here = planes.filter_map(|plane| self.edge_on(&map, (wing, kind), plane));
                found.extend(here.take(1));
            }
        }
        found
    }

    /// Whether this edge of wing `w` stays on a plane of images of its lattice, joined to its mirror image.
    pub(super) fn is_on_plane(&self, w: usize, kind: EdgeKind) -> bool {
        let edges = self.air.lattice().map(|air| self.edges_on_planes(air));
        let mut edges = edges.iter().flatten();
        edges.any(|edge| edge.wing == w && edge.kind == kind && edge.is_joined())
    }

    /// This edge of a wing, if it begins on or near this plane.
    fn edge_on(
        &self,
        map: &SurfaceMap,
        (wing, kind): (usize, EdgeKind),
        plane: &Plane,
    ) -> Option<EdgeOnPlane> {
        let [edge, next] = map.columns_of(&self.animal, wing, kind);
        let start = self.nodes_at(map, 0.0)?.position;
        let length = edge.windows(2).map(|n| start[n[0]].distance(start[n[1]]));
        let length = length.sum::<f64>();
        let off = |nodes: &NodeMotion| {
            let heights = edge.iter().map(|&n| plane.height(nodes.position[n]).abs());
            heights.fold(0.0, f64::max) / length
        };
        let rises = edge.iter().zip(&next).all(|(&a, &b)| {
            let rise = (plane.height(start[b]) - plane.height(start[a])).abs();
            rise >= RISES * start[a].distance(start[b])
        });
        let first = off(&self.nodes_at(map, 0.0)?);
        if !(first <= NEAR && rises) {
            return None;
        }
        let most = match (&self.mode, first <= ON_PLANE) {
            (MotionMode::Tethered(_), true) => {
                let all = (self.time.instants(LOOKS)).map(|t| self.nodes_at(map, t));
                all.map(|nodes| nodes.map_or(f64::INFINITY, |n| off(&n)))
                    .fold(0.0, f64::max)
            }
            _ => f64::INFINITY,
        };
        Some(EdgeOnPlane {
            wing,
            kind,
            plane: *plane,
            off: [first, most],
        })
    }

    /// Nodes of all wings at time `t` \[s\] in their prescribed motion, those of the body as it starts if it is free.
    fn nodes_at(&self, map: &SurfaceMap, t: f64) -> Option<NodeMotion> {
        let root = match &self.mode {
            MotionMode::Tethered(motion) => motion.at(t).motion,
            MotionMode::Free(_) => self.root_at_start(),
        };
        let wing = |w: &wingbeat_model::Wing| BodyMotion {
            p: root.p + root.r * w.hinge_b,
            r: root.r * w.motion.at(t).c,
            ..BodyMotion::REST
        };
        let wings = self.animal.wings.iter().map(wing);
        let motions: Vec<BodyMotion> = std::iter::once(root).chain(wings).collect();
        let mut nodes = NodeMotion::default();
        let at = Instant::rigid(t, self.time.step, &motions);
        map.node_motion(&at, &mut nodes).ok()?;
        Some(nodes)
    }
}
