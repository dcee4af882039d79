//! Wings whose roots lie on parts of the body or on each other: where they meet no air passes and circulation goes on, which a
//! vortex lattice of both does not know.

use crate::animal::{Animal, Wing};
use crate::contact::inside::Solid;
use crate::deformation::DeformingMesh;
use crate::mesh::{GridMesh, QuadMesh};
use crate::motion::{Start, WingMotion};
use wingbeat_math::{DVec3, RotationLaw};

/// How near a node of the root is to a part that it lies on, over the chord of the root: panels of a part lie
/// within its surface, by 0.04 chords of a bird's or an aeroplane's wing on eight panels around. A little more
/// than a round number: roots that stand off by just that are told on both sides of the body.
const NEAR: f64 = 0.1 + 1e-9;
/// How near those are, over the chord of the root, that stand off a part by a gap that counts.
const BESIDE: f64 = 0.25;
/// Part of the chord of the root along which it lies on a part: petioles and hinges touch theirs in a place.
const ALONG: f64 = 0.75;
/// Instants of a beat that are looked at.
const INSTANTS: usize = 20;

/// A wing whose root lies on a part of the central body throughout its prescribed motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RootOnPart {
    /// The wing, among those of the animal.
    pub wing: usize,
    /// The part, among those of the central body.
    pub part: usize,
}

/// Which of `wings` of the animal have their roots on parts of the central body: along three quarters of the
/// chord of the root within a tenth of it from panels of the part, or inside, at each of 20 instants of a beat,
/// with prescribed shapes, elastic ones at rest.
pub fn roots_on_parts(animal: &Animal, wings: &[usize]) -> Vec<RootOnPart> {
    within(animal, wings, NEAR)
}

/// Which of `wings` of the animal have their roots beside parts of the central body: they are not on them
/// ([`roots_on_parts`]), and would be if a quarter of the chord counted as a tenth does.
pub fn roots_beside_parts(animal: &Animal, wings: &[usize]) -> Vec<RootOnPart> {
    let on = roots_on_parts(animal, wings);
    let mut near = within(animal, wings, BESIDE);
    near.retain(|root| on.iter().all(|on| on.wing != root.wing));
    near
}

/// Roots that stay within `near` chords of a part along three quarters of their chord.
fn within(animal: &Animal, wings: &[usize], near: f64) -> Vec<RootOnPart> {
    let skins: Vec<Skin> = animal.parts.iter().map(|p| Skin::new(&p.mesh)).collect();
    let of_wing = |&wing: &usize| {
        let places = places(&animal.wings[wing]);
        let holds = |skin: &Skin| places.iter().all(|root| skin.holds(root, near));
        let found: Vec<usize> = (0..skins.len()).filter(|&p| holds(&skins[p])).collect();
        found.into_iter().map(move |part| RootOnPart { wing, part })
    };
    wings.iter().flat_map(of_wing).collect()
}

/// Whether the roots of two wings meet: along three quarters of either chord `within` \[1\] of it from nodes of the
/// other root, at each of 20 instants of a beat, with prescribed shapes, elastic ones at rest.
pub fn roots_meet(animal: &Animal, wings: [usize; 2], within: f64) -> bool {
    let [a, b] = wings.map(|w| places(&animal.wings[w]));
    let meets = |one: &[DVec3], other: &[DVec3]| {
        let near = within * one[0].distance(one[one.len() - 1]);
        let beside = |x: &DVec3| other.iter().any(|y| x.distance(*y) <= near);
        let count = one.iter().filter(|x| beside(x)).count();
        count as f64 >= ALONG * one.len() as f64
    };
    // Of one that stands still and one that beats all instants of the one.
    let instants = a.len().max(b.len());
    (0..instants).all(|k| {
        let [a, b] = [&a[k % a.len()], &b[k % b.len()]];
        meets(a, b) && meets(b, a)
    })
}

/// Two wings whose roots lie on one part of the central body, and the way from root to root through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairOnPart {
    /// The wings, among those of the animal.
    pub wings: [usize; 2],
    /// The part, among those of the central body.
    pub part: usize,
    /// From the middle between the two roots towards that of the part, normal to the mean chord of the roots
    /// [m], body components: so far the way leads off the straight one to stay clear of the surface. Zero where
    /// that would lead out of the part.
    pub aside: DVec3,
    /// How far the middle between the roots is from that of the part, normal to the chord, over half the
    /// distance of the roots \[1\].
    pub off_middle: f64,
    /// Distance of the roots over their chord \[1\].
    pub apart_chords: f64,
    /// Length of the part along the chord [m].
    pub part_length: f64,
    /// Length along the chord of the longest panel of the part beside either root, over the chord of the root \[1\].
    pub panel_chords: f64,
}

/// Which of these `pairs` of wings, with as many panels along both chords, have both roots on one part
/// ([`roots_on_parts`]).
pub fn pairs_on_parts(animal: &Animal, pairs: &[[usize; 2]]) -> Vec<PairOnPart> {
    let wings: Vec<usize> = pairs.iter().flatten().copied().collect();
    let found = roots_on_parts(animal, &wings);
    let lies = |wing: usize, part: usize| found.contains(&RootOnPart { wing, part });
    let of = |&wings: &[usize; 2]| {
        let [a, b] = wings;
        let part = (0..animal.parts.len()).find(|&part| lies(a, part) && lies(b, part))?;
        let mesh = &animal.parts[part].mesh;
        let roots = wings.map(|w| places(&animal.wings[w]).swap_remove(0));
        let middles: Vec<DVec3> = (roots[0].iter().zip(&roots[1]))
            .map(|(a, b)| a.midpoint(*b))
            .collect();
        let chord = middles[middles.len() - 1] - middles[0];
        let off = off_middle(&middles, chord, mesh);
        let apart = roots[0].iter().zip(&roots[1]).map(|(a, b)| a.distance(*b));
        let apart = apart.sum::<f64>() / middles.len() as f64;
        let along = mesh.nodes.iter().map(|x| x.dot(chord.normalize_or_zero()));
        Some(PairOnPart {
            wings,
            part,
            aside: if leads_within(&middles, off, mesh) {
                off
            } else {
                DVec3::ZERO
            },
            off_middle: off.length() / (0.5 * apart).max(f64::MIN_POSITIVE),
            apart_chords: apart / chord.length(),
            part_length: along.clone().fold(f64::MIN, f64::max) - along.fold(f64::MAX, f64::min),
            panel_chords: (roots.iter().map(|root| panel_chords(root, mesh))).fold(0.0, f64::max),
        })
    };
    pairs.iter().filter_map(of).collect()
}

/// From the middles between two roots to that of the part, normal to their mean chord [m].
fn off_middle(middles: &[DVec3], chord: DVec3, part: &QuadMesh) -> DVec3 {
    let [low, high] = part.bounds();
    let to_middle = low.midpoint(high) - middles.iter().sum::<DVec3>() / middles.len() as f64;
    to_middle - to_middle.project_onto(chord)
}

/// Whether these places are within the part, too, where they are moved `aside`.
fn leads_within(middles: &[DVec3], aside: DVec3, part: &QuadMesh) -> bool {
    let solid = Solid::new(part);
    aside.is_finite() && middles.iter().all(|x| solid.contains(*x + aside))
}

/// See [`PairOnPart::panel_chords`], of one root.
fn panel_chords(root: &[DVec3], part: &QuadMesh) -> f64 {
    let chord = root[root.len() - 1] - root[0];
    let near = |q: usize, x: DVec3| {
        let [a, b, c, d] = part.corners(q);
        distance(x, &[a, b, c]).min(distance(x, &[a, c, d]))
    };
    let beside =
        |x: &DVec3| (0..part.quads.len()).min_by(|p, q| near(*p, *x).total_cmp(&near(*q, *x)));
    let length = |q: usize| {
        let along = part
            .corners(q)
            .map(|x| x.dot(chord) / chord.length_squared());
        along.iter().fold(f64::MIN, |m, x| m.max(*x))
            - along.iter().fold(f64::MAX, |m, x| m.min(*x))
    };
    root.iter()
        .filter_map(beside)
        .map(length)
        .fold(0.0, f64::max)
}

/// The nodes of the root of a wing [m], body components, at the instants of a beat.
fn places(wing: &Wing) -> Vec<Vec<DVec3>> {
    let motion = WingMotion {
        start: Start::Impulsive,
        ..wing.motion.clone()
    };
    let (instants, beat) = match motion.frequency > 0.0 {
        true => (INSTANTS, 1.0 / motion.frequency),
        false => (1, 0.0),
    };
    let rest = root(&wing.mesh);
    let deforming = (wing.deformation.as_ref()).map(|d| DeformingMesh::new(&wing.mesh, d));
    let at = |k: usize| {
        let t = beat * k as f64 / INSTANTS as f64;
        let turn = motion.at(t).c;
        let mut root = rest.clone();
        if let Some(mesh) = &deforming {
            mesh.visit(motion.phase_at(t), |n, [x, ..]| {
                if n % (wing.mesh.cols + 1) == 0 {
                    root[n / (wing.mesh.cols + 1)] = x;
                }
            });
        }
        root.iter().map(|x| wing.hinge_b + turn * *x).collect()
    };
    (0..instants).map(at).collect()
}

/// Nodes of the root from leading to trailing edge [m], wing components.
fn root(mesh: &GridMesh) -> Vec<DVec3> {
    (0..=mesh.rows)
        .map(|i| mesh.nodes[mesh.node(i, 0)])
        .collect()
}

/// The surface of a part and what it encloses.
struct Skin {
    triangles: Vec<[DVec3; 3]>,
    solid: Solid,
}

impl Skin {
    fn new(mesh: &QuadMesh) -> Self {
        Self {
            triangles: mesh.triangles(),
            solid: Solid::new(mesh),
        }
    }

    /// Whether a root with these nodes lies on it, as near as this over its chord.
    fn holds(&self, root: &[DVec3], near: f64) -> bool {
        let lengths = root.windows(2).map(|w| w[0].distance(w[1]));
        let chord: f64 = lengths.clone().sum();
        let on: Vec<bool> = root
            .iter()
            .map(|x| self.is_near(*x, near * chord))
            .collect();
        let both = on.windows(2).map(|w| w[0] && w[1]);
        let along: f64 = lengths
            .zip(both)
            .filter(|(_, on)| *on)
            .map(|(l, _)| l)
            .sum();
        chord > 0.0 && along >= ALONG * chord
    }

    /// Whether a place is within `reach` [m] of the surface, or inside.
    fn is_near(&self, x: DVec3, reach: f64) -> bool {
        self.triangles.iter().any(|t| distance(x, t) <= reach) || self.solid.contains(x)
    }
}

/// Distance of a place from a triangle [m].
pub(crate) fn distance(x: DVec3, t: &[DVec3; 3]) -> f64 {
    let sides = [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let normal = (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero();
    let is_over = |[a, b]: [DVec3; 2]| (b - a).cross(x - a).dot(normal) >= 0.0;
    if normal != DVec3::ZERO && sides.into_iter().all(is_over) {
        return (x - t[0]).dot(normal).abs();
    }
    let from_side = |[a, b]: [DVec3; 2]| {
        let way = b - a;
        let along = (x - a).dot(way) / way.length_squared().max(f64::MIN_POSITIVE);
        x.distance(a + along.clamp(0.0, 1.0) * way)
    };
    sides
        .map(from_side)
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::animal::BodyPart;
    use crate::motion::{AngleLaw, Fourier};
    use crate::{MassInput, Planform, Revolution, Side, WingShape};
    use wingbeat_math::MassProperties;

    /// A trunk of length 1.6 and diameter 0.2 and wings of chord 0.2 at its middle whose roots are this far
    /// from its axis \[m\], that flap and feather by these angles \[rad\].
    fn animal(aside: f64, [flap, feather]: [f64; 2]) -> Animal {
        let planform = Planform::Outline {
            leading: vec![(0.0, 0.1), (0.4, 0.1)],
            trailing: vec![(0.0, -0.1), (0.4, -0.1)],
            least_chord: 0.1,
        };
        let sine = |angle: f64| {
            let (mean, cos, sin) = (0.0, vec![], vec![angle]);
            AngleLaw::Fourier(Fourier { mean, cos, sin })
        };
        let mut motion = WingMotion::fixed(0.0, [0.0; 3]);
        (motion.angles.phi, motion.angles.psi) = (sine(flap), sine(feather));
        motion.frequency = 3.0;
        let shape = WingShape::uniform(planform, 6, 12);
        let hinge = DVec3::new(0.0, aside, 0.0);
        let mass = MassInput::Total(0.1);
        let right = Wing::new("right", Side::Right, hinge, &shape, &mass, motion).unwrap();
        let trunk = Revolution::ellipsoid(DVec3::ZERO, 1.6, 0.1, [6, 8]);
        let mass = MassInput::Given(MassProperties::point(0.1, DVec3::ZERO));
        let part = BodyPart::revolution("trunk", &trunk, &mass).unwrap();
        Animal {
            name: "touching".into(),
            body: right.mass,
            parts: vec![part],
            wings: vec![right.mirrored("left"), right],
            segments: vec![],
        }
    }

    #[test]
    fn exact_distances_from_a_triangle() {
        let t = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let over = |x: f64, y: f64, z: f64| distance(DVec3::new(x, y, z), &t);
        assert_eq!(over(0.25, 0.25, -2.0), 2.0);
        assert_eq!(over(0.5, -3.0, 4.0), 5.0);
        assert_eq!(over(4.0, 0.0, 0.0), 3.0);
        assert!((over(1.0, 1.0, 0.0) - 0.5f64.sqrt()).abs() < 1e-15);
        let line = [DVec3::ZERO, DVec3::X, DVec3::X];
        assert_eq!(distance(DVec3::new(0.5, 2.0, 0.0), &line), 2.0);
    }

    /// The trunk reaches 0.1 from its axis.
    #[test]
    fn behaves_roots_lie_on_a_part_that_they_stay_near() {
        let found = |aside: f64, angles: [f64; 2]| roots_on_parts(&animal(aside, angles), &[0, 1]);
        let both = [0, 1].map(|wing| RootOnPart { wing, part: 0 });
        for aside in [0.08, 0.1, 0.11] {
            assert_eq!(found(aside, [0.7, 0.0]), both, "{aside}");
        }
        assert_eq!(found(0.13, [0.0, 0.0]), [], "beside the trunk");
        // Its ends are 0.1 sin(40 deg) above and below the middle of the trunk, where that is half as wide.
        assert_eq!(found(0.1, [0.7, 0.7]), [], "feathers");
        assert_eq!(roots_on_parts(&animal(0.1, [0.0; 2]), &[]), []);
    }

    /// Roots 0.05 above the axis of the trunk: the way leads down to it. At its ends, which reach beyond the
    /// roots, it would lead out.
    #[test]
    fn behaves_the_way_through_a_part_keeps_to_its_middle() {
        let on = |x: f64, z: f64| {
            let mut animal = animal(0.085, [0.0; 2]);
            animal.wings.iter_mut().for_each(|w| {
                w.hinge_b.x = x;
                w.hinge_b.z = z;
            });
            pairs_on_parts(&animal, &[[0, 1]])
        };
        let [middle] = on(0.0, 0.0)[..] else { panic!() };
        assert_eq!((middle.wings, middle.part), ([0, 1], 0));
        assert!(middle.aside.length() < 1e-15);
        // Six stations along 1.6, cosine-spaced: 0.4 in the middle, twice the chord.
        assert!((middle.panel_chords - 2.0).abs() < 1e-12, "{middle:?}");
        let [above] = on(0.0, -0.05)[..] else {
            panic!()
        };
        assert!((above.aside - DVec3::new(0.0, 0.0, 0.05)).length() < 1e-15);
        assert_eq!(pairs_on_parts(&animal(0.2, [0.0; 2]), &[[0, 1]]), []);
    }
}
