//! Whether two sheets cut each other, or touch at their edges alone.
//!
//! Where sheets pass through each other they cut along a line, both ends of which are at an edge of one of them:
//! within the other, or at an edge of it, too, as of wings that are mirror images. Two edges that cross each other
//! at points only touch: an arm and the hand that feathers at its tip are each on its side of the edge that was one.

use crate::contact::sheet::Sheet;
use wingbeat_math::DVec3;

/// How near an edge a point is on it, over the longest ways across both wings \[1\]: 0.01 % of them, about what
/// hinges are given to.
const ON_EDGE: f64 = 1e-4;

/// The sides of a sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Edge {
    Leading,
    Trailing,
    Root,
    Tip,
}

/// Whether two sheets with these nodes cut each other: a line of one goes through the other where not both have
/// an edge, or different edges cross each other at different points.
pub(super) fn is_cut([one, other]: [&Sheet; 2], [a, b]: [&[DVec3]; 2]) -> bool {
    let mut touching = None;
    let mut cuts = |sheets: [&Sheet; 2], nodes: [&[DVec3]; 2], is_turned: bool| {
        edges(sheets, nodes).any(|found| {
            let Some([x, y]) = found else { return true };
            let edges = if is_turned { [y, x] } else { [x, y] };
            *touching.get_or_insert(edges) != edges
        })
    };
    cuts([one, other], [a, b], false) || cuts([other, one], [b, a], true)
}

/// For each place at which a line of the first sheet passes through the second, the edges of both that cross
/// there; none where one has no edge there.
fn edges<'a>(
    [one, other]: [&'a Sheet; 2],
    [a, b]: [&'a [DVec3]; 2],
) -> impl Iterator<Item = Option<[Edge; 2]>> + 'a {
    let near = ON_EDGE * (one.size + other.size);
    let found = one.piercing(a, other, b);
    found.map(move |(line, _, p)| Some([one.edge(line)?, other.edge_at(b, p, near)?]))
}

impl Sheet {
    /// The edge on which a line is.
    fn edge(&self, [m, n]: [usize; 2]) -> Option<Edge> {
        let (row, column) = (m / self.columns, m % self.columns);
        match (self.is_along([m, n]), row, column) {
            (true, 0, _) => Some(Edge::Leading),
            (true, row, _) if row + 1 == self.rows => Some(Edge::Trailing),
            (false, _, 0) => Some(Edge::Root),
            (false, _, column) if column + 1 == self.columns => Some(Edge::Tip),
            _ => None,
        }
    }

    /// The edge nearest to the point `p` \[m\], if that is `near` \[m\]; nodes are at `b`.
    fn edge_at(&self, b: &[DVec3], p: DVec3, near: f64) -> Option<Edge> {
        let of_edges = self.lines().filter_map(|l| Some((l, self.edge(l)?)));
        let distances = of_edges.map(|(l, edge)| (distance(p, l.map(|n| b[n])), edge));
        let nearest = distances.min_by(|x, y| x.0.total_cmp(&y.0))?;
        (nearest.0 <= near).then_some(nearest.1)
    }
}

/// Of a point from a line between two others \[m\].
fn distance(p: DVec3, [x, y]: [DVec3; 2]) -> f64 {
    let along = y - x;
    let part = (p - x).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    p.distance(x + part.clamp(0.0, 1.0) * along)
}

#[cfg(test)]
mod tests {
    use crate::contact::crossing::flown::FlownCrossings;
    use crate::motion::WingMotion;
    use crate::{Animal, MassInput, Planform, Side, Wing, WingShape};
    use wingbeat_math::{DMat3, DVec3, EulerSequence};

    /// A rectangle of length 1 and chord 0.5, its axis at 0.2.
    fn wing(name: &str, chordwise: usize) -> Wing {
        let planform = Planform::Outline {
            leading: vec![(0.0, 0.2), (1.0, 0.2)],
            trailing: vec![(0.0, -0.3), (1.0, -0.3)],
            least_chord: 0.1,
        };
        let shape = WingShape::uniform(planform, chordwise, 4);
        let motion = WingMotion::fixed(0.0, [0.0; 3]);
        let mass = MassInput::Total(0.1);
        Wing::new(name, Side::Right, DVec3::ZERO, &shape, &mass, motion).unwrap()
    }

    fn turn(angles: [f64; 3]) -> DMat3 {
        EulerSequence::WING_132.rotation(DVec3::from(angles.map(f64::to_radians)))
    }

    /// Whether an arm and the hand at its tip, moved by `offset` \[m\] along the span and turned by these angles
    /// phi, theta, psi \[deg\], pass through each other, `tips` being joined.
    fn cross(chordwise: usize, offset: f64, angles: [f64; 3], tips: &[[usize; 2]]) -> bool {
        let hand = (DVec3::new(0.0, 1.0 + offset, 0.0), turn(angles));
        !met(chordwise, hand, tips).is_empty()
    }

    /// The same of a hand with this place \[m\] and attitude, and how deep.
    fn met(chordwise: usize, hand: (DVec3, DMat3), tips: &[[usize; 2]]) -> Vec<f64> {
        let wings = vec![wing("arm", chordwise), wing("hand", chordwise)];
        let animal = Animal {
            name: "hand".into(),
            body: wings[0].mass,
            parts: vec![],
            wings,
            segments: vec![],
        };
        let mut counted = FlownCrossings::new(&animal, &[], tips);
        // The whole animal is turned, too: nothing is round.
        let (about, place) = (turn([13.0, -7.0, 31.0]), DVec3::new(0.3, -0.7, 0.11));
        let turned = |(x, r)| (place + about * x, about * r);
        let poses = [(DVec3::ZERO, turn([0.0; 3])), hand].map(turned);
        counted.see(&poses, std::iter::empty(), |_| 0.0);
        counted
            .found()
            .into_iter()
            .map(|(_, depth)| depth)
            .collect()
    }

    /// Wings across each other whose rows of nodes lie in each other's planes pass through each other as others do, at
    /// least by the shorter of what is on either side; with its root or its tip in the plane of the other one a wing
    /// touches it.
    #[test]
    fn exact_wings_that_cross_at_rows_of_nodes() {
        for chordwise in [1, 2, 5] {
            for (above, shorter) in [
                (0.5, Some(0.5)),
                (0.47, Some(0.47)),
                (0.25, Some(0.25)),
                (0.0, None),
                (1.0, None),
            ] {
                let upright = (DVec3::new(0.0, 0.5, -above), turn([90.0, 0.0, 0.0]));
                let found = met(chordwise, upright, &[]);
                let at = format!("{chordwise} {above}: {found:?}");
                assert_eq!(found.len(), usize::from(shorter.is_some()), "{at}");
                let is_as_deep = |d: f64| found[0] >= d - 1e-5; // what is a touch
                assert!(shorter.is_none_or(is_as_deep), "{at}");
            }
        }
    }

    /// A hand that flaps and feathers at the tip of its arm shares no more than a point of the axis with it. Hands
    /// that reach into the arm by 1 % of its length pass through it, and so do those that are swept into it.
    #[test]
    fn exact_hands_that_feather_at_the_tip_of_an_arm_touch_it() {
        for chordwise in [1, 2, 4, 5] {
            for psi in [-40.0, 3.0, 20.0] {
                for phi in [-30.0, 0.0, 10.0] {
                    let at = format!("{chordwise} {phi} {psi}");
                    assert!(!cross(chordwise, 0.0, [phi, 0.0, psi], &[]), "{at}");
                    assert!(!cross(chordwise, 1e-7, [phi, 0.0, psi], &[]), "{at}");
                    assert!(cross(chordwise, -0.01, [phi, 0.0, psi], &[]), "{at}");
                }
            }
            // Their planes meet near the chord: swept one way the hand leaves the arm there, the other way it enters.
            let swept = [20.0, -20.0].map(|theta| cross(chordwise, 0.0, [10.0, theta, 1.0], &[]));
            assert_ne!(swept[0], swept[1], "{chordwise}");
        }
    }

    /// What the joint bridges, up to half a panel of 0.25, is no crossing: the edge of both is midway.
    #[test]
    fn exact_joined_tips_do_not_cross_within_half_a_panel() {
        let turned = [10.0, 0.0, 15.0];
        for tips in [[[0, 1]], [[1, 0]]] {
            let is_carried = tips == [[0, 1]];
            assert_eq!(cross(2, -0.02, turned, &tips), !is_carried);
        }
        assert!(cross(2, -0.02, turned, &[]));
        assert!(cross(2, -0.2, turned, &[[0, 1]]));
    }
}
