//! The vortex lattice as the air of a flight: surfaces that follow the bodies, wakes as memory.

use std::ops::Range;

use wingbeat_air::{
    AirLoads, AirSettings, AirState, EdgeKind, Lattice, NodeMotion, Points, SheddingKinds,
};
use wingbeat_dynamics::{BodyAcceleration, BodyMotion, Wrench};
use wingbeat_math::{DVec3, Six, SixBySix, six};

use super::mirror::mirror_pairs;
use super::on_plane::EdgeOnPlane;
use super::surfaces::SurfaceMap;
use crate::error::FlightError;
use crate::interface::memory::{AirMemory, wakes_of};
use crate::interface::record::{ParticleSnapshot, Snapshot, SurfaceSnapshot, WakeSnapshot};
use crate::interface::{
    Air, AirScratch, AnswerScratch, Instant, WingInertia, WingResponse, misfit,
};
use crate::setup::{AirOptions, FlightSetup, MotionMode};

/// Gravity across the plane of symmetry that is still the rounding of an attitude, over gravity.
const ROUNDING: f64 = 1e-9;

/// The lattice and its map to the bodies.
#[derive(Debug)]
pub struct LatticeAir {
    lattice: Lattice,
    map: SurfaceMap,
}

/// # Errors
/// Roots of wings that are joined to each other and lie on a plane, where roots are joined to their own images.
fn refuse_roots_joined_twice(
    setup: &FlightSetup,
    joined: &[[usize; 2]],
    on_planes: &[EdgeOnPlane],
) -> Result<(), FlightError> {
    let is_root_of = |edge: &EdgeOnPlane, pair: &[usize; 2]| {
        edge.kind == EdgeKind::Root && pair.contains(&edge.wing)
    };
    let lies_there = |pair: &&[usize; 2]| on_planes.iter().any(|edge| is_root_of(edge, pair));
    joined.iter().find(lies_there).map_or(Ok(()), |pair| {
        let [a, b] = pair.map(|w| &setup.animal.wings[w].name);
        let problem = format!(
            "the roots of the wings `{a}` and `{b}` are joined to each other and lie on it, where a root is joined to its own image, which \
             stands for the other wing; leave one of the two out (mirror = false), or fly both without the plane"
        );
        Err(FlightError::setup("air.ground", "", problem))
    })
}

impl LatticeAir {
    /// The lattice of a setup.
    ///
    /// # Errors
    /// Surfaces or settings that the lattice refuses; a mirror for an animal that is not its own
    /// mirror image.
    pub fn new(setup: &FlightSetup, options: &AirOptions) -> Result<Self, FlightError> {
        let carried = setup.carried_pairs(options);
        let pairs = (&options.joined[..], &carried[..]);
        let mut on_planes = setup.edges_on_planes(options);
        on_planes.retain(EdgeOnPlane::is_joined);
        refuse_roots_joined_twice(setup, &options.joined, &on_planes)?;
        let map = SurfaceMap::new(&setup.animal, options.body_surfaces, pairs)
            .with_tips(&setup.animal, &options.joined_tips)
            .with_planes(&setup.animal, on_planes.into_iter());
        let (mut surfaces, settings) = (map.surfaces.clone(), options.lattice.clone());
        for wing in setup.coincident_roots(options).into_iter().flatten() {
            surfaces[wing].reaches_root = true;
        }
        let lattice = Lattice::joined(surfaces, &map.joined_edges(), settings)?;
        if !options.mirror {
            return Ok(Self { lattice, map });
        }
        let root = setup.root_at_start();
        let refused = |problem: &str| {
            FlightError::setup(
                "air.mirror",
                "true",
                format!("{problem}; compute both sides (false)"),
            )
        };
        let is_free = matches!(setup.mode, MotionMode::Free(_));
        let across = root.r.y_axis.dot(root.v).abs() > ROUNDING * root.v.length();
        let turns = root.w.with_y(0.0).length() > ROUNDING * root.w.length();
        if is_free && (across || turns) {
            let problem = "the body starts across its plane of symmetry, or rolls or yaws (flight.velocity_m_s, flight.angular_velocity_deg_s)";
            return Err(refused(problem));
        }
        if is_free && root.r.y_axis.dot(setup.gravity).abs() > ROUNDING * setup.gravity.length() {
            let problem = "gravity pulls across the plane of symmetry of the body";
            return Err(refused(problem));
        }
        let pairs = mirror_pairs(&setup.animal, (options.body_surfaces, &carried), &root)
            .ok_or_else(|| refused("the animal is not its own mirror image"))?;
        let lattice = lattice.with_mirror_symmetry(pairs)?;
        Ok(Self { lattice, map })
    }

    /// How the panels of a wing answer to accelerations without circulation: of a lattice that sheds nothing,
    /// its rings inside all edges by a quarter panel, which makes added masses good to second order of the
    /// panel size.
    ///
    /// # Errors
    /// What the lattice refuses; a singular influence matrix.
    pub fn inertia(
        setup: &FlightSetup,
        options: &AirOptions,
        wing: usize,
        at: &Instant<'_>,
    ) -> Result<WingResponse, FlightError> {
        let of = &options.lattice;
        let settings = AirSettings {
            bound_core: of.bound_core,
            wake_core: of.wake_core,
            wake_overlap: of.wake_overlap,
            loads: of.loads,
            images: of.images.clone(),
            shedding: SheddingKinds::NONE,
            ..AirSettings::accurate(of.density, DVec3::ZERO)
        };
        let options = AirOptions {
            lattice: settings,
            ..options.clone()
        };
        let air = Self::new(setup, &options)?;
        let (mut s, mut wrenches) = (air.scratch(), vec![Wrench::default(); at.motions.len()]);
        air.place(at, &mut s)?;
        let memory = air.initial(&s);
        air.loads(at, memory.as_ref(), &mut s, &mut wrenches)?;
        let state = wakes_of(memory.as_ref()).ok_or_else(|| misfit("a lattice has a memory"))?;
        let mut answer = WingResponse::default();
        let now = (&mut s.workspace, &s.loads);
        (air.lattice).normal_inertia(wing, state, now, &mut answer.matrix)?;
        air.set_panels(wing, &s, &mut answer);
        Ok(answer)
    }

    /// The lattice.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// How nodes of the mesh share in the panels of a wing, and move them.
    fn set_panels(&self, wing: usize, s: &AirScratch, out: &mut WingResponse) {
        let panels = self.lattice.panels_of(wing);
        let now = (&s.loads, &s.nodes.position[..]);
        out.panels.resize_with(panels.len(), Vec::new);
        for (p, nodes) in panels.zip(&mut out.panels) {
            nodes.clear();
            (self.lattice).normal_wash(p, &s.workspace, now, |n, by| nodes.push((n, by)));
        }
    }

    fn surface_snapshot(&self, s: &AirScratch, k: usize) -> SurfaceSnapshot {
        let surface = &self.lattice.surfaces()[k];
        let panels = self.lattice.panels_of(k);
        SurfaceSnapshot {
            name: surface.name.clone(),
            nodes: s.nodes.position[self.lattice.nodes_of(k)].to_vec(),
            quads: surface.panels.clone(),
            circulation: s.loads.gamma[panels.clone()].to_vec(),
            pressure_jump: s.loads.pressure_jump[panels].to_vec(),
        }
    }

    /// A wake sheet, newest row first, the nodes on the shedding edge included.
    fn wake_snapshot(&self, air: &AirState, s: &AirScratch, k: usize) -> WakeSnapshot {
        let (sheet, root) = (&air.sheets[k], &self.lattice.sheets()[k]);
        let (rows, cols) = (sheet.rows(), sheet.columns);
        let mut nodes: Vec<DVec3> = root.nodes.iter().map(|&n| s.nodes.position[n]).collect();
        let mut circulation = Vec::with_capacity(rows * cols);
        let particles = self.lattice.settings().particles.as_ref();
        let mut shared_circulation = particles.map(|_| Vec::with_capacity(rows * cols));
        for row in (0..rows).rev() {
            nodes.extend((0..=cols).map(|c| sheet.node(row, c)));
            // Rings that have become particles are drawn without circulation.
            let of = |c: usize| match sheet.is_ring(row, c) {
                true => sheet.ring(row, c),
                false => 0.0,
            };
            circulation.extend((0..cols).map(of));
            if let Some(all) = &mut shared_circulation {
                let shared = |c: usize| sheet.ring(row, c) - of(c);
                all.extend((0..cols).map(shared));
            }
        }
        let surface = &self.lattice.surfaces()[root.surface].name;
        WakeSnapshot {
            name: format!("{surface}-wake-{k}"),
            rows,
            cols,
            nodes,
            circulation,
            shared_circulation,
            particles: self.particle_snapshots(air, k),
        }
    }

    fn particle_snapshots(&self, air: &AirState, k: usize) -> Vec<ParticleSnapshot> {
        let Some(settings) = &self.lattice.settings().particles else {
            return vec![];
        };
        let particles = &air.sheets[k].particles;
        let vectors = particles.position.iter().zip(particles.strength.iter());
        let all = vectors.zip(&particles.shed_time);
        let of = |((position, strength), shed): ((DVec3, DVec3), &f64)| ParticleSnapshot {
            position,
            strength,
            radius: settings.core(air.time - shed).sqrt(),
        };
        all.map(of).collect()
    }
}

impl Air for LatticeAir {
    /// Unchanged nodes in an unchanged wake keep their loads.
    fn loads(
        &self,
        at: &Instant<'_>,
        memory: Option<&AirMemory>,
        s: &mut AirScratch,
        out: &mut [Wrench],
    ) -> Result<(), FlightError> {
        let state = wakes_of(memory).ok_or_else(|| misfit("a lattice needs its wakes"))?;
        if !(s.is_current && s.nodes == s.nodes_done) {
            let (t, h) = (at.time, at.step);
            (self.lattice)
                .loads(state, t, h, &s.nodes, &mut s.workspace, &mut s.loads)
                .map_err(|e| self.map.error_of(e, at))?;
            (s.nodes_done.position).clone_from(&s.nodes.position);
            (s.nodes_done.velocity).clone_from(&s.nodes.velocity);
            s.is_current = true;
        }
        self.map.wrenches(&s.loads, at.motions, out);
        Ok(())
    }

    fn has_memory(&self) -> bool {
        true
    }

    fn is_steady_and_uniform(&self) -> bool {
        let settings = self.lattice.settings();
        settings.wind.is_none() && settings.images.is_empty()
    }

    fn scratch(&self) -> AirScratch {
        AirScratch {
            workspace: self.lattice.workspace(),
            ..AirScratch::default()
        }
    }

    fn place(&self, at: &Instant<'_>, s: &mut AirScratch) -> Result<(), FlightError> {
        self.map.node_motion(at, &mut s.nodes)
    }

    fn initial(&self, s: &AirScratch) -> Option<AirMemory> {
        let wakes = self.lattice.initial_state(&s.nodes);
        Some(AirMemory::Wakes(Box::new(wakes)))
    }

    fn advance(
        &self,
        memory: &mut Option<AirMemory>,
        step: f64,
        s: &mut AirScratch,
    ) -> Result<(), FlightError> {
        if let Some(air) = memory.as_mut().and_then(AirMemory::wakes_mut) {
            self.lattice.convect(air, step, &mut s.workspace)?;
            s.is_current = false;
        }
        Ok(())
    }

    fn accept(&self, memory: &mut Option<AirMemory>, s: &AirScratch) -> Result<(), FlightError> {
        if let Some(air) = memory.as_mut().and_then(AirMemory::wakes_mut) {
            self.lattice.accept(air, &s.nodes, &s.loads)?;
        }
        Ok(())
    }

    fn check(&self, memory: Option<&AirMemory>) -> Result<(), FlightError> {
        let air =
            wakes_of(memory).ok_or_else(|| misfit("the case has wakes, the state has none"))?;
        Ok(self.lattice.check_state(air)?)
    }

    fn nodal_forces(
        &self,
        wing: usize,
        _at: &Instant<'_>,
        s: &mut AirScratch,
        out: &mut Vec<DVec3>,
    ) -> Result<(), FlightError> {
        (self.lattice).nodal_forces(wing, &s.loads, &s.nodes, &mut s.rings, out);
        Ok(())
    }

    fn wing_response(
        &self,
        wing: usize,
        _at: &Instant<'_>,
        memory: Option<&AirMemory>,
        s: &mut AirScratch,
        out: &mut WingResponse,
    ) -> Result<bool, FlightError> {
        let state = wakes_of(memory).ok_or_else(|| misfit("a lattice needs its wakes"))?;
        out.inertia.clear();
        let now = (&mut s.workspace, &s.loads);
        (self.lattice).normal_response(wing, state, now, &mut out.matrix)?;
        self.set_panels(wing, s, out);
        Ok(true)
    }

    fn wing_inertia(
        &self,
        wing: usize,
        at: &Instant<'_>,
        memory: Option<&AirMemory>,
        s: &mut AirScratch,
    ) -> Result<Option<WingInertia>, FlightError> {
        let state = wakes_of(memory).ok_or_else(|| misfit("a lattice needs its wakes"))?;
        let Some(rate_weights) = self.lattice.circulation_rate_weights(state, at.step) else {
            return Ok(None);
        };
        let now = (&mut s.workspace, &s.loads);
        (self.lattice).normal_inertia(wing, state, now, &mut s.answer.response)?;
        let panels = self.lattice.panels_of(wing);
        let mass = rigid_added_mass(&mut s.answer, &s.loads, panels, &at.motions[wing + 1]);
        Ok(Some(WingInertia { mass, rate_weights }))
    }

    fn rate_loads_at_start(
        &self,
        wings: &[usize],
        at: &Instant<'_>,
        pushed: &[BodyMotion],
        memory: Option<&AirMemory>,
        s: &AirScratch,
        out: &mut [Wrench],
    ) -> Result<bool, FlightError> {
        let state = wakes_of(memory).ok_or_else(|| misfit("a lattice needs its wakes"))?;
        if self.lattice.circulation_rate_weights(state, at.step) != Some([0.0; 3]) {
            return Ok(false);
        }
        let (mut ws, mut loads) = (self.lattice.workspace(), AirLoads::default());
        let mut nodes = NodeMotion::default();
        let then = Instant::rigid(at.time, at.step, pushed);
        self.map.node_motion(&then, &mut nodes)?;
        (self.lattice)
            .loads(state, at.time, at.step, &nodes, &mut ws, &mut loads)
            .map_err(|e| self.map.error_of(e, at))?;
        for &wing in wings {
            let origin = at.motions[wing + 1].p;
            for p in self.lattice.panels_of(wing) {
                let rate = (loads.gamma[p] - s.loads.gamma[p]) / at.step;
                let now = (&s.workspace, &s.loads);
                let [force, couple] = self.lattice.loads_of_rate(p, rate, now);
                let moment = couple + (s.loads.panels.point[p] - origin).cross(force);
                out[wing + 1] += Wrench { force, moment };
            }
        }
        Ok(true)
    }

    fn deforms(&self) -> bool {
        self.map.deforms()
    }

    fn deformation_power(
        &self,
        at: &Instant<'_>,
        _accelerations: &[BodyAcceleration],
        s: &mut AirScratch,
        out: &mut [f64],
    ) {
        (self.map).deformation_power(&s.loads, &s.nodes, at, out);
        for wing in self.map.joined_bent(at) {
            let AirScratch {
                loads,
                nodes,
                rings,
                nodal,
                ..
            } = s;
            (self.lattice).nodal_forces(wing, loads, nodes, rings, nodal);
            out[wing + 1] += self.map.joining_power(wing, nodal, nodes, at);
        }
    }

    fn surfaces(&self, s: &AirScratch) -> Vec<SurfaceSnapshot> {
        let all = self.lattice.surfaces().iter().enumerate();
        let surfaces = all.filter(|(_, s)| !s.carry_through).map(|(k, _)| k);
        surfaces.map(|k| self.surface_snapshot(s, k)).collect()
    }

    fn snapshot(&self, memory: Option<&AirMemory>, s: &AirScratch) -> Snapshot {
        let Some(air) = wakes_of(memory) else {
            return Snapshot::default();
        };
        let wakes = 0..air.sheets.len();
        Snapshot {
            surfaces: self.surfaces(s),
            wakes: wakes.map(|k| self.wake_snapshot(air, s, k)).collect(),
            ..Snapshot::default()
        }
    }

    fn velocity(
        &self,
        memory: Option<&AirMemory>,
        points: &Points,
    ) -> Result<Option<Points>, FlightError> {
        let Some(wakes) = wakes_of(memory) else {
            return Ok(None);
        };
        let (mut ws, mut velocity) = (self.lattice.workspace(), Points::default());
        (self.lattice).velocity(wakes, points, &mut ws, &mut velocity)?;
        Ok(Some(velocity))
    }
}

/// Entries of an added mass smaller than this over the geometric mean of their diagonal ones are rounding \[1\].
const NOTHING: f64 = 1e-12;

/// The added mass of a wing that moves as a rigid body like `m`, from the `response` of the normal forces of its
/// panels to normal accelerations; symmetric as energy asks.
fn rigid_added_mass(
    AnswerScratch { response, moved }: &mut AnswerScratch,
    loads: &AirLoads,
    panels: Range<usize>,
    m: &BodyMotion,
) -> SixBySix {
    let back = m.r.transpose();
    let of_panel = |p: usize| {
        let normal = back * loads.panels.normal[p];
        let turn = (back * (loads.panels.point[p] - m.p)).cross(normal);
        six(normal, turn)
    };
    moved.clear();
    moved.extend(panels.map(of_panel));
    let mut mass = [[0.0; 6]; 6];
    for (row, by) in response.chunks_exact(moved.len()).zip(&*moved) {
        for (factor, of) in row.iter().zip(&*moved) {
            for (i, j) in (0..36).map(|k| (k / 6, k % 6)) {
                let part = -0.5 * factor * by[i] * of[j];
                mass[i][j] += part;
                mass[j][i] += part;
            }
        }
    }
    let size = |k: usize| -> f64 { (0..3).map(|l| mass[3 * (k / 3) + l][3 * (k / 3) + l]).sum() };
    let sizes: Six = std::array::from_fn(size);
    for (i, j) in (0..36).map(|k| (k / 6, k % 6)) {
        if mass[i][j].abs() <= NOTHING * (sizes[i] * sizes[j]).sqrt() {
            mass[i][j] = 0.0;
        }
    }
    mass
}
