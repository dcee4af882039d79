//! From bodies to lattice surfaces and back: node positions and velocities for the air, panel
//! forces gathered into wrenches for the dynamics (seed eq. 9).

use wingbeat_air::{AirLoads, EdgeKind, NodeMotion, Plane, SheddingSegment, Surface, Twins};
use wingbeat_dynamics::{BodyMotion, Wrench};
use wingbeat_math::DVec3;
use wingbeat_model::mesh::mirror;
use wingbeat_model::{Animal, BodyPart, GridMesh, Side, Wing};

/// Which lattice nodes and panels belong to which rigid body.
#[derive(Clone, Debug)]
pub struct SurfaceMap {
    /// Lattice topology, surface by surface.
    pub surfaces: Vec<Surface>,
    /// Per surface: the body it is fixed to.
    body: Vec<usize>,
    /// Nodes of all surfaces, body components [m].
    local: Vec<DVec3>,
    /// Per surface: range of its nodes in `local`.
    nodes: Vec<std::ops::Range<usize>>,
    /// Per surface: range of its panels among all panels.
    panels: Vec<std::ops::Range<usize>>,
}

impl SurfaceMap {
    /// Wings first, in the animal's order (body `i + 1`), then the closed parts of the root body
    /// and those of the segments when `body_surfaces` says so.
    pub fn new(animal: &Animal, body_surfaces: bool) -> Self {
        let mut map = Self {
            surfaces: vec![],
            body: vec![],
            local: vec![],
            nodes: vec![],
            panels: vec![],
        };
        for (i, wing) in animal.wings.iter().enumerate() {
            map.push(
                wing_surface(&wing.name, &wing.mesh, wing.side),
                &wing.mesh.nodes,
                i + 1,
            );
        }
        for part in animal.parts.iter().filter(|_| body_surfaces) {
            map.push(part_surface(part), &part.mesh.nodes, 0);
        }
        let first = animal.wings.len() + 1;
        for (i, segment) in animal.segments.iter().enumerate() {
            for part in segment.parts.iter().filter(|_| body_surfaces) {
                map.push(part_surface(part), &part.mesh.nodes, first + i);
            }
        }
        map
    }

    fn push(&mut self, surface: Surface, nodes: &[DVec3], body: usize) {
        let first_panel = self.panels.last().map_or(0, |r| r.end);
        self.nodes
            .push(self.local.len()..self.local.len() + nodes.len());
        self.panels
            .push(first_panel..first_panel + surface.panels.len());
        self.local.extend_from_slice(nodes);
        self.body.push(body);
        self.surfaces.push(surface);
    }

    /// Positions and velocities of all lattice nodes in N, from the motions of the bodies
    /// (seed eq. 3 and 14).
    pub fn node_motion(&self, bodies: &[BodyMotion], out: &mut NodeMotion) {
        out.position.resize(self.local.len(), DVec3::ZERO);
        out.velocity.resize(self.local.len(), DVec3::ZERO);
        for (surface, nodes) in self.nodes.iter().enumerate() {
            let b = &bodies[self.body[surface]];
            for k in nodes.clone() {
                let r = self.local[k];
                out.position[k] = b.p + b.r * r;
                out.velocity[k] = b.v + b.r * b.w.cross(r);
            }
        }
    }

    /// Panel forces gathered into one wrench per body about the body's origin, in N.
    pub fn wrenches(&self, loads: &AirLoads, bodies: &[BodyMotion], out: &mut [Wrench]) {
        for w in out.iter_mut() {
            *w = Wrench {
                force: DVec3::ZERO,
                moment: DVec3::ZERO,
            };
        }
        for (surface, panels) in self.panels.iter().enumerate() {
            let body = self.body[surface];
            for k in panels.clone() {
                out[body].force += loads.force[k];
                let arm = loads.panels.point[k] - bodies[body].p;
                out[body].moment += arm.cross(loads.force[k]) + loads.couple[k];
            }
        }
    }
}

/// The twins of an animal that is its own mirror image in the plane of axes 1 and 3 of the body,
/// at rest at `root`; none if a wing or a body node has no counterpart.
pub fn twins(animal: &Animal, body_surfaces: bool, root: &BodyMotion) -> Option<Twins> {
    if !animal.segments.is_empty() {
        return None;
    }
    let mut twins = Twins {
        plane: Plane {
            point: root.p,
            normal: root.r.y_axis,
        },
        node: vec![],
        panel: vec![],
    };
    let wing_nodes = first_of(animal.wings.iter().map(|w| w.mesh.nodes.len()));
    let wing_panels = first_of(animal.wings.iter().map(|w| w.mesh.rows * w.mesh.cols));
    for wing in &animal.wings {
        let other = animal.wings.iter().position(|o| is_image(wing, o))?;
        let nodes = wing.mesh.nodes.len();
        twins.node.extend((0..nodes).map(|k| wing_nodes[other] + k));
        let panels = wing.mesh.rows * wing.mesh.cols;
        twins
            .panel
            .extend((0..panels).map(|k| wing_panels[other] + k));
    }
    for part in animal.parts.iter().filter(|_| body_surfaces) {
        let (node, panel) = (twins.node.len(), twins.panel.len());
        let own = mirror_nodes(&part.mesh.nodes)?;
        for quad in &part.mesh.quads {
            let mut image = quad.map(|n| own[n]);
            image.sort_unstable();
            let is_twin = |q: &[usize; 4]| {
                let mut q = *q;
                q.sort_unstable();
                q == image
            };
            twins
                .panel
                .push(panel + part.mesh.quads.iter().position(is_twin)?);
        }
        twins.node.extend(own.iter().map(|k| node + k));
    }
    Some(twins)
}

/// Number of the first item of each of these lists laid end to end.
fn first_of(counts: impl Iterator<Item = usize>) -> Vec<usize> {
    counts
        .scan(0, |next, n| Some(std::mem::replace(next, *next + n)))
        .collect()
}

/// Whether `other` has the mesh and the hinge of `wing` in mirror image.
fn is_image(wing: &Wing, other: &Wing) -> bool {
    let same = |a: DVec3, b: DVec3| a.distance(mirror(b)) <= 1e-9 * (a.length() + b.length());
    let nodes = wing.mesh.nodes.iter().zip(&other.mesh.nodes);
    wing.side != other.side
        && (wing.mesh.rows, wing.mesh.cols) == (other.mesh.rows, other.mesh.cols)
        && same(wing.hinge_b, other.hinge_b)
        && nodes.into_iter().all(|(&a, &b)| same(a, b))
}

/// The mirror image of every node among the nodes.
fn mirror_nodes(nodes: &[DVec3]) -> Option<Vec<usize>> {
    let size = nodes.iter().map(|x| x.length()).fold(0.0, f64::max);
    let image = |x: &DVec3| {
        let near = |y: &DVec3| y.distance(mirror(*x)) <= 1e-9 * size;
        nodes.iter().position(near)
    };
    nodes.iter().map(image).collect()
}

/// A closed part as a lattice surface.
fn part_surface(part: &BodyPart) -> Surface {
    Surface {
        name: part.name.clone(),
        node_count: part.mesh.nodes.len(),
        panels: part.mesh.quads.clone(),
        shedding: vec![],
        closed: true,
    }
}

/// A wing as a lattice surface: its sharp edges shed in one chain that runs from the root along
/// the leading edge, over the tip, and along the trailing edge back to the root.
fn wing_surface(name: &str, mesh: &GridMesh, side: Side) -> Surface {
    let (rows, cols) = (mesh.rows, mesh.cols);
    let node = |i: usize, j: usize| i * (cols + 1) + j;
    let panel = |i: usize, j: usize| i * cols + j;
    let segment = |from, to, panel, kind| SheddingSegment {
        from,
        to,
        panel,
        kind,
    };
    let mut chain = Vec::with_capacity(2 * cols + rows);
    for j in 0..cols {
        chain.push(segment(
            node(0, j),
            node(0, j + 1),
            panel(0, j),
            EdgeKind::Leading,
        ));
    }
    for i in 0..rows {
        chain.push(segment(
            node(i, cols),
            node(i + 1, cols),
            panel(i, cols - 1),
            EdgeKind::Tip,
        ));
    }
    for j in (0..cols).rev() {
        chain.push(segment(
            node(rows, j + 1),
            node(rows, j),
            panel(rows - 1, j),
            EdgeKind::Trailing,
        ));
    }
    Surface {
        name: name.to_string(),
        node_count: mesh.nodes.len(),
        panels: mesh.panels(side),
        shedding: vec![chain],
        closed: false,
    }
}
