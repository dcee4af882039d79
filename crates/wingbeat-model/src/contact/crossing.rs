//! Wings that pass through each other: no animal's do, and no vortex lattice says what the air does then.

mod cut;
pub(crate) mod depth;
pub(crate) mod flown;

use crate::animal::{Animal, Wing};
use crate::contact::sheet::Sheet;
use crate::mesh::GridMesh;
use wingbeat_math::DVec3;

/// Instants of a beat at which wings are compared.
pub(crate) const INSTANTS: usize = 100;
/// Beats of the faster wing that are looked at where two beat at different frequencies.
const BEATS: usize = 10;

/// Two wings that pass through each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing {
    /// The two, among the wings of the animal.
    pub wings: [usize; 2],
    /// Part of the time in which they do \[1\].
    pub part: f64,
}

/// All pairs of `wings`, each once.
pub fn pairs(wings: impl Iterator<Item = usize> + Clone) -> impl Iterator<Item = [usize; 2]> {
    let all = wings.clone();
    let with = move |(k, a)| all.clone().skip(k + 1).map(move |b| [a, b]);
    wings.enumerate().flat_map(with)
}

/// Whether a pair of wings is among those `joined`, in either order.
pub fn are_joined(joined: &[[usize; 2]], pair: [usize; 2]) -> bool {
    joined.iter().any(|j| pair.iter().all(|w| j.contains(w)))
}

/// Which of `wings` of the animal pass through each other once their motion has started: at 100 instants of a
/// beat, in ten beats where frequencies differ, deformed as prescribed, on at most 8 x 16 panels. Pairs that are
/// `joined` at their roots have the edge there midway, as in the lattice, unless their roots part by more than
/// [`root_gap`].
pub fn crossings(animal: &Animal, wings: &[usize], joined: &[[usize; 2]]) -> Vec<Crossing> {
    let crossing = |wings: [usize; 2]| {
        let is_joined = are_joined(joined, wings);
        let part = part_of_time(wings.map(|w| &animal.wings[w]), is_joined);
        (part > 0.0).then_some(Crossing { wings, part })
    };
    pairs(wings.iter().copied()).filter_map(crossing).collect()
}

/// How near nodes of two wings come to each other in their prescribed motion at least \[m\], at the instants of
/// [`crossings`]: that of their surfaces, where these are closer than their panels are long.
pub fn nearest_nodes(animal: &Animal, wings: [usize; 2]) -> f64 {
    let wings = wings.map(|w| &animal.wings[w]);
    let sheets = wings.map(Sheet::new);
    let gap = |t: f64| {
        let [a, b] = [0, 1].map(|w| sheets[w].at(t));
        let squares = a
            .iter()
            .flat_map(|x| b.iter().map(|y| x.distance_squared(*y)));
        squares.fold(f64::INFINITY, f64::min).sqrt()
    };
    instants(wings).map(gap).fold(f64::INFINITY, f64::min)
}

/// How far the roots of two joined wings may part \[m\]: half the width of the narrowest panel there.
pub fn root_gap(meshes: [&GridMesh; 2]) -> f64 {
    edge_gap(meshes, [false; 2])
}

/// Half the width \[m\] of the narrowest panel at the roots of two wings, or at their tips.
fn edge_gap(meshes: [&GridMesh; 2], is_tip: [bool; 2]) -> f64 {
    let width = |w: usize, i: usize| {
        let mesh = meshes[w];
        let columns = if is_tip[w] {
            [mesh.cols - 1, mesh.cols]
        } else {
            [0, 1]
        };
        let [edge, next] = columns.map(|j| mesh.nodes[mesh.node(i, j)]);
        edge.distance(next)
    };
    let rows = 0..=meshes[0].rows.min(meshes[1].rows);
    let widths = rows.flat_map(|i| [0, 1].map(|w| width(w, i)));
    0.5 * widths.fold(f64::INFINITY, f64::min)
}

fn part_of_time(wings: [&Wing; 2], is_joined: bool) -> f64 {
    let sheets = wings.map(Sheet::new);
    let shared = is_joined.then(|| Shared::roots(wings.map(|w| &w.mesh)));
    let met = instants(wings).filter(|&t| {
        let nodes = [0, 1].map(|w| sheets[w].at(t));
        let [a, b] = joined(sheets.each_ref(), nodes, shared);
        pass_through(sheets.each_ref(), [&a, &b])
    });
    met.count() as f64 / instants(wings).count() as f64
}

/// Times at which two wings are compared \[s\].
pub(crate) fn instants(wings: [&Wing; 2]) -> impl Iterator<Item = f64> {
    let [a, b] = wings.map(|w| w.motion.frequency);
    let beats = if a == b || a * b == 0.0 { 1 } else { BEATS };
    let faster = [a, b].into_iter().filter(|f| *f > 0.0).reduce(f64::max);
    let (instants, beat) = match faster {
        Some(f) => (INSTANTS * beats, 1.0 / f),
        None => (1, 0.0),
    };
    (0..instants).map(move |k| beat * k as f64 / INSTANTS as f64)
}

/// Nodes of two sheets, the edge that they share being joined.
fn joined(
    sheets: [&Sheet; 2],
    [mut a, mut b]: [Vec<DVec3>; 2],
    shared: Option<Shared>,
) -> [Vec<DVec3>; 2] {
    if let Some(shared) = shared {
        shared.join(sheets, [&mut a, &mut b]);
    }
    [a, b]
}

/// Whether two sheets with these nodes pass through each other.
fn pass_through([one, other]: [&Sheet; 2], [a, b]: [&[DVec3]; 2]) -> bool {
    overlap(a, b, between_middles(a, b)) >= 0.0 && cut::is_cut([one, other], [a, b])
}

/// From the middle of the first nodes to that of the second \[m\].
fn between_middles(a: &[DVec3], b: &[DVec3]) -> DVec3 {
    let middle = |nodes: &[DVec3]| nodes.iter().sum::<DVec3>() / nodes.len() as f64;
    middle(b) - middle(a)
}

/// By how much the first nodes reach beyond the nearest of the second along `way`, times its length; less than 0
/// where a plane across it is between them.
fn overlap(a: &[DVec3], b: &[DVec3], way: DVec3) -> f64 {
    let along = |nodes: &[DVec3]| nodes.iter().map(|x| x.dot(way)).collect::<Vec<f64>>();
    let last = along(a).into_iter().fold(f64::NEG_INFINITY, f64::max);
    let first = along(b).into_iter().fold(f64::INFINITY, f64::min);
    last - first
}

/// Two edges along the chord that are one: the roots of two wings, or the tip of one and the root of the other.
#[derive(Clone, Copy, Debug)]
struct Shared {
    /// Of which of the two wings it is the tip.
    is_tip: [bool; 2],
    /// How far they are apart where they are still one \[m\].
    gap: f64,
}

impl Shared {
    fn roots(meshes: [&GridMesh; 2]) -> Self {
        let (is_tip, gap) = ([false; 2], root_gap(meshes));
        Self { is_tip, gap }
    }

    /// Puts the edges of two sheets midway between them, where they are at most the gap apart.
    fn join(&self, sheets: [&Sheet; 2], [a, b]: [&mut [DVec3]; 2]) {
        let rows = sheets[0].rows.min(sheets[1].rows);
        let node = |i: usize, w: usize| match self.is_tip[w] {
            true => (i + 1) * sheets[w].columns - 1,
            false => i * sheets[w].columns,
        };
        let ends = || (0..rows).map(|i| [node(i, 0), node(i, 1)]);
        if ends().all(|[m, n]| a[m].distance(b[n]) <= self.gap) {
            for [m, n] in ends() {
                let middle = 0.5 * (a[m] + b[n]);
                (a[m], b[n]) = (middle, middle);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::depth::crossing_depth;
    use super::flown::FlownCrossings;
    use super::*;
    use crate::contact::sheet::{LINES, lines};
    use crate::motion::{AngleLaw, Fourier, Start, WingMotion};
    use crate::{MassInput, Planform, Side, WingShape};
    use wingbeat_math::RotationLaw;

    /// A wing of length 1 that flaps about the axis of its chord, hinged `below` \[m\] the body's origin.
    fn wing(below: f64, amplitude: f64, frequency: f64) -> Wing {
        let planform = Planform::Outline {
            leading: vec![(0.0, 0.2), (1.0, 0.2)],
            trailing: vec![(0.0, -0.3), (1.0, -0.3)],
            least_chord: 0.1,
        };
        let shape = WingShape::uniform(planform, 3, 30);
        let mut motion = WingMotion::fixed(0.0, [0.0; 3]);
        let (mean, cos, sin) = (0.0, vec![], vec![amplitude]);
        motion.angles.phi = AngleLaw::Fourier(Fourier { mean, cos, sin });
        motion.frequency = frequency;
        motion.start = Start::Smooth { duration: 1.0 };
        let hinge = DVec3::new(0.0, 0.0, below);
        Wing::new(
            "wing",
            Side::Right,
            hinge,
            &shape,
            &MassInput::Total(0.1),
            motion,
        )
        .unwrap()
    }

    fn animal(wings: Vec<Wing>) -> Animal {
        Animal {
            name: "crossing".into(),
            body: wings[0].mass,
            parts: vec![],
            wings,
            segments: vec![],
        }
    }

    /// The tip is more than half a length below the hinge, where the other wing is, for a third of the beat.
    #[test]
    fn exact_time_for_which_a_wing_is_through_another() {
        let flapping = || wing(0.0, 60f64.to_radians(), 7.0);
        for (still, frequency) in [
            (wing(0.5, 0.0, 7.0), "the same"),
            (wing(0.5, 0.0, 0.0), "none"),
        ] {
            let found = crossings(&animal(vec![flapping(), still]), &[0, 1], &[]);
            assert_eq!(found.len(), 1, "{frequency}");
            assert_eq!(found[0].wings, [0, 1]);
            // Instants are a hundredth apart, and there are two ends.
            assert!(
                (found[0].part - 1.0 / 3.0).abs() < 0.02,
                "{}",
                found[0].part
            );
        }
        let two = animal(vec![flapping(), wing(0.5, 0.0, 7.0)]);
        let nearest = nearest_nodes(&two, [0, 1]);
        assert!(nearest < 0.05, "{nearest}"); // nodes of a line are 1/16 apart
        let slow = animal(vec![flapping(), wing(0.5, 0.0, 0.7)]);
        assert!((crossings(&slow, &[0, 1], &[])[0].part - 1.0 / 3.0).abs() < 0.02);
        let flown = animal(vec![flapping(), wing(0.5, 0.0, 7.0)]);
        let mut counted = FlownCrossings::new(&flown, &[], &[]);
        for k in 0..INSTANTS {
            let t = k as f64 / INSTANTS as f64 / 7.0;
            let pose = |w: &Wing| {
                let motion = WingMotion {
                    start: Start::Impulsive,
                    ..w.motion.clone()
                };
                (w.hinge_b, motion.at(t).c)
            };
            let poses: Vec<_> = flown.wings.iter().map(pose).collect();
            counted.see(&poses, std::iter::empty(), |m| m.phase_at(t)[0]);
        }
        let [(crossing, depth)] = &counted.found()[..] else {
            panic!("{:?}", counted.found());
        };
        let prescribed = crossings(&flown, &[0, 1], &[]);
        assert_eq!(std::slice::from_ref(crossing), &prescribed[..]);
        let expected = crossing_depth(&flown, [0, 1], false);
        assert!((depth - expected).abs() < 1e-12, "{depth} {expected}"); // roundings of times
        let far = animal(vec![flapping(), wing(0.9, 0.0, 7.0)]);
        assert_eq!(crossings(&far, &[0, 1], &[]), []);
    }

    /// Wings that share the line of their roots touch there and do not pass; nor does a wing with itself.
    #[test]
    fn behaves_touching_wings_do_not_cross() {
        let right = wing(0.0, 1.0, 7.0);
        let left = right.mirrored("left");
        let two = animal(vec![right, left]);
        assert_eq!(crossings(&two, &[0, 1], &[]), []);
        assert_eq!(crossings(&two, &[0, 0], &[]), []);
        assert_eq!(crossings(&two, &[], &[]), []);
    }

    /// Wings that share their roots and feather while flapped pass through each other by a sliver beside the
    /// roots, which joined ones do not have; those that feather beyond half a panel do, and so do joined wings
    /// that meet elsewhere.
    #[test]
    fn behaves_joined_wings_that_feather_do_not_cross_within_half_a_panel() {
        let feathering = |phi: f64, psi: f64| {
            let mut right = wing(0.0, phi.to_radians(), 7.0);
            right.motion.angles.psi = AngleLaw::Constant(psi.to_radians());
            let left = right.mirrored("left");
            animal(vec![right, left])
        };
        let little = feathering(30.0, 2.0);
        assert_eq!(crossings(&little, &[0, 1], &[]).len(), 1);
        assert_eq!(crossings(&little, &[0, 1], &[[1, 0]]), []);
        let much = feathering(30.0, 20.0);
        assert_eq!(crossings(&much, &[0, 1], &[[0, 1]]).len(), 1);
        let clapping = feathering(100.0, 1.0);
        assert_eq!(crossings(&clapping, &[0, 1], &[[0, 1]]).len(), 1);
    }

    #[test]
    fn behaves_fine_meshes_are_looked_at_on_few_lines() {
        assert_eq!(lines(3, 9), [0, 1, 2, 3]);
        assert_eq!(lines(80, 9), [0, 10, 20, 30, 40, 50, 60, 70, 80]);
        assert_eq!(lines(300, LINES[1]).len(), LINES[1]);
    }
}
