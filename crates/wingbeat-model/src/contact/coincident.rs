//! Wings that lie in each other: they pass through nothing, and are in one place.

use crate::animal::{Animal, Wing};
use crate::contact::crossing::{instants, pairs};
use crate::contact::sheet::{Sheet, bounds};
use crate::contact::touching::distance;
use wingbeat_math::{DMat3, DVec3};

/// Distance over the smaller mean chord below which sheets are in one place \[1\]: wings of insects and robots are about
/// as thick.
const THICKNESS: f64 = 0.02;

/// Part of the area of the smaller wing that lies in the other where they are in one place, and of the instants \[1\]:
/// wings that clap do so for less of the beat.
const MOST: f64 = 0.5;

/// Pairs of `wings` of the animal that lie in each other over most of the area of the smaller one and most of a
/// beat, at the instants of [`crate::crossings`], and over which part of the time \[1\]. `carried` has place of
/// the origin \[m\] and attitude in the body of wings that hang on others, at a time \[s\]; none of those that
/// move on their hinges.
pub fn coincident(
    animal: &Animal,
    wings: &[usize],
    carried: impl Fn(usize, f64) -> Option<(DVec3, DMat3)>,
) -> Vec<([usize; 2], f64)> {
    let part = |wings: [usize; 2]| {
        let carried = |k: usize, t: f64| carried(wings[k], t);
        let part = part_of_time(wings.map(|w| &animal.wings[w]), carried);
        (part >= MOST).then_some((wings, part))
    };
    pairs(wings.iter().copied()).filter_map(part).collect()
}

/// Pairs of wings of the animal that lie in each other over most of the area of the smaller one at time zero, where they
/// have these places of their origins \[m\] and attitudes.
pub fn in_one_place(animal: &Animal, poses: &[(DVec3, DMat3)]) -> Vec<[usize; 2]> {
    let lie = |pair: &[usize; 2]| {
        let places = SheetPair::of(pair.map(|w| &animal.wings[w]));
        places.lie(|k| poses.get(pair[k]).copied(), 0.0)
    };
    pairs(0..animal.wings.len()).filter(lie).collect()
}

/// Two wings that may lie in each other.
struct SheetPair {
    /// The smaller one first.
    sheets: [Sheet; 2],
    /// Their numbers in the pair.
    order: [usize; 2],
    /// Distance up to which they are in one place \[m\].
    near: f64,
}

impl SheetPair {
    fn of(wings: [&Wing; 2]) -> Self {
        let reports = wings.map(Wing::report);
        let order = match reports[0].area <= reports[1].area {
            true => [0, 1],
            false => [1, 0],
        };
        Self {
            sheets: order.map(|k| Sheet::new(wings[k])),
            order,
            near: THICKNESS * reports[0].mean_chord.min(reports[1].mean_chord),
        }
    }

    /// Whether they do at time `t` \[s\], those that are `carried` being there.
    fn lie(&self, carried: impl Fn(usize) -> Option<(DVec3, DMat3)>, t: f64) -> bool {
        let nodes = [0, 1].map(|k| match carried(self.order[k]) {
            Some(place) => self.sheets[k].carried(place, t),
            None => self.sheets[k].at(t),
        });
        lies_in(
            self.sheets.each_ref(),
            nodes.each_ref().map(|n| &n[..]),
            self.near,
        )
    }
}

/// Part of the time over which two wings lie in each other; 0 once it can no longer be most of it.
fn part_of_time(wings: [&Wing; 2], carried: impl Fn(usize, f64) -> Option<(DVec3, DMat3)>) -> f64 {
    let both = SheetPair::of(wings);
    let count = instants(wings).count();
    let (mut met, mut missed) = (0, 0);
    for t in instants(wings) {
        match both.lie(|k| carried(k, t), t) {
            true => met += 1,
            false => missed += 1,
        }
        if missed as f64 > (1.0 - MOST) * count as f64 {
            return 0.0;
        }
    }
    met as f64 / count as f64
}

/// Whether most of the area of the first of two sheets, whose nodes are at `a` and `b`, is nearer than `near` \[m\] to
/// the second.
fn lies_in([one, other]: [&Sheet; 2], [a, b]: [&[DVec3]; 2], near: f64) -> bool {
    let [low, high] = bounds(b);
    let (low, high) = (low - near, high + near);
    let is_near = |x: DVec3| {
        x.cmpge(low).all()
            && x.cmple(high).all()
            && (other.triangles()).any(|t| distance(x, &t.map(|n| b[n])) <= near)
    };
    let pieces = one.triangles().map(|t| t.map(|n| a[n]));
    let parts = pieces.map(|[x, y, z]| {
        let area = 0.5 * (y - x).cross(z - x).length();
        (area, is_near((x + y + z) / 3.0))
    });
    let sum = |[whole, within]: [f64; 2], (area, is_near): (f64, bool)| {
        [whole + area, within + if is_near { area } else { 0.0 }]
    };
    let [whole, within] = parts.fold([0.0; 2], sum);
    // Half of the panels of one wing and half of those of its image are no different by the rounding of their areas.
    const ROUNDING: f64 = 1e-9;
    within > (MOST + ROUNDING) * whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{AngleLaw, Fourier};
    use crate::{MassInput, Planform, Side, WingMotion, WingShape};

    /// A rectangle of length 1 and chord 0.5 that flaps by `stroke` \[rad\] at 7 Hz, hinged at `hinge` \[m\].
    fn wing(hinge: [f64; 3], stroke: f64) -> Wing {
        let planform = Planform::Outline {
            leading: vec![(0.0, 0.2), (1.0, 0.2)],
            trailing: vec![(0.0, -0.3), (1.0, -0.3)],
            least_chord: 0.1,
        };
        let shape = WingShape::uniform(planform, 3, 10);
        let mut motion = WingMotion::fixed(0.0, [0.0; 3]);
        let (mean, cos, sin) = (0.0, vec![], vec![stroke]);
        motion.angles.phi = AngleLaw::Fourier(Fourier { mean, cos, sin });
        motion.frequency = 7.0;
        let (hinge, mass) = (DVec3::from(hinge), MassInput::Total(0.1));
        Wing::new("wing", Side::Right, hinge, &shape, &mass, motion).unwrap()
    }

    fn found(wings: Vec<Wing>) -> Vec<f64> {
        let animal = Animal {
            name: "coincident".into(),
            body: wings[0].mass,
            parts: vec![],
            wings,
            segments: vec![],
        };
        let all: Vec<usize> = (0..animal.wings.len()).collect();
        let found = coincident(&animal, &all, |_, _| None);
        found.into_iter().map(|(_, part)| part).collect()
    }

    /// Copies of a wing lie in it when less than a fiftieth of the chord, 0.01, is between them across, or when they
    /// overlap by more than half. Their strokes are small: larger ones bring sheets one above the other nearer.
    #[test]
    fn behaves_copies_of_a_wing_lie_in_it() {
        for (aside, is_found) in [
            ([0.0, 0.0, 0.0], true),
            ([0.0, 0.0, 1e-6], true),
            ([0.0, 0.0, 9e-3], true),
            ([0.0, 0.0, 11e-3], false),
            ([0.2, 0.0, 0.0], true),
            ([0.3, 0.0, 0.0], false),
            ([0.0, 0.4, 0.0], true),
            ([0.0, 0.6, 0.0], false),
        ] {
            let time = found(vec![wing([0.0; 3], 0.02), wing(aside, 0.02)]);
            let expected: &[f64] = if is_found { &[1.0] } else { &[] };
            assert_eq!(time, expected, "{aside:?}");
        }
    }

    /// A wing that sweeps past another one is in its place for a small part of the beat.
    #[test]
    fn behaves_wings_that_meet_for_a_moment_do_not_lie_in_each_other() {
        assert!(found(vec![wing([0.0; 3], 1.0), wing([0.0; 3], 0.0)]).is_empty());
    }
}
