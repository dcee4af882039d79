//! From bodies to lattice surfaces and back: node positions and velocities for the air, panel
//! forces gathered into wrenches for the dynamics (seed eq. 9).

use wingbeat_air::{AirError, AirLoads, EdgeKind, JoinedEdge, NodeMotion, Surface};
use wingbeat_dynamics::{BodyMotion, Wrench};
use wingbeat_math::{DVec3, RotationLaw};
use wingbeat_model::{
    Animal, BodyPart, DeformingMesh, GridMesh, PairOnPart, Side, Spacing, Wing, WingMotion,
};

use super::on_plane::{EdgeOnPlane, OnPlane, columns_of};
use super::shared_edge::SharedEdge;
use crate::error::FlightError;
use crate::interface::{BentShape, Instant};

/// Which lattice nodes and panels belong to which rigid body.
#[derive(Clone, Debug)]
pub struct SurfaceMap {
    /// Lattice topology, surface by surface.
    pub surfaces: Vec<Surface>,
    /// Per surface: the body it is fixed to.
    body: Vec<usize>,
    /// Nodes of all surfaces, body components [m]; at rest where they are deformed.
    local: Vec<DVec3>,
    /// Per surface: how it is deformed.
    deforming: Vec<Option<Deforming>>,
    /// Edges of wings that are joined.
    joined: Vec<SharedEdge>,
    /// Edges of wings that are joined to their images.
    on_planes: Vec<OnPlane>,
    /// Strips through bodies.
    carried: Vec<CarryThrough>,
    /// Per surface: range of its nodes in `local`.
    nodes: Vec<std::ops::Range<usize>>,
    /// Per surface: range of its panels among all panels.
    panels: Vec<std::ops::Range<usize>>,
}

/// A surface that changes its shape in the phase of its wing's beat.
#[derive(Clone, Debug)]
struct Deforming {
    mesh: DeformingMesh,
    motion: WingMotion,
}

/// The strip from the root of a wing to the middle of the body it stands on, where that of the other wing begins.
#[derive(Clone, Debug)]
struct CarryThrough {
    /// Its surface.
    surface: usize,
    /// The wing, and the other one.
    wings: [usize; 2],
    /// Nodes of their roots among all nodes, from leading to trailing edge.
    roots: Vec<[usize; 2]>,
    /// From the middles between them to the nodes there \[m\], body components.
    aside: DVec3,
}

impl SurfaceMap {
    /// Wings first, in the animal's order (body `i + 1`), then the closed parts of the root body and those of
    /// the segments when `body_surfaces` says so; strips through bodies last. The pairs of wings in `joined`
    /// share the edge at their roots, the circulation of those in `carried` goes on through a body.
    pub fn new(
        animal: &Animal,
        body_surfaces: bool,
        (joined, carried): (&[[usize; 2]], &[PairOnPart]),
    ) -> Self {
        let mut map = Self {
            surfaces: vec![],
            body: vec![],
            deforming: vec![],
            joined: vec![],
            on_planes: vec![],
            carried: vec![],
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
            let deforming = |d| Deforming {
                mesh: DeformingMesh::new(&wing.mesh, d),
                motion: wing.motion.clone(),
            };
            map.deforming[i] = wing.deformation.as_ref().map(deforming);
        }
        for &[a, b] in joined {
            let nodes = [a, b].map(|k| map.nodes[k].clone());
            map.joined.push(SharedEdge::of_roots(animal, [a, b], nodes));
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
        for pair in carried {
            let [a, b] = pair.wings;
            map.carry([a, b], pair.aside, animal);
            map.carry([b, a], pair.aside, animal);
        }
        map
    }

    /// The same with the tips of these wings joined to the roots of those that they carry.
    pub fn with_tips(mut self, animal: &Animal, pairs: &[[usize; 2]]) -> Self {
        for &wings in pairs {
            let [tip, root] = [(0, EdgeKind::Tip), (1, EdgeKind::Root)]
                .map(|(k, kind)| self.columns_of(animal, wings[k], kind));
            let edge = SharedEdge::of_tip(animal, wings, [tip, root], &self.local);
            self.joined.push(edge);
        }
        self
    }

    /// The same with these edges of wings joined to their images.
    pub fn with_planes(
        mut self,
        animal: &Animal,
        edges: impl Iterator<Item = EdgeOnPlane>,
    ) -> Self {
        for edge in edges {
            let columns = self.columns_of(animal, edge.wing, edge.kind);
            let name = &animal.wings[edge.wing].name;
            (self.on_planes).push(OnPlane::new(name, &edge, columns, &self.local));
        }
        self
    }

    /// Nodes among all nodes of the root or tip of a wing, and of the next column ([`columns_of`]).
    pub fn columns_of(&self, animal: &Animal, wing: usize, kind: EdgeKind) -> [Vec<usize>; 2] {
        columns_of(&animal.wings[wing].mesh, self.nodes[wing].start, kind)
    }

    /// Adds the strip from the root of the first of these wings to the middle between both roots, which lies
    /// `aside` by so much.
    fn carry(&mut self, wings: [usize; 2], aside: DVec3, animal: &Animal) {
        let nodes = wings.map(|k| self.nodes[k].clone());
        let roots = SharedEdge::of_roots(animal, wings, nodes).nodes;
        let wing = &animal.wings[wings[0]];
        let strip = GridMesh {
            rows: wing.mesh.rows,
            cols: 1,
            nodes: vec![DVec3::ZERO; 2 * (wing.mesh.rows + 1)],
            columns: Spacing::Uniform,
        };
        let name = format!("{}-carry-through", wing.name);
        let surface = Surface {
            carry_through: true,
            ..wing_surface(&name, &strip, wing.side)
        };
        let surface_number = self.surfaces.len();
        self.push(surface, &strip.nodes, 0);
        self.surfaces[surface_number].rest = None;
        self.carried.push(CarryThrough {
            surface: surface_number,
            wings,
            roots,
            aside,
        });
    }

    fn push(&mut self, surface: Surface, nodes: &[DVec3], body: usize) {
        let first_panel = self.panels.last().map_or(0, |r| r.end);
        self.nodes
            .push(self.local.len()..self.local.len() + nodes.len());
        self.panels
            .push(first_panel..first_panel + surface.panels.len());
        self.local.extend_from_slice(nodes);
        self.body.push(body);
        self.surfaces.push(surface.with_rest(nodes.to_vec()));
        self.deforming.push(None);
    }

    /// What is joined to what, in the words of the lattice.
    pub fn joined_edges(&self) -> Vec<JoinedEdge> {
        let edge = |r: &SharedEdge| {
            let first = r.wings.map(|w| self.nodes[w].start);
            let local = |n: &[usize; 2]| [n[0] - first[0], n[1] - first[1]];
            JoinedEdge {
                surfaces: r.wings,
                nodes: r.nodes.iter().map(local).collect(),
            }
        };
        let on_plane = |p: &OnPlane| p.joined_edge(self.nodes[p.wing].start);
        let of_wings = self.joined.iter().map(edge);
        let of_planes = self.on_planes.iter().map(on_plane);
        of_wings
            .chain(self.carried_edges())
            .chain(of_planes)
            .collect()
    }

    /// Both sides of the strips through bodies: at the root, and in the middle.
    fn carried_edges(&self) -> impl Iterator<Item = JoinedEdge> + '_ {
        let rows = |c: &CarryThrough| 0..c.roots.len();
        let at_root = move |c: &CarryThrough| {
            let first = self.nodes[c.wings[0]].start;
            JoinedEdge {
                surfaces: [c.wings[0], c.surface],
                nodes: rows(c)
                    .map(|i| [c.roots[i][0] - first, 2 * i + 1])
                    .collect(),
            }
        };
        let in_middle = move |pair: &[CarryThrough]| JoinedEdge {
            surfaces: [pair[0].surface, pair[1].surface],
            nodes: rows(&pair[0]).map(|i| [2 * i, 2 * i]).collect(),
        };
        let middles = self.carried.chunks_exact(2).map(in_middle);
        self.carried.iter().map(at_root).chain(middles)
    }

    /// Positions and velocities of all lattice nodes in N, from the motions of the bodies (seed eq. 3 and 14) and the
    /// deformation of the wings, prescribed or by loads.
    ///
    /// # Errors
    /// Joined roots are too far apart, or an edge on a plane of images too far from it.
    pub fn node_motion(&self, at: &Instant<'_>, out: &mut NodeMotion) -> Result<(), FlightError> {
        out.position.resize(self.local.len(), DVec3::ZERO);
        out.velocity.resize(self.local.len(), DVec3::ZERO);
        for (surface, nodes) in self.nodes.iter().enumerate() {
            let b = &at.motions[self.body[surface]];
            let mut put = |k: usize, r: DVec3, u: DVec3| {
                out.position[k] = b.p + b.r * r;
                out.velocity[k] = b.v + b.r * (b.w.cross(r) + u);
            };
            match (bent(at, surface), &self.deforming[surface]) {
                (Some(shape), _) => {
                    let moving = shape.position.iter().zip(&shape.velocity);
                    (nodes.clone().zip(moving)).for_each(|(k, (r, u))| put(k, *r, *u));
                }
                (None, None) => nodes
                    .clone()
                    .for_each(|k| put(k, self.local[k], DVec3::ZERO)),
                (None, Some(d)) => d.mesh.visit(d.motion.phase_at(at.time), |k, [r, u, _]| {
                    put(nodes.start + k, r, u);
                }),
            }
        }
        (self.joined.iter()).try_for_each(|edge| edge.join(at.time, out))?;
        (self.on_planes.iter()).try_for_each(|edge| edge.place(at.time, out))?;
        (self.carried.iter()).for_each(|strip| strip.place(&at.motions[0], self, out));
        Ok(())
    }

    /// The error of the lattice at this instant: a panel that is none belongs to a sheet that folded over, if
    /// its wing changes its shape.
    pub fn error_of(&self, error: AirError, at: &Instant<'_>) -> FlightError {
        let (AirError::Crossed { surface, panel, .. }
        | AirError::NoLength { surface, panel, .. }
        | AirError::FlatPanel { surface, panel, .. }) = &error
        else {
            return error.into();
        };
        let number = self.surfaces.iter().position(|s| s.name == *surface);
        let elastic = number.is_some_and(|k| matches!(at.shapes.get(k), Some(Some(_))));
        if elastic || number.is_some_and(|k| self.deforming[k].is_some()) {
            return FlightError::Folded {
                time: at.time,
                wing: surface.clone(),
                panel: *panel,
                elastic,
            };
        }
        error.into()
    }

    /// Power that is needed to deform the wings against the air [W], body by body: that of the air
    /// on what the surfaces move beside their bodies, with the opposite sign. Those that loads bend are left
    /// out: of them only [`Self::joining_power`] is asked for.
    pub fn deformation_power(
        &self,
        loads: &AirLoads,
        nodes: &NodeMotion,
        at: &Instant<'_>,
        out: &mut [f64],
    ) {
        out.fill(0.0);
        for (s, panels) in self.panels.iter().enumerate() {
            let moves = self.deforming[s].is_some() || self.is_joined(s);
            if !moves || bent(at, s).is_some() {
                continue;
            }
            let (body, first) = (self.body[s], self.nodes[s].start);
            let b = &at.motions[body];
            let w = b.r * b.w;
            for (k, corners) in panels.clone().zip(&self.surfaces[s].panels) {
                let rigid = b.v + w.cross(loads.panels.point[k] - b.p);
                let mut power = loads.force[k].dot(loads.panels.velocity[k] - rigid);
                if loads.couple[k] != DVec3::ZERO {
                    let turn = spin(nodes, corners.map(|n| first + n));
                    power += loads.couple[k].dot(turn - w);
                }
                out[body] -= power;
            }
        }
    }

    /// Surfaces with joined edges that loads bend.
    pub fn joined_bent<'a>(&'a self, at: &'a Instant<'_>) -> impl Iterator<Item = usize> + 'a {
        (0..self.surfaces.len()).filter(|&s| self.is_joined(s) && bent(at, s).is_some())
    }

    /// Power that joining its edges takes against the air \[W\], of surface `s` that loads bend: that of its
    /// nodal `forces` \[N\], N components, on what its nodes there move otherwise than its frame and its
    /// bending carry them, with the opposite sign. The power on its bending is that of the air on the wing.
    pub fn joining_power(
        &self,
        s: usize,
        forces: &[DVec3],
        nodes: &NodeMotion,
        at: &Instant<'_>,
    ) -> f64 {
        let Some(shape) = bent(at, s) else { return 0.0 };
        let (b, own) = (&at.motions[self.body[s]], &self.nodes[s]);
        let w = b.r * b.w;
        let shared = self
            .joined
            .iter()
            .flat_map(|edge| edge.nodes.iter().flatten());
        let on_planes = self.on_planes.iter().flat_map(OnPlane::nodes);
        let of_surface = shared.chain(on_planes).filter(|n| own.contains(n));
        let power = of_surface.map(|&n| {
            let (k, arm) = (n - own.start, nodes.position[n] - b.p);
            let by_itself = b.v + w.cross(arm) + b.r * shape.velocity[k];
            forces[k].dot(nodes.velocity[n] - by_itself)
        });
        -power.sum::<f64>()
    }

    /// Whether an edge of this surface is joined to another one, or to its mirror image.
    fn is_joined(&self, s: usize) -> bool {
        self.joined.iter().any(|edge| edge.wings.contains(&s))
            || self.on_planes.iter().any(|edge| edge.wing == s)
    }

    /// Whether any surface moves otherwise than its body.
    pub fn deforms(&self) -> bool {
        !(self.joined.is_empty() && self.on_planes.is_empty())
            || self.deforming.iter().any(Option::is_some)
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

/// The shape of this surface, if loads bend it.
fn bent<'a>(at: &Instant<'a>, surface: usize) -> Option<&'a BentShape> {
    at.shapes.get(surface).and_then(Option::as_ref)
}

/// Whether the roots of two wings meet at time zero, as they must to be joined.
///
/// # Errors
/// Different panels at the roots; roots apart.
pub fn check_joined(animal: &Animal, pair: [usize; 2]) -> Result<(), FlightError> {
    let meshes = pair.map(|w| &animal.wings[w].mesh);
    let along = |mesh: &GridMesh| -> Vec<f64> {
        let x = |i: usize| mesh.nodes[mesh.node(i, 0)].x;
        (0..=mesh.rows).map(x).collect()
    };
    let [a, b] = meshes.map(along);
    let chord = a[0] - a[a.len() - 1];
    let same = a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| (a - b).abs() <= 1e-9 * chord);
    if !same {
        let names = pair.map(|w| animal.wings[w].name.clone());
        return Err(FlightError::setup(
            "joined",
            names.join(", "),
            "the roots have different chords, or different panels along the chord",
        ));
    }
    let at = |w: &Wing| BodyMotion {
        p: w.hinge_b,
        r: w.motion.at(0.0).c,
        ..BodyMotion::REST
    };
    let wings = animal.wings.iter().map(at);
    let motions: Vec<BodyMotion> = std::iter::once(BodyMotion::REST).chain(wings).collect();
    let at = Instant::rigid(0.0, 0.0, &motions);
    SurfaceMap::new(animal, false, (&[pair], &[])).node_motion(&at, &mut NodeMotion::default())
}

impl CarryThrough {
    /// Puts its nodes on the root and between both roots.
    fn place(&self, body: &BodyMotion, map: &SurfaceMap, out: &mut NodeMotion) {
        let first = map.nodes[self.surface].start;
        let aside = body.r * self.aside;
        let turned = (body.r * body.w).cross(aside);
        for (i, &[own, other]) in self.roots.iter().enumerate() {
            for (x, aside) in [(&mut out.position, aside), (&mut out.velocity, turned)] {
                let middle = 0.5 * (x[own] + x[other]) + aside;
                (x[first + 2 * i], x[first + 2 * i + 1]) = (middle, x[own]);
            }
        }
    }
}

/// Angular velocity of a panel [rad/s], N: that of its normal, and the mean one of its diagonals
/// about it. Exact for a panel that moves as a rigid one.
fn spin(nodes: &NodeMotion, corners: [usize; 4]) -> DVec3 {
    let across = |of: &[DVec3]| {
        let [a, b, c, d] = corners.map(|n| of[n]);
        [c - a, d - b]
    };
    let ([d, e], [d1, e1]) = (across(&nodes.position), across(&nodes.velocity));
    let area = d.cross(e);
    let n = area.normalize_or_zero();
    let area_rate = d1.cross(e) + d.cross(e1);
    let about = |d: DVec3, d1: DVec3| n.cross(d).dot(d1) / d.length_squared();
    n.cross(area_rate) / area.length() + 0.5 * (about(d, d1) + about(e, e1)) * n
}

/// A closed part as a lattice surface.
fn part_surface(part: &BodyPart) -> Surface {
    Surface::closed(&part.name, part.mesh.nodes.len(), part.mesh.quads.clone())
}

/// A wing as a lattice surface: normals along +axis 3 on both sides.
fn wing_surface(name: &str, mesh: &GridMesh, side: Side) -> Surface {
    Surface {
        panels: mesh.panels(side),
        cosine_columns: mesh.columns == Spacing::Cosine,
        ..Surface::grid(name, mesh.rows, mesh.cols)
    }
}
