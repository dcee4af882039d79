//! Which nodes and panels of an animal are mirror images of which.

use wingbeat_air::{MirrorPairs, Plane};
use wingbeat_dynamics::BodyMotion;
use wingbeat_math::{DVec3, mirrored};
use wingbeat_model::mesh::QuadMesh;
use wingbeat_model::{Animal, PairOnPart, Wing, mirror_name};

/// The pairs of an animal that is its own mirror image in the plane of axes 1 and 3 of the body, at rest at
/// `root`, in the order of the lattice's surfaces: wings, parts of the body, parts of segments, strips through
/// bodies between the wings `carried`. None if a wing or a node has no counterpart.
pub fn mirror_pairs(
    animal: &Animal,
    (body_surfaces, carried): (bool, &[PairOnPart]),
    root: &BodyMotion,
) -> Option<MirrorPairs> {
    let mut pairs = MirrorPairs {
        plane: Plane {
            point: root.p,
            normal: root.r.y_axis,
        },
        node: vec![],
        panel: vec![],
    };
    let wing_nodes = first_of(0, animal.wings.iter().map(|w| w.mesh.nodes.len()));
    let wing_panels = first_of(0, animal.wings.iter().map(|w| w.mesh.rows * w.mesh.cols));
    for wing in &animal.wings {
        let other = image_of(animal, wing)?;
        let nodes = wing.mesh.nodes.len();
        pairs.node.extend((0..nodes).map(|k| wing_nodes[other] + k));
        let panels = wing.mesh.rows * wing.mesh.cols;
        pairs
            .panel
            .extend((0..panels).map(|k| wing_panels[other] + k));
    }
    if body_surfaces {
        closed_pairs(&closed(animal), &mut pairs)?;
    }
    for pair in carried {
        let rows = animal.wings[pair.wings[0]].mesh.rows;
        let swapped = |first: usize, n: usize| (first + n..first + 2 * n).chain(first..first + n);
        pairs.node.extend(swapped(pairs.node.len(), 2 * (rows + 1)));
        pairs.panel.extend(swapped(pairs.panel.len(), rows));
    }
    Some(pairs)
}

/// Pairs of wings that are mirror images of each other.
pub fn wing_pairs(animal: &Animal) -> Vec<[usize; 2]> {
    let wings = animal.wings.iter().enumerate();
    let pairs = wings.filter_map(|(k, wing)| Some([k, image_of(animal, wing)?]));
    pairs.filter(|[a, b]| a < b).collect()
}

/// A closed part of the body or of a segment.
struct Closed<'a> {
    mesh: &'a QuadMesh,
    /// Where its frame stands in that of the body in the reference configuration \[m\].
    origin: DVec3,
}

fn closed(animal: &Animal) -> Vec<Closed<'_>> {
    let part = |mesh, origin| Closed { mesh, origin };
    let own = animal.parts.iter().map(|p| part(&p.mesh, DVec3::ZERO));
    let segments = animal.segments.iter();
    let others = segments.flat_map(|s| s.parts.iter().map(move |p| part(&p.mesh, s.origin_b)));
    own.chain(others).collect()
}

/// Adds the pairs of closed parts, each its own image or that of another one.
fn closed_pairs(parts: &[Closed<'_>], pairs: &mut MirrorPairs) -> Option<()> {
    let nodes = first_of(pairs.node.len(), parts.iter().map(|p| p.mesh.nodes.len()));
    let panels = first_of(pairs.panel.len(), parts.iter().map(|p| p.mesh.quads.len()));
    for (k, part) in parts.iter().enumerate() {
        // Itself first: parts that touch in the plane share places.
        let mut others = std::iter::once(k).chain(0..parts.len());
        let (other, image) = others.find_map(|o| Some((o, part.nodes_in(&parts[o])?)))?;
        for quad in &part.mesh.quads {
            let corners = sorted(quad.map(|n| image[n]));
            let is_image = |q: &[usize; 4]| sorted(*q) == corners;
            let panel = parts[other].mesh.quads.iter().position(is_image)?;
            pairs.panel.push(panels[other] + panel);
        }
        pairs.node.extend(image.iter().map(|n| nodes[other] + n));
    }
    Some(())
}

impl Closed<'_> {
    /// The mirror image of every node among the nodes of `other`.
    fn nodes_in(&self, other: &Closed<'_>) -> Option<Vec<usize>> {
        if self.mesh.nodes.len() != other.mesh.nodes.len() {
            return None;
        }
        let place = |part: &Closed<'_>, x: &DVec3| part.origin + *x;
        let own = self.mesh.nodes.iter().map(|x| place(self, x));
        let size = own.clone().map(DVec3::length).fold(0.0, f64::max);
        own.map(|x| {
            let near = |y: &DVec3| place(other, y).distance(mirrored(x)) <= 1e-9 * size;
            other.mesh.nodes.iter().position(near)
        })
        .collect()
    }
}

fn sorted(mut quad: [usize; 4]) -> [usize; 4] {
    quad.sort_unstable();
    quad
}

/// Numbers of the first items of lists laid end to end, the first list's is `from`.
fn first_of(from: usize, counts: impl Iterator<Item = usize>) -> Vec<usize> {
    counts
        .scan(from, |next, n| Some(std::mem::replace(next, *next + n)))
        .collect()
}

/// The mirror image of a wing: of several with its mesh on one hinge, which their motions tell apart, that which is
/// called so.
fn image_of(animal: &Animal, wing: &Wing) -> Option<usize> {
    let images = || (animal.wings.iter().enumerate()).filter(|(_, other)| is_image(wing, other));
    let name = mirror_name(&wing.name);
    let named = images().find(|(_, other)| name.as_ref().is_some_and(|n| *n == *other.name));
    named.or_else(|| images().next()).map(|(k, _)| k)
}

/// Whether `other` has the mesh and the hinge of `wing` in mirror image.
fn is_image(wing: &Wing, other: &Wing) -> bool {
    let same = |a: DVec3, b: DVec3| a.distance(mirrored(b)) <= 1e-9 * (a.length() + b.length());
    wing.side != other.side
        && wing.deformation == other.deformation
        && wing.structure == other.structure
        && same(wing.hinge_b, other.hinge_b)
        && wing.mesh.is_image_of(&other.mesh, 2e-9 * wing.length())
}
