//! Places behind the nodes of a strip by a part of a panel.

use crate::geometry::strips::Strip;
use std::collections::BTreeMap;
use wingbeat_math::DVec3;

/// The sides of panels along which a node of a strip goes aft: the one behind it; behind the last node the
/// strip goes on as it is curved up to there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aft {
    pub node: usize,
    /// Ends of a side, from fore to aft.
    side: [usize; 2],
    /// The node before that side, if it is the last one.
    before: Option<usize>,
}

/// All nodes of the strips, in their order.
pub(crate) fn nodes_of_strips(strips: &[Strip]) -> Vec<Aft> {
    let mut found = BTreeMap::new();
    for strip in strips {
        for (i, ends) in strip.sides.windows(2).enumerate() {
            for k in 0..2 {
                let side = [ends[0][k], ends[1][k]];
                let mut add = |node, before| found.insert(node, Aft { node, side, before });
                add(ends[0][k], None);
                if i + 1 == strip.panels.len() {
                    add(ends[1][k], i.checked_sub(1).map(|b| strip.sides[b][k]));
                }
            }
        }
    }
    found.into_values().collect()
}

impl Aft {
    /// The way aft along a whole panel, from the places of all nodes, or its rate from their velocities `of`:
    /// what lies behind the last node is as long as the last side, and its direction follows from those of the
    /// last two.
    pub fn way(&self, place: &[DVec3], of: &[DVec3]) -> DVec3 {
        let [a, b] = self.side;
        let last = of[b] - of[a];
        match self.before {
            None => last,
            Some(c) => {
                let [bend, ratio] = self.bend(place, c);
                last + bend * (last - ratio * (of[a] - of[c]))
            }
        }
    }

    /// Weight of the change of direction between the last two sides, and the ratio of their lengths; none where
    /// one has no length, as in triangles.
    fn bend(&self, place: &[DVec3], before: usize) -> [f64; 2] {
        let [a, b] = self.side;
        let last = place[a].distance(place[b]);
        let other = place[before].distance(place[a]);
        match last > 0.0 && other > 0.0 {
            true => [2.0 * last / (last + other), last / other],
            false => [0.0; 2],
        }
    }

    /// What a force at the end of a part of that way does to the nodes besides the one it leads from:
    /// [`Self::way`], transposed.
    pub fn spread(&self, place: &[DVec3], force: DVec3, mut add: impl FnMut(usize, DVec3)) {
        let [a, b] = self.side;
        add(b, force);
        add(a, -force);
        if let Some(c) = self.before {
            let [bend, ratio] = self.bend(place, c);
            add(b, bend * force);
            add(a, -bend * (1.0 + ratio) * force);
            add(c, bend * ratio * force);
        }
    }
}
